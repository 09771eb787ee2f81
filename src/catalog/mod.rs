//! Local catalogs of models: a folder with `catalog.csv` and glTF files, or a cache of Objaverse behind an index.
//!
//! Knows what a model is, how large it really is, what it is made of, whose it is and what people call it; knows nothing
//! of scenes.

pub mod asset;
pub mod build;
pub mod concepts;
pub mod disk;
pub mod error;
pub mod facts;
pub mod find;
pub mod glb;
pub mod home;
pub mod index;
pub mod licence;
pub mod materials;
pub mod model;
pub mod objaverse;
pub mod overrides;
pub mod paths;
pub mod pick;
pub mod priors;
pub mod search;
pub mod simplify;
pub mod solidity;
pub mod sonars;
pub mod text;
pub mod words;

pub use asset::{Asset, Up};
pub use error::{CatalogError, ModelFault};
pub use facts::MeshFacts;
pub use find::find_catalog;
pub use glb::{Reading, load_model, load_model_in, read_model};
pub use index::Catalog;
pub use licence::{Licence, LicencePolicy};
pub use model::{Model, Part};
pub use pick::{OneOrMany, Pick};
