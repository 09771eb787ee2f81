//! The job loop: frames rendered on every thread, written as they come, finished when all are there.
//!
//! Knows order, threads, progress and how to stop; how a frame is made is [`render`]'s, how it is kept the store's.

mod files;
mod project;
pub mod render;
mod rerender;
mod survey;
mod trial;
pub mod warnings;
mod world;

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};

pub use files::finish_facts;
pub use project::{Given, GivenPlan, Project};
pub use rerender::{Otherwise, rerender};
pub use survey::{InView, Place, Sight, Survey, survey};
pub use trial::{Trial, trial};
pub use world::{World, Worlds};

use crate::export::{Extent, FinishError, finish};
use crate::store::{FrameRecord, NewFile, Shard, Store, StoreError, Summary};
use render::Renderer;

/// Threads that write: each mostly waits for the disk, and those that wait at once wait for the same turn of it.
const KEEPERS: usize = 8;

/// A frame on its way to the store.
type Rendered = (FrameRecord, Vec<NewFile>);

/// How a run goes about its jobs.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Threads that render.
    pub threads: usize,
    /// Render at most so many frames now.
    pub limit: Option<u64>,
    /// Stop when so many frames could not be rendered; none: never.
    pub most_failures: Option<u64>,
}

/// What a run tells while it goes.
pub trait Watch: Sync {
    /// `total` frames are in the plan, `there` of them from an earlier start, `now` are to be rendered.
    fn begin(&self, total: u64, there: u64, now: u64);
    /// One more frame is written.
    fn frame_done(&self);
    /// A frame cannot be rendered.
    fn frame_failed(&self, id: u64, reason: &str);
    /// Something that a person should know.
    fn note(&self, message: &str);
}

/// How a run ended.
#[derive(Clone, Debug)]
pub enum Ended {
    /// Every frame is there and the dataset is finished.
    Complete(Summary),
    /// Every frame of the shard is there; so many of other shards are not, and finishing is left to who comes last.
    Shard(u64),
    /// It stopped at its limit; so many frames are still missing.
    Limited(u64),
    /// It was asked to stop; so many frames are still missing.
    Interrupted(u64),
    /// Some frames cannot be rendered, each with the reason. The rest is there, unless it was stopped by them.
    Failed(Vec<(u64, String)>),
}

/// A run that could not go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The folder cannot be used or written.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The dataset cannot be finished.
    #[error(transparent)]
    Finish(#[from] FinishError),
    /// The threads cannot be started.
    #[error("cannot start {threads} threads: {reason}; use a smaller --jobs")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// The system's reason.
        reason: String,
    },
}

/// Renders what is missing of a project into its store and, when nothing is, finishes the dataset.
///
/// # Errors
/// [`RunError`] if the store cannot be written; the frames that are there stay.
pub fn run(
    project: &Project,
    store: &Store,
    options: Options,
    watch: &dyn Watch,
    stop: &AtomicBool,
) -> Result<Ended, RunError> {
    let plan = &project.plan;
    let missing = store.missing();
    let Range { start, end } = store.jobs();
    let total = end - start;
    let now = options.limit.map_or(missing.len(), |limit| missing.len().min(limit as usize));
    watch.begin(total, total - missing.len() as u64, now as u64);

    let shift = Shift {
        project,
        store,
        watch,
        stop,
        jobs: &missing[..now],
        worlds: Worlds::new(plan, &project.assets, &missing[..now]),
        next: AtomicUsize::new(0),
        most_failures: options.most_failures.unwrap_or(u64::MAX),
        failed: Mutex::default(),
        broken: Mutex::default(),
    };
    let threads = options.threads.clamp(1, now.max(1));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| RunError::Threads { threads, reason: error.to_string() })?;
    let (hand_over, finished) = sync_channel(threads);
    let finished = Mutex::new(finished);
    std::thread::scope(|scope| {
        for _ in 0..KEEPERS {
            scope.spawn(|| shift.keep(&finished));
        }
        pool.broadcast(|_| shift.work(&hand_over));
        drop(hand_over);
    });

    if let Some(error) = shift.broken.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(error.into());
    }
    let left = store.missing().len() as u64;
    if left == 0 || !stop.load(Ordering::Relaxed) {
        store.pack()?;
    }
    let mut failed = shift.failed.into_inner().unwrap_or_else(PoisonError::into_inner);
    if !failed.is_empty() {
        failed.sort();
        return Ok(Ended::Failed(failed));
    }
    let dataset = store.dataset();
    match (left, dataset.planned() - dataset.done()) {
        (0, 0) if store.shard() == Shard::WHOLE => {
            Ok(Ended::Complete(finish(&dataset, &files::finish_input(project), Extent::Whole)?))
        }
        (0, elsewhere) => Ok(Ended::Shard(elsewhere)),
        (left, _) if stop.load(Ordering::Relaxed) => Ok(Ended::Interrupted(left)),
        (left, _) => Ok(Ended::Limited(left)),
    }
}

