//! What somebody calls a thing, to the models that are it.
//!
//! A model is a thing if its label is what was said or a kind of it; words like "wooden" and "large" choose among those
//! where some fit. There is never a substitute: for a unicorn there is no model. Knows nothing of prompts.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::read::text::Text;
use super::read::token::Kind;
use super::read::vocabulary::vocabulary;
use super::{Known, Models};
use crate::catalog::concepts::{Concept, concepts};
use crate::catalog::priors::{material_of, prior, priors};
use crate::catalog::search::Terms as _;
use crate::catalog::search::terms::label_term;
use crate::catalog::words::words;
use crate::catalog::{Asset, Catalog};

/// Most models of a label of a large collection.
const MOST: usize = 500;
/// Most labels that are named instead of one that is not there.
const MOST_NEAR: usize = 6;

/// Models that are what somebody said.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::draft) struct Found {
    /// The thing's name in English: a label, or a group such as `debris`, whose models have labels of their own.
    pub label: String,
    /// The models.
    pub models: Models,
    /// Words of the name, in common form, that chose among the models of the label.
    pub narrowed_by: Vec<String>,
}

/// The models that a name means, in any of five languages and with typing errors: "rusty anchors", "Fässer", "wooden
/// ladder", "junk".
///
/// # Errors
/// If no catalog has them: the labels that are there and may do instead, the nearest first.
pub(in crate::draft) fn models(name: &str, known: &Known) -> Result<Found, Vec<String>> {
    let said = Said::of(name);
    // Catalogs that were put together by hand come before large collections.
    let (by_hand, large): (Vec<_>, Vec<_>) = known.catalogs.iter().partition(|(_, catalog)| catalog.disk().is_none());
    for (catalog_name, catalog) in by_hand.into_iter().chain(large) {
        if let Some(found) = said.in_catalog(catalog_name, catalog) {
            return Ok(found);
        }
    }
    Err(near(&said, known))
}

/// Whether a name means something that the table of things knows, whatever the catalogs have.
pub(in crate::draft) fn is_known_thing(name: &str) -> bool {
    Said::of(name).concept.is_some()
}

/// The label or group that a name means, whatever the catalogs have.
pub(in crate::draft) fn name_of(name: &str) -> Option<String> {
    Said::of(name).concept.map(|concept| concepts().name(concept).to_owned())
}

/// A name, read.
struct Said {
    /// In common form, errors repaired.
    words: Vec<String>,
    /// What its last thing is.
    concept: Option<Concept>,
    /// The words of that.
    head: Vec<String>,
}

impl Said {
    fn of(name: &str) -> Self {
        let text = Text::of(name);
        let silent = |word: &String| words(word).is_empty() || words(&format!("{word} x")) == ["x"];
        let forms =
            text.tokens.iter().filter(|token| token.kind != Kind::Mark('-')).filter(|token| !token.is_ideograph());
        let mut forms: Vec<String> = forms.map(|token| token.form.clone()).filter(|word| !silent(word)).collect();
        // A script without spaces is cut by the table.
        forms.extend(words(name).into_iter().filter(|word| word.chars().all(crate::catalog::words::is_ideograph)));
        let units = concepts().units(&forms);
        let wrecked = forms.iter().any(|word| is_wreck(word));
        let meant = units.iter().rev().filter(|unit| !unit.concepts.is_empty());
        // The wreck of a car is a car; that of a ship is a wreck.
        let chosen = meant.clone().find(|unit| !(wrecked && unit.concepts.iter().any(|c| is_ship_or_wreck(*c))));
        let unit = if wrecked { chosen.or_else(|| meant.clone().next()) } else { meant.clone().next() };
        let mut concept = unit.and_then(|unit| unit.concepts.first().copied());
        if wrecked && concept.is_some_and(is_ship_or_wreck) {
            concept = concepts().number("shipwreck");
        }
        let mut head = unit.map(|unit| unit.words.clone()).unwrap_or_default();
        let declined = forms.last().and_then(|word| {
            let roots = ["ern", "em", "en", "n", "e"].iter().filter_map(|ending| word.strip_suffix(ending));
            let meant = |root: &str| {
                let root = crate::catalog::words::stem(root);
                concepts().units(std::slice::from_ref(&root)).iter().find_map(|unit| unit.concepts.first().copied())
            };
            roots.filter(|root| root.len() > 3).find_map(|root| Some((meant(root)?, root.to_owned())))
        });
        if concept.is_none()
            && let Some((meant, part)) = declined.or_else(|| forms.last().and_then(|word| compound(word)))
        {
            (concept, head) = (Some(meant), vec![part]);
        }
        Self { words: forms, concept, head }
    }

