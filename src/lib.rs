//! A YAML recipe becomes a labelled sonar dataset.
pub mod catalog;
pub mod math;
pub mod scene;
pub mod sonar;
pub mod vehicle;
