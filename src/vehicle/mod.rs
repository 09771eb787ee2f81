//! Where the vehicle is in each frame, and when: along a trajectory, shaken by the water, clear of bottom and things.
//!
//! Knows nothing of meshes, sonars or images: of the world it is told the ground, the targets, how far things are and
//! what sees what.

mod clear;
mod motion;
pub mod track;
pub mod trajectory;
mod wander;

pub use motion::{AttitudeNoise, Vehicle};
pub use track::{Track, TrackError};
pub use trajectory::{FrameOfRun, Station, Surroundings, Target, Trajectory, Voyage};
