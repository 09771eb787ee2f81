//! `ensonify draft`: a recipe from a sentence.

use std::io::{IsTerminal as _, Read as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::Args;
use serde_json::json;

use super::Code;
use super::check::{Looked, Report};
use super::llm::LlmArgs;
use crate::draft::transcript::Transcript;
use crate::draft::{Draft, Drafter, Known, Options, Prompt};
use crate::run::Project;

/// Longest prompt that is read from standard input, bytes.
const LONGEST: u64 = 1 << 20;

/// Drafts a recipe from a sentence
///
/// Says what is to be in the images, and gets a recipe with a comment on each line: which words led to it, or what was assumed
/// and why. Offline, the same sentence gives the same recipe. The draft is checked as any recipe is.
#[derive(Debug, Args)]
#[command(
    after_help = "The recipe goes to standard output, or with -o into a file; what there is to say of it to standard error.\n\n\
                        Examples:\n  ensonify draft \"300 images of two tires and an anchor on a sandy bottom at 12 m depth\" -o tires.yaml\n  \
                        ensonify preview tires.yaml"
)]
pub struct DraftVerb {
    /// What the dataset is to show; `-`, or nothing where something is piped in, reads standard input
    prompt: Option<String>,
    /// Writes the recipe into a file instead of to standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replaces the file if it is there
    #[arg(long, requires = "output")]
    force: bool,
    /// Frames in all, whatever the prompt says
    #[arg(short = 'n', long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    images: Option<u64>,
    /// Random seed
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Name of the dataset
    #[arg(long)]
    name: Option<String>,
    /// Sonar: a device such as oculus-m1200d-lf
    #[arg(long, value_name = "DEVICE")]
    sonar: Option<String>,
    /// A catalog to find models in, a name under `catalogs/` or a folder; may be given several times [default: all near the file]
    #[arg(short, long, value_name = "NAME|DIR")]
    catalog: Vec<String>,
    #[command(flatten)]
    llm: LlmArgs,
    /// Builds and renders nothing: no estimates, no notes on what is in view
    #[arg(long)]
    quick: bool,
    /// The recipe, what was understood and what `check` says, as JSON with stable names
    #[arg(long)]
    json: bool,
}

impl DraftVerb {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        self.may_be_written()?;
        let options =
            Options { images: self.images, seed: self.seed, name: self.name.clone(), sonar: self.sonar.clone() };
        let prompt = Prompt::new(&self.typed()?, options);
        let folder = self.folder();
        let known = Known::open(&folder, &self.catalog)?;
        if known.catalogs.is_empty() {
            bail!(
                "no catalog is found from {}\nhelp: recipes find catalogs under `catalogs/` in their folder and those above it; \
                 put the recipe there with -o, or name a catalog with --catalog",
                folder.display()
            );
        }
        let mut drafter = self.llm.drafter()?.map_or(Drafter::BuiltIn, |model| Drafter::Model(Box::new(model)));
        let draft = drafter.draft(&prompt, &known)?;
        let project = Project::of_text(&self.file_name(), &draft.recipe, &folder).context("the draft is no recipe")?;
        let looked = if self.quick { Looked::Nowhere } else { Looked::AtScenes };
        let report = Report::on(&project, looked, None).context("the draft cannot be run")?;
        if let Some(path) = &self.output {
            write_whole(path, &draft.recipe).with_context(|| format!("cannot write {}", path.display()))?;
            let transcript = Transcript::beside(path);
            let told = transcript.add(&draft.entry("draft"));
            told.with_context(|| format!("cannot write {}", transcript.path().display()))?;
        }
        self.tell(&draft, &project, &report)?;
        Ok(Code::Done)
    }

    fn may_be_written(&self) -> anyhow::Result<()> {
        let Some(path) = self.output.as_ref().filter(|path| path.exists() && !self.force) else { return Ok(()) };
        bail!("{} is there already\nhelp: give another file, or replace it with --force", path.display())
    }

    fn typed(&self) -> anyhow::Result<String> {
        match self.prompt.as_deref() {
            Some(typed) if typed != "-" => return Ok(typed.to_owned()),
            None if std::io::stdin().is_terminal() => {
                bail!("what is to be drafted?\nhelp: write for example: ensonify draft \"100 images of a tire on mud\"")
            }
            _ => {}
        }
        let mut bytes = Vec::new();
        std::io::stdin().take(LONGEST).read_to_end(&mut bytes).context("cannot read standard input")?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// The folder that the recipe is for.
    fn folder(&self) -> PathBuf {
        match self.output.as_deref().and_then(Path::parent) {
            Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
            _ => PathBuf::from("."),
        }
    }

    fn file_name(&self) -> String {
        let name = self.output.as_deref().and_then(Path::file_name);
        name.map_or_else(|| "draft.yaml".to_owned(), |name| name.to_string_lossy().into_owned())
    }

    fn tell(&self, draft: &Draft, project: &Project, report: &Report) -> anyhow::Result<()> {
        let Draft { recipe, by, .. } = draft;
        if self.json {
            let ignored: Vec<_> =
                draft.ignored().into_iter().map(|(words, why)| json!({"words": words, "why": why})).collect();
            let unknown: Vec<_> =
                draft.wish.unknown.iter().map(|thing| json!({"called": thing.called, "near": thing.near})).collect();
            let whole = json!({"recipe": recipe, "by": by, "ignored": ignored, "unknown": unknown, "notes": draft.notes, "check": report});
            say!("{}", serde_json::to_string_pretty(&whole)?);
            return Ok(());
        }
        if self.output.is_none() {
            say!("{}", recipe.trim_end());
        }
        let assumed = recipe.matches("# assumed: ").count();
        draft.ignored().iter().for_each(|(what, why)| eprintln!("ignored: \"{what}\": {why}"));
        for thing in &draft.wish.unknown {
            let near =
                if thing.near.is_empty() { String::new() } else { format!("; there are {}", thing.near.join(", ")) };
            eprintln!("unknown: \"{}\": no catalog has it{near}", thing.called);
        }
        draft.notes.iter().for_each(|note| eprintln!("note: {note}"));
        eprintln!("assumed: {assumed} settings, each with its reason in the recipe");
        report.lines(&project.plan).iter().for_each(|line| eprintln!("{line}"));
        report.notes(project).iter().for_each(|note| eprintln!("note: {note}"));
        let file = self.output.as_ref().map_or_else(|| "FILE".to_owned(), |path| path.display().to_string());
        eprintln!("look at it: ensonify preview {file}");
        Ok(())
    }
}

/// Writes a file that is there whole or not at all.
fn write_whole(path: &Path, text: &str) -> std::io::Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".tmp");
    let temporary = path.with_file_name(name);
    std::fs::write(&temporary, text)?;
    std::fs::rename(&temporary, path)
}
