//! Noise-free echoes → what can be seen in each view: a mask of dominant bodies, boxes and run-length masks.
//!
//! Labels are made from [`Echoes`](crate::sonar::Echoes) alone. Knows nothing of water, noise, pixels' brightness,
//! files or annotation formats beyond the run-length strings that they share.
//!
//! # What counts as seen
//! - A body is *visible* in a cell when it gave at least [`LabelSettings::min_share`] of the cell's energy. Several bodies
//!   can be visible in one cell (layover), so their masks may overlap.
//! - The *dominant* body of a cell is the visible one with most energy (the lowest number on a tie), unless the background
//!   (the cell's energy less that of all bodies) gave more than it did: then the cell has none.
//! - A body with fewer than [`LabelSettings::min_pixels`] visible pixels in a view is dropped from that view's annotations
//!   and from its mask, where its pixels become 0: mask and annotations always name the same bodies.

pub mod pass;
pub mod rle;
mod slots;

use serde::{Deserialize, Serialize};

pub use pass::{label_fan, label_polar};
pub use rle::{Rle, RleError};

/// A way to look at a ping.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum View {
    /// Beams across, slant range upwards.
    Polar,
    /// True shape, apex at the bottom.
    Fan,
}

impl View {
    /// Name in recipes and in paths.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Polar => "polar",
            Self::Fan => "fan",
        }
    }
}

/// When a body counts as seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LabelSettings {
    /// Fewest visible pixels in a view for a body to be annotated there.
    pub min_pixels: u32,
    /// Smallest part of a cell's energy, 0 to 1, that makes a body visible in the cell.
    pub min_share: f64,
}

/// The labels of one view of one ping.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViewLabels {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Number of the dominant body of each pixel, row by row; 0 where there is none.
    pub mask: Vec<u16>,
    /// One for each body seen, by body number.
    pub annotations: Vec<Annotation>,
}

/// Where one body is visible in a view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Annotation {
    /// Body number, from 1: the value in the mask.
    pub body: u16,
    /// Left, top, width and height of the smallest box around the visible pixels, in whole pixels.
    pub bbox: [u32; 4],
    /// Number of visible pixels.
    pub area: u32,
    /// The visible pixels.
    pub rle: Rle,
}
