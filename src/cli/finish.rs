//! `ensonify finish`: the parts of a dataset put together.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::Context as _;
use clap::Args;

use super::{Code, run};
use crate::export::{Extent, FinishInput, finish};
use crate::store::{Dataset, Status, layout};

/// Puts the shards of a dataset together
///
/// Writes annotations, tables, card and hashes from the frames that are there, the same bytes however the frames were
/// divided. A `run` of the whole recipe does this by itself; after `run --shard` it is the last step. It may be done
/// again.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  ensonify run survey.yaml -o out/survey --shard 0/2\n  \
    ensonify run survey.yaml -o out/survey --shard 1/2\n  ensonify finish out/survey")]
pub struct Finish {
    /// Folder of the dataset
    dataset: PathBuf,
    /// Finish what is there even if frames are missing
    #[arg(long)]
    partial: bool,
    /// Wait until every frame is there; for engines that start the finishing with the shards
    #[arg(long, conflicts_with = "partial")]
    wait: bool,
}

/// Between two looks of one who waits.
const LOOK_EACH: Duration = Duration::from_secs(10);

impl Finish {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        if self.wait {
            while Status::read(&self.dataset).map_or(true, |status| status.frames_done < status.frames_total) {
                std::thread::sleep(LOOK_EACH);
            }
        }
        let dataset = Dataset::open(&self.dataset)?;
        let input: FinishInput = serde_json::from_slice(&dataset.facts()?).with_context(|| {
            format!("{} is damaged; run the recipe again with --limit 0", self.dataset.join(layout::FACTS).display())
        })?;
        let extent = if self.partial { Extent::Partial } else { Extent::Whole };
        let summary = finish(&dataset, &input, extent)?;
        let missing = dataset.planned() - dataset.done();
        run::report_summary(dataset.name(), &self.dataset, &summary);
        for (id, reason) in dataset.failed() {
            eprintln!("note: frame {id} failed: {reason}");
        }
        if missing > 0 {
            eprintln!(
                "{missing} of {} frames are missing; run the recipe and finish again to add them",
                dataset.planned()
            );
        }
        Ok(if missing > 0 { Code::FramesFailed } else { Code::Done })
    }
}
