//! Parallel lines over an area, joined by half circles.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Leg, Voyage, finite, metres, not_negative, positive};
use crate::math::real::{cos, radians, sin};
use crate::math::{Impossible, Pose};

/// A level vehicle on survey lines, frames evenly along the path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lawnmower {
    /// Of a line, metres.
    pub length_m: f64,
    /// From line to line, metres.
    pub spacing_m: f64,
    /// How many lines, 1 or more.
    pub lines: u32,
    /// Above the ground under the vehicle, metres.
    pub altitude_m: f64,
    /// Of the first line, counter-clockwise from x; the next lie to port of it, degrees.
    pub heading_deg: f64,
    /// Middle of the area in the world, metres.
    pub centre_m: [f64; 2],
    /// Along lines and turns, metres a second.
    pub speed_m_s: f64,
}

impl Lawnmower {
    pub(super) fn check(&self) -> Result<(), Impossible> {
        positive("length_m", self.length_m)?;
        positive("spacing_m", self.spacing_m)?;
        positive("lines", self.lines.into())?;
        not_negative("altitude_m", self.altitude_m)?;
        finite("heading_deg", self.heading_deg)?;
        positive("speed_m_s", self.speed_m_s)?;
        self.centre_m.iter().try_for_each(|&value| metres("centre_m", value))
    }

    pub(super) fn leg<'a>(&'a self, voyage: &'a Voyage<'a>) -> Leg<'a> {
        let (share, speed_m_s) = (voyage.frame.share(), self.speed_m_s);
        Leg { share, duration_s: self.way_m() / speed_m_s, speed_m_s, at: Box::new(|share| self.at(share, voyage)) }
    }

    fn at(&self, share: f64, voyage: &Voyage) -> Pose {
        let heading = radians(self.heading_deg);
        let (along, across, turned) = self.on_path(share);
        let (s, c) = (sin(heading), cos(heading));
        let (x, y) = (self.centre_m[0] + c * along - s * across, self.centre_m[1] + s * along + c * across);
        let position = DVec3::new(x, y, voyage.around.ground(x, y) + self.altitude_m);
        Pose::from_angles(position, heading + turned, 0.0, 0.0)
    }

    /// Length of lines and turns together.
    fn way_m(&self) -> f64 {
        let lines = f64::from(self.lines);
        lines * self.length_m + (lines - 1.0) * (PI * (0.5 * self.spacing_m))
    }

    /// Place along and across the lines from the middle, and the turn from the first heading, at a share of the path.
    fn on_path(&self, share: f64) -> (f64, f64, f64) {
        let (half, radius) = (0.5 * self.length_m, 0.5 * self.spacing_m);
        let (bend, lines) = (PI * radius, f64::from(self.lines));
        let way = share * self.way_m();
        let line = (way / (self.length_m + bend)).floor().min(lines - 1.0);
        let on_line = way - line * (self.length_m + bend);
        let across = (line - 0.5 * (lines - 1.0)) * self.spacing_m;
        let forth = if line % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let turned = if forth > 0.0 { 0.0 } else { PI };
        if on_line <= self.length_m {
            return (forth * (on_line - half), across, turned);
        }
        // Turns go to port after a line out and to starboard after a line back.
        let angle = (on_line - self.length_m) / radius;
        let along = forth * (half + radius * cos(angle - FRAC_PI_2));
        (along, across + radius * (1.0 + sin(angle - FRAC_PI_2)), turned + forth * angle)
    }
}
