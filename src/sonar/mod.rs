//! Scene × device × pose → echoes: energy per (bearing, slant range) cell, with the bodies that gave it.
//!
//! Knows nothing of water, noise, displays or labels: absorption, speckle and TVG come later and never touch this energy.

pub mod beams;
mod cells;
mod deposit;
pub mod device;
pub mod echoes;
pub mod fan;
mod ghosts;
pub mod grid;
pub mod surface;
pub mod trace;
pub mod visibility;

pub use device::{Bearing, Mount, Sonar};
pub use echoes::{BodyEcho, Echoes, RayRange, Rays};
pub use fan::FanMap;
pub use grid::Grid;
pub use trace::{Keep, Tracer, trace};
