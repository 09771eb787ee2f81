//! Poses from a file.

use serde::{Deserialize, Serialize};

use super::FrameOfRun;
use crate::math::Pose;
use crate::vehicle::track::Track;

/// world_from_vehicle as a file has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Poses {
    /// The file, from the recipe's folder: see [`Track::load`].
    pub file: String,
    /// How frames are taken from it.
    pub take: Take,
}

/// How frames are taken from a file of poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Take {
    /// Evenly in time from the first row to the last, between rows by interpolation.
    Evenly,
    /// One row a frame, from the first on.
    Rows,
}

impl Poses {
    /// Least rows that the file must have for a run of so many frames.
    #[must_use]
    pub fn least_rows(&self, frames: u64) -> u64 {
        match self.take {
            Take::Evenly => 2,
            Take::Rows => frames,
        }
    }

    /// Pose and time of a frame.
    pub(super) fn pose(&self, track: &Track, frame: FrameOfRun) -> (Pose, f64) {
        match self.take {
            Take::Evenly => {
                let time_s = track.begin_s() + frame.share() * (track.end_s() - track.begin_s());
                (track.at(time_s), time_s)
            }
            Take::Rows => track.row(frame.index as usize),
        }
    }
}