    fn in_catalog(&self, name: &str, catalog: &Catalog) -> Option<Found> {
        let all = self.candidates(catalog);
        let mut label = self.words.join("-");
        let by_name = || all.iter().filter(|asset| words(&asset.label) == self.words).collect::<Vec<&Asset>>();
        let mut fitting = if self.concept.is_none() { by_name() } else { Vec::new() };
        if let Some(concept) = self.concept {
            let table = concepts();
            label = table.name(concept).to_owned();
            fitting = all.iter().filter(|asset| is_a(asset, concept)).collect();
            if fitting.is_empty() {
                fitting = all.iter().filter(|asset| vocabulary().passes(&asset.label, &label)).collect();
            }
            // A kind that is searched for by a name of its own is labelled as what it is a kind of.
            if let Some(wider) = table.group(concept).filter(|wider| table.is_group(concept) && !table.is_group(*wider))
            {
                label = table.name(wider).to_owned();
            }
        }
        if fitting.is_empty() {
            (fitting, label) = (by_name(), self.words.join("-"));
        }
        if fitting.is_empty() {
            return None;
        }
        let narrowed_by = self.narrow(&mut fitting);
        Some(Found { label, models: models_of(name, catalog, &fitting), narrowed_by })
    }

    /// The models that may be it.
    fn candidates<'c>(&self, catalog: &'c Catalog) -> Cow<'c, [Asset]> {
        let Some(disk) = catalog.disk() else { return Cow::Borrowed(&catalog.assets) };
        let mut labels: BTreeSet<String> = BTreeSet::from([self.words.join("-"), self.words.join(" ")]);
        if let Some(concept) = self.concept {
            let below = priors()
                .map(|(label, _)| label)
                .filter(|label| concepts().number(label).is_some_and(|number| is_below(number, concept)));
            labels.extend(below.map(str::to_owned));
        }
        let numbers = labels.iter().flat_map(|label| disk.postings(&label_term(label)).unwrap_or_default());
        let assets = numbers.filter_map(|posting| catalog.asset(posting.model).ok());
        Cow::Owned(assets.filter(|asset| asset.path.is_file()).take(MOST).collect())
    }

    /// Keeps what the other words of the name fit best, if they fit some: "wooden ladder", "large rock".
    fn narrow(&self, fitting: &mut Vec<&Asset>) -> Vec<String> {
        let mut narrowed_by = Vec::new();
        let own = self.concept.map(|concept| words(concepts().name(concept))).unwrap_or_default();
        for word in self.words.iter().filter(|word| !own.contains(word)) {
            let fits = |asset: &&Asset| has_word(asset, word, &self.head);
            let count = fitting.iter().filter(|asset| fits(asset)).count();
            if count > 0 && count < fitting.len() {
                fitting.retain(fits);
            }
            if count > 0 {
                narrowed_by.push(word.clone());
            }
        }
        narrowed_by
    }
}

fn is_wreck(word: &str) -> bool {
    vocabulary().wrecked.contains(word)
}

fn is_ship_or_wreck(concept: Concept) -> bool {
    matches!(concepts().name(concept), "ship" | "boat" | "vessel" | "shipwreck")
}

/// Whether a concept is this one or belongs to it.
fn is_below(concept: Concept, wider: Concept) -> bool {
    concept == wider || concepts().groups(concept).any(|group| group == wider)
}

/// Whether a model is what a concept means.
fn is_a(asset: &Asset, concept: Concept) -> bool {
    let table = concepts();
    let label =
        table.number(&asset.label).or_else(|| table.label_in(&asset.label).and_then(|label| table.number(label)));
    let Some(label) = label else { return false };
    if is_below(label, concept) {
        return true;
    }
    let says = |text: &str| table.read(text).iter().any(|unit| unit.concepts.contains(&concept));
    match table.group(concept).filter(|wider| !table.is_group(*wider)) {
        // A kind of a label (`wine-bottle`): that label, and its name or tags tell the kind.
        Some(wider) => is_below(label, wider) && (says(&asset.name) || asset.tags.iter().any(|tag| says(tag))),
        None => table.is_group(concept) && asset.tags.iter().any(|tag| says(tag)),
    }
}

/// Whether a word tells of a model: one of its name, tags and uid, or its material.
fn has_word(asset: &Asset, word: &str, head: &[String]) -> bool {
    let told = |text: &str| words(text).iter().any(|other| other == word);
    let made_of = material_of("", word).filter(|_| !head.contains(&word.to_owned()));
    told(&asset.name)
        || told(&asset.label)
        || told(&asset.uid)
        || asset.tags.iter().any(|tag| told(tag))
        || made_of.is_some_and(|material| material == asset.material)
}

