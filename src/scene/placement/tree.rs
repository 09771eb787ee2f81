//! Triangles in a tree of boxes: whether two surfaces meet, come near each other, or one lies inside the other.
//!
//! Exact on the triangles themselves, so that what is placed by it never overlaps. Knows nothing of bodies.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use glam::{DAffine3, DMat3, DVec3};
use rapier3d_f64::prelude::{SharedShape, Vector};

use super::triangle::{Triangle, are_closer, nearest, solid_angle};
use crate::scene::mesh::Mesh;

/// Most triangles in a leaf.
const LEAF: usize = 4;

/// A surface in its own frame, metres.
pub struct Tree {
    /// Leaves hold neighbouring triangles.
    triangles: Vec<Triangle>,
    /// The root first; none of an empty surface.
    nodes: Vec<Node>,
    /// Side of the cells in which vertices are merged for what falls on it, metres; 0 for none.
    merged: f64,
    collider: OnceLock<Option<SharedShape>>,
}

struct Node {
    bounds: Box3,
    /// First triangle and how many, of a leaf; else 0 triangles.
    first: u32,
    count: u32,
    /// Number of the second child; the first comes next after its parent.
    second: u32,
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box3 {
    pub low: DVec3,
    pub high: DVec3,
}

impl Tree {
    /// Of triangles in any order.
    pub(super) fn new(triangles: impl IntoIterator<Item = Triangle>) -> Self {
        let mut triangles: Vec<Triangle> = triangles.into_iter().collect();
        let mut nodes = Vec::new();
        if !triangles.is_empty() {
            grow(&mut triangles, 0, &mut nodes);
        }
        Self { triangles, nodes, merged: 0.0, collider: OnceLock::new() }
    }

    /// With a coarser surface for what falls on it: vertices in one cell of this side become one.
    pub(super) fn falling_onto(self, merged: f64) -> Self {
        Self { merged, ..self }
    }

    /// Of a mesh.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        Self::new(mesh.triangles().map(|corners| corners.map(|v| v.as_dvec3())))
    }

    pub(super) fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The box about it where it stands; `None` of an empty surface.
    pub(super) fn bounds(&self, world_from_mesh: &DAffine3) -> Option<Box3> {
        self.nodes.first()?;
        Some(Box3::about(self.triangles.iter().flatten().map(|&p| world_from_mesh.transform_point3(p))))
    }

    /// Whether a triangle of `other` meets one of these or lies closer than `distance` to it. Surfaces that only
    /// touch may count as meeting.
    pub(super) fn is_closer(&self, other: &Self, self_from_other: &DAffine3, distance: f64) -> bool {
        if self.nodes.is_empty() || other.nodes.is_empty() {
            return false;
        }
        let (turn, stretch) = (self_from_other.matrix3, absolute(self_from_other.matrix3));
        let carried = |bounds: &Box3| {
            let middle = turn * (0.5 * (bounds.low + bounds.high)) + self_from_other.translation;
            let half = stretch * (0.5 * (bounds.high - bounds.low)) + DVec3::splat(distance);
            Box3 { low: middle - half, high: middle + half }
        };
        let mut pairs = vec![(0, 0)];
        while let Some((a, b)) = pairs.pop() {
            let (ours, theirs) = (&self.nodes[a], &other.nodes[b]);
            if !ours.bounds.meets(&carried(&theirs.bounds)) {
                continue;
            }
            match (ours.count, theirs.count) {
                (1.., 1..) => {
                    if theirs.of(other).any(|triangle| {
                        let triangle = triangle.map(|p| self_from_other.transform_point3(p));
                        ours.of(self).any(|own| are_closer(own, &triangle, distance))
                    }) {
                        return true;
                    }
                }
                (0, 1..) => pairs.extend([(a + 1, b), (ours.second as usize, b)]),
                (1.., 0) => pairs.extend([(a, b + 1), (a, theirs.second as usize)]),
                (0, 0) if ours.bounds.volume() >= theirs.bounds.volume() => {
                    pairs.extend([(a + 1, b), (ours.second as usize, b)]);
                }
                (0, 0) => pairs.extend([(a, b + 1), (a, theirs.second as usize)]),
            }
        }
        false
    }

