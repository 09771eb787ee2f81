//! Making the index of a large collection from its metadata alone.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::facts::size_and_time;
use super::files::{put, unwritable};
use crate::catalog::disk::{self, DiskIndex};
use crate::catalog::error::CatalogError;
use crate::catalog::home::{Home, Kind};
use crate::catalog::objaverse::{self, Counts, Gathered};

/// What the index was made from; may be deleted.
const SOURCES: &str = ".catalog.sources.json";

/// A collection that is indexed by its metadata.
#[derive(Clone, Debug)]
pub struct Collection {
    /// Root of its models.
    root: PathBuf,
    kind: Kind,
}

/// What came of indexing a collection.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Models in the index.
    pub models: u64,
    /// Models whose files are there.
    pub on_disk: u64,
    /// Files of metadata.
    pub sources: u64,
    /// Files of metadata that are new or have changed; none if nothing was to be done.
    pub changed: Vec<String>,
    /// Files of metadata that are gone.
    pub missing: Vec<String>,
    /// What is wrong with the collection.
    pub problems: Vec<String>,
}

/// A file of metadata as it was.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Source {
    path: String,
    bytes: u64,
    written: u64,
}

#[derive(Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct Sources {
    /// Version of the program, as another one may read labels otherwise.
    program: String,
    files: Vec<Source>,
    on_disk: u64,
    problems: Vec<String>,
}

impl Collection {
    /// The collection in a folder, if it is one.
    #[must_use]
    pub fn of(dir: &Path) -> Option<Self> {
        let objaverse = || objaverse::home(dir).map(|root| Self { root, kind: Kind::Objaverse });
        #[cfg(feature = "parquet")]
        if objaverse::xl::is_in(dir) {
            return Some(Self { root: dir.to_path_buf(), kind: Kind::ObjaverseXl });
        }
        objaverse()
    }

    /// The collection that an index in a folder was made of.
    ///
    /// # Errors
    /// If its `catalog.yaml` cannot be read.
    pub fn behind(dir: &Path) -> Result<Self, CatalogError> {
        let Home { root, kind } = Home::read(dir)?;
        Ok(Self { root, kind })
    }

    /// Writes its index into a folder; does nothing if it is there and no metadata has changed.
    ///
    /// # Errors
    /// If the folder cannot be written or a path leads out of the collection.
    pub fn index(&self, dir: &Path) -> Result<Report, CatalogError> {
        fs::create_dir_all(dir).map_err(|e| unwritable(dir, &e))?;
        let files = self.sources()?;
        let before = sources_of(dir);
        let mut report = Report { sources: files.len() as u64, ..Report::default() };
        let known = before.program == program();
        report.changed = files.iter().filter(|f| !known || !before.files.contains(f)).map(|f| f.path.clone()).collect();
        let gone = |old: &&Source| !files.iter().any(|file| file.path == old.path);
        report.missing = before.files.iter().filter(gone).map(|file| file.path.clone()).collect();
        if report.changed.is_empty()
            && report.missing.is_empty()
            && let Ok(index) = DiskIndex::open(dir, &self.root)
        {
            report.models = u64::from(index.count());
            (report.on_disk, report.problems) = (before.on_disk, before.problems);
            return Ok(report);
        }
        let Gathered { batches, counts, problems } = self.gather()?;
        let Counts { on_disk, .. } = counts;
        Home { root: self.root.clone(), kind: self.kind }.write(dir)?;
        report.models = u64::from(disk::write(dir, batches)?);
        let now = Sources { program: program(), files, on_disk, problems };
        let text = serde_json::to_vec_pretty(&now).map_err(|e| unwritable(&dir.join(SOURCES), &e.into()))?;
        put(dir, SOURCES, &text)?;
        (report.on_disk, report.problems) = (on_disk, now.problems);
        Ok(report)
    }

    /// Files of metadata that are not as they were when the index of a folder was made.
    ///
    /// # Errors
    /// If the collection cannot be read.
    pub fn changed_since(&self, dir: &Path) -> Result<Vec<String>, CatalogError> {
        let (now, before) = (self.sources()?, sources_of(dir).files);
        let changed = now.iter().filter(|file| !before.contains(file));
        let gone = before.iter().filter(|old| !now.iter().any(|file| file.path == old.path));
        Ok(changed.chain(gone).map(|file| file.path.clone()).collect())
    }

    fn gather(&self) -> Result<Gathered, CatalogError> {
        match self.kind {
            #[cfg(feature = "parquet")]
            Kind::ObjaverseXl => objaverse::xl::gather(&self.root),
            _ => objaverse::gather(&self.root),
        }
    }

    fn sources(&self) -> Result<Vec<Source>, CatalogError> {
        let files = match self.kind {
            #[cfg(feature = "parquet")]
            Kind::ObjaverseXl => objaverse::xl::sources(&self.root)?,
            _ => objaverse::sources(&self.root)?,
        };
        let source = |path: PathBuf| {
            let (bytes, written) = size_and_time(&path).unwrap_or_default();
            Source { path: super::relative(&self.root, &path), bytes, written }
        };
        Ok(files.into_iter().map(source).collect())
    }
}

fn program() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

fn sources_of(dir: &Path) -> Sources {
    let read = fs::read(dir.join(SOURCES)).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    read.unwrap_or_default()
}