fn models_of(name: &str, catalog: &Catalog, fitting: &[&Asset]) -> Models {
    let sizes = fitting
        .iter()
        .map(|asset| asset.size_m.or_else(|| prior(&asset.label).map(|prior| prior.size_m[1])).unwrap_or(1.0));
    let size_m = sizes.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], size| [least.min(size), most.max(size)]);
    let label = &fitting[0].label;
    let one_label = fitting.iter().all(|asset| asset.label == *label);
    let with_label = match catalog.disk() {
        Some(disk) => disk.postings(&label_term(label)).map_or(usize::MAX, |postings| postings.len()),
        None => catalog.assets.iter().filter(|asset| asset.label == *label).count(),
    };
    Models {
        catalog: name.to_owned(),
        uids: fitting.iter().map(|asset| asset.uid.clone()).collect(),
        label: one_label.then(|| label.clone()),
        is_whole_label: one_label && with_label == fitting.len(),
        size_m,
        material: fitting[0].material.clone(),
    }
}

/// What the last part of a compound means, where its first part is a word, too: `Lkwreifen`, `Ankerkette`.
fn compound(word: &str) -> Option<(Concept, String)> {
    let is_word = |part: &str| {
        [part, part.trim_end_matches('s'), part.trim_end_matches('n')].iter().any(|part| {
            part.len() >= 3 && (concepts().vocabulary().contains(*part) || vocabulary().parts.contains(*part))
        })
    };
    let cuts = word.char_indices().map(|(at, _)| at).skip(3);
    cuts.filter(|&at| word.len() - at >= 4 && is_word(&word[..at])).find_map(|at| {
        let part = crate::catalog::words::stem(&word[at..]);
        let units = concepts().units(std::slice::from_ref(&part));
        units.iter().find_map(|unit| unit.concepts.first().copied()).map(|concept| (concept, part))
    })
}

/// Labels that are there, of the same group or spelled alike, the nearest first.
fn near(said: &Said, known: &Known) -> Vec<String> {
    let mut labels: BTreeSet<String> = BTreeSet::new();
    for (_, catalog) in &known.catalogs {
        labels.extend(catalog.assets.iter().map(|asset| asset.label.clone()));
    }
    let table = concepts();
    let groups: Vec<Concept> = said.concept.into_iter().flat_map(|concept| table.groups(concept)).collect();
    let name = said.words.join("-");
    let mut ranked: Vec<(usize, usize, String)> = Vec::new();
    for label in labels {
        let number = table.number(&label);
        // How many groups up they meet; the widest ones hold too much to be alike.
        let kin = number.and_then(|number| groups.iter().take(1).position(|group| is_below(number, *group)));
        let alike = strsim::jaro_winkler(&name, &label);
        let spelled = alike > 0.85;
        if kin.is_some() || spelled {
            ranked.push((kin.unwrap_or(9), 1000 - (1000.0 * alike) as usize, label));
        }
    }
    ranked.sort();
    ranked.into_iter().take(MOST_NEAR).map(|(_, _, label)| label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draft::read::summary::known;

    fn found(name: &str) -> Option<(String, Vec<String>)> {
        let (_folder, known) = known();
        models(name, &known).ok().map(|found| (found.label, found.models.uids))
    }

    fn uids(name: &str) -> String {
        found(name).map(|(_, uids)| uids.join(" ")).unwrap_or_default()
    }

    #[test]
    fn names_lead_to_models_that_are_it() {
        for (name, label, uids) in [
            ("rusty anchors", "anchor", "anchor"),
            ("ancor", "anchor", "anchor"),
            ("锚", "anchor", "anchor"),
            ("生锈的锚", "anchor", "anchor"),
            ("wooden ladder", "ladder", "ladder-wooden"),
            ("truck tyres", "tire", "truck-tire"),
            ("moored mine", "moored-mine", "moored-mine"),
            ("plastic barrel", "barrel", "oil-drum"),
            ("large rock", "rock", "rock-3"),
            ("amfora", "amphora", "amphora"),
            ("bycicle", "bicycle", "bicycle"),
            ("Fahrräder", "bicycle", "bicycle"),
            ("sunken wooden ship", "shipwreck", "shipwreck"),
            ("plane wreck", "aircraft", "aircraft"),
            ("wreck of an aeroplane", "aircraft", "aircraft"),
        ] {
            assert_eq!(
                found(name).map(|(label, uids)| (label, uids.join(" "))),
                Some((label.into(), uids.into())),
                "{name}"
            );
        }
        assert!(uids("mines").contains("moored-mine") && uids("mines").contains("bottom-mine"));
        assert!(uids("bottles").contains("beer-bottle") && !uids("wine bottle").contains("beer-bottle"));
        assert!(uids("junk").split(' ').count() > 8 && uids("scrap").contains("tire"));
        assert!(uids("fishing gear").contains("lobster-pot") && uids("ordnance").contains("torpedo"));
    }

    #[test]
    fn what_no_catalog_has_has_no_substitute() {
        for name in ["unicorn", "grand piano", "car", "spaceship", "wheelbarrow", "xyzzy", "", "moon", "dragon"] {
            assert_eq!(found(name), None, "{name}");
        }
        let near = models("helicopter", &known().1).expect_err("none there");
        assert!(near.contains(&"aircraft".to_owned()), "{near:?}");
    }
}
