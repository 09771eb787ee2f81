//! Where a catalog's models are: in its own folder, or in another that `catalog.yaml` names.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::error::CatalogError;

/// File that names another folder.
const FILE: &str = "catalog.yaml";

/// Where the models of a catalog are, and what kind of collection they are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Home {
    /// The folder that all paths of the index begin at.
    pub root: PathBuf,
    /// What it is.
    pub kind: Kind,
}

/// Kinds of collections.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A folder of models.
    #[default]
    Folder,
    /// A cache of Objaverse 1.0.
    Objaverse,
    /// A folder of Objaverse-XL annotations with what was downloaded.
    ObjaverseXl,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    root: PathBuf,
    #[serde(default)]
    kind: Kind,
}

impl Home {
    /// Of the catalog in a folder.
    ///
    /// # Errors
    /// If its `catalog.yaml` cannot be read.
    pub fn read(dir: &Path) -> Result<Self, CatalogError> {
        let path = dir.join(FILE);
        let Ok(text) = fs::read_to_string(&path) else {
            return Ok(Self { root: dir.to_path_buf(), kind: Kind::Folder });
        };
        let fault = |e: serde_yaml::Error| CatalogError::File {
            path: path.clone(),
            problem: format!("{e}; it says `root: FOLDER` where the models are not beside the index"),
        };
        let Written { root, kind } = serde_yaml::from_str(&text).map_err(fault)?;
        Ok(Self { root: dir.join(root), kind })
    }

    /// Writes `catalog.yaml`, where the models are not in the catalog's own folder.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, dir: &Path) -> Result<(), CatalogError> {
        if self.root == dir {
            return Ok(());
        }
        let path = dir.join(FILE);
        let fault = |problem: String| CatalogError::File { path: path.clone(), problem };
        let written = Written { root: self.root.clone(), kind: self.kind };
        let text = serde_yaml::to_string(&written).map_err(|e| fault(e.to_string()))?;
        let text = format!("# Where the models of this catalog are; its index is beside this file.\n{text}");
        fs::write(&path, text).map_err(|e| fault(e.to_string()))
    }
}
