//! What motion and a wrong sound speed do to a ping.

use super::stated::Stated;
use crate::math::real::{asin, sin};

/// Time from ping to echo, s: `2R/c`. Source: definition of slant range.
#[must_use]
pub fn two_way_time_s(range_m: f64, sound_speed_m_s: f64) -> f64 {
    2.0 * range_m / sound_speed_m_s
}

/// How far a vehicle turns or moves between ping and echo: its rate (per s) times `2R/c`. The receive beams smear by it.
///
/// Source: kinematics.
#[must_use]
pub fn change_during_ping(rate_per_s: f64, range_m: f64, sound_speed_m_s: f64) -> f64 {
    rate_per_s * two_way_time_s(range_m, sound_speed_m_s)
}

/// Doppler shift of an echo, Hz, for a closing speed in m/s: `2·v·f/c`. Stated for |v| up to 1 % of c, where it is within 1 %
/// of the exact `f·((c + v)/(c − v) − 1)`. Source: Urick (1983), ch. 8.
pub fn doppler_hz(closing_m_s: f64, frequency_hz: f64, sound_speed_m_s: f64) -> Stated<f64> {
    let mach = closing_m_s / sound_speed_m_s;
    Stated::new(2.0 * mach * frequency_hz, &[("closing speed over sound speed", mach.abs(), 0.0, 0.01)])
}

/// Bearing that an array steered by delays reports, less the true one, rad, where its sound speed is wrong by a fraction:
/// `sin θ′ = (1 + e)·sin θ`. Range errs by the same fraction. None where no real angle answers.
///
/// Source: Lurton (2002), An Introduction to Underwater Acoustics, ch. 5.
#[must_use]
pub fn bearing_error_rad(true_bearing_rad: f64, relative_speed_error: f64) -> Option<f64> {
    let sine = (1.0 + relative_speed_error) * sin(true_bearing_rad);
    (sine.abs() <= 1.0).then(|| asin(sine) - true_bearing_rad)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::{degrees, radians};

    #[test]
    fn a_ping_of_ten_metres() {
        assert!((two_way_time_s(10.0, 1500.0) - 0.013_333).abs() < 1e-6);
        assert!((change_during_ping(30.0, 10.0, 1500.0) - 0.4).abs() < 1e-12);
        let shift = doppler_hz(1.0, 1.2e6, 1500.0);
        assert!((shift.value - 1600.0).abs() < 1e-9 && shift.is_within());
        assert!(!doppler_hz(100.0, 1.2e6, 1500.0).is_within());
    }

    #[test]
    fn bearing_errors_grow_towards_the_end_of_the_line() {
        assert!((degrees(bearing_error_rad(radians(30.0), 0.01).unwrap()) - 0.331_35).abs() < 1e-4);
        assert!((degrees(bearing_error_rad(radians(-60.0), 0.01).unwrap()) + 1.0078).abs() < 1e-3);
        assert_eq!(bearing_error_rad(radians(89.0), 0.02), None);
    }
}
