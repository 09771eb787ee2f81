//! One ping: what is visible, and the energy that it sends back.

use super::beams::Beams;
use super::cells::Cells;
use super::deposit::Ping;
use super::ghosts::Reflection;
use super::surface::Surfaces;
use super::visibility::{Planes, Visibility};
use super::{Echoes, RayRange, Sonar};
use crate::math::Pose;
use crate::scene::Scene;

/// What a trace keeps beside energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Keep {
    /// Means of elevation, incidence and material: [`super::echoes::Detail`].
    pub detail: bool,
    /// Counts of rays, sorted by this range: [`super::echoes::Rays`].
    pub rays: Option<RayRange>,
}

impl Keep {
    /// Energy alone.
    pub const ENERGY: Self = Self { detail: false, rays: None };
}

/// A sonar made ready: its tables, and buffers used again from ping to ping. One a thread.
#[derive(Clone, Debug)]
pub struct Tracer {
    sonar: Sonar,
    beams: Beams,
    /// The scan converter, open to benchmarks and to tests against other ways of finding what is visible.
    pub visibility: Visibility,
}

/// Traces one ping. For many pings of one sonar, keep a [`Tracer`].
#[must_use]
pub fn trace(scene: &Scene, sonar: &Sonar, world_from_sonar: &Pose) -> Echoes {
    Tracer::new(sonar).trace(scene, world_from_sonar, Keep::ENERGY)
}

impl Tracer {
    /// Prepares `sonar`, whose figures [`Sonar::validate`] has accepted.
    #[must_use]
    pub fn new(sonar: &Sonar) -> Self {
        let planes = Planes::new(sonar);
        let beams = Beams::new(sonar, &planes);
        Self { sonar: sonar.clone(), beams, visibility: Visibility::new(planes) }
    }

    /// The sonar that this was made for.
    #[must_use]
    pub fn sonar(&self) -> &Sonar {
        &self.sonar
    }

    /// Traces one ping of `scene` from `world_from_sonar`.
    pub fn trace(&mut self, scene: &Scene, world_from_sonar: &Pose, keep: Keep) -> Echoes {
        self.visibility.scan(scene, world_from_sonar);
        let mut cells = Cells::new(self.sonar.grid(), keep, self.sonar.turn_beams_per_m());
        let surfaces = Surfaces::new(scene);
        let ping = Ping {
            planes: &self.visibility.planes,
            beams: &self.beams,
            depth: &self.visibility.depth,
            scene,
            surfaces: &surfaces,
            world_from_sonar,
        };
        ping.deposit(&mut cells);
        for &mirror in &scene.mirrors {
            let Self { sonar, beams, visibility } = self;
            let reflection = Reflection { sonar, beams, scene, surfaces: &surfaces, world_from_sonar, mirror };
            reflection.deposit(visibility, &mut cells);
        }
        cells.echoes()
    }
}
