//! The store: opens or begins a shard of a dataset folder and takes finished frames from any thread.

use std::fs::{self, File};
use std::io::ErrorKind;
use std::ops::Range;
use std::path::Path;
use std::sync::{Mutex, MutexGuard};

use super::atomic::{Writer, sha256};
use super::dataset::Dataset;
use super::index::Index;
use super::journal::Journal;
use super::manifest::{IncludeLock, Manifest};
use super::pack::{Frames, Packer, Spot, assemble, untidy};
use super::{FrameRecord, Pack, Shard, StoreError, claim, layout, line};

/// What makes a dataset the one that it is.
#[derive(Clone, Copy, Debug)]
pub struct Identity<'a> {
    /// Name in the recipe.
    pub name: &'a str,
    /// Hash of every drawn value of every job.
    pub plan_hash: &'a str,
    /// Frames in the plan: ids 0 .. frames.
    pub frames: u64,
    /// Frames of each scene.
    pub frames_a_scene: u64,
    /// The recipe as given; none where a plan was given instead.
    pub recipe_text: Option<&'a str>,
    /// How frames' files are packed; none: they are loose.
    pub pack: Option<Pack>,
    /// Changes that were made to it, `path=value`.
    pub sets: &'a [String],
    /// Files that it includes.
    pub includes: &'a [IncludeLock],
    /// Every drawn value of every job.
    pub plan_json: &'a [u8],
    /// What finishing needs beside the frames' records; kept for it.
    pub facts: &'a [u8],
}

/// A file that a frame brings.
#[derive(Clone, Debug)]
pub struct NewFile {
    /// Relative to the dataset folder, see [`layout`].
    pub path: String,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// A shard of a dataset folder that this process, and no other, writes to until the store is dropped.
#[derive(Debug)]
pub struct Store {
    writer: Writer,
    /// None where files are loose.
    packer: Option<Packer>,
    /// Without the results of finishing.
    manifest: Manifest,
    shard: Shard,
    jobs: Range<u64>,
    progress: Mutex<Progress>,
    lock: File,
}

#[derive(Debug)]
struct Progress {
    journal: Journal,
    index: Index,
}

impl Store {
    /// Begins a dataset in `root`, or goes on with the one that is there. Frames whose files are gone or cut off count as
    /// unfinished; frames that other shards finished count as finished.
    ///
    /// # Errors
    /// [`StoreError`] if the folder cannot be written, holds something else, another plan or another version's frames, or
    /// if another process writes the same shard. The folder is then as it was before, but for `shards/`.
    pub fn open(root: &Path, identity: &Identity<'_>, shard: Shard) -> Result<Self, StoreError> {
        claim::refuse_foreign(root)?;
        let mut ours = Manifest::begun(identity);
        check_is_ours(root, &ours, identity)?;
        let tag = format!("{:05}-of-{:05}", shard.index, shard.count);
        claim::probe(root, &tag)?;
        let lock = claim::lock(root, &layout::lock(shard))?;
        let writer = Writer::new(root, &tag);
        // Again, as another process may have begun and ended since.
        let there = check_is_ours(root, &ours, identity)?;
        let mut recipe = identity.recipe_text.map(|text| text.as_bytes().to_vec());
        if let (None, Some(there)) = (&recipe, &there) {
            // Begun from a recipe that gave this very plan: it stays what the dataset is made from.
            recipe = fs::read(root.join(layout::RECIPE)).ok().filter(|text| there.recipe_sha256 == Some(sha256(text)));
            if recipe.is_some() {
                (ours.recipe_sha256, ours.includes) = (there.recipe_sha256.clone(), there.includes.clone());
            }
        }
        if there.is_none_or(|there| there.begun_again() != ours) {
            writer.write(layout::MANIFEST, ours.text().as_bytes())?;
        }
        if let Some(recipe) = recipe {
            writer.keep(layout::RECIPE, &recipe)?;
        }
        writer.keep(layout::PLAN, identity.plan_json)?;
        writer.keep(layout::FACTS, identity.facts)?;
        let journal = Journal::open(&writer, shard)?;
        let index = Index::read(root, identity.frames, Some(&layout::journal(shard)))?;
        let jobs = shard.jobs(identity.frames, identity.frames_a_scene);
        let packer = identity.pack.map(|pack| Packer::new(root, shard, jobs.start, pack));
        Ok(Self {
            writer,
            packer,
            manifest: ours,
            shard,
            jobs,
            progress: Mutex::new(Progress { journal, index }),
            lock,
        })
    }

