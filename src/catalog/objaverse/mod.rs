//! A cache of Objaverse 1.0, read where it lies: metadata shards, paths and LVIS categories into one index.
//!
//! Knows the cache's layout and its records; how they are kept and searched is [`super::disk`]'s. Nothing is fetched, no
//! model is opened. Downloads break off: files that are cut off give what they have, and are reported.
//!
//! Source: the `objaverse` package 0.1.7 on PyPI.

mod gzip;
mod record;
#[cfg(feature = "parquet")]
pub mod xl;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use rayon::iter::{IntoParallelRefIterator as _, ParallelIterator as _};
use rayon::slice::ParallelSliceMut as _;

use self::gzip::{Contents, Text, each_entry};
use self::record::Metadata;
use super::disk::Batch;
use super::error::CatalogError;
use super::paths;

/// Folder of Objaverse 1.0 in a cache.
const HOME: &str = "hf-objaverse-v1";
const PATHS: &str = "object-paths.json.gz";
const LVIS: &str = "lvis-annotations.json.gz";
const METADATA: &str = "metadata";

/// What was found in a cache.
#[derive(Debug, Default)]
pub struct Gathered {
    /// Everything that goes into the index.
    pub batches: Vec<Batch>,
    /// Models by what is known of them.
    pub counts: Counts,
    /// What is wrong with the cache, each with its file.
    pub problems: Vec<String>,
}

/// Models by what is known of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// With metadata.
    pub described: u64,
    /// With a path alone.
    pub paths_alone: u64,
    /// Whose file is in the cache.
    pub on_disk: u64,
}

/// The folder `hf-objaverse-v1` of a cache, given itself or the folder that holds it.
#[must_use]
pub fn home(dir: &Path) -> Option<PathBuf> {
    let is_cache = |dir: &Path| dir.join(PATHS).is_file() || dir.join(METADATA).join("000-000.json.gz").is_file();
    [dir.join(HOME), dir.to_path_buf()].into_iter().find(|dir| is_cache(dir))
}

