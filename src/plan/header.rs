//! What holds for a whole dataset.

use serde::{Deserialize, Serialize};

use crate::label::{LabelSettings, View};
use crate::math::rng::Stream;

/// Sections of a recipe that are the same for every frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Header {
    /// Name of the dataset.
    pub name: String,
    /// Seed of every draw.
    pub seed: u64,
    /// Independent draws of the world.
    pub scenes: u64,
    /// Frames a scene.
    pub frames: u64,
    /// When a body is labelled.
    pub labels: LabelSettings,
    /// How frames are dealt out.
    pub splits: Splits,
    /// What is written for each frame.
    pub output: Output,
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
}

/// What is kept together when frames are dealt out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SplitBy {
    /// All frames of a scene: a test frame never shows a world seen in training.
    Scene,
}

impl Splits {
    /// Names of the splits, in the order of files and tables.
    pub const NAMES: [&'static str; 3] = ["train", "val", "test"];

    /// The split of a scene. More scenes never move earlier ones.
    ///
    /// Scenes take points of a golden-ratio sequence with a seeded start: any run of them fills the shares evenly, so ten
    /// scenes at 0.8 / 0.1 / 0.1 do not leave a split empty as independent draws often would.
    #[must_use]
    pub fn of_scene(&self, seed: u64, scene: u64) -> &'static str {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let start = Stream::at(seed, "dataset", 0, "splits").unit();
        let point = start + GOLDEN * scene as f64;
        let point = (point - point.floor()) * (self.train + self.val + self.test);
        let mut edge = 0.0;
        for (name, share) in Self::NAMES.into_iter().zip([self.train, self.val, self.test]) {
            edge += share;
            if point < edge {
                return name;
            }
        }
        // Rounding at the very end: the last split that has a share.
        if self.test > 0.0 {
            "test"
        } else if self.val > 0.0 {
            "val"
        } else {
            "train"
        }
    }

    /// Whether the shares can be dealt out: none negative, some positive.
    #[must_use]
    pub fn possible(&self) -> bool {
        let shares = [self.train, self.val, self.test];
        shares.iter().all(|share| share.is_finite() && *share >= 0.0) && shares.iter().sum::<f64>() > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPLITS: Splits = Splits { train: 0.8, val: 0.1, test: 0.1, by: SplitBy::Scene };

    #[test]
    fn shares_come_out_as_asked_even_for_few_scenes() {
        for seed in 0..50 {
            let count = |name| (0..20).filter(|&scene| SPLITS.of_scene(seed, scene) == name).count();
            assert!((15..=17).contains(&count("train")), "seed {seed}");
            assert!(count("val") >= 1 && count("test") >= 1, "seed {seed}");
        }
    }

    #[test]
    fn an_empty_share_gets_nothing() {
        let all = Splits { train: 1.0, val: 0.0, test: 0.0, by: SplitBy::Scene };
        assert!((0..1000).all(|scene| all.of_scene(3, scene) == "train"));
    }
}
