//! The store: opens or begins a dataset folder and takes finished frames from any thread.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};

use super::atomic::sha256;
use super::journal::{self, Journal};
use super::manifest::{IncludeLock, Manifest};
use super::{FileRecord, FrameRecord, StoreError, atomic, claim, layout};

/// What makes a dataset the one that it is.
#[derive(Clone, Copy, Debug)]
pub struct Identity<'a> {
    /// Name in the recipe.
    pub name: &'a str,
    /// Hash of every drawn value of every job.
    pub plan_hash: &'a str,
    /// Frames in the plan: ids 0 .. frames.
    pub frames: u64,
    /// The recipe as given; none where a plan was given instead.
    pub recipe_text: Option<&'a str>,
    /// Changes that were made to it, `path=value`.
    pub sets: &'a [String],
    /// Files that it includes.
    pub includes: &'a [IncludeLock],
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
    lock: File,
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
        claim::refuse_foreign(root)?;
        let mut ours = Manifest::begun(identity);
        if let Some(there) = Manifest::read(root)? {
            there.check_is(&ours, root)?;
        }
        claim::probe(root)?;
        let lock = claim::lock(root)?;
        // Again, as another process may have begun and ended since.
        let there = Manifest::read(root)?;
        if let Some(there) = &there {
            there.check_is(&ours, root)?;
        }
        let mut recipe = identity.recipe_text.map(|text| text.as_bytes().to_vec());
        if let (None, Some(there)) = (&recipe, &there) {
            // Begun from a recipe that gave this very plan: it stays what the dataset is made from.
            recipe = fs::read(root.join(layout::RECIPE)).ok().filter(|text| there.recipe_sha256 == Some(sha256(text)));
            if recipe.is_some() {
                (ours.recipe_sha256, ours.includes) = (there.recipe_sha256.clone(), there.includes.clone());
            }
        }
        if there.is_none_or(|there| Manifest { dataset_hash: None, counts: None, ..there } != ours) {
            atomic::write(root, layout::MANIFEST, ours.text().as_bytes())?;
        }
        let recipe = recipe.as_deref().map(|text| (layout::RECIPE, text));
        let given = recipe.into_iter().chain([(layout::PLAN, identity.plan_json)]);
        let given = given.map(|(path, bytes)| keep(root, path, bytes)).collect::<Result<_, _>>()?;
        let contents = journal::read(root)?;
        let journal = Journal::open(root, &contents)?;
        let finished = whole_frames(root, contents.records, identity.frames);
        let progress = Mutex::new(Progress { journal, finished });
        Ok(Self { root: root.to_path_buf(), manifest: ours, given, progress, lock })
    }

    /// Writes a frame's files and then journals it; `record.files` is filled in here. Threads may call this at once,
    /// each for frames of its own.
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

    /// Writes a file beside the frames, whole or not at all.
    pub(crate) fn write_with(
        &self,
        path: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<FileRecord, StoreError> {
        atomic::write_with(&self.root, path, fill)
    }

    fn progress(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().expect("nothing panics while it holds the journal")
    }
}

