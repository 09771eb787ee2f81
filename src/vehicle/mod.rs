//! Where the vehicle is in each frame.
//!
//! Knows nothing of meshes, sonars or images: of the world it is told the ground, the targets and what sees what.

pub mod trajectory;

pub use trajectory::{FrameOfRun, Surroundings, Target, Trajectory, TrajectoryError};
