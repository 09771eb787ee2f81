//! A row of the index from what is known of a model, and what a person changed in it.

use std::collections::BTreeMap;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::facts::Facts;
use super::listing::Listing;
use crate::catalog::concepts::concepts;
use crate::catalog::index::{COLUMNS, MORE_COLUMNS, size};
use crate::catalog::licence::{Licence, UNKNOWN};
use crate::catalog::materials::{self, material_in_name};
use crate::catalog::overrides::Override;
use crate::catalog::priors::{self, SizeFrom, Sized};
use crate::catalog::simplify::MOST_TRIANGLES;
use crate::catalog::text::clean;

/// A line of `catalog.csv` by column.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Row(BTreeMap<String, String>);

impl Row {
    /// A cell; empty if there is none.
    #[must_use]
    pub fn get(&self, column: &str) -> &str {
        self.0.get(column).map_or("", String::as_str)
    }

    /// Writes a cell.
    pub fn set(&mut self, column: &str, text: impl Into<String>) {
        self.0.insert(column.into(), text.into());
    }

    /// The model's unique name.
    #[must_use]
    pub fn uid(&self) -> &str {
        self.get("uid")
    }

    /// The row with what the overrides state.
    #[must_use]
    pub fn with(mut self, stated: Option<&Override>) -> Self {
        let Some(stated) = stated else { return self };
        let texts = [
            ("name", &stated.name),
            ("label", &stated.label),
            ("up", &stated.up),
            ("material", &stated.material),
            ("licence", &stated.licence),
            ("attribution", &stated.attribution),
            ("source", &stated.source),
        ];
        for (column, text) in texts {
            if let Some(text) = text {
                self.set(column, clean(text));
            }
        }
        if let Some(size) = stated.size_m {
            self.set("size_m", written(size));
            self.set("size_from", SizeFrom::Given.name());
        }
        self
    }
}

/// All columns of an index that is written here.
pub fn columns() -> impl Iterator<Item = &'static str> {
    COLUMNS.into_iter().chain(MORE_COLUMNS)
}

/// What is derived now, and the row to write: every cell that a person changed stays.
///
/// A cell is a person's if it differs from what was derived `last`; without that, from what is derived now. `derive`
/// makes a row, for a label that a person gave if there is one.
pub fn merged(before: Option<&Row>, last: Option<&Row>, derive: impl Fn(Option<&str>) -> Row) -> (Row, Row) {
    let fresh = derive(None);
    let Some(before) = before else { return (fresh.clone(), fresh) };
    let reference = last.unwrap_or(&fresh).clone();
    let changed = |column: &str| !before.get(column).is_empty() && before.get(column) != reference.get(column);
    // Sizes and materials follow a label that a person gave.
    let fresh = if changed("label") { derive(Some(before.get("label"))) } else { fresh };
    let mut row = fresh.clone();
    for column in COLUMNS.into_iter().filter(|column| *column != "path") {
        if changed(column) {
            row.set(column, before.get(column));
        }
    }
    if changed("size_m") {
        row.set("size_from", SizeFrom::Given.name());
    }
    (fresh, row)
}

