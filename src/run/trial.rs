//! A few frames rendered for their time and size, nothing written.

use std::time::{Duration, Instant};

use super::render::Renderer;
use super::{Project, World, files, spread};
use crate::scene::SceneError;

/// Frames that are rendered, at most.
const MOST_FRAMES: u64 = 3;
/// No frame but the first is begun later than this.
const LONGEST: Duration = Duration::from_millis(500);

/// What frames of a plan take.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Frames that were rendered, spread over the plan.
    pub frames: u64,
    /// Seconds a frame, on one thread.
    pub frame_s: f64,
    /// Bytes a frame: pictures, masks, raw values, and its lines in journal and annotations.
    pub frame_bytes: f64,
}

/// Renders frames spread over the plan.
///
/// # Errors
/// A scene that cannot be built.
pub fn trial(project: &Project) -> Result<Trial, SceneError> {
    let plan = &project.plan;
    let begun = Instant::now();
    let mut renderer = Renderer::default();
    let (mut seconds, mut bytes) = (Vec::new(), 0.0);
    for id in spread(plan.jobs.len() as u64, MOST_FRAMES) {
        if !seconds.is_empty() && begun.elapsed() > LONGEST {
            break;
        }
        let job = &plan.jobs[id as usize];
        let world = World::build(plan.scene_of(job), &project.assets)?;
        let started = Instant::now();
        let frame = renderer.render(&plan.header, job, &world)?;
        let (record, new_files) = files::of_frame(plan, job, &world, frame);
        seconds.push(started.elapsed().as_secs_f64());
        // A frame's record stands in the journal, most of it once more in the annotations.
        let line = serde_json::to_vec(&record).map_or(0, |line| line.len());
        bytes += new_files.iter().map(|file| file.bytes.len()).sum::<usize>() as f64 + 2.0 * line as f64;
    }
    let frames = seconds.len().max(1);
    // The first frame of a thread makes tables that serve the others.
    let usual = if seconds.len() > 1 { &seconds[1..] } else { &seconds[..] };
    let frame_s = usual.iter().sum::<f64>() / usual.len().max(1) as f64;
    Ok(Trial { frames: frames as u64, frame_s, frame_bytes: bytes / frames as f64 })
}
