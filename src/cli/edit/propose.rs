//! From a request to a proposal: the new text, its difference, and what each change comes from.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow};
use serde_json::json;
use similar::TextDiff;

use super::folder_of;
use super::history::History;
use crate::draft::edit::{Act, Change, Revision, Subject, revise, understand, understand_with};
use crate::draft::model::ModelDrafter;
use crate::draft::transcript::{Entry, Outcome, Transcript};
use crate::draft::wish::{Said, Source};
use crate::draft::{Known, Options, Prompt, Refusal};
use crate::recipe::{Origin, Outside, parse};
use crate::run::{Given, Project};

/// A recipe on the desk.
pub(in crate::cli) struct Desk {
    path: PathBuf,
    outside: Outside,
    known: Known,
    /// As it is written.
    pub subject: Subject,
}

/// A change that may be written.
pub(in crate::cli) struct Proposal {
    path: PathBuf,
    asked: String,
    before: String,
    /// The new text.
    pub after: String,
    /// For which words, what was set where.
    done: Vec<(String, Vec<Act>)>,
    notes: Vec<String>,
    /// Words of the request that nothing was made of.
    unread: Vec<String>,
    /// The conversation with a language model, if there was one.
    entry: Option<Entry>,
}

impl Desk {
    /// Opens a recipe, and the catalogs that it and its folder name.
    pub fn open(path: &Path, outside: Outside) -> anyhow::Result<Self> {
        let text = crate::recipe::read(path).and_then(|_| {
            std::fs::read_to_string(path).map_err(|error| {
                let span = crate::recipe::Span::whole(&crate::recipe::Source::new(
                    &path.display().to_string(),
                    "",
                    Origin::Given,
                ));
                crate::recipe::Error::new(
                    &span,
                    "",
                    format!("cannot be read: {error}"),
                    "check the file and its permissions",
                )
            })
        })?;
        Self::of(path, &text, outside)
    }

    /// A text that stands, or is to stand, in a file.
    pub fn of(path: &Path, text: &str, outside: Outside) -> anyhow::Result<Self> {
        let subject = Subject::new(path, text, outside)?;
        let folder = folder_of(path);
        let mut known =
            Known::open(&folder, &[]).unwrap_or_else(|_| Known { folder: folder.clone(), catalogs: Vec::new() });
        let items = subject.said("objects").map_or(&[][..], |(node, _)| node.items());
        let named: Vec<String> =
            items.iter().filter_map(|item| item.at("pick.catalog")?.text()).map(str::to_owned).collect();
        for name in named.iter().rev() {
            let there = known.catalogs.iter().position(|(known, _)| known == name);
            let catalog = match there {
                Some(index) => Some(known.catalogs.remove(index)),
                None => {
                    Known::open(&folder, std::slice::from_ref(name)).ok().and_then(|mut known| known.catalogs.pop())
                }
            };
            // What the recipe picks from comes first.
            known.catalogs.splice(0..0, catalog);
        }
        Ok(Self { path: path.to_owned(), outside, known, subject })
    }

    /// What a request and options make of the recipe, with a language model beside the built-in reader if one is given.
    pub fn propose_with(
        &self,
        request: Option<&str>,
        sets: &[String],
        model: Option<&mut ModelDrafter>,
    ) -> anyhow::Result<Proposal> {
        let prompt = Prompt::new(request.unwrap_or_default(), Options::default());
        let mut changes: Vec<Said<Change>> = Vec::new();
        let (mut unread, mut rounds, mut by) = (Vec::new(), Vec::new(), None);
        if request.is_some() {
            let understood = match model {
                Some(model) => {
                    let understood = understand_with(&prompt, &self.subject, &self.known, model, &mut rounds);
                    by = (!rounds.is_empty()).then(|| model.who());
                    understood?
                }
                None => understand(&prompt, &self.subject, &self.known)?,
            };
            unread.extend(understood.unread.iter().map(|words| prompt.words(words).to_owned()));
            changes.extend(understood.changes);
        }
        changes.extend(sets.iter().map(|set| setting(set)).collect::<anyhow::Result<Vec<_>>>()?);
        let revision = revise(&self.subject, &self.known, &changes).map_err(Refusal::from)?;
        let Revision { subject, done, notes } = revision;
        let words = |source: &Source| match source {
            Source::Words(ranges) => ranges.iter().map(|range| prompt.words(range)).collect::<Vec<_>>().join(" "),
            Source::Option(option) => (*option).to_owned(),
            Source::Model | Source::Assumed(_) => String::new(),
        };
        let done = done.into_iter().map(|said| (words(&said.source), said.value)).collect();
        Ok(Proposal {
            path: self.path.clone(),
            asked: prompt.text().to_owned(),
            before: self.subject.text().to_owned(),
            after: subject.text().to_owned(),
            done,
            notes,
            unread,
            entry: by.map(|who| Entry::new("edit", &prompt, Outcome::recipe(subject.text())).by_model(who, rounds)),
        })
    }

