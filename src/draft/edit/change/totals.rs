//! Numbers of the dataset as a whole: frames in all, shares of its splits.

use super::Acts;
use super::values::set;
use crate::draft::Problem;
use crate::draft::edit::act::{map, number};
use crate::draft::edit::numbers::rounded;
use crate::draft::edit::subject::Subject;
use crate::recipe::path::under;

/// So many frames in all: scenes as they are said, where that can be.
pub(super) fn images(subject: &Subject, images: u64) -> Result<Acts, Problem> {
    let variants = subject.variants() as u64;
    let each = images.div_ceil(variants).max(1);
    let frames = subject.value("frames").and_then(|(node, _)| node.number()).unwrap_or(10.0).max(1.0) as u64;
    // The number of frames nearest to what is said that divides them; a prime number of images has one scene more.
    let divides = (1..=each.min(10_000)).filter(|frames| each.is_multiple_of(*frames));
    let best = divides.min_by_key(|count| count.abs_diff(frames)).unwrap_or(1);
    let near = best * 2 >= frames && best <= frames * 2;
    let frames_now = if near { best } else { frames.min(each) };
    let scenes = each.div_ceil(frames_now);
    let made = scenes * frames_now * variants;
    let acts = set(subject, "scenes", number(scenes as f64))?;
    let acts = if frames_now == frames { acts } else { acts.with(set(subject, "frames", number(frames_now as f64))?) };
    Ok(match made == images {
        true => acts,
        false => {
            acts.note(format!("{made} images in all: {variants} variants of {scenes} scenes of {frames_now} frames"))
        }
    })
}

/// Shares of training, validation and test.
pub(super) fn splits(subject: &Subject, shares: [f64; 3]) -> Result<Acts, Problem> {
    let names = ["train", "val", "test"];
    if subject.said("splits").is_some() {
        let mut acts = Acts::default();
        for (name, share) in names.into_iter().zip(shares) {
            acts = acts.with(set(subject, &under("splits", name), number(rounded(share)))?);
        }
        return Ok(acts);
    }
    let entries = names.into_iter().zip(shares).map(|(name, share)| (name, number(rounded(share))));
    set(subject, "splits", map(entries))
}
