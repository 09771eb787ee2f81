//! `ensonify verify`: every file of a dataset against its hash, and frames against their being made again.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::bail;
use clap::Args;
use serde::Serialize;

use super::Code;
use crate::math::rng::Stream;
use crate::run::{GivenPlan, Otherwise, Project, rerender};
use crate::store::{Dataset, Verification, layout, verify};

/// Most paths listed of a kind; `--json` has all.
const MOST: usize = 20;

/// Checks every file of a dataset against its hash
///
/// Names what is changed, missing or extra. Damaged frames are noted in the dataset's folder, and the next `run` of the
/// recipe renders exactly those again. Exit code 4 if anything differs.
#[derive(Debug, Args)]
pub struct Verify {
    /// Folder of the dataset
    dataset: PathBuf,
    /// Render so many random frames again and compare their bytes
    #[arg(long, value_name = "N")]
    rerender: Option<u64>,
    /// Where relative paths of the plan begin, for rendering: the recipe's folder [default: the current folder]
    #[arg(long, value_name = "DIR", requires = "rerender")]
    base: Option<PathBuf>,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Report {
    #[serde(flatten)]
    files: Verification,
    /// Frames rendered again.
    rerendered: Vec<u64>,
    /// Those that came out otherwise.
    otherwise: Vec<Otherwise>,
}

impl Verify {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let files = verify(&self.dataset)?;
        let (rerendered, otherwise) = match self.rerender {
            Some(count) => self.rerender(count)?,
            None => Default::default(),
        };
        let is_whole = files.changed.is_empty() && files.missing.is_empty() && files.extra.is_empty();
        let report = Report { files, rerendered, otherwise };
        if self.json {
            say!("{}", serde_json::to_string_pretty(&report)?);
        } else {
            print(&report, is_whole);
        }
        Ok(if is_whole && report.otherwise.is_empty() { Code::Done } else { Code::Different })
    }

    /// Renders frames again: which, and which of them differ.
    fn rerender(&self, count: u64) -> anyhow::Result<(Vec<u64>, Vec<Otherwise>)> {
        let dataset = Dataset::open(&self.dataset)?;
        let base = self.base.clone().unwrap_or_else(|| PathBuf::from("."));
        let project = Project::load_plan(&GivenPlan { path: &self.dataset.join(layout::PLAN), base: Some(&base) })?;
        if project.plan_hash != dataset.plan_hash() {
            bail!("{} is not the plan of the dataset; run the recipe again", layout::PLAN);
        }
        let missing: BTreeSet<u64> = dataset.missing().into_iter().collect();
        let mut there: Vec<u64> = (0..dataset.planned()).filter(|id| !missing.contains(id)).collect();
        // Other frames each time, so that asking often finds more.
        let seed = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos() as u64);
        let mut stream = Stream::at(seed, "verify", 0, "frames");
        let mut ids: Vec<u64> = Vec::new();
        while !there.is_empty() && (ids.len() as u64) < count {
            ids.push(there.swap_remove(stream.below(there.len() as u64) as usize));
        }
        ids.sort_unstable();
        let otherwise = rerender(&project, &dataset, &ids)?;
        Ok((ids, otherwise))
    }
}

fn print(report: &Report, is_whole: bool) {
    let Report { files, rerendered, otherwise } = report;
    for (what, paths) in [("changed", &files.changed), ("missing", &files.missing), ("extra", &files.extra)] {
        paths.iter().take(MOST).for_each(|path| say!("{what}  {path}"));
        if paths.len() > MOST {
            say!("{what}  … and {} more", paths.len() - MOST);
        }
    }
    say!(
        "{} files checked, {}",
        files.checked,
        if is_whole { "all as they should be" } else { "not all as they should be" }
    );
    if !is_whole {
        eprintln!("{} frames are damaged; the same `ensonify run` mends frames and derived files", files.frames.len());
    }
    for frame in otherwise.iter().take(MOST) {
        say!("frame {} comes out otherwise: {}", frame.id, frame.what.join(", "));
    }
    if !rerendered.is_empty() {
        say!("{} frames rendered again, {} came out otherwise", rerendered.len(), otherwise.len());
    }
}
