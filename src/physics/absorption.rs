//! How water absorbs sound.

use crate::math::real::{exp, pow};
use crate::physics::Water;

/// Absorption in sea water after Francois & Garrison, dB/km: boric acid, magnesium sulphate and pure water.
///
/// `frequency_khz` in kHz. Stated for 0.2–1000 kHz; above, the viscous term's f² law carries on.
/// Source: Francois & Garrison (1982), J. Acoust. Soc. Am. 72:1879–1890, eqs. 3–12.
#[must_use]
pub fn francois_garrison_db_per_km(frequency_khz: f64, water: &Water) -> f64 {
    let Water { temperature_c: t, salinity_ppt: s, ph, depth_m: z } = *water;
    let f2 = frequency_khz * frequency_khz;
    let kelvin = t + 273.0;
    let c = 1412.0 + 3.21 * t + 1.19 * s + 0.0167 * z;

    let boric_f = 2.8 * (s / 35.0).sqrt() * pow(10.0, 4.0 - 1245.0 / kelvin);
    let boric = 8.86 / c * pow(10.0, 0.78 * ph - 5.0);

    let sulphate_f = 8.17 * pow(10.0, 8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (s - 35.0));
    let sulphate = 21.44 * s / c * (1.0 + 0.025 * t) * (1.0 - 1.37e-4 * z + 6.2e-9 * z * z);

    let viscous = if t <= 20.0 {
        4.937e-4 - 2.59e-5 * t + 9.11e-7 * t * t - 1.5e-8 * t * t * t
    } else {
        3.964e-4 - 1.146e-5 * t + 1.45e-7 * t * t - 6.5e-10 * t * t * t
    } * (1.0 - 3.83e-5 * z + 4.9e-10 * z * z);

    relaxation(boric, boric_f, f2) + relaxation(sulphate, sulphate_f, f2) + viscous * f2
}

/// Absorption in sea water after Ainslie & McColm, dB/km; within 10 % of Francois & Garrison for 0.1–1000 kHz.
///
/// Source: Ainslie & McColm (1998), J. Acoust. Soc. Am. 103:1671–1672.
#[must_use]
pub fn ainslie_mccolm_db_per_km(frequency_khz: f64, water: &Water) -> f64 {
    let Water { temperature_c: t, salinity_ppt: s, ph, depth_m } = *water;
    let (f2, z_km) = (frequency_khz * frequency_khz, depth_m / 1000.0);
    let boric_f = 0.78 * (s / 35.0).sqrt() * exp(t / 26.0);
    let sulphate_f = 42.0 * exp(t / 17.0);
    let boric = 0.106 * exp((ph - 8.0) / 0.56);
    let sulphate = 0.52 * (1.0 + t / 43.0) * (s / 35.0) * exp(-z_km / 6.0);
    let viscous = 0.000_49 * exp(-(t / 27.0 + z_km / 17.0));
    relaxation(boric, boric_f, f2) + relaxation(sulphate, sulphate_f, f2) + viscous * f2
}

/// A relaxing constituent: `a·f₁·f²/(f₁² + f²)`; nothing where its relaxation frequency is 0 (no salt).
fn relaxation(a: f64, relaxation_khz: f64, f2: f64) -> f64 {
    if relaxation_khz > 0.0 { a * relaxation_khz * f2 / (relaxation_khz * relaxation_khz + f2) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLD_SEA: Water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 0.0 };

    #[test]
    fn published_values_at_10_khz() {
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}");
        close(francois_garrison_db_per_km(10.0, &COLD_SEA), 0.962_637);
        close(ainslie_mccolm_db_per_km(10.0, &COLD_SEA), 0.986_572);
    }

    #[test]
    fn fresh_water_keeps_only_the_viscous_part() {
        let fresh = Water { salinity_ppt: 0.0, ..COLD_SEA };
        let viscous = (4.937e-4 - 2.59e-4 + 9.11e-5 - 1.5e-5) * 1e6;
        assert!((francois_garrison_db_per_km(1000.0, &fresh) - viscous).abs() < 1e-9);
    }
}
