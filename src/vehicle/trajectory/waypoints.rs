//! A smooth path through given points.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::spline::{Limits, Spline};
use super::{Leg, Voyage, metres, not_negative, positive};
use crate::math::real::radians;
use crate::math::{Impossible, Pose};

/// A level vehicle on a Catmull–Rom spline, nose along it, frames evenly in time.
///
/// It goes at its speed, slower in bends where it would turn faster than it can, and turns on the spot where the path
/// comes to a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waypoints {
    /// In the world, at least two, metres.
    pub points_m: Vec<[f64; 3]>,
    /// Along the path where nothing slows it, metres a second.
    pub speed_m_s: f64,
    /// Fastest turn of the heading, degrees a second.
    pub turn_deg_s: f64,
    /// Slowest that the vehicle can go and still steer, metres a second; paths with tighter bends are refused.
    pub least_speed_m_s: f64,
}

impl Waypoints {
    pub(super) fn check(&self) -> Result<(), Impossible> {
        enough(self.points_m.len())?;
        self.points_m.iter().flatten().try_for_each(|&value| metres("points_m", value))?;
        positive("speed_m_s", self.speed_m_s)?;
        positive("turn_deg_s", self.turn_deg_s)?;
        not_negative("least_speed_m_s", self.least_speed_m_s)?;
        flyable(&self.spline(), self.turn_deg_s, self.least_speed_m_s)
    }

    pub(super) fn leg<'a>(&'a self, voyage: &Voyage) -> Leg<'a> {
        let spline = self.spline();
        let (share, duration_s) = (voyage.frame.share(), spline.duration());
        let at = move |share| {
            let (position, yaw) = spline.at(share);
            Pose::from_angles(position, yaw, 0.0, 0.0)
        };
        Leg { share, duration_s, speed_m_s: self.speed_m_s, at: Box::new(at) }
    }

    fn spline(&self) -> Spline {
        let points = self.points_m.iter().map(|&point| DVec3::from_array(point)).collect();
        Spline::new(points, Limits { speed: self.speed_m_s, turn: radians(self.turn_deg_s) })
    }
}

/// Refuses a path of fewer than two points.
pub(super) fn enough(points: usize) -> Result<(), Impossible> {
    Impossible::unless(points >= 2, "points_m", format!("{points} points are no path"), "write at least 2 points")
}

/// Refuses a path with bends that a vehicle of a least speed cannot take.
pub(super) fn flyable(spline: &Spline, turn_deg_s: f64, least_speed: f64) -> Result<(), Impossible> {
    let Some((slowest, place)) = spline.slowest() else { return Ok(()) };
    let problem = format!(
        "near [{:.1}, {:.1}] the path bends so that at {turn_deg_s} degrees a second it is flown at {slowest:.2} m/s, below the \
         least_speed_m_s of {least_speed}",
        place.x, place.y
    );
    let remedy = "set the points wider apart, a larger turn_deg_s or a smaller least_speed_m_s";
    Impossible::unless(slowest >= least_speed * (1.0 - 1e-9), "points_m", problem, remedy)
}
