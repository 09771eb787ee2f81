//! `ensonify status`: how far a dataset is.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use indicatif::HumanDuration;

use super::Code;
use crate::store::Status;

/// Most failed frames listed; `--json` has all.
const MOST_FAILED: usize = 10;

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
        if status.shards > 1 {
            say!("  shards       {} journals", status.shards);
        }
        if let (Some(rate), Some(left)) = (status.frames_per_s, status.left_s) {
            say!("  rate         {rate:.1} frames/s, {} left", HumanDuration(Duration::from_secs_f64(left)));
        }
        let splits: Vec<String> = status.splits.iter().map(|(split, count)| format!("{split} {count}")).collect();
        if !splits.is_empty() {
            say!("  splits       {}", splits.join(", "));
        }
        if !status.failed.is_empty() {
            say!("  failed       {}", status.failed.len());
            status.failed.iter().take(MOST_FAILED).for_each(|(id, reason)| say!("    {id:>8}  {reason}"));
        }
        for (view, labels) in &status.annotations {
            let total: u64 = labels.values().sum();
            say!("  annotations of the {} view: {total}", view.name());
            labels.iter().for_each(|(label, count)| say!("    {label:24} {count:>8}"));
        }
        Ok(Code::Done)
    }
}