/// The files of a cache's metadata.
///
/// # Errors
/// If the folder cannot be read.
pub fn sources(home: &Path) -> Result<Vec<PathBuf>, CatalogError> {
    let mut files: Vec<PathBuf> = [PATHS, LVIS].iter().map(|name| home.join(name)).filter(|f| f.is_file()).collect();
    let folder = home.join(METADATA);
    if folder.is_dir() {
        let fault =
            |e: std::io::Error| CatalogError::File { path: folder.clone(), problem: format!("cannot be read: {e}") };
        for entry in folder.read_dir().map_err(fault)? {
            let path = entry.map_err(fault)?.path();
            if path.to_string_lossy().ends_with(".json.gz") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// Reads all metadata of a cache.
///
/// # Errors
/// If a path leads out of the cache; what is broken or missing is told in [`Gathered::problems`].
pub fn gather(home: &Path) -> Result<Gathered, CatalogError> {
    let mut gathered = Gathered::default();
    let paths = object_paths(home, &mut gathered.problems)?;
    let lvis = categories(home, &mut gathered.problems);
    let shards: Vec<PathBuf> =
        sources(home)?.into_iter().filter(|f| f.parent() == Some(&home.join(METADATA))).collect();
    let known = Known { paths, lvis };
    let read: Vec<Shard> = shards.par_iter().map(|file| shard(file, &known)).collect();
    let mut described: Vec<u32> = Vec::with_capacity(known.paths.len());
    for (file, shard) in shards.iter().zip(read) {
        gathered.problems.extend(shard.problem.map(|problem| format!("{}: {problem}", file.display())));
        gathered.counts.described += shard.batch.count() as u64;
        described.extend(shard.places);
        gathered.batches.push(shard.batch);
    }
    described.sort_unstable();
    gathered.batches.push(alone(&known, &described, &mut gathered.counts));
    if let 1.. = gathered.counts.paths_alone {
        let count = gathered.counts.paths_alone;
        gathered.problems.push(format!("{count} models have no metadata: their names and licences are unknown"));
    }
    gathered.counts.on_disk = on_disk(home);
    Ok(gathered)
}

/// Paths by uid, in the order of uids.
type Paths = Vec<(Box<str>, Box<str>)>;

/// What is known before the records are read.
struct Known {
    /// By uid.
    paths: Paths,
    lvis: HashMap<String, String>,
}

impl Known {
    fn path(&self, uid: &str) -> Option<(u32, &str)> {
        let place = self.paths.binary_search_by(|(known, _)| (**known).cmp(uid)).ok()?;
        Some((place as u32, &self.paths[place].1))
    }
}

/// The models of one file of metadata.
struct Shard {
    batch: Batch,
    /// Places of its models among the paths.
    places: Vec<u32>,
    problem: Option<String>,
}

fn shard(file: &Path, known: &Known) -> Shard {
    let mut out = Shard { batch: Batch::default(), places: Vec::new(), problem: None };
    let contents = match Contents::read(file) {
        Ok(contents) => contents,
        Err(error) => {
            out.problem = Some(format!("cannot be read: {error}"));
            return out;
        }
    };
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let folder = name.trim_end_matches(".json.gz");
    let mut refused = None;
    let parsed = each_entry(&contents.bytes, |uid, metadata: Metadata<'_>| {
        let path = match known.path(&uid) {
            Some((place, path)) => {
                out.places.push(place);
                path.to_owned()
            }
            // The file of metadata has the name of the models' folder.
            None => format!("glbs/{folder}/{uid}.glb"),
        };
        let category = known.lvis.get(&*uid).map_or("", String::as_str);
        let record = metadata.record(&uid, path, category);
        match paths::inside(Path::new(""), &record.path) {
            Ok(_) => record::add(&mut out.batch, &record),
            Err(_) => refused = Some(uid),
        }
    });
    out.batch.close();
    out.problem = contents.problem(parsed, out.batch.count());
    if let Some(uid) = refused {
        out.problem
            .get_or_insert(format!("the uid `{}` is no name of a file: it is left out", super::text::clean(&uid)));
    }
    out
}

/// Records of models that have a path and nothing else.
fn alone(known: &Known, described: &[u32], counts: &mut Counts) -> Batch {
    let mut batch = Batch::default();
    for (place, (uid, path)) in (0..).zip(&known.paths) {
        if described.binary_search(&place).is_err() {
            let category = known.lvis.get(&**uid).map_or("", String::as_str);
            record::add(&mut batch, &Metadata::default().record(uid, path.to_string(), category));
        }
    }
    batch.close();
    counts.paths_alone = batch.count() as u64;
    batch
}

/// Paths by uid, in the order of uids.
fn object_paths(home: &Path, problems: &mut Vec<String>) -> Result<Paths, CatalogError> {
    let file = home.join(PATHS);
    let mut paths: Paths = Vec::new();
    let mut refused = None;
    let contents = match Contents::read(&file) {
        Ok(contents) => contents,
        Err(error) => {
            problems.push(format!(
                "{}: cannot be read: {error}; paths are taken from the names of the metadata",
                file.display()
            ));
            return Ok(paths);
        }
    };
    let parsed = each_entry(&contents.bytes, |uid, Text(path): Text<'_>| {
        if let Err(problem) = paths::inside(Path::new(""), &path) {
            refused.get_or_insert_with(|| format!("{}: {problem}", super::text::clean(&uid)));
        }
        paths.push((uid.into(), path.into()));
    });
    if let Some(problem) = refused {
        return Err(CatalogError::File { path: file, problem });
    }
    problems.extend(contents.problem(parsed, paths.len()).map(|problem| format!("{}: {problem}", file.display())));
    paths.par_sort_unstable();
    paths.dedup_by(|b, a| a.0 == b.0);
    Ok(paths)
}

/// LVIS categories by uid.
fn categories(home: &Path, problems: &mut Vec<String>) -> HashMap<String, String> {
    let file = home.join(LVIS);
    let mut of_uid = HashMap::new();
    let Ok(contents) = Contents::read(&file) else { return of_uid };
    let parsed = each_entry(&contents.bytes, |category, uids: Vec<String>| {
        for uid in uids {
            of_uid.insert(uid, super::text::clean(&category));
        }
    });
    problems.extend(contents.problem(parsed, of_uid.len()).map(|problem| format!("{}: {problem}", file.display())));
    of_uid
}

/// How many models are in the cache, by the names of its files.
fn on_disk(home: &Path) -> u64 {
    let folders = home.join("glbs").read_dir().into_iter().flatten().flatten();
    let files = folders.flat_map(|folder| folder.path().read_dir().into_iter().flatten().flatten());
    files.filter(|file| file.path().extension().is_some_and(|e| e == "glb")).count() as u64
}
