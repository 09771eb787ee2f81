//! Each frame from a new random side of a random target.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Target, Voyage, not_negative, positive};
use crate::math::real::{cos, radians, sin};
use crate::math::rng::Stream;
use crate::math::{Impossible, Pose};

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
    pub(super) fn check(&self) -> Result<(), Impossible> {
        positive("range_m", self.range_m)?;
        not_negative("altitude_m", self.altitude_m)?;
        not_negative("off_axis_deg", self.off_axis_deg)
    }

    /// Without targets the origin's ground is looked at; if no side is clear, the last one tried has to do.
    pub(super) fn pose(&self, voyage: &Voyage, stream: &mut Stream) -> Pose {
        let around = voyage.around;
        let target = match around.targets().len() as u64 {
            0 => Target { centre: DVec3::new(0.0, 0.0, around.ground(0.0, 0.0)), radius_m: 0.0 },
            count => around.targets()[stream.below(count) as usize],
        };
        let room = voyage.vehicle.clear_m;
        let off_axis = radians(self.off_axis_deg) * stream.uniform(-1.0, 1.0);
        let mut sonar = target.centre;
        for _ in 0..TRIES {
            sonar = self.stand(&target, std::f64::consts::TAU * stream.unit(), voyage);
            let towards = target.centre - sonar;
            let distance = towards.length();
            let near_side = target.centre - towards * (target.radius_m / distance).min(1.0);
            let free = sonar.z >= around.ground(sonar.x, sonar.y) + room - 1e-9 && around.gap(sonar, room) >= room;
            if free && around.sees(sonar, near_side) {
                break;
            }
        }
        voyage.aimed(sonar, target.centre - sonar, off_axis)
    }

    /// Where the sonar stands on a bearing from the target.
    fn stand(&self, target: &Target, bearing: f64, voyage: &Voyage) -> DVec3 {
        let away = DVec3::new(cos(bearing), sin(bearing), 0.0);
        let range = self.range_m.max(target.radius_m + 1.0);
        let mut above = self.altitude_m;
        // The ground's height is known only where the sonar stands, and that depends on it: three rounds settle it.
        for _ in 0..3 {
            let there = target.centre + away * across(range, above);
            let ground = voyage.around.ground(there.x, there.y);
            above = ground + self.altitude_m.max(voyage.vehicle.clear_m) - target.centre.z;
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