    /// Refuses what `run` would refuse, as if it stood in a file.
    pub fn check(&self, proposal: &Proposal, path: &Path) -> anyhow::Result<Project> {
        self.checked(&proposal.after, path).context("the changed recipe would not run, and nothing was written")
    }

    /// As [`Self::check`], of any text.
    pub fn checked(&self, text: &str, path: &Path) -> anyhow::Result<Project> {
        let project = Project::load_text(&Given { path, sets: &[], outside: self.outside }, text)?;
        project.try_corners()?;
        Ok(project)
    }

    /// Writes the recipe, with its history.
    pub fn write(&self, proposal: &Proposal) -> anyhow::Result<()> {
        History::of(&self.path)?.change(&proposal.before, &proposal.after, &proposal.asked)?;
        if let Some(entry) = &proposal.entry {
            let transcript = Transcript::beside(&self.path);
            let told = transcript.add(entry);
            told.with_context(|| format!("cannot write {}", transcript.path().display()))?;
        }
        Ok(())
    }
}

/// `path=value` of an option.
fn setting(set: &str) -> anyhow::Result<Said<Change>> {
    let help = "help: write --set path=value, such as --set frames=5";
    let (path, value) = set.split_once('=').ok_or_else(|| anyhow!("`{set}` has no `=`\n{help}"))?;
    let value = parse("--set", value, Origin::Given)?;
    Ok(Said { value: Change::Set(path.trim().to_owned(), value), source: Source::Option("--set") })
}

impl Proposal {
    /// Whether it changes nothing.
    pub fn is_nothing(&self) -> bool {
        self.before == self.after
    }

    /// Shows the difference and what it comes from.
    pub fn show(&self, in_colour: bool) {
        show_difference(&self.path, &self.before, &self.after, in_colour);
        for (words, acts) in &self.done {
            for act in acts {
                say!("{}  ← {}", told(act), if words.is_empty() { "the request" } else { words });
            }
        }
        self.notes.iter().for_each(|note| eprintln!("note: {note}"));
        self.unread.iter().for_each(|words| eprintln!("not understood, and left out: “{words}”"));
    }

    /// The same, with stable names.
    pub fn json(&self, written: bool) -> serde_json::Value {
        let change = |(words, acts): &(String, Vec<Act>)| {
            let acts: Vec<_> = acts.iter().map(|act| json!({"path": act.path(), "value": value_of(act)})).collect();
            json!({"words": words, "acts": acts})
        };
        json!({
            "diff": difference(&self.path, &self.before, &self.after),
            "changes": self.done.iter().map(change).collect::<Vec<_>>(),
            "notes": self.notes,
            "not_understood": self.unread,
            "written": written,
        })
    }
}

fn value_of(act: &Act) -> serde_json::Value {
    match act {
        Act::Set { value, .. } | Act::Insert { value, .. } => value.json(),
        Act::Remove { .. } => serde_json::Value::Null,
    }
}

/// An act in a line.
fn told(act: &Act) -> String {
    match act {
        Act::Set { path, value } => format!("{path}: {}", crate::draft::edit::in_line(value)),
        Act::Insert { list, value, .. } => format!("{list}: + {}", crate::draft::edit::in_line(value)),
        Act::Remove { path } => format!("{path}: removed"),
    }
}

/// Shows a difference.
pub(in crate::cli) fn show_difference(path: &Path, before: &str, after: &str, in_colour: bool) {
    for line in difference(path, before, after).lines() {
        let colour = match line.as_bytes().first() {
            _ if !in_colour || line.starts_with("---") || line.starts_with("+++") => None,
            Some(b'+') => Some(32),
            Some(b'-') => Some(31),
            Some(b'@') => Some(36),
            _ => None,
        };
        let line = crate::recipe::printable(line.trim_end_matches('\r'));
        match colour {
            Some(colour) => say!("\u{1b}[{colour}m{line}\u{1b}[0m"),
            None => say!("{line}"),
        }
    }
}

/// A unified difference; empty where there is none.
fn difference(path: &Path, before: &str, after: &str) -> String {
    let name = path.display().to_string();
    TextDiff::from_lines(before, after).unified_diff().context_radius(2).header(&name, &name).to_string()
}
