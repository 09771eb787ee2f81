//! A body and the ground: the slope under it, where it touches, how deep it is sunk.

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::shape::Shape;
use crate::scene::ground::Ground;

/// Samples along each side of a footprint for the plane under it.
const PLANE_SAMPLES: i32 = 9;

/// The plane that fits the ground under a body best.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    pub middle: DVec3,
    /// Upwards, of length 1.
    pub normal: DVec3,
}

impl Plane {
    /// Under a rectangle in plan: its middle, the direction of its first side, half of each side.
    fn under(ground: &Ground, middle: DVec2, axis: DVec2, half: DVec2) -> Self {
        let share = |k: i32| f64::from(2 * k) / f64::from(PLANE_SAMPLES - 1) - 1.0;
        let (mut slope, mut squares, mut sum) = (DVec2::ZERO, 0.0, 0.0);
        // On a grid symmetric about the middle, the fit is one sum an axis.
        for (i, j) in (0..PLANE_SAMPLES).flat_map(|i| (0..PLANE_SAMPLES).map(move |j| (i, j))) {
            let across = DVec2::new(share(i), share(j));
            let there = middle + axis * (across.x * half.x) + axis.perp() * (across.y * half.y);
            let height = ground.height(there.x, there.y);
            slope += across * height;
            squares += across.x * across.x;
            sum += height;
        }
        // A body thinner than a millimetre has no slope across it.
        let slope = slope / (squares * half.max(DVec2::splat(1e-3)));
        let gradient = axis * slope.x + axis.perp() * slope.y;
        let normal = DVec3::new(-gradient.x, -gradient.y, 1.0).normalize();
        Self { middle: middle.extend(sum / f64::from(PLANE_SAMPLES * PLANE_SAMPLES)), normal }
    }

    /// Under a body where it stands: under the rectangle about it along its longest side.
    pub fn under_body(ground: &Ground, shape: &Shape, world_from_mesh: &DAffine3) -> Self {
        let size = shape.bounds.size();
        let longest = if size.x >= size.y && size.x >= size.z {
            DVec3::X
        } else if size.y >= size.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let axis = (world_from_mesh.matrix3 * longest).truncate().try_normalize().unwrap_or(DVec2::X);
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for corner in &shape.hull {
            let point = world_from_mesh.transform_point3(*corner).truncate();
            let along = DVec2::new(point.dot(axis), point.dot(axis.perp()));
            (low, high) = (low.min(along), high.max(along));
        }
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        Self::under(ground, axis * middle.x + axis.perp() * middle.y, axis, half)
    }
}

/// Least height of a body's points above the ground under each, metres; negative where it is sunk.
pub(super) fn clearance(ground: &Ground, shape: &Shape, world_from_mesh: &DAffine3) -> f64 {
    let above = |p: &DVec3| {
        let point = world_from_mesh.transform_point3(*p);
        point.z - ground.height(point.x, point.y)
    };
    shape.samples.iter().map(above).fold(f64::INFINITY, f64::min)
}

/// As [`clearance`], above the seabed alone; infinite without one.
pub(super) fn clearance_of_seabed(ground: &Ground, shape: &Shape, world_from_mesh: &DAffine3) -> f64 {
    let Some(seabed) = &ground.seabed else { return f64::INFINITY };
    let above = |p: DVec3| p.z - seabed.height(p.x, p.y);
    shape.samples.iter().map(|p| above(world_from_mesh.transform_point3(*p))).fold(f64::INFINITY, f64::min)
}

/// The body moved up or down until it touches the ground.
pub(super) fn touching(ground: &Ground, shape: &Shape, world_from_mesh: DAffine3) -> DAffine3 {
    raised(world_from_mesh, -clearance(ground, shape, &world_from_mesh))
}

/// A body that touches the ground, sunk until the share `burial` of its height lies below the plane that fits the ground
/// under it best, height being measured along that plane's normal. One that lies deeper already, in a hollow, stays.
pub(super) fn sunk(ground: &Ground, shape: &Shape, world_from_mesh: DAffine3, burial: f64) -> DAffine3 {
    if burial <= 0.0 {
        return world_from_mesh;
    }
    let plane = Plane::under_body(ground, shape, &world_from_mesh);
    let above = |p: &DVec3| plane.normal.dot(world_from_mesh.transform_point3(*p) - plane.middle);
    let (low, high) = shape.samples.iter().map(above).fold((f64::MAX, f64::MIN), |(l, h), d| (l.min(d), h.max(d)));
    let deeper = (burial * (high - low) + low) / plane.normal.z;
    raised(world_from_mesh, -deeper.max(0.0))
}

/// A transform `up` metres higher.
pub(super) fn raised(world_from_mesh: DAffine3, up: f64) -> DAffine3 {
    DAffine3 { translation: world_from_mesh.translation + DVec3::Z * up, ..world_from_mesh }
}

/// The shortest turn from straight up to a direction.
pub(super) fn from_up_to(normal: DVec3) -> DMat3 {
    if normal.z < -0.999_999 {
        return DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0));
    }
    let v = DVec3::Z.cross(normal);
    let cross = DMat3::from_cols(DVec3::new(0.0, v.z, -v.y), DVec3::new(-v.z, 0.0, v.x), DVec3::new(v.y, -v.x, 0.0));
    DMat3::IDENTITY + cross + cross * cross * (1.0 / (1.0 + normal.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_turn_takes_up_to_the_normal() {
        for normal in [DVec3::new(0.3, -0.2, 0.9).normalize(), DVec3::new(0.1, 0.8, -0.5).normalize(), DVec3::NEG_Z] {
            let turn = from_up_to(normal);
            assert!((turn * DVec3::Z - normal).length() < 1e-12, "{normal}");
            assert!((turn.determinant() - 1.0).abs() < 1e-12);
        }
    }
}
