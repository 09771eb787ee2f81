//! `ensonify check`: everything that `run` would refuse, before anything is rendered.

use std::collections::{BTreeMap, BTreeSet};

use clap::Args;

use super::{Code, RecipeArgs};
use crate::catalog::solidity::facet_error;
use crate::image::Channel;
use crate::image::reach::REACH_SEABED_DB;
use crate::physics::absorption::francois_garrison;
use crate::plan::Plan;
use crate::run::{Project, World};

/// Speed of sound that resolutions are told by, m/s.
const NOMINAL_SPEED: f64 = 1500.0;
/// Most notes of a kind.
const MOST_NOTES: usize = 8;

/// Checks a recipe without rendering anything
///
/// Draws every scene and frame, opens every catalog and model that is picked and builds the first scene. What passes here
/// is not refused by `run`.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    recipe: RecipeArgs,
}

impl Check {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let project = self.recipe.load()?;
        let plan = &project.plan;
        let world = World::build(&plan.scenes[0], &project.assets)?;
        let mut labels: BTreeMap<&str, u64> = BTreeMap::new();
        for body in plan.scenes.iter().flat_map(|scene| &scene.spec.bodies) {
            *labels.entry(&body.label).or_default() += 1;
        }
        let mut splits: BTreeMap<&str, u64> = BTreeMap::new();
        plan.jobs.iter().for_each(|job| *splits.entry(job.split.name()).or_default() += 1);
        let list = |counts: &BTreeMap<&str, u64>| {
            counts.iter().map(|(name, count)| format!("{name} {count}")).collect::<Vec<_>>().join(", ")
        };
        say!("{} is fine", self.recipe.recipe.display());
        say!("  scenes    {}", plan.header.scenes);
        if !plan.variants.is_empty() {
            say!("  variants  {}", plan.variants.len());
            plan.variants.iter().for_each(|variant| say!("    {}  {}", variant.id, variant.description));
        }
        say!("  frames    {} ({})", plan.jobs.len(), list(&splits));
        say!("  objects   {}", if labels.is_empty() { "none".to_owned() } else { list(&labels) });
        say!("  models    {}", plan.assets.len());
        say!("  plan hash {}", project.plan_hash);
        for (split, share) in plan.header.splits.shares() {
            if share > 0.0 && !splits.contains_key(split.name()) {
                eprintln!("note: no scene falls into the split {split}; more scenes fill it");
            }
        }
        let notes = project.notes.iter().map(ToString::to_string);
        for note in notes.chain(acoustic_notes(plan)).chain(model_notes(&project)) {
            eprintln!("note: {note}");
        }
        for dropped in &world.built().dropped {
            eprintln!("note: scene 0: {} is left out: {}", dropped.asset, dropped.reason);
        }
        Ok(Code::Done)
    }
}

/// Models that are coarser than the sonars resolve: their facets glint where the thing itself is round.
fn model_notes(project: &Project) -> BTreeSet<String> {
    let bandwidth = project.plan.jobs.iter().map(|job| job.sonar.bandwidth_khz).fold(0.0, f64::max);
    let resolution = NOMINAL_SPEED / (2.0 * 1000.0 * bandwidth.max(1e-3));
    let bodies = project.plan.scenes.iter().flat_map(|scene| &scene.spec.bodies);
    let models: BTreeSet<(&str, &str)> = bodies.map(|body| (body.catalog.as_str(), body.uid.as_str())).collect();
    let coarse = models.into_iter().filter_map(|(catalog, uid)| {
        let solid = project.assets.solid(catalog, uid).ok()?;
        let error = facet_error(solid.mesh.triangles());
        (error > resolution).then(|| {
            format!(
                "{catalog}/{uid} is coarse: its facets depart by {:.1} cm from the round shape that they stand for, and the sonar \
                 resolves {:.1} cm in range",
                100.0 * error,
                100.0 * resolution
            )
        })
    });
    coarse.take(MOST_NOTES).collect()
}

/// What an acoustician would say of a plan's sonars and waters; each thing once.
fn acoustic_notes(plan: &Plan) -> BTreeSet<String> {
    let mut notes = BTreeSet::new();
    for job in &plan.jobs {
        let (sonar, far) = (&job.sonar, job.sonar.range_m[1]);
        let name = sonar.device.as_deref().unwrap_or("the sonar");
        for look in &job.looks {
            let reach = Channel::new(sonar, &look.water).reach_m();
            if far > reach {
                notes.insert(format!(
                    "{name} hears a seabed of {REACH_SEABED_DB} dB only to about {reach:.0} m: beyond it, up to its range_m of \
                     {far} m, images show noise"
                ));
            }
            for outside in francois_garrison(sonar.frequency_khz, &look.water.water).outside {
                notes.insert(format!("absorption is carried beyond its stated range: {outside}"));
            }
        }
        if notes.len() >= MOST_NOTES {
            break;
        }
    }
    notes
}
