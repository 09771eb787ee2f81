//! Angles and distances under which a sonar sees things on the bottom and in the water.

use crate::math::real::{asin, atan2, cos, degrees, pow, radians, sin, tan};

/// Distance that suits a thing of 1 m, metres, and how it grows with the size: 2.4 m for a can, 5 m for a tire, 24 m for a
/// ship. A tire is then a twentieth of the picture's height, with its shadow a tenth.
const DISTANCE: (f64, f64) = (6.0, 0.42);
/// Nearest and farthest of such distances, metres.
const DISTANCES_M: [f64; 2] = [2.0, 40.0];
/// Height over distance: sound comes in at 20°, as steep as shadows are still twice as long as things are high.
const RISE: f64 = 0.36;
/// Lowest altitude, metres: vehicles keep 0.3 m clear.
pub const LEAST_ALTITUDE_M: f64 = 0.5;
/// Steepest view down that a tilt is chosen for, degrees.
pub const STEEPEST_DEG: f64 = 75.0;
/// Part of the vertical beam that middles of things may fill: they are a little beyond where it is 3 dB down, at most.
pub const USABLE: f64 = 1.2;

/// Distance from which things of a size are looked at, metres.
#[must_use]
pub fn distance_m(longest_m: f64) -> f64 {
    (DISTANCE.0 * pow(longest_m.max(0.01), DISTANCE.1)).clamp(DISTANCES_M[0], DISTANCES_M[1])
}

/// Altitude that suits a distance in plan, metres.
#[must_use]
pub fn altitude_m(distance_m: f64) -> f64 {
    (RISE * distance_m).max(LEAST_ALTITUDE_M)
}

/// Part of the distance of things by which the range goes beyond them for their shadows, at most.
const SHADOW: f64 = 0.25;
/// Distance over the longest side of a thing, at least: it is not cut by the edges of the picture.
const WHOLE: f64 = 0.9;

/// Distance from which things from one size to another are looked at, metres: between those that suit each, and so far
/// that the largest is seen as a whole.
#[must_use]
pub fn distance_of_all_m([smallest_m, largest_m]: [f64; 2]) -> f64 {
    distance_m((smallest_m.max(0.01) * largest_m).sqrt()).max(WHOLE * largest_m)
}

/// Where things are, as a sonar sees them: nearest and farthest in plan, lowest and highest middle; metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// In plan.
    pub near_m: f64,
    /// In plan.
    pub far_m: f64,
    /// Over the bottom.
    pub low_m: f64,
    /// Over the bottom.
    pub high_m: f64,
}

impl Sight {
    /// Elevations of the lowest and the highest line of sight from an altitude, degrees; down is negative.
    #[must_use]
    pub fn elevations_deg(&self, altitude_m: f64) -> [f64; 2] {
        let seen = |height: f64, distance: f64| degrees(atan2(height - altitude_m, distance.max(0.1)));
        let lowest = if self.low_m < altitude_m { self.near_m } else { self.far_m };
        let highest = if self.high_m < altitude_m { self.far_m } else { self.near_m };
        [seen(self.low_m, lowest), seen(self.high_m, highest)]
    }

    /// The tilt that has all of it in the middle of the beam, degrees; whole ones.
    #[must_use]
    pub fn tilt_deg(&self, altitude_m: f64) -> f64 {
        let [low, high] = self.elevations_deg(altitude_m);
        (0.5 * (low + high)).round().clamp(-STEEPEST_DEG, STEEPEST_DEG)
    }

    /// How high a beam it takes, degrees.
    #[must_use]
    pub fn span_deg(&self, altitude_m: f64) -> f64 {
        let [low, high] = self.elevations_deg(altitude_m);
        high - low
    }

    /// The longest way to any of it, metres.
    #[must_use]
    pub fn slant_m(&self, altitude_m: f64) -> f64 {
        let height = (self.low_m - altitude_m).abs().max((self.high_m - altitude_m).abs());
        (self.far_m * self.far_m + height * height).sqrt()
    }

    /// How far behind the farthest of it a shadow falls on the bottom, metres of slant range.
    #[must_use]
    pub fn shadow_m(&self, altitude_m: f64, height_m: f64) -> f64 {
        // A thing as high as the sonar throws its shadow without end: what matters is that some of it is seen.
        let over = (altitude_m - height_m).max(0.3 * altitude_m);
        (self.far_m * height_m / over.max(0.1)).min(SHADOW * self.far_m)
    }
}

/// Distance in plan of what is so far off by sound and so much lower, metres; `None` where it is lower than that.
#[must_use]
pub fn plan_m(slant_m: f64, below_m: f64) -> Option<f64> {
    let left = slant_m * slant_m - below_m * below_m;
    let least = slant_m * cos(radians(STEEPEST_DEG));
    (left >= least * least).then(|| left.sqrt())
}

/// Slant range at a distance in plan, metres.
#[must_use]
pub fn slant_m(plan_m: f64, below_m: f64) -> f64 {
    (plan_m * plan_m + below_m * below_m).sqrt()
}