/// The row of a model by its file, a listing beside it, and a label if a person gave one.
#[must_use]
pub fn derived(path: &str, facts: &Facts, listing: Option<&Listing>, given_label: Option<&str>) -> Row {
    let none = Listing::default();
    let listing = listing.unwrap_or(&none);
    let mut problems: Vec<String> = Vec::new();
    let name = name(path, facts, listing);
    let label = given_label.map_or_else(|| label(path, &name, listing), String::from);
    if priors::prior(&label).is_none() {
        problems.push(format!("nothing is known of the label `{label}`: state size_m, or another label"));
    }
    let extent = Vec3::from_array(facts.extent);
    let sized = sized(&label, extent, listing, &mut problems);
    let mut row = Row::default();
    row.set("name", name.clone());
    row.set("tags", tags(&label, &name, listing));
    row.set("path", path);
    row.set("size_m", written(sized.size_m));
    row.set("size_from", sized.from.name());
    let (up, why) = priors::up_of(&label, extent);
    match listing.up.as_deref().filter(|up| matches!(*up, "y" | "z")) {
        Some(stated) => row.set("up", stated),
        None => {
            row.set("up", up.name());
            problems.extend(why.map(String::from));
        }
    }
    row.set("material", material(&label, &name, facts, listing));
    let stated = listing.licence.as_deref().filter(|text| !text.is_empty()).unwrap_or(&facts.about.licence);
    let licence = Licence::read(stated);
    if licence.id == UNKNOWN {
        problems.push("its licence is not stated".into());
    } else if !licence.known {
        problems.push(format!("its licence `{}` is none that is known", licence.id));
    }
    row.set("licence", licence.id);
    row.set("attribution", listing.attribution.clone().unwrap_or_else(|| facts.about.author.clone()));
    row.set("source", listing.source.clone().unwrap_or_else(|| facts.about.source.clone()));
    row.set("triangles", facts.triangles.to_string());
    row.set("watertight", if facts.watertight { "yes" } else { "no" });
    if facts.triangles > MOST_TRIANGLES as u64 {
        let problem = "triangles are more than a sonar resolves: it is simplified when it is loaded";
        problems.push(format!("{} {problem}", facts.triangles));
    }
    row.set("label", label);
    row.set("problems", problems.join("; "));
    row
}

fn name(path: &str, facts: &Facts, listing: &Listing) -> String {
    let file = path.rsplit('/').next().unwrap_or(path);
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    let spoken = || clean(&stem.replace(['_', '-'], " "));
    let title = Some(facts.about.title.clone()).filter(|title| !title.is_empty());
    listing.name.clone().or(title).unwrap_or_else(spoken)
}

/// A stated label as it is; else the category's, or a narrower one of the name; else what the name or the path speaks of.
fn label(path: &str, name: &str, listing: &Listing) -> String {
    if let Some(label) = &listing.label {
        return label.clone();
    }
    let table = concepts();
    let of_name = table.label_in(name);
    if let Some(category) = &listing.category {
        return table.label_of_category(category, name);
    }
    let known = |label: &&str| priors::prior(label).is_some();
    let of_path =
        || path.rsplit('/').find_map(|part| table.label_in(part.split('.').next().unwrap_or(part)).filter(known));
    let tagged = || listing.tags.as_deref().and_then(|tags| table.label_in(tags));
    of_name.filter(known).or_else(tagged).or_else(of_path).or(of_name).unwrap_or("object").into()
}

fn sized(label: &str, extent: Vec3, listing: &Listing, problems: &mut Vec<String>) -> Sized {
    let stated = listing.size_m.as_deref().map(size);
    match stated {
        Some(Ok(Some(size_m))) => return Sized { size_m, from: SizeFrom::Given, note: None },
        Some(Err(problem)) => problems.push(problem),
        Some(Ok(None)) | None => {}
    }
    let sized = priors::size_of(label, f64::from(extent.max_element()));
    problems.extend(sized.note.clone());
    sized
}

/// What most of the surface is made of by the names of its parts, if they tell of half of it; else what name and label do.
fn material(label: &str, name: &str, facts: &Facts, listing: &Listing) -> String {
    if let Some(stated) = listing.material.as_deref().filter(|name| materials::material(name).is_ok()) {
        return stated.into();
    }
    let otherwise = priors::material_of(label, name);
    let mut by_material: BTreeMap<&str, f64> = BTreeMap::new();
    let (mut named, mut whole) = (0.0, 0.0);
    for (surface, area) in &facts.areas {
        whole += area;
        let told =
            material_in_name(surface).map(|_| priors::material_of_surface(surface, otherwise.unwrap_or_default()));
        if let Some(material) = told {
            named += area;
            *by_material.entry(material).or_default() += area;
        }
    }
    // What such things are made of counts before their fittings: a chest is wood under its iron.
    if let Some(usual) = otherwise.filter(|usual| by_material.get(usual).is_some_and(|area| *area > 0.15 * whole)) {
        return usual.into();
    }
    let most = by_material.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(material, _)| material);
    match most.filter(|_| named > 0.5 * whole) {
        Some(material) => material.into(),
        None => otherwise.or(most).unwrap_or(materials::UNKNOWN).into(),
    }
}

