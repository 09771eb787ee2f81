//! How far a dataset is, read without disturbing the process that writes it.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::folder::whole_frames;
use super::manifest::Manifest;
use super::{StoreError, journal};
use crate::label::View;

/// How far a dataset is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Status {
    /// Name of the dataset.
    pub name: String,
    /// Version of the program that writes it.
    pub ensonify: String,
    /// Hash of the plan.
    pub plan_hash: String,
    /// Frames that are whole.
    pub frames_done: u64,
    /// Frames in the plan.
    pub frames_total: u64,
    /// Whether all frames are there and annotations, tables and hashes are written.
    pub finished: bool,
    /// Hash of the data, once finished.
    pub dataset_hash: Option<String>,
    /// Annotations so far of each view and category.
    pub annotations: BTreeMap<View, BTreeMap<String, u64>>,
    /// Length of the finished frames' files.
    pub bytes: u64,
}

impl Status {
    /// Looks at the dataset in `root`; writes nothing.
    ///
    /// # Errors
    /// [`StoreError`] if `root` is no dataset or cannot be read.
    pub fn read(root: &Path) -> Result<Self, StoreError> {
        let manifest = Manifest::read(root)?.ok_or_else(|| StoreError::NoDataset { path: root.to_path_buf() })?;
        let frames = whole_frames(root, journal::read(root)?.records, manifest.frames);
        let mut annotations: BTreeMap<View, BTreeMap<String, u64>> = BTreeMap::new();
        for (&view, record) in frames.values().flat_map(|frame| &frame.views) {
            let labels = annotations.entry(view).or_default();
            for annotation in &record.annotations {
                *labels.entry(annotation.label.clone()).or_default() += 1;
            }
        }
        let (frames_done, frames_total) = (frames.len() as u64, manifest.frames);
        let dataset_hash = manifest.dataset_hash.filter(|_| frames_done == frames_total);
        Ok(Self {
            name: manifest.name,
            ensonify: manifest.ensonify,
            plan_hash: manifest.plan_hash,
            frames_done,
            frames_total,
            finished: dataset_hash.is_some(),
            dataset_hash,
            annotations,
            bytes: frames.values().flat_map(|frame| &frame.files).map(|file| file.bytes).sum(),
        })
    }
}
