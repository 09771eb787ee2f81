//! The end of a dataset: hashes over everything, and a manifest that says so.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Write};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::atomic::{self, Writer};
use super::dataset::Dataset;
use super::index::Files;
use super::manifest::Manifest;
use super::{Counts, FileRecord, StoreError, claim, damage, layout, pack};

/// What came of a dataset.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Summary {
    /// SHA-256 over the sorted `sha256sum` lines of all data files: images, masks, raw, annotations, frames.csv; packed
    /// ones under the paths that they would have loose, so that packing changes nothing.
    pub dataset_hash: String,
    /// How many frames there are.
    pub frames: u64,
    /// How many annotations there are in all views.
    pub annotations: u64,
    /// How many files there are, but for the hashes and the journals.
    pub files: u64,
    /// Their length.
    pub bytes: u64,
}

/// The right to finish a dataset, of one process at a time.
#[derive(Debug)]
pub(crate) struct Sealing<'a> {
    dataset: &'a Dataset,
    writer: Writer,
    lock: File,
}

/// A stretch of the sorted list of files.
enum Stretch {
    One(FileRecord),
    /// All frames' files of a folder.
    Folder(String),
}

impl<'a> Sealing<'a> {
    /// Takes the right.
    ///
    /// # Errors
    /// [`StoreError::Locked`] if another process has it.
    pub fn begin(dataset: &'a Dataset) -> Result<Self, StoreError> {
        let lock = claim::lock(dataset.root(), layout::FINISH_LOCK)?;
        Ok(Self { dataset, writer: Writer::new(dataset.root(), "finish"), lock })
    }

    /// Writes a file beside the frames, whole or not at all.
    pub fn write_with(
        &self,
        path: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<FileRecord, StoreError> {
        self.writer.write_with(path, fill)
    }

    /// Puts tar files in order, then writes `SHA256SUMS` and, last, the manifest with the dataset hash. `derived` are the files made from the frames.
    pub fn seal(&self, derived: Vec<FileRecord>, counts: Counts) -> Result<Summary, StoreError> {
        let mut stretches: Vec<Stretch> = self.folders()?.into_iter().map(Stretch::Folder).collect();
        stretches.extend(derived.into_iter().chain(self.given()?).map(Stretch::One));
        let tars = self.tars()?;
        stretches.sort_by(|a, b| a.path().cmp(b.path()));
        let mut hash = Sha256::new();
        self.each(&stretches, &mut |file| {
            if layout::is_data(&file.path) {
                hash.update(line(file));
            }
            Ok(())
        })?;
        let dataset_hash = atomic::hex(&hash.finalize());
        let annotations = counts.annotations.values().flat_map(|labels| labels.values()).sum();
        let missing = self.dataset.planned() - self.dataset.done();
        let begun = self.dataset.manifest.clone().begun_again();
        let text = Manifest { dataset_hash: Some(dataset_hash.clone()), counts: Some(counts), missing, ..begun }.text();
        let bytes = text.len() as u64;
        let manifest = FileRecord { path: layout::MANIFEST.to_owned(), bytes, sha256: atomic::sha256(text.as_bytes()) };
        stretches.push(Stretch::One(manifest));
        if self.dataset.manifest.pack.is_some() {
            // What lies on the disk: tar files in place of what is in them.
            stretches.retain(|stretch| matches!(stretch, Stretch::One(_)));
            stretches.extend(tars.into_iter().map(Stretch::One));
        }
        stretches.sort_by(|a, b| a.path().cmp(b.path()));
        let (mut files, mut bytes) = (0, 0);
        self.write_with(layout::SUMS, |out| {
            self.each(&stretches, &mut |file| {
                (files, bytes) = (files + 1, bytes + file.bytes);
                out.write_all(line(file).as_bytes())
            })
            .map_err(io::Error::other)
        })?;
        self.write_with(layout::MANIFEST, |out| out.write_all(text.as_bytes()))?;
        damage::clear(self.dataset.root())?;
        Ok(Summary { dataset_hash, frames: self.dataset.done(), annotations, files, bytes })
    }

    /// Folders of the frames' files.
    fn folders(&self) -> Result<BTreeSet<String>, StoreError> {
        let mut folders = BTreeSet::new();
        for record in self.dataset.index.records::<Files>() {
            for file in record?.files {
                let folder = folder_of(&file.path);
                if !folders.contains(folder) {
                    folders.insert(folder.to_owned());
                }
            }
        }
        Ok(folders)
    }

    /// Tar files, put in order and hashed.
    fn tars(&self) -> Result<Vec<FileRecord>, StoreError> {
        let (root, dataset) = (self.dataset.root(), self.dataset);
        if dataset.manifest.pack.is_none() {
            return Ok(Vec::new());
        }
        let hashed = |path: String| {
            let full = root.join(&path);
            let (bytes, sha256) = atomic::hash_file(&full).map_err(StoreError::io("read", &full))?;
            Ok(FileRecord { path, bytes, sha256 })
        };
        pack::settle(root, &dataset.index, dataset.planned())?.into_par_iter().map(hashed).collect()
    }

    /// Files that were there before the frames.
    fn given(&self) -> Result<Vec<FileRecord>, StoreError> {
        let mut files = Vec::new();
        for path in [layout::PLAN, layout::RECIPE, layout::FACTS] {
            let full = self.dataset.root().join(path);
            if full.is_file() {
                let (bytes, sha256) = atomic::hash_file(&full).map_err(StoreError::io("read", &full))?;
                files.push(FileRecord { path: path.to_owned(), bytes, sha256 });
            }
        }
        Ok(files)
    }

    /// Calls `each` with every file: by folder, then by frame.
    fn each(
        &self,
        stretches: &[Stretch],
        each: &mut dyn FnMut(&FileRecord) -> io::Result<()>,
    ) -> Result<(), StoreError> {
        let sums = self.dataset.root().join(layout::SUMS);
        for stretch in stretches {
            match stretch {
                Stretch::One(file) => each(file).map_err(StoreError::io("write", &sums))?,
                Stretch::Folder(folder) => {
                    for record in self.dataset.index.records::<Files>() {
                        let mut files = record?.files;
                        files.retain(|file| folder_of(&file.path) == folder);
                        files.sort_by(|a, b| a.path.cmp(&b.path));
                        files.iter().try_for_each(&mut *each).map_err(StoreError::io("write", &sums))?;
                    }
                }
            }
        }
        Ok(())
    }
}

impl Drop for Sealing<'_> {
    fn drop(&mut self) {
        let _ = self.lock.unlock();
    }
}

impl Stretch {
    fn path(&self) -> &str {
        match self {
            Self::One(file) => &file.path,
            Self::Folder(folder) => folder,
        }
    }
}

/// All of a path up to its name, the slash included.
fn folder_of(path: &str) -> &str {
    path.rfind('/').map_or("", |slash| &path[..=slash])
}

/// A line as `sha256sum` writes it.
fn line(file: &FileRecord) -> String {
    format!("{}  {}\n", file.sha256, file.path)
}
