//! Elementary functions with the same bits on every platform.
//!
//! `f32::sin`, `f64::ln` and their like call the system's library, whose last bits differ between systems.
//! These go to the pure-Rust `libm`. `+ − × ÷ √` need no help: IEEE 754 fixes their results.

pub use libm::{acos, acosh, asin, atan2, cos, cosh, erf, exp, lgamma, log as ln, log10, pow, sin, tan};
pub use libm::{cosf, log10f, logf as lnf, powf, sinf};

/// Degrees to radians.
#[must_use]
pub fn radians(degrees: f64) -> f64 {
    degrees * (std::f64::consts::PI / 180.0)
}

/// Radians to degrees.
#[must_use]
pub fn degrees(radians: f64) -> f64 {
    radians * (180.0 / std::f64::consts::PI)
}

/// Power ratio of a level in decibels: `10^(db/10)`.
#[must_use]
pub fn power_from_db(db: f64) -> f64 {
    pow(10.0, db / 10.0)
}

/// Level in decibels of a power ratio: `10·log10(power)`.
#[must_use]
pub fn db_from_power(power: f64) -> f64 {
    10.0 * log10(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decibels_and_angles_turn_back() {
        assert!((power_from_db(3.0) - 1.995_262_314_968_88).abs() < 1e-12);
        assert!((db_from_power(power_from_db(-57.25)) + 57.25).abs() < 1e-12);
        assert!((degrees(radians(73.5)) - 73.5).abs() < 1e-12);
    }
}
