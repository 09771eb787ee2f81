//! Where things lie in a dataset folder: paths relative to it, with forward slashes.

use super::Shard;
use crate::label::View;

/// The recipe as given.
pub const RECIPE: &str = "recipe.yaml";
/// Every drawn value of every job.
pub const PLAN: &str = "plan.json";
/// What the dataset is.
pub const MANIFEST: &str = "manifest.json";
/// Hash of every file, for `sha256sum -c`.
pub const SUMS: &str = "SHA256SUMS";
/// One row a frame.
pub const FRAMES: &str = "frames.csv";
/// The dataset card.
pub const CARD: &str = "README.md";
/// Whose models are in it.
pub const ATTRIBUTION: &str = "ATTRIBUTION.md";
/// Journals, and what else is kept of a run.
pub const SHARDS: &str = "shards";
/// What finishing needs beside the journals.
pub const FACTS: &str = "shards/facts.json";
/// Held by the process that finishes.
pub(crate) const FINISH_LOCK: &str = "shards/finish.lock";
/// Files that a verification found changed.
pub(crate) const DAMAGED: &str = "shards/damaged.json";
/// What a file is called until it is whole.
pub(crate) const TEMPORARY: &str = "tmp";

/// A shard's finished frames, one line each.
#[must_use]
pub fn journal(shard: Shard) -> String {
    format!("{SHARDS}/{:05}-of-{:05}.jsonl", shard.index, shard.count)
}

/// Held by the process that writes a shard.
#[must_use]
pub(crate) fn lock(shard: Shard) -> String {
    format!("{SHARDS}/{:05}-of-{:05}.lock", shard.index, shard.count)
}

/// Whether a file of [`SHARDS`] is a journal.
pub(crate) fn is_journal(name: &str) -> bool {
    let shard = name.strip_suffix(".jsonl").and_then(|stem| stem.split_once("-of-"));
    shard.is_some_and(|(index, count)| format!("{index}/{count}").parse::<Shard>().is_ok())
}

/// Name of a frame in all its files, with its variant where there is a sweep.
#[must_use]
pub fn frame_name(id: u64, variant: Option<&str>) -> String {
    match variant {
        Some(variant) => format!("{id:06}_{variant}"),
        None => format!("{id:06}"),
    }
}

/// 8-bit picture of a frame, in a look if it has a name.
#[must_use]
pub fn image(view: View, frame: &str, look: Option<&str>) -> String {
    match look {
        Some(look) => format!("images/{}/{frame}_{look}.png", view.name()),
        None => format!("images/{}/{frame}.png", view.name()),
    }
}

/// 16-bit mask of a frame: body numbers.
#[must_use]
pub fn mask(view: View, frame: &str) -> String {
    format!("masks/{}/{frame}.png", view.name())
}

/// Noise-free echoes of a frame.
#[must_use]
pub fn raw(frame: &str) -> String {
    format!("raw/{frame}.exr")
}

/// COCO annotations of one view of one split.
#[must_use]
pub fn annotations(view: View, split: &str) -> String {
    format!("annotations/{}_{split}.json", view.name())
}

/// Whether the dataset hash covers a file: what was rendered and what is derived from it, not words about it.
pub(crate) fn is_data(path: &str) -> bool {
    path == FRAMES || ["images/", "masks/", "raw/", "annotations/"].iter().any(|folder| path.starts_with(folder))
}
