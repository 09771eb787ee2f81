//! Tables beside models that say what they are: any CSV file with a column for the file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::catalog::error::CatalogError;
use crate::catalog::index::INDEX;
use crate::catalog::text::clean;

/// What tables say of the models of a folder.
#[derive(Clone, Debug, Default)]
pub struct Listings {
    of: BTreeMap<String, Listing>,
}

/// What a table says of one model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Listing {
    /// Unique name.
    pub uid: Option<String>,
    /// What it is.
    pub name: Option<String>,
    /// Its label, to be kept as it is.
    pub label: Option<String>,
    /// Its category, which a label may be read from.
    pub category: Option<String>,
    /// Tags, `;` between them.
    pub tags: Option<String>,
    /// Licence.
    pub licence: Option<String>,
    /// Whom to name.
    pub attribution: Option<String>,
    /// Where it comes from.
    pub source: Option<String>,
    /// Longest side, metres.
    pub size_m: Option<String>,
    /// Axis that points up.
    pub up: Option<String>,
    /// Material.
    pub material: Option<String>,
}

impl Listings {
    /// Reads every table in a folder that has a column `file`, `path` or `filename`.
    ///
    /// # Errors
    /// If such a table is broken.
    pub fn read(root: &Path) -> Result<Self, CatalogError> {
        let mut tables: Vec<_> = root
            .read_dir()
            .map_err(|e| CatalogError::File { path: root.to_path_buf(), problem: format!("cannot be read: {e}") })?
            .filter_map(|entry| entry.ok().map(|entry| entry.path()))
            .filter(|path| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv")))
            .filter(|path| path.file_name().is_none_or(|name| name != INDEX))
            .collect();
        tables.sort();
        let mut listings = Self::default();
        for table in tables {
            let fault = |problem: String| CatalogError::File { path: table.clone(), problem };
            let text = fs::read(&table).map_err(|e| fault(format!("cannot be read: {e}")))?;
            listings.add(&text).map_err(|e| fault(format!("{e}; correct the table or move it elsewhere")))?;
        }
        Ok(listings)
    }

    fn add(&mut self, text: &[u8]) -> Result<(), csv::Error> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text);
        let header = reader.headers()?.clone();
        let place = |names: &[&str]| {
            names.iter().find_map(|name| {
                header.iter().position(|h| h.trim_start_matches('\u{feff}').eq_ignore_ascii_case(name))
            })
        };
        let Some(file) = place(&["file", "path", "filename"]) else { return Ok(()) };
        for record in reader.records() {
            let record = record?;
            let cell =
                |names: &[&str]| place(names).and_then(|at| record.get(at)).map(clean).filter(|text| !text.is_empty());
            let listing = Listing {
                uid: cell(&["uid", "id"]),
                name: cell(&["name", "title", "what"]),
                label: cell(&["label"]),
                category: cell(&["category", "class", "kind"]),
                tags: cell(&["tags", "keywords"]),
                licence: cell(&["licence", "license"]),
                attribution: cell(&["attribution", "author", "credit", "creator"]),
                source: cell(&["source", "url", "link"]),
                size_m: cell(&["size_m", "longest_side_m"]),
                up: cell(&["up", "up_axis"]),
                material: cell(&["material"]),
            };
            self.of.insert(record.get(file).unwrap_or_default().trim_start_matches("./").to_owned(), listing);
        }
        Ok(())
    }

    /// What is said of a model.
    #[must_use]
    pub fn of(&self, path: &str) -> Option<&Listing> {
        self.of.get(path)
    }

    /// A note on what is listed and not there.
    pub fn unused<'a>(&self, there: impl Iterator<Item = &'a String>) -> Option<String> {
        let there: std::collections::BTreeSet<&String> = there.collect();
        let gone: Vec<&str> = self.of.keys().filter(|path| !there.contains(path)).map(String::as_str).collect();
        let first = gone.first()?;
        Some(format!(
            "{} files of the tables beside the models are not there or not usable, such as {}",
            gone.len(),
            clean(first)
        ))
    }
}
