//! The parts that a shard writes: blocks appended in the order in which frames are finished.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::super::atomic::{self, sha256};
use super::super::{FileRecord, FrameRecord, NewFile, Shard, StoreError, layout};
use super::block::build;
use super::{Block, Pack};

/// Appends the blocks of a shard.
#[derive(Debug)]
pub(crate) struct Packer {
    root: PathBuf,
    shard: Shard,
    /// First of the shard's jobs.
    first: u64,
    pack: Pack,
    parts: Mutex<BTreeMap<String, Part>>,
}

/// A part, open for writing.
#[derive(Debug)]
struct Part {
    file: Arc<File>,
    path: PathBuf,
    number: u32,
    length: u64,
}

impl Packer {
    /// Packs the shard's jobs, the first of which is `first`.
    pub fn new(root: &Path, shard: Shard, first: u64, pack: Pack) -> Self {
        Self { root: root.to_path_buf(), shard, first, pack, parts: Mutex::default() }
    }

    /// The tar file that a frame belongs to, and the frames there.
    pub fn tar_of(&self, id: u64) -> (String, std::ops::Range<u64>) {
        let number = id.saturating_sub(self.first) / self.pack.tar_frames;
        let first = self.first + number * self.pack.tar_frames;
        (layout::tar(self.shard, number), first..first + self.pack.tar_frames)
    }

    /// Appends a frame's block and waits until it is on the disk; fills in the files of the record. `newest` is the number
    /// of the newest part of a tar that the journals know.
    pub fn append(
        &self,
        record: &mut FrameRecord,
        files: &[NewFile],
        newest: impl FnOnce(&str) -> Option<u32>,
    ) -> Result<Block, StoreError> {
        let refuse = |reason| StoreError::Record { path: self.root.clone(), id: record.id, reason };
        let bytes = build(record, files).map_err(refuse)?;
        let (tar, _) = self.tar_of(record.id);
        let of = |file: &NewFile| FileRecord {
            path: file.path.clone(),
            bytes: file.bytes.len() as u64,
            sha256: sha256(&file.bytes),
        };
        record.files = files.iter().map(of).collect();
        let sha256 = sha256(&bytes);
        let (part, offset, file, path) = {
            let mut parts = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
            if !parts.contains_key(&tar) {
                parts.insert(tar.clone(), self.open(&tar, newest(&tar))?);
            }
            let part = parts.get_mut(&tar).expect("just opened");
            let (file, path, number, offset) = (part.file.clone(), part.path.clone(), part.number, part.length);
            if let Err(error) = (&*file).write_all(&bytes) {
                // Half a block is room lost, no more; the part is opened again with the length that it has.
                parts.remove(&tar);
                return Err(StoreError::io("write", &path)(error));
            }
            part.length += bytes.len() as u64;
            (number, offset, file, path)
        };
        // Without the lock, so that threads that sync at once share one wait.
        file.sync_data().map_err(StoreError::io("sync", &path))?;
        Ok(Block { tar, part, offset, length: bytes.len() as u64, sha256 })
    }

    /// Goes on with the part that is there, or begins one with a number that no line of a journal names: an old line must
    /// not be taken for one about it.
    fn open(&self, tar: &str, newest: Option<u32>) -> Result<Part, StoreError> {
        let there = parts_of(&self.root, tar)?.pop();
        let begun = newest.map_or(0, |number| number + 1);
        let number = there.filter(|&there| there + 1 >= begun).unwrap_or(begun);
        let path = self.root.join(layout::part(tar, number));
        let folder = path.parent().unwrap_or(&self.root);
        fs::create_dir_all(folder).map_err(StoreError::io("create", folder))?;
        let file = OpenOptions::new().append(true).create(true).open(&path).map_err(StoreError::io("open", &path))?;
        let length = file.metadata().map_err(StoreError::io("read", &path))?.len();
        atomic::sync_folder_of(&path)?;
        Ok(Part { file: Arc::new(file), path, number, length })
    }

    /// Forgets the part of a tar that is assembled.
    pub fn close(&self, tar: &str) {
        self.parts.lock().unwrap_or_else(PoisonError::into_inner).remove(tar);
    }
}

/// Numbers of the parts of a tar that are there, sorted.
pub(super) fn parts_of(root: &Path, tar: &str) -> Result<Vec<u32>, StoreError> {
    let there = names(root)?;
    let mut parts: Vec<u32> = there
        .iter()
        .filter_map(|name| layout::tar_of(name))
        .filter_map(|(of, _, part)| part.filter(|_| of == tar))
        .collect();
    parts.sort_unstable();
    Ok(parts)
}

/// Paths of all that lies among the tar files.
pub(super) fn names(root: &Path) -> Result<Vec<String>, StoreError> {
    let folder = root.join(layout::TARS);
    let entries = match fs::read_dir(&folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        result => result.map_err(StoreError::io("read", &folder))?,
    };
    let mut names = Vec::new();
    for entry in entries {
        let name = entry.map_err(StoreError::io("read", &folder))?.file_name();
        names.push(format!("{}/{}", layout::TARS, name.to_string_lossy()));
    }
    names.sort();
    Ok(names)
}
