//! Whether a body is where a sonar looks.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::math::Pose;
use crate::math::real::{asin, atan2};
use crate::scene::bvh::Bvh;
use crate::scene::ground::Ground;
use crate::scene::{Body, Scene};

/// A point this far above the ground is looked at where a body's centre is sunk, metres.
const ABOVE_GROUND_M: f64 = 0.02;

/// From which frames a body must be seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InView {
    /// `all`, or numbers of frames of the scene, from 0.
    pub frames: Frames,
}

/// Frames of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Frames {
    /// A word for them.
    Named(NamedFrames),
    /// Numbers, from 0.
    Listed(Vec<u64>),
}

/// Words for frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NamedFrames {
    /// Every frame of the scene.
    All,
}

/// What a sonar insonifies in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where it is; it looks along its x.
    pub world_from_sonar: Pose,
    /// Nearest and farthest slant range, metres.
    pub range_m: [f64; 2],
    /// Half its horizontal aperture, radians.
    pub half_azimuth: f64,
    /// Half its vertical aperture, radians.
    pub half_elevation: f64,
}

impl InView {
    /// Those of all frames of a scene that count.
    pub(in crate::scene) fn of<'v>(&self, views: &'v [View]) -> Vec<&'v View> {
        match &self.frames {
            Frames::Named(NamedFrames::All) => views.iter().collect(),
            Frames::Listed(numbers) => numbers.iter().filter_map(|&number| views.get(number as usize)).collect(),
        }
    }

    /// The largest number of a frame.
    #[must_use]
    pub fn last(&self) -> Option<u64> {
        match &self.frames {
            Frames::Named(NamedFrames::All) => None,
            Frames::Listed(numbers) => numbers.iter().max().copied(),
        }
    }
}

impl View {
    /// Whether a point is in range, sector and fan.
    pub(super) fn holds(&self, point: DVec3) -> bool {
        let p = self.world_from_sonar.inverse().apply(point);
        let range = p.length();
        let bearing = atan2(p.y, p.x).abs();
        let elevation = asin((p.z / range.max(1e-9)).clamp(-1.0, 1.0)).abs();
        (self.range_m[0]..=self.range_m[1]).contains(&range)
            && bearing <= self.half_azimuth
            && elevation <= self.half_elevation
    }

    /// Whether the point of a body that is looked at is held, and no seabed is before it.
    pub(super) fn holds_over(&self, ground: &Ground, centre: DVec3) -> bool {
        let point = looked_at(ground, centre);
        let seabed = ground.seabed.as_ref();
        self.holds(point) && seabed.is_none_or(|grid| grid.is_clear(self.world_from_sonar.position, point))
    }
}

/// Whether a body of a scene is seen in all these views: held, and nothing else before its centre. `beside` are all
/// instances but the first `skipped`, the seabed.
pub(in crate::scene) fn is_seen(scene: &Scene, ground: &Ground, number: u16, views: &[&View], beside: &Bvh) -> bool {
    let skipped = u32::from(ground.seabed.is_some());
    let Some(Body { centre, .. }) = scene.bodies.get(usize::from(number) - 1) else { return false };
    let point = looked_at(ground, *centre);
    views.iter().all(|view| {
        let from = view.world_from_sonar.position;
        let way = point - from;
        let hit = beside.closest(from, way / way.length().max(1e-9), way.length());
        let own = |instance: u32| scene.instances[(instance + skipped) as usize].body == number;
        view.holds_over(ground, *centre) && hit.is_none_or(|hit| own(hit.instance))
    })
}

fn looked_at(ground: &Ground, centre: DVec3) -> DVec3 {
    centre.with_z(centre.z.max(ground.height(centre.x, centre.y) + ABOVE_GROUND_M))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_holds_its_sector() {
        let pose = Pose::from_angles(DVec3::new(0.0, 0.0, 2.0), 0.0, -0.3, 0.0);
        let view = View { world_from_sonar: pose, range_m: [1.0, 5.0], half_azimuth: 0.5, half_elevation: 0.2 };
        let ahead = |range: f64, bearing: f64, elevation: f64| {
            pose.apply(Pose::from_angles(DVec3::ZERO, bearing, elevation, 0.0).rotation.x_axis * range)
        };
        assert!(view.holds(ahead(3.0, 0.4, 0.1)) && view.holds(ahead(4.9, -0.4, -0.15)));
        assert!(!view.holds(ahead(5.1, 0.0, 0.0)) && !view.holds(ahead(0.9, 0.0, 0.0)));
        assert!(!view.holds(ahead(3.0, 0.6, 0.0)) && !view.holds(ahead(3.0, 0.0, 0.25)));
    }
}
