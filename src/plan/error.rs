//! Why a recipe or a plan cannot become jobs.

use std::fmt;

use crate::catalog::CatalogError;
use crate::recipe::{self, printable};

/// A recipe or a plan that cannot be run, found before anything is rendered.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// A fault in the recipe itself, located.
    #[error(transparent)]
    Recipe(#[from] recipe::Error),
    /// A catalog or a model file that cannot be used.
    #[error(transparent)]
    Catalog(#[from] CatalogError),
    /// A fault in a plan that was given instead of a recipe.
    #[error(transparent)]
    Plan(#[from] PlanFault),
}

/// A fault in the JSON of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanFault {
    /// The plan's name as the user knows it; with line and column where it is no JSON or of the wrong form.
    pub file: String,
    /// Path of the value, such as `jobs[3].sonar.range_m`; empty for the plan as a whole.
    pub place: String,
    /// What is wrong.
    pub problem: String,
    /// What to do; empty where the problem says so itself.
    pub help: String,
}

impl std::error::Error for PlanFault {}

impl fmt::Display for PlanFault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [&self.file, &self.place, &self.problem].into_iter().filter(|part| !part.is_empty());
        let text = parts.map(|part| printable(part)).collect::<Vec<_>>().join(": ");
        out.write_str(&text)?;
        if self.help.is_empty() { Ok(()) } else { write!(out, "\nhelp: {}", printable(&self.help)) }
    }
}
