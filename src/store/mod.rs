//! A dataset folder: its layout, whole files only, a journal of finished frames, hashes and the manifest.
//!
//! A frame's files are written under temporary names, synced and renamed; then one line in the journal says that the
//! frame is finished. Whatever a killed run leaves behind, opening the folder again finds the frames that are whole, and
//! the others are rendered again. Where many small files are not wanted, frames lie in tar files instead, with the same
//! records and hashes (`pack`). No date, host or absolute path is ever written.
//!
//! Knows nothing of recipes, scenes or how frames are made, and of annotation formats only what a frame's record holds.

mod atomic;
mod claim;
mod compare;
mod damage;
mod dataset;
mod difference;
mod error;
pub mod exr;
pub mod folder;
mod index;
mod journal;
pub mod layout;
mod line;
mod manifest;
mod pack;
pub mod png;
mod record;
#[cfg(test)]
pub(crate) mod sample;
mod seal;
mod shard;
mod status;
mod verify;

pub(crate) use atomic::sha256 as digest;
pub use compare::{Comparison, FrameDifference, compare};
pub use dataset::{Dataset, Place};
pub use error::StoreError;
pub use folder::{Identity, NewFile, Store};
pub use index::Records;
pub use manifest::{Counts, IncludeLock, ObjectCounts};
pub use pack::Pack;
pub use record::{AnnotationRecord, Fate, FileRecord, FrameRecord, Misplaced, ViewRecord};
pub(crate) use seal::Sealing;
pub use seal::Summary;
pub use shard::{Shard, ShardError};
pub use status::Status;
pub use verify::{Verification, verify};

/// Version of this program, which a dataset names.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");