/// `wanted` of `total` numbers from 0, evenly spread, each once.
#[must_use]
pub fn spread(total: u64, wanted: u64) -> Vec<u64> {
    let count = wanted.min(total);
    (0..count).map(|i| (2 * i + 1) * total / (2 * count)).collect()
}

/// What the threads of a run share.
struct Shift<'a> {
    project: &'a Project,
    store: &'a Store,
    watch: &'a dyn Watch,
    stop: &'a AtomicBool,
    /// Ids to render; threads take them in order, so scenes are finished one after the other.
    jobs: &'a [u64],
    worlds: Worlds<'a>,
    next: AtomicUsize,
    most_failures: u64,
    failed: Mutex<Vec<(u64, String)>>,
    broken: Mutex<Option<StoreError>>,
}

impl Shift<'_> {
    /// Renders frame after frame and hands them over.
    fn work(&self, hand_over: &SyncSender<Rendered>) {
        let mut renderer = Renderer::default();
        while !self.is_over() {
            let Some(&id) = self.jobs.get(self.next.fetch_add(1, Ordering::Relaxed)) else { return };
            // A panic is a bug, but of one frame: the others must not be lost with it.
            let outcome = catch_unwind(AssertUnwindSafe(|| self.frame(&mut renderer, id)));
            match outcome {
                // The keepers are there as long as a thread renders.
                Ok(Ok(rendered)) => drop(hand_over.send(rendered)),
                Ok(Err(reason)) => self.fail(id, reason),
                Err(_) => {
                    renderer = Renderer::default();
                    self.fail(id, "it made the program panic, which is a bug: please report it".into());
                }
            }
            self.worlds.done(&self.project.plan.jobs[id as usize]);
        }
    }

    /// Writes frames as they come, until none comes any more.
    fn keep(&self, finished: &Mutex<Receiver<Rendered>>) {
        loop {
            let next = finished.lock().unwrap_or_else(PoisonError::into_inner).recv();
            let Ok((record, files)) = next else { return };
            match self.store.commit(record, &files) {
                Ok(()) => self.watch.frame_done(),
                Err(error) => self.breaks(error),
            }
        }
    }

    fn frame(&self, renderer: &mut Renderer, id: u64) -> Result<Rendered, String> {
        let plan = &self.project.plan;
        let job = &plan.jobs[id as usize];
        let world = self.worlds.get(job)?;
        if job.frame == 0 {
            let variant = job.variant.as_ref().map(|id| format!("{id} ")).unwrap_or_default();
            for note in world.built().notes() {
                self.watch.note(&format!("{variant}scene {}: {note}", job.scene));
            }
        }
        let frame = renderer.render(&plan.header, job, &world).map_err(|error| error.to_string())?;
        Ok(files::of_frame(plan, job, &world, frame))
    }

    fn fail(&self, id: u64, reason: String) {
        self.watch.frame_failed(id, &reason);
        if let Err(error) = self.store.fail(id, &reason) {
            self.breaks(error);
        }
        self.failed.lock().unwrap_or_else(PoisonError::into_inner).push((id, reason));
    }

    fn breaks(&self, error: StoreError) {
        self.broken.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }

    /// Whether to take no more frames.
    fn is_over(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
            || self.broken.lock().unwrap_or_else(PoisonError::into_inner).is_some()
            || self.failed.lock().unwrap_or_else(PoisonError::into_inner).len() as u64 >= self.most_failures
    }
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn frames_are_taken_evenly_and_once() {
        assert_eq!(spread(200, 4), [25, 75, 125, 175]);
        assert_eq!(spread(3, 10), [0, 1, 2]);
    }
}
