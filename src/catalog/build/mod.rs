//! Making the index of a folder of models, or of a cache of Objaverse: `catalog.csv`, its lock, and a state that spares unchanged files.
//!
//! [`scan`] finds files, [`facts`] reads what each holds, [`listing`] what tables beside them say, [`derive`] makes rows
//! of it, [`files`] writes. What a person wrote into `catalog.csv` stays; see [`derive::merged`].

pub mod collection;
pub mod derive;
pub mod facts;
pub mod files;
pub mod listing;
pub mod scan;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};
use serde::Serialize;

use self::derive::{Row, derived, merged};
use self::facts::Facts;
use self::files::State;
use self::listing::Listings;
use super::error::CatalogError;
use super::home::{Home, Kind};
use super::overrides::Overrides;

/// What came of indexing a folder.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Models in the index.
    pub models: u64,
    /// Files that were read.
    pub read: u64,
    /// Paths of models that are new.
    pub new: Vec<String>,
    /// Paths of models whose files have changed.
    pub changed: Vec<String>,
    /// Uids whose files are gone; their lines are taken out.
    pub missing: Vec<String>,
    /// Old and new paths of files that were renamed; their lines stay.
    pub moved: Vec<(String, String)>,
    /// Files that cannot be used, with the reason.
    pub unusable: Vec<(String, String)>,
    /// What else a person should know.
    pub notes: Vec<String>,
}

/// What was indexed.
#[derive(Clone, Debug)]
pub enum Indexed {
    /// A folder of models.
    Folder(Report),
    /// A large collection.
    Collection(collection::Report),
}

/// Indexes a folder of models or a cache of Objaverse. The index goes `into` a folder, else beside the models.
///
/// # Errors
/// If a folder cannot be read or written, or something in it is wrong.
pub fn index(source: &Path, into: Option<&Path>) -> Result<Indexed, CatalogError> {
    let fault = |e: std::io::Error| CatalogError::File {
        path: source.to_path_buf(),
        problem: format!("cannot be indexed: {e}; name a folder of glTF models or a cache of Objaverse"),
    };
    let root = source.canonicalize().map_err(fault)?;
    let Some(collection) = collection::Collection::of(&root) else {
        let dir = into.unwrap_or(source);
        let root = if into.is_none() { source } else { &root };
        return index_folder(root, dir).map(Indexed::Folder);
    };
    let Some(dir) = into else {
        let problem = "is a cache, which is left as it is; say where its index goes with `--into DIR`".into();
        return Err(CatalogError::File { path: source.to_path_buf(), problem });
    };
    collection.index(dir).map(Indexed::Collection)
}

/// Indexes the models below `root` into the folder `dir`, which may be the same.
///
/// # Errors
/// If a folder cannot be read or written, or a table beside the models is wrong.
pub fn index_folder(root: &Path, dir: &Path) -> Result<Report, CatalogError> {
    let mut report = Report::default();
    let scan::Scanned { files, refused } = scan::models(root)?;
    report.notes.extend(refused);
    let listings = Listings::read(root)?;
    let overrides = Overrides::read(dir)?;
    let home = Home { root: root.to_path_buf(), kind: Kind::Folder };
    let state = State::read(dir);
    let old = files::read_rows(dir)?;
    let facts = gathered(root, &files, &state, &mut report);
    let renamed = renamed(&facts, &state, &old, &mut report);
    let mut rows: Vec<Row> = Vec::new();
    let mut made: BTreeMap<String, Row> = BTreeMap::new();
    let mut taken: BTreeSet<String> = BTreeSet::new();
    for (path, facts) in &facts {
        let before = old.get(renamed.get(path).unwrap_or(path));
        let stated = before.map(|row| row.uid().to_owned()).or_else(|| listings.of(path).and_then(|l| l.uid.clone()));
        let uid = unique(stated.unwrap_or_else(|| uid_of(path)), path, &mut taken);
        let last = state.row(renamed.get(path).unwrap_or(path));
        let (fresh, row) = merged(before, last, |label| {
            let mut row = derived(path, facts, listings.of(path), label);
            row.set("uid", uid.clone());
            row
        });
        made.insert(path.clone(), fresh);
        rows.push(row.with(overrides.of(&uid)));
    }
    rows.sort_by(|a, b| a.uid().cmp(b.uid()));
    for row in old.values().filter(|row| !rows.iter().any(|now| now.uid() == row.uid())) {
        report.missing.push(row.uid().to_owned());
    }
    if let Err(error) = overrides.check(|uid| rows.iter().any(|row| row.uid() == uid)) {
        report.notes.push(error.to_string());
    }
    report.notes.extend(listings.unused(facts.keys()));
    report.models = rows.len() as u64;
    files::write(dir, &home, &rows, &facts, &made)?;
    Ok(report)
}

