//! The terms of a small catalog, gathered when they are asked for.

use std::collections::BTreeMap;

use super::terms::{Described, terms_of};
use super::{Posting, Terms};
use crate::catalog::asset::Asset;
use crate::catalog::error::CatalogError;

/// Terms in memory.
#[derive(Clone, Debug, Default)]
pub struct MemoryTerms {
    models: u32,
    terms: BTreeMap<String, Vec<Posting>>,
}

impl MemoryTerms {
    /// Of models in their order.
    #[must_use]
    pub fn of(assets: &[Asset]) -> Self {
        let mut held = Self::default();
        for asset in assets {
            let model = held.models;
            let described = Described {
                uid: &asset.uid,
                name: &asset.name,
                label: &asset.label,
                category: "",
                material: &asset.material,
                tags: &asset.tags,
            };
            for (term, weight) in terms_of(&described) {
                held.terms.entry(term).or_default().push(Posting { model, weight });
            }
            held.models += 1;
        }
        held
    }
}

impl Terms for MemoryTerms {
    fn models(&self) -> u32 {
        self.models
    }

    fn postings(&self, term: &str) -> Result<Vec<Posting>, CatalogError> {
        Ok(self.terms.get(term).cloned().unwrap_or_default())
    }

    fn beginning_with(&self, letter: char) -> Vec<&str> {
        self.terms
            .range(String::from(letter)..)
            .map(|(term, _)| term.as_str())
            .take_while(|term| term.starts_with(letter))
            .collect()
    }
}
