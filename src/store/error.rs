//! What can go wrong with a dataset folder.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::difference;

/// A dataset folder cannot be used, written or finished.
#[derive(Debug, Error)]
pub enum StoreError {
    /// The system refused.
    #[error(
        "cannot {doing} {}: {source}; check that the disk has room and that you may write there, or choose another folder with -o",
        path.display()
    )]
    Io {
        /// What was tried: "create", "write" ….
        doing: &'static str,
        /// On which file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// There is a file where the folder should be.
    #[error("{} is a file, not a folder; choose another folder with -o", path.display())]
    NotAFolder {
        /// The file.
        path: PathBuf,
    },
    /// The folder holds something else.
    #[error(
        "{} holds files of something else (`{found}`) and no manifest.json: it is not a dataset; choose another folder with -o",
        path.display()
    )]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// One of the things in it.
        found: String,
    },
    /// There is no dataset.
    #[error("{} is not a dataset: it has no manifest.json; name a folder that `ensonify run` wrote", path.display())]
    NoDataset {
        /// The folder.
        path: PathBuf,
    },
    /// The manifest cannot be understood.
    #[error("{}: {reason}; restore the file, or delete the folder and run again", path.display())]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The folder belongs to another plan.
    #[error(
        "{} holds frames of another plan: its plan hash is {there}, this recipe's is {ours}{difference}; choose another folder with -o, or delete this one",
        path.display()
    )]
    OtherPlan {
        /// The folder.
        path: PathBuf,
        /// Plan hash in the folder.
        there: String,
        /// Plan hash of this run.
        ours: String,
        /// The first values that differ, in words; empty where that is not known.
        difference: String,
    },
    /// The folder was begun by another version, whose frames may differ.
    #[error(
        "{} was begun by ensonify {there}, this is {ours}, and versions must not mix in a dataset; go on with {there}, choose another folder with -o, or delete this one",
        path.display()
    )]
    OtherVersion {
        /// The folder.
        path: PathBuf,
        /// Version in the folder.
        there: String,
        /// This version.
        ours: String,
    },
    /// Another process writes here.
    #[error(
        "another ensonify process is writing to {} and holds {lock}; wait until it ends, take another --shard, or choose another folder with -o",
        path.display()
    )]
    Locked {
        /// The folder.
        path: PathBuf,
        /// The lock that it holds.
        lock: String,
    },
    /// A journal was written over while it was read.
    #[error("{} changed while it was read; wait until its run ends, and try again", path.display())]
    Changed {
        /// The journal.
        path: PathBuf,
    },
    /// A frame that cannot be recorded.
    #[error("frame {id} of {} cannot be recorded: {reason}", path.display())]
    Record {
        /// The folder.
        path: PathBuf,
        /// The frame.
        id: u64,
        /// Why.
        reason: String,
    },
    /// The dataset is not complete.
    #[error("{} still lacks {} ({}); run the recipe again to render them", path.display(), frames(missing.len()), list(missing))]
    Unfinished {
        /// The folder.
        path: PathBuf,
        /// Ids of the frames that are not there, in order.
        missing: Vec<u64>,
    },
}

impl StoreError {
    /// Adds what differs between the plan in the folder and ours.
    pub(crate) fn with_difference(self, plan: &Path, ours: &[u8]) -> Self {
        match self {
            Self::OtherPlan { path, there, ours: hash, .. } => {
                let text = difference::of_plans(plan, ours).map_or_else(String::new, |text| format!(" ({text})"));
                Self::OtherPlan { path, there, ours: hash, difference: text }
            }
            other => other,
        }
    }

    /// Turns the system's error into one that names what was tried on which file.
    pub(crate) fn io<'a>(doing: &'static str, path: &'a Path) -> impl FnOnce(std::io::Error) -> Self + use<'a> {
        move |source| Self::Io { doing, path: path.to_path_buf(), source }
    }
}

fn frames(count: usize) -> String {
    if count == 1 { "1 frame".to_owned() } else { format!("{count} frames") }
}

/// The first few ids.
fn list(ids: &[u64]) -> String {
    const SHOWN: usize = 8;
    let mut text = ids.iter().take(SHOWN).map(u64::to_string).collect::<Vec<_>>().join(", ");
    if ids.len() > SHOWN {
        text.push_str(", …");
    }
    text
}
