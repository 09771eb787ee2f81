//! Local catalogs of models: a folder with `catalog.csv` and GLB files.
//!
//! Knows what a model is, how large it really is and what it is made of; knows nothing of scenes.

pub mod model;
pub mod sonars;

pub use model::{Model, Part};
