//! How far a dataset is, read from the journals' heads without disturbing the processes that write them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use super::line::{self, Outcome};
use super::manifest::Manifest;
use super::{StoreError, index, journal};
use crate::label::View;

/// A run that has written nothing for so long has ended or hangs, seconds.
const QUIET_S: u64 = 120;
/// The rate is that of the last so many seconds of work.
const RATE_OVER_S: u64 = 600;

/// How far a dataset is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Status {
    /// Name of the dataset.
    pub name: String,
    /// Version of the program that writes it.
    pub ensonify: String,
    /// Hash of the plan.
    pub plan_hash: String,
    /// Frames that are journalled.
    pub frames_done: u64,
    /// Frames in the plan.
    pub frames_total: u64,
    /// Whether all frames are there and annotations, tables and hashes are written.
    pub finished: bool,
    /// Hash of the data, once finished.
    pub dataset_hash: Option<String>,
    /// Frames of each split so far.
    pub splits: BTreeMap<String, u64>,
    /// Annotations so far of each view and category.
    pub annotations: BTreeMap<View, BTreeMap<String, u64>>,
    /// Length of the finished frames' files.
    pub bytes: u64,
    /// Frames that could not be rendered, with the reason.
    pub failed: BTreeMap<u64, String>,
    /// Journals there are: one a shard.
    pub shards: u64,
    /// Frames a second over the last minutes of all shards that are at work; nothing when none is.
    pub frames_per_s: Option<f64>,
    /// Seconds to go at that rate.
    pub left_s: Option<f64>,
}

impl Status {
    /// Looks at the dataset in `root`; writes nothing, and does not look at the frames' files.
    ///
    /// # Errors
    /// [`StoreError`] if `root` is no dataset or cannot be read.
    pub fn read(root: &Path) -> Result<Self, StoreError> {
        let manifest = Manifest::read(root)?.ok_or_else(|| StoreError::NoDataset { path: root.to_path_buf() })?;
        let mut tally = Tally::default();
        let journals = index::journals(root, None)?;
        for path in &journals {
            journal::each_line(path, |text, _| tally.line(text, manifest.frames))?;
        }
        let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        let (frames_done, frames_total) = (tally.done.len() as u64, manifest.frames);
        let dataset_hash = manifest.dataset_hash.filter(|_| frames_done + manifest.missing == frames_total);
        let frames_per_s = tally.rate(now).filter(|_| frames_done < frames_total);
        tally.failed.retain(|id, _| !tally.done.contains(id));
        Ok(Self {
            name: manifest.name,
            ensonify: manifest.ensonify,
            plan_hash: manifest.plan_hash,
            frames_done,
            frames_total,
            finished: dataset_hash.is_some(),
            dataset_hash,
            splits: tally.splits,
            annotations: tally.annotations,
            bytes: tally.bytes,
            failed: tally.failed,
            shards: journals.len() as u64,
            frames_per_s,
            left_s: frames_per_s.map(|rate| (frames_total - frames_done) as f64 / rate),
        })
    }
}

/// Sums over lines.
#[derive(Default)]
struct Tally {
    done: BTreeSet<u64>,
    failed: BTreeMap<u64, String>,
    splits: BTreeMap<String, u64>,
    annotations: BTreeMap<View, BTreeMap<String, u64>>,
    bytes: u64,
    /// Frames by the second in which they were written.
    written: BTreeMap<u64, u64>,
}

impl Tally {
    fn line(&mut self, text: &str, frames: u64) {
        let Some((head, outcome)) = line::head(text).filter(|(head, _)| head.id < frames) else { return };
        *self.written.entry(head.at).or_default() += 1;
        if let Outcome::Failed(reason) = outcome {
            self.failed.insert(head.id, reason);
            return;
        }
        if !self.done.insert(head.id) {
            return;
        }
        *self.splits.entry(head.split).or_default() += 1;
        self.bytes += head.bytes;
        for (view, labels) in head.annotations {
            let sums = self.annotations.entry(view).or_default();
            labels.into_iter().for_each(|(label, count)| *sums.entry(label).or_default() += count);
        }
    }

    /// Frames a second, if one was written a short while ago.
    fn rate(&self, now: u64) -> Option<f64> {
        let (&last, _) = self.written.last_key_value()?;
        let recent = || self.written.range(last.saturating_sub(RATE_OVER_S)..);
        let (&first, &at_first) = recent().next()?;
        let frames: u64 = recent().map(|(_, frames)| frames).sum();
        let lasted = last - first;
        // The frames of the first second were begun before it.
        let is_fresh = now.saturating_sub(last) <= QUIET_S && lasted > 0;
        is_fresh.then(|| (frames - at_first) as f64 / lasted as f64)
    }
}
