//! The files that indexing reads and writes: `catalog.csv`, `catalog.lock`, and the state that spares unchanged files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::derive::{Row, columns};
use super::facts::Facts;
use crate::catalog::error::CatalogError;
use crate::catalog::home::Home;
use crate::catalog::index::INDEX;

/// Hashes of every file, as `sha256sum -c` reads them in the models' folder.
pub const LOCK: &str = "catalog.lock";
/// What is remembered from one indexing to the next; may be deleted.
pub const STATE: &str = ".catalog.state.json";

/// Version of the state's form.
const STATE_VERSION: u32 = 1;

/// What an earlier indexing knew.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct State {
    version: u32,
    files: BTreeMap<String, Known>,
}

#[derive(Debug, Serialize, Deserialize)]
struct Known {
    facts: Facts,
    /// As it was derived, before a person's changes.
    row: Row,
}

impl State {
    /// Of the catalog in a folder; empty where there is none or it is of another version.
    #[must_use]
    pub fn read(dir: &Path) -> Self {
        let read = fs::read(dir.join(STATE)).ok().and_then(|bytes| serde_json::from_slice::<Self>(&bytes).ok());
        read.filter(|state| state.version == STATE_VERSION).unwrap_or_default()
    }

    /// The facts of a model none of whose files has changed.
    #[must_use]
    pub fn unchanged(&self, path: &str, root: &Path) -> Option<&Facts> {
        let known = self.files.get(path)?;
        known.facts.files.iter().all(|stamp| stamp.holds(root)).then_some(&known.facts)
    }

    /// The hash that a model had.
    #[must_use]
    pub fn sha256(&self, path: &str) -> Option<&str> {
        self.files.get(path).map(|known| known.facts.sha256.as_str())
    }

    /// What was derived of a model.
    #[must_use]
    pub fn row(&self, path: &str) -> Option<&Row> {
        self.files.get(path).map(|known| &known.row)
    }
}

/// The rows of an index by path; none if there is no index.
///
/// # Errors
/// If it cannot be read as CSV.
pub fn read_rows(dir: &Path) -> Result<BTreeMap<String, Row>, CatalogError> {
    let path = dir.join(INDEX);
    let Ok(text) = fs::read(&path) else { return Ok(BTreeMap::new()) };
    let fault = |e: csv::Error| CatalogError::Unreadable { path: path.clone(), problem: e.to_string() };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
    let header = reader.headers().map_err(fault)?.clone();
    let mut rows = BTreeMap::new();
    for record in reader.records() {
        let record = record.map_err(fault)?;
        let mut row = Row::default();
        for (column, cell) in header.iter().zip(&record) {
            row.set(column.trim_start_matches('\u{feff}'), cell);
        }
        rows.insert(row.get("path").to_owned(), row);
    }
    Ok(rows)
}

/// Writes everything; each file whole or not at all.
pub(super) fn write(
    dir: &Path,
    home: &Home,
    rows: &[Row],
    facts: &BTreeMap<String, Facts>,
    made: &BTreeMap<String, Row>,
) -> Result<(), CatalogError> {
    fs::create_dir_all(dir).map_err(|e| unwritable(dir, &e))?;
    home.write(dir)?;
    put(dir, INDEX, &table(rows).map_err(|e| unwritable(&dir.join(INDEX), &e.into()))?)?;
    put(dir, LOCK, lock(facts).as_bytes())?;
    let known = |(path, facts): (&String, &Facts)| {
        (path.clone(), Known { facts: facts.clone(), row: made.get(path).cloned().unwrap_or_default() })
    };
    let state = State { version: STATE_VERSION, files: facts.iter().map(known).collect() };
    let text = serde_json::to_vec(&state).map_err(|e| unwritable(&dir.join(STATE), &e.into()))?;
    put(dir, STATE, &text)
}

fn table(rows: &[Row]) -> Result<Vec<u8>, csv::Error> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(columns())?;
    for row in rows {
        table.write_record(columns().map(|column| row.get(column)))?;
    }
    table.into_inner().map_err(|e| e.into_error().into())
}

fn lock(facts: &BTreeMap<String, Facts>) -> String {
    let mut hashes: BTreeMap<&str, &str> = BTreeMap::new();
    for stamp in facts.values().flat_map(|facts| &facts.files) {
        hashes.insert(&stamp.path, &stamp.sha256);
    }
    hashes.into_iter().map(|(path, sha256)| format!("{sha256}  {path}\n")).collect()
}

/// Hashes by path, as a lock states them.
///
/// # Errors
/// If there is no lock or it is none.
pub fn read_lock(dir: &Path) -> Result<BTreeMap<String, String>, CatalogError> {
    let path = dir.join(LOCK);
    let fault = |problem: String| CatalogError::File { path: path.clone(), problem };
    let text = fs::read_to_string(&path)
        .map_err(|e| fault(format!("cannot be read: {e}; `ensonify catalog index` makes it")))?;
    let pair = |(number, line): (usize, &str)| {
        let parts = line.split_once("  ").filter(|(sha256, _)| sha256.len() == 64);
        let (sha256, file) = parts.ok_or_else(|| fault(format!("line {} is no hash with a path", number + 1)))?;
        Ok((file.to_owned(), sha256.to_owned()))
    };
    text.lines().enumerate().map(pair).collect()
}

/// Writes a file under a temporary name and moves it to its place.
pub(crate) fn put(dir: &Path, name: &str, bytes: &[u8]) -> Result<(), CatalogError> {
    let (path, temporary) = (dir.join(name), dir.join(format!("{name}.tmp")));
    let written = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, &path));
    written.map_err(|e| unwritable(&path, &e))
}

pub(crate) fn unwritable(path: &Path, error: &std::io::Error) -> CatalogError {
    let problem = format!("cannot be written: {error}; give another folder with `--into DIR`");
    CatalogError::File { path: path.to_path_buf(), problem }
}
