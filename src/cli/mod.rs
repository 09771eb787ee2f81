//! The command line: one file a verb; each parses, calls the library and prints.
//!
//! Results go to standard output, messages to standard error.

/// Prints a line of results. Whoever reads may stop reading (`ensonify status … | head`): that is no error.
macro_rules! say {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stdout(), $($text)*);
    }};
}

mod catalog;
mod chat;
mod check;
mod diff;
mod draft;
mod edit;
mod finish;
mod job;
mod llm;
mod plan;
mod preview;
mod progress;
mod realism;
mod run;
mod schema;
mod shards;
mod signals;
mod status;
mod table;
mod verify;
mod water;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use crate::plan::PlanError;
use crate::recipe::Outside;
use crate::run::{Given, GivenPlan, Project};

/// Exit codes, the same for every verb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Code {
    /// Done.
    Done = 0,
    /// Invalid recipe, catalog, folder or arguments; nothing was rendered.
    Invalid = 2,
    /// Some frames failed for good; the rest is there.
    FramesFailed = 3,
    /// A verification or comparison found a difference.
    Different = 4,
    /// Stopped before the end; the same command goes on.
    Interrupted = 75,
}

/// Turns a YAML recipe into a labelled sonar dataset.
#[derive(Debug, Parser)]
#[command(
    name = "ensonify",
    version,
    about,
    long_about = "Turns a YAML recipe into a labelled sonar dataset: forward-looking sonar images with masks, boxes and COCO \
                  annotations, byte for byte the same on every machine.",
    after_help = "Begin with:\n  ensonify preview recipes/quickstart.yaml   a picture of what a recipe makes\n  \
                  ensonify run recipes/quickstart.yaml       the dataset, in out/quickstart\n\n\
                  Exit codes: 0 done, 2 invalid recipe, catalog or arguments, 3 some frames failed, 4 a difference was found, 75 interrupted (run again to go on)."
)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Run(run::Run),
    Draft(draft::DraftVerb),
    Check(check::Check),
    Plan(plan::PlanVerb),
    Preview(preview::Preview),
    Edit(edit::Edit),
    Chat(chat::Chat),
    Status(status::StatusVerb),
    Finish(finish::Finish),
    Verify(verify::Verify),
    Diff(diff::Diff),
    Job(job::Job),
    Water(water::WaterVerb),
    Realism(realism::Realism),
    Schema(schema::Schema),
    Catalog(catalog::CatalogVerb),
}

/// A recipe on the command line, or a plan.
#[derive(Debug, Args)]
struct RecipeArgs {
    /// The recipe, a YAML file
    #[arg(required_unless_present = "plan", conflicts_with = "plan")]
    recipe: Option<PathBuf>,
    /// Changes a value of the recipe, such as --set frames=5 or --set water.temperature_c=4
    #[arg(long, value_name = "PATH=VALUE", conflicts_with = "plan")]
    set: Vec<String>,
    /// Lets `include:` read files outside of the recipe's folder
    #[arg(long, conflicts_with = "plan")]
    allow_outside: bool,
    /// Takes a plan instead of a recipe: what `plan --json` writes, or a dataset's plan.json; `-` is standard input
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,
    /// Where relative paths in the plan begin: catalogs, GLB files, height maps [default: the plan's folder]
    #[arg(long, value_name = "DIR", requires = "plan")]
    base: Option<PathBuf>,
}

impl RecipeArgs {
    fn load(&self) -> Result<Project, PlanError> {
        if let Some(path) = &self.plan {
            return Project::load_plan(&GivenPlan { path, base: self.base.as_deref() });
        }
        let outside = if self.allow_outside { Outside::Allowed } else { Outside::Refused };
        Project::load(&Given { path: self.file(), sets: &self.set, outside })
    }

    /// The file that was given.
    fn file(&self) -> &Path {
        let given = self.recipe.as_ref().or(self.plan.as_ref());
        given.expect("the arguments have a recipe or a plan")
    }
}

/// Threads where `--jobs` does not say.
fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// Parses the arguments of this process and does what they say.
#[must_use]
pub fn main() -> ExitCode {
    let outcome = match Cli::parse().verb {
        Verb::Run(verb) => verb.run(),
        Verb::Draft(verb) => verb.run(),
        Verb::Check(verb) => verb.run(),
        Verb::Plan(verb) => verb.run(),
        Verb::Preview(verb) => verb.run(),
        Verb::Edit(verb) => verb.run(),
        Verb::Chat(verb) => verb.run(),
        Verb::Status(verb) => verb.run(),
        Verb::Finish(verb) => verb.run(),
        Verb::Verify(verb) => verb.run(),
        Verb::Diff(verb) => verb.run(),
        Verb::Job(verb) => verb.run(),
        Verb::Water(verb) => verb.run(),
        Verb::Realism(verb) => verb.run(),
        Verb::Schema(verb) => verb.run(),
        Verb::Catalog(verb) => verb.run(),
    };
    let code = outcome.unwrap_or_else(|error| {
        eprintln!("error: {error:#}");
        Code::Invalid
    });
    ExitCode::from(code as u8)
}
