//! Ropes and lines as thin tubes: what moors floating things and joins those in a chain.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::tree::Tree;
use crate::catalog::Part;
use crate::math::real::{cos, sin};
use crate::scene::ground::Ground;
use crate::scene::mesh::Mesh;

/// Material of every rope, a name in the table of materials.
pub(crate) const ROPE: &str = "rope";
/// Corners of a rope's section.
const SIDES: u32 = 6;
/// Length of a straight piece of rope on the ground, metres.
const PIECE_M: f64 = 0.2;

/// A rope in the world: background, it carries no label.
#[derive(Clone, Debug)]
pub(super) struct Rope {
    pub mesh: Arc<Mesh>,
    pub tree: Arc<Tree>,
    /// Numbers of what it may meet: what it is tied to.
    pub tied_to: Vec<usize>,
}

impl Rope {
    /// Through points of the world; `thickness` is its diameter, metres.
    pub fn through(points: &[DVec3], thickness: f64, tied_to: Vec<usize>) -> Self {
        let part = tube(points, 0.5 * thickness);
        let mesh = Mesh::from_parts(&[part]);
        let tree = Tree::of(&mesh);
        Self { mesh: Arc::new(mesh), tree: Arc::new(tree), tied_to }
    }

    /// Along the ground from one place to another, half sunk where it lies.
    pub fn along(ground: &Ground, from: DVec3, to: DVec3, thickness: f64, tied_to: Vec<usize>) -> Self {
        let pieces = ((to - from).truncate().length() / PIECE_M).ceil().max(1.0) as u32;
        let lying = |k: u32| {
            let point = from + (to - from) * (f64::from(k) / f64::from(pieces));
            DVec3::new(point.x, point.y, ground.height(point.x, point.y) + 0.25 * thickness)
        };
        let points: Vec<DVec3> = (0..=pieces).map(lying).collect();
        Self::through(&points, thickness, tied_to)
    }

    pub fn world_from_mesh() -> DAffine3 {
        DAffine3::IDENTITY
    }
}

/// A closed tube; its section turns as little as it can from point to point.
fn tube(points: &[DVec3], radius: f64) -> Part {
    let mut part = Part { material: ROPE.into(), ..Part::default() };
    let Some((first, last)) = points.first().zip(points.last()) else { return part };
    let way = |k: usize| {
        let (before, after) = (points[k.saturating_sub(1)], points[(k + 1).min(points.len() - 1)]);
        (after - before).try_normalize().unwrap_or(DVec3::Z)
    };
    let mut across = way(0).any_orthonormal_vector();
    for (k, point) in points.iter().enumerate() {
        let along = way(k);
        across = (across - along * across.dot(along)).try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
        let beside = along.cross(across);
        let corner = |side: u32| std::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
        let ring = (0..SIDES).map(|side| *point + (across * cos(corner(side)) + beside * sin(corner(side))) * radius);
        part.positions.extend(ring.map(|p| p.as_vec3()));
    }
    let rings = points.len() as u32;
    for (k, side) in (1..rings).flat_map(|k| (0..SIDES).map(move |side| (k, side))) {
        let (here, before, next) = (k * SIDES, (k - 1) * SIDES, (side + 1) % SIDES);
        part.triangles.extend([[before + side, before + next, here + next], [before + side, here + next, here + side]]);
    }
    let ends = part.positions.len() as u32;
    part.positions.extend([first.as_vec3(), last.as_vec3()]);
    let top = (rings - 1) * SIDES;
    for side in 0..SIDES {
        let next = (side + 1) % SIDES;
        part.triangles.extend([[ends, next, side], [ends + 1, top + side, top + next]]);
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rope_has_its_length_and_thickness() {
        let points: Vec<DVec3> =
            (0..=20).map(|k| DVec3::new(0.1 * f64::from(k), 0.0, 0.02 * f64::from(k % 2))).collect();
        let part = tube(&points, 0.01);
        let corner = |v: u32| part.positions[v as usize].as_dvec3();
        let volume: f64 = part.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum();
        // A hexagon in a circle of radius r has 2.598 r².
        let hexagon = 2.598e-4 * 2.0;
        assert!((volume / hexagon - 1.0).abs() < 0.1, "{volume} for {hexagon}");
    }
}
