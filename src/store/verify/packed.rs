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
    /// With members that are not what they should be.
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
        let outcomes: Vec<_> = self.frames.par_iter().map(|(&id, frame)| (id, frame, self.find(frame))).collect();
        let mut bad: BTreeSet<&str> = BTreeSet::new();
        for (id, frame, outcome) in outcomes {
            let tar = &frame.block.tar;
            found.checked += frame.files.len() as u64 + 1;
            match (outcome, frame.spot) {
                (Found::Right, _) => continue,
                (Found::Changed(members), Some(spot)) => {
                    found.changed.extend(members.iter().map(|member| format!("{}/{member}", spot.path(tar))));
                }
                _ if !self.root.join(tar).is_file() => found.missing.push(tar.clone()),
                _ => {
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

    fn find(&self, frame: &Frame) -> Found {
        let Some(Ok(bytes)) = frame.spot.map(|spot| spot.read(&self.root, &frame.block.tar)) else {
            return Found::Missing;
        };
        if sha256(&bytes) == frame.block.sha256 {
            return Found::Right;
        }
        Found::Changed(pack::damaged_members(&bytes, &frame.name, &frame.files))
    }
}
