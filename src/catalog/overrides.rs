//! What a person knows better: `catalog.overrides.yaml` beside the index, which `catalog index` never writes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::asset::{Asset, Up};
use super::error::CatalogError;
use super::index::MAX_SIZE_M;
use super::materials;
use super::priors::SizeFrom;

/// File name of the overrides.
pub(crate) const OVERRIDES: &str = "catalog.overrides.yaml";

/// Facts by uid, over those of the index.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    path: PathBuf,
    of: BTreeMap<String, Override>,
}

/// What is stated of one model; what is left out stays as the index has it.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Override {
    /// For people.
    pub name: Option<String>,
    /// Category.
    pub label: Option<String>,
    /// Words to pick it by, besides those of the index.
    #[serde(default)]
    pub tags: Vec<String>,
    /// Longest side, metres.
    pub size_m: Option<f64>,
    /// `y`, `z` or `auto`.
    pub up: Option<String>,
    /// Material where surfaces have none of their own.
    pub material: Option<String>,
    /// Materials by the name of a glTF material or node.
    #[serde(default)]
    pub parts: BTreeMap<String, String>,
    /// Licence.
    pub licence: Option<String>,
    /// Whom to name.
    pub attribution: Option<String>,
    /// Where it comes from.
    pub source: Option<String>,
}

impl Overrides {
    /// Of the catalog in a folder; none if it has no such file.
    ///
    /// # Errors
    /// An unknown key, material or axis, with file and uid.
    pub fn read(dir: &Path) -> Result<Self, CatalogError> {
        let path = dir.join(OVERRIDES);
        let Ok(text) = fs::read_to_string(&path) else { return Ok(Self::default()) };
        let fault = |problem: String| CatalogError::File { path: path.clone(), problem };
        if text.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#')) {
            return Ok(Self::default());
        }
        let of: BTreeMap<String, Override> = serde_yaml::from_str(&text).map_err(|e| fault(e.to_string()))?;
        for (uid, entry) in &of {
            entry.check().map_err(|problem| fault(format!("{uid}: {problem}")))?;
        }
        Ok(Self { path, of })
    }

    /// Refuses a uid that no model has.
    ///
    /// # Errors
    /// The first such uid.
    pub fn check(&self, is_known: impl Fn(&str) -> bool) -> Result<(), CatalogError> {
        match self.of.keys().find(|uid| !is_known(uid)) {
            None => Ok(()),
            Some(uid) => Err(CatalogError::File {
                path: self.path.clone(),
                problem: format!("no model has the uid `{uid}`; correct it or take it out"),
            }),
        }
    }

    /// What is stated of a model.
    #[must_use]
    pub fn of(&self, uid: &str) -> Option<&Override> {
        self.of.get(uid)
    }

    /// A model with what is stated of it.
    #[must_use]
    pub fn applied(&self, mut asset: Asset) -> Asset {
        let Some(stated) = self.of.get(&asset.uid) else { return asset };
        let lay = |over: &Option<String>, under: &mut String| {
            if let Some(text) = over {
                *under = super::text::clean(text);
            }
        };
        // A size that was taken from another label is none of this one's.
        let was = asset.label.clone();
        lay(&stated.name, &mut asset.name);
        lay(&stated.label, &mut asset.label);
        if asset.label != was && asset.size_from != SizeFrom::Given {
            asset.size_m = None;
        }
        lay(&stated.material, &mut asset.material);
        lay(&stated.licence, &mut asset.licence);
        lay(&stated.attribution, &mut asset.attribution);
        lay(&stated.source, &mut asset.source);
        for tag in &stated.tags {
            if !asset.tags.contains(tag) {
                asset.tags.push(super::text::clean(tag));
            }
        }
        if let Some(size) = stated.size_m {
            (asset.size_m, asset.size_from) = (Some(size), SizeFrom::Given);
        }
        if let Some(up) = stated.up.as_deref().and_then(|up| Up::of(up).ok()) {
            asset.up = up;
        }
        asset.parts.clone_from(&stated.parts);
        asset
    }
}

impl Override {
    fn check(&self) -> Result<(), String> {
        if let Some(size) = self.size_m.filter(|size| !(*size > 0.0 && *size <= MAX_SIZE_M)) {
            return Err(format!("size_m {size} is not above 0 and up to {MAX_SIZE_M} metres"));
        }
        if self.label.as_deref().is_some_and(|label| label.trim().is_empty()) {
            return Err("the label is empty".into());
        }
        self.up.as_deref().map_or(Ok(Up::Y), Up::of)?;
        for material in self.material.iter().chain(self.parts.values()) {
            materials::material(material).map_err(|e| e.to_string())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Overrides, CatalogError> {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join(OVERRIDES), text).expect("written");
        Overrides::read(folder.path())
    }

    #[test]
    fn what_is_stated_lies_over_the_index() {
        let overrides = read("a: {size_m: 2, up: z, parts: {Blade: steel}, tags: [big]}").expect("sound");
        let asset = Asset { uid: "a".into(), label: "x".into(), size_m: Some(1.0), ..Asset::default() };
        let asset = overrides.applied(asset);
        assert_eq!((asset.size_m, asset.up, asset.label.as_str()), (Some(2.0), Up::Z, "x"));
        assert_eq!((asset.tags[0].as_str(), asset.parts["Blade"].as_str()), ("big", "steel"));
        assert!(overrides.check(|uid| uid == "a").is_ok());
        assert!(overrides.check(|_| false).expect_err("no such uid").to_string().contains("`a`"));
        assert_eq!(read("# nothing\n").expect("empty"), Overrides::default());
    }

    #[test]
    fn faults_name_file_and_uid() {
        for (text, fault) in [
            ("a: {size_m: 0}", "a: size_m 0"),
            ("a: {up: x}", "a: up `x`"),
            ("a: {parts: {Blade: stel}}", "did you mean `steel`"),
            ("a: {siez_m: 1}", "siez_m"),
        ] {
            let error = read(text).expect_err(text).to_string();
            assert!(error.contains(OVERRIDES) && error.contains(fault), "{error}");
        }
    }
}
