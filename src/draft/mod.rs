//! From a sentence to a recipe, and from a sentence to a change of one.
//!
//! ```text
//!            ┌ read ─────────┐
//! prompt ────┤               ├──► Wish ── compose ──► recipe text with comments ── checked as any recipe
//!            └ model ─ HTTP ─┘
//! ```
//! A drafter only says what was asked for, as a [`Wish`] of closed kinds, numbers and names of models that are in a catalog;
//! the recipe is written by this program. So no path, address, command or YAML of a prompt, a catalog or a language model
//! gets anywhere. Knows nothing of rendering; a run never comes back here.

pub mod annotate;
pub mod check;
pub mod compose;
mod drafter;
pub mod edit;
pub(crate) mod find;
pub mod infer;
mod known;
pub mod model;
mod prompt;
pub mod read;
mod refusal;
pub(crate) mod sense;
pub mod transcript;
pub mod wish;

pub use compose::{Composed, compose, composed};
pub use drafter::{Draft, DraftError, Drafter};
pub use known::{Known, Models};
pub use prompt::{Options, Prompt};
pub use refusal::{Problem, Refusal};
pub use wish::Wish;
