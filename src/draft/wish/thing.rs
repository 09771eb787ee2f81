//! An object as somebody asked for it.

use std::ops::Range;

use super::{Amount, Count, Said};
use crate::draft::Models;

/// An object to place.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// As it was called, with the adjectives that belong to it: "rusty anchor". Its words.
    pub called: Said<String>,
    /// What it is annotated as: the thing's name in English, singular, as `catalogs/synonyms.yaml` has it.
    pub label: String,
    /// Models that are it.
    pub models: Models,
    /// How many in a scene; none where nobody said so ("barrels").
    pub count: Option<Said<Count>>,
    /// Size of its longest side, metres, where somebody says so. Models have their own; a contradiction is told.
    pub size_m: Option<Said<Amount>>,
    /// How and where it stands; what is said twice stands in the order of the prompt.
    pub stands: Vec<Said<Stand>>,
}

/// One thing that is said of how or where an object is.
#[derive(Clone, Debug, PartialEq)]
pub enum Stand {
    /// Lying on the bottom, or simply there.
    Resting,
    /// Standing as it is built.
    Upright,
    /// Lying on its side, overturned.
    OnSide,
    /// Dumped, thrown, fallen: as it came to rest.
    Settled,
    /// Sunk in: share of its height, 0 to 1 ("half buried": 0.5).
    Buried(Amount),
    /// In the water, at so many metres over the bottom where that is said ("swimming 2 m above the bottom").
    Floating(Option<Amount>),
    /// In the water on a line, at so many metres over the bottom where that is said.
    Moored(Option<Amount>),
    /// In the water, so many metres under the surface.
    BelowSurface(Amount),
    /// All instances together in a school.
    School,
    /// All instances in a heap or cluster.
    Heap,
    /// In a row, with so many metres between them where that is said.
    Row(Option<Amount>),
    /// So many metres apart.
    Apart(Amount),
    /// Leaning against what has this label; the environment or anything where nothing is said.
    Leaning(Option<String>),
    /// On top of what has this label.
    On(String),
    /// Beside what has this label: on which side, how far off, metres.
    Near {
        /// Label.
        of: String,
        /// On which side, as seen looking north (+y), where that is said.
        side: Option<Side>,
        /// Free water between the two, metres.
        distance_m: Option<Amount>,
    },
    /// From the vehicle where it begins: on which side of it, how far off, metres.
    FromVehicle {
        /// On which side.
        side: Side,
        /// From the sonar, metres.
        distance_m: Option<Amount>,
    },
    /// At a place of the world, metres: x east, y north and, where it is said, z up from the bottom.
    At([f64; 2], Option<f64>),
    /// Somewhere in a rectangle of the world: two corners, metres.
    Within([f64; 2], [f64; 2]),
    /// Scattered: somewhere within so many metres of the middle.
    Around(Amount),
}

/// A side of something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Ahead; of an object: north.
    Front,
    /// Astern; of an object: south.
    Behind,
    /// To port; of an object: west.
    Left,
    /// To starboard; of an object: east.
    Right,
}

impl Side {
    /// The other side.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Front => Self::Behind,
            Self::Behind => Self::Front,
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// A thing that no catalog has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// As it was called.
    pub called: String,
    /// Bytes of the prompt.
    pub words: Option<Range<usize>>,
    /// Labels that are there and may do instead, the nearest first.
    pub near: Vec<String>,
}
