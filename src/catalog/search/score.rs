//! How well each model is what was asked for.

use super::query::{Wanted, read};
use super::terms::{MOST, term_of};
use super::{Posting, Terms};
use crate::catalog::concepts::concepts;
use crate::catalog::error::CatalogError;

/// A model that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Number of the model.
    pub model: u32,
    /// How well it fits: 1 is what was asked for and nothing else.
    pub score: f32,
}

/// A label counts a little less than the very word: those who say `drum` mean a drum before a barrel.
const MEANT: f32 = 0.92;
/// A model of the wider label, where something narrower was asked for.
const WIDER: f32 = 0.45;
/// A word that no table knows tells less than a thing's name.
const PLAIN_WORD: f32 = 0.6;
/// What the very words add to what they mean.
const TOLD_TWICE: f32 = 0.15;
/// Models below this part of the best are no answers.
const FAR_BEHIND: f32 = 0.25;

/// The models that fit a query best, the best first; equally good ones in the order of the catalog.
///
/// # Errors
/// If an index on disk cannot be read.
pub fn find(query: &str, terms: &dyn Terms, most: usize) -> Result<Vec<Found>, CatalogError> {
    let wanted = read(query, terms)?;
    let count = terms.models() as usize;
    let mut total = vec![0.0_f32; count];
    let mut seen = vec![0_u8; count];
    let mut of_unit = vec![0.0_f32; count];
    let mut all = 0.0;
    for unit in &wanted {
        let scored = unit_scores(unit, terms, &mut of_unit)?;
        let weight = if unit.concepts.is_empty() { PLAIN_WORD } else { 1.0 } * rarity(scored.len(), count);
        all += weight;
        for &model in &scored {
            let place = model as usize;
            total[place] += weight * of_unit[place];
            seen[place] += 1;
            of_unit[place] = 0.0;
        }
    }
    let units = wanted.len().max(1) as f32;
    let mut found: Vec<Found> = (0..count as u32)
        .filter(|&model| total[model as usize] > 0.0)
        .map(|model| {
            let place = model as usize;
            let covered = f32::from(seen[place]) / units;
            Found { model, score: total[place] / all * (0.5 + 0.5 * covered) }
        })
        .collect();
    let best = found.iter().map(|f| f.score).fold(0.0, f32::max);
    found.retain(|f| f.score >= FAR_BEHIND * best);
    let order = |a: &Found, b: &Found| b.score.total_cmp(&a.score).then(a.model.cmp(&b.model));
    if found.len() > most && most > 0 {
        found.select_nth_unstable_by(most - 1, order);
    }
    found.truncate(most);
    found.sort_unstable_by(order);
    Ok(found)
}

/// What few models have tells more of them.
fn rarity(with: usize, of: usize) -> f32 {
    if with == 0 || of == 0 {
        return 1.0;
    }
    1.0 + 0.1 * crate::math::real::ln(of as f64 / with as f64) as f32
}

/// Writes how well each model fits one unit, 0 to 1; the models that fit at all.
fn unit_scores(unit: &Wanted, terms: &dyn Terms, scores: &mut [f32]) -> Result<Vec<u32>, CatalogError> {
    let mut fitting = Vec::new();
    let mut raise = |model: u32, score: f32| {
        let held = &mut scores[model as usize];
        if *held == 0.0 {
            fitting.push(model);
        }
        *held = held.max(score);
    };
    let full = f32::from(MOST);
    let mut literal = Vec::new();
    for (words, sure) in [(&unit.words, 1.0), (&unit.repaired, unit.sure)] {
        for (model, weight) in all_of(words, terms)? {
            raise(model, sure * weight / full);
            literal.push((model, sure * weight / full));
        }
    }
    for &concept in &unit.concepts {
        let mut meant = |term: String, share: f32| -> Result<(), CatalogError> {
            for Posting { model, weight } in terms.postings(&term)? {
                raise(model, share * unit.sure * f32::from(weight) / full);
            }
            Ok(())
        };
        meant(term_of(concept), MEANT)?;
        if let Some(wider) = concepts().group(concept).filter(|&group| !concepts().is_group(group)) {
            meant(term_of(wider), WIDER)?;
        }
    }
    // Of those that mean the same, the one that has the very words.
    for (model, score) in literal {
        scores[model as usize] += TOLD_TWICE * score;
    }
    Ok(fitting)
}

/// Models with words of a phrase, and the mean of their weights over the phrase.
fn all_of(words: &[String], terms: &dyn Terms) -> Result<Vec<(u32, f32)>, CatalogError> {
    let mut sums: Vec<(u32, f32)> = Vec::new();
    for word in words {
        let postings = terms.postings(word)?;
        sums = merged(sums, &postings);
    }
    let count = words.len().max(1) as f32;
    // Half a phrase is much less than half of its meaning.
    Ok(sums.into_iter().map(|(model, sum)| (model, sum / count)).collect())
}

fn merged(sums: Vec<(u32, f32)>, more: &[Posting]) -> Vec<(u32, f32)> {
    let mut out = Vec::with_capacity(sums.len() + more.len());
    let (mut left, mut right) = (sums.into_iter().peekable(), more.iter().peekable());
    loop {
        match (left.peek(), right.peek()) {
            (Some(&(a, sum)), Some(p)) if a == p.model => {
                out.push((a, sum + f32::from(p.weight)));
                left.next();
                right.next();
            }
            (Some(&(a, sum)), Some(p)) if a < p.model => {
                out.push((a, sum));
                left.next();
            }
            (_, Some(p)) => {
                out.push((p.model, f32::from(p.weight)));
                right.next();
            }
            (Some(&rest), None) => {
                out.push(rest);
                left.next();
            }
            (None, None) => return out,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::asset::Asset;
    use crate::catalog::search::MemoryTerms;

    #[test]
    fn the_very_thing_comes_first_and_its_kin_after() {
        let asset = |uid: &str, name: &str, label: &str, tags: &[&str]| Asset {
            uid: uid.into(),
            name: name.into(),
            label: label.into(),
            tags: tags.iter().map(|tag| (*tag).into()).collect(),
            ..Asset::default()
        };
        let assets = [
            asset("anchor", "admiralty anchor", "anchor", &["ship"]),
            asset("barrel", "wooden barrel", "barrel", &[]),
            asset("drum", "oil drum, 200 l", "oil-drum", &["barrel"]),
            asset("mine", "moored contact mine", "moored-mine", &["ordnance"]),
            asset("tire", "car tire", "tire", &["car", "tyre"]),
            asset("wheel", "car wheel", "wheel", &["tire"]),
        ];
        let terms = MemoryTerms::of(&assets);
        let found = |query: &str| -> Vec<&str> {
            let found = find(query, &terms, 10).expect("in memory");
            found.iter().map(|f| assets[f.model as usize].uid.as_str()).collect()
        };
        assert_eq!(found("rusty anchor"), ["anchor"]);
        assert_eq!(found("barrels")[..2], ["barrel", "drum"]);
        assert_eq!(found("Ölfass")[..2], ["drum", "barrel"]);
        assert_eq!(found("tyre of a car")[..2], ["tire", "wheel"]);
        assert_eq!(found("sea mine"), ["mine"]);
        assert_eq!(found("munition"), ["mine"]);
        assert!(found("xyzzy").is_empty() && found("").is_empty());
    }
}
