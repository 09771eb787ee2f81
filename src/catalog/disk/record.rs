//! What the index of a large collection keeps of a model.

use std::path::Path;

use crate::catalog::asset::{Asset, Up};
use crate::catalog::error::CatalogError;
use crate::catalog::priors::{self, SizeFrom};
use crate::catalog::{Licence, paths, text};

/// Between the fields; no cleaned text has it.
const BETWEEN: char = '\u{1F}';
/// Stands for the uid within other fields.
const UID: char = '\u{1}';

/// A model's facts by its metadata alone.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// Unique in the collection.
    pub uid: String,
    /// For people.
    pub name: String,
    /// What it is annotated with.
    pub label: String,
    /// A category that people chose for it; empty if none did.
    pub category: String,
    /// Words to pick it by.
    pub tags: Vec<String>,
    /// The file below the collection's root.
    pub path: String,
    /// SPDX name of the licence, or `unknown`.
    pub licence: String,
    /// Who made it.
    pub author: String,
    /// Where it comes from.
    pub source: String,
    /// The beginning of its description.
    pub about: String,
    /// Triangles, as the metadata says.
    pub triangles: Option<u64>,
}

impl Record {
    /// The record as bytes.
    pub(super) fn encoded(&self) -> Vec<u8> {
        let short = |field: &str| field.replace(&self.uid, UID.encode_utf8(&mut [0; 4]));
        let triangles = self.triangles.map(|count| count.to_string()).unwrap_or_default();
        let fields: [&str; 11] = [
            &self.uid,
            &self.name,
            &self.label,
            &self.category,
            &self.tags.join(";"),
            &short(&self.path),
            &self.licence,
            &self.author,
            &short(&self.source),
            &self.about,
            &triangles,
        ];
        fields.join(BETWEEN.encode_utf8(&mut [0; 4])).into_bytes()
    }

    /// The record of such bytes; none if they are none.
    pub(super) fn decoded(bytes: &[u8]) -> Option<Self> {
        let text = std::str::from_utf8(bytes).ok()?;
        let fields: Vec<&str> = text.split(BETWEEN).collect();
        let [uid, name, label, category, tags, path, licence, author, source, about, triangles] = fields[..] else {
            return None;
        };
        let whole = |field: &str| field.replace(UID, uid);
        Some(Self {
            uid: uid.into(),
            name: name.into(),
            label: label.into(),
            category: category.into(),
            tags: tags.split(';').filter(|tag| !tag.is_empty()).map(String::from).collect(),
            path: whole(path),
            licence: licence.into(),
            author: author.into(),
            source: whole(source),
            about: about.into(),
            triangles: triangles.parse().ok(),
        })
    }

    /// The model with what its label tells of it; its size is read from the file when it is used.
    ///
    /// # Errors
    /// If its path leaves the collection.
    pub fn asset(self, root: &Path, index: &Path) -> Result<Asset, CatalogError> {
        let path = paths::inside(root, &self.path).map_err(|problem| CatalogError::File {
            path: index.to_path_buf(),
            problem: format!("{}: {problem}", self.uid),
        })?;
        Ok(Asset {
            attribution: self.attribution(),
            material: priors::material_of(&self.label, &self.name).unwrap_or_default().into(),
            uid: self.uid,
            name: self.name,
            label: self.label,
            tags: self.tags,
            path,
            root: root.to_path_buf(),
            size_m: None,
            size_from: SizeFrom::Prior,
            up: Up::Auto,
            licence: self.licence,
            source: self.source,
            triangles: self.triangles,
            ..Asset::default()
        })
    }

    /// The line that a licence with attribution asks for: name, author, address, licence.
    fn attribution(&self) -> String {
        let author = if self.author.is_empty() { "an unnamed author" } else { &self.author };
        let source = if self.source.is_empty() { String::new() } else { format!(" ({})", self.source) };
        let licence = Licence::read(&self.licence);
        text::clean(&format!("\"{}\" by {author}{source}, {}", self.name, licence.id))
    }
}
