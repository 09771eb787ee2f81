//! Underwater acoustics as pure functions, each with its source: no I/O, no randomness, no sonar in particular.

pub mod absorption;
pub mod levels;
pub mod water;

pub use water::Water;
