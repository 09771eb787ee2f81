//! What holds for a whole dataset.

use serde::{Deserialize, Serialize};

use crate::catalog::LicencePolicy;
use crate::label::{LabelSettings, View};
use crate::math::Impossible;
use crate::math::rng::Stream;

/// Most frames of one dataset.
pub(super) const MAX_JOBS: u64 = 10_000_000;

/// Sections of a recipe that are the same for every frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Header {
    /// Name of the dataset.
    pub name: String,
    /// Seed of every draw.
    pub seed: u64,
    /// Independent draws of the world, in each variant.
    #[serde(rename = "scenes_per_variant")]
    pub scenes: u64,
    /// Frames a scene.
    #[serde(rename = "frames_per_scene")]
    pub frames: u64,
    /// Which licences models may be under.
    #[serde(skip_serializing_if = "LicencePolicy::is_default")]
    pub licences: LicencePolicy,
    /// When a body is labelled.
    pub labels: LabelSettings,
    /// How frames are dealt out.
    pub splits: Splits,
    /// What is written for each frame.
    pub output: Output,
}

impl Header {
    /// Refuses what no dataset of so many variants can have.
    ///
    /// # Errors
    /// The first impossible value, with its key in the recipe.
    pub(super) fn check(&self, variants: u64) -> Result<(), Impossible> {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        let names_folder = !self.name.is_empty() && self.name.chars().all(plain) && !self.name.starts_with('.');
        let help = "use letters, digits, `-`, `_` and `.`: it names the folder of the dataset";
        Impossible::unless(names_folder, "name", format!("`{}` cannot name a dataset", self.name), help)?;
        for (key, count) in [("scenes", self.scenes), ("frames", self.frames)] {
            Impossible::unless(count > 0, key, "there must be at least 1", "write a whole number from 1")?;
        }
        let jobs = self.scenes.checked_mul(self.frames).and_then(|jobs| jobs.checked_mul(variants));
        let swept = if variants > 1 { " x variants" } else { "" };
        let few = jobs.is_some_and(|jobs| jobs <= MAX_JOBS);
        let message = format!("scenes x frames{swept} is more than {MAX_JOBS}");
        Impossible::unless(few, "scenes", message, "make several datasets")?;
        self.splits.check()?;
        let share = self.labels.min_share;
        let message = format!("{share} is not a share");
        let help = "write a number from 0 to 1";
        Impossible::unless((0.0..=1.0).contains(&share), "labels.min_share", message, help)?;
        self.output.check()
    }

    /// Number of a frame among those of its variant: with the seed, the address of its random streams. Frames of different
    /// variants share it, so that they differ in what was swept alone.
    #[must_use]
    pub fn number_in_variant(&self, scene: u64, frame: u64) -> u64 {
        scene * self.frames + frame
    }
}

/// What is written for each frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Pictures, each with its masks and annotations.
    pub views: Vec<View>,
    /// Linear values before noise and display.
    pub raw: Raw,
    /// Height of the fan picture, pixels; its width follows from the aperture.
    pub fan_height_px: u32,
    /// Whether files are packed; pictures and hashes are the same either way.
    pub pack: Packing,
    /// Frames in each tar file of a packed dataset.
    pub tar_frames: u64,
}

impl Output {
    fn check(&self) -> Result<(), Impossible> {
        let help = "write `views: [polar]`, `[fan]` or `[polar, fan]`";
        Impossible::unless(!self.views.is_empty(), "output.views", "there is nothing to write", help)?;
        let twice = self.views.iter().enumerate().any(|(i, view)| self.views[..i].contains(view));
        Impossible::unless(!twice, "output.views", "a view stands twice", help)?;
        let message = format!("a fan {} pixels high cannot be drawn", self.fan_height_px);
        let possible = (16..=8192).contains(&self.fan_height_px);
        Impossible::unless(possible, "output.fan_height_px", message, "write a whole number from 16 to 8192")?;
        let message = format!("tar files of {} frames cannot be written", self.tar_frames);
        let help = format!("write a whole number from 1 to {MAX_JOBS}, such as 1000");
        Impossible::unless((1..=MAX_JOBS).contains(&self.tar_frames), "output.tar_frames", message, &help)
    }
}

/// Formats of the linear, noise-free image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Raw {
    /// Not written.
    None,
    /// OpenEXR, 32 bits a channel: intensity, elevation, incidence, instance, material.
    Exr,
}

/// Ways to write many files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Packing {
    /// Each as it is.
    None,
    /// In tar files, as WebDataset has them.
    Tar,
}

/// Shares of train, val and test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Splits {
    /// Share of `train`.
    pub train: f64,
    /// Share of `val`.
    pub val: f64,
    /// Share of `test`.
    pub test: f64,
    /// What is kept together.
    pub by: SplitBy,
    /// What the shares hold within.
    pub stratify: Stratify,
}

/// What the shares of the splits hold within, where models are dealt out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stratify {
    /// Nothing: each model is dealt by itself, and other models never move it.
    None,
    /// The models of each label of a catalog: a label with at least as many models as there are splits is in all of them.
    Label,
}

