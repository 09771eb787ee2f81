//! Local catalogs of models: a folder with `catalog.csv` and glTF files.
//!
//! Knows what a model is, how large it really is and what it is made of; knows nothing of scenes.

pub mod error;
pub mod facts;
pub mod find;
pub mod glb;
pub mod index;
pub mod materials;
pub mod model;
pub mod pick;
pub mod sonars;

pub use error::{CatalogError, ModelFault};
pub use facts::MeshFacts;
pub use find::find_catalog;
pub use glb::{Reading, load_model, load_model_in, read_model};
pub use index::{Asset, Catalog, Up};
pub use model::{Model, Part};
pub use pick::{OneOrMany, Pick};
