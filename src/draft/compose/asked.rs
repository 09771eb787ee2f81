//! What a recipe is composed of, and the words for where it comes from.

use std::ops::Range;

use crate::draft::wish::{Amount, Said, Source};
use crate::draft::{Problem, Prompt, Wish};
use crate::scene::AssetCache;

/// Longest quotation in a comment, letters.
const LONGEST: usize = 60;

/// A wish, the prompt that it comes from, and the models that it names.
pub(super) struct Asked<'a> {
    pub wish: &'a Wish,
    pub prompt: &'a Prompt,
    pub assets: AssetCache,
}

/// A number with the reason for it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Figure {
    pub amount: Amount,
    pub why: String,
}

impl Asked<'_> {
    /// Who says so: the words in quotes, an option, a rule.
    pub fn why(&self, source: &Source) -> String {
        match source {
            Source::Words(ranges) => {
                let quoted: Vec<String> = ranges.iter().map(|range| self.quoted(range)).collect();
                quoted.join(", ")
            }
            Source::Option(name) => (*name).to_owned(),
            Source::Model => "as the language model reads it".to_owned(),
            Source::Assumed(reason) => assumed(reason),
        }
    }

    fn quoted(&self, range: &Range<usize>) -> String {
        let words = self.prompt.words(range);
        let cut: String = words.chars().take(LONGEST).collect();
        let dots = if cut.len() < words.len() { "…" } else { "" };
        format!("\"{cut}{dots}\"")
    }

    /// A number that somebody said.
    pub fn figure(&self, said: &Said<Amount>) -> Figure {
        Figure { amount: said.value.clone(), why: self.why(&said.source) }
    }

    /// A fault of what somebody said.
    pub fn problem(&self, source: &Source, what: impl Into<String>, help: impl Into<String>) -> Problem {
        match source {
            Source::Words(ranges) => match ranges.first() {
                Some(range) => Problem::of(range.clone(), what, help),
                None => Problem::whole(what, help),
            },
            Source::Option(_) | Source::Model | Source::Assumed(_) => Problem::whole(what, help),
        }
    }
}

/// The comment of what nobody said.
pub(super) fn assumed(reason: &str) -> String {
    format!("assumed: {reason}")
}

/// Several reasons in one comment; what is assumed comes last, and says so once.
pub(super) fn joined(reasons: impl IntoIterator<Item = String>) -> String {
    let begin = assumed("");
    let (assumed, said): (Vec<String>, Vec<String>) =
        reasons.into_iter().filter(|why| !why.is_empty()).partition(|why| why.starts_with(&begin));
    let mut parts = said;
    let rules: Vec<&str> = assumed.iter().filter_map(|why| why.strip_prefix(&begin)).collect();
    if !rules.is_empty() {
        parts.push(format!("{begin}{}", rules.join("; ")));
    }
    parts.join("; ")
}

impl Figure {
    /// Chosen by a rule.
    pub fn assumed(amount: Amount, reason: &str) -> Self {
        Self { amount, why: assumed(reason) }
    }

    /// The middle of what it may be.
    pub fn middle(&self) -> f64 {
        let [low, high] = self.amount.ends();
        0.5 * (low + high)
    }
}