    /// Whether a point lies closer than `distance` to the surface.
    pub(super) fn is_near(&self, point: DVec3, distance: f64) -> bool {
        let mut left = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(number) = left.pop() {
            let node = &self.nodes[number];
            if !node.bounds.grown(distance).holds(point) {
                continue;
            }
            if node.count == 0 {
                left.extend([number + 1, node.second as usize]);
            } else if node.of(self).any(|triangle| (nearest(triangle, point) - point).length() < distance) {
                return true;
            }
        }
        false
    }

    /// Whether a point lies inside, by the solid angle that the surface fills around it: holes in a surface do not
    /// matter much, an open sheet has no inside.
    ///
    /// Source: Jacobson, Kavan & Sorkine-Hornung (2013), Robust inside-outside segmentation using generalized winding
    /// numbers, ACM TOG 32.
    pub(super) fn has_inside(&self, point: DVec3) -> bool {
        let bounds = self.nodes.first().map(|root| root.bounds);
        bounds.is_some_and(|bounds| bounds.holds(point))
            && self.triangles.iter().map(|triangle| solid_angle(triangle, point)).sum::<f64>().abs()
                > std::f64::consts::TAU
    }

    /// As what a body can fall upon; `None` of an empty surface.
    pub(super) fn collider(&self) -> Option<&SharedShape> {
        let make = || {
            let (corners, numbers) = self.coarse();
            let corners = corners.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
            SharedShape::trimesh(corners, numbers).ok()
        };
        self.collider.get_or_init(make).as_ref()
    }
}

impl Tree {
    /// Corners and triangles; corners of one cell are one, at their mean, and each triangle comes once.
    fn coarse(&self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let mut cells: BTreeMap<[i64; 3], (u32, DVec3, f64)> = BTreeMap::new();
        let mut numbers = BTreeSet::new();
        for (number, triangle) in self.triangles.iter().enumerate() {
            let corners = [0, 1, 2].map(|corner: usize| {
                let point = triangle[corner];
                // Without merging, every corner is a cell of its own.
                let whole = |value: f64| (value / self.merged).floor() as i64;
                let cell = match self.merged {
                    0.0 => [number as i64, corner as i64, 0],
                    _ => point.to_array().map(whole),
                };
                let next = cells.len() as u32;
                let entry = cells.entry(cell).or_insert((next, DVec3::ZERO, 0.0));
                (entry.1, entry.2) = (entry.1 + point, entry.2 + 1.0);
                entry.0
            });
            if corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0] {
                numbers.insert(corners);
            }
        }
        let mut corners = vec![DVec3::ZERO; cells.len()];
        cells.values().for_each(|(number, sum, count)| corners[*number as usize] = *sum / *count);
        (corners, numbers.into_iter().collect())
    }
}

impl std::fmt::Debug for Tree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tree").field("triangles", &self.triangles.len()).finish_non_exhaustive()
    }
}

impl Node {
    fn of<'t>(&self, tree: &'t Tree) -> impl Iterator<Item = &'t Triangle> {
        tree.triangles[self.first as usize..(self.first + self.count) as usize].iter()
    }
}

impl Box3 {
    /// The smallest about points.
    pub fn about(points: impl IntoIterator<Item = DVec3>) -> Self {
        let nothing = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        points.into_iter().fold(nothing, |grown, p| Self { low: grown.low.min(p), high: grown.high.max(p) })
    }

    /// Larger by a margin on every side.
    pub fn grown(&self, margin: f64) -> Self {
        Self { low: self.low - DVec3::splat(margin), high: self.high + DVec3::splat(margin) }
    }

    pub fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    pub fn holds(&self, point: DVec3) -> bool {
        self.low.cmple(point).all() && point.cmple(self.high).all()
    }

    /// Whether another box lies wholly inside.
    pub fn encloses(&self, other: &Self) -> bool {
        self.holds(other.low) && self.holds(other.high)
    }

