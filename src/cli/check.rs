//! `ensonify check`: everything that `run` would refuse, before anything is rendered, and what a run will take.

use std::collections::BTreeMap;

use clap::Args;
use serde::Serialize;

use super::{Code, RecipeArgs, processors};
use crate::plan::{Plan, Tried};
use crate::run::warnings::{self, Warning};
use crate::run::{Project, Survey, survey, trial};

/// Checks a recipe or a plan and tells what it makes
///
/// Draws every scene and frame, then every distribution at its ends, and opens every model that could be picked: what passes
/// here is not refused by `run`, with another seed or more scenes neither. Then builds some scenes and renders up to three
/// frames, without writing anything, for warnings and estimates.
#[derive(Debug, Args)]
#[command(after_help = "Warnings (notes, on standard error) do not change the exit code.\n\nExamples:\n  \
    ensonify check survey.yaml\n  ensonify check survey.yaml --json | jq .estimate.seconds")]
pub struct Check {
    #[command(flatten)]
    recipe: RecipeArgs,
    /// Builds and renders nothing: no estimates, no warnings about what is in view
    #[arg(long)]
    quick: bool,
    /// Threads that the estimate is for [default: one a processor]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

/// What a recipe makes.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    name: String,
    plan_hash: String,
    variants: u64,
    scenes: u64,
    frames: u64,
    /// Names of looks; none where there is but one without a name.
    looks: Vec<String>,
    /// Pictures of all frames, looks and views.
    images: u64,
    /// Frames by split.
    splits: BTreeMap<&'static str, u64>,
    /// Objects in the scenes by class.
    objects: BTreeMap<String, u64>,
    /// Models and other files in the plan.
    models: u64,
    /// Models that could be picked, all of them opened; 0 of a plan.
    models_possible: u64,
    /// Ends of distributions that were tried; 0 of a plan.
    corners: u64,
    /// Ends that there are.
    corners_in_all: u64,
    estimate: Option<Estimate>,
    warnings: Vec<Warning>,
}

/// What a run will take.
#[derive(Debug, Serialize)]
struct Estimate {
    threads: u64,
    seconds: f64,
    bytes: u64,
    /// Frames that were rendered for it.
    frames_timed: u64,
    seconds_per_frame: f64,
    seconds_per_scene: f64,
}

impl Check {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let project = self.recipe.load()?;
        let looked = if self.quick { Looked::Nowhere } else { Looked::AtScenes };
        let report = Report::on(&project, looked, self.jobs)?;
        if self.json {
            say!("{}", serde_json::to_string_pretty(&report)?);
            return Ok(Code::Done);
        }
        say!("{} is fine", self.recipe.file().display());
        report.lines(&project.plan).into_iter().for_each(|line| say!("{line}"));
        report.notes(&project).into_iter().for_each(|note| eprintln!("note: {note}"));
        Ok(Code::Done)
    }
}

/// What of a plan is looked at beside its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Looked {
    /// Some scenes are built, some frames rendered.
    AtScenes,
    /// Nothing is.
    Nowhere,
}

impl Estimate {
    fn of(project: &Project, found: &Survey, jobs: Option<u16>) -> anyhow::Result<Self> {
        let timed = trial(project)?;
        let (frames, scenes) = (project.plan.jobs.len() as f64, project.plan.scenes.len() as f64);
        let threads = jobs.map_or_else(processors, usize::from);
        let seconds_per_scene = found.building_s / found.scenes.max(1) as f64;
        let work = frames * timed.frame_s + scenes * seconds_per_scene;
        // More threads than processors do not help, nor more than frames.
        let abreast = threads.min(processors()) as f64;
        Ok(Self {
            threads: threads as u64,
            seconds: work / abreast.min(frames),
            bytes: (frames * timed.frame_bytes) as u64 + project.plan_json.len() as u64,
            frames_timed: timed.frames,
            seconds_per_frame: timed.frame_s,
            seconds_per_scene,
        })
    }
}

impl Report {
    /// What is to be said of a project that can be run.
    ///
    /// # Errors
    /// The first thing that a run would refuse.
    pub(super) fn on(project: &Project, looked: Looked, jobs: Option<u16>) -> anyhow::Result<Self> {
        let tried = project.try_corners()?;
        let mut report = Self::of(project, tried);
        if looked == Looked::AtScenes {
            let found = survey(project)?;
            report.estimate = Some(Estimate::of(project, &found, jobs)?);
            report.warnings.extend(warnings::of_models(&project.plan, &project.assets));
            report.warnings.extend(warnings::of_survey(&found));
        }
        Ok(report)
    }

