//! Models dealt out to splits, so that no object of a test image was seen in training.

use std::collections::BTreeMap;

use super::header::{Split, Splits, Stratify};
use crate::catalog::Catalog;
use crate::math::rng::Stream;

/// The split of each model of a catalog.
pub(super) struct Deal {
    dealt: BTreeMap<String, Split>,
    /// Models of a large collection are dealt as they are met.
    singly: Option<(Splits, u64)>,
}

impl Deal {
    /// Deals a catalog's models by their uids: a catalog may be reached by several names.
    pub(super) fn of(splits: &Splits, seed: u64, catalog: &Catalog) -> Self {
        let mut labels: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for asset in &catalog.assets {
            // One stratum for all models is none.
            labels.entry(&asset.label).or_default().push(&asset.uid);
        }
        let dealt = labels.into_values().flat_map(|uids| match splits.stratify {
            Stratify::None => singly(splits, seed, &uids),
            Stratify::Label => within(splits, seed, uids),
        });
        let dealt = dealt.map(|(uid, split)| (uid.to_owned(), split)).collect();
        Self { dealt, singly: catalog.disk().map(|_| (*splits, seed)) }
    }

    /// Whether a model is dealt to a split.
    pub(super) fn is_in(&self, uid: &str, split: Split) -> bool {
        match self.singly {
            Some((splits, seed)) => splits.of_key(seed, uid) == split,
            None => self.dealt.get(uid) == Some(&split),
        }
    }
}

fn singly<'a>(splits: &Splits, seed: u64, uids: &[&'a str]) -> Vec<(&'a str, Split)> {
    uids.iter().map(|&uid| (uid, splits.of_key(seed, uid))).collect()
}

/// The models of one label, in an order of their own laid along the splits: so one more model moves at most one other
/// across each border between two splits. Fewer models than splits cannot be in all of them: they are dealt singly.
fn within<'a>(splits: &Splits, seed: u64, mut uids: Vec<&'a str>) -> Vec<(&'a str, Split)> {
    let with_share: Vec<(Split, f64)> = splits.shares().into_iter().filter(|(_, share)| *share > 0.0).collect();
    if uids.len() < with_share.len() {
        return singly(splits, seed, &uids);
    }
    uids.sort_by_cached_key(|uid| (Stream::at(seed, "dataset", 0, &format!("splits/{uid}")).bits(), *uid));
    let counts = counts(&with_share, uids.len());
    let places = with_share.iter().zip(counts).flat_map(|((split, _), count)| std::iter::repeat_n(*split, count));
    uids.into_iter().zip(places).collect()
}

/// So many things in shares, at least one each; one more thing adds one to one count.
fn counts(shares: &[(Split, f64)], things: usize) -> Vec<usize> {
    let whole: f64 = shares.iter().map(|(_, share)| share).sum();
    let mut counts = vec![1; shares.len()];
    for dealt in shares.len()..things {
        let lack = |i: usize| shares[i].1 / whole * (dealt + 1) as f64 - counts[i] as f64;
        let poorest = (1..shares.len()).fold(0, |best, i| if lack(i) > lack(best) { i } else { best });
        counts[poorest] += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::SplitBy;

    const SPLITS: Splits = Splits { train: 0.8, val: 0.1, test: 0.1, by: SplitBy::Asset, stratify: Stratify::Label };

    fn named(count: usize) -> Vec<String> {
        (0..count).map(|i| format!("model-{i}")).collect()
    }

    fn dealt(uids: &[String]) -> BTreeMap<&str, Split> {
        within(&SPLITS, 7, uids.iter().map(String::as_str).collect()).into_iter().collect()
    }

    #[test]
    fn a_label_of_few_models_is_in_every_split_and_one_of_many_has_its_shares() {
        for (models, expected) in [(3, [1, 1, 1]), (5, [3, 1, 1]), (10, [8, 1, 1]), (40, [32, 4, 4])] {
            let uids = named(models);
            let dealt = dealt(&uids);
            let counts = Split::ALL.map(|split| dealt.values().filter(|found| **found == split).count());
            assert_eq!(counts, expected, "{models} models");
        }
    }

    #[test]
    fn one_more_model_moves_at_most_two_others() {
        let uids = named(60);
        for models in 3..60 {
            let (few, more) = (dealt(&uids[..models]), dealt(&uids[..=models]));
            let moved = few.iter().filter(|(uid, split)| more[**uid] != **split).count();
            assert!(moved <= 2, "{moved} of {models} models moved");
        }
    }
}
