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
/// Frames' files, where they are packed.
pub const TARS: &str = "tars";
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

/// A tar file of a shard.
#[must_use]
pub fn tar(shard: Shard, number: u64) -> String {
    format!("{TARS}/{:05}-of-{:05}-{number:06}.tar", shard.index, shard.count)
}

/// Where frames wait to be put into a tar file in order; its number is one more than that of an earlier part of the tar.
pub(crate) fn part(tar: &str, number: u32) -> String {
    format!("{tar}.{number}.part")
}

/// The tar file, its shard, and the number if it is but a part, of a path.
pub(crate) fn tar_of(path: &str) -> Option<(&str, Shard, Option<u32>)> {
    let (tar, part) = match path.strip_suffix(".part") {
        Some(numbered) => {
            let (tar, number) = numbered.rsplit_once('.')?;
            (tar, Some(number.parse().ok()?))
        }
        None => (path, None),
    };
    let stem = tar.strip_prefix(TARS)?.strip_prefix('/')?.strip_suffix(".tar")?;
    let (index, rest) = stem.split_once("-of-")?;
    let (count, _) = rest.split_once('-')?;
    let shard = format!("{}/{}", index.parse::<u32>().ok()?, count.parse::<u32>().ok()?);
    Some((tar, shard.parse().ok()?, part))
}

/// Whether a path is one among the tar files.
pub(crate) fn is_packed(path: &str) -> bool {
    path.strip_prefix(TARS).is_some_and(|rest| rest.starts_with('/'))
}

/// Name of a frame's file in a tar file: all of a frame share what stands before the first dot, as WebDataset has it.
///
/// `images/polar/000123.png` is `000123.polar.png`, in the look `murky` `000123.murky.polar.png`; a mask
/// `000123.polar.mask.png`; raw values `000123.raw.exr`.
#[must_use]
pub fn member(frame: &str, path: &str) -> String {
    let (folder, file) = path.rsplit_once('/').unwrap_or(("", path));
    let (stem, kind) = file.rsplit_once('.').unwrap_or((file, "bin"));
    let look = stem.strip_prefix(frame).and_then(|rest| rest.strip_prefix('_'));
    let look = look.map(|look| format!("{look}.")).unwrap_or_default();
    match folder.split_once('/') {
        Some(("masks", view)) => format!("{frame}.{look}{view}.mask.{kind}"),
        Some((_, view)) => format!("{frame}.{look}{view}.{kind}"),
        None => format!("{frame}.{look}{folder}.{kind}"),
    }
}

/// Name of a frame's record in a tar file.
#[must_use]
pub fn record_member(frame: &str) -> String {
    format!("{frame}.json")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tars_and_their_parts_are_told_by_name() {
        let shard = Shard { index: 3, count: 16 };
        let name = tar(shard, 7);
        assert_eq!(name, "tars/00003-of-00016-000007.tar");
        assert_eq!(tar_of(&name), Some((name.as_str(), shard, None)));
        assert_eq!(tar_of(&part(&name, 2)), Some((name.as_str(), shard, Some(2))));
        for other in
            ["tars/notes.txt", "tars/00003-of-00002-000000.tar", "tars/a.tar", "tars/x.part", &format!("{name}.s.tmp")]
        {
            assert_eq!(tar_of(other), None, "{other}");
        }
    }

    #[test]
    fn members_of_a_frame_share_all_before_the_first_dot() {
        let frame = frame_name(123, Some("v001"));
        let paths = [
            (image(View::Polar, &frame, None), "000123_v001.polar.png"),
            (image(View::Fan, &frame, Some("mask")), "000123_v001.mask.fan.png"),
            (mask(View::Fan, &frame), "000123_v001.fan.mask.png"),
            (raw(&frame), "000123_v001.raw.exr"),
        ];
        paths.iter().for_each(|(path, name)| assert_eq!(member(&frame, path), *name));
    }
}
