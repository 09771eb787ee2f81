//! `ensonify chat`: one request after the other at a recipe, each shown, checked and kept or not.

use std::io::{BufRead as _, IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};

use clap::Args;

use super::Code;
use super::edit::history::{History, write_whole};
use super::edit::propose::{Desk, show_difference};
use super::edit::{asked, is_interactive};
use super::llm::LlmArgs;
use super::preview;
use crate::draft::model::ModelDrafter;
use crate::draft::{Drafter, Known, Options, Prompt};
use crate::recipe::Outside;
use crate::run::Project;

/// Frames of a picture between two requests.
const FRAMES: u32 = 2;

/// Changes a recipe in a conversation
///
/// Each line is a request, such as "make the water murkier"; its difference is shown and checked, a picture drawn, and the
/// recipe written when it is kept. The first request of a recipe that is not there yet drafts it. Lines may be piped in: what
/// can be done is then kept without a question.
#[derive(Debug, Args)]
#[command(after_help = "Besides requests: undo, redo, show, diff, check, preview, run, help, quit.\n\nExample:\n  \
    ensonify chat survey.yaml\n  printf 'two tires on mud\\nmake the water murkier\\n' | ensonify chat new.yaml --no-preview")]
pub struct Chat {
    /// The recipe, a YAML file; made if it is not there
    recipe: PathBuf,
    /// Draws no pictures
    #[arg(long)]
    no_preview: bool,
    /// Lets `include:` read files outside of the recipe's folder
    #[arg(long)]
    allow_outside: bool,
    #[command(flatten)]
    llm: LlmArgs,
}

/// What a line asks of the conversation itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Command {
    Undo,
    Redo,
    Show,
    Diff,
    Check,
    Preview,
    Run,
    Save,
    Help,
    Quit,
}

impl Command {
    fn of(line: &str) -> Option<Self> {
        Some(match line.trim().trim_start_matches(['/', ':']).to_lowercase().as_str() {
            "undo" => Self::Undo,
            "redo" => Self::Redo,
            "show" => Self::Show,
            "diff" => Self::Diff,
            "check" => Self::Check,
            "preview" => Self::Preview,
            "run" => Self::Run,
            "save" => Self::Save,
            "help" | "?" => Self::Help,
            "quit" | "exit" | "q" | "bye" => Self::Quit,
            _ => return None,
        })
    }
}

const HELP: &str =
    "say what is to change: \"make the water murkier\", \"add two barrels to the left of the wreck\", \"range 15 m\"
undo, redo   the last change back, and again     check     what `run` would refuse, and what it makes
show         the recipe                          preview   a picture of two frames
diff         all that changed since the start    run       how to make the dataset
save         every kept change is written        quit";

impl Chat {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let mut talk = Talk {
            path: &self.recipe,
            outside: if self.allow_outside { Outside::Allowed } else { Outside::Refused },
            pictures: !self.no_preview,
            began: std::fs::read_to_string(&self.recipe).ok(),
            drafter: self.llm.drafter()?,
        };
        if is_interactive() {
            let there = if talk.began.is_some() { "" } else { " is not there yet: the first request drafts it" };
            eprintln!("{}{there}\nhelp tells what can be said, quit ends", self.recipe.display());
        }
        let mut last = Ok(());
        while let Some(line) = next_line()? {
            if line.trim().is_empty() {
                continue;
            }
            match talk.answer(&line) {
                Ok(Going::On) => last = Ok(()),
                Ok(Going::Home) => break,
                Err(error) => {
                    eprintln!("error: {error:#}");
                    last = Err(());
                }
            }
        }
        Ok(if last.is_err() && !is_interactive() { Code::Invalid } else { Code::Done })
    }
}

/// The next line; none at the end.
fn next_line() -> anyhow::Result<Option<String>> {
    if is_interactive() {
        eprint!("> ");
        std::io::stderr().flush()?;
    }
    let mut line = String::new();
    let read = std::io::stdin().lock().read_line(&mut line)?;
    Ok((read > 0).then_some(line))
}

/// Whether the conversation goes on.
enum Going {
    On,
    Home,
}