impl Drop for Store {
    fn drop(&mut self) {
        // Closing the file would do, but for a child process that is just being started and still holds a copy of it.
        let _ = self.lock.unlock();
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

/// Makes sure that a file has these bytes.
fn keep(root: &Path, path: &str, bytes: &[u8]) -> Result<FileRecord, StoreError> {
    if fs::read(root.join(path)).is_ok_and(|there| there == bytes) {
        let sha256 = atomic::sha256(bytes);
        return Ok(FileRecord { path: path.to_owned(), bytes: bytes.len() as u64, sha256 });
    }
    atomic::write(root, path, bytes)
}

#[cfg(test)]
mod tests {
    use super::super::Status;
    use super::super::sample::{FRAMES, IDENTITY, frame};
    use super::*;

    fn commit(store: &Store, id: u64) {
        let (record, files) = frame(id);
        store.commit(record, &files).unwrap();
    }

    fn refusal(root: &Path, identity: &Identity<'_>) -> StoreError {
        Store::open(root, identity).expect_err("the folder is refused")
    }

    /// Every file under a folder with its contents.
    fn everything(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut files = BTreeMap::new();
        for entry in fs::read_dir(root).unwrap().map(Result::unwrap) {
            if entry.file_type().unwrap().is_dir() {
                files.extend(everything(&entry.path()));
            } else {
                files.insert(entry.path(), fs::read(entry.path()).unwrap());
            }
        }
        files
    }

    #[test]
    fn frames_from_several_threads_are_there_when_the_folder_is_opened_again() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("new/sample");
        let store = Store::open(&root, &IDENTITY).unwrap();
        assert_eq!(store.missing(), [0, 1, 2, 3, 4, 5]);
        std::thread::scope(|threads| {
            for id in [4, 1, 3] {
                let store = &store;
                threads.spawn(move || commit(store, id));
            }
        });
        assert_eq!(store.missing(), [0, 2, 5]);
        let before = store.finished();
        assert_eq!(Status::read(&root).unwrap().frames_done, 3, "status reads while the store is open");
        drop(store);
        let store = Store::open(&root, &IDENTITY).unwrap();
        assert_eq!(store.finished(), before);
        let status = Status::read(&root).unwrap();
        assert_eq!((status.frames_total, status.finished), (FRAMES, false));
        let labels = BTreeMap::from([("tire".to_owned(), 3), ("anchor".to_owned(), 1)]);
        assert_eq!(status.annotations[&crate::label::View::Fan], labels);
        assert_eq!(fs::read_to_string(root.join(layout::RECIPE)).ok().as_deref(), IDENTITY.recipe_text);
        assert_eq!(fs::read(root.join(layout::PLAN)).unwrap(), IDENTITY.plan_json);
    }

    #[test]
    fn damaged_lines_are_dropped_and_their_frames_are_missing() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        (0..4).for_each(|id| commit(&store, id));
        drop(store);
        let path = folder.path().join(layout::JOURNAL);
        let text = fs::read_to_string(&path).unwrap();
        let lines: Vec<&str> = text.split_inclusive('\n').collect();
        let damaged = lines[1].replace("\"scene\":0", "\"scene\":9");
        assert_ne!(damaged, lines[1]);
        let torn = &lines[3][..lines[3].len() / 2];
        fs::write(&path, [lines[0], &damaged, "\u{0}\u{0}\n", lines[2], torn].concat()).unwrap();
        assert_eq!(Status::read(folder.path()).unwrap().frames_done, 2);
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        assert_eq!(store.missing(), [1, 3, 4, 5]);
        assert_eq!(fs::read_to_string(&path).unwrap(), [lines[0], lines[2]].concat());
        commit(&store, 3);
        drop(store);
        assert_eq!(Store::open(folder.path(), &IDENTITY).unwrap().missing(), [1, 4, 5], "lines follow the good part");
    }

