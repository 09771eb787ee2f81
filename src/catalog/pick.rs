//! Picking from a catalog: by uid, tags or label.

use serde::{Deserialize, Serialize};

use super::error::{CatalogError, did_you_mean};
use super::index::{Asset, Catalog};

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

impl Catalog {
    /// The asset of that uid; `name` is what the recipe calls this catalog.
    ///
    /// # Errors
    /// [`CatalogError::NoMatch`] with the nearest uid.
    pub fn pick_uid(&self, name: &str, uid: &str) -> Result<&Asset, CatalogError> {
        self.get(uid).ok_or_else(|| CatalogError::NoMatch {
            catalog: name.into(),
            wanted: format!("uid `{uid}`"),
            nearest: did_you_mean(uid, self.assets.iter().map(|asset| asset.uid.as_str())),
        })
    }

    /// All assets that a pick names, in file order; never none.
    ///
    /// # Errors
    /// [`CatalogError::NoMatch`] with the nearest uid, tag or label. Every uid of a list must be there.
    pub fn pick(&self, pick: &Pick) -> Result<Vec<&Asset>, CatalogError> {
        let none =
            |wanted: String, nearest: String| CatalogError::NoMatch { catalog: pick.catalog.clone(), wanted, nearest };
        let uids = pick.uid.as_ref().map(OneOrMany::words);
        for uid in uids.unwrap_or_default() {
            self.pick_uid(&pick.catalog, uid)?;
        }
        for tag in pick.tags.iter().flatten() {
            let known = || self.assets.iter().flat_map(|asset| asset.tags.iter().map(String::as_str));
            if !known().any(|word| word == tag) {
                return Err(none(format!("tag `{tag}`"), did_you_mean(tag, known())));
            }
        }
        if let Some(label) = &pick.label {
            let known = || self.assets.iter().map(|asset| asset.label.as_str());
            if !known().any(|word| word == label) {
                return Err(none(format!("label `{label}`"), did_you_mean(label, known())));
            }
        }
        let matching: Vec<&Asset> = self
            .assets
            .iter()
            .filter(|asset| uids.is_none_or(|uids| uids.contains(&asset.uid)))
            .filter(|asset| pick.tags.iter().flatten().all(|tag| asset.tags.contains(tag)))
            .filter(|asset| pick.label.as_ref().is_none_or(|label| asset.label == *label))
            .collect();
        if matching.is_empty() {
            return Err(none("all of these conditions at once".into(), "; drop one of them".into()));
        }
        Ok(matching)
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
        let error = |text: &str| catalog.pick(&pick(text)).expect_err(text).to_string();
        assert!(error("{catalog: c, tags: [tyre]}").contains("did you mean `tire`"));
        assert!(error("{catalog: c, uid: [barrel, car_tyre]}").contains("did you mean `car_tire`"));
        assert!(error("{catalog: c, label: barel}").contains("did you mean `barrel`"));
        assert!(error("{catalog: c, uid: barrel, tags: [big]}").contains("at once"));
        assert!(serde_yaml::from_str::<Pick>("{catalog: c, tag: x}").is_err());
    }
}
