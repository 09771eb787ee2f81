//! Underwater acoustics as pure functions, each with its source: no I/O, no randomness, no sonar in particular.
//!
//! An equation whose source states a range returns [`Stated`]: its value with what lay outside of the range. Arguments that
//! cannot be are refused with [`Impossible`](crate::math::Impossible); where geometry has no answer there is `None`.

pub mod absorption;
pub mod array;
pub mod bins;
pub mod deepsonar;
pub mod geometry;
pub mod janus;
pub mod lambert;
pub mod levels;
pub mod motion;
pub mod noise;
mod numeric;
pub mod reflection;
pub mod report;
mod report_text;
pub mod response;
pub mod rigid_sphere;
pub mod seawater;
pub mod sediment_load;
pub mod shading;
pub mod sonar_equation;
pub mod sound_speed;
mod stated;
pub mod statistics;
pub mod target;
pub mod turbid_water;
pub mod turbidity;
pub mod water;

pub use report::WaterReport;
pub use stated::{Outside, Stated};
pub use turbid_water::{Load, TurbidWater};
pub use turbidity::Turbidity;
pub use water::{SpeedEquation, Water};
