//! Rays against triangles: the first thing that a ray meets, and whether two points see each other.
//!
//! Serves what is not a picture: resting objects on a bottom of triangles, lines of sight, and the check of the
//! visibility that pings are made of.

use std::time::Duration;

use glam::{DAffine3, DVec3, UVec2, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::cwbvh::node::CwBvhNode;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;
use obvhs::{BvhBuildParams, traverse};

use super::{Mesh, Scene};

/// A tree over the triangles of instances, in world coordinates.
pub struct Bvh {
    tree: Option<CwBvh>,
    triangles: Vec<Triangle>,
    /// Number of the first triangle of each instance.
    starts: Vec<u32>,
}

/// Where a ray met a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// From the ray's start, metres.
    pub distance: f64,
    /// Number of the triangle in its mesh.
    pub triangle: u32,
    /// Number of the instance.
    pub instance: u32,
}

impl Bvh {
    /// Of everything in a scene; instance numbers are those of [`Scene::instances`].
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Self {
        Self::of(scene.instances.iter().map(|instance| (&*instance.mesh, instance.world_from_mesh)))
    }

    /// Of meshes where they stand, numbered as they come.
    #[must_use]
    pub fn of<'a>(instances: impl IntoIterator<Item = (&'a Mesh, DAffine3)>) -> Self {
        let (mut triangles, mut starts) = (Vec::new(), Vec::new());
        for (mesh, world_from_mesh) in instances {
            starts.push(triangles.len() as u32);
            let place = |p: glam::Vec3| world_from_mesh.transform_point3(p.as_dvec3()).as_vec3().into();
            triangles.extend(mesh.triangles().map(|corners| {
                let [v0, v1, v2] = corners.map(place);
                Triangle { v0, v1, v2 }
            }));
        }
        let tree = (!triangles.is_empty())
            .then(|| build_cwbvh_from_tris(&triangles, BvhBuildParams::fast_build(), &mut Duration::default()));
        Self { tree, triangles, starts }
    }

    /// The nearest triangle, either side, that a ray meets within `reach` metres. `direction` has length 1.
    #[must_use]
    pub fn closest(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Hit> {
        let tree = self.tree.as_ref()?;
        let ray = Ray::new(vec3a(origin), vec3a(direction), 0.0, reach as f32);
        let mut nearest = RayHit::none();
        let meets = |ray: &Ray, place: usize| self.triangles[tree.primitive_indices[place] as usize].intersect(ray);
        if !tree.ray_traverse(ray, &mut nearest, meets) {
            return None;
        }
        let triangle = tree.primitive_indices[nearest.primitive_id as usize];
        let instance = self.starts.partition_point(|&start| start <= triangle) - 1;
        let distance = plane_distance(&self.triangles[triangle as usize], origin, direction);
        Some(Hit {
            distance: distance.unwrap_or(nearest.t.into()),
            triangle: triangle - self.starts[instance],
            instance: instance as u32,
        })
    }

    /// Whether nothing stands between two points, both ends left out by a millimetre.
    #[must_use]
    pub fn is_clear(&self, from: DVec3, to: DVec3) -> bool {
        const MARGIN_M: f64 = 1e-3;
        let way = to - from;
        let length = way.length();
        if length <= 2.0 * MARGIN_M {
            return true;
        }
        let direction = way / length;
        self.closest(from + direction * MARGIN_M, direction, length - 2.0 * MARGIN_M).is_none()
    }

    /// Height of the highest surface above or below a point of the plane, metres.
    #[must_use]
    pub fn highest(&self, x: f64, y: f64) -> Option<f64> {
        let bounds = self.tree.as_ref()?.total_aabb;
        // A little above the top, so that a level top is met too.
        let (top, bottom) = (f64::from(bounds.max.z) + 1.0, f64::from(bounds.min.z) - 1.0);
        let hit = self.closest(DVec3::new(x, y, top), DVec3::NEG_Z, top - bottom)?;
        Some(top - hit.distance)
    }

    /// Height of the first surface below a point, metres.
    #[must_use]
    pub fn below(&self, point: DVec3) -> Option<f64> {
        let reach = point.z - f64::from(self.tree.as_ref()?.total_aabb.min.z) + 1.0;
        let hit = self.closest(point, DVec3::NEG_Z, reach)?;
        Some(point.z - hit.distance)
    }

    /// Distance from a point to the nearest triangle, at most `within`, metres; 0 in a closed solid.
    #[must_use]
    pub fn gap(&self, point: DVec3, within: f64) -> f64 {
        let Some(tree) = &self.tree else { return within };
        // A little more than asked for, so that rounding to 32 bits leaves nothing out.
        let reach = Vec3A::splat(within as f32 * 1.001 + 1e-3);
        let about = Aabb::new(vec3a(point) - reach, vec3a(point) + reach);
        if !about.intersect_aabb(&tree.total_aabb) {
            return within;
        }
        let mut nearest = within;
        let mut state = tree.new_traversal(Vec3A::Z);
        let mut node: &CwBvhNode;
        traverse!(tree, node, state, node.intersect_aabb(&about, state.oct_inv4), {
            let triangle = &self.triangles[tree.primitive_indices[state.primitive_id as usize] as usize];
            nearest = nearest.min(distance_to(triangle, point));
        });
        if nearest > 0.0 && self.is_inside(point) { 0.0 } else { nearest }
    }

    /// Whether a point lies in a closed solid whose triangles turn their fronts outwards: whichever way one goes, one
    /// leaves more surfaces than one enters. Rooms that are seen from within and single sheets are no solids.
    fn is_inside(&self, point: DVec3) -> bool {
        // Odd directions, so that they hardly meet edges and corners; they need not be of length 1 to the last bit.
        const WAYS: [DVec3; 3] = [
            DVec3::new(0.0113, 0.0071, 0.999_911),
            DVec3::new(0.8019, 0.5970, 0.0237),
            DVec3::new(-0.5313, 0.8459, 0.0471),
        ];
        WAYS.iter().all(|&way| self.left_over(point, way) > 0)
    }

    /// Surfaces that a ray leaves less those that it enters.
    fn left_over(&self, point: DVec3, way: DVec3) -> i32 {
        const STEP_M: f64 = 1e-3;
        const MOST: u32 = 256;
        let Some(tree) = &self.tree else { return 0 };
        let reach = f64::from(tree.total_aabb.diagonal().length()) + 1.0;
        let (mut from, mut left) = (point, 0);
        for _ in 0..MOST {
            let Some(hit) = self.closest(from, way, reach) else { break };
            let triangle = &self.triangles[(self.starts[hit.instance as usize] + hit.triangle) as usize];
            left += if normal(triangle).dot(way) > 0.0 { 1 } else { -1 };
            from += way * (hit.distance + STEP_M);
        }
        left
    }
}

