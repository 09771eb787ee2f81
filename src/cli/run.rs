//! `ensonify run`: the main job.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::Context as _;
use clap::Args;

use super::progress::Progress;
use super::shards::ShardArgs;
use super::{Code, RecipeArgs, processors, signals};
use crate::plan::Packing;
use crate::run::{Ended, Options, Project, RunError, finish_facts, run};
use crate::store::{Identity, Pack, Store, Summary, layout};

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
    #[command(flatten)]
    shard: ShardArgs,
    /// Stop when so many frames could not be rendered
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..))]
    max_failures: u64,
    /// Stop at the first frame that cannot be rendered
    #[arg(long, conflicts_with_all = ["max_failures", "keep_going"])]
    fail_fast: bool,
    /// Go on however many frames cannot be rendered
    #[arg(long, conflicts_with = "max_failures")]
    keep_going: bool,
}

impl Run {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let project = self.recipe.load()?;
        let header = &project.plan.header;
        let folder = self.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&header.name));
        let (shard, told) = self.shard.shard()?;
        if let Some(told) = told {
            eprintln!("shard {shard}: {told}");
        }
        let facts = finish_facts(&project);
        let identity = Identity {
            name: &header.name,
            plan_hash: &project.plan_hash,
            frames: project.plan.jobs.len() as u64,
            frames_a_scene: header.frames,
            recipe_text: project.recipe_text.as_deref(),
            pack: (header.output.pack == Packing::Tar).then_some(Pack { tar_frames: header.output.tar_frames }),
            sets: &project.plan.sets,
            includes: &project.includes,
            plan_json: &project.plan_json,
            facts: &facts,
        };
        let store = Store::open(&folder, &identity, shard)?;
        signals::listen().context("cannot listen to signals")?;
        let threads = self.jobs.map_or_else(processors, usize::from);
        let progress = Progress::new();
        let started = Instant::now();
        let options = Options { threads, limit: self.limit, most_failures: self.most_failures() };
        let outcome = run(&project, &store, options, &progress, &signals::STOP);
        progress.end();
        self.report(&project, &store, outcome, started.elapsed().as_secs_f64())
    }

    fn most_failures(&self) -> Option<u64> {
        match (self.fail_fast, self.keep_going) {
            (true, _) => Some(1),
            (_, true) => None,
            _ => Some(self.max_failures),
        }
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
                report_summary(&project.plan.header.name, store.root(), &summary);
                say!("  {seconds:.1} s");
                Ok(Code::Done)
            }
            Ok(Ended::Shard(0)) => {
                say!(
                    "shard {} is there, and so are all others: `ensonify finish {folder}` puts them together",
                    store.shard()
                );
                Ok(Code::Done)
            }
            Ok(Ended::Shard(elsewhere)) => {
                say!(
                    "shard {} is there, {seconds:.1} s; {elsewhere} frames of other shards are not yet",
                    store.shard()
                );
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
                let done = store.dataset().done();
                eprintln!("{done} frames are safe in {folder}; the same command goes on");
                Ok(Code::Interrupted)
            }
        }
    }
}

/// What a finished dataset is and where it lies.
pub(super) fn report_summary(name: &str, root: &Path, summary: &Summary) {
    let folder = root.display();
    say!("{name}: {} frames, {} annotations", summary.frames, summary.annotations);
    let images = if root.join(layout::TARS).is_dir() { layout::TARS } else { "images" };
    say!("  images       {folder}/{images}");
    say!("  annotations  {folder}/annotations (COCO)");
    say!("  card         {folder}/README.md");
    say!("  dataset hash {}", summary.dataset_hash);
    say!("  {:.1} MB in {} files", summary.bytes as f64 / 1e6, summary.files);
}