    /// Notes on what can be run and may not be what was meant.
    pub(super) fn notes(&self, project: &Project) -> Vec<String> {
        let notes = project.notes.iter().map(ToString::to_string);
        notes.chain(self.warnings.iter().map(|warning| warning.text.clone())).collect()
    }

    /// Counts, time and disk, a line each.
    pub(super) fn lines(&self, plan: &Plan) -> Vec<String> {
        let report = self;
        let mut lines = Vec::new();
        let mut add = |line: String| lines.push(line);
        let list = |counts: Vec<(&str, u64)>| {
            counts.iter().map(|(name, count)| format!("{name} {count}")).collect::<Vec<_>>().join(", ")
        };
        let splits = list(report.splits.iter().map(|(name, count)| (*name, *count)).collect());
        let objects = list(report.objects.iter().map(|(name, count)| (name.as_str(), *count)).collect());
        add(format!("  scenes    {}", report.scenes));
        if !plan.variants.is_empty() {
            add(format!("  variants  {}", report.variants));
            plan.variants.iter().for_each(|variant| add(format!("    {}  {}", variant.id, variant.description)));
        }
        add(format!("  frames    {} ({splits})", report.frames));
        if !report.looks.is_empty() {
            add(format!("  looks     {} ({})", report.looks.len(), report.looks.join(", ")));
        }
        add(format!("  images    {}", report.images));
        add(format!("  objects   {}", if objects.is_empty() { "none" } else { &objects }));
        let possible = match report.models_possible {
            0 => String::new(),
            possible => format!("; {possible} that could be picked can be read"),
        };
        add(format!("  models    {}{possible}", report.models));
        if report.corners > 0 {
            let all = report.corners_in_all;
            let of = if all > report.corners { format!(" of {all}") } else { String::new() };
            add(format!("  corners   {}{of} ends of distributions tried", report.corners));
        }
        if let Some(estimate) = &report.estimate {
            let Estimate { threads, seconds, frames_timed, seconds_per_frame, bytes, .. } = estimate;
            let (time, each) = (duration(*seconds), duration(*seconds_per_frame));
            add(format!(
                "  time      about {time} with {threads} threads ({each} a frame on one; {frames_timed} timed)"
            ));
            add(format!("  disk      about {}", size(*bytes as f64)));
        }
        add(format!("  plan hash {}", report.plan_hash));
        lines
    }

    fn of(project: &Project, tried: Tried) -> Self {
        let plan = &project.plan;
        let mut objects: BTreeMap<String, u64> = BTreeMap::new();
        for body in plan.scenes.iter().flat_map(|scene| &scene.spec.bodies) {
            *objects.entry(body.label.clone()).or_default() += 1;
        }
        let mut splits: BTreeMap<&'static str, u64> = BTreeMap::new();
        plan.jobs.iter().for_each(|job| *splits.entry(job.split.name()).or_default() += 1);
        let looks = plan.jobs.first().map_or(&[][..], |job| &job.looks);
        let views = plan.header.output.views.len() as u64;
        Self {
            name: plan.header.name.clone(),
            plan_hash: project.plan_hash.clone(),
            variants: plan.variants.len().max(1) as u64,
            scenes: plan.scenes.len() as u64,
            frames: plan.jobs.len() as u64,
            looks: looks.iter().filter_map(|look| look.name.clone()).collect(),
            images: plan.jobs.len() as u64 * looks.len() as u64 * views,
            splits,
            objects,
            models: plan.assets.len() as u64,
            models_possible: tried.models as u64,
            corners: tried.corners as u64,
            corners_in_all: tried.corners_in_all as u64,
            estimate: None,
            warnings: warnings::of_plan(plan),
        }
    }
}

/// A time for people.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => format!("{:.0} ms", 1000.0 * s),
        s if s < 100.0 => format!("{s:.1} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

/// A length for people.
fn size(bytes: f64) -> String {
    if bytes < 1e9 { format!("{:.1} MB", bytes / 1e6) } else { format!("{:.1} GB", bytes / 1e9) }
}
