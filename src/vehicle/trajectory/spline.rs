//! A smooth curve through points, with the time at which a vehicle of limited speed and turn is where on it.

use std::f64::consts::PI;

use glam::DVec3;

use crate::math::real::atan2;

/// Chords that a piece of the curve between two points is measured with.
const CHORDS: usize = 64;
/// Horizontal part of a derivative that gives no heading, metres.
const NO_HEADING_M: f64 = 1e-9;
/// Part of the greatest turn rate above which the heading of a chord turns evenly.
const TURNING: f64 = 0.5;

/// How fast a vehicle may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Metres a second.
    pub speed: f64,
    /// Of the heading, radians a second.
    pub turn: f64,
}

/// A Catmull–Rom spline, cut into chords that are passed at the speed, or slower where the heading would turn too fast.
///
/// Within a chord the spline's own parameter goes evenly: near points the pace is a few per cent off.
pub(super) struct Spline {
    points: Vec<DVec3>,
    /// When each chord begins, and when the last ends, seconds.
    times: Vec<f64>,
    /// Heading at the chords' ends, radians.
    yaws: Vec<f64>,
    /// Whether the heading turns evenly over a chord.
    even: Vec<bool>,
}

impl Spline {
    /// Through at least two points.
    pub fn new(points: Vec<DVec3>, limits: Limits) -> Self {
        let steps = points.len().saturating_sub(1) * CHORDS;
        let mut spline = Self { points, times: vec![0.0], yaws: Vec::new(), even: Vec::new() };
        let nodes: Vec<(DVec3, DVec3)> = (0..=steps).map(|step| spline.node(step)).collect();
        let heading = |along: DVec3| (along.truncate().length() > NO_HEADING_M).then(|| atan2(along.y, along.x));
        // Straight up or down, and where it stands still, the vehicle keeps its heading.
        let mut yaw = nodes.iter().find_map(|(_, along)| heading(*along)).unwrap_or(0.0);
        for (_, along) in &nodes {
            yaw = heading(*along).unwrap_or(yaw);
            spline.yaws.push(yaw);
        }
        for step in 0..steps {
            let chord = (nodes[step + 1].0 - nodes[step].0).length();
            let turn = turn_between(spline.yaws[step], spline.yaws[step + 1]).abs();
            let needed = (chord / limits.speed).max(turn / limits.turn);
            spline.times.push(spline.times[step] + needed);
            let headless = [step, step + 1].iter().any(|&node| heading(nodes[node].1).is_none());
            spline.even.push(headless || turn > TURNING * limits.turn * needed);
        }
        spline
    }

    /// From the first point to the last, seconds.
    pub fn duration(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Position and heading at a part of the time.
    pub fn at(&self, share: f64) -> (DVec3, f64) {
        let Some(last) = self.even.len().checked_sub(1) else {
            return (self.points.first().copied().unwrap_or(DVec3::ZERO), 0.0);
        };
        let wanted = share * self.duration();
        let step = self.times.partition_point(|&time| time <= wanted).saturating_sub(1).min(last);
        let taken = self.times[step + 1] - self.times[step];
        let within = if taken > 0.0 { (wanted - self.times[step]) / taken } else { 0.0 };
        let (position, along) =
            self.curve(step / CHORDS, (step % CHORDS) as f64 / CHORDS as f64 + within / CHORDS as f64);
        let yaw = if self.even[step] {
            self.yaws[step] + within * turn_between(self.yaws[step], self.yaws[step + 1])
        } else {
            atan2(along.y, along.x)
        };
        (position, yaw)
    }

    /// The slowest that a chord is passed, metres a second, and where; chords without length aside.
    pub fn slowest(&self) -> Option<(f64, DVec3)> {
        let chord = |step: usize| {
            let (from, to) = (self.node(step).0, self.node(step + 1).0);
            let length = (to - from).length();
            (length > NO_HEADING_M).then(|| (length / (self.times[step + 1] - self.times[step]), from))
        };
        (0..self.even.len()).filter_map(chord).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Position and derivative where a chord begins; the end of the curve belongs to the last piece.
    fn node(&self, step: usize) -> (DVec3, DVec3) {
        let pieces = self.points.len().saturating_sub(1);
        if step == pieces * CHORDS {
            return self.curve(pieces.saturating_sub(1), 1.0);
        }
        self.curve(step / CHORDS, (step % CHORDS) as f64 / CHORDS as f64)
    }

    /// Position and derivative at a share of a piece.
    ///
    /// Source: Catmull & Rom (1974), A class of local interpolating splines; ends mirrored.
    fn curve(&self, piece: usize, t: f64) -> (DVec3, DVec3) {
        let point = |k: usize| self.points.get(k).copied();
        let from = point(piece).unwrap_or(DVec3::ZERO);
        let to = point(piece + 1).unwrap_or(from);
        let before = piece.checked_sub(1).and_then(point).unwrap_or(2.0 * from - to);
        let after = point(piece + 2).unwrap_or(2.0 * to - from);
        let (a, b) = (0.5 * (to - before), 2.0 * before - 5.0 * from + 4.0 * to - after);
        let c = 3.0 * (from - to) + after - before;
        (from + a * t + 0.5 * b * (t * t) + 0.5 * c * (t * t * t), a + b * t + 1.5 * c * (t * t))
    }
}

/// The shorter turn from one heading to another, radians.
fn turn_between(from: f64, to: f64) -> f64 {
    let turn = to - from;
    turn - 2.0 * PI * (turn / (2.0 * PI)).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(speed: f64, turn: f64) -> Limits {
        Limits { speed, turn }
    }

    #[test]
    fn a_straight_way_takes_its_length_over_the_speed() {
        let spline = Spline::new(vec![DVec3::ZERO, DVec3::new(6.0, 8.0, 0.0)], limits(2.0, 0.1));
        assert!((spline.duration() - 5.0).abs() < 1e-9);
        let (place, yaw) = spline.at(0.5);
        assert!((place - DVec3::new(3.0, 4.0, 0.0)).length() < 1e-9 && (yaw - atan2(8.0, 6.0)).abs() < 1e-12);
        assert!((spline.slowest().expect("chords").0 - 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_reversal_takes_half_a_turn_of_time() {
        // Out and back over the same points: the heading turns by half a circle in one chord.
        let out_and_back = [0.0, 5.0, 0.0].map(|x| DVec3::new(x, 0.0, 1.0)).to_vec();
        let spline = Spline::new(out_and_back, limits(1.0, 0.2));
        let length = 10.0;
        assert!(spline.duration() > length + 0.9 * PI / 0.2, "{}", spline.duration());
        assert!(spline.slowest().expect("chords").0 < 0.05);
    }

    #[test]
    fn straight_up_keeps_the_heading() {
        let up = |points: &[[f64; 3]]| {
            let points = points.iter().map(|&point| DVec3::from_array(point)).collect();
            Spline::new(points, limits(1.0, 1.0))
        };
        let lift = up(&[[1.0, 2.0, 0.0], [1.0, 2.0, 6.0]]);
        let climb = up(&[[0.0, 0.0, 0.0], [0.0, 3.0, 1.0], [0.0, 3.5, 9.0], [0.0, 3.5, 12.0]]);
        for k in 0..=100 {
            let share = f64::from(k) / 100.0;
            assert_eq!(lift.at(share).1, 0.0);
            assert!(climb.at(share).1.is_finite());
        }
        assert!((lift.duration() - 6.0).abs() < 1e-9);
        assert!((lift.at(0.25).0 - DVec3::new(1.0, 2.0, 1.5)).length() < 0.01);
    }
}
