//! Frames in tar files, held against the journals block by block.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::super::atomic::sha256;
use super::super::index::Files;
use super::super::pack::{self, Block, Frames, Shelf, Spot};
use super::super::{FileRecord, StoreError};
use super::Verification;

/// Packed frames as the journals tell of them; of several records of a frame the last counts whose block is there.
pub(super) struct Packed {
    root: PathBuf,
    shelf: Shelf,
    frames: BTreeMap<u64, Frame>,
}

struct Frame {
    block: Block,
    spot: Option<Spot>,
    name: String,
    files: Vec<FileRecord>,
}

/// How a block was found.
enum Found {
    Right,
    /// With members, by path, that are not what they should be.
    Changed(Vec<String>),
    Missing,
}

impl Packed {
    pub fn new(root: &Path) -> Self {
        Self { root: root.to_path_buf(), shelf: Shelf::new(root), frames: BTreeMap::new() }
    }

    /// Takes in what a journal tells of a frame.
    pub fn add(&mut self, id: u64, block: Block, Files { name, files }: Files) {
        // What cannot be read is not there; which it is, the tar file's own hash tells.
        let spot = self.shelf.find(id, &block).unwrap_or_default();
        if spot.is_some() || !self.frames.contains_key(&id) {
            self.frames.insert(id, Frame { block, spot, name, files });
        }
    }

    /// The tar files that the journals tell of.
    pub fn tars(&self) -> BTreeSet<&str> {
        self.frames.values().map(|frame| frame.block.tar.as_str()).collect()
    }

    /// Looks at every block; adds what is not as it should be, and the frames with their tar files to the damaged ones.
    /// Returns the tar files that are what they should be.
    pub fn look(
        &self,
        found: &mut Verification,
        damaged: &mut Vec<(u64, FileRecord)>,
    ) -> Result<BTreeSet<String>, StoreError> {
        let outcomes: Vec<_> = self.frames.par_iter().map(|(&id, frame)| (id, frame, self.find(id, frame))).collect();
        let mut bad: BTreeSet<&str> = BTreeSet::new();
        for (id, frame, outcome) in outcomes {
            let tar = &frame.block.tar;
            found.checked += frame.files.len() as u64 + 1;
            match outcome {
                Found::Right => continue,
                Found::Changed(members) => found.changed.extend(members),
                Found::Missing if !self.root.join(tar).is_file() => found.missing.push(tar.clone()),
                Found::Missing => {
                    let members = pack::member_names(&frame.name, &frame.files);
                    found.missing.extend(members.iter().map(|member| format!("{tar}/{member}")));
                }
            }
            bad.insert(tar);
            let Block { length, sha256, .. } = &frame.block;
            damaged.push((id, FileRecord { path: tar.clone(), bytes: *length, sha256: sha256.clone() }));
        }
        let mut tars: BTreeMap<String, Frames> = BTreeMap::new();
        for (&id, frame) in &self.frames {
            tars.entry(frame.block.tar.clone()).or_default().extend(frame.spot.map(|spot| (id, spot)));
        }
        let untidy = pack::sift(&self.root, tars.clone(), |_| true)?;
        tars.retain(|tar, _| !bad.contains(tar.as_str()) && !untidy.contains_key(tar));
        Ok(tars.into_keys().collect())
    }

    fn find(&self, id: u64, frame: &Frame) -> Found {
        let Block { tar, sha256: hash, .. } = &frame.block;
        let Some(spot) = frame.spot.or_else(|| self.guess(id, frame)) else { return Found::Missing };
        let Ok(bytes) = spot.read(&self.root, tar) else { return Found::Missing };
        if frame.spot.is_some() && sha256(&bytes) == *hash {
            return Found::Right;
        }
        let members = pack::damaged_members(&bytes, &frame.name, &frame.files);
        if frame.spot.is_none() && members.len() == frame.files.len() {
            return Found::Missing;
        }
        Found::Changed(members.iter().map(|member| format!("{}/{member}", spot.path(tar))).collect())
    }

    /// Where a frame without a place would be if only its first or last header were harmed: behind the one before.
    fn guess(&self, id: u64, frame: &Frame) -> Option<Spot> {
        let tar = &frame.block.tar;
        let before = self.frames.range(..id).rev().find(|(_, other)| other.block.tar == *tar);
        let offset = match before.map(|(_, other)| other.spot) {
            Some(spot) => spot.filter(|spot| spot.part.is_none()).map(|spot| spot.offset + spot.length)?,
            None => 0,
        };
        Some(Spot { part: None, offset, length: frame.block.length })
    }
}
