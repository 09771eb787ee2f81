//! A dataset folder as it lies there, whoever writes it: which frames it has, and their records.

use std::fs;
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};

use super::index::{Index, Records};
use super::manifest::Manifest;
use super::{FrameRecord, StoreError, layout, pack};

/// A dataset folder to read from.
#[derive(Clone, Debug)]
pub struct Dataset {
    root: PathBuf,
    /// As it lies there, results of an earlier finishing included.
    pub(super) manifest: Manifest,
    pub(super) index: Index,
}

/// Where the bytes of a file are: in a file of their own, or in a tar file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file on the disk.
    pub path: PathBuf,
    /// Where in it and how many bytes; none: all of it.
    pub stretch: Option<(u64, u64)>,
}

impl Place {
    /// A file that is all its own.
    #[must_use]
    pub fn whole(path: PathBuf) -> Self {
        Self { path, stretch: None }
    }

    /// Reads the bytes.
    ///
    /// # Errors
    /// The system's, or an unexpected end where a tar file was cut off.
    pub fn read(&self) -> io::Result<Vec<u8>> {
        let Some((offset, length)) = self.stretch else { return fs::read(&self.path) };
        let mut file = fs::File::open(&self.path)?;
        file.seek(SeekFrom::Start(offset))?;
        let mut bytes = Vec::new();
        file.take(length).read_to_end(&mut bytes)?;
        if bytes.len() as u64 == length { Ok(bytes) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
    }
}

impl Dataset {
    /// Looks at the dataset in `root`; writes nothing.
    ///
    /// # Errors
    /// [`StoreError`] if `root` is no dataset or cannot be read.
    pub fn open(root: &Path) -> Result<Self, StoreError> {
        let manifest = Manifest::read(root)?.ok_or_else(|| StoreError::NoDataset { path: root.to_path_buf() })?;
        let index = Index::read(root, manifest.frames, None)?;
        Ok(Self { root: root.to_path_buf(), manifest, index })
    }

    /// A dataset whose frames are known.
    pub(super) fn of(root: &Path, manifest: &Manifest, index: &Index) -> Self {
        Self { root: root.to_path_buf(), manifest: manifest.clone(), index: index.clone() }
    }

    /// The folder.
    #[must_use]
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Name of the dataset.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.manifest.name
    }

    /// Hash of the plan.
    #[must_use]
    pub fn plan_hash(&self) -> &str {
        &self.manifest.plan_hash
    }

    /// Frames in the plan.
    #[must_use]
    pub fn planned(&self) -> u64 {
        self.manifest.frames
    }

    /// Frames that are there.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.index.len()
    }

    /// Hash of the data, once finished.
    #[must_use]
    pub fn dataset_hash(&self) -> Option<&str> {
        self.manifest.dataset_hash.as_deref()
    }

    /// Ids of the frames that are not there, in order.
    #[must_use]
    pub fn missing(&self) -> Vec<u64> {
        (0..self.manifest.frames).filter(|&id| !self.index.has(id)).collect()
    }

    /// Frames that could not be rendered, with the reason.
    pub fn failed(&self) -> impl Iterator<Item = (u64, &str)> {
        self.index.failed().iter().map(|(&id, reason)| (id, reason.as_str()))
    }

    /// Records of the frames that are there, in the order of their ids, read one by one.
    #[must_use]
    pub fn records(&self) -> Records<'_, FrameRecord> {
        self.index.records()
    }

    /// Where a frame's file is, by its path in the record.
    #[must_use]
    pub fn place(&self, record: &FrameRecord, path: &str) -> Place {
        let packed = self.index.packed(record.id).and_then(|(tar, spot)| {
            let (file, offset) = pack::members(&record.files).find(|(file, _)| file.path == path)?;
            Some(Place { path: self.root.join(spot.path(tar)), stretch: Some((spot.offset + offset, file.bytes)) })
        });
        packed.unwrap_or_else(|| Place::whole(self.root.join(path)))
    }

    /// What a run left for finishing.
    ///
    /// # Errors
    /// [`StoreError`] if it is not there or cannot be read.
    pub fn facts(&self) -> Result<Vec<u8>, StoreError> {
        let path = self.root.join(layout::FACTS);
        fs::read(&path).map_err(StoreError::io("read", &path))
    }
}
