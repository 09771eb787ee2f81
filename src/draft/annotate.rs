//! What models of a catalog may be, where the catalog has guesses or nothing: proposals for a person to look through.
//!
//! From names, tags, the names of parts, and what is known of labels. Writes nothing over what somebody stated: the
//! proposals are a file in the form of `catalog.overrides.yaml`.

use std::collections::BTreeMap;

use super::compose::page::Page;
use super::compose::yaml::Yaml;
use crate::catalog::asset::{Asset, Up};
use crate::catalog::concepts::concepts;
use crate::catalog::materials::{UNKNOWN, material_in_name};
use crate::catalog::priors::{SizeFrom, material_of, prior, size_of, up_of};
use crate::catalog::{CatalogError, Model};

/// File name of proposals beside an index.
pub const PROPOSALS: &str = "catalog.proposals.yaml";

/// Words of parts that tell of a material without naming one.
const PARTS: [(&str, &str); 14] = [
    ("blade", "steel"),
    ("bolt", "steel"),
    ("hub", "aluminium"),
    ("lens", "glass"),
    ("nut", "steel"),
    ("rim", "aluminium"),
    ("sail", "rope"),
    ("screw", "steel"),
    ("spoke", "steel"),
    ("strap", "rope"),
    ("tread", "rubber"),
    ("valve", "steel"),
    ("windshield", "glass"),
    ("windscreen", "glass"),
];

/// What is proposed for a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// The model.
    pub uid: String,
    /// At least one.
    pub changes: Vec<Change>,
}

/// One fact, with what is there now and the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What is proposed.
    pub fact: Fact,
    /// What the catalog has; empty if nothing.
    pub now: String,
    /// Why.
    pub why: String,
}

/// A fact of a model.
#[derive(Clone, Debug, PartialEq)]
pub enum Fact {
    /// Category.
    Label(String),
    /// Longest side, metres.
    SizeM(f64),
    /// Axis that points up.
    Up(Up),
    /// Of the main surface.
    Material(String),
    /// Of the surface or node of this name.
    Part(String, String),
}

impl Fact {
    /// Key in the overrides.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Label(_) => "label",
            Self::SizeM(_) => "size_m",
            Self::Up(_) => "up",
            Self::Material(_) => "material",
            Self::Part(..) => "parts",
        }
    }

    /// The value for people.
    #[must_use]
    pub fn text(&self) -> String {
        match self {
            Self::Label(text) | Self::Material(text) => text.clone(),
            Self::SizeM(size) => format!("{size} m"),
            Self::Up(up) => up.name().to_owned(),
            Self::Part(name, material) => format!("{name}: {material}"),
        }
    }
}

/// Proposes what is not known of a model; nothing where all is.
///
/// # Errors
/// If its file cannot be read.
pub fn propose(asset: &Asset) -> Result<Option<Proposal>, CatalogError> {
    let mut changes = Vec::new();
    let label = label(asset, &mut changes);
    let model = asset.scaled_model()?;
    material(asset, &label, &mut changes);
    parts(asset, &model, &mut changes);
    size_and_up(asset, &label, &mut changes)?;
    Ok((!changes.is_empty()).then(|| Proposal { uid: asset.uid.clone(), changes }))
}

/// The label that it should have: its own, where something is known of that.
fn label(asset: &Asset, changes: &mut Vec<Change>) -> String {
    if prior(&asset.label).is_some() {
        return asset.label.clone();
    }
    let said = [("name", asset.name.clone()), ("tags", asset.tags.join(" ")), ("file name", stem(asset))];
    let read = said.iter().find_map(|(what, text)| {
        let label = concepts().label_in(text).filter(|label| prior(label).is_some() && *label != asset.label)?;
        Some((label.to_owned(), format!("its {what} says `{}`", crate::catalog::text::clean(text))))
    });
    let Some((label, why)) = read else { return asset.label.clone() };
    changes.push(Change { fact: Fact::Label(label.clone()), now: asset.label.clone(), why });
    label
}

fn stem(asset: &Asset) -> String {
    let stem = asset.path.file_stem().unwrap_or_default().to_string_lossy();
    stem.replace(['_', '-', '.'], " ")
}

fn material(asset: &Asset, label: &str, changes: &mut Vec<Change>) {
    if !asset.material.is_empty() && asset.material != UNKNOWN {
        return;
    }
    let told = |text: &str| material_of("", text).or_else(|| material_in_name(text));
    let of_name = told(&asset.name).map(|material| (material, "its name says so".to_owned()));
    let of_tags = || asset.tags.iter().find_map(|tag| told(tag)).map(|material| (material, "a tag says so".to_owned()));
    let of_label = || {
        let prior = prior(label)?;
        Some((prior.material.as_str(), format!("what a {label} is mostly made of")))
    };
    if let Some((material, why)) = of_name.or_else(of_tags).or_else(of_label) {
        let fact = Fact::Material(material.to_owned());
        changes.push(Change { fact, now: asset.material.clone(), why });
    }
}

