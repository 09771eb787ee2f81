//! Whether a dataset's files are still what its hashes say.
//!
//! Frames are held against the journals, whose lines carry checksums of their own, packed ones member by member; everything
//! else against `SHA256SUMS`, which is held against both.

mod packed;

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::Serialize;

use super::atomic::{self, Writer};
use super::index::{self, Files};
use super::line::{self, Outcome};
use super::manifest::Manifest;
use super::{FileRecord, StoreError, damage, journal, layout};
use packed::Packed;

/// What a verification found. Paths are relative to the dataset folder; a member of a tar file is `TAR/MEMBER`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Verification {
    /// Files that were read.
    pub checked: u64,
    /// Files with other bytes than they should have.
    pub changed: Vec<String>,
    /// Files that should be there and are not.
    pub missing: Vec<String>,
    /// Files that nothing tells of.
    pub extra: Vec<String>,
    /// Frames that `run` will render again.
    pub frames: Vec<u64>,
}

/// What a file should be.
struct Expected {
    sha256: String,
    /// Its frame and its record there.
    frame: Option<(u64, FileRecord)>,
}

/// Hashes every file of the dataset in `root`. Damaged frames are listed for the next run, which renders them again;
/// nothing else is written. On a disk that cannot be written the list is not made.
///
/// # Errors
/// [`StoreError`] if `root` is no dataset or cannot be read.
pub fn verify(root: &Path) -> Result<Verification, StoreError> {
    let mut found = Verification::default();
    let manifest = manifest(root, &mut found)?;
    let is_finished = manifest.as_ref().is_none_or(|manifest| manifest.dataset_hash.is_some());
    let frames = manifest.as_ref().map_or(u64::MAX, |manifest| manifest.frames);
    let (mut expected, packed) = journalled(root, frames, is_finished, &mut found)?;
    if is_finished {
        add_sums(root, &mut expected, &mut found)?;
    }
    let outcomes: Vec<(&String, Found)> =
        expected.par_iter().map(|(path, file)| (path, look(root, path, file))).collect();
    let mut damaged = Vec::new();
    found.checked = expected.len() as u64;
    let right_tars = packed.look(&mut found, &mut damaged)?;
    for (path, outcome) in outcomes {
        let list = match outcome {
            Found::Same => None,
            // The frames in it are right, and nothing else is in it: then its hash is what changed.
            Found::Changed if right_tars.contains(path) => {
                found.changed.push(layout::SUMS.to_owned());
                None
            }
            Found::Changed => Some(&mut found.changed),
            Found::Missing => Some(&mut found.missing),
        };
        if let Some(list) = list {
            list.push(path.clone());
            damaged.extend(expected[path].frame.clone());
        }
    }
    found.frames.extend(damaged.iter().map(|(id, _)| *id));
    let tars = packed.tars();
    walk(root, root, &mut |path| {
        let is_known = expected.contains_key(path) || KNOWN.contains(&path) || path.starts_with("shards/");
        let is_tar = layout::tar_of(path).is_some_and(|(tar, ..)| tars.contains(tar));
        if !is_known && !is_tar {
            found.extra.push(path.to_owned());
        }
    })?;
    found.put_in_order();
    // A disk that cannot be written is no difference.
    let _ = damage::write(&Writer::new(root, "verify"), &damaged);
    Ok(found)
}

impl Verification {
    /// Every list sorted, each entry once.
    fn put_in_order(&mut self) {
        for list in [&mut self.changed, &mut self.missing, &mut self.extra] {
            list.sort();
            list.dedup();
        }
        self.frames.sort_unstable();
        self.frames.dedup();
    }
}

