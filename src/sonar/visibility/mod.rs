//! What a ping sees: the nearest surface at every (beam plane, elevation) sample.
//!
//! Knows geometry only: no energy, no bins, no bodies.

mod clip;
pub mod planes;
pub mod scan;

use glam::{DAffine3, DMat3, DVec3};

pub use planes::Planes;
pub use scan::{DepthBuffer, Segment};

use crate::math::Pose;
use crate::math::vectors::{Work, widest};
use crate::scene::{Cluster, Instance, Scene};
use scan::{Tag, Vertices};

/// What one sample of a ping meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Slant range, metres.
    pub range_m: f32,
    /// Number of the instance in the scene.
    pub instance: u16,
    /// Number of the triangle in the instance's mesh.
    pub triangle: u32,
}

/// Scan converter of one sonar, with the buffers that it uses again from ping to ping.
#[derive(Clone, Debug)]
pub struct Visibility {
    /// The beam planes.
    pub planes: Planes,
    /// Result of the latest [`Visibility::scan`].
    pub depth: DepthBuffer,
    vertices: Vertices,
}

impl Visibility {
    /// A scan converter for `planes`.
    #[must_use]
    pub fn new(planes: Planes) -> Self {
        Self { planes, depth: DepthBuffer::default(), vertices: Vertices::default() }
    }

    /// Finds the nearest surface at every sample of a ping from `world_from_sonar`.
    pub fn scan(&mut self, scene: &Scene, world_from_sonar: &Pose) {
        self.scan_instances(scene, world_from_sonar, &DAffine3::IDENTITY, |_| true);
    }

    /// As [`Visibility::scan`], of some instances only and with the whole world moved by `moved`.
    pub fn scan_instances(
        &mut self,
        scene: &Scene,
        world_from_sonar: &Pose,
        moved: &DAffine3,
        wanted: impl Fn(&Instance) -> bool,
    ) {
        self.depth.clear(&self.planes);
        let back = world_from_sonar.inverse();
        let sonar_from_world = DAffine3 { matrix3: back.rotation, translation: back.position } * *moved;
        for (number, instance) in scene.instances.iter().enumerate().filter(|(_, instance)| wanted(instance)) {
            let sonar_from_mesh = Transform::new(&(sonar_from_world * instance.world_from_mesh));
            for cluster in &instance.mesh.clusters {
                if !sonar_from_mesh.may_see(cluster, &self.planes) {
                    continue;
                }
                let (first_triangle, material) = (cluster.first_triangle, cluster.material);
                let tag = Tag { first_triangle, instance: number as u16, material };
                widest(Draw { scan: self, cluster, sonar_from_mesh: &sonar_from_mesh, tag });
            }
        }
    }

    /// What sample (plane, elevation) met in the latest scan.
    #[must_use]
    pub fn hit(&self, plane: usize, sample: usize) -> Option<Hit> {
        let at = plane * self.planes.samples() + sample;
        let w = self.depth.nearest[at];
        let t = self.planes.t[sample];
        (w > 0.0).then(|| {
            let segment = &self.depth.segments[self.depth.segment[at] as usize];
            let range_m = (1.0 + t * t).sqrt() / w;
            Hit { range_m, instance: segment.instance, triangle: segment.triangle }
        })
    }
}

/// One cluster turned into the sonar's frame and drawn.
struct Draw<'a> {
    scan: &'a mut Visibility,
    cluster: &'a Cluster,
    sonar_from_mesh: &'a Transform,
    tag: Tag,
}

impl Work for Draw<'_> {
    #[inline(always)]
    fn run(self) {
        let Visibility { planes, depth, vertices } = self.scan;
        self.sonar_from_mesh.apply(self.cluster, vertices);
        vertices.classify(planes);
        depth.draw(planes, vertices, &self.cluster.triangles, self.tag);
    }
}

/// sonar_from_mesh in single precision: rows of the matrix, then the offset. The offset is formed in double precision, so
/// far-away worlds lose nothing.
struct Transform {
    rows: [[f32; 3]; 3],
    offset: [f32; 3],
    scale: f32,
}

