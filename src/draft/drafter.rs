//! Who reads prompts, and what all of them give.

use thiserror::Error;

use super::{Refusal, Wish};

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
}

/// Why there is no draft.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DraftError {
    /// It cannot be, or is no wish.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl Drafter {
    /// Who it is, as headings of recipes say.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::BuiltIn => "built-in drafter",
        }
    }
}
