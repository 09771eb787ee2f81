//! `ensonify diff`: two datasets side by side.

use std::path::PathBuf;

use clap::Args;

use super::Code;
use crate::store::{Dataset, compare};

/// Most frames listed; `--json` has all.
const MOST: usize = 20;

/// Tells how two datasets differ: which frames, which drawn values, which bytes
///
/// Compares what the journals say, so it is quick; `verify` tells whether the files are what the journals say. Exit code 4
/// if anything differs.
#[derive(Debug, Args)]
pub struct Diff {
    /// Folder of a dataset
    first: PathBuf,
    /// Folder of another
    second: PathBuf,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

impl Diff {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let [first, second] = [Dataset::open(&self.first)?, Dataset::open(&self.second)?];
        let found = compare(&first, &second)?;
        if self.json {
            say!("{}", serde_json::to_string_pretty(&found)?);
        } else {
            if first.plan_hash() != second.plan_hash() {
                say!("the plans differ: {} and {}", first.plan_hash(), second.plan_hash());
            }
            for frame in found.different.iter().take(MOST) {
                say!("frame {}", frame.id);
                frame.values.iter().for_each(|value| say!("  {value}"));
                frame.files.iter().for_each(|file| say!("  {file}"));
            }
            if found.different.len() > MOST {
                say!("… and {} more frames", found.different.len() - MOST);
            }
            say!(
                "{} frames are the same, {} differ, {} are only in {}, {} only in {}",
                found.same,
                found.different.len(),
                found.only_first.len(),
                self.first.display(),
                found.only_second.len(),
                self.second.display()
            );
        }
        Ok(if found.is_same() { Code::Done } else { Code::Different })
    }
}
