//! `ensonify catalog annotate`: what models may be, where a catalog has guesses or nothing.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::Args;
use serde_json::json;

use super::Which;
use crate::cli::{Code, table};
use crate::draft::annotate::{PROPOSALS, Proposal, propose, sidecar};

/// Proposes labels, sizes, upright axes and materials where a catalog has guesses
///
/// From names, tags, names of parts, and what is known of labels, each with its reason. Proposals are written beside the index,
/// in the form of catalog.overrides.yaml, for you to look through: they change nothing before they stand in that file.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  ensonify catalog annotate -c my-models\n  ensonify catalog annotate -c my-models --apply"
)]
pub struct Annotate {
    #[command(flatten)]
    which: Which,
    /// Writes catalog.proposals.yaml into the catalog's folder
    #[arg(long)]
    apply: bool,
    /// Writes the proposals of one catalog into this file
    #[arg(long, value_name = "FILE", conflicts_with = "apply")]
    into: Option<PathBuf>,
    /// Most models of a catalog that are looked at; 0 for all
    #[arg(short = 'n', long, default_value_t = 1000)]
    limit: u64,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

impl Annotate {
    pub(in crate::cli) fn run(&self) -> anyhow::Result<Code> {
        let catalogs = self.which.open()?;
        if self.into.is_some() && catalogs.len() != 1 {
            bail!(
                "--into takes the proposals of one catalog, and there are {}; name it with --catalog",
                catalogs.len()
            );
        }
        let (mut rows, mut lines) = (Vec::new(), Vec::new());
        for opened in &catalogs {
            let proposals = self.of(opened)?;
            for proposal in &proposals {
                for change in &proposal.changes {
                    let (what, proposed) = (change.fact.key(), change.fact.text());
                    rows.push(
                        [&opened.name, &proposal.uid, what, &change.now, &proposed, &change.why]
                            .map(String::from)
                            .to_vec(),
                    );
                    lines.push(json!({"catalog": opened.name, "uid": proposal.uid, "what": what, "now": change.now,
                        "proposed": proposed, "why": change.why}));
                }
            }
            let beside = self.apply.then(|| opened.catalog.dir.join(PROPOSALS));
            if let Some(path) = self.into.clone().or(beside) {
                write(&path, &proposals)?;
            }
        }
        if self.json {
            say!("{}", serde_json::to_string_pretty(&lines)?);
        } else if rows.is_empty() {
            eprintln!("nothing to propose: labels, sizes and materials are all known");
        } else {
            table::print(&["catalog", "uid", "what", "now", "proposed", "why"], &rows);
        }
        Ok(Code::Done)
    }

    fn of(&self, opened: &super::Opened) -> anyhow::Result<Vec<Proposal>> {
        let count = opened.catalog.count();
        let most = if self.limit == 0 { count } else { self.limit.min(count) };
        if most < count {
            eprintln!("note: {most} of the {count} models of {} are looked at; --limit 0 looks at all", opened.name);
        }
        let mut proposals = Vec::new();
        for number in 0..most as u32 {
            let asset = opened.catalog.asset(number)?;
            match propose(&asset) {
                Ok(found) => proposals.extend(found),
                Err(error) => eprintln!("note: {}: {error}", asset.uid),
            }
        }
        Ok(proposals)
    }
}

fn write(path: &Path, proposals: &[Proposal]) -> anyhow::Result<()> {
    let is_overrides = path.file_name().is_some_and(|name| name == "catalog.overrides.yaml");
    if is_overrides {
        bail!("{} is what somebody stated, and is not written over; take another name", path.display());
    }
    std::fs::write(path, sidecar(proposals)).with_context(|| format!("cannot write {}", path.display()))?;
    eprintln!("{}: proposals for {} models", path.display(), proposals.len());
    Ok(())
}
