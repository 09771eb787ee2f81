//! A YAML recipe becomes a labelled sonar dataset.
pub mod catalog;
pub mod cli;
pub mod export;
pub mod image;
pub mod label;
pub mod math;
pub mod physics;
pub mod plan;
pub mod realism;
pub mod recipe;
pub mod run;
pub mod scene;
pub mod sonar;
pub mod store;
pub mod vehicle;
pub mod view;
