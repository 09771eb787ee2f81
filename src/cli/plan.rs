//! `ensonify plan`: every job with its drawn values.

use std::io::{self, Write as _};

use anyhow::Context as _;
use clap::Args;

use super::{Code, RecipeArgs};
use crate::math::real::degrees;
use crate::plan::{Job, Origin, Origins, Plan};
use crate::run::render::pose_numbers;
use crate::run::{Place, Project, World};

/// Shows every job of a recipe or a plan with its drawn values
///
/// One line a frame. With --explain, everything about one frame: what was drawn, from which distribution of the recipe and
/// how often, where its objects are, its scene's specification and its own. With --json, the plan as `run` writes it to
/// plan.json and takes it with --plan.
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
            // Whole before it is shown, as its errors are not those of the reader's pipe.
            let mut text = Vec::new();
            explain(&mut text, &project, job)?;
            out.write_all(&text)
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

fn explain(out: &mut dyn io::Write, project: &Project, job: &Job) -> anyhow::Result<()> {
    let plan = &project.plan;
    let scene = plan.scene_of(job);
    writeln!(out, "frame {:06}: frame {} of scene {}, split {}", job.id, job.frame, job.scene, job.split)?;
    let variant = plan.variants.iter().position(|variant| Some(&variant.id) == job.variant.as_ref());
    if let Some(variant) = variant.map(|number| &plan.variants[number]) {
        writeln!(out, "variant {}: {}", variant.id, variant.description)?;
    }
    // A plan that was given says what was drawn, not from what.
    let of = |recipe| Origins::of(recipe, variant.unwrap_or(0), &project.folder);
    let origins = project.recipe.as_ref().map(of).transpose()?;
    for (whose, draws) in [("scene", &scene.drawn), ("frame", &job.drawn)] {
        writeln!(out, "\ndrawn for the {whose}:")?;
        for (path, value) in draws {
            let origin = origins.as_ref().and_then(|origins| origins.origin(path));
            let from = origin.map(|Origin { law, often, place }| format!("   from {law}, {often}, {place}"));
            writeln!(out, "  {path} = {value}{}", from.unwrap_or_default())?;
        }
    }
    objects(out, project, job)?;
    writeln!(out, "\nscene: {}", serde_json::to_string_pretty(&scene.spec)?)?;
    writeln!(out, "\nframe: {}", serde_json::to_string_pretty(job)?)?;
    Ok(())
}

/// The bodies of a frame's world, and where its sonar has them.
fn objects(out: &mut dyn io::Write, project: &Project, job: &Job) -> anyhow::Result<()> {
    let plan = &project.plan;
    let world = World::build(plan.scene_of(job), &project.assets)?;
    let pose = world.sonar_pose(&plan.header, job)?;
    let [x, y, z, yaw, pitch, roll] = pose_numbers(&pose);
    writeln!(out, "\nsonar at x {x:.2}, y {y:.2}, z {z:.2} m, yaw {yaw:.1}, pitch {pitch:.1}, roll {roll:.1} degrees")?;
    for (number, body) in world.scene().bodies.iter().enumerate() {
        let Place { range_m, bearing_rad, size_m, view } = Place::of(&job.sonar, &pose, body);
        let ([x, y, z], bearing) = (body.centre.to_array(), degrees(bearing_rad));
        writeln!(
            out,
            "  {} {} ({}), {size_m:.2} m, at x {x:.2}, y {y:.2}, z {z:.2} m: range {range_m:.2} m, bearing {bearing:.1}, {}",
            number + 1,
            body.label,
            body.asset,
            view.name()
        )?;
    }
    for dropped in &world.built().dropped {
        writeln!(out, "  {} ({}) is left out: {}", dropped.label, dropped.asset, dropped.reason)?;
    }
    Ok(())
}
