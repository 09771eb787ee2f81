//! What placing knows of a model: its triangles, points all over it, its hull and where its weight sits.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::tree::{Box3, Tree};
use super::triangle::Triangle;
use crate::math::real::{cos, sin};
use crate::scene::mesh::Mesh;

/// Directions in which the hull's corners are the furthest points.
const HULL_DIRECTIONS: u32 = 44;
/// Others fall on a surface of vertices that are merged in so many cells along the longest side.
const COLLIDER_CELLS: f64 = 24.0;
/// Points lie this share of the longest side apart, at most …
const SAMPLES_A_SIDE: f64 = 40.0;
/// … but not closer than this, metres.
const CLOSEST_SAMPLES_M: f64 = 0.02;
/// Most points along the side of one triangle.
const MOST_A_TRIANGLE: f64 = 64.0;

/// A model made ready to be placed, in the mesh's frame.
#[derive(Debug)]
pub struct Shape {
    pub(super) tree: Arc<Tree>,
    pub(super) bounds: Box3,
    /// Every vertex, and points on triangles that are wider than the samples are apart.
    pub(super) samples: Vec<DVec3>,
    /// Corners of its convex hull, to within a few thousandths of its size.
    pub(super) hull: Vec<DVec3>,
    pub(super) balance: Balance,
}

/// A body of mass 1: as heavy everywhere on its surface, which is true of hollow things and near enough for others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance {
    /// Centre of gravity.
    pub centre: DVec3,
    /// Inertia about the centre, m².
    pub inertia: DMat3,
}

impl Shape {
    /// Of a mesh.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let bounds = Box3 { low: mesh.low.as_dvec3(), high: mesh.high.as_dvec3() };
        let tree = Tree::of(mesh).falling_onto(bounds.size().max_element() / COLLIDER_CELLS);
        let apart = (bounds.size().max_element() / SAMPLES_A_SIDE).max(CLOSEST_SAMPLES_M);
        let mut samples: Vec<DVec3> = mesh.vertices().map(|v| v.as_dvec3()).collect();
        let hull = hull(&samples);
        mesh.triangles().for_each(|triangle| scatter(triangle.map(|v| v.as_dvec3()), apart, &mut samples));
        let balance = Balance::of(tree.triangles());
        Self { tree: Arc::new(tree), bounds, samples, hull, balance }
    }

    /// Longest side of its box, metres.
    pub(super) fn size(&self) -> f64 {
        self.bounds.size().max_element()
    }
}

impl Balance {
    fn of(triangles: &[Triangle]) -> Self {
        let area = |[a, b, c]: &Triangle| 0.5 * (b - a).cross(c - a).length();
        let (mut mass, mut first) = (0.0, DVec3::ZERO);
        for triangle in triangles {
            let share = area(triangle);
            mass += share;
            first += share * (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        }
        if mass <= 0.0 {
            return Self { centre: DVec3::ZERO, inertia: DMat3::IDENTITY };
        }
        let centre = first / mass;
        // A triangle's second moments are those of a third of its mass at the middle of each side.
        let mut inertia = DMat3::ZERO;
        for triangle in triangles {
            let [a, b, c] = triangle.map(|p| p - centre);
            for r in [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)] {
                let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
                inertia += (DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer) * (area(triangle) / 3.0);
            }
        }
        Self { centre, inertia: inertia * (1.0 / mass) }
    }
}

/// Adds points on a triangle whose sides are longer than `apart`.
fn scatter([a, b, c]: [DVec3; 3], apart: f64, samples: &mut Vec<DVec3>) {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    let steps = (longest / apart).ceil().min(MOST_A_TRIANGLE) as u32;
    let share = |k: u32| f64::from(k) / f64::from(steps.max(1));
    for (i, j) in (0..=steps).flat_map(|i| (0..=steps - i).map(move |j| (i, j))) {
        // The corners are there already.
        if steps > 1 && [i, j, steps - i - j].iter().all(|&k| k < steps) {
            samples.push(a + (b - a) * share(i) + (c - a) * share(j));
        }
    }
}

/// The furthest points in directions spread evenly, each once.
fn hull(points: &[DVec3]) -> Vec<DVec3> {
    let mut corners: Vec<DVec3> = Vec::new();
    for k in 0..HULL_DIRECTIONS {
        let furthest = |direction: DVec3| points.iter().max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)));
        if let Some(&corner) = furthest(spread(k, HULL_DIRECTIONS))
            && !corners.contains(&corner)
        {
            corners.push(corner);
        }
    }
    corners
}

/// Direction number `k` of `of`, evenly over the sphere; the axes' own first.
fn spread(k: u32, of: u32) -> DVec3 {
    let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    if let Some(axis) = axes.get(k as usize) {
        return *axis;
    }
    let (k, of) = (k - axes.len() as u32, of - axes.len() as u32);
    let (golden, height) = (PI * (3.0 - 5.0_f64.sqrt()), 1.0 - 2.0 * (f64::from(k) + 0.5) / f64::from(of));
    let across = (1.0 - height * height).sqrt();
    DVec3::new(across * cos(golden * f64::from(k)), across * sin(golden * f64::from(k)), height)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::catalog::Part;

    #[test]
    fn a_plate_is_sampled_and_balanced() {
        let positions = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.5)).to_vec();
        let shape = Shape::new(&Mesh::from_parts(&[Part {
            positions,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Part::default()
        }]));
        assert!((shape.balance.centre - DVec3::new(1.0, 0.5, 0.5)).length() < 1e-6);
        // A plate of sides 2 and 1: 1/12, 4/12 and their sum.
        let diagonal = DVec3::new(1.0, 4.0, 5.0) / 12.0;
        assert!((shape.balance.inertia * DVec3::ONE - diagonal).length() < 1e-6, "{}", shape.balance.inertia);
        assert_eq!(shape.hull.len(), 4);
        for k in 0..100 {
            let p = DVec3::new(0.02 * f64::from(k), 0.37, 0.5);
            assert!(shape.samples.iter().any(|s| (*s - p).length() < 0.06), "no sample near {p}");
        }
    }

    #[test]
    fn directions_fill_the_sphere() {
        let sum: DVec3 = (0..HULL_DIRECTIONS).map(|k| spread(k, HULL_DIRECTIONS)).sum();
        assert!(sum.length() < 4.0, "{sum}");
    }
}
