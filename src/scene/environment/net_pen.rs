//! A fish pen: a net of thin bars under a floating collar, a ring that weighs it down, moorings.

use std::f64::consts::TAU;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::EnvironmentError;
use super::kinds::within;
use super::solid::Solid;
use super::structure::Structure;
use crate::math::real::{cos, sin};
use crate::math::rng::Stream;

/// Most bars of a net.
const MAX_BARS: f64 = 40_000.0;

/// A round pen about the z axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetPen {
    /// Across, metres.
    pub diameter_m: f64,
    /// Water surface above z = 0, metres.
    pub surface_m: f64,
    /// From the surface down to the foot of the net's wall, metres.
    pub depth_m: f64,
    /// From twine to twine, metres. Real nets are finer than a sonar resolves: this is what is drawn of them.
    pub mesh_m: f64,
    /// Thickness of a twine, metres.
    pub twine_m: f64,
    /// How far the current pushes the foot of the net to positive x, metres.
    pub sway_m: f64,
    /// Mooring lines, 0 to 32.
    pub moorings: u32,
}

impl NetPen {
    pub(super) const PARTS: &'static [&'static str] = &["collar", "mooring", "mooring-block", "net", "sinker-ring"];

    pub(super) fn check(&self) -> Result<(), EnvironmentError> {
        within("diameter_m", self.diameter_m, [1.0, 100.0])?;
        within("surface_m", self.surface_m, [1.0, 200.0])?;
        within("depth_m", self.depth_m, [0.5, self.surface_m])?;
        within("twine_m", self.twine_m, [0.001, 0.2])?;
        within("sway_m", self.sway_m, [0.0, 20.0])?;
        within("moorings", self.moorings.into(), [0.0, 32.0])?;
        within("mesh_m", self.mesh_m, [2.0 * self.twine_m, 5.0])?;
        let (around, down) = self.meshes();
        let bars = 2.0 * f64::from(around) * f64::from(down);
        if bars > MAX_BARS { Err(EnvironmentError::TooManyBars { bars, mesh_m: self.mesh_m }) } else { Ok(()) }
    }

    pub(super) fn raise(&self, structure: &mut Structure, stream: &mut Stream) {
        let net = Net { pen: self, phase: stream.uniform(0.0, TAU) };
        let (around, down) = self.meshes();
        let bar = |from: DVec3, to: DVec3| Solid::bar(from, to, [self.twine_m, self.twine_m]);
        let (mut wall, mut floor) = (Vec::new(), Vec::new());
        for (i, j) in (0..around).flat_map(|i| (0..down).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| net.wall(f64::from(i) / f64::from(around), f64::from(j) / f64::from(down));
            wall.extend([bar(at(i, j), at(i, j + 1)), bar(at(i, j + 1), at(i + 1, j + 1))]);
        }
        // The floor hangs as a shallow cone, every third twine running to its middle.
        let rings = (0.5 * self.diameter_m / (3.0 * self.mesh_m)).ceil().max(2.0) as u32;
        let spokes = around.div_ceil(3);
        for (i, j) in (0..spokes).flat_map(|i| (1..rings).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| net.floor(f64::from(i) / f64::from(spokes), f64::from(j) / f64::from(rings));
            floor.extend([bar(at(i, j), at(i, j + 1)), bar(at(i, j), at(i + 1, j))]);
        }
        wall.extend(floor);
        structure.part("net", "rope", &wall);
        let top = DVec3::Z * self.surface_m;
        let collar = [0.0, 0.7].map(|out| Solid::hoop(top, 0.5 * self.diameter_m + 0.3 + out, 0.4, [96, 12]));
        structure.part("collar", "plastic", &collar);
        let foot = DVec3::new(self.sway_m, 0.0, self.surface_m - self.depth_m);
        structure.part("sinker-ring", "steel", &[Solid::hoop(foot, 0.5 * self.diameter_m, 0.25, [96, 12])]);
        for mooring in 0..self.moorings {
            self.mooring(TAU * f64::from(mooring) / f64::from(self.moorings), structure);
        }
    }

    /// A rope from the collar to a block of concrete on the ground.
    fn mooring(&self, angle: f64, structure: &mut Structure) {
        let out = DVec3::new(cos(angle), sin(angle), 0.0);
        let radius = 0.5 * self.diameter_m;
        let place = out * (radius + 1.5 * self.surface_m);
        let block = place.with_z((structure.site.ground)(place.x, place.y));
        let head = out * (radius + 1.0) + DVec3::Z * self.surface_m;
        structure.part("mooring", "rope", &[Solid::rod(head, block + DVec3::Z * 0.8, 0.03, 8)]);
        let half = DVec3::new(0.9, 0.9, 0.0);
        let sunk = Solid::block(block - half - DVec3::Z * 0.4, block + half + DVec3::Z * 0.9);
        structure.part("mooring-block", "concrete", &[sunk]);
    }

    /// Meshes around the wall and down it.
    fn meshes(&self) -> (u32, u32) {
        let around = (std::f64::consts::PI * self.diameter_m / self.mesh_m).ceil().max(8.0);
        (around as u32, (self.depth_m / self.mesh_m).ceil().max(1.0) as u32)
    }
}

/// Where the net hangs: bellied by the current, more so lower down.
struct Net<'a> {
    pen: &'a NetPen,
    phase: f64,
}

impl Net<'_> {
    /// A point of the wall, `around` and `down` from 0 to 1.
    fn wall(&self, around: f64, down: f64) -> DVec3 {
        let NetPen { diameter_m, surface_m, depth_m, sway_m, .. } = *self.pen;
        let angle = TAU * around;
        // Lobes between the points where the net is tied to collar and ring.
        let slack = 0.02 * diameter_m * 4.0 * down * (1.0 - down) * cos(7.0 * angle + self.phase);
        let radius = 0.5 * diameter_m + slack;
        DVec3::new(radius * cos(angle) + sway_m * down * down, radius * sin(angle), surface_m - depth_m * down)
    }

    /// A point of the floor, `inwards` from 0 in the middle to 1 at the wall.
    fn floor(&self, around: f64, inwards: f64) -> DVec3 {
        let rim = self.wall(around, 1.0);
        let middle = DVec3::new(self.pen.sway_m, 0.0, rim.z - 0.1 * self.pen.diameter_m.min(self.pen.depth_m));
        middle + (rim - middle) * inwards
    }
}
