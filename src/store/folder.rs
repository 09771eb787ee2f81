//! The store: opens or begins a dataset folder and takes finished frames from any thread.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};

use super::journal::{self, Journal};
use super::manifest::Manifest;
use super::{AtomicFile, FileRecord, FrameRecord, StoreError, atomic, layout};

/// What makes a dataset the one that it is.
#[derive(Clone, Copy, Debug)]
pub struct Identity<'a> {
    /// Name in the recipe.
    pub name: &'a str,
    /// Hash of every drawn value of every job.
    pub plan_hash: &'a str,
    /// Frames in the plan: ids 0 .. frames.
    pub frames: u64,
    /// The recipe as given.
    pub recipe_text: &'a str,
    /// Every drawn value of every job.
    pub plan_json: &'a [u8],
}

/// A file that a frame brings.
#[derive(Clone, Debug)]
pub struct NewFile {
    /// Relative to the dataset folder, see [`layout`].
    pub path: String,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// A dataset folder that this process, and no other, writes to until the store is dropped.
#[derive(Debug)]
pub struct Store {
    root: PathBuf,
    /// Without the results of finishing.
    pub(super) manifest: Manifest,
    /// `recipe.yaml` and `plan.json`.
    pub(super) given: Vec<FileRecord>,
    progress: Mutex<Progress>,
    /// Closing the file gives the lock back.
    _lock: File,
}

#[derive(Debug)]
struct Progress {
    journal: Journal,
    finished: BTreeMap<u64, FrameRecord>,
}

impl Store {
    /// Begins a dataset in `root`, or goes on with the one that is there. Frames whose files are gone or cut off count as
    /// unfinished.
    ///
    /// # Errors
    /// [`StoreError`] if the folder cannot be written, holds something else, another plan or another version's frames, or
    /// if another process writes to it. The folder is then as it was before, but for an empty `shards/`.
    pub fn open(root: &Path, identity: &Identity<'_>) -> Result<Self, StoreError> {
        refuse_foreign(root)?;
        let ours = Manifest::begun(identity);
        if let Some(there) = Manifest::read(root)? {
            there.check_is(&ours, root)?;
        }
        probe(root)?;
        let lock = lock(root)?;
        // Again, as another process may have begun and ended since.
        let there = Manifest::read(root)?;
        if let Some(there) = &there {
            there.check_is(&ours, root)?;
        }
        if there.is_none_or(|there| Manifest { dataset_hash: None, counts: None, ..there } != ours) {
            atomic::write(root, layout::MANIFEST, ours.text().as_bytes())?;
        }
        let given = [(layout::RECIPE, identity.recipe_text.as_bytes()), (layout::PLAN, identity.plan_json)];
        let given = given.iter().map(|(path, bytes)| keep(root, path, bytes)).collect::<Result<_, _>>()?;
        let contents = journal::read(root)?;
        let journal = Journal::open(root, &contents)?;
        let finished = whole_frames(root, contents.records, identity.frames);
        let progress = Mutex::new(Progress { journal, finished });
        Ok(Self { root: root.to_path_buf(), manifest: ours, given, progress, _lock: lock })
    }

    /// Writes a frame's files and then journals it; `record.files` is filled in here. Threads may call this at once.
    ///
    /// # Errors
    /// [`StoreError`] if a file cannot be written or the record cannot be kept; the frame is then unfinished.
    pub fn commit(&self, mut record: FrameRecord, files: &[NewFile]) -> Result<(), StoreError> {
        let refuse = |reason: String| StoreError::Record { path: self.root.clone(), id: record.id, reason };
        if record.id >= self.manifest.frames {
            return Err(refuse(format!("the plan has {} frames", self.manifest.frames)));
        }
        record.files = files.iter().map(|f| atomic::write(&self.root, &f.path, &f.bytes)).collect::<Result<_, _>>()?;
        let (line, record) = journal::line(&record).map_err(|error| refuse(error.to_string()))?;
        let mut progress = self.progress();
        progress.journal.append(&line)?;
        progress.finished.insert(record.id, record);
        Ok(())
    }

