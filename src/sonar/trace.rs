//! One ping: what is visible, and the energy that it sends back.

use super::beams::Beams;
use super::deposit::{Cells, PlaneView, Surface};
use super::visibility::{Planes, Segment, Visibility};
use super::{BodyEcho, Echoes, Sonar};
use crate::math::Pose;
use crate::scene::Scene;

/// Whether a trace also keeps energy-weighted means of elevation, incidence and material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Energy alone.
    Energy,
    /// Energy and [`super::echoes::Detail`].
    Detail,
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
    Tracer::new(sonar).trace(scene, world_from_sonar, Keep::Energy)
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
        let Visibility { planes, depth, .. } = &self.visibility;
        let mut cells = Cells::new(self.sonar.grid(), keep == Keep::Detail);
        let surface_of = |segment: &Segment| {
            let instance = &scene.instances[usize::from(segment.instance)];
            let material = instance.materials[usize::from(segment.material)];
            let mu = scene.materials[usize::from(material)].lambert_mu as f32;
            Surface { body: instance.body, material, mu }
        };
        let samples = planes.samples();
        for number in 0..planes.count() {
            let row = number * samples..(number + 1) * samples;
            let plane = PlaneView {
                number,
                planes,
                beams: &self.beams,
                nearest: &depth.nearest[row.clone()],
                segment: &depth.segment[row],
                segments: &depth.segments,
            };
            cells.add_plane(&plane, surface_of);
        }
        let detail = cells.detail.take().map(|sums| sums.means(&cells.energy));
        Echoes { grid: self.sonar.grid(), bodies: merged(cells.bodies), energy: cells.energy, detail }
    }
}

/// Sorts by cell and body and adds up what belongs together. The sort is stable, so sums keep their order.
fn merged(mut echoes: Vec<BodyEcho>) -> Vec<BodyEcho> {
    echoes.sort_by_key(|echo| (echo.cell, echo.body));
    echoes.dedup_by(|later, kept| {
        let same = (later.cell, later.body) == (kept.cell, kept.body);
        if same {
            kept.energy += later.energy;
        }
        same
    });
    echoes
}
