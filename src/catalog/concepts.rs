//! What words mean: labels and groups with their names in several languages, from a table in the program.
//!
//! Knows nothing of catalogs: it reads words and says which labels they speak of.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::LazyLock;

use serde::Deserialize;

use super::error::CatalogError;
use super::words::{is_ideograph, words};

const TABLE: &str = include_str!("../../catalogs/synonyms.yaml");

static CONCEPTS: LazyLock<Concepts> =
    LazyLock::new(|| Concepts::of(TABLE).expect("the table in the program is sound: a test loads it"));

/// Number of a label or group in the table, in alphabetical order.
pub type Concept = u16;

/// Labels and groups with the words that mean them.
#[derive(Debug)]
pub struct Concepts {
    names: Vec<String>,
    groups: Vec<Option<Concept>>,
    /// Words in common form, spaces between them.
    phrases: HashMap<String, Vec<Concept>>,
    /// Every word of the phrases.
    vocabulary: BTreeSet<String>,
    /// Words that phrases begin with, and the most words of such a phrase.
    starts: HashMap<String, usize>,
}

/// Neighbouring words that mean something together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// In common form.
    pub words: Vec<String>,
    /// Labels that they speak of; none if they are in no table.
    pub concepts: Vec<Concept>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    is: Option<String>,
    en: Vec<String>,
    de: Vec<String>,
    es: Vec<String>,
    fr: Vec<String>,
    zh: Vec<String>,
}

/// The table in the program.
#[must_use]
pub fn concepts() -> &'static Concepts {
    &CONCEPTS
}

impl Concepts {
    fn of(text: &str) -> Result<Self, CatalogError> {
        let fault = |problem: String| CatalogError::Table { table: "synonyms.yaml", problem };
        let entries: BTreeMap<String, Entry> = serde_yaml::from_str(text).map_err(|e| fault(e.to_string()))?;
        let names: Vec<String> = entries.keys().cloned().collect();
        let mut table = Self {
            groups: vec![None; names.len()],
            names,
            phrases: HashMap::new(),
            vocabulary: BTreeSet::new(),
            starts: HashMap::new(),
        };
        for (number, (name, entry)) in entries.iter().enumerate() {
            if let Some(group) = &entry.is {
                let known = table.number(group).ok_or_else(|| fault(format!("{name}: there is no group `{group}`")))?;
                table.groups[number] = Some(known);
            }
            table.add(name, number as Concept);
            for word in [&entry.en, &entry.de, &entry.es, &entry.fr, &entry.zh].into_iter().flatten() {
                table.add(word, number as Concept);
            }
        }
        Ok(table)
    }

    fn add(&mut self, text: &str, concept: Concept) {
        let printed = text.replace('ä', "ae").replace('ö', "oe").replace('ü', "ue");
        for form in [text, &printed.replace('Ö', "Oe").replace('Ü', "Ue").replace('Ä', "Ae")] {
            let words = words(form);
            if let Some(first) = words.first() {
                let longest = self.starts.entry(first.clone()).or_default();
                *longest = words.len().max(*longest);
            }
            let joined = (words.len() == 2).then(|| words.concat());
            for phrase in std::iter::once(words.join(" ")).chain(joined) {
                let meant = self.phrases.entry(phrase).or_default();
                if !meant.contains(&concept) {
                    meant.push(concept);
                }
            }
            self.vocabulary.extend(words);
        }
    }