    /// Ids of the frames that are still to be rendered, in order.
    #[must_use]
    pub fn missing(&self) -> Vec<u64> {
        let progress = self.progress();
        (0..self.manifest.frames).filter(|id| !progress.finished.contains_key(id)).collect()
    }

    /// All finished frames by id, as they are now.
    #[must_use]
    pub fn finished(&self) -> BTreeMap<u64, FrameRecord> {
        self.progress().finished.clone()
    }

    /// The dataset folder.
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

    /// Begins a file beside the frames.
    pub(crate) fn create(&self, path: &str) -> Result<AtomicFile, StoreError> {
        AtomicFile::create(&self.root, path)
    }

    /// Writes a file beside the frames.
    pub(crate) fn write(&self, path: &str, bytes: &[u8]) -> Result<FileRecord, StoreError> {
        atomic::write(&self.root, path, bytes)
    }

    fn progress(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().expect("nothing panics while it holds the journal")
    }
}

/// Frames of the plan whose files are all there with their lengths; of several records of a frame the last counts.
pub(super) fn whole_frames(root: &Path, records: Vec<FrameRecord>, frames: u64) -> BTreeMap<u64, FrameRecord> {
    let is_whole = |file: &FileRecord| {
        fs::metadata(root.join(&file.path)).is_ok_and(|data| data.is_file() && data.len() == file.bytes)
    };
    let mut finished: BTreeMap<u64, FrameRecord> =
        records.into_iter().filter(|record| record.id < frames).map(|record| (record.id, record)).collect();
    finished.retain(|_, record| record.files.iter().all(is_whole));
    finished
}

/// Refuses a path that is a file, and a folder with other things in it.
fn refuse_foreign(root: &Path) -> Result<(), StoreError> {
    let entries = match fs::read_dir(root) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) if error.kind() == ErrorKind::NotADirectory && root.is_file() => {
            return Err(StoreError::NotAFolder { path: root.to_path_buf() });
        }
        result => result.map_err(StoreError::io("read", root))?,
    };
    if root.join(layout::MANIFEST).is_file() {
        return Ok(());
    }
    let mut names = Vec::new();
    for entry in entries {
        names.push(entry.map_err(StoreError::io("read", root))?.file_name().to_string_lossy().into_owned());
    }
    // What a run leaves that was killed before it wrote its manifest.
    let own = ["shards".to_owned(), PROBE.to_owned(), format!("{}.{}", layout::MANIFEST, layout::TEMPORARY)];
    names.retain(|name| !own.contains(name));
    names.sort();
    match names.into_iter().next() {
        Some(found) => Err(StoreError::Foreign { path: root.to_path_buf(), found }),
        None => Ok(()),
    }
}

const PROBE: &str = "probe.tmp";

/// Makes the folder and sees whether files can be written there.
fn probe(root: &Path) -> Result<(), StoreError> {
    fs::create_dir_all(root).map_err(StoreError::io("create", root))?;
    let path = root.join(PROBE);
    fs::write(&path, b"may be deleted").map_err(StoreError::io("write", &path))?;
    fs::remove_file(&path).map_err(StoreError::io("delete", &path))
}

/// Takes the folder for this process. The system gives it back however the process ends.
fn lock(root: &Path) -> Result<File, StoreError> {
    let path = root.join(layout::LOCK);
    let folder = path.parent().unwrap_or(root);
    fs::create_dir_all(folder).map_err(StoreError::io("create", folder))?;
    let file = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
    let file = file.map_err(StoreError::io("create", &path))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StoreError::Locked { path: root.to_path_buf() }),
        // Some network file systems know no locks; there the user must see to it.
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(file),
        Err(TryLockError::Error(source)) => Err(StoreError::Io { doing: "lock", path, source }),
    }
}

/// Makes sure that a file has these bytes.
fn keep(root: &Path, path: &str, bytes: &[u8]) -> Result<FileRecord, StoreError> {
    if fs::read(root.join(path)).is_ok_and(|there| there == bytes) {
        let sha256 = atomic::sha256(bytes);
        return Ok(FileRecord { path: path.to_owned(), bytes: bytes.len() as u64, sha256 });
    }
    atomic::write(root, path, bytes)
}