    /// Writes a frame's files and then journals it; `record.files` is filled in here. Threads may call this at once,
    /// each for frames of its own.
    ///
    /// # Errors
    /// [`StoreError`] if a file cannot be written or the record cannot be kept; the frame is then unfinished.
    pub fn commit(&self, mut record: FrameRecord, files: &[NewFile]) -> Result<(), StoreError> {
        let id = record.id;
        let refuse = |reason: String| StoreError::Record { path: self.root().to_path_buf(), id, reason };
        if record.id >= self.manifest.frames {
            return Err(refuse(format!("the plan has {} frames", self.manifest.frames)));
        }
        let block = match &self.packer {
            Some(packer) => {
                let newest = |tar: &str| self.progress().index.newest_part(tar);
                Some(packer.append(&mut record, files, newest)?)
            }
            None => {
                record.files = self.writer.write_all(files)?;
                None
            }
        };
        let (line, record) = line::done(&record, block.clone()).map_err(|error| refuse(error.to_string()))?;
        let (file, path, full) = {
            let Progress { journal, index } = &mut *self.progress();
            let (offset, file) = journal.append(&line)?;
            index.add(journal.path(), record.id, (offset, line.len()), block.as_ref());
            (file, journal.path().to_path_buf(), self.filled(index, record.id))
        };
        file.sync_data().map_err(StoreError::io("sync", &path))?;
        full.map_or(Ok(()), |(packer, tar, frames)| self.assemble(packer, &tar, &frames))
    }

    /// The tar file of a frame and all its frames, if this one is the last that was missing.
    fn filled(&self, index: &Index, id: u64) -> Option<(&Packer, String, Frames)> {
        let packer = self.packer.as_ref()?;
        let (tar, range) = packer.tar_of(id);
        let ids = range.start..range.end.min(self.jobs.end);
        // Frames come nearly in order, so the last ones are most likely to be missing.
        if !ids.clone().rev().all(|id| index.has(id)) {
            return None;
        }
        let spot = |id| index.packed(id).filter(|(of, _)| *of == tar).map(|(_, spot)| (id, spot));
        let frames = ids.filter_map(spot).collect();
        Some((packer, tar, frames))
    }

    fn assemble(&self, packer: &Packer, tar: &str, frames: &[(u64, Spot)]) -> Result<(), StoreError> {
        packer.close(tar);
        let placed = assemble(self.root(), tar, frames)?;
        self.progress().index.moved(&placed);
        Ok(())
    }

    /// Puts the shard's tar files in order with the frames that are there. Nothing where files are loose.
    ///
    /// # Errors
    /// [`StoreError`] if a tar file cannot be written; no frame is lost then.
    pub fn pack(&self) -> Result<(), StoreError> {
        let Some(packer) = &self.packer else { return Ok(()) };
        let untidy = untidy(self.root(), &self.progress().index, |shard| shard == self.shard)?;
        untidy.iter().try_for_each(|(tar, frames)| self.assemble(packer, tar, frames))
    }

    /// Journals that a frame cannot be rendered, and why.
    ///
    /// # Errors
    /// [`StoreError`] if the journal cannot be written.
    pub fn fail(&self, id: u64, reason: &str) -> Result<(), StoreError> {
        let Progress { journal, index } = &mut *self.progress();
        let (_, file) = journal.append(&line::failed(id, reason))?;
        index.fail(id, reason);
        file.sync_data().map_err(StoreError::io("sync", journal.path()))
    }

    /// Ids of this shard's frames that are still to be rendered, in order.
    #[must_use]
    pub fn missing(&self) -> Vec<u64> {
        let progress = self.progress();
        self.jobs.clone().filter(|&id| !progress.index.has(id)).collect()
    }

    /// Which part of the dataset this is.
    #[must_use]
    pub fn shard(&self) -> Shard {
        self.shard
    }

    /// Frames that this shard has to render, finished or not.
    #[must_use]
    pub fn jobs(&self) -> Range<u64> {
        self.jobs.clone()
    }

    /// The whole dataset as it is now, as far as this process knows.
    #[must_use]
    pub fn dataset(&self) -> Dataset {
        Dataset::of(self.root(), &self.manifest, &self.progress().index)
    }

    /// The dataset folder.
    #[must_use]
    pub fn root(&self) -> &Path {
        self.writer.root()
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

/// Refuses a folder with another dataset; `None` if there is none, or a manifest too damaged to tell beside a plan that
/// is ours.
fn check_is_ours(root: &Path, ours: &Manifest, identity: &Identity<'_>) -> Result<Option<Manifest>, StoreError> {
    let plan = root.join(layout::PLAN);
    let verdict = match Manifest::read(root) {
        Ok(None) => return Ok(None),
        Ok(Some(there)) => there.check_is(ours, root).map(|()| Some(there)),
        Err(error) => Err(error),
    };
    verdict.or_else(|error| match error {
        // A flipped bit in the manifest must not make a dataset somebody else's: the plan itself is the better witness.
        StoreError::OtherPlan { .. } | StoreError::Manifest { .. } => match fs::read(&plan) {
            Ok(bytes) if bytes == identity.plan_json => Ok(None),
            Err(io) if io.kind() != ErrorKind::NotFound => Err(StoreError::io("read", &plan)(io)),
            _ => Err(error.with_difference(&plan, identity.plan_json)),
        },
        _ => Err(error),
    })
}

#[cfg(test)]
mod tests;