/// Distance in plan at which a tilt looks at what is so much lower, metres.
#[must_use]
pub fn reach_of_tilt_m(tilt_deg: f64, below_m: f64) -> Option<f64> {
    (tilt_deg < -1.0 && below_m > 0.0).then(|| below_m / tan(radians(-tilt_deg)))
}

/// Distance from which a fan sees a whole disc, metres.
#[must_use]
pub fn fan_distance_m(disc_m: f64, azimuth_deg: f64) -> f64 {
    disc_m / sin(radians((0.45 * azimuth_deg).min(90.0)))
}

/// Radius of the disc that a fan sees from a distance, metres.
#[must_use]
pub fn disc_in_fan_m(distance_m: f64, azimuth_deg: f64) -> f64 {
    distance_m * sin(radians((0.45 * azimuth_deg).min(90.0)))
}

/// How far from the middle of a circle anything is seen from it, looking inwards, metres.
#[must_use]
pub fn reach_from_orbit_m(radius_m: f64, range_m: f64, azimuth_deg: f64) -> f64 {
    let half = radians((0.5 * azimuth_deg).min(180.0));
    let across = radius_m * radius_m + range_m * range_m - 2.0 * radius_m * range_m * cos(half);
    across.sqrt().max((range_m - radius_m).abs()).max(radius_m)
}

/// A number for people: two figures, of what is below one metre the second decimal.
#[must_use]
pub fn round(value: f64) -> f64 {
    let step = match value.abs() {
        0.0..1.0 => 0.05,
        1.0..10.0 => 0.1,
        10.0..30.0 => 0.5,
        30.0..100.0 => 1.0,
        _ => 5.0,
    };
    // Through hundredths, so that 0.1 is 0.1.
    ((value / step).round() * step * 100.0).round() / 100.0
}

/// Half the angle under which a disc is seen, degrees.
#[must_use]
pub fn half_angle_deg(disc_m: f64, distance_m: f64) -> f64 {
    degrees(asin((disc_m / distance_m.max(1e-6)).clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_grow_with_sizes() {
        assert!((distance_m(1.0) - 6.0).abs() < 1e-12);
        assert!((2.3..2.5).contains(&distance_m(0.115)) && (4.8..5.1).contains(&distance_m(0.63)));
        assert!((22.0..25.0).contains(&distance_m(25.9)));
        // Bottles and a ladder are seen from where a bucket would be; with a ship, from where the ship is whole.
        assert!((5.0..6.0).contains(&distance_of_all_m([0.23, 3.0])));
        assert!((distance_of_all_m([0.6, 26.0]) - 23.4).abs() < 1e-9);
    }

    #[test]
    fn a_tilt_looks_at_the_middle() {
        // 2 m over the middle of a thing 5 m ahead: atan(2/5) = 21.8°.
        let thing = Sight { near_m: 5.0, far_m: 5.0, low_m: 0.3, high_m: 0.3 };
        assert_eq!((thing.tilt_deg(2.3), thing.span_deg(2.3)), (-22.0, 0.0));
        assert!((thing.slant_m(2.3) - 29.0_f64.sqrt()).abs() < 1e-12);
        // From 2 to 8 m, from 2 m up: −45° to −14°.
        let field = Sight { near_m: 2.0, far_m: 8.0, low_m: 0.0, high_m: 0.0 };
        assert!((field.span_deg(2.0) - 30.963_756_532_073_53).abs() < 1e-9);
        // Above the sonar the near is the highest.
        let buoy = Sight { near_m: 2.0, far_m: 8.0, low_m: 0.0, high_m: 4.0 };
        assert_eq!(buoy.elevations_deg(2.0), [-45.0, 45.0]);
    }

    #[test]
    fn what_is_3_m_off_is_3_m_off() {
        let plan = plan_m(3.0, 1.0).expect("not steep");
        assert!((slant_m(plan, 1.0) - 3.0).abs() < 1e-12);
        assert_eq!(plan_m(3.0, 3.5), None);
        assert!((reach_of_tilt_m(-45.0, 2.0).expect("down") - 2.0).abs() < 1e-12);
        assert_eq!(reach_of_tilt_m(0.0, 2.0), None);
    }

    #[test]
    fn fans_and_discs() {
        assert!((disc_in_fan_m(fan_distance_m(2.0, 28.0), 28.0) - 2.0).abs() < 1e-12);
        assert!((half_angle_deg(1.0, 2.0) - 30.0).abs() < 1e-9);
        // A full turn sees as far as it can on the other side; a thin beam what is straight ahead.
        assert!((reach_from_orbit_m(5.0, 12.0, 360.0) - 17.0).abs() < 1e-9);
        assert!((reach_from_orbit_m(5.0, 12.0, 1e-6) - 7.0).abs() < 1e-6);
    }

    #[test]
    fn numbers_for_people() {
        assert_eq!([0.123, 4.567, 12.34, 77.7, 333.0].map(round), [0.1, 4.6, 12.5, 78.0, 335.0]);
    }
}
