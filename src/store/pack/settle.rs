//! Tar files put in order: assembled from parts, and without blocks that are no frame's any more.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, Instant};

use super::super::atomic::{self, Writer};
use super::super::index::Index;
use super::super::{Place, Shard, StoreError, claim, layout};
use super::Spot;
use super::block::END;
use super::packer::names;

/// Frames that belong into a tar, sorted, and where their blocks lie.
pub(crate) type Frames = Vec<(u64, Spot)>;

/// Another process that puts its last frames into a tar is waited for so long.
const WAIT: Duration = Duration::from_secs(600);
const LOOK_EACH: Duration = Duration::from_millis(100);

/// Puts the frames' blocks into their tar in order, and deletes the parts. Returns where they lie then.
pub(crate) fn assemble(root: &Path, tar: &str, frames: &[(u64, Spot)]) -> Result<Frames, StoreError> {
    let path = root.join(tar);
    let mut placed = Frames::new();
    if frames.is_empty() {
        remove(&path)?;
    } else {
        let tag = layout::tar_of(tar).map_or_else(String::new, |(_, shard, _)| shard_tag(shard));
        Writer::new(root, &tag).write_with(tar, |out| {
            let mut at = 0;
            for &(id, spot) in frames {
                out.write_all(&spot.read(root, tar)?)?;
                placed.push((id, Spot { part: None, offset: at, length: spot.length }));
                at += spot.length;
            }
            out.write_all(&END)
        })?;
    }
    let there = names(root)?;
    let parts =
        there.iter().filter(|name| layout::tar_of(name).is_some_and(|(of, _, part)| of == tar && part.is_some()));
    parts.into_iter().try_for_each(|name| remove(&root.join(name)))?;
    if root.join(layout::TARS).is_dir() {
        atomic::sync_folder_of(&path)?;
    }
    Ok(placed)
}

/// Whether a tar is just its frames, in order.
fn is_tidy(root: &Path, tar: &str, frames: &[(u64, Spot)]) -> bool {
    let mut end = 0;
    let in_order = frames.iter().all(|(_, spot)| {
        let follows = spot.part.is_none() && spot.offset == end;
        end += spot.length;
        follows
    });
    let length = fs::metadata(root.join(tar)).ok().map(|data| data.len());
    let is_long_enough = length == Some(end + END.len() as u64);
    in_order && !frames.is_empty() && is_long_enough && ends_well(&root.join(tar), end)
}

/// Whether a tar file has zeros, as it should, from the end of its last member.
fn ends_well(path: &Path, end: u64) -> bool {
    let stretch = Some((end, END.len() as u64));
    Place { path: path.to_path_buf(), stretch }.read().is_ok_and(|bytes| bytes == END)
}

/// The tar files of some shards that are not in order, with the frames that belong there.
pub(crate) fn untidy(
    root: &Path,
    index: &Index,
    of: impl Fn(Shard) -> bool,
) -> Result<BTreeMap<String, Frames>, StoreError> {
    let mut tars = index.tars();
    tars.retain(|tar, _| layout::tar_of(tar).is_some_and(|(_, shard, _)| of(shard)));
    sift(root, tars, of)
}

/// Takes those out that are in order, and adds what lies there without a frame.
pub(crate) fn sift(
    root: &Path,
    mut tars: BTreeMap<String, Frames>,
    of: impl Fn(Shard) -> bool,
) -> Result<BTreeMap<String, Frames>, StoreError> {
    let mut in_parts = BTreeSet::new();
    for name in names(root)? {
        let Some((tar, _, part)) = layout::tar_of(&name).filter(|&(_, shard, _)| of(shard)) else { continue };
        tars.entry(tar.to_owned()).or_default();
        if part.is_some() {
            in_parts.insert(tar.to_owned());
        }
    }
    tars.retain(|tar, frames| in_parts.contains(tar) || !is_tidy(root, tar, frames));
    Ok(tars)
}

/// Puts all tar files of a dataset in order but those of shards that are being written, which are waited for when every
/// frame is there. Returns the paths of the tar files that are in order.
pub(crate) fn settle(root: &Path, index: &Index, frames: u64) -> Result<Vec<String>, StoreError> {
    let shards: BTreeSet<(u32, u32)> = untidy(root, index, |_| true)?
        .keys()
        .filter_map(|tar| layout::tar_of(tar).map(|(_, shard, _)| (shard.index, shard.count)))
        .collect();
    if shards.is_empty() {
        return Ok(index.tars().into_keys().collect());
    }
    let patience = if index.len() == frames { WAIT } else { Duration::ZERO };
    for (number, count) in shards {
        let ours = Shard { index: number, count };
        let lock = match lock(root, ours, patience) {
            Err(StoreError::Locked { .. }) if patience.is_zero() => continue,
            result => result?,
        };
        // Its process may have put them in order, or more frames there, since.
        let index = Index::read(root, frames, None)?;
        for (tar, frames) in untidy(root, &index, |shard| shard == ours)? {
            assemble(root, &tar, &frames)?;
        }
        // As the store does: a child process may still hold a copy.
        let _ = lock.unlock();
    }
    let index = Index::read(root, frames, None)?;
    let untidy = untidy(root, &index, |_| true)?;
    Ok(index.tars().into_keys().filter(|tar| !untidy.contains_key(tar)).collect())
}

fn lock(root: &Path, shard: Shard, patience: Duration) -> Result<File, StoreError> {
    let asked = Instant::now();
    loop {
        match claim::lock(root, &layout::lock(shard)) {
            Err(StoreError::Locked { .. }) if asked.elapsed() < patience => std::thread::sleep(LOOK_EACH),
            result => return result,
        }
    }
}

/// What tells the temporary files of a shard from others'.
fn shard_tag(shard: Shard) -> String {
    format!("{:05}-of-{:05}", shard.index, shard.count)
}

fn remove(path: &Path) -> Result<(), StoreError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        result => result.map_err(StoreError::io("delete", path)),
    }
}