impl Transform {
    fn new(affine: &DAffine3) -> Self {
        let m: DMat3 = affine.matrix3;
        let row = |r: DVec3| r.to_array().map(|v| v as f32);
        let scale = m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
        Self {
            rows: [row(m.row(0)), row(m.row(1)), row(m.row(2))],
            offset: row(affine.translation),
            scale: scale as f32,
        }
    }

    /// False only if no point of the cluster's bounding sphere lies in the fan.
    fn may_see(&self, cluster: &Cluster, planes: &Planes) -> bool {
        let c = cluster.centre.to_array();
        let [x, y, z] = [0, 1, 2].map(|i| {
            let row = self.rows[i];
            row[0] * c[0] + row[1] * c[1] + row[2] * c[2] + self.offset[i]
        });
        // A touch more than the sphere, for rounding.
        let radius = cluster.radius * self.scale * 1.0001 + 1e-4;
        let rho = (x * x + y * y).sqrt();
        let (sin, cos) = planes.edge;
        let slant = (1.0 + planes.t_high * planes.t_high).sqrt();
        rho * rho + z * z <= (planes.far_m + radius) * (planes.far_m + radius)
            && y * cos - x * sin <= radius
            && -y * cos - x * sin <= radius
            && z - planes.t_high * rho <= radius * slant
            && planes.t_low * rho - z <= radius * slant
    }

    #[inline(always)]
    fn apply(&self, cluster: &Cluster, out: &mut Vertices) {
        let axis = |row: [f32; 3], offset: f32, out: &mut Vec<f32>| {
            out.clear();
            let points = cluster.x.iter().zip(&cluster.y).zip(&cluster.z);
            out.extend(points.map(|((x, y), z)| row[0] * x + row[1] * y + row[2] * z + offset));
        };
        axis(self.rows[0], self.offset[0], &mut out.x);
        axis(self.rows[1], self.offset[1], &mut out.y);
        axis(self.rows[2], self.offset[2], &mut out.z);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::Vec3;

    use super::*;
    use crate::catalog::Part;
    use crate::math::rng::Stream;
    use crate::math::vectors::tests::narrow;
    use crate::scene::Mesh;

    #[test]
    fn wide_vectors_change_no_bit() {
        let mut draw = Stream::at(5, "test", 0, "clutter");
        let mut point = || Vec3::from_array([0.0; 3].map(|_: f32| draw.uniform(-9.0, 9.0) as f32));
        let positions: Vec<Vec3> = (0..900).map(|_| point()).collect();
        let triangles = (0..300).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Arc::new(Mesh::from_parts(&[Part { positions, triangles, ..Part::default() }]));
        let instance = Instance { mesh, world_from_mesh: DAffine3::IDENTITY, body: 0, materials: vec![0] };
        let scene = Scene { instances: vec![instance], ..Scene::default() };
        let text = "{beams: 200, azimuth_deg: 120, elevation_deg: 60, vertical_beam_deg: 20, elevations: 300,
            range_m: [0.5, 20], range_bins: 100, bearing: cone, beam_width_deg: 1, frequency_khz: 900,
            bandwidth_khz: 100, source_level_db: 210, directivity_db: 30, yaw_rate_deg_s: 0,
            mount: {position_m: [0, 0, 0], yaw_deg: 0, pitch_deg: 0, roll_deg: 0}}";
        let sonar: crate::sonar::Sonar =
            crate::recipe::parse("sonar", text, crate::recipe::Origin::Given).unwrap().to("sonar").unwrap();
        let scan = || {
            let mut visibility = Visibility::new(Planes::new(&sonar));
            visibility.scan(&scene, &Pose::IDENTITY);
            let bits: Vec<u32> = visibility.depth.nearest.iter().map(|w| w.to_bits()).collect();
            (bits, visibility.depth.segments)
        };
        let wide = scan();
        assert!(wide.1.len() > 1000, "something is seen");
        assert!(wide == narrow(scan));
    }
}
