//! Models and other files pinned by their content, so that a plan means the same bytes wherever it is rendered.

use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use crate::catalog::{Asset, Licence, Up};

/// A model file pinned by its content.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AssetLock {
    /// SHA-256 of the model's file.
    pub sha256: String,
    /// What the catalog makes of the file; none for files that are in no catalog.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shown: Option<Shown>,
    /// Name for people.
    pub name: String,
    /// Licence as the catalog states it.
    pub licence: String,
    /// Whom to name.
    pub attribution: String,
    /// Where it came from.
    pub source: String,
}

/// What a catalog makes of a model file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shown {
    /// Longest side, metres; none where the file and its label decide.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_m: Option<f64>,
    /// Axis of the file that points up.
    pub up: Up,
    /// Material where the file names none.
    pub material: String,
}

impl AssetLock {
    /// Pins a model of a catalog.
    pub(super) fn of_model(asset: &Asset) -> io::Result<Self> {
        Ok(Self {
            sha256: sha256_of(&asset.path)?,
            shown: Some(Shown { size_m: asset.size_m, up: asset.up, material: asset.material.clone() }),
            name: asset.name.clone(),
            licence: Licence::read(&asset.licence).id,
            attribution: asset.attribution.clone(),
            source: asset.source.clone(),
        })
    }

    /// Pins a file that is no model of a catalog; `name` is its path from `folder`.
    pub(super) fn of_file(folder: &Path, name: &str) -> io::Result<Self> {
        let unknown = || "not stated".to_owned();
        Ok(Self {
            sha256: sha256_of(&folder.join(name))?,
            shown: None,
            name: name.to_owned(),
            licence: unknown(),
            attribution: unknown(),
            source: name.to_owned(),
        })
    }
}

fn sha256_of(path: &Path) -> io::Result<String> {
    let bytes = std::fs::read(path)?;
    Ok(Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect())
}
