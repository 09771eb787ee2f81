//! The table of words in the program, `catalogs/vocabulary.yaml`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use serde::Deserialize;

use super::phrases::{Phrases, Words};
use super::quantity::Unit;
use super::token::Language;

const TABLE: &str = include_str!("../../../catalogs/vocabulary.yaml");

static VOCABULARY: LazyLock<Vocabulary> =
    LazyLock::new(|| Vocabulary::of(TABLE).expect("the table in the program is sound: a test loads it"));

/// The table in the program.
pub(in crate::draft) fn vocabulary() -> &'static Vocabulary {
    &VOCABULARY
}

/// How many, where nobody counts.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum Vague {
    /// Two.
    Couple,
    /// A few.
    Few,
    /// Some.
    Some,
    /// Several.
    Several,
    /// Many.
    Many,
    /// Dozens.
    Dozens,
    /// Hundreds.
    Hundreds,
}

/// What a number is bounded or blurred by.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum Bound {
    /// "up to".
    AtMost,
    /// "at least".
    AtLeast,
    /// "about".
    About,
}

/// Words that make ranges of numbers.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub(in crate::draft) enum RangeWord {
    /// Before the first end.
    From,
    /// Between the ends.
    To,
    /// Between the ends after "between", between the last two of a list.
    And,
    /// Between the last two of a choice.
    Or,
    /// "in equal steps".
    Steps,
    /// "step", behind a number.
    Step,
    /// Between the sides of an area.
    By,
    /// Before the number of steps.
    In,
}

/// Every section of the table.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Table {
    languages: Words,
    numbers: BTreeMap<u64, Words>,
    powers: BTreeMap<u64, Words>,
    shares: BTreeMap<String, Words>,
    vague: BTreeMap<Vague, Words>,
    bounds: BTreeMap<Bound, Words>,
    ranges: BTreeMap<RangeWord, Words>,
    units: BTreeMap<Unit, Words>,
    measure_words: Words,
    wrecked: Words,
    parts: Words,
    passes: BTreeMap<String, Vec<String>>,
    plain: Words,
}

/// What the table says, ready to be matched.
#[derive(Debug)]
pub(in crate::draft) struct Vocabulary {
    languages: BTreeMap<String, BTreeSet<Language>>,
    pub(super) numbers: Phrases<f64>,
    pub(super) powers: Phrases<f64>,
    pub(super) shares: Phrases<f64>,
    /// How many, where nobody counts.
    pub(in crate::draft) vague: Phrases<Vague>,
    /// What a number is bounded by.
    pub(in crate::draft) bounds: Phrases<Bound>,
    /// Words that make ranges.
    pub(in crate::draft) ranges: Phrases<RangeWord>,
    /// Units.
    pub(in crate::draft) units: Phrases<Unit>,
    /// Words between a number and what it counts.
    pub(in crate::draft) measure_words: Phrases<()>,
    /// Words that make a ship a wreck.
    pub(in crate::draft) wrecked: BTreeSet<String>,
    /// First parts of German compounds that are no things.
    pub(in crate::draft) parts: BTreeSet<String>,
    /// Labels by the name that they pass for, too.
    passes: BTreeMap<String, Vec<String>>,
}

impl Vocabulary {
    fn of(text: &str) -> Result<Self, String> {
        let table: Table = serde_yaml::from_str(text).map_err(|error| format!("vocabulary.yaml: {error}"))?;
        let mut shares = Vec::new();
        for (share, words) in &table.shares {
            let value: f64 = share.parse().map_err(|_| format!("vocabulary.yaml: shares: `{share}` is no number"))?;
            shares.push((value, words));
        }
        let mut read = Self {
            languages: BTreeMap::new(),
            numbers: counts(&table.numbers),
            powers: counts(&table.powers),
            shares: Phrases::of(shares),
            vague: phrases(&table.vague),
            bounds: phrases(&table.bounds),
            ranges: phrases(&table.ranges),
            units: phrases(&table.units),
            measure_words: Phrases::of([((), &table.measure_words)]),
            wrecked: forms(&table.wrecked),
            parts: forms(&table.parts),
            passes: table.passes,
        };
        let tells = Phrases::of([((), &table.languages), ((), &table.plain), ((), &table.wrecked)]);
        let said: Vec<(Language, String)> = [&read.numbers, &read.powers, &read.shares]
            .into_iter()
            .flat_map(Phrases::words)
            .chain(read.vague.words())
            .chain(read.bounds.words())
            .chain(read.ranges.words())
            .chain(read.units.words())
            .chain(tells.words())
            .map(|(language, word)| (language, word.to_owned()))
            .collect();
        for (language, word) in said {
            read.languages.entry(word).or_default().insert(language);
        }
        Ok(read)
    }

    /// The languages that a word in common form is of; none if it is in no phrase.
    pub(super) fn languages_of(&self, form: &str) -> &BTreeSet<Language> {
        static NONE: BTreeSet<Language> = BTreeSet::new();
        self.languages.get(form).unwrap_or(&NONE)
    }

    /// Whether models with this label are what somebody calls so, although the table of things has them apart.
    pub(in crate::draft) fn passes(&self, label: &str, called: &str) -> bool {
        self.passes.get(called).is_some_and(|labels| labels.iter().any(|known| known == label))
    }

    /// Every word of the table, in common form.
    pub(super) fn words(&self) -> impl Iterator<Item = &str> {
        self.languages.keys().map(String::as_str)
    }
}

fn phrases<T: Copy>(table: &BTreeMap<T, Words>) -> Phrases<T> {
    Phrases::of(table.iter().map(|(means, words)| (*means, words)))
}

fn forms(words: &Words) -> BTreeSet<String> {
    Phrases::of([((), words)]).words().map(|(_, form)| form.to_owned()).collect()
}

fn counts(table: &BTreeMap<u64, Words>) -> Phrases<f64> {
    Phrases::of(table.iter().map(|(value, words)| (*value as f64, words)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_loads_and_unknown_keys_are_refused() {
        let read = Vocabulary::of(TABLE).expect("sound");
        assert!(read.words().count() > 400);
        let more = format!("{TABLE}\nmore: {{en: [x]}}\n");
        assert!(Vocabulary::of(&more).expect_err("refused").contains("more"));
        let wrong = TABLE.replacen("at-most:", "most:", 1);
        assert!(Vocabulary::of(&wrong).expect_err("refused").contains("most"));
    }
}
