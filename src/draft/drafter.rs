//! Who reads prompts, and what all of them give.

use thiserror::Error;

use super::check::checked;
use super::model::{Asked, ModelDrafter, ModelError, NotUnderstood, Understood};
use super::read::read;
use super::transcript::{Entry, Outcome, Round, Who};
use super::wish::Source;
use super::{Composed, Known, Prompt, Refusal, Wish, composed};
use crate::plan::PlanError;

/// A reader of prompts.
#[derive(Debug, Default)]
pub enum Drafter {
    /// Rules and tables of this program: the same prompt gives the same recipe.
    #[default]
    BuiltIn,
    /// A language model beside them.
    Model(Box<ModelDrafter>),
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
    drafter: Who,
    rounds: Vec<Round>,
}

impl Draft {
    /// What a transcript says of it.
    #[must_use]
    pub fn entry(&self, verb: &'static str) -> Entry {
        let entry = Entry::new(verb, &self.prompt, Outcome::recipe(&self.recipe));
        entry.by_model(self.drafter.clone(), self.rounds.clone())
    }

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
    /// The language model gives no answer.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl Drafter {
    /// The recipe of a prompt, which passes what `check` asks.
    ///
    /// # Errors
    /// What of the prompt cannot be, and what to write instead; a language model that gives no answer.
    pub fn draft(&mut self, prompt: &Prompt, known: &Known) -> Result<Draft, DraftError> {
        let by = self.name();
        let make = |wish: &Wish| -> Result<Draft, DraftError> {
            let Composed { recipe, notes } = composed(wish, prompt, known, &by)?;
            checked(&recipe, &known.folder)?;
            let (wish, by, prompt) = (wish.clone(), by.clone(), prompt.clone());
            Ok(Draft { recipe, wish, by, notes, prompt, drafter: Who::BuiltIn, rounds: Vec::new() })
        };
        let read = read(prompt, known);
        match self {
            Self::BuiltIn => make(&read?),
            Self::Model(drafter) => {
                let mut rounds = Vec::new();
                let asked = Asked { prompt, known, read: &read };
                let Understood { made, .. } =
                    drafter.read(asked, &mut rounds, &mut { make }).map_err(|why| match why {
                        NotUnderstood::Model(error) => error.into(),
                        NotUnderstood::Refused(refusal) => refusal.into(),
                        NotUnderstood::Unmade(error) => error,
                    })?;
                Ok(Draft { drafter: drafter.who(), rounds, ..made })
            }
        }
    }

    /// Who it is, as transcripts say.
    #[must_use]
    pub fn who(&self) -> Who {
        match self {
            Self::BuiltIn => Who::BuiltIn,
            Self::Model(drafter) => drafter.who(),
        }
    }

    /// Who it is, as headings of recipes say.
    #[must_use]
    pub fn name(&self) -> String {
        self.who().to_string()
    }
}
