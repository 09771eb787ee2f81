//! `manifest.json`: what a dataset is, from its first moment, and what came of it, once it is finished.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::atomic::sha256;
use super::{Identity, Pack, StoreError, VERSION, layout};
use crate::label::View;

/// Version of the layout of a dataset folder.
pub(crate) const FORMAT_VERSION: u32 = 1;

/// The manifest's fields.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Manifest {
    pub format_version: u32,
    /// Version of the program.
    pub ensonify: String,
    pub name: String,
    /// Hash of `recipe.yaml`; none where the dataset was made from a plan alone.
    #[serde(default)]
    pub recipe_sha256: Option<String>,
    /// Changes that were made to the recipe, `path=value`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sets: Vec<String>,
    /// Files that the recipe includes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub includes: Vec<IncludeLock>,
    pub plan_hash: String,
    /// Frames in the plan.
    pub frames: u64,
    /// How the frames' files are packed; none where they are loose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pack: Option<Pack>,
    /// Hash of the data; `null` until the dataset is finished.
    pub dataset_hash: Option<String>,
    /// `null` until the dataset is finished.
    pub counts: Option<Counts>,
    /// Frames of the plan that a dataset finished in part lacks.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub missing: u64,
}

/// A file that a recipe includes, pinned by its content.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct IncludeLock {
    /// Its name in the including file.
    pub name: String,
    /// SHA-256 of the file.
    pub sha256: String,
}

/// How much there is in a finished dataset.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Frames of each split.
    pub frames: BTreeMap<String, u64>,
    /// Annotations of each view and category.
    pub annotations: BTreeMap<View, BTreeMap<String, u64>>,
    /// What became of the objects that were asked for.
    #[serde(default)]
    pub objects: ObjectCounts,
}

/// Objects of all scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ObjectCounts {
    /// Asked for.
    pub asked: u64,
    /// In their scenes.
    pub placed: u64,
    /// Of those, at given poses where they pass through others.
    pub overlapping: u64,
}

impl Manifest {
    /// The manifest of a dataset that is begun.
    pub fn begun(identity: &Identity<'_>) -> Self {
        Self {
            format_version: FORMAT_VERSION,
            ensonify: VERSION.to_owned(),
            name: identity.name.to_owned(),
            recipe_sha256: identity.recipe_text.map(|text| sha256(text.as_bytes())),
            sets: identity.sets.to_vec(),
            includes: identity.includes.to_vec(),
            plan_hash: identity.plan_hash.to_owned(),
            frames: identity.frames,
            pack: identity.pack,
            dataset_hash: None,
            counts: None,
            missing: 0,
        }
    }

    /// The same without the results of finishing.
    pub fn begun_again(self) -> Self {
        Self { dataset_hash: None, counts: None, missing: 0, ..self }
    }

    /// The manifest in a folder; `None` if it has none.
    pub fn read(root: &Path) -> Result<Option<Self>, StoreError> {
        let path = root.join(layout::MANIFEST);
        let bytes = match fs::read(&path) {
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(None),
            result => result.map_err(StoreError::io("read", &path))?,
        };
        let manifest: Self = serde_json::from_slice(&bytes)
            .map_err(|error| StoreError::Manifest { path: path.clone(), reason: error.to_string() })?;
        if manifest.format_version == FORMAT_VERSION {
            return Ok(Some(manifest));
        }
        let reason = format!("format version {}, but this program knows {FORMAT_VERSION}", manifest.format_version);
        Err(StoreError::Manifest { path, reason })
    }

    /// Refuses a dataset that is not the one to write.
    pub fn check_is(&self, ours: &Self, root: &Path) -> Result<(), StoreError> {
        let path = || root.to_path_buf();
        if self.plan_hash != ours.plan_hash {
            let (there, ours) = (self.plan_hash.clone(), ours.plan_hash.clone());
            return Err(StoreError::OtherPlan { path: path(), there, ours, difference: String::new() });
        }
        if self.ensonify != ours.ensonify {
            let (there, ours) = (self.ensonify.clone(), ours.ensonify.clone());
            return Err(StoreError::OtherVersion { path: path(), there, ours });
        }
        Ok(())
    }

    /// The file's text.
    pub fn text(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("strings and numbers always serialise");
        text.push('\n');
        text
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_zero(number: &u64) -> bool {
    *number == 0
}
