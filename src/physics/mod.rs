//! Underwater acoustics as pure functions, each with its source: no I/O, no randomness, no sonar in particular.
//!
//! An equation whose source states a range returns [`Stated`]: its value with what lay outside of the range.

pub mod absorption;
pub mod deepsonar;
pub mod levels;
mod numeric;
pub mod seawater;
pub mod sound_speed;
mod stated;
pub mod water;

pub use stated::{Outside, Stated};
pub use water::Water;
