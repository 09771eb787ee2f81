//! The table of words in the program, `catalogs/vocabulary.yaml`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use serde::Deserialize;

pub(in crate::draft) use super::meaning::{Bound, Cue, RangeWord, Vague, Word};
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

/// A cue's words by where they stand.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sides {
    before: Words,
    behind: Words,
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
    strange: Words,
    doubtful: Words,
    cues: BTreeMap<Cue, Sides>,
    words: BTreeMap<Word, Words>,
    ignored: BTreeMap<String, Words>,
    sediments: BTreeMap<String, Words>,
    shapes: BTreeMap<String, Words>,
    environments: BTreeMap<String, Words>,
    turbidities: BTreeMap<String, Words>,
    edits: BTreeMap<String, Words>,
    misspelt: BTreeMap<String, Vec<String>>,
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
    /// Words for things that are seldom meant as such.
    pub(in crate::draft) doubtful: BTreeSet<String>,
    /// Words for what sonars never see.
    strange: BTreeSet<String>,
    /// Words that say nothing.
    pub(in crate::draft) plain: BTreeSet<String>,
    /// What a number is of, by the words before it.
    pub(in crate::draft) cues_before: Phrases<Cue>,
    /// What a number is of, by the words behind it.
    pub(in crate::draft) cues_behind: Phrases<Cue>,
    /// Words of requests.
    pub(in crate::draft) words: Phrases<Word>,
    /// Adjectives that change nothing, with the reason.
    pub(in crate::draft) ignored: Phrases<String>,
    /// Sediments of the recipe.
    pub(in crate::draft) sediments: Phrases<Vec<String>>,
    /// Kinds of `seabed.shape`.
    pub(in crate::draft) shapes: Phrases<String>,
    /// Kinds of `environment.kind`.
    pub(in crate::draft) environments: Phrases<String>,
    /// Kinds of `water.turbidity`.
    pub(in crate::draft) turbidities: Phrases<String>,
    /// How changes of something that is there begin.
    pub(in crate::draft) edits: Phrases<()>,
    /// Labels by the name that they pass for, too.
    passes: BTreeMap<String, Vec<String>>,
    /// English words by spellings that are words of another language, or too far from them.
    misspelt: BTreeMap<String, String>,
}

impl Vocabulary {
    fn of(text: &str) -> Result<Self, String> {
        let table: Table = serde_yaml::from_str(text).map_err(|error| format!("vocabulary.yaml: {error}"))?;
        let mut shares = Vec::new();
        for (share, words) in &table.shares {
            let value: f64 = share.parse().map_err(|_| format!("vocabulary.yaml: shares: `{share}` is no number"))?;
            shares.push((value, words));
        }
        let misspelt = table
            .misspelt
            .iter()
            .flat_map(|(word, spellings)| spellings.iter().map(|spelling| (spelling.clone(), word.clone())));
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
            doubtful: forms(&table.doubtful),
            strange: forms(&table.strange),
            plain: forms(&table.plain),
            cues_before: Phrases::of(table.cues.iter().map(|(cue, sides)| (*cue, &sides.before))),
            cues_behind: Phrases::of(table.cues.iter().map(|(cue, sides)| (*cue, &sides.behind))),
            words: phrases(&table.words),
            ignored: Phrases::of(table.ignored.values().map(|words| (words.is.join(" "), words))),
            sediments: Phrases::of(table.sediments.values().map(|words| (words.is.clone(), words))),
            shapes: named(&table.shapes),
            environments: named(&table.environments),
            turbidities: named(&table.turbidities),
            edits: Phrases::of(table.edits.values().map(|words| ((), words))),
            passes: table.passes,
            misspelt: misspelt.collect(),
        };
        let tells =
            Phrases::of([((), &table.languages), ((), &table.plain), ((), &table.wrecked), ((), &table.strange)]);
        let said: Vec<(Language, String)> = [&read.numbers, &read.powers, &read.shares]
            .into_iter()
            .flat_map(Phrases::words)
            .chain(read.vague.words())
            .chain(read.bounds.words())
            .chain(read.ranges.words())
            .chain(read.units.words())
            .chain(tells.words())
            .chain(read.cues_before.words())
            .chain(read.cues_behind.words())
            .chain(read.words.words())
            .chain(read.ignored.words())
            .chain(read.sediments.words())
            .chain(read.shapes.words())
            .chain(read.environments.words())
            .chain(read.turbidities.words())
            .map(|(language, word)| (language, word.to_owned()))
            .collect();
        for (language, word) in said {
            read.languages.entry(word).or_default().insert(language);
        }
        Ok(read)
    }

    /// The languages that a word in common form is of; none if it is in no phrase.
    pub(in crate::draft) fn languages_of(&self, form: &str) -> &BTreeSet<Language> {
        static NONE: BTreeSet<Language> = BTreeSet::new();
        self.languages.get(form).unwrap_or(&NONE)
    }

    /// The English word that a spelling in common form stands for.
    pub(super) fn misspelt(&self, form: &str) -> Option<String> {
        self.misspelt.get(form).cloned()
    }

    /// Whether a word in common form means something here, or is known to mean nothing.
    pub(in crate::draft) fn is_said(&self, form: &str) -> bool {
        self.languages.contains_key(form) && !self.strange.contains(form)
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

fn named(table: &BTreeMap<String, Words>) -> Phrases<String> {
    Phrases::of(table.iter().map(|(name, words)| (name.clone(), words)))
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
