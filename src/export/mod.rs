//! Other shapes of a dataset, made from its records in job order and never from completion order.
//!
//! Knows nothing of how frames are made: a new format needs no re-render.

mod card;
pub mod coco;
pub mod finish;
mod frames;

pub use finish::{Attribution, Extent, FinishError, FinishInput, finish};
