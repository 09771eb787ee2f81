//! How water absorbs sound.
//!
//! Knows nothing of what floats in the water: suspended sediment has equations of its own.

use serde::{Deserialize, Serialize};

use crate::math::real::{exp, pow, power_from_db};
use crate::physics::{Stated, Water};

/// What absorbs sound in the sea, dB/km each.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Absorption {
    /// Relaxation of boric acid, felt below 10 kHz.
    pub boric_acid: f64,
    /// Relaxation of magnesium sulphate, felt at 10–500 kHz.
    pub magnesium_sulphate: f64,
    /// Viscosity of the water itself, felt above.
    pub viscous: f64,
}

impl Absorption {
    /// All parts together, dB/km.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.boric_acid + self.magnesium_sulphate + self.viscous
    }
}

/// Absorption in sea water after Francois & Garrison, dB/km, in its parts. The default model.
///
/// `frequency_khz` in kHz. Within 5 % for 0.2–1000 kHz: up to 500 kHz at −2–22 °C, 30–35 ppt, 0–3500 m, above at
/// 0–30 °C, 0–40 ppt, 0–10 km. Beyond 1000 kHz the viscous term's f² law carries on.
/// Source: Francois & Garrison (1982), J. Acoust. Soc. Am. 72:1879–1890, eqs. 3–12.
pub fn francois_garrison(frequency_khz: f64, water: &Water) -> Stated<Absorption> {
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

    let parts = Absorption {
        boric_acid: relaxation(boric, boric_f, f2),
        magnesium_sulphate: relaxation(sulphate, sulphate_f, f2),
        viscous: viscous * f2,
    };
    let (temperature, salinity, depth) = if frequency_khz <= 500.0 {
        ((-2.0, 22.0), (30.0, 35.0), 3500.0)
    } else {
        ((0.0, 30.0), (0.0, 40.0), 10_000.0)
    };
    Stated::new(
        parts,
        &[
            ("frequency, kHz", frequency_khz, 0.2, 1000.0),
            ("temperature, °C", t, temperature.0, temperature.1),
            ("salinity, ppt", s, salinity.0, salinity.1),
            ("depth, m", z, 0.0, depth),
        ],
    )
}

/// Absorption in sea water after Ainslie & McColm, dB/km, in its parts.
///
/// `frequency_khz` in kHz. Within 10 % of Francois & Garrison for 0.1–1000 kHz at −6–35 °C, 5–50 ppt, pH 7.7–8.3, 0–7 km;
/// beyond 1000 kHz the viscous term's f² law carries on.
/// Source: Ainslie & McColm (1998), J. Acoust. Soc. Am. 103:1671–1672.
pub fn ainslie_mccolm(frequency_khz: f64, water: &Water) -> Stated<Absorption> {
    let Water { temperature_c: t, salinity_ppt: s, ph, depth_m } = *water;
    let (f2, z_km) = (frequency_khz * frequency_khz, depth_m / 1000.0);
    let boric_f = 0.78 * (s / 35.0).sqrt() * exp(t / 26.0);
    let sulphate_f = 42.0 * exp(t / 17.0);
    let boric = 0.106 * exp((ph - 8.0) / 0.56);
    let sulphate = 0.52 * (1.0 + t / 43.0) * (s / 35.0) * exp(-z_km / 6.0);
    let viscous = 0.000_49 * exp(-(t / 27.0 + z_km / 17.0));
    let parts = Absorption {
        boric_acid: relaxation(boric, boric_f, f2),
        magnesium_sulphate: relaxation(sulphate, sulphate_f, f2),
        viscous: viscous * f2,
    };
    Stated::new(
        parts,
        &[
            ("frequency, kHz", frequency_khz, 0.1, 1000.0),
            ("temperature, °C", t, -6.0, 35.0),
            ("salinity, ppt", s, 5.0, 50.0),
            ("pH", ph, 7.7, 8.3),
            ("depth, m", depth_m, 0.0, 7000.0),
        ],
    )
}

/// Intensity left after a path through water that absorbs, `10^(−α·d/10)`: α in dB/m, d in m (twice the range for an echo).
///
/// Source: definition of the decibel per metre; Urick (1983), ch. 5.
#[must_use]
pub fn transmission(absorption_db_per_m: f64, path_m: f64) -> f64 {
    power_from_db(-absorption_db_per_m * path_m)
}

/// Amplitude attenuation, Np/m, of an absorption in dB/m: 1 Np is 20·log e = 8.686 dB.
///
/// Source: definition of the neper, ISO 80000-8.
#[must_use]
pub fn nepers_from_db(db: f64) -> f64 {
    db / DB_PER_NEPER
}

/// Decibels a neper: 20·log e.
pub(crate) const DB_PER_NEPER: f64 = 20.0 * std::f64::consts::LOG10_E;

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
        close(francois_garrison(10.0, &COLD_SEA).value.total(), 0.962_637);
        close(ainslie_mccolm(10.0, &COLD_SEA).value.total(), 0.986_572);
    }

    #[test]
    fn fresh_water_keeps_only_the_viscous_part_and_ainslie_mccolm_says_it_is_outside() {
        let fresh = Water { salinity_ppt: 0.0, ..COLD_SEA };
        let viscous = (4.937e-4 - 2.59e-4 + 9.11e-5 - 1.5e-5) * 1e6;
        let francois = francois_garrison(1000.0, &fresh);
        assert!((francois.value.total() - viscous).abs() < 1e-9);
        assert!(francois.is_within());
        let ainslie = ainslie_mccolm(1000.0, &fresh);
        assert_eq!((ainslie.outside.len(), ainslie.outside[0].quantity), (1, "salinity, ppt"));
    }

    #[test]
    fn beyond_a_megahertz_both_say_so() {
        assert!(!francois_garrison(1200.0, &COLD_SEA).is_within());
        assert!(!ainslie_mccolm(1200.0, &COLD_SEA).is_within());
        assert!(francois_garrison(900.0, &COLD_SEA).is_within());
    }

    #[test]
    fn the_models_agree_within_ten_per_cent() {
        for frequency in [0.1, 1.0, 10.0, 100.0, 1000.0] {
            let [a, b] = [francois_garrison(frequency, &COLD_SEA), ainslie_mccolm(frequency, &COLD_SEA)];
            assert!((a.value.total() / b.value.total() - 1.0).abs() < 0.1, "{frequency} kHz");
        }
    }

    #[test]
    fn ten_decibels_leave_a_tenth() {
        assert!((transmission(0.5, 20.0) - 0.1).abs() < 1e-15);
        assert!((nepers_from_db(8.685_889_638) - 1.0).abs() < 1e-9);
    }
}
