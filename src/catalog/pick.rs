//! Picking from a catalog: by uid, tags, label or search.

use serde::{Deserialize, Serialize};

use super::asset::Asset;
use super::disk::DiskIndex;
use super::error::{CatalogError, did_you_mean};
use super::index::Catalog;
use super::search::terms::label_term;
use super::search::{Found, MemoryTerms, Terms as _, find};
use super::words::words;

/// What a recipe picks from a catalog: all assets that satisfy every condition given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pick {
    /// Name or folder of the catalog.
    pub catalog: String,
    /// One of these uids.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uid: Option<OneOrMany>,
    /// All of these tags.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tags: Option<Vec<String>>,
    /// This label.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// What fits these words best; several where they fit equally well.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub search: Option<String>,
}

/// A word or a list of words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum OneOrMany {
    /// A single word.
    One(String),
    /// Any of several.
    Many(Vec<String>),
}

impl OneOrMany {
    /// The words.
    #[must_use]
    pub fn words(&self) -> &[String] {
        match self {
            Self::One(word) => std::slice::from_ref(word),
            Self::Many(words) => words,
        }
    }
}

/// Most answers of a search that a pick looks at.
const MOST_FOUND: usize = 500;
/// Answers at least so good beside the best one are as good as it.
const AS_GOOD: f32 = 0.8;
/// Most models of one pick from a large collection.
const MOST_PICKED: usize = 5000;

impl Catalog {
    /// The asset of that uid; `name` is what the recipe calls this catalog.
    ///
    /// # Errors
    /// [`CatalogError::NoMatch`] with the nearest uid.
    pub fn pick_uid(&self, name: &str, uid: &str) -> Result<Asset, CatalogError> {
        self.get(uid)?.ok_or_else(|| CatalogError::NoMatch {
            catalog: name.into(),
            wanted: format!("uid `{uid}`"),
            nearest: did_you_mean(uid, self.assets.iter().map(|asset| asset.uid.as_str())),
        })
    }

    /// All assets that a pick names, in the order of the index; never none. Of a large collection those whose files are
    /// there.
    ///
    /// # Errors
    /// [`CatalogError::NoMatch`] with the nearest uid, tag or label. Every uid of a list must be there.
    pub fn pick(&self, pick: &Pick) -> Result<Vec<Asset>, CatalogError> {
        let none =
            |wanted: String, nearest: String| CatalogError::NoMatch { catalog: pick.catalog.clone(), wanted, nearest };
        for uid in pick.uid.as_ref().map(OneOrMany::words).unwrap_or_default() {
            self.pick_uid(&pick.catalog, uid)?;
        }
        if self.disk().is_none() {
            self.check_words(pick)?;
        }
        let mut matching = match (&pick.search, self.disk()) {
            (Some(query), _) => self.best(pick, query)?,
            (None, None) => self.assets.clone(),
            (None, Some(disk)) => self.candidates(disk, pick)?,
        };
        matching.retain(|asset| pick.admits(asset));
        if matching.is_empty() {
            return Err(none("all of these conditions at once".into(), "; drop one of them".into()));
        }
        if self.disk().is_some() {
            let known = matching.len();
            matching.retain(|asset| asset.path.is_file());
            if matching.is_empty() {
                let remedy = "; download some of them, or pick others".into();
                return Err(none(format!("its file on disk: {known} models match, and none is downloaded"), remedy));
            }
            matching.truncate(MOST_PICKED);
        }
        Ok(matching)
    }

    /// Refuses a tag or label that no listed model has.
    fn check_words(&self, pick: &Pick) -> Result<(), CatalogError> {
        let none = |kind: &str, word: &str, nearest: String| CatalogError::NoMatch {
            catalog: pick.catalog.clone(),
            wanted: format!("{kind} `{word}`"),
            nearest,
        };
        for tag in pick.tags.iter().flatten() {
            let known = || self.assets.iter().flat_map(|asset| asset.tags.iter().map(String::as_str));
            if !known().any(|word| word == tag) {
                return Err(none("tag", tag, did_you_mean(tag, known())));
            }
        }
        if let Some(label) = &pick.label {
            let known = || self.assets.iter().map(|asset| asset.label.as_str());
            if !known().any(|word| word == label) {
                return Err(none("label", label, did_you_mean(label, known())));
            }
        }
        Ok(())
    }