/// Surfaces whose own name tells nothing and whose node's name does.
fn parts(asset: &Asset, model: &Model, changes: &mut Vec<Change>) {
    let mut found: BTreeMap<&str, (&str, String)> = BTreeMap::new();
    for part in &model.parts {
        let stated = asset.parts.contains_key(&part.node) || asset.parts.contains_key(&part.material);
        if stated || part.node.is_empty() || material_in_name(&part.material).is_some() {
            continue;
        }
        let named = material_in_name(&part.node).map(|material| (material, "its name names it".to_owned()));
        let of_kind = || {
            let words = crate::catalog::words::words(&part.node);
            let (word, material) = PARTS.iter().find(|(word, _)| words.iter().any(|other| other == word))?;
            Some((*material, format!("what a {word} is usually made of")))
        };
        if let Some(told) = named.or_else(of_kind).filter(|(material, _)| *material != asset.material) {
            found.entry(&part.node).or_insert(told);
        }
    }
    for (name, (material, why)) in found {
        let fact = Fact::Part(name.to_owned(), material.to_owned());
        changes.push(Change { fact, now: String::new(), why });
    }
}

fn size_and_up(asset: &Asset, label: &str, changes: &mut Vec<Change>) -> Result<(), CatalogError> {
    let known = prior(label);
    if asset.size_from == SizeFrom::Guessed || (asset.size_from != SizeFrom::Given && label != asset.label) {
        let now = asset.size_m.map_or_else(String::new, |size| format!("{size} m, {}", asset.size_from.name()));
        if let Some(known) = known {
            let sized = size_of(label, asset.file_units()?);
            let [least, _, most] = known.size_m;
            let why = match sized.from {
                SizeFrom::File => format!("its file's units give a {label} of {least} to {most} m"),
                _ => format!("the usual size of a {label}; those are {least} to {most} m"),
            };
            let size = (sized.size_m * 1000.0).round() / 1000.0;
            changes.push(Change { fact: Fact::SizeM(size), now, why });
        }
    }
    if label != asset.label || asset.up == Up::Auto {
        // In the file's axes, which the model that stands has not any more.
        let file = crate::catalog::glb::load_model_in(&asset.root, &asset.path)?;
        if let Some((low, high)) = file.bounds() {
            let size = high - low;
            let (up, why) = up_of(label, glam::Vec3::new(size.x, size.z, size.y));
            if up != asset.up && why.is_some() {
                let why = why.unwrap_or_default().to_owned();
                changes.push(Change { fact: Fact::Up(up), now: asset.up.name().to_owned(), why });
            }
        }
    }
    Ok(())
}

/// Proposals in the form of `catalog.overrides.yaml`, each with its reason.
#[must_use]
pub fn sidecar(proposals: &[Proposal]) -> String {
    let mut page = Page::default();
    page.note(
        0,
        "Proposals of `ensonify catalog annotate`, in the form of catalog.overrides.yaml. Look through them; what is",
    );
    page.note(
        0,
        "right goes into that file, or this file becomes it by its name. Nothing reads this file as it is called now.",
    );
    for proposal in proposals {
        page.blank();
        page.entry(0, &Yaml::word(&proposal.uid), None, "");
        let parts = proposal.changes.iter().filter(|change| matches!(change.fact, Fact::Part(..)));
        for change in &proposal.changes {
            let value = match &change.fact {
                Fact::Label(text) | Fact::Material(text) => Yaml::word(text),
                Fact::SizeM(size) => Yaml::number(*size),
                Fact::Up(up) => Yaml::word(up.name()),
                Fact::Part(..) => continue,
            };
            page.set(2, change.fact.key(), &value, &change.why);
        }
        let mut is_open = false;
        for change in parts {
            if !std::mem::replace(&mut is_open, true) {
                page.open(2, "parts", "");
            }
            if let Fact::Part(name, material) = &change.fact {
                page.entry(4, &Yaml::word(name), Some(&Yaml::word(material)), &change.why);
            }
        }
    }
    page.text()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::overrides::Overrides;

    /// A bottle's model under another name, with nothing known of it.
    fn unknown(name: &str) -> Asset {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
        Asset {
            uid: "thing: 1".into(),
            name: name.into(),
            label: "object".into(),
            path: root.join("bottle.glb"),
            root,
            size_m: Some(1.0),
            size_from: SizeFrom::Guessed,
            ..Asset::default()
        }
    }

    #[test]
    fn names_and_labels_tell() {
        let found = propose(&unknown("old wine bottle")).expect("it can be read").expect("nothing was known");
        let facts: Vec<_> = found.changes.iter().map(|change| (change.fact.key(), change.fact.text())).collect();
        assert_eq!(facts[..2], [("label", "bottle".to_owned()), ("material", "glass".to_owned())]);
        let Fact::SizeM(size) = found.changes[2].fact else { panic!("{found:?}") };
        assert!((0.1..0.5).contains(&size), "{size}");
        assert!(found.changes.iter().all(|change| !change.why.is_empty()));
    }

    #[test]
    fn what_is_known_is_left_alone_and_proposals_are_overrides() {
        let mut known = unknown("bottle");
        (known.label, known.material, known.size_from) = ("bottle".into(), "glass".into(), SizeFrom::Given);
        assert_eq!(propose(&known).expect("it can be read"), None);
        let found = propose(&unknown("bottle")).expect("it can be read").expect("nothing was known");
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("catalog.overrides.yaml"), sidecar(&[found])).expect("written");
        let overrides = Overrides::read(folder.path()).expect("the same form");
        assert_eq!(overrides.of("thing: 1").and_then(|of| of.label.clone()).as_deref(), Some("bottle"));
    }
}
