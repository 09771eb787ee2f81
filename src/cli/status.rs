//! `ensonify status`: how far a dataset is.

use std::path::PathBuf;

use clap::Args;

use super::Code;
use crate::store::Status;

/// Shows how far a dataset is
///
/// Reads only, so it may be asked while a run is writing.
#[derive(Debug, Args)]
pub struct StatusVerb {
    /// Folder of the dataset, such as out/quickstart
    dataset: PathBuf,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

impl StatusVerb {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let status = Status::read(&self.dataset)?;
        if self.json {
            say!("{}", serde_json::to_string_pretty(&status)?);
            return Ok(Code::Done);
        }
        let state = if status.finished { "finished" } else { "not finished: run the recipe again to go on" };
        say!("{}: {} of {} frames, {state}", status.name, status.frames_done, status.frames_total);
        say!("  size         {:.1} MB", status.bytes as f64 / 1e6);
        say!("  plan hash    {}", status.plan_hash);
        if let Some(hash) = &status.dataset_hash {
            say!("  dataset hash {hash}");
        }
        for (view, labels) in &status.annotations {
            let total: u64 = labels.values().sum();
            say!("  annotations of the {} view: {total}", view.name());
            labels.iter().for_each(|(label, count)| say!("    {label:24} {count:>8}"));
        }
        Ok(Code::Done)
    }
}
