//! A built scene with what trajectories ask of it, kept for as long as frames of it are to come.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::DVec3;

use crate::math::Pose;
use crate::math::rng::Stream;
use crate::plan::{Header, Job, Plan, ScenePlan};
use crate::scene::bvh::Bvh;
use crate::scene::{AssetCache, Built, Scene, SceneError, Tracks, build};
use crate::vehicle::{FrameOfRun, Station, Surroundings, Target, TrackError, Voyage};

/// A scene ready to be looked at.
pub struct World {
    built: Built,
    seed: u64,
    targets: Vec<Target>,
    /// Of everything but the seabed, whose grid knows its own lines of sight. Built on the first question about one.
    sight: OnceLock<Bvh>,
    tracks: Tracks,
}

impl World {
    /// Builds a scene as a plan has it.
    ///
    /// # Errors
    /// See [`SceneError`].
    pub fn build(scene: &ScenePlan, assets: &AssetCache) -> Result<Self, SceneError> {
        let seed = scene.seed;
        let built = build(&scene.spec, assets, seed, scene.index)?;
        let bodies = &built.scene.bodies;
        let targets = bodies.iter().map(|body| Target { centre: body.centre, radius_m: body.radius }).collect();
        Ok(Self { built, seed, targets, sight: OnceLock::new(), tracks: assets.tracks().clone() })
    }

    /// The geometry.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.built.scene
    }

    /// The scene with what could not be placed.
    #[must_use]
    pub fn built(&self) -> &Built {
        &self.built
    }

    /// Seed of its draws and of its frames'.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Where the vehicle of a job is, and when.
    ///
    /// # Errors
    /// If the job's poses are in a file that cannot be read.
    pub fn station(&self, header: &Header, job: &Job) -> Result<Station, TrackError> {
        let track = job.trajectory.file().map(|file| self.tracks.get(file)).transpose()?;
        let voyage = Voyage {
            frame: FrameOfRun { index: job.frame, count: header.frames },
            vehicle: &job.vehicle,
            mount: &job.sonar.mount.pose(),
            around: self,
            scene_stream: &|purpose| Stream::at(self.seed, "scene", job.scene, purpose),
            track: track.as_deref(),
        };
        let mut stream = Stream::at(self.seed, "frame", header.number_in_variant(job.scene, job.frame), "trajectory");
        Ok(job.trajectory.station(&voyage, &mut stream))
    }

    /// world_from_sonar of a job.
    ///
    /// # Errors
    /// As [`World::station`].
    pub fn sonar_pose(&self, header: &Header, job: &Job) -> Result<Pose, TrackError> {
        Ok(self.station(header, job)?.pose.then_inner(&job.sonar.mount.pose()))
    }

    /// Everything but the seabed.
    fn things(&self) -> &Bvh {
        let Built { scene, ground, .. } = &self.built;
        // The seabed comes first among the instances.
        let beside = scene.instances.iter().skip(usize::from(ground.seabed.is_some()));
        self.sight.get_or_init(|| Bvh::of(beside.map(|instance| (&*instance.mesh, instance.world_from_mesh))))
    }
}

impl Surroundings for World {
    fn ground(&self, x: f64, y: f64) -> f64 {
        self.built.ground.height(x, y)
    }

    fn targets(&self) -> &[Target] {
        &self.targets
    }

    fn sees(&self, from: DVec3, to: DVec3) -> bool {
        let seabed = &self.built.ground.seabed;
        seabed.as_ref().is_none_or(|grid| grid.is_clear(from, to)) && self.things().is_clear(from, to)
    }

    fn floor(&self, point: DVec3) -> f64 {
        self.built.ground.floor(point)
    }

    fn gap(&self, point: DVec3, within: f64) -> f64 {
        self.things().gap(point, within)
    }
}

/// Worlds by their place in the plan: built once, by whoever comes first, and let go after the last frame.
pub struct Worlds<'a> {
    plan: &'a Plan,
    assets: &'a AssetCache,
    held: Mutex<BTreeMap<usize, Held>>,
}

type Slot = Arc<OnceLock<Result<Arc<World>, String>>>;

struct Held {
    slot: Slot,
    frames_left: u64,
}

impl<'a> Worlds<'a> {
    /// Worlds for these jobs of a plan.
    #[must_use]
    pub fn new(plan: &'a Plan, assets: &'a AssetCache, jobs: &[u64]) -> Self {
        let mut held: BTreeMap<usize, Held> = BTreeMap::new();
        for &id in jobs {
            let world = plan.world_of(&plan.jobs[id as usize]);
            held.entry(world).or_insert_with(|| Held { slot: Slot::default(), frames_left: 0 }).frames_left += 1;
        }
        Self { plan, assets, held: Mutex::new(held) }
    }

    /// The world of a job; waits where another thread is building it.
    ///
    /// # Errors
    /// Why the scene could not be built.
    pub fn get(&self, job: &Job) -> Result<Arc<World>, String> {
        let world = self.plan.world_of(job);
        let slot = {
            let held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
            held.get(&world).map(|held| held.slot.clone()).unwrap_or_default()
        };
        let build =
            || World::build(&self.plan.scenes[world], self.assets).map(Arc::new).map_err(|error| error.to_string());
        slot.get_or_init(build).clone()
    }

    /// Says that a job is done; after the last one of a world it is let go.
    pub fn done(&self, job: &Job) {
        let world = self.plan.world_of(job);
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(entry) = held.get_mut(&world) {
            entry.frames_left = entry.frames_left.saturating_sub(1);
            if entry.frames_left == 0 {
                held.remove(&world);
            }
        }
    }
}
