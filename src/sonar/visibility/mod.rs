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
                sonar_from_mesh.apply(cluster, &mut self.vertices);
                self.vertices.classify(&self.planes);
                let tag =
                    Tag { first_triangle: cluster.first_triangle, instance: number as u16, material: cluster.material };
                self.depth.draw(&self.planes, &self.vertices, &cluster.triangles, tag);
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
