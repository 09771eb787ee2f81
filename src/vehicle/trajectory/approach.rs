//! Straight towards a place, looking at it.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Leg, NamedPlace, Place, Voyage, finite, not_negative, positive};
use crate::math::real::{cos, radians, sin};
use crate::math::{Impossible, Pose};

/// The sonar on a straight line in plan towards a place, its axis on it: the vehicle pitches as it comes nearer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Approach {
    /// What is approached; of the origin the ground there.
    pub of: Place,
    /// Distance in plan from sonar to place in the first frame, metres.
    pub from_m: f64,
    /// The same in the last frame, metres.
    pub to_m: f64,
    /// Of the sonar above the ground under it, metres.
    pub altitude_m: f64,
    /// Direction of motion, counter-clockwise from x, degrees.
    pub course_deg: f64,
    /// Metres a second.
    pub speed_m_s: f64,
}

impl Approach {
    pub(super) fn check(&self) -> Result<(), Impossible> {
        self.of.check("of")?;
        positive("from_m", self.from_m)?;
        positive("to_m", self.to_m)?;
        not_negative("altitude_m", self.altitude_m)?;
        finite("course_deg", self.course_deg)?;
        positive("speed_m_s", self.speed_m_s)
    }

    pub(super) fn leg<'a>(&'a self, voyage: &'a Voyage<'a>) -> Leg<'a> {
        let (share, speed_m_s) = (voyage.frame.share(), self.speed_m_s);
        let duration_s = (self.from_m - self.to_m).abs() / speed_m_s;
        Leg { share, duration_s, speed_m_s, at: Box::new(|share| self.at(share, voyage)) }
    }

    fn at(&self, share: f64, voyage: &Voyage) -> Pose {
        let mut place = voyage.place(&self.of);
        if self.of == Place::Named(NamedPlace::Origin) || voyage.around.targets().is_empty() && self.names_objects() {
            place.z = voyage.around.ground(place.x, place.y);
        }
        let course = radians(self.course_deg);
        let away = self.from_m + (self.to_m - self.from_m) * share;
        let mut sonar = place - DVec3::new(cos(course), sin(course), 0.0) * away;
        sonar.z = voyage.around.ground(sonar.x, sonar.y) + self.altitude_m;
        voyage.aimed(sonar, place - sonar, 0.0)
    }

    fn names_objects(&self) -> bool {
        self.of == Place::Named(NamedPlace::Objects)
    }
}