/// The manifest; `None`, and told, where it is lost or damaged in what is a dataset all the same.
fn manifest(root: &Path, found: &mut Verification) -> Result<Option<Manifest>, StoreError> {
    match Manifest::read(root) {
        Ok(Some(manifest)) => Ok(Some(manifest)),
        Ok(None) if root.join(layout::SUMS).is_file() || root.join(layout::SHARDS).is_dir() => {
            found.missing.push(layout::MANIFEST.to_owned());
            Ok(None)
        }
        Ok(None) => Err(StoreError::NoDataset { path: root.to_path_buf() }),
        Err(StoreError::Manifest { .. }) => {
            found.changed.push(layout::MANIFEST.to_owned());
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// Files that `SHA256SUMS` does not tell of, or only once the dataset is finished.
const KNOWN: [&str; 4] = [layout::SUMS, layout::MANIFEST, layout::PLAN, layout::RECIPE];

/// How a file was found.
enum Found {
    Same,
    Changed,
    Missing,
}

fn look(root: &Path, path: &str, expected: &Expected) -> Found {
    match atomic::hash_file(&root.join(path)) {
        Ok((_, sha256)) if sha256 == expected.sha256 => Found::Same,
        Err(error) if error.kind() == ErrorKind::NotFound => Found::Missing,
        _ => Found::Changed,
    }
}

/// Files of the frames, loose and packed, as the journals tell of them; of several records of a frame the last counts.
fn journalled(
    root: &Path,
    frames: u64,
    is_finished: bool,
    found: &mut Verification,
) -> Result<(BTreeMap<String, Expected>, Packed), StoreError> {
    let mut packed = Packed::new(root);
    let mut last: BTreeMap<u64, Vec<FileRecord>> = BTreeMap::new();
    for path in index::journals(root, None)? {
        let mut is_damaged = false;
        journal::each_line(&path, |text, _| match line::parse(text) {
            Some((head, Outcome::Done(frame))) if head.id < frames => {
                let Ok(frame) = serde_json::from_str::<Files>(frame) else { return };
                match head.block {
                    Some(block) => packed.add(head.id, block, frame),
                    None => {
                        last.insert(head.id, frame.files);
                    }
                }
            }
            Some(_) => {}
            // A run that is at work, or was killed, may leave half a line.
            None => is_damaged |= is_finished || text.ends_with('\n'),
        })?;
        if is_damaged {
            found.changed.push(relative(root, &path));
        }
    }
    let of_frame = |(id, files): (u64, Vec<FileRecord>)| {
        files
            .into_iter()
            .map(move |file| (file.path.clone(), Expected { sha256: file.sha256.clone(), frame: Some((id, file)) }))
    };
    Ok((last.into_iter().flat_map(of_frame).collect(), packed))
}

/// Adds what `SHA256SUMS` tells of; where it contradicts a journal it is itself what changed.
fn add_sums(
    root: &Path,
    expected: &mut BTreeMap<String, Expected>,
    found: &mut Verification,
) -> Result<(), StoreError> {
    let path = root.join(layout::SUMS);
    let text = match fs::read(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            found.missing.push(layout::SUMS.to_owned());
            return Ok(());
        }
        result => result.map_err(StoreError::io("read", &path))?,
    };
    let is_journalled = !expected.is_empty();
    for line in String::from_utf8_lossy(&text).lines() {
        let Some((sha256, path)) = line.split_once("  ").filter(|(sha256, path)| is_sum(sha256, path)) else {
            found.changed.push(layout::SUMS.to_owned());
            continue;
        };
        match expected.get(path) {
            Some(there) if there.sha256 != sha256 => found.changed.push(layout::SUMS.to_owned()),
            Some(_) => {}
            // A frame's file that no journal knows: the journal's line is damaged, or the name is.
            None if is_journalled && is_frame(path) && !root.join(path).is_file() => {
                found.changed.push(layout::SUMS.to_owned());
            }
            None => {
                expected.insert(path.to_owned(), Expected { sha256: sha256.to_owned(), frame: None });
            }
        }
    }
    Ok(())
}

fn is_sum(sha256: &str, path: &str) -> bool {
    sha256.len() == 64
        && sha256.bytes().all(|byte| byte.is_ascii_hexdigit())
        && !path.split('/').any(|part| part.is_empty() || part == "..")
}

fn is_frame(path: &str) -> bool {
    ["images/", "masks/", "raw/"].iter().any(|folder| path.starts_with(folder))
}

/// Calls `each` with the path of every file under `folder`.
fn walk(root: &Path, folder: &Path, each: &mut dyn FnMut(&str)) -> Result<(), StoreError> {
    let entries: io::Result<Vec<_>> = fs::read_dir(folder).and_then(Iterator::collect);
    for entry in entries.map_err(StoreError::io("read", folder))? {
        let path = entry.path();
        if entry.file_type().map_err(StoreError::io("read", &path))?.is_dir() {
            walk(root, &path, each)?;
        } else {
            each(&relative(root, &path));
        }
    }
    Ok(())
}

/// A path below the root, with forward slashes.
fn relative(root: &Path, path: &Path) -> String {
    let below: PathBuf = path.strip_prefix(root).unwrap_or(path).to_path_buf();
    below.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::super::sample::{FRAMES, IDENTITY, frame};
    use super::super::{Shard, Store};
    use super::*;
    use crate::export::{Extent, FinishInput, finish};
    use crate::label::View;

    fn finished(root: &Path) -> Vec<u64> {
        let store = Store::open(root, &IDENTITY, Shard::WHOLE).unwrap();
        let missing = store.missing();
        for &id in &missing {
            let (record, files) = frame(id);
            store.commit(record, &files).unwrap();
        }
        let input = FinishInput {
            views: vec![View::Polar, View::Fan],
            splits: ["train", "val", "test"].map(str::to_owned).to_vec(),
            categories: ["tire", "anchor"].map(str::to_owned).to_vec(),
            ..FinishInput::default()
        };
        finish(&store.dataset(), &input, Extent::Whole).unwrap();
        missing
    }

    fn files(root: &Path) -> Vec<String> {
        let mut files = Vec::new();
        walk(root, root, &mut |path| files.push(path.to_owned())).unwrap();
        files.retain(|path| fs::metadata(root.join(path)).unwrap().len() > 0);
        files
    }

    #[test]
    fn a_flipped_bit_in_any_file_is_named_and_a_run_mends_it() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        finished(root);
        let whole = verify(root).unwrap();
        assert!(whole.changed.is_empty() && whole.missing.is_empty() && whole.extra.is_empty(), "{whole:?}");
        let sums = fs::read(root.join(layout::SUMS)).unwrap();
        let files = files(root);
        assert!(files.len() as u64 > 4 * FRAMES);
        for path in files {
            let mut bytes = fs::read(root.join(&path)).unwrap();
            let middle = bytes.len() / 2;
            bytes[middle] ^= 1;
            fs::write(root.join(&path), bytes).unwrap();
            let found = verify(root).unwrap();
            assert!(found.changed.contains(&path), "{path}: {found:?}");
            let mended = finished(root);
            assert!(mended.len() <= 1, "{path}: exactly the damaged frame is rendered again, not {mended:?}");
            // A damaged line of a journal may be one that a later line of the same frame took the place of.
            if !path.ends_with(".jsonl") {
                assert_eq!(mended.is_empty(), !is_frame(&path), "{path}");
            }
            assert_eq!(verify(root).unwrap(), whole, "{path}");
            assert_eq!(fs::read(root.join(layout::SUMS)).unwrap(), sums, "{path}");
        }
    }

    #[test]
    fn lost_and_strange_files_are_named() {
        let folder = tempfile::tempdir().unwrap();
        finished(folder.path());
        fs::remove_file(folder.path().join("masks/fan/000003.png")).unwrap();
        fs::remove_file(folder.path().join("frames.csv")).unwrap();
        fs::write(folder.path().join("images/fan/notes.txt"), "x").unwrap();
        let found = verify(folder.path()).unwrap();
        assert_eq!(found.missing, ["frames.csv", "masks/fan/000003.png"]);
        assert_eq!((found.extra, found.frames), (vec!["images/fan/notes.txt".to_owned()], vec![3]));
        assert_eq!(finished(folder.path()), [3]);
        assert!(matches!(verify(&folder.path().join("images")), Err(StoreError::NoDataset { .. })));
    }

    #[test]
    fn an_unfinished_dataset_is_held_against_its_journals() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
        let (record, files) = frame(2);
        store.commit(record, &files).unwrap();
        let found = verify(folder.path()).unwrap();
        assert!(found.changed.is_empty() && found.extra.is_empty() && found.checked == 4, "{found:?}");
        fs::write(folder.path().join(&files[0].path), "x").unwrap();
        assert_eq!(verify(folder.path()).unwrap().changed, [files[0].path.clone()]);
    }
}