    /// The number of a label or group.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<Concept> {
        self.names.binary_search_by(|known| known.as_str().cmp(name)).ok().map(|place| place as Concept)
    }

    /// Its name.
    #[must_use]
    pub fn name(&self, concept: Concept) -> &str {
        &self.names[usize::from(concept)]
    }

    /// The wider group that a label belongs to.
    #[must_use]
    pub fn group(&self, concept: Concept) -> Option<Concept> {
        self.groups[usize::from(concept)]
    }

    /// The label's group, its group's group and so on.
    pub fn groups(&self, concept: Concept) -> impl Iterator<Item = Concept> + '_ {
        std::iter::successors(self.group(concept), |&group| self.group(group))
    }

    /// Every word that stands in a phrase.
    #[must_use]
    pub fn vocabulary(&self) -> &BTreeSet<String> {
        &self.vocabulary
    }

    /// Whether the last word of a name stands in the table as it is, without an ending of a plural, as a name of a label
    /// that is no group: "Anker", not "anchors".
    #[must_use]
    pub fn is_singular_of(&self, name: &str, label: Concept) -> bool {
        let last = super::words::raw(name).pop().unwrap_or_default();
        !self.is_group(label) && self.meaning(&last).is_some_and(|meant| meant.contains(&label))
    }

    /// What a phrase in common form means.
    fn meaning(&self, phrase: &str) -> Option<&[Concept]> {
        self.phrases.get(phrase).map(Vec::as_slice)
    }

    /// What a word means if an ending of another language is taken off it: `Flaschen`, `bateaux`.
    fn without_ending(&self, word: &str) -> Option<&[Concept]> {
        const ENDINGS: [&str; 7] = ["en", "er", "es", "e", "n", "s", "x"];
        let roots = ENDINGS.iter().filter_map(|ending| word.strip_suffix(ending));
        roots.filter(|root| root.chars().count() >= 3).find_map(|root| self.meaning(root))
    }

    /// The words of a text cut into units, each the longest that means something.
    #[must_use]
    pub fn read(&self, text: &str) -> Vec<Unit> {
        self.units(&words(text))
    }

    /// As [`Self::read`], of words in common form.
    #[must_use]
    pub fn units(&self, words: &[String]) -> Vec<Unit> {
        let mut units = Vec::new();
        let mut at = 0;
        while at < words.len() {
            let (count, concepts) = self.longest_at(&words[at..]);
            if concepts.is_empty() && words[at].chars().all(is_ideograph) {
                units.extend(self.ideographs(&words[at]));
            } else {
                units.push(Unit { words: words[at..at + count].to_vec(), concepts });
            }
            at += count;
        }
        units
    }

    /// How many of the first words mean something together, and what.
    fn longest_at(&self, words: &[String]) -> (usize, Vec<Concept>) {
        let first = &words[0];
        let longest = self.starts.get(first).copied().unwrap_or(0).min(words.len());
        for count in (2..=longest).rev() {
            if let Some(meant) = self.meaning(&words[..count].join(" ")) {
                return (count, meant.to_vec());
            }
        }
        // `row boat` is a rowboat: looked up only where a known word begins like this one.
        let goes_on = |word: &String| word.starts_with(first.as_str()) && word != first;
        if words.len() > 1
            && self.vocabulary.range(first.clone()..).take(2).any(goes_on)
            && let Some(meant) = self.meaning(&words[..2].concat())
        {
            return (2, meant.to_vec());
        }
        let meant = self.meaning(first).or_else(|| self.without_ending(first));
        (1, meant.map(<[Concept]>::to_vec).unwrap_or_default())
    }

    /// A run of a script without spaces: the longest known pieces, and what is left between them.
    fn ideographs(&self, run: &str) -> Vec<Unit> {
        let letters: Vec<char> = run.chars().collect();
        let mut units: Vec<Unit> = Vec::new();
        let mut at = 0;
        while at < letters.len() {
            let piece = |count: usize| letters[at..at + count].iter().collect::<String>();
            let known = (1..=letters.len() - at).rev().find_map(|count| {
                let word = piece(count);
                self.meaning(&word).map(|concepts| Unit { words: vec![word.clone()], concepts: concepts.to_vec() })
            });
            match known {
                Some(unit) => {
                    at += unit.words[0].chars().count();
                    units.push(unit);
                }
                None => {
                    // Letters that mean nothing by themselves stand together: 生锈的 before 锚.
                    match units.last_mut().filter(|unit| unit.concepts.is_empty()) {
                        Some(unit) => unit.words[0].push(letters[at]),
                        None => units.push(Unit { words: vec![piece(1)], concepts: Vec::new() }),
                    }
                    at += 1;
                }
            }
        }
        units
    }

    /// The label that a text names: of the last thing that it speaks of, as in `delivery truck tire`; a part comes after
    /// `of` or in brackets only by chance. Groups are no labels unless nothing else is there.
    #[must_use]
    pub fn label_in(&self, text: &str) -> Option<&str> {
        // What stands before a bracket, a comma or `for` is the thing itself.
        let head = text.split(['(', '[', ',', ';']).map(str::trim).find(|piece| !piece.is_empty())?;
        let head = [" for ", " with ", " on ", " in ", " of ", " from ", " by "]
            .iter()
            .fold(head, |head, cut| head.split_once(cut).map_or(head, |(before, _)| before));
        self.last_label(head).or_else(|| self.last_label(text))
    }

    /// The label of a thing that people put into a category: a narrower one if its name tells of it (`water bottle` among
    /// bottles), else the category's own.
    #[must_use]
    pub fn label_of_category(&self, category: &str, name: &str) -> String {
        let category = category.replace('_', " ");
        let own = category.split('(').next().map(str::trim).filter(|own| !own.is_empty()).unwrap_or(&category);
        let Some(wide) = self.label_in(own) else { return own.to_lowercase().replace(' ', "-") };
        let wide_number = self.number(wide);
        let is_narrower = |label: &&str| {
            self.number(label).is_some_and(|number| self.groups(number).any(|group| Some(group) == wide_number))
        };
        self.label_in(name).filter(is_narrower).unwrap_or(wide).into()
    }

    fn last_label(&self, text: &str) -> Option<&str> {
        let units = self.read(text);
        let meant = || units.iter().rev().filter_map(|unit| unit.concepts.first().copied());
        // A kind of something (`wine-bottle`) is labelled as that.
        let label = |concept: Concept| {
            std::iter::once(concept).chain(self.groups(concept)).find(|&wider| !self.is_group(wider))
        };
        meant().find_map(label).or_else(|| meant().next()).map(|concept| self.name(concept))
    }

    /// Whether others belong to it and nothing is known of its size.
    #[must_use]
    pub fn is_group(&self, concept: Concept) -> bool {
        super::priors::prior(self.name(concept)).is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_label_has_words_and_every_group_is_there() {
        let table = concepts();
        assert!(table.names.len() > 250);
        for (label, _) in super::super::priors::priors() {
            assert!(table.number(label).is_some(), "{label} has a size but no words");
        }
        for concept in 0..table.names.len() as Concept {
            assert!(table.groups(concept).take(9).count() < 5, "{} goes round", table.name(concept));
        }
    }

    #[test]
    fn singulars_are_told_from_plurals() {
        let table = concepts();
        let is_one = |name: &str, label: &str| table.is_singular_of(name, table.number(label).expect("a label"));
        for (name, label) in [
            ("rusty anchor", "anchor"),
            ("Anker", "anchor"),
            ("épave", "shipwreck"),
            ("barco", "boat"),
            ("锚", "anchor"),
        ] {
            assert!(is_one(name, label), "{name}");
        }
        for (name, label) in
            [("anchors", "anchor"), ("Flaschen", "bottle"), ("barcos", "boat"), ("junk", "debris"), ("tire", "anchor")]
        {
            assert!(!is_one(name, label), "{name}");
        }
    }

    #[test]
    fn names_lead_to_labels() {
        let cases = [
            ("small wooden boat", Some("boat")),
            ("round bomb (stands in for a moored-mine shape)", Some("mine")),
            ("three-masted sailing ship", Some("ship")),
            ("delivery truck tyre", Some("tire")),
            ("Propeller of a ship", Some("propeller")),
            ("car_(automobile)", Some("car")),
            ("Shark_LowPoly_v2", Some("shark")),
            ("Weinflaschen", Some("bottle")),
            ("bateaux", Some("boat")),
            ("生锈的锚", Some("anchor")),
            ("Oelfass", Some("oil-drum")),
            ("cinderblock", Some("cinder-block")),
            ("Iain Dawson Kew Road", None),
        ];
        for (text, label) in cases {
            assert_eq!(concepts().label_in(text), label, "{text}");
        }
    }
}
