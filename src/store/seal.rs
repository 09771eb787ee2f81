//! The end of a dataset: hashes over everything, and a manifest that says so.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use super::atomic::sha256;
use super::manifest::Manifest;
use super::{Counts, FileRecord, FrameRecord, Store, StoreError, layout};

/// What came of a dataset.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Summary {
    /// SHA-256 over the sorted `sha256sum` lines of all data files: images, masks, raw, annotations, frames.csv.
    pub dataset_hash: String,
    /// How many frames there are.
    pub frames: u64,
    /// How many annotations there are in all views.
    pub annotations: u64,
    /// How many files there are, but for the hashes and the journal.
    pub files: u64,
    /// Their length.
    pub bytes: u64,
}

impl Store {
    /// Writes `SHA256SUMS` and, last, the manifest with the dataset hash. `derived` are the files made from the frames.
    pub(crate) fn seal<'a>(
        &'a self,
        frames: impl IntoIterator<Item = &'a FrameRecord>,
        derived: &'a [FileRecord],
        counts: Counts,
    ) -> Result<Summary, StoreError> {
        let mut files: Vec<&FileRecord> = frames.into_iter().flat_map(|frame| &frame.files).collect();
        files.extend(self.given.iter().chain(derived));
        files.sort_by(|a, b| a.path.cmp(&b.path));
        let dataset_hash = sha256(sums(files.iter().copied().filter(|file| layout::is_data(&file.path))).as_bytes());
        let annotations = counts.annotations.values().flat_map(|labels| labels.values()).sum();
        let finished =
            Manifest { dataset_hash: Some(dataset_hash.clone()), counts: Some(counts), ..self.manifest.clone() };
        let text = finished.text();
        let manifest =
            FileRecord { path: layout::MANIFEST.to_owned(), bytes: text.len() as u64, sha256: sha256(text.as_bytes()) };
        let place = files.partition_point(|file| file.path < manifest.path);
        files.insert(place, &manifest);
        self.write_with(layout::SUMS, |out| out.write_all(sums(files.iter().copied()).as_bytes()))?;
        self.write_with(layout::MANIFEST, |out| out.write_all(text.as_bytes()))?;
        let bytes = files.iter().map(|file| file.bytes).sum();
        Ok(Summary { dataset_hash, frames: self.manifest.frames, annotations, files: files.len() as u64, bytes })
    }
}

/// Lines as `sha256sum` writes them.
fn sums<'a>(files: impl Iterator<Item = &'a FileRecord>) -> String {
    files.fold(String::new(), |mut text, file| {
        writeln!(text, "{}  {}", file.sha256, file.path).expect("a string takes all text");
        text
    })
}
