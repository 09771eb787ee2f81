//! A path in plan that keeps its altitude over the ground.

use std::f64::consts::PI;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::spline::{Limits, Spline};
use super::waypoints::enough;
use super::{Leg, Voyage, finite, metres, not_negative, positive};
use crate::math::real::{atan2, cos, radians, sin};
use crate::math::{Impossible, Pose};

/// Places to either side of the vehicle at which the ground is taken.
const SAMPLES: i32 = 24;

/// A vehicle that follows the ground as far as a vehicle can: its height is an altitude above the ground smoothed along
/// its path, ahead and behind; its pitch is the slope of that.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Terrain {
    /// Above the smoothed ground, metres.
    pub altitude_m: f64,
    /// Points in plan of a smooth path, at least two, metres; without them a straight line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points_m: Option<Vec<[f64; 2]>>,
    /// Of the line, metres.
    pub length_m: f64,
    /// Of the line, counter-clockwise from x, degrees.
    pub heading_deg: f64,
    /// Middle of the line, metres.
    pub centre_m: [f64; 2],
    /// Path over which the ground is smoothed by a raised cosine: bumps of half that length are not followed, metres.
    pub smooth_m: f64,
    /// Steepest that the nose points up or down, degrees.
    pub most_pitch_deg: f64,
    /// Along the path in plan, metres a second.
    pub speed_m_s: f64,
    /// Fastest turn of the heading, degrees a second: bends are passed slower.
    pub turn_deg_s: f64,
}

impl Terrain {
    pub(super) fn check(&self) -> Result<(), Impossible> {
        not_negative("altitude_m", self.altitude_m)?;
        if let Some(points) = &self.points_m {
            enough(points.len())?;
            points.iter().flatten().try_for_each(|&value| metres("points_m", value))?;
        }
        positive("length_m", self.length_m)?;
        metres("length_m", self.length_m)?;
        finite("heading_deg", self.heading_deg)?;
        self.centre_m.iter().try_for_each(|&value| metres("centre_m", value))?;
        positive("smooth_m", self.smooth_m)?;
        Impossible::outside("most_pitch_deg", self.most_pitch_deg, 0.0, 80.0)?;
        positive("speed_m_s", self.speed_m_s)?;
        positive("turn_deg_s", self.turn_deg_s)
    }

    pub(super) fn leg<'a>(&'a self, voyage: &'a Voyage<'a>) -> Leg<'a> {
        let spline = Spline::new(self.points(), Limits { speed: self.speed_m_s, turn: radians(self.turn_deg_s) });
        let (share, duration_s) = (voyage.frame.share(), spline.duration());
        Leg { share, duration_s, speed_m_s: self.speed_m_s, at: Box::new(move |share| self.at(share, &spline, voyage)) }
    }

    fn points(&self) -> Vec<DVec3> {
        let middle = DVec3::new(self.centre_m[0], self.centre_m[1], 0.0);
        let heading = radians(self.heading_deg);
        let half = DVec3::new(cos(heading), sin(heading), 0.0) * (0.5 * self.length_m);
        let line = || vec![middle - half, middle + half];
        self.points_m.as_ref().map_or_else(line, |points| points.iter().map(|p| DVec3::new(p[0], p[1], 0.0)).collect())
    }

    fn at(&self, share: f64, spline: &Spline, voyage: &Voyage) -> Pose {
        let way = spline.duration() * self.speed_m_s;
        let on_path = |ahead: f64| {
            // Beyond its ends the path goes straight on.
            let wanted = if way > 0.0 { share + ahead / way } else { share };
            let (place, yaw) = spline.at(wanted.clamp(0.0, 1.0));
            place + DVec3::new(cos(yaw), sin(yaw), 0.0) * ((wanted - wanted.clamp(0.0, 1.0)) * way)
        };
        let (mut weights, mut heights, mut leaning, mut squares) = (0.0, 0.0, 0.0, 0.0);
        for k in -SAMPLES..=SAMPLES {
            let part = f64::from(k) / f64::from(SAMPLES + 1);
            let (ahead, weight) = (0.5 * self.smooth_m * part, 0.5 + 0.5 * cos(PI * part));
            let place = on_path(ahead);
            let height = voyage.around.ground(place.x, place.y);
            weights += weight;
            heights += weight * height;
            // Least squares of a line: the weights are even about the middle, so one sum is enough.
            leaning += weight * ahead * height;
            squares += weight * ahead * ahead;
        }
        let (mut position, yaw) = spline.at(share);
        position.z = heights / weights + self.altitude_m;
        let most = radians(self.most_pitch_deg);
        let pitch = atan2(leaning, squares).clamp(-most, most);
        Pose::from_angles(position, yaw, pitch, 0.0)
    }
}
