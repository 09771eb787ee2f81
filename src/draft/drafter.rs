//! Who reads prompts, and what all of them give.

use thiserror::Error;

use super::check::checked;
use super::read::read;
use super::wish::Source;
use super::{Composed, Known, Prompt, Refusal, Wish, composed};
use crate::plan::PlanError;

/// A reader of prompts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Drafter {
    /// Rules and tables of this program: the same prompt gives the same recipe.
    #[default]
    BuiltIn,
}

/// A drafted recipe.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// Its text.
    pub recipe: String,
    /// What was understood.
    pub wish: Wish,
    /// Who read the prompt.
    pub by: String,
    /// What could not be as it was asked for, and what to expect.
    pub notes: Vec<String>,
    prompt: Prompt,
}

impl Draft {
    /// Words of the prompt that change nothing in a sonar image, and why.
    #[must_use]
    pub fn ignored(&self) -> Vec<(String, String)> {
        let words = |source: &Source| match source {
            Source::Words(ranges) => ranges.iter().map(|range| self.prompt.words(range)).collect::<Vec<_>>().join(" "),
            Source::Option(_) | Source::Model | Source::Assumed(_) => String::new(),
        };
        self.wish.ignored.iter().map(|said| (words(&said.source), said.value.clone())).collect()
    }
}

/// Why there is no draft.
#[derive(Debug, Error)]
pub enum DraftError {
    /// It cannot be, or is no wish.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The recipe that was made of it cannot be run: a model file is broken, a licence forbids it.
    #[error("the draft cannot be run: {0}")]
    Unfit(#[from] PlanError),
}

impl Drafter {
    /// The recipe of a prompt, which passes what `check` asks.
    ///
    /// # Errors
    /// What of the prompt cannot be, and what to write instead.
    pub fn draft(&self, prompt: &Prompt, known: &Known) -> Result<Draft, DraftError> {
        let wish = match self {
            Self::BuiltIn => read(prompt, known)?,
        };
        let Composed { recipe, notes } = composed(&wish, prompt, known, self.name())?;
        checked(&recipe, &known.folder)?;
        Ok(Draft { recipe, wish, by: self.name().to_owned(), notes, prompt: prompt.clone() })
    }

    /// Who it is, as headings of recipes say.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::BuiltIn => "built-in drafter",
        }
    }
}
