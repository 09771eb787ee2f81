//! Lambert's law: the bound that energy sets, and the echoes of simple Lambert bodies in closed form.
//!
//! `levels::lambert_strength_db` is the law as a level. Knows no sediments by name and casts no rays.

use super::absorption::transmission;
use super::numeric::integral;
use crate::math::Impossible;
use crate::math::real::power_from_db;

/// The greatest Lambert coefficient μ: a surface that scatters all it receives. `∫ μ·cos θᵢ·cos θₛ dΩ = π·μ·cos θᵢ ≤ cos θᵢ`.
///
/// Source: conservation of energy; Urick (1983), ch. 8.
pub const MAX_LAMBERT_MU: f64 = std::f64::consts::FRAC_1_PI;

/// Lambert coefficient of a level `10·log μ` in dB.
///
/// # Errors
/// A level above −4.97 dB: such a surface would scatter more than it receives. Source: see [`MAX_LAMBERT_MU`].
pub fn lambert_mu(ten_log_mu_db: f64) -> Result<f64, Impossible> {
    let mu = power_from_db(ten_log_mu_db);
    let problem =
        format!("{ten_log_mu_db} dB is a Lambert coefficient of {mu:.3}, more than 1/π: it would make energy");
    Impossible::unless(mu <= MAX_LAMBERT_MU, "ten_log_mu_db", problem, "write −4.98 dB or less")?;
    Ok(mu)
}

/// Echo energy of a whole Lambert sphere for μ = 1, m⁻²: `∫ cos θ·10^(−2αr/10)/r² dΩ` over all that faces the sonar, which
/// is what rays of solid angle dΩ sum to. Radius and range of the centre in m, absorption in dB/m.
///
/// With t = cos θ: `2πa²/D · ∫₀¹ t²/(q·(q − at)²) dt`, q² = D² − a²(1 − t²), r = q − at.
/// Source: Lambert's law integrated over the sphere; far away it is 2πa²/(3D⁴).
///
/// # Errors
/// A sonar on or within the sphere, or a radius that is not positive.
pub fn sphere_energy(radius_m: f64, centre_range_m: f64, absorption_db_per_m: f64) -> Result<f64, Impossible> {
    let (a, d) = (radius_m, centre_range_m);
    let problem = format!("{a} m is no radius of a sphere whose centre is {d} m away");
    Impossible::unless(a > 0.0 && a < d, "radius_m", problem, "keep the sonar outside of the sphere")?;
    let sum = integral(0.0, 1.0, |t| {
        let q = (d * d - a * a * (1.0 - t * t)).sqrt();
        let range = q - a * t;
        t * t / (q * range * range) * transmission(absorption_db_per_m, 2.0 * range)
    });
    Ok(2.0 * std::f64::consts::PI * a * a / d * sum)
}

/// A range bin of a beam over level seabed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeabedBin {
    /// Height of the sonar above the seabed, m.
    pub altitude_m: f64,
    /// Slant range of the near edge, m.
    pub near_m: f64,
    /// Slant range of the far edge, m.
    pub far_m: f64,
    /// Width in azimuth, rad.
    pub azimuth_rad: f64,
}

/// Echo energy of a bin of level Lambert seabed for μ = 1, m⁻²: `φ·∫ (H/r)²·10^(−2αr/10)·r⁻³ dr`, absorption in dB/m.
///
/// Ranges short of the altitude meet no seabed and give nothing.
/// Source: Lambert's law with ρ·dρ = r·dr on level ground; without absorption `φ·H²/4·(r₁⁻⁴ − r₂⁻⁴)`.
#[must_use]
pub fn seabed_energy(bin: &SeabedBin, absorption_db_per_m: f64) -> f64 {
    let near = bin.near_m.max(bin.altitude_m);
    let far = bin.far_m.max(near);
    let squared = bin.altitude_m * bin.altitude_m;
    bin.azimuth_rad
        * integral(near, far, |r| squared / (r * r * r * r * r) * transmission(absorption_db_per_m, 2.0 * r))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::radians;

    #[test]
    fn more_than_all_is_refused() {
        assert!((lambert_mu(-27.0).unwrap() - 0.001_995).abs() < 1e-6);
        assert!(lambert_mu(-4.98).is_ok());
        let refused = lambert_mu(-4.9).unwrap_err();
        assert_eq!(refused.key, "ten_log_mu_db");
        assert!(lambert_mu(f64::NAN).is_err());
    }

    #[test]
    fn a_far_sphere_is_two_thirds_pi_a_squared() {
        let (a, d) = (1e-3, 10.0);
        let far = 2.0 * std::f64::consts::PI * a * a / 3.0 / (d * d * d * d);
        assert!((sphere_energy(a, d, 0.0).unwrap() / far - 1.0).abs() < 1e-3);
        assert!((sphere_energy(0.25, 5.0, 0.0).unwrap() / 0.000_226_488 - 1.0).abs() < 1e-5);
        assert!(sphere_energy(5.0, 5.0, 0.0).is_err());
    }

    #[test]
    fn a_bin_of_seabed_meets_its_closed_form_and_loses_to_absorption() {
        let bin = SeabedBin { altitude_m: 2.0, near_m: 5.0, far_m: 5.1, azimuth_rad: radians(1.0) };
        let closed = radians(1.0) * (1.0 / 625.0 - 1.0 / 676.5201);
        assert!((seabed_energy(&bin, 0.0) / closed - 1.0).abs() < 1e-9);
        let ratio = seabed_energy(&bin, 1.0) / seabed_energy(&bin, 0.0);
        assert!((ratio / transmission(1.0, 10.1) - 1.0).abs() < 1e-2);
        assert_eq!(seabed_energy(&SeabedBin { near_m: 0.5, far_m: 1.9, ..bin }, 0.0), 0.0);
    }
}
