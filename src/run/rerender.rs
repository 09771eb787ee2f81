//! Frames of a dataset rendered once more, and held against what is there.

use rayon::prelude::*;
use serde::Serialize;

use super::files;
use super::render::Renderer;
use super::{Project, Worlds};
use crate::store::{Dataset, StoreError, digest};

/// A frame that came out otherwise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Otherwise {
    /// The frame.
    pub id: u64,
    /// Its files whose bytes differ, or why it could not be rendered.
    pub what: Vec<String>,
}

/// Renders frames again and compares their files' hashes with those in the journals; a frame that is not in the dataset
/// is left out.
///
/// # Errors
/// [`StoreError`] if a journal cannot be read.
pub fn rerender(project: &Project, dataset: &Dataset, ids: &[u64]) -> Result<Vec<Otherwise>, StoreError> {
    let mut there = Vec::new();
    for record in dataset.records() {
        let record = record?;
        if ids.contains(&record.id) {
            there.push(record);
        }
    }
    let known: Vec<u64> = there.iter().map(|record| record.id).collect();
    let worlds = Worlds::new(&project.plan, &project.assets, &known);
    let one = |record: &crate::store::FrameRecord| {
        let job = &project.plan.jobs[record.id as usize];
        let world = match worlds.get(job) {
            Ok(world) => world,
            Err(reason) => return Some(Otherwise { id: record.id, what: vec![reason] }),
        };
        let frame = match Renderer::default().render(&project.plan.header, job, &world) {
            Ok(frame) => frame,
            Err(error) => return Some(Otherwise { id: record.id, what: vec![error.to_string()] }),
        };
        let (_, made) = files::of_frame(&project.plan, job, &world, frame);
        worlds.done(job);
        let is_same = |path: &str, bytes: &[u8]| record.file(path).is_some_and(|file| file.sha256 == digest(bytes));
        let what: Vec<String> =
            made.iter().filter(|file| !is_same(&file.path, &file.bytes)).map(|file| file.path.clone()).collect();
        (!what.is_empty()).then_some(Otherwise { id: record.id, what })
    };
    Ok(there.par_iter().filter_map(one).collect())
}