    /// The answers of a search that are as good as the best of those that may be picked.
    fn best(&self, pick: &Pick, query: &str) -> Result<Vec<Asset>, CatalogError> {
        let mut best = None;
        let mut kept: Vec<(u32, Asset)> = Vec::new();
        for found in self.find(query, MOST_FOUND)? {
            let asset = self.asset(found.model)?;
            if !pick.admits(&asset) || (self.disk().is_some() && !asset.path.is_file()) {
                continue;
            }
            if found.score < AS_GOOD * *best.get_or_insert(found.score) {
                break;
            }
            kept.push((found.model, asset));
        }
        if kept.is_empty() {
            let wanted = format!("`{}`", super::text::clean(query));
            let nearest = "; try `ensonify catalog search`".into();
            return Err(CatalogError::NoMatch { catalog: pick.catalog.clone(), wanted, nearest });
        }
        kept.sort_by_key(|(model, _)| *model);
        Ok(kept.into_iter().map(|(_, asset)| asset).collect())
    }

    /// Models of a large collection that may satisfy a pick.
    fn candidates(&self, disk: &DiskIndex, pick: &Pick) -> Result<Vec<Asset>, CatalogError> {
        if let Some(uids) = &pick.uid {
            return uids.words().iter().filter_map(|uid| self.get(uid).transpose()).collect();
        }
        let mut terms: Vec<String> = pick.label.iter().map(|label| label_term(label)).collect();
        terms.extend(pick.tags.iter().flatten().flat_map(|tag| words(tag)));
        let Some((first, rest)) = terms.split_first() else {
            return Err(CatalogError::NoMatch {
                catalog: pick.catalog.clone(),
                wanted: format!("so many models at once ({})", self.count()),
                nearest: "; add `label`, `tags`, `search` or `uid` to the pick".into(),
            });
        };
        let mut models: Vec<u32> = disk.postings(first)?.iter().map(|posting| posting.model).collect();
        for term in rest {
            let with = disk.postings(term)?;
            models.retain(|model| with.binary_search_by_key(model, |posting| posting.model).is_ok());
        }
        models.into_iter().map(|model| self.asset(model)).collect()
    }

    /// The models that fit a search best, the best first.
    ///
    /// # Errors
    /// If the index of a large collection cannot be read.
    pub fn find(&self, query: &str, most: usize) -> Result<Vec<Found>, CatalogError> {
        match self.disk() {
            Some(disk) => find(query, disk, most),
            None => find(query, &MemoryTerms::of(&self.assets), most),
        }
    }
}

impl Pick {
    /// Whether a model has the uid, tags and label of the pick.
    fn admits(&self, asset: &Asset) -> bool {
        let uids = self.uid.as_ref().map(OneOrMany::words);
        uids.is_none_or(|uids| uids.contains(&asset.uid))
            && self.tags.iter().flatten().all(|tag| asset.tags.contains(tag) || asset.label == *tag)
            && self.label.as_ref().is_none_or(|label| asset.label == *label)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::index::tests::{HEADER, catalog};

    #[test]
    fn picks_name_what_is_nearest() {
        let rows = format!(
            "{HEADER}car_tire,A,tire,tire;round,a.glb,1,y,,l,a,s\ntruck_tire,B,tire,tire;big,b.glb,1,y,,l,a,s\n\
             barrel,C,barrel,round,c.glb,1,y,,l,a,s\n"
        );
        let catalog = catalog(&rows).1.expect("sound");
        let pick = |text: &str| serde_yaml::from_str::<Pick>(text).expect("a pick");
        let uids = |text: &str| -> Vec<String> {
            catalog.pick(&pick(text)).expect(text).iter().map(|asset| asset.uid.clone()).collect()
        };
        assert_eq!(uids("{catalog: c, tags: [tire]}"), ["car_tire", "truck_tire"]);
        assert_eq!(uids("{catalog: c, tags: [tire, round]}"), ["car_tire"]);
        assert_eq!(uids("{catalog: c, uid: barrel}"), ["barrel"]);
        assert_eq!(uids("{catalog: c, uid: [barrel, car_tire]}"), ["car_tire", "barrel"]);
        assert_eq!(uids("{catalog: c, label: barrel}"), ["barrel"]);
        assert_eq!(uids("{catalog: c}").len(), 3);
        assert_eq!(uids("{catalog: c, search: rusty barells}"), ["barrel"]);
        assert_eq!(uids("{catalog: c, search: Reifen}"), ["car_tire", "truck_tire"]);
        assert_eq!(uids("{catalog: c, search: Reifen, tags: [big]}"), ["truck_tire"]);
        let error = |text: &str| catalog.pick(&pick(text)).expect_err(text).to_string();
        assert!(error("{catalog: c, tags: [tyre]}").contains("did you mean `tire`"));
        assert!(error("{catalog: c, uid: [barrel, car_tyre]}").contains("did you mean `car_tire`"));
        assert!(error("{catalog: c, label: barel}").contains("did you mean `barrel`"));
        assert!(error("{catalog: c, search: xyzzy}").contains("catalog search"));
        assert!(error("{catalog: c, uid: barrel, tags: [big]}").contains("at once"));
        assert!(serde_yaml::from_str::<Pick>("{catalog: c, tag: x}").is_err());
    }
}