/// Facts of every usable file, read anew only where the file has changed.
fn gathered(root: &Path, files: &[PathBuf], state: &State, report: &mut Report) -> BTreeMap<String, Facts> {
    let looked: Vec<(String, Looked)> = files
        .into_par_iter()
        .map(|file| {
            let path = relative(root, file);
            let looked = match state.unchanged(&path, root) {
                Some(facts) => Looked::Same(facts.clone()),
                None => Facts::read(root, file).map_or_else(|e| Looked::Unusable(e.to_string()), Looked::Read),
            };
            (path, looked)
        })
        .collect();
    let mut all = BTreeMap::new();
    for (path, looked) in looked {
        match looked {
            Looked::Unusable(why) => report.unusable.push((path, why)),
            Looked::Same(facts) => {
                all.insert(path, facts);
            }
            Looked::Read(facts) => {
                report.read += 1;
                match state.sha256(&path) {
                    None => report.new.push(path.clone()),
                    // Touched, but not changed.
                    Some(before) if before == facts.sha256 => {}
                    Some(_) => report.changed.push(path.clone()),
                }
                all.insert(path, facts);
            }
        }
    }
    all
}

enum Looked {
    Same(Facts),
    Read(Facts),
    Unusable(String),
}

/// New path → old path of files whose content was known under another name.
fn renamed(
    facts: &BTreeMap<String, Facts>,
    state: &State,
    old: &BTreeMap<String, Row>,
    report: &mut Report,
) -> BTreeMap<String, String> {
    let mut renamed = BTreeMap::new();
    let gone: Vec<&String> = old.keys().filter(|path| !facts.contains_key(*path)).collect();
    for path in report.new.clone() {
        let same = |from: &&&String| state.sha256(from).is_some_and(|sha| sha == facts[&path].sha256);
        if let Some(from) = gone.iter().find(same).filter(|from| !renamed.values().any(|used| used == **from)) {
            report.new.retain(|new| *new != path);
            report.moved.push(((*from).clone(), path.clone()));
            renamed.insert(path, (*from).clone());
        }
    }
    renamed
}

/// A path below the root as indexes write it.
pub(crate) fn relative(root: &Path, file: &Path) -> String {
    let below = file.strip_prefix(root).unwrap_or(file);
    below.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

fn uid_of(path: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    plain(name.rsplit_once('.').map_or(name, |(stem, _)| stem))
}

/// Two files of one name are told apart by their folders.
fn unique(uid: String, path: &str, taken: &mut BTreeSet<String>) -> String {
    let whole = plain(path.rsplit_once('.').map_or(path, |(stem, _)| stem));
    let numbered = (2..).map(|number| format!("{whole}-{number}"));
    let mut names = [uid, whole.clone()].into_iter().chain(numbered);
    names.find(|name| taken.insert(name.clone())).unwrap_or(whole)
}

/// Letters, digits, `-`, `_` and `.` only.
fn plain(text: &str) -> String {
    let kept: String = text.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect();
    let kept = kept.trim_matches(['-', '.']).to_owned();
    if kept.is_empty() { "model".into() } else { kept }
}
