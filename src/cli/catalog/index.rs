//! `ensonify catalog index`: makes or renews the index of a folder of models.

use std::path::PathBuf;

use clap::Args;

use crate::catalog::Catalog;
use crate::catalog::build::{Indexed, Report, collection, index};
use crate::cli::Code;

/// Lines of a kind that are printed one by one.
const MOST_LINES: usize = 20;

/// Indexes a folder of models, or a cache of Objaverse where it lies
///
/// Writes catalog.csv and catalog.lock. Sizes, upright axes and materials come from tables beside the models, from the files,
/// and from what is known of their labels. Done again, only changed files are read; what was edited in catalog.csv stays, and
/// catalog.overrides.yaml beside it is never written.
#[derive(Debug, Args)]
pub struct Index {
    /// A folder with .glb and .gltf files, or a cache of Objaverse such as ~/.objaverse
    source: PathBuf,
    /// The folder of the index, where it is not to be beside the models
    #[arg(long, value_name = "DIR")]
    into: Option<PathBuf>,
    /// What was done, as JSON with stable names
    #[arg(long)]
    json: bool,
}

impl Index {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let dir = self.into.as_ref().unwrap_or(&self.source);
        let indexed = index(&self.source, self.into.as_deref())?;
        // What was written must be readable.
        Catalog::open(dir)?;
        match &indexed {
            Indexed::Folder(report) if self.json => say!("{}", serde_json::to_string_pretty(report)?),
            Indexed::Collection(report) if self.json => say!("{}", serde_json::to_string_pretty(report)?),
            Indexed::Folder(report) => tell_folder(report),
            Indexed::Collection(report) => tell_collection(report),
        }
        if !self.json {
            say!("index: {}", dir.display());
        }
        Ok(Code::Done)
    }
}

fn tell_folder(report: &Report) {
    let Report { models, read, new, changed, missing, moved, unusable, notes } = report;
    say!(
        "{models} models; {read} files read: {} new, {} changed, {} missing, {} renamed",
        new.len(),
        changed.len(),
        missing.len(),
        moved.len()
    );
    lines("new", new.iter().cloned());
    lines("changed", changed.iter().cloned());
    lines("missing", missing.iter().map(|uid| format!("{uid} (its line is taken out)")));
    lines("renamed", moved.iter().map(|(from, to)| format!("{from} is now {to}")));
    for (path, why) in unusable {
        eprintln!("warning: {path} is left out: {why}");
    }
    notes.iter().for_each(|note| eprintln!("note: {note}"));
}

fn tell_collection(report: &collection::Report) {
    let collection::Report { models, on_disk, sources, changed, missing, problems } = report;
    say!("{models} models, {on_disk} of them on disk; {sources} files of metadata, {} new or changed", changed.len());
    if changed.is_empty() && missing.is_empty() {
        say!("nothing has changed since the last time");
    }
    lines("missing", missing.iter().cloned());
    problems.iter().for_each(|problem| eprintln!("warning: {problem}"));
}

fn lines(kind: &str, items: impl ExactSizeIterator<Item = String>) {
    let count = items.len();
    items.take(MOST_LINES).for_each(|item| say!("  {kind}: {item}"));
    if count > MOST_LINES {
        say!("  {kind}: … and {} more", count - MOST_LINES);
    }
}
