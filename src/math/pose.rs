//! Rigid poses: where a body is and how it is turned.

use glam::{DMat3, DVec3};

use super::real::{cos, sin};

/// A rigid transform from a body's frame to the frame it stands in: `p_world = rotation · p_body + position`.
///
/// World: x east, y north, z up. Body: x forward, y left (port), z up. Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Origin of the body in the outer frame, metres.
    pub position: DVec3,
    /// Columns are the body's axes in the outer frame.
    pub rotation: DMat3,
}

impl Pose {
    /// The pose that changes nothing.
    pub const IDENTITY: Self = Self { position: DVec3::ZERO, rotation: DMat3::IDENTITY };

    /// From yaw (counter-clockwise from x), pitch (nose up) and roll (port side up), radians, applied in the order roll, pitch, yaw.
    #[must_use]
    pub fn from_angles(position: DVec3, yaw: f64, pitch: f64, roll: f64) -> Self {
        let (sy, cy) = (sin(yaw), cos(yaw));
        let (sp, cp) = (sin(pitch), cos(pitch));
        let (sr, cr) = (sin(roll), cos(roll));
        let about_z = DMat3::from_cols(DVec3::new(cy, sy, 0.0), DVec3::new(-sy, cy, 0.0), DVec3::Z);
        // Nose up turns x towards +z, which is a negative right-hand turn about y (port).
        let about_y = DMat3::from_cols(DVec3::new(cp, 0.0, sp), DVec3::Y, DVec3::new(-sp, 0.0, cp));
        let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cr, sr), DVec3::new(0.0, -sr, cr));
        Self { position, rotation: about_z * about_y * about_x }
    }

    /// A point of the body's frame in the outer frame.
    #[must_use]
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.position
    }

    /// `self ∘ inner`: world_from_vehicle.then_inner(vehicle_from_sonar) is world_from_sonar.
    #[must_use]
    pub fn then_inner(&self, inner: &Self) -> Self {
        Self { position: self.apply(inner.position), rotation: self.rotation * inner.rotation }
    }

    /// The transform back: body from outer.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let back = self.rotation.transpose();
        Self { position: -(back * self.position), rotation: back }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_turn_the_way_they_say() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let close = |a: DVec3, b: DVec3| assert!((a - b).length() < 1e-12, "{a} {b}");
        close(Pose::from_angles(DVec3::ZERO, quarter, 0.0, 0.0).apply(DVec3::X), DVec3::Y);
        close(Pose::from_angles(DVec3::ZERO, 0.0, quarter, 0.0).apply(DVec3::X), DVec3::Z);
        close(Pose::from_angles(DVec3::ZERO, 0.0, 0.0, quarter).apply(DVec3::Y), DVec3::Z);
    }

    #[test]
    fn inverse_and_composition_agree() {
        let a = Pose::from_angles(DVec3::new(1.0, 2.0, 3.0), 0.3, -0.2, 0.1);
        let b = Pose::from_angles(DVec3::new(-4.0, 0.5, 1.0), -1.1, 0.4, 0.7);
        let p = DVec3::new(0.2, -0.7, 5.0);
        assert!((a.then_inner(&b).apply(p) - a.apply(b.apply(p))).length() < 1e-12);
        assert!((a.inverse().apply(a.apply(p)) - p).length() < 1e-12);
    }
}
