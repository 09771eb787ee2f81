//! Bottom, water, sonar, splits and looks, as somebody asked for them.

use super::{Amount, Said};

/// The bottom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seabed {
    /// A kind of the recipe's `seabed.shape`: `flat`, `ripples`, `reef` …
    pub shape: Option<Said<String>>,
    /// Sediments of the recipe, each as likely ("sand": fine, medium and coarse).
    pub sediments: Option<Said<Vec<String>>>,
    /// Angle of a slope, degrees.
    pub slope_deg: Option<Said<Amount>>,
    /// Height of ripples, waves or relief, metres.
    pub height_m: Option<Said<Amount>>,
    /// Distance from crest to crest, metres.
    pub wavelength_m: Option<Said<Amount>>,
}

/// The water.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Water {
    /// Depth of the bottom, metres, above 0.
    pub depth_m: Option<Said<Amount>>,
    /// Degrees Celsius.
    pub temperature_c: Option<Said<Amount>>,
    /// Parts per thousand.
    pub salinity_ppt: Option<Said<Amount>>,
    /// Acidity.
    pub ph: Option<Said<Amount>>,
    /// Kinds of the recipe's `water.turbidity`, each as likely: `clear`, `coastal`, `turbid`, `very-turbid`.
    pub turbidity: Option<Said<Vec<String>>>,
}

/// The sonar and how it is held.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sonar {
    /// Device files, each as likely.
    pub devices: Option<Said<Vec<String>>>,
    /// Kilohertz.
    pub frequency_khz: Option<Said<Amount>>,
    /// How many beams.
    pub beams: Option<Said<u32>>,
    /// Width of the fan, degrees.
    pub fov_deg: Option<Said<Amount>>,
    /// Nearest range shown, metres.
    pub least_range_m: Option<Said<Amount>>,
    /// Farthest range shown, metres.
    pub most_range_m: Option<Said<Amount>>,
    /// Tilt, degrees: below the horizon is negative.
    pub pitch_deg: Option<Said<Amount>>,
    /// To port positive, degrees.
    pub yaw_deg: Option<Said<Amount>>,
}

/// What is written besides what is always written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Output {
    /// Kind of the recipe's `output.raw`: `exr`.
    pub raw: Option<Said<String>>,
    /// `polar`, `fan` or both, where not both are wanted.
    pub views: Option<Said<Vec<String>>>,
    /// Kind of the recipe's `output.pack`: `tar`.
    pub pack: Option<Said<String>>,
}

/// Shares of the frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Splits {
    /// Training, validation, test; they add up to 1.
    pub shares: [f64; 3],
    /// `scene`, `asset` or `variant`, where somebody says so.
    pub by: Option<String>,
}

/// One of several pictures of the same echoes.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Its name in file names: `no-noise`.
    pub name: String,
    /// What is different in it.
    pub changes: Vec<LookChange>,
}

/// What a look changes.
#[derive(Clone, Debug, PartialEq)]
pub enum LookChange {
    /// Strength of speckle: 0 none, 1 full.
    Speckle(f64),
    /// Noise of the receiver: 0 none, 1 as usual, more.
    Noise(f64),
    /// A kind of `water.turbidity`.
    Turbidity(String),
    /// Degrees Celsius.
    Temperature(f64),
    /// A kind of `image.model`: `physical`, `deepsonar`, `holoocean`.
    Model(String),
}
