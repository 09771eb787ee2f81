//! Each frame from a new random side of a random target.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{LEAST_ALTITUDE_M, Surroundings, Target, TrajectoryError, not_negative, positive};
use crate::math::Pose;
use crate::math::real::{asin, atan2, cos, radians, sin};
use crate::math::rng::Stream;

/// Sides tried for a clear line of sight.
const TRIES: u32 = 64;
/// Sine of the steepest view down: from higher up than the range allows, the sonar comes lower.
const STEEPEST: f64 = 0.95;

/// The sonar at a range from a target, its axis on the target's height and nearly on its bearing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Views {
    /// From the sonar to the target's centre, metres; more where that would be within a metre of a large target.
    pub range_m: f64,
    /// Of the sonar above the ground under it, metres; less where the range does not reach so high.
    pub altitude_m: f64,
    /// The target lies up to this far to either side of the axis, degrees.
    pub off_axis_deg: f64,
}

impl Views {
    pub(super) fn check(&self) -> Result<(), TrajectoryError> {
        positive("range_m", self.range_m)?;
        not_negative("altitude_m", self.altitude_m)?;
        not_negative("off_axis_deg", self.off_axis_deg)
    }

    /// Without targets the origin's ground is looked at; if no side is clear, the last one tried has to do.
    pub(super) fn pose(&self, around: &Surroundings, stream: &mut Stream) -> Pose {
        let target = match around.targets.len() as u64 {
            0 => Target { centre: DVec3::new(0.0, 0.0, (around.ground)(0.0, 0.0)), radius_m: 0.0 },
            count => around.targets[stream.below(count) as usize],
        };
        let off_axis = radians(self.off_axis_deg) * stream.uniform(-1.0, 1.0);
        let mut sonar = target.centre;
        for _ in 0..TRIES {
            sonar = self.stand(&target, std::f64::consts::TAU * stream.unit(), around);
            let towards = target.centre - sonar;
            let distance = towards.length();
            let near_side = target.centre - towards * (target.radius_m / distance).min(1.0);
            let free = sonar.z >= (around.ground)(sonar.x, sonar.y) + LEAST_ALTITUDE_M - 1e-9;
            if free && (around.clear)(sonar, near_side) {
                break;
            }
        }
        let turned = aim(around.mount, target.centre - sonar, off_axis);
        Pose { position: sonar - turned.rotation * around.mount.position, ..turned }
    }

    /// Where the sonar stands on a bearing from the target.
    fn stand(&self, target: &Target, bearing: f64, around: &Surroundings) -> DVec3 {
        let away = DVec3::new(cos(bearing), sin(bearing), 0.0);
        let range = self.range_m.max(target.radius_m + 1.0);
        let mut above = self.altitude_m;
        // The ground's height is known only where the sonar stands, and that depends on it: three rounds settle it.
        for _ in 0..3 {
            let there = target.centre + away * across(range, above);
            above = (around.ground)(there.x, there.y) + self.altitude_m.max(LEAST_ALTITUDE_M) - target.centre.z;
            above = above.min(STEEPEST * range);
        }
        target.centre + away * across(range, above) + DVec3::Z * above
    }
}

/// Distance in plan of a point `above` metres higher at a range.
fn across(range: f64, above: f64) -> f64 {
    let above = above.clamp(-STEEPEST * range, STEEPEST * range);
    (range * range - above * above).sqrt()
}

/// Yaw and pitch of the vehicle at which the sonar's axis has the elevation of `direction` and lies `off_axis` radians
/// to port of its bearing.
fn aim(mount: &Pose, direction: DVec3, off_axis: f64) -> Pose {
    let axis = mount.rotation.x_axis;
    let rise = direction.z / direction.length();
    // Pitching turns the axis in the vehicle's x–z plane: sin(pitch + tilt) · upright = rise.
    let (upright, tilt) = ((axis.x * axis.x + axis.z * axis.z).sqrt(), atan2(axis.z, axis.x));
    let pitch = asin((rise / upright.max(1e-9)).clamp(-1.0, 1.0)) - tilt;
    let pitched = Pose::from_angles(DVec3::ZERO, 0.0, pitch, 0.0).rotation * axis;
    let yaw = atan2(direction.y, direction.x) + off_axis - atan2(pitched.y, pitched.x);
    Pose::from_angles(DVec3::ZERO, yaw, pitch, 0.0)
}
