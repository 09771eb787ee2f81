//! Search: what people call a thing, in their language and with their typing errors, to the models that are it.
//!
//! [`terms`] says what a model is found by, [`Terms`] holds that for all models (in memory, or on disk for large
//! collections), [`query`] reads what was asked for, [`find`] weighs the models against it.

pub mod memory;
pub mod query;
pub mod score;
pub mod terms;

pub use memory::MemoryTerms;
pub use score::{Found, find};

use super::error::CatalogError;

/// A model that has a term, and how much it speaks of the model (1 to [`terms::MOST`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Posting {
    /// Number of the model.
    pub model: u32,
    /// How much the term says of it.
    pub weight: u8,
}

/// The terms of a catalog's models.
pub trait Terms {
    /// How many models there are.
    fn models(&self) -> u32;

    /// The models with a term, by number; none if no model has it.
    ///
    /// # Errors
    /// If an index on disk cannot be read.
    fn postings(&self, term: &str) -> Result<Vec<Posting>, CatalogError>;

    /// Terms that begin with a letter, for the repair of typing errors.
    fn beginning_with(&self, letter: char) -> Vec<&str>;
}
