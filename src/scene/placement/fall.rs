//! A body falls through the water onto the ground and what stands there, and comes to rest.
//!
//! The falling body is its convex hull, which is exact for what lies on level ground; ground and others are surfaces, a
//! little coarser than their own, and do not move. Who lets it fall puts right on the true triangles what that leaves over. One body falls at a time, in one thread: the same bits everywhere.

use glam::{DAffine3, DMat3, DVec2, DVec3};
use rapier3d_f64::math::{Matrix, Pose, Vector};
use rapier3d_f64::prelude::{
    ColliderBuilder, MassProperties, PhysicsWorld, RigidBody, RigidBodyBuilder, RigidBodyHandle, SharedShape,
};

use super::shape::Shape;
use super::tree::Box3;
use super::{Around, Miss};

/// Acceleration of a heavy thing in water, m/s²: gravity less buoyancy.
const GRAVITY: f64 = 6.0;
/// Drag on translation and rotation, 1/s.
const DRAG: [f64; 2] = [0.4, 1.2];
const FRICTION: f64 = 0.8;
/// Step of time, seconds.
const STEP_S: f64 = 1.0 / 60.0;
/// Steps after which a body that still moves has failed.
const MOST_STEPS: u32 = 720;
/// A body at rest moves its outermost points slower than this, m/s, for so many steps.
const STILL: (f64, u32) = (0.01, 15);
/// Side of a cell of the ground under it, as a share of its size, and at least, metres. Where it touches the ground itself is
/// found on its triangles afterwards.
const CELL: (f64, f64) = (0.2, 0.02);
/// Sediment gives way under a round thing: its weight acts at least this share of its height off the middle of contact.
const ROLLING: f64 = 0.06;

/// Where a body falls from, and how deep it will lie.
pub(super) struct Drop<'a> {
    pub shape: &'a Shape,
    pub world_from_mesh: DAffine3,
    pub burial: f64,
}

impl Drop<'_> {
    /// Where it comes to rest.
    ///
    /// # Errors
    /// [`Miss::Restless`] if it does not, or not close by.
    pub fn land(&self, around: &Around) -> Result<DAffine3, Miss> {
        let bounds = self.shape.tree.bounds(&self.world_from_mesh).ok_or(Miss::Restless)?;
        let patch = Patch::about(&bounds, self.shape.size());
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, 0.0, -GRAVITY);
        world.integration_parameters.dt = STEP_S;
        // Tolerances in proportion: a can is not held up by what a boat does not notice.
        world.integration_parameters.length_unit = (0.3 * self.shape.size()).clamp(0.02, 1.0);
        let fixed = |shape: &SharedShape| ColliderBuilder::new(shape.clone()).friction(FRICTION);
        world.colliders.insert(fixed(&patch.collider(around)?));
        let volume = Box3 {
            low: patch.middle.extend(f64::MIN) - patch.reach,
            high: patch.middle.extend(bounds.high.z) + patch.reach,
        };
        for other in around.taken.iter().filter(|other| other.bounds.meets(&volume)) {
            if let Some(shape) = other.tree.collider() {
                world.colliders.insert(fixed(shape).position(pose_of(&other.world_from_mesh)));
            }
        }
        let hull = self.hull();
        let body = RigidBodyBuilder::dynamic()
            .pose(pose_of(&self.world_from_mesh))
            .linear_damping(DRAG[0])
            .angular_damping(DRAG[1])
            .can_sleep(false);
        let (falling, _) = world.insert(body, hull);
        self.watch(&mut world, falling, &patch)
    }

    /// Steps until it rests.
    fn watch(&self, world: &mut PhysicsWorld, falling: RigidBodyHandle, patch: &Patch) -> Result<DAffine3, Miss> {
        let radius = self.shape.hull.iter().map(|p| (*p - self.shape.balance.centre).length()).fold(0.0, f64::max);
        let mut still = 0;
        for _ in 0..MOST_STEPS {
            world.step();
            let Some(body) = world.bodies.get_mut(falling) else { return Err(Miss::Restless) };
            self.hold(body);
            let place = transform_of(body.position());
            let centre = place.transform_point3(self.shape.balance.centre);
            if !centre.is_finite() || (centre.truncate() - patch.middle).abs().max_element() > patch.reach - radius {
                return Err(Miss::Restless);
            }
            let speed = body.linvel().length() + body.angvel().length() * radius;
            still = if speed < STILL.0 { still + 1 } else { 0 };
            if still >= STILL.1 {
                return Ok(place);
            }
        }
        Err(Miss::Restless)
    }

    /// Slows rotation as soft ground does: its resistance acts at an arm that grows with the depth the body will have.
    fn hold(&self, body: &mut RigidBody) {
        let spin = body.angvel();
        let speed = spin.length();
        if speed <= 0.0 {
            return;
        }
        let place = transform_of(body.position());
        let centre = place.transform_point3(self.shape.balance.centre);
        let lowest = self.shape.hull.iter().map(|p| place.transform_point3(*p).z).fold(f64::MAX, f64::min);
        let height = (centre.z - lowest).max(0.0);
        let axis = place.matrix3.transpose() * DVec3::new(spin.x / speed, spin.y / speed, spin.z / speed);
        let inertia = axis.dot(self.shape.balance.inertia * axis) + height * height;
        // Half the width of a circle's part that is sunk by the burial.
        let sunk = 1.0 - 2.0 * self.burial;
        let arm = (1.0 - sunk * sunk).max(0.0).sqrt().clamp(ROLLING, 0.5) * height;
        let slower = (GRAVITY * arm / inertia.max(1e-9) * STEP_S).min(speed);
        body.set_angvel(spin * (1.0 - slower / speed), false);
    }

    fn hull(&self) -> ColliderBuilder {
        let corners: Vec<Vector> = self.shape.hull.iter().map(|&p| vector_of(p)).collect();
        let size = 0.5 * self.shape.bounds.size().max(DVec3::splat(1e-3));
        let middle = vector_of(self.shape.bounds.middle());
        let shape = SharedShape::convex_hull(&corners).unwrap_or_else(|| {
            SharedShape::compound(vec![(Pose::from_translation(middle), SharedShape::cuboid(size.x, size.y, size.z))])
        });
        let balance = &self.shape.balance;
        let inertia = balance.inertia + DMat3::from_diagonal(DVec3::splat(1e-9));
        let columns = [inertia.x_axis, inertia.y_axis, inertia.z_axis].map(vector_of);
        let weight = MassProperties::with_inertia_matrix(
            vector_of(balance.centre),
            1.0,
            Matrix::from_cols(columns[0], columns[1], columns[2]),
        );
        ColliderBuilder::new(shape).friction(FRICTION).mass_properties(weight)
    }
}