/// Twice the area, towards the front.
fn normal(triangle: &Triangle) -> DVec3 {
    let [a, b, c] = corners(triangle);
    (b - a).cross(c - a)
}

fn corners(triangle: &Triangle) -> [DVec3; 3] {
    [triangle.v0, triangle.v1, triangle.v2].map(|v| v.as_dvec3())
}

/// Distance from a point to a triangle, metres.
///
/// Source: Ericson (2005), Real-time collision detection, section 5.1.5.
fn distance_to(triangle: &Triangle, point: DVec3) -> f64 {
    let [a, b, c] = corners(triangle);
    let across = (b - a).cross(c - a);
    // Within the prism over the triangle the plane is nearest, else one of the sides.
    let over = |from: DVec3, to: DVec3| across.cross(to - from).dot(point - from) >= 0.0;
    let area = across.length();
    if area > 0.0 && over(a, b) && over(b, c) && over(c, a) {
        return across.dot(point - a).abs() / area;
    }
    let to_side = |from: DVec3, to: DVec3| {
        let side = to - from;
        let square = side.length_squared();
        let share = if square > 0.0 { ((point - from).dot(side) / square).clamp(0.0, 1.0) } else { 0.0 };
        (point - from - side * share).length()
    };
    to_side(a, b).min(to_side(b, c)).min(to_side(c, a))
}

/// Where a ray meets a triangle's plane, metres: finer than the tree's 32 bits and the same on every machine.
fn plane_distance(triangle: &Triangle, origin: DVec3, direction: DVec3) -> Option<f64> {
    let (a, normal) = (triangle.v0.as_dvec3(), normal(triangle));
    let towards = normal.dot(direction);
    (towards.abs() > 1e-6 * normal.length()).then(|| normal.dot(a - origin) / towards)
}

