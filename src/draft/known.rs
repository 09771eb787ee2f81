//! What a drafter may choose from: the models of catalogs, and the sonars.

use std::path::{Path, PathBuf};

use crate::catalog::find::{catalogs_near, find_catalog};
use crate::catalog::{Catalog, CatalogError};

/// Everything that a recipe can name.
#[derive(Debug)]
pub struct Known {
    /// The folder that the recipe is for.
    pub folder: PathBuf,
    /// Catalogs with the names that recipes in that folder give them; the first is looked into first.
    pub catalogs: Vec<(String, Catalog)>,
}

/// Models of one catalog that are what somebody called by a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Models {
    /// The catalog.
    pub catalog: String,
    /// At least one, in the order of the catalog.
    pub uids: Vec<String>,
    /// Label of all of them, where they have one in common.
    pub label: Option<String>,
    /// Whether these are all models with that label.
    pub is_whole_label: bool,
    /// Longest sides of the smallest and of the largest, metres.
    pub size_m: [f64; 2],
    /// Material of the first one's main surface; empty where nobody knows it.
    pub material: String,
}

impl Known {
    /// Opens the catalogs of these names or folders, or all near a folder where none is named.
    ///
    /// # Errors
    /// The first that is not there or cannot be read.
    pub fn open(folder: &Path, names: &[String]) -> Result<Self, CatalogError> {
        let mut near: Vec<(String, PathBuf)> = names
            .iter()
            .map(|name| Ok((name.clone(), find_catalog(name, folder)?)))
            .collect::<Result<_, CatalogError>>()?;
        if names.is_empty() {
            near = catalogs_near(folder);
        }
        let open = |(name, dir): (String, PathBuf)| Ok((name, Catalog::open(&dir)?));
        let catalogs = near.into_iter().map(open).collect::<Result<_, CatalogError>>()?;
        Ok(Self { folder: folder.to_owned(), catalogs })
    }
}
