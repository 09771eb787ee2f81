//! The table of words of changes in the program, `catalogs/changes.yaml`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use serde::Deserialize;

use crate::draft::edit::Param;
use crate::draft::read::phrases::{Phrases, Words};

const TABLE: &str = include_str!("../../../../catalogs/changes.yaml");

static LEXICON: LazyLock<Lexicon> =
    LazyLock::new(|| Lexicon::of(TABLE).expect("the table in the program is sound: a test loads it"));

/// The table in the program.
pub(super) fn lexicon() -> &'static Lexicon {
    &LEXICON
}

/// What is to be done.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Verb {
    Add,
    Put,
    Remove,
    Replace,
    Clear,
    Sweep,
    Bury,
    Double,
    Halve,
    More,
    Fewer,
    Rename,
    Move,
    Turn,
    Pitch,
    Point,
}

/// More or less, in one word.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Degree {
    Warmer,
    Colder,
    Saltier,
    Fresher,
    Deeper,
    Shallower,
    Murkier,
    Clearer,
    Muddier,
    Coarser,
    Rougher,
    Flatter,
    Higher,
    Lower,
    Closer,
    Farther,
    Faster,
    Slower,
    Brighter,
    Dimmer,
    Noisier,
    Quieter,
}

/// What is spoken of.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Topic {
    Water,
    Bottom,
    Sonar,
    Vehicle,
    Picture,
    Split,
}

/// Where something is.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Relation {
    Left,
    Right,
    Front,
    Behind,
    Near,
    On,
    Against,
    Off,
    AboveBottom,
    BelowSurface,
    Within,
    Apart,
}

/// How something stands.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Manner {
    Floating,
    Moored,
    Buried,
    Half,
    Side,
    Upright,
    Heap,
    Row,
    Settled,
    School,
    Scattered,
}

/// Forms of a path.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Way {
    Orbit,
    Lawnmower,
    Follow,
    Approach,
    Views,
    Hover,
}

/// Directions of a turn.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Turning {
    Left,
    Right,
    Up,
    Down,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    verbs: BTreeMap<Verb, Words>,
    by: Words,
    instead: Words,
    params: BTreeMap<Param, Words>,
    images: Words,
    degrees: BTreeMap<Degree, Words>,
    turbidity: BTreeMap<String, Words>,
    salt: BTreeMap<String, Words>,
    sediments: BTreeMap<String, Words>,
    shapes: BTreeMap<String, Words>,
    structures: BTreeMap<String, Words>,
    routes: BTreeMap<Way, Words>,
    topics: BTreeMap<Topic, Words>,
    relations: BTreeMap<Relation, Words>,
    stands: BTreeMap<Manner, Words>,
    headings: BTreeMap<String, Words>,
    turns: BTreeMap<Turning, Words>,
    to: Words,
    difference: Words,
    fillers: Words,
}

/// What the table says, ready to be matched.
#[derive(Debug)]
pub(super) struct Lexicon {
    pub verbs: Phrases<Verb>,
    /// Between what goes and what comes.
    pub by: Phrases<()>,
    pub instead: Phrases<()>,
    pub params: Phrases<Param>,
    pub images: Phrases<()>,
    pub degrees: Phrases<Degree>,
    pub turbidity: Phrases<String>,
    /// Parts per thousand.
    pub salt: Phrases<f64>,
    pub sediments: Phrases<String>,
    pub shapes: Phrases<String>,
    pub structures: Phrases<String>,
    pub routes: Phrases<Way>,
    pub topics: Phrases<Topic>,
    pub relations: Phrases<Relation>,
    pub stands: Phrases<Manner>,
    /// Degrees counter-clockwise from east.
    pub headings: Phrases<f64>,
    pub turns: Phrases<Turning>,
    pub to: Phrases<()>,
    pub difference: Phrases<()>,
    pub fillers: Phrases<()>,
    /// Every word of the table, in common form.
    pub known: BTreeSet<String>,
}

impl Lexicon {
    fn of(text: &str) -> Result<Self, String> {
        let table: Table = serde_yaml::from_str(text).map_err(|error| format!("changes.yaml: {error}"))?;
        let mut read = Self {
            verbs: phrases(&table.verbs),
            by: plain(&table.by),
            instead: plain(&table.instead),
            params: phrases(&table.params),
            images: plain(&table.images),
            degrees: phrases(&table.degrees),
            turbidity: phrases(&table.turbidity),
            salt: numbers(&table.salt)?,
            sediments: phrases(&table.sediments),
            shapes: phrases(&table.shapes),
            structures: phrases(&table.structures),
            routes: phrases(&table.routes),
            topics: phrases(&table.topics),
            relations: phrases(&table.relations),
            stands: phrases(&table.stands),
            headings: numbers(&table.headings)?,
            turns: phrases(&table.turns),
            to: plain(&table.to),
            difference: plain(&table.difference),
            fillers: plain(&table.fillers),
            known: BTreeSet::new(),
        };
        read.known = read.words();
        Ok(read)
    }

    fn words(&self) -> BTreeSet<String> {
        let mut known = BTreeSet::new();
        let mut all = |words: &mut dyn Iterator<Item = (crate::draft::read::token::Language, &str)>| {
            known.extend(words.map(|(_, word)| word.to_owned()));
        };
        all(&mut self.verbs.words());
        all(&mut self.params.words());
        all(&mut self.degrees.words());
        all(&mut self.relations.words());
        all(&mut self.stands.words());
        all(&mut self.routes.words());
        all(&mut self.topics.words());
        all(&mut self.turns.words());
        all(&mut self.headings.words());
        for words in [&self.turbidity, &self.sediments, &self.shapes, &self.structures] {
            all(&mut words.words());
        }
        for words in [&self.by, &self.instead, &self.images, &self.to, &self.difference, &self.fillers] {
            all(&mut words.words());
        }
        all(&mut self.salt.words());
        known
    }
}

fn phrases<T: Clone>(table: &BTreeMap<T, Words>) -> Phrases<T> {
    Phrases::of(table.iter().map(|(means, words)| (means.clone(), words)))
}

fn plain(words: &Words) -> Phrases<()> {
    Phrases::of([((), words)])
}

fn numbers(table: &BTreeMap<String, Words>) -> Result<Phrases<f64>, String> {
    let number = |text: &String| text.parse::<f64>().map_err(|_| format!("changes.yaml: `{text}` is no number"));
    let table = table.iter().map(|(text, words)| Ok((number(text)?, words))).collect::<Result<Vec<_>, String>>()?;
    Ok(Phrases::of(table))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_loads_and_what_it_does_not_know_is_refused() {
        assert!(Lexicon::of(TABLE).unwrap().known.len() > 500);
        for (from, to) in [("  warmer:", "  warmed:"), ("  \"35\":", "  salty:"), ("instead:", "insteadd:")] {
            assert!(Lexicon::of(&TABLE.replacen(from, to, 1)).is_err(), "{to}");
        }
    }
}