fn vec3a(v: DVec3) -> Vec3A {
    Vec3A::new(v.x as f32, v.y as f32, v.z as f32)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::Vec3;

    use super::*;
    use crate::catalog::Part;

    fn square(z: f32) -> Mesh {
        let positions = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vec3::new(x, y, z)).to_vec();
        Mesh::from_parts(&[Part { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Part::default() }])
    }

    #[test]
    fn rays_meet_the_nearest_and_name_it() {
        let (low, high) = (Arc::new(square(0.0)), Arc::new(square(1.0)));
        let aside = DAffine3::from_translation(DVec3::new(5.0, 0.0, 0.0));
        let bvh = Bvh::of([(&*low, DAffine3::IDENTITY), (&*high, DAffine3::IDENTITY), (&*high, aside)]);
        let down = |x: f64, y: f64| bvh.closest(DVec3::new(x, y, 3.0), DVec3::NEG_Z, 10.0);
        let hit = down(0.5, -0.5).expect("above the middle");
        assert_eq!((hit.distance, hit.instance, hit.triangle), (2.0, 1, 0));
        assert_eq!(down(4.5, 0.5).map(|hit| (hit.instance, hit.triangle)), Some((2, 1)));
        assert_eq!(down(2.0, 0.0), None);
        assert_eq!(bvh.closest(DVec3::new(0.5, 0.2, 3.0), DVec3::NEG_Z, 1.5), None);
        assert!((bvh.highest(0.3, 0.1).expect("a surface") - 1.0).abs() < 1e-12);
    }

    #[test]
    fn sight_is_cut_by_what_stands_between() {
        let bvh = Bvh::of([(&square(0.0), DAffine3::IDENTITY)]);
        let (above, below) = (DVec3::new(0.2, 0.1, 1.0), DVec3::new(0.2, 0.1, -1.0));
        assert!(!bvh.is_clear(above, below));
        assert!(bvh.is_clear(above, DVec3::new(0.2, 0.1, 0.0)), "a point on the surface is seen");
        assert!(Bvh::of([]).is_clear(above, below));
    }

    /// A closed box from −half to half, its faces outwards.
    fn cuboid(half: Vec3) -> Mesh {
        let corner = |k: u32| half * Vec3::new((k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2 & 1) as f32) * 2.0 - half;
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Mesh::from_parts(&[Part { positions: (0..8).map(corner).collect(), triangles, ..Part::default() }])
    }

    #[test]
    fn a_gap_is_the_distance_to_a_box_and_nothing_within() {
        let (half, at) = (DVec3::new(2.0, 1.0, 0.5), DVec3::new(7.0, -3.0, 1.0));
        let mesh = cuboid(half.as_vec3());
        let bvh = Bvh::of([(&mesh, DAffine3::from_translation(at))]);
        let mut stream = crate::math::rng::Stream::at(1, "test", 0, "gap");
        let (mut within, mut near) = (0, 0);
        for _ in 0..4000 {
            let p = DVec3::from_array([6.0, 4.0, 3.0].map(|reach| stream.uniform(-reach, reach)));
            let outside = (p.abs() - half).max(DVec3::ZERO).length();
            let gap = bvh.gap(p + at, 1.5);
            assert!((gap - outside.min(1.5)).abs() < 1e-6, "{p}: {gap} for {outside}");
            within += u32::from(outside == 0.0);
            near += u32::from(outside > 0.0 && outside < 1.5);
        }
        assert!(within > 30 && near > 500, "{within} {near}");
        assert_eq!(Bvh::of([]).gap(at, 0.3), 0.3);
    }

    #[test]
    fn two_solids_in_one_another_are_solid_and_sheets_are_not() {
        let (large, small) = (cuboid(Vec3::splat(2.0)), cuboid(Vec3::splat(1.0)));
        let both = Bvh::of([(&large, DAffine3::IDENTITY), (&small, DAffine3::IDENTITY)]);
        assert_eq!(both.gap(DVec3::new(0.1, 0.2, 0.05), 0.3), 0.0);
        assert_eq!(both.gap(DVec3::new(1.5, 0.2, 0.05), 0.3), 0.0);
        let sheet = Bvh::of([(&square(1.0), DAffine3::IDENTITY)]);
        for z in [0.0, 2.0] {
            assert_eq!(sheet.gap(DVec3::new(0.1, 0.2, z), 0.3), 0.3);
        }
        assert!((sheet.gap(DVec3::new(0.1, 0.2, 0.8), 0.3) - 0.2).abs() < 1e-7);
        assert_eq!(sheet.below(DVec3::new(0.1, 0.2, 3.0)), Some(1.0));
        assert_eq!(sheet.below(DVec3::new(0.1, 0.2, 0.5)), None);
        // A room is seen from within: its faces point there.
        let mirrored = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        assert_eq!(Bvh::of([(&large, mirrored)]).gap(DVec3::new(0.1, 0.2, 0.05), 0.3), 0.3);
    }
}
