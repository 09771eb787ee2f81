//! From a sentence to a change of a recipe, in its text, with everything else as it was.
//!
//! ```text
//! prompt ── understand ──► Change ── acts on the tree ──► Act ── text ──► new text ── parsed again, and checked as any recipe
//! ```
//! A change is of a closed kind, with numbers and names of models that are in a catalog. Knows nothing of files and terminals.

mod act;
mod ask;
mod change;
mod numbers;
mod subject;
mod text;
mod understand;

pub use act::Act;
pub use ask::{NotUnderstood, understand_with};
pub use change::{Acts, Addition, Change, Held, Named, NumberOf, Param, Revision, Which, revise};
pub use numbers::Move;
pub use subject::{Subject, Whose};
pub use text::{apply, in_line};
pub use understand::{Understood, understand};
