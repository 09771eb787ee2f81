//! `ensonify edit`: a change of a recipe from a sentence, shown as a difference, checked, and taken back again.

pub(super) mod history;
pub(super) mod propose;

use std::io::{BufRead as _, IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::Args;

use super::Code;
use super::llm::LlmArgs;
use crate::recipe::Outside;
use history::History;
use propose::{Desk, Proposal};

/// Changes a recipe as a sentence says
///
/// Shows the difference and what each change comes from. The result is checked as `check` does before anything is written, and
/// comments, order and blank lines stay as they are.
#[derive(Debug, Args)]
#[command(
    after_help = "Nothing is written before a yes: on a terminal it is asked for, elsewhere --yes says so.\n\nExamples:\n  \
    ensonify edit survey.yaml \"make the water murkier and pitch the sonar down 10 degrees\"\n  \
    ensonify edit survey.yaml \"add two barrels to the left of the wreck\" --yes\n  \
    ensonify edit survey.yaml --undo"
)]
pub struct Edit {
    /// The recipe, a YAML file
    recipe: PathBuf,
    /// What is to be changed
    #[arg(required_unless_present_any = ["set", "undo", "redo"])]
    prompt: Option<String>,
    /// Sets a value, such as --set water.temperature_c=4, after what the prompt says; may be given several times
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Writes without asking
    #[arg(short, long)]
    yes: bool,
    /// Writes into another file, and leaves the recipe as it is
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Takes the last change back
    #[arg(long, conflicts_with_all = ["prompt", "set", "output", "redo"])]
    undo: bool,
    /// Makes the change again that was taken back last
    #[arg(long, conflicts_with_all = ["prompt", "set", "output"])]
    redo: bool,
    /// Lets `include:` read files outside of the recipe's folder
    #[arg(long)]
    allow_outside: bool,
    /// The difference, the changes and notes as JSON with stable names
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    llm: LlmArgs,
}

impl Edit {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        if self.undo || self.redo {
            return self.step();
        }
        let outside = if self.allow_outside { Outside::Allowed } else { Outside::Refused };
        let desk = Desk::open(&self.recipe, outside)?;
        let proposal = desk.propose_with(self.prompt.as_deref(), &self.set, self.llm.drafter()?.as_mut())?;
        desk.check(&proposal, self.output.as_deref().unwrap_or(&self.recipe))?;
        if self.json {
            let written = self.may_write()? && !proposal.is_nothing();
            if written {
                self.write(&desk, &proposal)?;
            }
            say!("{}", serde_json::to_string_pretty(&proposal.json(written))?);
            return Ok(Code::Done);
        }
        proposal.show(std::io::stdout().is_terminal());
        if proposal.is_nothing() {
            eprintln!("nothing changes");
        } else if self.may_write()? || self.is_wanted()? {
            self.write(&desk, &proposal)?;
        } else {
            eprintln!("nothing was written{}", if is_interactive() { "" } else { "; --yes writes it" });
        }
        Ok(Code::Done)
    }

    /// Whether it is said already that the file may be written.
    fn may_write(&self) -> anyhow::Result<bool> {
        match &self.output {
            Some(path) if path.exists() && !self.yes => {
                bail!("{} is there already\nhelp: give another file, or --yes to replace it", path.display())
            }
            Some(_) => Ok(true),
            None => Ok(self.yes),
        }
    }

    fn is_wanted(&self) -> anyhow::Result<bool> {
        if !is_interactive() {
            return Ok(false);
        }
        Ok(matches!(asked("write it? [y/N] ")?.as_str(), "y" | "yes"))
    }

    fn write(&self, desk: &Desk, proposal: &Proposal) -> anyhow::Result<()> {
        match &self.output {
            Some(path) => history::write_whole(path, &proposal.after)
                .with_context(|| format!("cannot write {}; choose another file with -o", path.display()))?,
            None => desk.write(proposal)?,
        }
        eprintln!("written: {}", self.output.as_ref().unwrap_or(&self.recipe).display());
        Ok(())
    }

    /// One step back or forth.
    fn step(&self) -> anyhow::Result<Code> {
        let mut history = History::of(&self.recipe)?;
        let before = history.text()?;
        let after = if self.undo { history.undo(self.yes)? } else { history.redo(self.yes)? };
        propose::show_difference(&self.recipe, &before, &after, std::io::stdout().is_terminal());
        Ok(Code::Done)
    }
}

/// Whether a person sits there.
pub(super) fn is_interactive() -> bool {
    std::io::stdin().is_terminal() && std::io::stderr().is_terminal()
}

/// What a person answers.
pub(super) fn asked(question: &str) -> anyhow::Result<String> {
    let mut err = std::io::stderr();
    write!(err, "{question}").and_then(|()| err.flush()).context("cannot ask")?;
    let mut answer = String::new();
    std::io::stdin().lock().read_line(&mut answer).context("cannot read the answer")?;
    Ok(answer.trim().to_lowercase())
}

/// The folder of a file: where its relative paths begin.
pub(super) fn folder_of(path: &Path) -> PathBuf {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned()
}
