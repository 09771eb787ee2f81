//! Pictures for people: contact sheets of frames with their labels drawn over them.
//!
//! Knows nothing of how frames are made and writes no files.

mod canvas;
pub mod contact;
pub mod portrait;

pub use contact::{GreyImage, SheetFrame, contact_sheet};
