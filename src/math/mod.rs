//! Numbers that are the same on every machine: elementary functions, random streams, rigid poses.
//!
//! Knows nothing of sonar, scenes or recipes.

pub mod fast;
mod impossible;
pub mod pose;
pub mod real;
pub mod rng;
pub(crate) mod vectors;

pub use impossible::Impossible;
pub use pose::Pose;
