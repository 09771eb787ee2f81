//! What somebody asked for, in closed kinds, each part with the words that said it.
//!
//! Knows neither prompts nor recipes: a drafter fills it, the composer writes a recipe of it.

mod amount;
mod path;
mod settings;
mod thing;

use std::ops::Range;

pub use amount::{Amount, Count};
pub use path::{Path, Route, Sway};
pub use settings::{Look, LookChange, Output, Seabed, Sonar, Splits, Water};
pub use thing::{Side, Stand, Thing, Unknown};

/// Where a part of a wish comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// Bytes of the prompt that say so, in their order.
    Words(Vec<Range<usize>>),
    /// An explicit option, such as `--images`.
    Option(&'static str),
    /// The language model says so, and no words of the prompt were found that do.
    Model,
    /// Nobody said it: chosen by a rule, for this reason, which stands in the recipe.
    Assumed(String),
}

/// A part of a wish and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Said<T> {
    /// What was said.
    pub value: T,
    /// Who said it.
    pub source: Source,
}

impl<T> Said<T> {
    /// Said by some words of the prompt.
    pub fn by(words: Range<usize>, value: T) -> Self {
        Self { value, source: Source::Words(vec![words]) }
    }

    /// Chosen by a rule.
    pub fn assumed(value: T, reason: impl Into<String>) -> Self {
        Self { value, source: Source::Assumed(reason.into()) }
    }
}

/// What somebody asked for. What is not said is `None` or empty; the composer chooses it and tells so.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wish {
    /// Frames in all, of each look.
    pub images: Option<Said<u64>>,
    /// Independent draws of the world, where somebody says so ("20 scenes", "the same scene").
    pub scenes: Option<Said<u64>>,
    /// Random seed.
    pub seed: Option<Said<u64>>,
    /// Name of the dataset, as an option gives it.
    pub name: Option<Said<String>>,
    /// Objects to place.
    pub things: Vec<Thing>,
    /// Labels that must not be there ("no tires").
    pub without: Vec<Said<String>>,
    /// Things that no catalog has; shown, never replaced by something else.
    pub unknown: Vec<Unknown>,
    /// The bottom.
    pub seabed: Seabed,
    /// A structure: `pier`, `dam`, `harbour`, `tank`, `pipeline` or `net-pen`, a kind of the recipe's `environment`.
    pub environment: Option<Said<String>>,
    /// Longest sides of that structure, metres: length, width, height or depth as far as they were said ("a 10 m pool").
    pub environment_m: Option<Said<Vec<f64>>>,
    /// The water.
    pub water: Water,
    /// The sonar and how it is held.
    pub sonar: Sonar,
    /// How the vehicle moves.
    pub path: Path,
    /// Mirrors of the recipe's `multipath`: `surface`, `bottom`.
    pub multipath: Option<Said<Vec<String>>>,
    /// What is written besides.
    pub output: Output,
    /// Shares of training, validation and test.
    pub splits: Option<Said<Splits>>,
    /// Several pictures of the same echoes.
    pub looks: Vec<Said<Look>>,
    /// Words that change nothing in a sonar image, and why ("rusty": "sonar sees shape and material, not colour").
    pub ignored: Vec<Said<String>>,
    /// What a person should know besides.
    pub notes: Vec<String>,
}
