//! Target strengths of simple shapes, dB re 1 m².
//!
//! Asymptotic forms for targets much larger than the wavelength, seen from the far field; `rigid_sphere` has one exact
//! solution. Inside of [`far_field_m`](super::array::far_field_m) a flat or long target answers with its first Fresnel zone
//! only: take the infinite cylinder there.

use super::stated::Stated;
use crate::math::real::{cos, db_from_power, sin};

/// Least value of ka that stands for the sources' "ka ≫ 1".
const LARGE_KA: f64 = 10.0;

/// Target strength of a large rigid sphere, `10·log(a²/4)`, whatever the wavelength: for ka ≫ 1, see
/// [`rigid_sphere_exact`](super::rigid_sphere::rigid_sphere_exact) below ka = 10. Radius in m.
///
/// Source: Urick (1983), table 9.1.
#[must_use]
pub fn rigid_sphere_db(radius_m: f64) -> f64 {
    db_from_power(0.25 * radius_m * radius_m)
}

/// A flat rectangular plate, turned about one of its sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// Side across the axis of turning, m: it gives the pattern.
    pub turned_m: f64,
    /// Side along the axis, m.
    pub along_m: f64,
}

impl Plate {
    /// Target strength, `20·log((ab/λ)·(sin β/β)·cos θ)` with β = k·a·sin θ, a the side that is turned; angle of incidence in rad.
    ///
    /// Stated for sides of many wavelengths (ka ≥ 10 here) and ranges beyond a²/λ. Source: Urick (1983), table 9.1.
    pub fn strength_db(&self, wavelength_m: f64, incidence_rad: f64) -> Stated<f64> {
        let k = wavenumber(wavelength_m);
        let amplitude = self.turned_m * self.along_m / wavelength_m
            * sinc(k * self.turned_m * sin(incidence_rad))
            * cos(incidence_rad);
        let smaller = self.turned_m.min(self.along_m);
        Stated::new(db_from_power(amplitude * amplitude), &[("ka", k * smaller, LARGE_KA, f64::INFINITY)])
    }
}

/// A cylinder seen from its side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Radius, m.
    pub radius_m: f64,
    /// Length, m.
    pub length_m: f64,
}

impl Cylinder {
    /// Target strength, `10·log((a·L²/2λ)·(sin β/β)²·cos²θ)` with β = k·L·sin θ, θ from broadside in rad.
    ///
    /// Stated for ka ≫ 1 (10 here) and ranges beyond L²/λ. Source: Urick (1983), table 9.1.
    pub fn strength_db(&self, wavelength_m: f64, incidence_rad: f64) -> Stated<f64> {
        let k = wavenumber(wavelength_m);
        let pattern = sinc(k * self.length_m * sin(incidence_rad)) * cos(incidence_rad);
        let broadside = self.radius_m * self.length_m * self.length_m / (2.0 * wavelength_m);
        let limits = [("ka", k * self.radius_m, LARGE_KA, f64::INFINITY)];
        Stated::new(db_from_power(broadside * pattern * pattern), &limits)
    }
}

/// Effective target strength of a thick cylinder without visible ends at a range, `10·log(a·r/2)`: for ranges short of L²/λ
/// and ka ≫ 1. Both in m. Source: Urick (1983), table 9.1.
#[must_use]
pub fn infinite_cylinder_db(radius_m: f64, range_m: f64) -> f64 {
    db_from_power(0.5 * radius_m * range_m)
}

/// Target strength of a Lambert sphere, `10·log(2πμa²/3)`. Source: `∫ μ·cos²θ dA` over the half that faces the sonar.
#[must_use]
pub fn lambert_sphere_db(mu: f64, radius_m: f64) -> f64 {
    db_from_power(2.0 / 3.0 * std::f64::consts::PI * mu * radius_m * radius_m)
}

/// Target strength of a Lambert disc, `10·log(μ·πa²·cos²θ)`; angle of incidence in rad.
///
/// Source: Lambert's law, Urick (1983), ch. 8, times the area.
#[must_use]
pub fn lambert_disc_db(mu: f64, radius_m: f64, incidence_rad: f64) -> f64 {
    let cosine = cos(incidence_rad);
    db_from_power(mu * std::f64::consts::PI * radius_m * radius_m * cosine * cosine)
}

fn wavenumber(wavelength_m: f64) -> f64 {
    2.0 * std::f64::consts::PI / wavelength_m
}

/// `sin x / x`.
pub(crate) fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-8 { 1.0 } else { sin(x) / x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::radians;

    #[test]
    fn published_strengths() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-3, "{a} {b}");
        close(rigid_sphere_db(0.1), -26.0206);
        close(Plate { turned_m: 0.3, along_m: 0.2 }.strength_db(0.00125, 0.0).value, 33.6248);
        close(Cylinder { radius_m: 0.05, length_m: 0.5 }.strength_db(0.00125, 0.0).value, 6.9897);
        close(infinite_cylinder_db(0.05, 2.0), -13.0103);
        close(lambert_sphere_db(0.1, 0.25), -18.8306);
        close(lambert_disc_db(0.1, 0.25, 0.0), -17.0697);
    }

    #[test]
    fn a_plate_of_a_few_wavelengths_is_outside() {
        let plate = Plate { turned_m: 0.01, along_m: 0.001 };
        assert!(!plate.strength_db(0.002, 0.0).is_within());
        assert!(!Cylinder { radius_m: 0.002, length_m: 1.0 }.strength_db(0.002, 0.0).is_within());
    }

    #[test]
    fn a_cylinder_has_its_first_null_at_half_a_wavelength_over_its_length() {
        let cylinder = Cylinder { radius_m: 0.05, length_m: 0.5 };
        let null = crate::math::real::asin(0.00125 / (2.0 * 0.5));
        assert!(cylinder.strength_db(0.00125, null).value < -100.0);
        assert!((lambert_disc_db(0.1, 0.25, radians(60.0)) - (-17.0697 - 6.0206)).abs() < 1e-3);
    }
}
