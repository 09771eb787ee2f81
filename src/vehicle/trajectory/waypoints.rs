//! A smooth path through given points, at an even pace.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{FrameOfRun, TrajectoryError, finite};
use crate::math::Pose;
use crate::math::real::atan2;

/// Chords that a piece of the path between two points is measured with.
const CHORDS: usize = 64;

/// A level vehicle on a Catmull–Rom spline, frames evenly along it, nose along the path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Waypoints {
    /// In the world, at least two, metres.
    pub points_m: Vec<[f64; 3]>,
}

impl Waypoints {
    pub(super) fn check(&self) -> Result<(), TrajectoryError> {
        if self.points_m.len() < 2 {
            let value = self.points_m.len() as f64;
            return Err(TrajectoryError { name: "number of points_m", value, range: "2 or more" });
        }
        self.points_m.iter().flatten().try_for_each(|&value| finite("points_m", value))
    }

    pub(super) fn pose(&self, frame: FrameOfRun) -> Pose {
        let pieces = self.points_m.len().saturating_sub(1);
        let steps = pieces * CHORDS;
        let at = |step: usize| self.at((step / CHORDS).min(pieces.saturating_sub(1)), share(step, pieces));
        // Length of the path up to each chord's end.
        let mut lengths = vec![0.0];
        for step in 0..steps {
            let chord = (at(step + 1).0 - at(step).0).length();
            lengths.push(lengths[step] + chord);
        }
        let wanted = frame.share() * lengths[steps];
        let step = lengths.partition_point(|&length| length <= wanted).saturating_sub(1).min(steps.saturating_sub(1));
        let chord = lengths.get(step + 1).map_or(0.0, |end| end - lengths[step]);
        let within = if chord > 0.0 { (wanted - lengths[step]) / chord } else { 0.0 };
        let piece = (step / CHORDS).min(pieces.saturating_sub(1));
        let (position, along) = self.at(piece, (step - piece * CHORDS) as f64 / CHORDS as f64 + within / CHORDS as f64);
        Pose::from_angles(position, atan2(along.y, along.x), 0.0, 0.0)
    }

    /// Position and derivative at a share of a piece.
    ///
    /// Source: Catmull & Rom (1974), A class of local interpolating splines; ends mirrored.
    fn at(&self, piece: usize, t: f64) -> (DVec3, DVec3) {
        let point = |k: usize| self.points_m.get(k).map(|p| DVec3::from_array(*p));
        let from = point(piece).unwrap_or(DVec3::ZERO);
        let to = point(piece + 1).unwrap_or(from);
        let before = piece.checked_sub(1).and_then(point).unwrap_or(2.0 * from - to);
        let after = point(piece + 2).unwrap_or(2.0 * to - from);
        let (a, b) = (0.5 * (to - before), 2.0 * before - 5.0 * from + 4.0 * to - after);
        let c = 3.0 * (from - to) + after - before;
        (from + a * t + 0.5 * b * (t * t) + 0.5 * c * (t * t * t), a + b * t + 1.5 * c * (t * t))
    }
}

/// Share of its piece at which a chord begins; the end of the path belongs to the last piece.
fn share(step: usize, pieces: usize) -> f64 {
    if step == pieces * CHORDS { 1.0 } else { (step % CHORDS) as f64 / CHORDS as f64 }
}
