//! Why no recipe can be drafted, and what to write instead.

use std::fmt;
use std::ops::Range;

use crate::recipe::printable;

/// A wish that no recipe can fulfil, or that is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// At least one; the gravest first.
    pub problems: Vec<Problem>,
}

/// One thing that cannot be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Bytes of the prompt that ask for it; none where the prompt as a whole does.
    pub words: Option<Range<usize>>,
    /// What is wrong, in a sentence without a full stop: "five to three barrels: the range runs backwards".
    pub what: String,
    /// What to write instead.
    pub help: String,
}

impl Problem {
    /// A fault of some words of the prompt.
    #[must_use]
    pub fn of(words: Range<usize>, what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { words: Some(words), what: what.into(), help: help.into() }
    }

    /// A fault of the prompt as a whole.
    #[must_use]
    pub fn whole(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { words: None, what: what.into(), help: help.into() }
    }
}

impl From<Problem> for Refusal {
    fn from(problem: Problem) -> Self {
        Self { problems: vec![problem] }
    }
}

impl std::error::Error for Refusal {}

impl fmt::Display for Refusal {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, Problem { what, help, .. }) in self.problems.iter().enumerate() {
            let begin = if number == 0 { "" } else { "\n" };
            write!(out, "{begin}{}\nhelp: {}", printable(what), printable(help))?;
        }
        Ok(())
    }
}