/// A conversation.
struct Talk<'a> {
    path: &'a Path,
    outside: Outside,
    pictures: bool,
    /// The text as it was at first; none of a new recipe.
    began: Option<String>,
    drafter: Option<ModelDrafter>,
}

impl Talk<'_> {
    fn answer(&mut self, line: &str) -> anyhow::Result<Going> {
        match Command::of(line) {
            Some(Command::Quit) => return Ok(Going::Home),
            Some(command) => self.command(command)?,
            None if self.path.exists() => self.change(line)?,
            None => self.draft(line)?,
        }
        Ok(Going::On)
    }

    fn command(&mut self, command: Command) -> anyhow::Result<()> {
        if command == Command::Help {
            say!("{HELP}");
            return Ok(());
        }
        let mut history = History::of(self.path)?;
        let now = history.text()?;
        match command {
            Command::Undo => self.stepped(&now, &history.undo(false)?),
            Command::Redo => self.stepped(&now, &history.redo(false)?),
            Command::Show => say!("{}", now.trim_end()),
            Command::Diff => self.stepped(self.began.as_deref().unwrap_or_default(), &now),
            Command::Check => {
                let project = self.project(&now)?;
                let plan = &project.plan;
                say!("{} is fine: {} scenes, {} frames", self.path.display(), plan.scenes.len(), plan.jobs.len());
            }
            Command::Preview => self.picture(&self.project(&now)?)?,
            Command::Run => say!("ensonify run {}", self.path.display()),
            Command::Save => say!("{} is written", self.path.display()),
            Command::Help | Command::Quit => {}
        }
        Ok(())
    }

    fn stepped(&self, before: &str, after: &str) {
        show_difference(self.path, before, after, std::io::stdout().is_terminal());
    }

    fn project(&self, text: &str) -> anyhow::Result<Project> {
        Desk::of(self.path, text, self.outside)?.checked(text, self.path)
    }

    /// One request at a recipe that is there.
    fn change(&mut self, request: &str) -> anyhow::Result<()> {
        let desk = Desk::open(self.path, self.outside)?;
        let proposal = desk.propose_with(Some(request), &[], self.drafter.as_mut())?;
        proposal.show(std::io::stdout().is_terminal());
        if proposal.is_nothing() {
            eprintln!("nothing changes");
            return Ok(());
        }
        let project = desk.check(&proposal, self.path)?;
        if self.pictures {
            self.picture(&project)?;
        }
        if self.is_kept()? {
            desk.write(&proposal)?;
            eprintln!("kept");
        } else {
            eprintln!("not kept");
        }
        Ok(())
    }

    /// The first request of a recipe that is not there.
    fn draft(&mut self, request: &str) -> anyhow::Result<()> {
        let prompt = Prompt::new(request, Options::default());
        let folder = super::edit::folder_of(self.path);
        let known = Known::open(&folder, &[])?;
        let mut drafter = self.drafter.take().map_or(Drafter::BuiltIn, |model| Drafter::Model(Box::new(model)));
        let draft = drafter.draft(&prompt, &known);
        if let Drafter::Model(model) = drafter {
            self.drafter = Some(*model);
        }
        let draft = draft?;
        self.stepped("", &draft.recipe);
        draft.notes.iter().for_each(|note| eprintln!("note: {note}"));
        let project = self.project(&draft.recipe)?;
        if self.pictures {
            self.picture(&project)?;
        }
        if self.is_kept()? {
            write_whole(self.path, &draft.recipe)?;
            eprintln!("written: {}", self.path.display());
        }
        Ok(())
    }

    fn picture(&self, project: &Project) -> anyhow::Result<()> {
        say!("picture: {}", preview::draw(project, None, FRAMES)?.display());
        Ok(())
    }

    fn is_kept(&self) -> anyhow::Result<bool> {
        if !is_interactive() {
            return Ok(true);
        }
        Ok(!matches!(asked("keep it? [Y/n] ")?.as_str(), "n" | "no" | "undo"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_single_words() {
        assert_eq!(Command::of(" Undo\n"), Some(Command::Undo));
        assert_eq!(Command::of("/quit"), Some(Command::Quit));
        assert_eq!(Command::of("undo the wreck"), None);
    }
}
