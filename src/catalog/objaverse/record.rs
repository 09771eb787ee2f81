//! A record of Objaverse's metadata, and what a catalog keeps of it.

use serde::Deserialize;

use super::gzip::Text;
use crate::catalog::concepts::concepts;
use crate::catalog::disk::{Batch, Record};
use crate::catalog::licence::Licence;
use crate::catalog::search::terms::Described;
use crate::catalog::text::{clean, without_html};

/// Most tags that are kept of a model.
const MOST_TAGS: usize = 24;
/// Letters that are kept of a description.
const ABOUT: usize = 160;

/// The part of a record that is of use; anything may be missing or `null`.
#[derive(Debug, Default, Deserialize)]
pub(super) struct Metadata<'a> {
    #[serde(borrow, default)]
    name: Text<'a>,
    #[serde(borrow, default, rename = "viewerUrl")]
    viewer_url: Text<'a>,
    #[serde(borrow, default)]
    tags: Option<Vec<Named<'a>>>,
    #[serde(borrow, default)]
    categories: Option<Vec<Named<'a>>>,
    #[serde(borrow, default)]
    user: Option<User<'a>>,
    #[serde(borrow, default)]
    description: Text<'a>,
    #[serde(borrow, default)]
    license: Text<'a>,
    #[serde(default, rename = "faceCount")]
    face_count: Option<u64>,
}

#[derive(Debug, Deserialize)]
struct Named<'a> {
    #[serde(borrow, default)]
    name: Text<'a>,
}

#[derive(Debug, Deserialize)]
struct User<'a> {
    #[serde(borrow, default, rename = "displayName")]
    display_name: Text<'a>,
    #[serde(borrow, default)]
    username: Text<'a>,
}

impl Metadata<'_> {
    /// What a catalog keeps of it. `category` is the one of LVIS, or empty.
    pub fn record(&self, uid: &str, path: String, category: &str) -> Record {
        let text = |field: &Text<'_>| clean(&field.0);
        let named = |list: &Option<Vec<Named<'_>>>| -> Vec<String> {
            let names = list.iter().flatten().map(|tag| &tag.name.0);
            names.map(|name| clean(&name.replace(';', " "))).filter(|name| !name.is_empty()).collect()
        };
        let name = text(&self.name);
        let mut tags = named(&self.tags);
        tags.extend(named(&self.categories));
        tags.dedup();
        tags.truncate(MOST_TAGS);
        let user = self.user.as_ref();
        let author = user.map(|user| text(&user.display_name)).filter(|author| !author.is_empty());
        let author = author.or_else(|| user.map(|user| text(&user.username))).unwrap_or_default();
        // Descriptions are long and hold markup: only their beginning is looked at.
        let about = without_html(beginning(&self.description.0, 4 * ABOUT));
        Record {
            label: label(&name, category, &tags),
            uid: clean(uid),
            name,
            category: category.into(),
            path,
            licence: Licence::read(&self.license.0).id,
            author,
            source: text(&self.viewer_url),
            about: beginning(&about, ABOUT).into(),
            triangles: self.face_count,
            tags,
        }
    }
}

/// At most so many bytes of a text, cut between letters.
fn beginning(text: &str, most: usize) -> &str {
    let mut end = most.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
}

/// Adds a record with what it is found by.
pub(super) fn add(batch: &mut Batch, record: &Record) {
    let Record { name, label, category, tags, .. } = record;
    // A label that was read from name or tags says no more than they do.
    let label = if category.is_empty() { "" } else { label };
    let described = Described { name, label, category, tags, ..Described::default() };
    batch.add(record, &described);
}

/// The label of a model: of its LVIS category, else what its name speaks of, else what most of its tags do.
fn label(name: &str, category: &str, tags: &[String]) -> String {
    if !category.is_empty() {
        return concepts().label_of_category(category, name);
    }
    if let Some(label) = concepts().label_in(name) {
        return label.into();
    }
    let told =
        tags.iter().find_map(|tag| concepts().label_in(tag).filter(|l| crate::catalog::priors::prior(l).is_some()));
    told.unwrap_or("object").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_real_record_gives_what_it_says() {
        let json = r#"{"uri": "x", "name": "Old\tTyre | \u001b[31m", "staffpickedAt": null, "viewerUrl": "https://sketchfab.com/3d-models/u1",
            "tags": [{"name": "rubber", "slug": "r", "uri": "u"}, {"name": null}], "categories": [{"name": "Cars & Vehicles"}],
            "thumbnails": {"images": [{"width": 1}]}, "user": {"displayName": "Alan", "username": "a"},
            "description": "<p>a <b>tyre</b></p>", "faceCount": 12, "license": "by-nc", "archives": {"glb": {"faceCount": null}}}"#;
        let metadata: Metadata<'_> = serde_json::from_str(json).expect("JSON");
        let record = metadata.record("u1", "glbs/000-000/u1.glb".into(), "");
        assert_eq!((record.name.as_str(), record.label.as_str()), ("Old Tyre | [31m", "tire"));
        assert_eq!(record.tags, ["rubber", "Cars & Vehicles"]);
        assert_eq!((record.licence.as_str(), record.about.as_str()), ("CC-BY-NC-4.0", "a tyre"));
        let asset = record.asset(std::path::Path::new("/c"), std::path::Path::new("i")).expect("sound");
        assert_eq!(asset.attribution, "\"Old Tyre | [31m\" by Alan (https://sketchfab.com/3d-models/u1), CC-BY-NC-4.0");
        let nothing: Metadata<'_> = serde_json::from_str(r#"{"license": null, "tags": null}"#).expect("JSON");
        assert_eq!(nothing.record("u", "p".into(), "").licence, "unknown");
    }

    #[test]
    fn labels_come_from_lvis_then_names_then_tags() {
        assert_eq!(label("Blue thing", "car_(automobile)", &[]), "car");
        assert_eq!(label("Blue thing", "garlic", &[]), "garlic");
        assert_eq!(label("Rusty Anchor", "", &["ship".into()]), "anchor");
        assert_eq!(label("Kew Road", "", &["old".into(), "staircase".into()]), "stairs");
        assert_eq!(label("Kew Road", "", &[]), "object");
    }
}
