//! What words of the vocabulary mean, in closed kinds. The words themselves are in `catalogs/vocabulary.yaml`.

use serde::Deserialize;

/// How many, where nobody counts.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum Vague {
    /// Two.
    Couple,
    /// A few.
    Few,
    /// Some.
    Some,
    /// Several.
    Several,
    /// Many.
    Many,
    /// Dozens.
    Dozens,
    /// Hundreds.
    Hundreds,
}

/// What a number is bounded or blurred by.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum Bound {
    /// "up to".
    AtMost,
    /// "at least".
    AtLeast,
    /// "about".
    About,
}

/// Words that make ranges of numbers.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum RangeWord {
    /// Before the first end.
    From,
    /// Between the ends.
    To,
    /// Between the ends after "between", between the last two of a list.
    And,
    /// Between the last two of a choice.
    Or,
    /// "in equal steps".
    Steps,
    /// "step", behind a number.
    Step,
    /// Between the sides of an area.
    By,
    /// Before the number of steps.
    In,
}

/// What a number is of.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum Cue {
    Visibility,
    Depth,
    BelowSurface,
    AboveSurface,
    Altitude,
    ObjectRange,
    MostRange,
    LeastRange,
    RangeWindow,
    Spacing,
    Apart,
    Size,
    Wavelength,
    Relief,
    PathLength,
    Radius,
    DiveTo,
    Front,
    Behind,
    Left,
    Right,
    FromThing,
    SonarDepth,
    Temperature,
    Salinity,
    Ph,
    Frequency,
    Beams,
    Fov,
    TiltDown,
    TiltUp,
    Yaw,
    Slope,
    Heading,
    Arc,
    Motion,
    Speed,
    Burial,
    Seed,
    Lines,
    Sides,
}

/// Words of requests by what they mean; the table shows them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum Word {
    Images,
    Scenes,
    SameScene,
    Each,
    PerScene,
    PerImage,
    Without,
    Include,
    Bottom,
    Vehicle,
    ViewFrom,
    Lawnmower,
    Orbit,
    Views,
    DifferentSides,
    Approach,
    Follow,
    Hover,
    Dive,
    ComeBack,
    After,
    StraightLine,
    Waypoints,
    North,
    East,
    South,
    West,
    Northeast,
    Northwest,
    Southeast,
    Southwest,
    Buried,
    HalfBuried,
    PartlyBuried,
    MostlyBuried,
    FullyBuried,
    Floating,
    Moored,
    OnSide,
    Upright,
    Settled,
    Heap,
    Row,
    School,
    Leaning,
    OnTop,
    Near,
    LeftOf,
    RightOf,
    FrontOf,
    BehindOf,
    Scattered,
    Resting,
    Middle,
    Train,
    Validation,
    Test,
    Split,
    ByAsset,
    ByScene,
    ByVariant,
    Speckle,
    Noise,
    NoiseFree,
    Weak,
    Medium,
    Strong,
    Fresh,
    Brackish,
    SaltWater,
    Shallow,
    DeepWater,
    Tropical,
    Arctic,
    LowFrequency,
    HighFrequency,
    NavigationMode,
    InspectionMode,
    Level,
    Multipath,
    Raw,
    Fan,
    Polar,
    Tar,
    CallIt,
    Compare,
    SizeUp,
    SizeDown,
    EmptyScene,
    Anything,
    HalfOf,
}