/// Stated tags, the label and the groups that it belongs to.
fn tags(label: &str, name: &str, listing: &Listing) -> String {
    let mut tags: Vec<String> = vec![label.to_owned()];
    let stated = listing.tags.iter().flat_map(|tags| tags.split(';'));
    tags.extend(stated.map(str::trim).filter(|tag| !tag.is_empty()).map(String::from));
    tags.extend(listing.category.clone());
    let table = concepts();
    if let Some(number) = table.number(label) {
        tags.extend(table.groups(number).map(|group| table.name(group).to_owned()));
    }
    for unit in table.read(name) {
        tags.extend(unit.concepts.first().map(|&concept| table.name(concept).to_owned()));
    }
    let mut seen = std::collections::BTreeSet::new();
    tags.retain(|tag| seen.insert(tag.to_lowercase()));
    tags.join(";")
}

/// A size as it stands in an index: to a tenth of a millimetre.
fn written(size_m: f64) -> String {
    format!("{size_m:.4}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cells: &[(&str, &str)]) -> Row {
        Row(cells.iter().map(|(column, text)| ((*column).into(), (*text).into())).collect())
    }

    #[test]
    fn what_a_person_changed_stays_and_the_rest_is_derived_anew() {
        let derive = |label: Option<&str>| match label {
            Some("anchor") => row(&[("label", "anchor"), ("size_m", "1.6"), ("size_from", "prior"), ("name", "new")]),
            _ => row(&[("label", "object"), ("size_m", "1.0"), ("size_from", "guessed"), ("name", "new")]),
        };
        let last = row(&[("label", "object"), ("size_m", "1.0"), ("size_from", "guessed"), ("name", "old")]);
        let (_, same) = merged(Some(&last), Some(&last), derive);
        assert_eq!(same.get("name"), "new");
        let by_hand = row(&[("label", "anchor"), ("size_m", "1.0"), ("size_from", "guessed"), ("name", "mine")]);
        let (_, labelled) = merged(Some(&by_hand), Some(&last), derive);
        assert_eq!((labelled.get("name"), labelled.get("size_m"), labelled.get("size_from")), ("mine", "1.6", "prior"));
        let sized = row(&[("label", "object"), ("size_m", "2.5"), ("size_from", "guessed"), ("name", "old")]);
        let (_, sized) = merged(Some(&sized), Some(&last), derive);
        assert_eq!((sized.get("size_m"), sized.get("size_from"), sized.get("name")), ("2.5", "given", "new"));
        let (_, unknown) = merged(Some(&by_hand), None, derive);
        assert_eq!(unknown.get("name"), "mine");
    }

    #[test]
    fn a_name_narrows_a_category() {
        let of = |name: &str, category: &str| {
            label("x.glb", name, &Listing { category: Some(category.into()), ..Listing::default() })
        };
        assert_eq!(of("water bottle", "bottle"), "water-bottle");
        assert_eq!(of("puffer fish", "fish"), "pufferfish");
        assert_eq!(of("wooden dock", "dock"), "dock");
        assert_eq!(of("armoured tank (wreck)", "tank"), "army-tank");
        assert_eq!(of("thing", "gizmo part"), "gizmo-part");
        assert_eq!(label("wrecks/k_ship_wreck.glb", "k ship wreck", &Listing::default()), "shipwreck");
    }
}
