//! A plan from its JSON: what `ensonify plan --json` wrote, or a person or another program did.
//!
//! Whatever stands in it is taken or refused with its place; what it may say is what a recipe may.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::verify::Verifier;
use super::{AssetLock, Header, Job, Output, Plan, PlanError, PlanFault, ScenePlan, Splits, VariantPlan};
use crate::catalog::LicencePolicy;
use crate::label::LabelSettings;
use crate::scene::AssetCache;

/// Reads a plan. `name` stands in messages; `assets` finds catalogs and files.
///
/// Models and files that the scenes use are loaded and held against the plan's hashes; those without one get it. Hashes
/// that nothing uses are dropped. So a plan may be edited, and reading what was written gives the same plan.
///
/// # Errors
/// The first fault: no JSON, another version's plan, unknown or missing keys, numbers that a recipe may not have either,
/// scenes and jobs that contradict each other, models that are missing or changed.
pub fn read(name: &str, json: &[u8], folder: &Path, assets: &AssetCache) -> Result<Plan, PlanError> {
    version(name, json)?;
    let file: File = typed(name, json)?;
    let plan = Plan {
        ensonify: env!("CARGO_PKG_VERSION"),
        sets: file.sets,
        header: Header {
            name: file.name,
            seed: file.seed,
            scenes: file.scenes_per_variant,
            frames: file.frames_per_scene,
            licences: file.licences,
            labels: file.labels,
            splits: file.splits,
            output: file.output,
        },
        variants: file.variants,
        assets: file.assets,
        scenes: file.scenes,
        jobs: file.jobs,
    };
    Ok(Verifier { name, folder, assets }.verified(plan)?)
}

/// A plan as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// Looked at before.
    #[serde(rename = "ensonify")]
    _version: String,
    #[serde(default)]
    sets: Vec<String>,
    name: String,
    seed: u64,
    scenes_per_variant: u64,
    frames_per_scene: u64,
    #[serde(default)]
    licences: LicencePolicy,
    labels: LabelSettings,
    splits: Splits,
    output: Output,
    #[serde(default)]
    variants: Vec<VariantPlan>,
    assets: BTreeMap<String, AssetLock>,
    scenes: Vec<ScenePlan>,
    jobs: Vec<Job>,
}

/// Refuses the plan of another version before its form is looked at: that may differ.
fn version(name: &str, json: &[u8]) -> Result<(), PlanFault> {
    #[derive(Deserialize)]
    struct Stamp {
        ensonify: String,
    }
    let ours = env!("CARGO_PKG_VERSION");
    let stamp: Stamp = typed(name, json)?;
    if stamp.ensonify == ours {
        return Ok(());
    }
    Err(PlanFault {
        file: name.to_owned(),
        place: "ensonify".to_owned(),
        problem: format!("the plan is of version {}, this program is {ours}", stamp.ensonify),
        help: "run it with that version, or make it anew from its recipe with `ensonify plan RECIPE --json`".to_owned(),
    })
}

fn typed<'de, T: Deserialize<'de>>(name: &str, json: &'de [u8]) -> Result<T, PlanFault> {
    let mut reader = serde_json::Deserializer::from_slice(json);
    let fault = |error: &serde_json::Error, place: String| {
        let at = format!(" at line {} column {}", error.line(), error.column());
        let problem = error.to_string();
        let problem = problem.strip_suffix(&at).unwrap_or(&problem).to_owned();
        let help = match error.classify() {
            serde_json::error::Category::Eof => "the file is cut off: copy or write it again",
            serde_json::error::Category::Syntax => "a plan is JSON, as `ensonify plan RECIPE --json` writes it",
            serde_json::error::Category::Data | serde_json::error::Category::Io => {
                "compare with what `ensonify plan RECIPE --json` writes"
            }
        };
        let file = match error.line() {
            0 => name.to_owned(),
            line => format!("{name}:{line}:{}", error.column()),
        };
        PlanFault { file, place, problem, help: help.to_owned() }
    };
    let value = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let place = error.path().to_string();
        fault(error.inner(), if place == "." { String::new() } else { place })
    })?;
    reader.end().map_err(|error| fault(&error, String::new()))?;
    Ok(value)
}
