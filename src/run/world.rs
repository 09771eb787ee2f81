//! A built scene with what trajectories ask of it, kept for as long as frames of it are to come.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::DVec3;

use crate::math::Pose;
use crate::math::real::radians;
use crate::math::rng::Stream;
use crate::plan::{Header, Job, Plan};
use crate::scene::bvh::Bvh;
use crate::scene::{AssetCache, Built, Scene, SceneError, View, build_in_view};
use crate::vehicle::{FrameOfRun, Surroundings, Target};

/// A scene ready to be looked at.
pub struct World {
    built: Built,
    seed: u64,
    targets: Vec<Target>,
    /// Of everything but the seabed, whose grid knows its own lines of sight. Built on the first question about one.
    sight: OnceLock<Bvh>,
}

impl World {
    /// Builds a scene of a plan, by its number there; its frames' views decide where objects with `in_view` stand.
    ///
    /// # Errors
    /// See [`SceneError`].
    pub fn build(plan: &Plan, number: usize, assets: &AssetCache) -> Result<Self, SceneError> {
        let scene = &plan.scenes[number];
        let views = |built: &Built| {
            let world = Self::of(built.clone(), scene.seed);
            plan.jobs_of(number).iter().map(|job| world.view(&plan.header, job)).collect()
        };
        let built = build_in_view(&scene.spec, assets, scene.seed, scene.index, &views)?;
        Ok(Self::of(built, scene.seed))
    }

    fn of(built: Built, seed: u64) -> Self {
        let bodies = &built.scene.bodies;
        let targets = bodies.iter().map(|body| Target { centre: body.centre, radius_m: body.radius }).collect();
        Self { built, seed, targets, sight: OnceLock::new() }
    }

    /// What a job's sonar insonifies.
    fn view(&self, header: &Header, job: &Job) -> View {
        let sonar = &job.sonar;
        View {
            world_from_sonar: self.sonar_pose(header, job),
            range_m: sonar.range_m,
            half_azimuth: radians(0.5 * sonar.azimuth_deg),
            half_elevation: radians(0.5 * sonar.elevation_deg),
        }
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

    /// world_from_sonar of a job.
    #[must_use]
    pub fn sonar_pose(&self, header: &Header, job: &Job) -> Pose {
        let mount = job.sonar.mount.pose();
        let around = Surroundings {
            ground: &|x, y| self.built.ground.height(x, y),
            targets: &self.targets,
            clear: &|from: DVec3, to: DVec3| self.is_clear(from, to),
            mount: &mount,
        };
        let frame = FrameOfRun { index: job.frame, count: header.frames };
        let mut stream = Stream::at(self.seed, "frame", header.number_in_variant(job.scene, job.frame), "trajectory");
        job.trajectory.pose(frame, &around, &mut stream).then_inner(&mount)
    }

    /// Whether nothing stands between two points.
    fn is_clear(&self, from: DVec3, to: DVec3) -> bool {
        let Built { scene, ground, .. } = &self.built;
        // The seabed comes first among the instances.
        let beside = || scene.instances.iter().skip(usize::from(ground.seabed.is_some()));
        let sight = || Bvh::of(beside().map(|instance| (&*instance.mesh, instance.world_from_mesh)));
        ground.seabed.as_ref().is_none_or(|grid| grid.is_clear(from, to))
            && self.sight.get_or_init(sight).is_clear(from, to)
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
        let build = || World::build(self.plan, world, self.assets).map(Arc::new).map_err(|error| error.to_string());
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