    pub fn middle(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    pub fn size(&self) -> DVec3 {
        self.high - self.low
    }

    fn volume(&self) -> f64 {
        let size = self.size();
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

/// Halves along the longest axis of the middles until a leaf's worth is left.
fn grow(triangles: &mut [Triangle], first: usize, nodes: &mut Vec<Node>) {
    let bounds = Box3::about(triangles.iter().flatten().copied());
    let number = nodes.len();
    nodes.push(Node { bounds, first: first as u32, count: 0, second: 0 });
    if triangles.len() <= LEAF {
        // The halving leaves an order that is the selection's own: only the set is fixed.
        triangles.sort_unstable_by(compare);
        nodes[number].count = triangles.len() as u32;
        return;
    }
    let middle_of = |triangle: &Triangle| triangle[0] + triangle[1] + triangle[2];
    let spread = Box3::about(triangles.iter().map(middle_of)).size();
    let axis = if spread.x >= spread.y && spread.x >= spread.z { 0 } else { 1 + usize::from(spread.z > spread.y) };
    let half = triangles.len() / 2;
    let along = |a: &Triangle, b: &Triangle| middle_of(a)[axis].total_cmp(&middle_of(b)[axis]);
    triangles.select_nth_unstable_by(half, |a, b| along(a, b).then_with(|| compare(a, b)));
    let (lower, upper) = triangles.split_at_mut(half);
    grow(lower, first, nodes);
    nodes[number].second = nodes.len() as u32;
    grow(upper, first + half, nodes);
}

/// An order of all triangles, by their corners.
fn compare(a: &Triangle, b: &Triangle) -> std::cmp::Ordering {
    let numbers = |triangle: &Triangle| triangle.map(|corner| corner.to_array()).into_iter().flatten();
    let mut pairs = numbers(a).zip(numbers(b)).map(|(a, b)| a.total_cmp(&b));
    pairs.find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
}

fn absolute(matrix: DMat3) -> DMat3 {
    DMat3::from_cols(matrix.x_axis.abs(), matrix.y_axis.abs(), matrix.z_axis.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The twelve triangles of a cube of side 1 about the origin, facing outwards.
    fn cube() -> Tree {
        let corner = |k: usize| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2 & 1) as f64) - 0.5;
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        Tree::new(quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|corners| corners.map(corner)))
    }

    #[test]
    fn cubes_meet_when_they_do() {
        let cube = cube();
        let at = |x: f64, y: f64, z: f64| DAffine3::from_translation(DVec3::new(x, y, z));
        assert!(cube.is_closer(&cube, &at(0.9, 0.3, 0.2), 0.0));
        assert!(!cube.is_closer(&cube, &at(1.0 + 1e-8, 0.3, 0.2), 0.0), "they do not meet");
        assert!(cube.is_closer(&cube, &at(1.09, 0.3, 0.2), 0.1));
        assert!(!cube.is_closer(&cube, &at(1.11, 0.3, 0.2), 0.1));
        // Edge against edge: turned by an eighth about z, the half diagonal is 0.707.
        let turn = crate::math::Pose::from_angles(DVec3::ZERO, std::f64::consts::FRAC_PI_4, 0.0, 0.0).rotation;
        let turned = |x: f64| DAffine3 { matrix3: turn, translation: DVec3::new(x, 0.0, 0.0) };
        assert!(cube.is_closer(&cube, &turned(1.2), 0.0) && !cube.is_closer(&cube, &turned(1.21), 0.0));
    }

    #[test]
    fn a_coarse_surface_keeps_its_size() {
        let (corners, numbers) = cube().coarse();
        assert_eq!((corners.len(), numbers.len()), (36, 12));
        let (corners, numbers) = cube().falling_onto(0.4).coarse();
        assert_eq!((corners.len(), numbers.len()), (8, 12));
        assert!(corners.iter().all(|corner| (corner.abs() - 0.5).length() < 1e-12));
    }

    #[test]
    fn inside_is_inside() {
        let cube = cube();
        assert!(cube.has_inside(DVec3::new(0.4, -0.3, 0.2)));
        assert!(!cube.has_inside(DVec3::new(0.6, -0.3, 0.2)) && !cube.has_inside(DVec3::new(5.0, 0.0, 0.0)));
        let small = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(0.2)), translation: DVec3::ZERO };
        assert!(!cube.is_closer(&cube, &small, 0.0), "a cube in a cube crosses no side of it");
        assert!(cube.bounds(&small).is_some_and(|bounds| (bounds.high - 0.1).length() < 1e-12));
        assert!(Tree::new([]).bounds(&small).is_none());
    }
}
