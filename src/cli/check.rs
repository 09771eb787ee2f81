//! `ensonify check`: everything that `run` would refuse, before anything is rendered.

use std::collections::BTreeMap;

use clap::Args;

use super::{Code, RecipeArgs};
use crate::run::World;

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
        for note in &project.notes {
            eprintln!("note: {note}");
        }
        for dropped in &world.built().dropped {
            eprintln!("note: scene 0: {} is left out: {}", dropped.asset, dropped.reason);
        }
        Ok(Code::Done)
    }
}
