//! Models with bytes, numbers and chunks changed at random: each gives a model or an error, soon and with little memory.
//!
//! `ENSONIFY_MUTANTS=2000000 ENSONIFY_FIRST_MUTANT=0` tries more; a mutant is the same wherever it is tried.

mod memory;
mod mutants;
mod support;

use std::fs;
use std::path::Path;
use std::process::abort;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant};

use ensonify::catalog::{CatalogError, ModelFault, read_model};
use mutants::{Seed, mutant};

const LONGEST: Duration = Duration::from_secs(2);
const MOST_BYTES: usize = 1 << 30;
/// Largest seed, bytes: mutants of small files find as much in less time.
const LARGEST_SEED: u64 = 64_000;

/// Milliseconds since the start at which the mutant in work began, and its number; 0 between mutants.
static BEGUN: AtomicU64 = AtomicU64::new(0);
static NUMBER: AtomicU64 = AtomicU64::new(0);

#[test]
fn mutants_are_models_or_errors() {
    let variable = |name: &str, otherwise: u64| match std::env::var(name) {
        Ok(text) => text.parse().expect("a number"),
        Err(_) => otherwise,
    };
    let (count, first) = (variable("ENSONIFY_MUTANTS", 20_000), variable("ENSONIFY_FIRST_MUTANT", 0));
    let seeds = seeds();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let start = Instant::now();
    watch(start);
    let (mut models, mut longest, mut most) = (0, (Duration::ZERO, 0), (0, 0));
    for number in first..first + count {
        let (bytes, seed) = mutant(&seeds, number);
        let path = folder.path().join(&seed.name);
        // A file that is replaced is flushed to the disk on some systems; a new one is not.
        let _ = fs::remove_file(&path);
        fs::write(&path, &bytes).expect("written");
        NUMBER.store(number, Relaxed);
        BEGUN.store(start.elapsed().as_millis() as u64 + 1, Relaxed);
        let begun = Instant::now();
        let (result, memory) = memory::most_allocated(|| read_model(&path, Some(folder.path())));
        let took = begun.elapsed();
        BEGUN.store(0, Relaxed);
        match result {
            Ok(reading) => {
                let sound = reading.model.bounds().is_none_or(|(low, high)| low.is_finite() && high.is_finite());
                assert!(sound, "mutant {number} of {}", seed.name);
                models += 1;
            }
            Err(error) => {
                let crashed = matches!(error, CatalogError::Model { fault: ModelFault::Crash, .. });
                assert!(!crashed, "mutant {number} of {} makes the reader fail", seed.name);
                assert!(error.to_string().contains(&seed.name), "mutant {number}: {error}");
            }
        }
        assert!(memory < MOST_BYTES, "mutant {number} of {}: {memory} bytes", seed.name);
        longest = longest.max((took, number));
        most = most.max((memory, number));
    }
    println!("{count} mutants of {} seeds in {:.0?}: {models} models", seeds.len(), start.elapsed());
    println!("longest {longest:?}, most bytes {most:?}");
    assert!(longest.0 < LONGEST, "mutant {} took {:?}", longest.1, longest.0);
}

/// Small models of the starter catalog, and odd files where they are at hand.
fn seeds() -> Vec<Seed> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
    let mut files = Vec::new();
    collect(&here, &mut files);
    if let Some(torture) = support::shared("gltf-torture") {
        collect(&torture, &mut files);
    }
    files.sort();
    let seeds: Vec<Seed> = files.iter().filter_map(|file| Seed::open(file)).collect();
    assert!(seeds.len() >= 20, "only {} seeds", seeds.len());
    seeds
}

fn collect(folder: &Path, files: &mut Vec<std::path::PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        let is_model = path.extension().is_some_and(|extension| extension == "glb" || extension == "gltf");
        if path.is_dir() {
            collect(&path, files);
        } else if is_model && fs::metadata(&path).is_ok_and(|about| about.len() <= LARGEST_SEED) {
            files.push(path);
        }
    }
}

/// Ends the test where one mutant does not end: a hang cannot be caught.
fn watch(start: Instant) {
    thread::spawn(move || {
        loop {
            thread::sleep(Duration::from_millis(200));
            let (begun, now) = (BEGUN.load(Relaxed), start.elapsed().as_millis() as u64);
            if begun != 0 && now > begun + 30_000 {
                eprintln!("mutant {} does not end", NUMBER.load(Relaxed));
                abort();
            }
        }
    });
}
