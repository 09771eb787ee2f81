//! Shards: parts of a dataset that processes write side by side, each with a journal of its own.
//!
//! Which frames a shard renders follows from the plan alone; what a frame is does not follow from its shard.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use thiserror::Error;

/// Most shards of a dataset.
pub const MAX_SHARDS: u32 = 99_999;
/// Shards are cut between scenes where there are so many scenes to a shard: a world is then built by one of them only.
const SCENES_A_SHARD: u64 = 4;

/// One of several parts of a dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 0.
    pub index: u32,
    /// How many there are.
    pub count: u32,
}

/// A text that names no shard.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{text}` is no shard: write i/n with i from 0 to n - 1, such as 0/4 for the first of four")]
pub struct ShardError {
    /// What was given.
    pub text: String,
}

impl Shard {
    /// The whole dataset.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Its jobs among all of a plan with so many `frames` a scene: a stretch of the plan's order, so that frames of a
    /// scene stay together.
    #[must_use]
    pub fn jobs(self, jobs: u64, frames: u64) -> Range<u64> {
        let scenes = jobs.checked_div(frames).unwrap_or(0);
        let (index, count) = (u128::from(self.index), u128::from(self.count));
        let whole_scenes = scenes >= SCENES_A_SHARD * u64::from(self.count);
        let cut = |of: u64, part: u128| (u128::from(of) * part / count) as u64;
        if whole_scenes {
            cut(scenes, index) * frames..cut(scenes, index + 1) * frames
        } else {
            cut(jobs, index)..cut(jobs, index + 1)
        }
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let numbers = text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        match numbers {
            Some((index, count)) if index < count && count <= MAX_SHARDS => Ok(Self { index, count }),
            _ => Err(ShardError { text: text.to_owned() }),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_all_jobs_and_none_twice() {
        for (scenes, frames, count) in [(10, 20, 1), (10, 20, 3), (100, 7, 7), (1, 5, 8), (3, 1, 2), (8, 3, 2)] {
            let parts = (0..count).map(|index| Shard { index, count }.jobs(scenes * frames, frames));
            let all: Vec<u64> = parts.flatten().collect();
            assert_eq!(all, (0..scenes * frames).collect::<Vec<_>>(), "{scenes} × {frames} in {count}");
        }
    }

    #[test]
    fn scenes_stay_whole_where_there_are_many() {
        let shard = |index| Shard { index, count: 2 };
        assert_eq!(shard(0).jobs(9 * 3, 3), 0..12);
        assert_eq!(shard(1).jobs(9 * 3, 3), 12..27);
        assert_eq!(shard(0).jobs(3 * 3, 3), 0..4, "few scenes are shared evenly instead");
    }

    #[test]
    fn names_are_read_strictly() {
        assert_eq!("3/16".parse(), Ok(Shard { index: 3, count: 16 }));
        for wrong in ["", "3", "4/4", "-1/4", "1/0", "1/x", "1/2/3", "0/100000"] {
            let message = wrong.parse::<Shard>().expect_err(wrong).to_string();
            assert!(message.contains("0/4"), "{message}");
        }
    }
}
