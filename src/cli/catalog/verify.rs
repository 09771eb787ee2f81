//! `ensonify catalog verify`: whether the files of catalogs are those that were indexed.

use clap::Args;
use serde::Serialize;

use super::{Opened, Which};
use crate::catalog::build::collection::Collection;
use crate::catalog::build::facts::sha256_of;
use crate::catalog::build::files::read_lock;
use crate::catalog::home::Home;
use crate::catalog::paths;
use crate::cli::Code;

/// Compares the files of catalogs with the hashes in their locks
#[derive(Debug, Args)]
pub struct Verify {
    #[command(flatten)]
    which: Which,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Default, Serialize)]
struct Outcome {
    catalog: String,
    /// Files that are as they were.
    same: u64,
    /// Files that differ.
    changed: Vec<String>,
    /// Files that are gone.
    missing: Vec<String>,
    /// Models of the index that the lock does not have.
    not_locked: Vec<String>,
    /// What else is wrong.
    problems: Vec<String>,
}

impl Verify {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let mut outcomes = Vec::new();
        for opened in self.which.open()? {
            outcomes.push(if opened.catalog.disk().is_some() { collection(&opened)? } else { folder(&opened)? });
        }
        if self.json {
            say!("{}", serde_json::to_string_pretty(&outcomes)?);
        } else {
            outcomes.iter().for_each(tell);
        }
        let sound = outcomes
            .iter()
            .all(|o| o.changed.is_empty() && o.missing.is_empty() && o.not_locked.is_empty() && o.problems.is_empty());
        Ok(if sound { Code::Done } else { Code::Different })
    }
}

fn folder(opened: &Opened) -> anyhow::Result<Outcome> {
    let dir = &opened.catalog.dir;
    let root = Home::read(dir)?.root;
    let lock = read_lock(dir)?;
    let mut outcome = Outcome { catalog: opened.name.clone(), ..Outcome::default() };
    for (path, sha256) in &lock {
        let file = match paths::inside(&root, path) {
            Ok(file) => file,
            Err(problem) => {
                outcome.problems.push(problem);
                continue;
            }
        };
        if !file.is_file() {
            outcome.missing.push(path.clone());
            continue;
        }
        match paths::real(&root, &file)
            .map_err(|e| e.to_string())
            .and_then(|f| sha256_of(&f).map_err(|e| e.to_string()))
        {
            Ok(now) if now == *sha256 => outcome.same += 1,
            Ok(_) => outcome.changed.push(path.clone()),
            Err(problem) => outcome.problems.push(problem),
        }
    }
    for asset in &opened.catalog.assets {
        let path = asset.path.strip_prefix(&root).unwrap_or(&asset.path).to_string_lossy().replace('\\', "/");
        if !lock.contains_key(&path) {
            outcome.not_locked.push(asset.uid.clone());
        }
    }
    Ok(outcome)
}

/// A large collection has no hashes of its models: its metadata must be what the index was made from, its records whole.
fn collection(opened: &Opened) -> anyhow::Result<Outcome> {
    let mut outcome = Outcome { catalog: opened.name.clone(), ..Outcome::default() };
    outcome.changed = Collection::behind(&opened.catalog.dir)?.changed_since(&opened.catalog.dir)?;
    for number in 0..opened.catalog.count() as u32 {
        match opened.catalog.asset(number) {
            Ok(_) => outcome.same += 1,
            Err(error) => outcome.problems.push(error.to_string()),
        }
    }
    Ok(outcome)
}

fn tell(outcome: &Outcome) {
    let Outcome { catalog, same, changed, missing, not_locked, problems } = outcome;
    say!(
        "{catalog}: {same} as indexed, {} changed, {} missing, {} not in the lock",
        changed.len(),
        missing.len(),
        not_locked.len()
    );
    for (kind, list) in
        [("changed", changed), ("missing", missing), ("not in the lock", not_locked), ("problem", problems)]
    {
        list.iter().for_each(|what| say!("  {kind}: {what}"));
    }
    if !(changed.is_empty() && missing.is_empty() && not_locked.is_empty()) {
        eprintln!("note: `ensonify catalog index` renews the index if the files are as they should be");
    }
}
