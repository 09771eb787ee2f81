//! Local catalogs of models: a folder with `catalog.csv` and GLB files.
//!
//! Knows what a model is, how large it really is and what it is made of; knows nothing of scenes.

pub mod error;
pub mod glb;
pub mod model;

pub use error::{CatalogError, ModelFault};
pub use glb::load_model;
pub use model::{Model, Part};
