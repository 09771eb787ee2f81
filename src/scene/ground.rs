//! The ground: what objects rest on and altitudes are measured from.

use std::sync::Arc;

use glam::DVec3;

use super::environment::Environment;
use super::seabed::HeightGrid;

/// Half the width over which a slope is taken, metres.
const SLOPE_REACH_M: f64 = 0.05;

/// The highest of seabed and environment; the plane z = 0 where there is neither.
#[derive(Clone, Debug, Default)]
pub struct Ground {
    /// The seabed of the scene.
    pub seabed: Option<Arc<HeightGrid>>,
    /// Its environment, every surface of it.
    pub environment: Option<Arc<Environment>>,
}

impl Ground {
    /// Height at a point of the world, metres.
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        let seabed = self.seabed.as_ref().map(|grid| grid.height(x, y));
        let environment = self.environment.as_ref().and_then(|world| world.bvh().highest(x, y));
        match (seabed, environment) {
            (Some(a), Some(b)) => a.max(b),
            (Some(height), None) | (None, Some(height)) => height,
            (None, None) => 0.0,
        }
    }

    /// Height of the bottom that nothing at a point may be below, metres: the seabed, however much is built over it; without
    /// one the surface of the environment under the point, or the highest where there is none under it.
    #[must_use]
    pub fn floor(&self, point: DVec3) -> f64 {
        if let Some(grid) = &self.seabed {
            return grid.height(point.x, point.y);
        }
        let highest = self.height(point.x, point.y);
        let below = |world: &Arc<Environment>| world.bvh().below(point);
        if point.z >= highest { highest } else { self.environment.as_ref().and_then(below).unwrap_or(highest) }
    }

    /// Upward normal at a point of the world, from the slope over ten centimetres.
    #[must_use]
    pub fn normal(&self, x: f64, y: f64) -> DVec3 {
        let r = SLOPE_REACH_M;
        let along = (self.height(x + r, y) - self.height(x - r, y)) / (2.0 * r);
        let across = (self.height(x, y + r) - self.height(x, y - r)) / (2.0 * r);
        DVec3::new(-along, -across, 1.0).normalize()
    }

    /// Whether there is something to stand on; everywhere if the scene has neither seabed nor environment.
    #[must_use]
    pub fn is_there(&self, x: f64, y: f64) -> bool {
        let on_seabed = self.seabed.as_ref().map(|grid| x.abs().max(y.abs()) <= 0.5 * grid.extent());
        let on_world = self.environment.as_ref().map(|world| world.bvh().highest(x, y).is_some());
        match (on_seabed, on_world) {
            (None, None) => true,
            (a, b) => a.unwrap_or(false) || b.unwrap_or(false),
        }
    }
}
