//! What nobody said: distances, angles, sonar, ground and numbers of frames, by rules with their reasons.
//!
//! Closed forms and tables over plain numbers, metres and degrees. Knows neither wishes nor recipes.

pub mod budget;
pub mod device;
pub mod ground;
pub mod room;
pub mod sight;
