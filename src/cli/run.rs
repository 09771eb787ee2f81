//! `ensonify run`: the main job.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use clap::Args;

use super::progress::Progress;
use super::{Code, RecipeArgs, processors};
use crate::run::{Ended, Options, Project, RunError, run};
use crate::store::{Identity, Status, Store};

/// Renders a recipe or a plan into a dataset
///
/// It is checked whole before anything is written. Frames are written one by one, each complete or not at all:
/// after Ctrl-C, a crash or a power cut the same command goes on where it stopped. The bytes do not depend on --jobs, on
/// interruptions or on the machine.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  ensonify run recipes/quickstart.yaml\n  \
    ensonify run survey.yaml -o /data/survey --jobs 8\n  ensonify run survey.yaml --set seed=8 -o out/survey-8\n  \
    ensonify run --plan survey/plan.json -o out/again")]
pub struct Run {
    #[command(flatten)]
    recipe: RecipeArgs,
    /// Folder of the dataset [default: out/NAME]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Threads that render [default: one a processor]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Render at most so many frames now; the same command again goes on
    #[arg(long, value_name = "N")]
    limit: Option<u64>,
}

/// Set by Ctrl-C: frames in work are finished, then the run ends.
static STOP: AtomicBool = AtomicBool::new(false);

impl Run {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let project = self.recipe.load()?;
        let header = &project.plan.header;
        let folder = self.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&header.name));
        let identity = Identity {
            name: &header.name,
            plan_hash: &project.plan_hash,
            frames: project.plan.jobs.len() as u64,
            recipe_text: project.recipe_text.as_deref(),
            sets: &project.plan.sets,
            includes: &project.includes,
            plan_json: &project.plan_json,
        };
        let store = Store::open(&folder, &identity)?;
        // A second Ctrl-C ends the program at once; a frame cut off is rendered again later.
        ctrlc::set_handler(|| {
            if STOP.swap(true, Ordering::Relaxed) {
                std::process::exit(Code::Interrupted as i32);
            }
            eprintln!("stopping after the frames in work; Ctrl-C again to stop at once");
        })?;
        let threads = self.jobs.map_or_else(processors, usize::from);
        let progress = Progress::new();
        let started = Instant::now();
        let outcome = run(&project, &store, Options { threads, limit: self.limit }, &progress, &STOP);
        progress.end();
        self.report(&project, &store, outcome, started.elapsed().as_secs_f64())
    }

    fn report(
        &self,
        project: &Project,
        store: &Store,
        outcome: Result<Ended, RunError>,
        seconds: f64,
    ) -> anyhow::Result<Code> {
        let folder = store.root().display();
        let go_on = |left: u64| eprintln!("{left} frames are still missing; the same command goes on");
        match outcome {
            Ok(Ended::Complete(summary)) => {
                say!("{}: {} frames, {} annotations", project.plan.header.name, summary.frames, summary.annotations);
                say!("  images       {folder}/images");
                say!("  annotations  {folder}/annotations (COCO)");
                say!("  card         {folder}/README.md");
                say!("  dataset hash {}", summary.dataset_hash);
                say!("  {:.1} MB in {} files, {seconds:.1} s", summary.bytes as f64 / 1e6, summary.files);
                Ok(Code::Done)
            }
            Ok(Ended::Limited(left)) => {
                go_on(left);
                Ok(Code::Done)
            }
            Ok(Ended::Interrupted(left)) => {
                go_on(left);
                Ok(Code::Interrupted)
            }
            Ok(Ended::Failed(failed)) => {
                eprintln!("error: {} frames failed; the first, frame {}: {}", failed.len(), failed[0].0, failed[0].1);
                Ok(Code::FramesFailed)
            }
            Err(error) => {
                // Frames written so far are whole; once the cause is mended the same command goes on.
                eprintln!("error: {error}");
                let done = Status::read(store.root()).map_or(0, |status| status.frames_done);
                eprintln!("{done} frames are safe in {folder}; the same command goes on");
                Ok(Code::Interrupted)
            }
        }
    }
}