    #[test]
    fn a_kill_between_files_and_journal_costs_only_that_frame() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        commit(&store, 0);
        drop(store);
        let (_, files) = frame(1);
        atomic::write(folder.path(), &files[0].path, &files[0].bytes).unwrap();
        fs::write(folder.path().join(format!("{}.tmp", files[1].path)), b"half").unwrap();
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        assert_eq!(store.missing(), [1, 2, 3, 4, 5]);
        commit(&store, 1);
        assert_eq!(store.missing(), [2, 3, 4, 5]);
        assert!(everything(folder.path()).keys().all(|path| path.extension().is_none_or(|e| e != "tmp")));
    }

    #[test]
    fn a_frame_with_a_lost_or_cut_file_is_missing() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        (0..3).for_each(|id| commit(&store, id));
        drop(store);
        fs::remove_file(folder.path().join("masks/fan/000000.png")).unwrap();
        fs::write(folder.path().join("images/polar/000002.png"), b"short").unwrap();
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        assert_eq!(store.missing(), [0, 2, 3, 4, 5]);
        (0..3).for_each(|id| commit(&store, id));
        drop(store);
        assert_eq!(Store::open(folder.path(), &IDENTITY).unwrap().missing(), [3, 4, 5]);
    }

    #[test]
    fn a_second_writer_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        assert!(matches!(refusal(folder.path(), &IDENTITY), StoreError::Locked { .. }));
        drop(store);
        Store::open(folder.path(), &IDENTITY).unwrap();
    }

    #[test]
    fn another_plan_or_version_is_refused_and_nothing_is_touched() {
        let folder = tempfile::tempdir().unwrap();
        commit(&Store::open(folder.path(), &IDENTITY).unwrap(), 0);
        let before = everything(folder.path());
        let message = refusal(folder.path(), &Identity { plan_hash: "ffff", ..IDENTITY }).to_string();
        assert!(message.contains("0123abcd") && message.contains("ffff") && message.contains("-o"), "{message}");
        assert_eq!(everything(folder.path()), before);
        let manifest = folder.path().join(layout::MANIFEST);
        let text = fs::read_to_string(&manifest).unwrap();
        let version = format!("\"ensonify\": \"{}\"", super::super::VERSION);
        fs::write(&manifest, text.replace(&version, "\"ensonify\": \"0.0.9\"")).unwrap();
        assert!(matches!(refusal(folder.path(), &IDENTITY), StoreError::OtherVersion { .. }));
        fs::write(&manifest, "{}").unwrap();
        assert!(matches!(refusal(folder.path(), &IDENTITY), StoreError::Manifest { .. }));
    }

    #[test]
    fn a_recipe_with_other_comments_takes_the_place_of_the_old() {
        let folder = tempfile::tempdir().unwrap();
        commit(&Store::open(folder.path(), &IDENTITY).unwrap(), 0);
        let identity = Identity { recipe_text: Some("# better\nname: sample\n"), ..IDENTITY };
        assert_eq!(Store::open(folder.path(), &identity).unwrap().missing(), [1, 2, 3, 4, 5]);
        assert_eq!(fs::read_to_string(folder.path().join(layout::RECIPE)).ok().as_deref(), identity.recipe_text);
    }

    #[test]
    fn a_plan_alone_leaves_the_recipe_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let alone = Identity { recipe_text: None, ..IDENTITY };
        commit(&Store::open(folder.path(), &alone).unwrap(), 0);
        assert!(!folder.path().join(layout::RECIPE).exists());
        for identity in [&IDENTITY, &alone] {
            let store = Store::open(folder.path(), identity).unwrap();
            assert_eq!(store.given.len(), 2, "recipe and plan");
            assert_eq!(store.manifest.recipe_sha256, Manifest::begun(&IDENTITY).recipe_sha256);
        }
    }

    #[test]
    fn folders_that_are_none_of_ours_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("thesis.pdf");
        fs::write(&file, "x").unwrap();
        let foreign = refusal(folder.path(), &IDENTITY);
        assert!(matches!(&foreign, StoreError::Foreign { found, .. } if found == "thesis.pdf"), "{foreign}");
        assert_eq!(everything(folder.path()).len(), 1);
        assert!(matches!(refusal(&file, &IDENTITY), StoreError::NotAFolder { .. }));
        let below = refusal(&file.join("out"), &IDENTITY).to_string();
        assert!(below.contains("thesis.pdf") && below.contains("-o"), "{below}");
        assert!(matches!(Status::read(folder.path()), Err(StoreError::NoDataset { .. })));
    }

    #[test]
    fn a_run_killed_before_its_manifest_does_not_make_the_folder_foreign() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("shards")).unwrap();
        fs::write(folder.path().join(layout::LOCK), "").unwrap();
        fs::write(folder.path().join("manifest.json.tmp"), "{").unwrap();
        assert_eq!(Store::open(folder.path(), &IDENTITY).unwrap().missing().len() as u64, FRAMES);
    }

    #[test]
    fn a_frame_outside_the_plan_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), &IDENTITY).unwrap();
        let (record, files) = frame(FRAMES);
        assert!(matches!(store.commit(record, &files), Err(StoreError::Record { id: FRAMES, .. })));
        assert!(!folder.path().join("images").exists());
    }
}
