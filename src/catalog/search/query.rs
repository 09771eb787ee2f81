//! What was asked for: the words of a query as units of meaning, typing errors repaired.

use super::Terms;
use crate::catalog::concepts::{Concept, concepts};
use crate::catalog::error::CatalogError;
use crate::catalog::words::words;

/// Most words of a query that are looked at.
const MOST_WORDS: usize = 16;

/// One thing of several that a query asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// As they were written, in common form.
    pub words: Vec<String>,
    /// Other words that may have been meant.
    pub repaired: Vec<String>,
    /// Labels and groups that it speaks of.
    pub concepts: Vec<Concept>,
    /// How sure the meaning is: 1 as written, less where it was repaired.
    pub sure: f32,
}

/// Reads a query against the terms of a catalog.
///
/// # Errors
/// If an index on disk cannot be read.
pub fn read(query: &str, terms: &dyn Terms) -> Result<Vec<Wanted>, CatalogError> {
    let mut written = words(query);
    written.truncate(MOST_WORDS);
    let mut all = Vec::new();
    for unit in concepts().units(&written) {
        all.push(Wanted { words: unit.words, repaired: Vec::new(), concepts: unit.concepts, sure: 1.0 });
    }
    if all.iter().all(|wanted| !wanted.concepts.is_empty()) {
        return Ok(all);
    }
    // With errors repaired, neighbours may mean something together: `oil barell`.
    let mut repaired = Vec::new();
    for wanted in &all {
        for word in &wanted.words {
            let meant = if wanted.concepts.is_empty() { repair(word, terms)? } else { word.clone() };
            repaired.push((word.clone(), meant));
        }
    }
    let meant: Vec<String> = repaired.iter().map(|(_, meant)| meant.clone()).collect();
    let mut at = 0;
    let mut out = Vec::new();
    for unit in concepts().units(&meant) {
        // A word in a script without spaces may have been cut: it was never repaired.
        let count = unit.words.len().min(repaired.len() - at);
        let as_written: Vec<String> = repaired[at..at + count].iter().map(|(word, _)| word.clone()).collect();
        at += count;
        let same = as_written == unit.words;
        let mut wanted = Wanted {
            repaired: if same { Vec::new() } else { unit.words },
            words: as_written,
            concepts: unit.concepts,
            sure: if same { 1.0 } else { 0.8 },
        };
        if wanted.concepts.is_empty()
            && let Some(concept) = wanted.words.iter().find_map(|word| last_part(word))
        {
            (wanted.concepts, wanted.sure) = (concept, 0.7);
        }
        out.push(wanted);
    }
    Ok(out)
}

/// The word that was meant; itself if it is known or none is near.
fn repair(word: &str, terms: &dyn Terms) -> Result<String, CatalogError> {
    let letters = word.chars().count();
    // In halves.
    let errors = match letters {
        0..=3 => return Ok(word.into()),
        4..=5 => 2,
        6 => 3,
        _ => 4,
    };
    if !word.chars().all(char::is_alphabetic) {
        return Ok(word.into());
    }
    let vocabulary = concepts().vocabulary().iter().map(String::as_str);
    if let Some(near) = nearest(word, vocabulary, errors) {
        return Ok(near.into());
    }
    if !terms.postings(word)?.is_empty() || last_part(word).is_some() {
        return Ok(word.into());
    }
    // Nobody mistypes a first letter often enough to look through all terms for it.
    let first = word.chars().next().unwrap_or_default();
    Ok(nearest(word, terms.beginning_with(first).into_iter(), errors).unwrap_or(word).into())
}

pub(crate) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>, errors: usize) -> Option<&'a str> {
    let (length, first) = (word.len(), word.chars().next());
    known
        .filter(|other| {
            other.len() >= 3 && other.len().abs_diff(length) <= errors / 2 && !other.starts_with(['#', '='])
        })
        .filter_map(|other| {
            let distance = half_errors(word, other);
            let other_first = other.chars().next() != first;
            // A wrong first letter counts as one more.
            (distance + 2 * usize::from(other_first) <= errors).then_some((distance, other_first, other))
        })
        .min()
        .map(|(_, _, other)| other)
}

/// How many half errors lead from one word to the other. What fingers do most counts half: a letter doubled or not, two
/// neighbours swapped. All letters in another order behind the first count one and a half.
pub(crate) fn half_errors(word: &str, other: &str) -> usize {
    let once = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.dedup();
        letters
    };
    let sorted = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    let errors = strsim::damerau_levenshtein(word, other);
    let same_letters = word.chars().next() == other.chars().next() && sorted(word) == sorted(other);
    match errors {
        0 => 0,
        _ if once(word) == once(other) => 1,
        1 if same_letters => 1,
        _ if same_letters => 3,
        _ => 2 * errors,
    }
}

/// What the last part of a compound means: `Lkwreifen`, `rustbucket`.
fn last_part(word: &str) -> Option<Vec<Concept>> {
    let starts: Vec<usize> = word.char_indices().map(|(at, _)| at).skip(3).collect();
    starts.into_iter().filter(|&at| word[at..].chars().count() >= 4).find_map(|at| {
        let units = concepts().units(&[word[at..].to_owned()]);
        units.into_iter().map(|unit| unit.concepts).find(|meant| !meant.is_empty())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::search::MemoryTerms;

    fn labels(query: &str) -> Vec<&'static str> {
        let wanted = read(query, &MemoryTerms::default()).expect("in memory");
        wanted.iter().flat_map(|wanted| &wanted.concepts).map(|&concept| concepts().name(concept)).collect()
    }

    #[test]
    fn queries_mean_the_same_in_every_language_and_with_errors() {
        for (query, label) in [
            ("rusty anchor", "anchor"),
            ("ancor", "anchor"),
            ("achnors", "anchor"),
            ("Schiffsanker", "anchor"),
            ("ancre rouillée", "anchor"),
            ("生锈的锚", "anchor"),
            ("tyre", "tire"),
            ("Lkwreifen", "truck-tire"),
            ("oil barell", "oil-drum"),
            ("propellor", "propeller"),
            ("torpedos", "torpedo"),
            ("shoping cart", "shopping-trolley"),
            ("cinderblocks", "cinder-block"),
            ("row boat", "rowing-boat"),
        ] {
            assert!(labels(query).contains(&label), "{query}: {:?}", labels(query));
        }
        assert!(labels("xyzzy").is_empty());
    }
}
