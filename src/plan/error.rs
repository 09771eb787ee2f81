//! Why a recipe cannot become jobs.

use crate::catalog::CatalogError;
use crate::recipe;

/// A recipe that cannot be run, found before anything is rendered.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// A fault in the recipe itself, located.
    #[error(transparent)]
    Recipe(#[from] recipe::Error),
    /// A catalog or a model file that cannot be used.
    #[error(transparent)]
    Catalog(#[from] CatalogError),
}
