//! What can be changed of a recipe, in closed kinds, and the small acts that each means for a given recipe.
//!
//! Distributions are changed as a whole, looks and sweeps with them; a value that an included file or the defaults say is
//! overridden in the recipe itself. What is ambiguous is asked back, never guessed.

mod bottom;
mod item;
mod objects;
mod param;
mod pose;
mod shift;
mod totals;
mod values;
mod vehicle;

use std::collections::BTreeSet;

use super::act::Act;
use super::numbers::Move;
use super::subject::Subject;
use crate::draft::wish::{Amount, Count, Route, Said, Stand};
use crate::draft::{Known, Models, Problem};
use crate::recipe::Node;

pub(super) use objects::{has, label_of};
pub use param::Param;
pub(super) use shift::{SEDIMENTS, TURBIDITY, moved_at};
pub(super) use values::in_steps;

/// One change of a recipe.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// A value at a path, as an option or a language model says.
    Set(String, Node),
    /// A value goes, with its key.
    Unset(String),
    /// An amount for a parameter.
    To(Param, Amount),
    /// A word for a value at a path: `water.turbidity`, `seabed.sediment`.
    Words(&'static str, Vec<String>),
    /// More or less of a parameter.
    Move(Param, Move),
    /// A parameter in steps, every one a variant.
    Sweep(Param, Vec<f64>),
    /// A word in steps.
    SweepWords(&'static str, Vec<String>),
    /// So many steps murkier; clearer below 0.
    Murkier(i32),
    /// Finer sediments, so many steps; coarser below 0.
    Muddier(i32),
    /// So many times the height of what shapes the bottom.
    Rougher(f64),
    /// A shape for the bottom.
    Shape(String),
    /// A structure, or none.
    Structure(Option<String>),
    /// So many frames in all.
    Images(u64),
    /// Shares of training, validation and test.
    Splits([f64; 3]),
    /// Degrees to port.
    Turn(f64, Held),
    /// Degrees up.
    Pitch(f64, Held),
    /// The vehicle's heading, degrees counter-clockwise from x.
    Heading(f64),
    /// The vehicle's place: x, y, z, as far as they were said.
    Place([Option<f64>; 3]),
    /// Another way.
    Route(Route),
    /// More objects.
    Add(Addition),
    /// Fewer objects: all of a kind.
    Remove(Which),
    /// All objects go.
    Clear,
    /// Other models in the stead of some.
    Swap(Which, Named),
    /// Another number of some.
    Number(Which, NumberOf),
    /// How some stand.
    Stand(Which, Vec<Stand>),
}

/// What is turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// The sonar on its mount.
    Sonar,
    /// The vehicle, where its path lets it.
    Vehicle,
}

/// Things by a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// As they were called.
    pub called: String,
    /// In English, singular.
    pub label: String,
    /// Models that are it.
    pub models: Models,
}

/// Objects of a recipe, as somebody calls them.
#[derive(Clone, Debug, PartialEq)]
pub struct Which {
    /// As they were called.
    pub called: String,
    /// Labels and words in common form that mean them.
    pub labels: BTreeSet<String>,
    /// Models that are it: uids of the first catalog that has some.
    pub uids: BTreeSet<String>,
}

/// Objects that come.
#[derive(Clone, Debug, PartialEq)]
pub struct Addition {
    /// What.
    pub thing: Named,
    /// How many.
    pub count: Count,
    /// How and where.
    pub stands: Vec<Stand>,
    /// "two more": an item that is there already gets them.
    pub is_more: bool,
}

/// Another number of objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NumberOf {
    /// So many.
    Count(Count),
    /// More or fewer.
    Moved(Move),
}

/// The acts of a change, and what a person should know of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Acts {
    /// In their order.
    pub acts: Vec<Act>,
    /// Sentences.
    pub notes: Vec<String>,
}

impl Acts {
    fn of(acts: Vec<Act>) -> Self {
        Self { acts, notes: Vec::new() }
    }

    fn one(act: Act) -> Self {
        Self::of(vec![act])
    }

    fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    fn with(mut self, more: Self) -> Self {
        self.acts.extend(more.acts);
        self.notes.extend(more.notes);
        self
    }
}

impl Change {
    /// What is to be done in a recipe for it.
    ///
    /// # Errors
    /// What cannot be changed there, or is ambiguous, and what to write instead.
    pub fn acts(&self, subject: &Subject, known: &Known) -> Result<Acts, Problem> {
        match self {
            Self::Set(path, value) => values::set(subject, path, value.clone()),
            Self::Unset(path) => values::unset(subject, path),
            Self::To(param, amount) => values::to(subject, *param, amount),
            Self::Words(path, words) => values::set(subject, path, values::one_of(words)),
            Self::Move(param, how) => shift::moved(subject, *param, *how),
            Self::Sweep(param, values) => values::sweep(subject, *param, values),
            Self::SweepWords(path, words) => values::sweep_words(subject, path, words),
            Self::Murkier(steps) => shift::murkier(subject, *steps),
            Self::Muddier(steps) => shift::muddier(subject, *steps),
            Self::Rougher(factor) => bottom::rougher(subject, *factor),
            Self::Shape(kind) => bottom::shape(subject, kind),
            Self::Structure(kind) => bottom::structure(subject, kind.as_deref()),
            Self::Images(images) => totals::images(subject, *images),
            Self::Splits(shares) => totals::splits(subject, *shares),
            Self::Turn(degrees, held) => vehicle::turn(subject, *degrees, *held),
            Self::Pitch(degrees, held) => vehicle::pitch(subject, *degrees, *held),
            Self::Heading(degrees) => vehicle::heading(subject, *degrees),
            Self::Place(place) => vehicle::place(subject, *place),
            Self::Route(route) => vehicle::route(subject, route),
            Self::Add(addition) => objects::add(subject, known, addition),
            Self::Remove(which) => objects::remove(subject, known, which),
            Self::Clear => objects::clear(subject),
            Self::Swap(which, thing) => objects::swap(subject, known, which, thing),
            Self::Number(which, number) => objects::number(subject, known, which, *number),
            Self::Stand(which, stands) => objects::stand(subject, known, which, stands),
        }
    }
}

/// A recipe after some changes.
#[derive(Clone, Debug)]
pub struct Revision {
    /// The recipe.
    pub subject: Subject,
    /// What was done, and for which words.
    pub done: Vec<Said<Vec<Act>>>,
    /// What a person should know.
    pub notes: Vec<String>,
}

/// Makes changes one after the other.
///
/// # Errors
/// The first change that cannot be made, and what to write instead.
pub fn revise(subject: &Subject, known: &Known, changes: &[Said<Change>]) -> Result<Revision, Problem> {
    let mut revision = Revision { subject: subject.clone(), done: Vec::new(), notes: Vec::new() };
    for change in changes {
        let Acts { acts, notes } = change.value.acts(&revision.subject, known)?;
        for act in &acts {
            revision.subject = revision.subject.with(act).map_err(|error| {
                Problem::whole(format!("{}: {} in {}", error.span, error.message, error.path), error.help)
            })?;
        }
        revision.notes.extend(notes);
        revision.done.push(Said { value: acts, source: change.source.clone() });
    }
    let before = objects::orphans(subject, known);
    let is_new = |[_, of]: &&[String; 2]| !before.iter().any(|[_, known]| known == of);
    match objects::orphans(&revision.subject, known).iter().find(is_new) {
        Some([what, of]) => {
            let help = format!("remove the {what} too, or say first where they are to stand");
            Err(Problem::whole(format!("{what} would stand by a {of} that is not there"), help))
        }
        None => Ok(revision),
    }
}
