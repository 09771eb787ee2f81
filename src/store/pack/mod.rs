//! Frames' files packed into tar files, for file systems that dislike many small files.
//!
//! A frame's files and its record make one *block*: a run of tar members with fixed times, owners and modes, the same bytes
//! whenever the frame is rendered. A shard's tar number `k` holds the blocks of the shard's jobs `k·N … (k+1)·N`, sorted by
//! frame, and nothing else, so its bytes follow from the plan and the shards alone.
//!
//! Frames are finished in any order. A block is appended to a *part* beside its tar (`….tar.0.part`, no tar itself) and
//! synced; then the journal's line of the frame tells part, offset, length and hash. When all frames of a tar are there, it
//! is assembled: part, and blocks of an earlier tar, are copied in order under a temporary name, synced, renamed, and the
//! part is deleted. So a killed run loses no journalled frame and leaves one part for each tar that it was at work on.
//! A frame that is rendered again goes the same way: into a new part, then into the tar. A bit is written twice for this.
//!
//! Where a block lies is looked up: in the part that the journal names as long as that is there, else in the tar, whose
//! headers are read on opening. Assembling needs no entry in the journal, and may be done again, by whoever holds the lock
//! of the shard.
//!
//! Paths in records, annotations and tables are those of loose files, `images/polar/000123.png`, and the dataset hash is
//! over these; [`layout::member`](super::layout::member) tells their names in the tar files.

mod block;
mod packer;
mod settle;
mod shelf;

use serde::{Deserialize, Serialize};

pub(crate) use block::{Block, damaged_members, member_names, members};
pub(crate) use packer::Packer;
pub(crate) use settle::{Frames, assemble, settle, sift, untidy};
pub(crate) use shelf::{Shelf, Spot};

/// How the frames of a dataset are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pack {
    /// Frames of a shard in each of its tar files.
    pub tar_frames: u64,
}

#[cfg(test)]
mod tests;
