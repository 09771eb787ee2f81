//! `ensonify plan`: every job with its drawn values.

use std::io::{self, Write as _};

use anyhow::Context as _;
use clap::Args;

use super::{Code, RecipeArgs};
use crate::plan::{Job, Plan};

/// Shows every job of a recipe with its drawn values
///
/// One line a frame. With --explain, everything about one frame: its scene's specification and its own. With --json, the
/// plan as `run` writes it to plan.json.
#[derive(Debug, Args)]
pub struct PlanVerb {
    #[command(flatten)]
    recipe: RecipeArgs,
    /// Everything about one frame
    #[arg(long, value_name = "ID", conflicts_with = "json")]
    explain: Option<u64>,
    /// The whole plan as JSON
    #[arg(long)]
    json: bool,
}

impl PlanVerb {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let project = self.recipe.load()?;
        let plan = &project.plan;
        let mut out = io::stdout().lock();
        let written = if self.json {
            out.write_all(&project.plan_json)
        } else if let Some(id) = self.explain {
            let last = plan.jobs.len() - 1;
            let job =
                plan.jobs.get(id as usize).with_context(|| format!("there is no frame {id}; the last is {last}"))?;
            explain(&mut out, plan, job)
        } else {
            writeln!(out, "plan hash {}", project.plan_hash).and_then(|()| table(&mut out, plan))
        };
        match written {
            // Whoever reads has seen enough (`ensonify plan … | head`).
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(Code::Done),
            written => Ok(written.map(|()| Code::Done)?),
        }
    }
}

fn table(out: &mut dyn io::Write, plan: &Plan) -> io::Result<()> {
    for job in &plan.jobs {
        write!(out, "{:06}", job.id)?;
        if let Some(variant) = &job.variant {
            write!(out, " {variant}")?;
        }
        write!(out, " scene {} frame {} {}", job.scene, job.frame, job.split)?;
        let scene = plan.scene_of(job);
        for (path, value) in scene.drawn.iter().chain(&job.drawn) {
            write!(out, " {path}={value}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn explain(out: &mut dyn io::Write, plan: &Plan, job: &Job) -> io::Result<()> {
    let scene = plan.scene_of(job);
    writeln!(out, "frame {:06}: frame {} of scene {}, split {}", job.id, job.frame, job.scene, job.split)?;
    if let Some(variant) = plan.variants.iter().find(|variant| Some(&variant.id) == job.variant.as_ref()) {
        writeln!(out, "variant {}: {}", variant.id, variant.description)?;
    }
    writeln!(out, "\ndrawn for the scene:")?;
    scene.drawn.iter().try_for_each(|(path, value)| writeln!(out, "  {path} = {value}"))?;
    writeln!(out, "\ndrawn for the frame:")?;
    job.drawn.iter().try_for_each(|(path, value)| writeln!(out, "  {path} = {value}"))?;
    writeln!(out, "\nscene: {}", serde_json::to_string_pretty(&scene.spec)?)?;
    writeln!(out, "\nframe: {}", serde_json::to_string_pretty(job)?)
}
