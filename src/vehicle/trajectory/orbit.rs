//! A circle about a place, looking inwards.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{FrameOfRun, Place, Surroundings, TrajectoryError, finite, not_negative, positive};
use crate::math::Pose;
use crate::math::real::{cos, radians, sin};

/// A level vehicle on a circle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Orbit {
    /// Of the circle, metres.
    pub radius_m: f64,
    /// Above the ground under the vehicle, metres.
    pub altitude_m: f64,
    /// Where the sonar is turned to, in plan.
    pub look_at: Place,
    /// Middle of the circle.
    pub centre: Place,
    /// Direction from the middle to the first position, counter-clockwise from x, degrees.
    pub start_deg: f64,
    /// How far round, counter-clockwise; at 360 the last frame stops short of the first, degrees.
    pub arc_deg: f64,
}

impl Orbit {
    pub(super) fn check(&self) -> Result<(), TrajectoryError> {
        positive("radius_m", self.radius_m)?;
        not_negative("altitude_m", self.altitude_m)?;
        finite("start_deg", self.start_deg)?;
        finite("arc_deg", self.arc_deg)?;
        for (name, place) in [("look_at", &self.look_at), ("centre", &self.centre)] {
            if let Place::Point(point) = place {
                point.iter().try_for_each(|&value| finite(name, value))?;
            }
        }
        Ok(())
    }

    pub(super) fn pose(&self, frame: FrameOfRun, around: &Surroundings) -> Pose {
        let closed = self.arc_deg.abs() >= 360.0;
        let share = if closed { frame.share_of_round() } else { frame.share() };
        let angle = radians(self.start_deg + self.arc_deg * share);
        let from_centre = DVec3::new(cos(angle), sin(angle), 0.0) * self.radius_m;
        let mut position = around.place(&self.centre) + from_centre;
        position.z = (around.ground)(position.x, position.y) + self.altitude_m;
        let yaw = around.yaw_towards(around.place(&self.look_at) - position);
        Pose::from_angles(position, yaw, 0.0, 0.0)
    }
}
