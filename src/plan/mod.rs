//! Recipe → jobs: every leaf drawn, every choice made, before anything is rendered.
//!
//! Knows what is to be done, to the last number; does none of it.

mod compile;
mod corners;
mod deal;
mod error;
mod header;
mod lock;
mod looks;
mod origin;
mod read;
mod schema;
mod sections;
mod verify;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

pub use compile::{compile, notes};
pub use corners::{Tried, corners};
pub use error::{PlanError, PlanFault};
pub use header::{Header, Output, Packing, Raw, Split, SplitBy, Splits, Stratify};
pub use lock::{AssetLock, Shown};
pub use origin::{Origin, Origins};
pub use read::read;
pub use schema::schema;

use crate::image::ImageModel;
use crate::physics::TurbidWater;
use crate::recipe::Draws;
use crate::scene::SceneSpec;
use crate::sonar::Sonar;
use crate::vehicle::{Trajectory, Vehicle};

/// Whether a sweep may vary a section.
pub(crate) fn is_swept(section: &str) -> bool {
    sections::SWEPT.contains(&section)
}

/// Every job of a dataset, with every drawn value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// Version of the program: another version may draw or render other bytes.
    pub ensonify: &'static str,
    /// Changes that were made to the recipe, `path=value`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sets: Vec<String>,
    /// What holds for all jobs.
    #[serde(flatten)]
    pub header: Header,
    /// What a sweep makes of the recipe, in order; nothing without a sweep.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<VariantPlan>,
    /// Models that the scenes use, by `catalog/uid`.
    pub assets: BTreeMap<String, AssetLock>,
    /// The worlds: all scenes of the first variant, then of the next.
    pub scenes: Vec<ScenePlan>,
    /// The frames, in order; a job's id is its index.
    pub jobs: Vec<Job>,
}

/// One variant of a swept recipe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VariantPlan {
    /// Its name in file names and tables: `v000`, `v001` ….
    pub id: String,
    /// What is set, in words.
    pub description: String,
    /// What is set, by path.
    pub set: BTreeMap<String, serde_json::Value>,
    /// Number of the repeat, where there are several.
    pub repeat: Option<u64>,
    /// Seed of its draws: the recipe's, but for repeats after the first.
    pub seed: u64,
}

/// One drawn world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenePlan {
    /// Its variant, where there is a sweep.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Number of the scene in its variant.
    pub index: u64,
    /// Seed of its draws.
    pub seed: u64,
    /// Its split.
    pub split: Split,
    /// What to build.
    pub spec: SceneSpec,
    /// What was drawn for it, by path.
    pub drawn: Draws,
}

/// A way to make a picture of a ping's echoes: other water, other gain, another model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Look {
    /// Its name in file names and tables; none where a recipe has no `looks`.
    pub name: Option<String>,
    /// The water.
    pub water: TurbidWater,
    /// How echoes become a picture.
    pub image: ImageModel,
}

/// One frame to render.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    /// Number of the job, and of its files.
    pub id: u64,
    /// Its variant, where there is a sweep.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Number of its scene in its variant.
    pub scene: u64,
    /// Number of the frame in its scene.
    pub frame: u64,
    /// Split of its scene.
    pub split: Split,
    /// The sonar.
    pub sonar: Sonar,
    /// Pictures of the same echoes, at least one.
    pub looks: Vec<Look>,
    /// What holds of the vehicle on any way.
    pub vehicle: Vehicle,
    /// Where the vehicle goes.
    pub trajectory: Trajectory,
    /// What was drawn for this frame, by path, its scene's draws not repeated.
    pub drawn: Draws,
}

impl Plan {
    /// Index in [`Plan::scenes`] of a job's world.
    #[must_use]
    pub fn world_of(&self, job: &Job) -> usize {
        // Jobs stand in the order of the scenes, so many to each.
        (job.id / self.header.frames) as usize
    }

    /// The world of a job.
    #[must_use]
    pub fn scene_of(&self, job: &Job) -> &ScenePlan {
        &self.scenes[self.world_of(job)]
    }

    /// The frames of a world, in order.
    #[must_use]
    pub fn jobs_of(&self, world: usize) -> &[Job] {
        let frames = self.header.frames as usize;
        self.jobs.get(world * frames..(world + 1) * frames).unwrap_or_default()
    }

    /// The plan as JSON: what is written to `plan.json`, and what is hashed.
    ///
    /// # Panics
    /// Never: every map in a plan has text keys and every number is finite.
    #[must_use]
    pub fn json(&self) -> Vec<u8> {
        let mut text = serde_json::to_vec_pretty(self).expect("a plan is plain data");
        text.push(b'\n');
        text
    }

    /// SHA-256 of [`Plan::json`], in hexadecimal: two runs with one plan hash make the same dataset.
    #[must_use]
    pub fn hash(json: &[u8]) -> String {
        Sha256::digest(json).iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Labels in alphabetical order: the categories of the annotations.
    #[must_use]
    pub fn planned_labels(&self) -> Vec<String> {
        let bodies = self.scenes.iter().flat_map(|scene| &scene.spec.bodies);
        let labels: std::collections::BTreeSet<_> = bodies.map(|body| body.label.clone()).collect();
        labels.into_iter().collect()
    }
}
