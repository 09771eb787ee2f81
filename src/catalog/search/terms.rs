//! What a model is found by: the words of its name, label and tags, and the labels and groups that they speak of.

use std::collections::BTreeMap;

use crate::catalog::concepts::{Concept, Unit, concepts};
use crate::catalog::words::words;

/// Greatest weight of a term.
pub const MOST: u8 = 40;

/// Of the label that a model is annotated with, and of a category that people chose for it.
const LABEL: u8 = MOST;
/// Of a name of one word; longer names say less with each.
const NAME: u8 = 32;
/// Of a tag.
pub const TAG: u8 = 14;
/// Of the group of a label.
const GROUP: u8 = 16;
/// Of the material and of the words of a uid.
const ASIDE: u8 = 6;

/// What is known of a model before it is searched for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Described<'a> {
    /// Its uid; empty if that is a mere number.
    pub uid: &'a str,
    /// Its name.
    pub name: &'a str,
    /// Its label.
    pub label: &'a str,
    /// A category that people chose for it; empty if it has none.
    pub category: &'a str,
    /// Its material.
    pub material: &'a str,
    /// Its tags.
    pub tags: &'a [String],
}

/// The term of a label or group, which no word looks like.
#[must_use]
pub fn term_of(concept: Concept) -> String {
    format!("#{}", concepts().name(concept))
}

/// The term of a label as it is written, which no word looks like.
#[must_use]
pub fn label_term(label: &str) -> String {
    format!("={label}")
}

/// Every term of a model with its weight.
#[must_use]
pub fn terms_of(model: &Described<'_>) -> BTreeMap<String, u8> {
    let mut terms = Collected(BTreeMap::new());
    terms.label(model.label);
    if !model.category.is_empty() {
        terms.label(model.category);
    }
    terms.name(model.name);
    for tag in model.tags {
        terms_of_tag(tag).into_iter().for_each(|term| terms.add(term, TAG));
    }
    if !model.uid.is_empty() {
        terms.units(&concepts().read(model.uid), ASIDE, ASIDE);
    }
    words(model.material).into_iter().for_each(|word| terms.add(word, ASIDE));
    terms.0
}

/// The terms of a tag; each weighs [`TAG`].
#[must_use]
pub fn terms_of_tag(tag: &str) -> Vec<String> {
    let units = concepts().read(tag);
    let meant = units.iter().flat_map(|unit| &unit.concepts).map(|&concept| term_of(concept));
    let meant: Vec<String> = meant.collect();
    units.into_iter().flat_map(|unit| unit.words).chain(meant).collect()
}

struct Collected(BTreeMap<String, u8>);

impl Collected {
    fn add(&mut self, term: String, weight: u8) {
        let known = self.0.entry(term).or_default();
        *known = (*known).max(weight);
    }

    /// A label speaks for its groups, too.
    fn label(&mut self, label: &str) {
        let units = concepts().read(label);
        self.units(&units, LABEL, LABEL);
        for concept in units.iter().flat_map(|unit| &unit.concepts) {
            for group in concepts().groups(*concept) {
                self.add(term_of(group), GROUP);
            }
        }
    }

    /// The last thing that a name speaks of is what the model is; what stands before it tells it from others.
    fn name(&mut self, name: &str) {
        let units = concepts().read(name);
        let head = units.iter().rposition(|unit| !unit.concepts.is_empty());
        let share = NAME - (2 * units.len().saturating_sub(1)).min(14) as u8;
        for (place, unit) in units.iter().enumerate() {
            let weight = if Some(place) == head { share + 4 } else { share };
            self.units(std::slice::from_ref(unit), share, weight);
        }
        for concept in head.iter().flat_map(|&place| &units[place].concepts) {
            for group in concepts().groups(*concept) {
                self.add(term_of(group), GROUP / 2);
            }
        }
    }

    fn units(&mut self, units: &[Unit], word: u8, concept: u8) {
        for unit in units {
            unit.words.iter().for_each(|text| self.add(text.clone(), word));
            unit.concepts.iter().for_each(|&meant| self.add(term_of(meant), concept));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_weigh_most_and_bring_their_groups() {
        let tags = ["debris".to_owned()];
        let model = Described { name: "small delivery truck tyre", label: "tire", tags: &tags, ..Described::default() };
        let terms = terms_of(&model);
        assert_eq!((terms["#tire"], terms["tire"]), (MOST, MOST));
        assert!(terms["truck"] > terms["#debris"] && terms["#debris"] >= TAG);
        let mine = terms_of(&Described { label: "moored-mine", ..Described::default() });
        assert_eq!((mine["#moored-mine"], mine["#mine"], mine["#ordnance"]), (MOST, GROUP, GROUP));
    }
}
