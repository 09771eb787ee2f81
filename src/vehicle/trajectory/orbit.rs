//! A circle about a place, looking inwards.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Leg, Place, Voyage, finite, not_negative, positive};
use crate::math::real::{cos, radians, sin};
use crate::math::{Impossible, Pose};

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
    /// Along the circle, metres a second.
    pub speed_m_s: f64,
}

impl Orbit {
    pub(super) fn check(&self) -> Result<(), Impossible> {
        positive("radius_m", self.radius_m)?;
        not_negative("altitude_m", self.altitude_m)?;
        finite("start_deg", self.start_deg)?;
        finite("arc_deg", self.arc_deg)?;
        positive("speed_m_s", self.speed_m_s)?;
        self.look_at.check("look_at")?;
        self.centre.check("centre")
    }

    pub(super) fn leg<'a>(&'a self, voyage: &'a Voyage<'a>) -> Leg<'a> {
        let closed = self.arc_deg.abs() >= 360.0;
        let share = if closed { voyage.frame.share_of_round() } else { voyage.frame.share() };
        let duration_s = radians(self.arc_deg.abs()) * self.radius_m / self.speed_m_s;
        Leg { share, duration_s, speed_m_s: self.speed_m_s, at: Box::new(|share| self.at(share, voyage)) }
    }

    fn at(&self, share: f64, voyage: &Voyage) -> Pose {
        let angle = radians(self.start_deg + self.arc_deg * share);
        let from_centre = DVec3::new(cos(angle), sin(angle), 0.0) * self.radius_m;
        let mut position = voyage.place(&self.centre) + from_centre;
        position.z = voyage.around.ground(position.x, position.y) + self.altitude_m;
        let yaw = voyage.yaw_towards(voyage.place(&self.look_at) - position);
        Pose::from_angles(position, yaw, 0.0, 0.0)
    }
}
