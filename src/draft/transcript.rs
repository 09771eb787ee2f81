//! How a recipe came to be: what was asked, who drafted it, what was answered and what was wrong with it.
//!
//! A file of JSON lines beside the recipe, one line a draft or change, only ever added to. A run never reads it. Keys are not
//! in it, and neither are dates.

use std::fmt;
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde::Serialize;
use sha2::{Digest as _, Sha256};

use super::{Options, Prompt};
use crate::recipe::printable;

/// Longest text of an answer that is kept, letters.
const LONGEST: usize = 20_000;

/// The file beside a recipe: `survey.yaml` has `survey.draft.jsonl`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Transcript {
    path: PathBuf,
}

/// One draft or change.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// `draft`, `edit` or `chat`.
    pub verb: &'static str,
    /// Version of this program.
    pub program: &'static str,
    /// What a person typed.
    pub prompt: String,
    /// Options that won over it.
    pub options: Said,
    /// Who read it.
    pub drafter: Who,
    /// A model's answers in their order; none of the built-in drafter.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rounds: Vec<Round>,
    /// What came of it.
    pub outcome: Outcome,
}

/// Options as they were given.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Said {
    #[serde(skip_serializing_if = "Option::is_none")]
    images: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sonar: Option<String>,
}

/// Who read a prompt.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Who {
    /// This program alone.
    BuiltIn,
    /// A language model.
    Model {
        /// Its name.
        model: String,
        /// Host and port of its server.
        host: String,
    },
}

impl fmt::Display for Who {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BuiltIn => out.write_str("built-in drafter"),
            Self::Model { model, .. } => write!(out, "language model {}", printable(model)),
        }
    }
}

/// One answer of a model.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Round {
    /// The model's text, cut where it is very long.
    pub answer: String,
    /// What was wrong with it, as the model was told.
    pub problems: Vec<String>,
}

/// What came of a prompt.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// A recipe of this hash.
    Recipe {
        /// SHA-256 of its bytes.
        sha256: String,
    },
    /// Nothing: why.
    Refused(String),
}

impl Entry {
    /// An entry for a prompt and what came of it.
    #[must_use]
    pub fn new(verb: &'static str, prompt: &Prompt, outcome: Outcome) -> Self {
        let Options { images, seed, name, sonar } = prompt.options.clone();
        Self {
            verb,
            program: env!("CARGO_PKG_VERSION"),
            prompt: prompt.text().to_owned(),
            options: Said { images, seed, name, sonar },
            drafter: Who::BuiltIn,
            rounds: Vec::new(),
            outcome,
        }
    }

    /// The same, by a language model.
    #[must_use]
    pub fn by_model(self, drafter: Who, rounds: Vec<Round>) -> Self {
        Self { drafter, rounds, ..self }
    }
}

impl Round {
    /// An answer and what was wrong with it.
    #[must_use]
    pub fn new(answer: &str, problems: Vec<String>) -> Self {
        Self { answer: answer.chars().take(LONGEST).collect(), problems }
    }
}

impl Outcome {
    /// A recipe by its text.
    #[must_use]
    pub fn recipe(text: &str) -> Self {
        let hash = Sha256::digest(text.as_bytes());
        Self::Recipe { sha256: hash.iter().map(|byte| format!("{byte:02x}")).collect() }
    }
}

impl Transcript {
    /// The file beside a recipe.
    #[must_use]
    pub fn beside(recipe: &Path) -> Self {
        Self { path: recipe.with_extension("draft.jsonl") }
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a line.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn add(&self, entry: &Entry) -> std::io::Result<()> {
        let mut line = serde_json::to_string(entry).expect("an entry has string keys only");
        line.push('\n');
        let mut file = OpenOptions::new().create(true).append(true).open(&self.path)?;
        file.write_all(line.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_for_each_draft() {
        let folder = tempfile::tempdir().expect("a folder");
        let transcript = Transcript::beside(&folder.path().join("two.tires.yaml"));
        assert!(transcript.path().ends_with("two.tires.draft.jsonl"));
        let prompt = Prompt::new("two \"tires\"", Options { images: Some(5), ..Options::default() });
        let first = Entry::new("draft", &prompt, Outcome::recipe("seed: 1\n"));
        let who = Who::Model { model: "small".into(), host: "127.0.0.1:1".into() };
        let rounds = vec![Round::new("{\n}", vec!["no objects".into()]), Round::new(&"x".repeat(50_000), Vec::new())];
        let second = Entry::new("edit", &prompt, Outcome::Refused("no".into())).by_model(who, rounds);
        transcript.add(&first).expect("written");
        transcript.add(&second).expect("written");
        let text = std::fs::read_to_string(transcript.path()).expect("there");
        let lines: Vec<serde_json::Value> =
            text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        assert_eq!(lines.len(), 2);
        assert_eq!(
            (lines[0]["prompt"].as_str(), lines[0]["options"]["images"].as_u64()),
            (Some("two \"tires\""), Some(5))
        );
        assert_eq!(lines[0]["drafter"], "built-in");
        assert_eq!(lines[0]["outcome"]["recipe"]["sha256"].as_str().map(str::len), Some(64));
        assert_eq!(
            (lines[1]["drafter"]["model"]["host"].as_str(), lines[1]["outcome"]["refused"].as_str()),
            (Some("127.0.0.1:1"), Some("no"))
        );
        assert_eq!(lines[1]["rounds"][0]["problems"][0], "no objects");
        assert!(text.len() < 22_000);
    }
}
