//! Rays against triangles: the first thing that a ray meets, and whether two points see each other.
//!
//! Serves what is not a picture: resting objects on a bottom of triangles, lines of sight, and the check of the
//! visibility that pings are made of.

use std::time::Duration;

use glam::{DAffine3, DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;

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
}

/// Where a ray meets a triangle's plane, metres: finer than the tree's 32 bits and the same on every machine.
fn plane_distance(triangle: &Triangle, origin: DVec3, direction: DVec3) -> Option<f64> {
    let [a, b, c] = [triangle.v0, triangle.v1, triangle.v2].map(|v| v.as_dvec3());
    let normal = (b - a).cross(c - a);
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
}