/// What is kept together when frames are dealt out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SplitBy {
    /// All frames of a scene: a test frame never shows a world seen in training.
    Scene,
    /// Models too: each is dealt to one split, and scenes pick among those of their own. A test frame never shows an object
    /// seen in training.
    Asset,
    /// All frames of a variant of the sweep: a test frame never shows settings seen in training.
    Variant,
}

/// A part of a dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Split {
    /// To learn from.
    Train,
    /// To choose by.
    Val,
    /// To be judged by.
    Test,
}

impl Split {
    /// All splits, in the order of files and tables.
    pub const ALL: [Self; 3] = [Self::Train, Self::Val, Self::Test];

    /// Name in recipes, files and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Train => "train",
            Self::Val => "val",
            Self::Test => "test",
        }
    }
}

impl std::fmt::Display for Split {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(self.name())
    }
}

impl Splits {
    /// Each split with its share.
    #[must_use]
    pub fn shares(&self) -> [(Split, f64); 3] {
        [(Split::Train, self.train), (Split::Val, self.val), (Split::Test, self.test)]
    }

    /// The split of a scene. More scenes never move earlier ones.
    ///
    /// Scenes take points of a golden-ratio sequence with a seeded start: any run of them fills the shares evenly, so ten
    /// scenes at 0.8 / 0.1 / 0.1 do not leave a split empty as independent draws often would.
    #[must_use]
    pub fn of_scene(&self, seed: u64, scene: u64) -> Split {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let start = Stream::at(seed, "dataset", 0, "splits").unit();
        let point = start + GOLDEN * scene as f64;
        self.at(point - point.floor())
    }

    /// The split of a thing that stands for itself: a model by its uid, a variant by what it sets. Other things never
    /// move it, so small numbers of things may leave a split empty.
    #[must_use]
    pub fn of_key(&self, seed: u64, key: &str) -> Split {
        self.at(Stream::at(seed, "dataset", 0, &format!("splits/{key}")).unit())
    }

    /// The split at a point of [0, 1) along the shares laid end to end.
    fn at(&self, point: f64) -> Split {
        let point = point * (self.train + self.val + self.test);
        let mut edge = 0.0;
        let with_share = self.shares().into_iter().filter(|(_, share)| *share > 0.0);
        let mut last = Split::Train;
        for (split, share) in with_share {
            edge += share;
            last = split;
            if point < edge {
                break;
            }
        }
        // Rounding at the very end leaves the last split that has a share.
        last
    }

    fn check(&self) -> Result<(), Impossible> {
        let shares = self.shares().map(|(_, share)| share);
        let possible = shares.iter().all(|share| share.is_finite() && *share >= 0.0)
            && (0.0..f64::INFINITY).contains(&shares.iter().sum::<f64>())
            && shares.iter().any(|share| *share > 0.0);
        let help = "shares are 0 or more, and one of them is positive";
        Impossible::unless(possible, "splits", "these shares cannot be dealt out", help)?;
        let dealt = self.stratify == Stratify::None || self.by == SplitBy::Asset;
        let problem = "only models are dealt out by label; the shares of scenes hold within each variant as they are";
        Impossible::unless(dealt, "splits.stratify", problem, "write `by: asset`, or leave out `stratify`")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPLITS: Splits = Splits { train: 0.8, val: 0.1, test: 0.1, by: SplitBy::Scene, stratify: Stratify::None };

    #[test]
    fn shares_come_out_as_asked_even_for_few_scenes() {
        for seed in 0..50 {
            let count = |split| (0..20).filter(|&scene| SPLITS.of_scene(seed, scene) == split).count();
            assert!((15..=17).contains(&count(Split::Train)), "seed {seed}");
            assert!(count(Split::Val) >= 1 && count(Split::Test) >= 1, "seed {seed}");
        }
    }

    #[test]
    fn keys_are_dealt_by_themselves_in_the_shares_asked_for() {
        let count = (0..1000).filter(|i| SPLITS.of_key(7, &format!("starter/{i}")) == Split::Train).count();
        assert!((760..840).contains(&count), "{count}");
        assert_eq!(SPLITS.of_key(7, "starter/tire"), SPLITS.of_key(7, "starter/tire"));
    }

    #[test]
    fn tar_files_hold_some_frames() {
        let (views, raw, fan_height_px) = (vec![View::Polar], Raw::None, 768);
        let output = |tar_frames| Output { views: views.clone(), raw, fan_height_px, pack: Packing::Tar, tar_frames };
        assert!(output(1).check().is_ok() && output(MAX_JOBS).check().is_ok());
        assert!(output(0).check().is_err() && output(u64::MAX).check().is_err());
    }

    #[test]
    fn an_empty_share_gets_nothing() {
        let all = Splits { train: 1.0, val: 0.0, test: 0.0, by: SplitBy::Scene, stratify: Stratify::None };
        assert!((0..1000).all(|scene| all.of_scene(3, scene) == Split::Train));
    }
}
