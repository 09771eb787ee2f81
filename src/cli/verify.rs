//! `ensonify verify`: every file of a dataset against its hash.

use std::path::PathBuf;

use clap::Args;

use super::Code;
use crate::store::verify;

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
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

impl Verify {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let found = verify(&self.dataset)?;
        let is_same = found.changed.is_empty() && found.missing.is_empty() && found.extra.is_empty();
        if self.json {
            say!("{}", serde_json::to_string_pretty(&found)?);
        } else {
            let lists = [("changed", &found.changed), ("missing", &found.missing), ("extra", &found.extra)];
            for (what, paths) in lists {
                paths.iter().take(MOST).for_each(|path| say!("{what}  {path}"));
                if paths.len() > MOST {
                    say!("{what}  … and {} more", paths.len() - MOST);
                }
            }
            let verdict = if is_same { "all as they should be" } else { "not all as they should be" };
            say!("{} files checked, {verdict}", found.checked);
            if !is_same {
                eprintln!(
                    "{} frames are damaged; the same `ensonify run` mends frames and derived files",
                    found.frames.len()
                );
            }
        }
        Ok(if is_same { Code::Done } else { Code::Different })
    }
}
