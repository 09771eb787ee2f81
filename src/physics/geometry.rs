//! Plane geometry of a sonar over level seabed: shadows, footprint, bent rays, second paths.

use super::stated::Stated;
use crate::math::real::{atan2, sin};

/// A box on level seabed, as its shadow sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// Height of the sonar above the seabed, m.
    pub altitude_m: f64,
    /// Height of the box, m.
    pub height_m: f64,
    /// Ground range of its far upper edge, m.
    pub ground_range_m: f64,
}

/// The shadow behind an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// Ground range of its end, m.
    pub end_ground_m: f64,
    /// Length on the ground, m.
    pub length_ground_m: f64,
    /// Slant range of the edge that casts it, m.
    pub edge_slant_m: f64,
    /// Slant range of its end, m.
    pub end_slant_m: f64,
    /// Length in slant range, m, as an image shows it.
    pub length_slant_m: f64,
}

impl Obstacle {
    /// The shadow behind the box: on the ground it is `x·h/(H − h)` long. None where the box is as high as the sonar: the
    /// shadow has no end. Source: similar triangles; Blondel (2009), The Handbook of Sidescan Sonar, ch. 2.
    #[must_use]
    pub fn shadow(&self) -> Option<Shadow> {
        let Self { altitude_m, height_m, ground_range_m } = *self;
        if height_m >= altitude_m {
            return None;
        }
        let length_ground_m = ground_range_m * height_m / (altitude_m - height_m);
        let end_ground_m = ground_range_m + length_ground_m;
        let edge_slant_m = hypotenuse(ground_range_m, altitude_m - height_m);
        let end_slant_m = hypotenuse(end_ground_m, altitude_m);
        Some(Shadow {
            end_ground_m,
            length_ground_m,
            edge_slant_m,
            end_slant_m,
            length_slant_m: end_slant_m - edge_slant_m,
        })
    }
}

/// Height of what cast a shadow, m: `H·L/R`, length and end both along the ground or both in slant range.
///
/// Source: as [`Obstacle::shadow`].
#[must_use]
pub fn height_from_shadow_m(altitude_m: f64, shadow_length_m: f64, shadow_end_m: f64) -> f64 {
    altitude_m * shadow_length_m / shadow_end_m
}

/// Slant ranges at which the lower and upper edge of a vertical beam meet level seabed, m: `H/sin(tilt ± aperture/2)`.
///
/// Tilt down and aperture in rad. None for an edge at or above the horizon: it never meets the seabed. A beam that looks
/// straight down meets it first at its altitude. Source: plane geometry.
#[must_use]
pub fn footprint_m(altitude_m: f64, tilt_down_rad: f64, aperture_rad: f64) -> [Option<f64>; 2] {
    let meets = |down: f64| {
        let steepest = down.min(std::f64::consts::FRAC_PI_2);
        // An edge is at the horizon when rounding is all that keeps it below.
        (steepest > 1e-12).then(|| altitude_m / sin(steepest))
    };
    [meets(tilt_down_rad + 0.5 * aperture_rad), meets(tilt_down_rad - 0.5 * aperture_rad)]
}

/// How far a ray that starts level is bent off a straight line, m: `x²·g/(2c)`, towards the slower water; g = dc/dz in 1/s.
///
/// The arc has radius c/g; the parabola is short of it by (x·g/2c)², 2.3 % at the stated limit x·g/c = 0.3.
/// Source: Urick (1983), ch. 5, constant gradient.
pub fn refraction_offset_m(range_m: f64, gradient_per_s: f64, sound_speed_m_s: f64) -> Stated<f64> {
    let turn = range_m * gradient_per_s / sound_speed_m_s;
    Stated::new(0.5 * range_m * turn, &[("range over radius of curvature", turn.abs(), 0.0, 0.3)])
}

/// Two-way ranges by way of a mirror: the sea surface or the seabed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Multipath {
    /// Range of the target, m.
    pub direct_m: f64,
    /// Range of the ghost that goes one way direct and one way by the mirror, m.
    pub mixed_m: f64,
    /// Range of the ghost that goes both ways by the mirror, m.
    pub double_m: f64,
    /// Angle from the horizontal at which the mirrored path arrives, rad: towards the mirror.
    pub arrival_rad: f64,
}

/// Ranges of a target and its ghosts in a level mirror. `sonar_m` and `target_m` are distances from the mirror (depths for
/// the surface, heights for the seabed), all in m.
///
/// Source: image source; Brekhovskikh & Lysanov (2003), ch. 4.
#[must_use]
pub fn multipath(sonar_m: f64, target_m: f64, ground_range_m: f64) -> Multipath {
    let direct_m = hypotenuse(ground_range_m, target_m - sonar_m);
    let double_m = hypotenuse(ground_range_m, target_m + sonar_m);
    Multipath {
        direct_m,
        mixed_m: 0.5 * (direct_m + double_m),
        double_m,
        arrival_rad: atan2(target_m + sonar_m, ground_range_m),
    }
}

fn hypotenuse(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::{degrees, radians};

    #[test]
    fn a_shadow_tells_the_height_of_what_cast_it() {
        let obstacle = Obstacle { altitude_m: 2.0, height_m: 0.5, ground_range_m: 8.0 };
        let shadow = obstacle.shadow().unwrap();
        assert!((shadow.length_ground_m - 2.666_67).abs() < 1e-5);
        assert!((shadow.length_slant_m - 2.713_14).abs() < 1e-5);
        for (length, end) in
            [(shadow.length_ground_m, shadow.end_ground_m), (shadow.length_slant_m, shadow.end_slant_m)]
        {
            assert!((height_from_shadow_m(2.0, length, end) - 0.5).abs() < 1e-12);
        }
        assert_eq!(Obstacle { height_m: 2.0, ..obstacle }.shadow(), None);
    }

    #[test]
    fn a_beam_that_looks_above_the_horizon_has_no_last_range() {
        let [first, last] = footprint_m(2.0, radians(15.0), radians(20.0));
        assert!((first.unwrap() - 4.7324).abs() < 1e-4 && (last.unwrap() - 22.9474).abs() < 1e-4);
        assert_eq!(footprint_m(3.0, radians(10.0), radians(20.0))[1], None);
        assert_eq!(footprint_m(3.0, radians(-30.0), radians(20.0)), [None, None]);
        assert_eq!(footprint_m(3.0, radians(85.0), radians(20.0))[0], Some(3.0));
    }

    #[test]
    fn the_parabola_keeps_to_the_arc_within_its_range() {
        let near = refraction_offset_m(50.0, 1.0, 1500.0);
        let arc = 1500.0 - (1500.0_f64 * 1500.0 - 2500.0).sqrt();
        assert!(near.is_within() && (near.value / arc - 1.0).abs() < 1e-3);
        assert!(!refraction_offset_m(600.0, 1.0, 1500.0).is_within());
    }

    #[test]
    fn ghosts_lie_behind_their_target() {
        let ghost = multipath(3.0, 4.0, 10.0);
        assert!((ghost.direct_m - 10.0499).abs() < 1e-4);
        assert!((ghost.mixed_m - 11.1282).abs() < 1e-4);
        assert!((ghost.double_m - 12.2066).abs() < 1e-4);
        assert!((degrees(ghost.arrival_rad) - 34.992).abs() < 1e-3);
    }
}