/// The ground about a body, as triangles.
struct Patch {
    middle: DVec2,
    /// Half its side, metres.
    reach: f64,
    cell: f64,
}

impl Patch {
    fn about(bounds: &Box3, size: f64) -> Self {
        let radius = 0.5 * bounds.size().length();
        Self { middle: bounds.middle().truncate(), reach: 1.6 * radius + 0.6, cell: (CELL.0 * size).max(CELL.1) }
    }

    fn collider(&self, around: &Around) -> Result<SharedShape, Miss> {
        let cells = (2.0 * self.reach / self.cell).ceil() as u32;
        let at = |k: u32| self.reach * (2.0 * f64::from(k) / f64::from(cells) - 1.0);
        let node = |i: u32, j: u32| {
            let (x, y) = (self.middle.x + at(i), self.middle.y + at(j));
            Vector::new(x, y, around.ground.height(x, y))
        };
        let nodes = (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j))).map(|(i, j)| node(i, j)).collect();
        let number = |i: u32, j: u32| j * (cells + 1) + i;
        let quads = (0..cells).flat_map(|j| (0..cells).map(move |i| (i, j)));
        let triangles = quads.flat_map(|(i, j)| {
            let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        SharedShape::trimesh(nodes, triangles.collect()).map_err(|_| Miss::Restless)
    }
}

fn vector_of(p: DVec3) -> Vector {
    Vector::new(p.x, p.y, p.z)
}

/// A rigid transform as the engine has it.
fn pose_of(transform: &DAffine3) -> Pose {
    let [x, y, z] = [transform.matrix3.x_axis, transform.matrix3.y_axis, transform.matrix3.z_axis].map(vector_of);
    let rotation = rapier3d_f64::math::Rotation::from_mat3(&Matrix::from_cols(x, y, z));
    Pose { rotation: rotation.normalize(), translation: vector_of(transform.translation) }
}

/// The engine's pose as a transform, by plain arithmetic.
fn transform_of(pose: &Pose) -> DAffine3 {
    let q = pose.rotation;
    let length = (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w).sqrt();
    let (x, y, z, w) = (q.x / length, q.y / length, q.z / length, q.w / length);
    let matrix3 = DMat3::from_cols(
        DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)),
        DVec3::new(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)),
        DVec3::new(2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)),
    );
    let t = pose.translation;
    DAffine3 { matrix3, translation: DVec3::new(t.x, t.y, t.z) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Pose as OurPose;

    #[test]
    fn poses_go_to_the_engine_and_back() {
        for (yaw, pitch, roll) in [(0.3, -1.2, 2.0), (3.0, 0.1, -3.0), (-2.0, 1.5, 0.0)] {
            let pose = OurPose::from_angles(DVec3::new(1.0, -2.0, 3.0), yaw, pitch, roll);
            let given = DAffine3 { matrix3: pose.rotation, translation: pose.position };
            let back = transform_of(&pose_of(&given));
            assert!(back.abs_diff_eq(given, 1e-12), "{back}");
        }
    }
}
