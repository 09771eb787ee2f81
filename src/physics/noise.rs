//! Noise of the sea.
//!
//! `levels` has the thermal noise and bands; noise of vessels, rain and the platform is left out.

use super::levels::thermal_noise_db;
use super::stated::Stated;
use crate::math::real::{db_from_power, log10, power_from_db};

/// Noise of wind and waves, dB re 1 µPa²/Hz: `50 + 7.5·√w + 20·log f − 40·log(f + 0.4)`.
///
/// Frequency in kHz (0.1–100), wind speed in m/s (0–40). Above 100 kHz it falls by 20 dB a decade and thermal noise wins.
/// Source: Coates (1990), Underwater Acoustic Systems; Stojanovic (2007), Mobile Comput. Commun. Rev. 11(4):34–43.
pub fn wind_noise_db(frequency_khz: f64, wind_m_s: f64) -> Stated<f64> {
    let value = 50.0 + 7.5 * wind_m_s.max(0.0).sqrt() + 20.0 * log10(frequency_khz) - 40.0 * log10(frequency_khz + 0.4);
    Stated::new(value, &[("frequency, kHz", frequency_khz, 0.1, 100.0), ("wind speed, m/s", wind_m_s, 0.0, 40.0)])
}

/// Noise of wind and heat together, dB re 1 µPa²/Hz: powers add. Limits as [`wind_noise_db`].
///
/// Source: uncorrelated sources; Urick (1983), ch. 7.
pub fn ambient_noise_db(frequency_khz: f64, wind_m_s: f64) -> Stated<f64> {
    let thermal = power_from_db(thermal_noise_db(frequency_khz));
    wind_noise_db(frequency_khz, wind_m_s).map(|wind| db_from_power(thermal + power_from_db(wind)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wind_rules_below_and_heat_above() {
        let wind = wind_noise_db(100.0, 10.0);
        assert!((wind.value - 33.648).abs() < 1e-3 && wind.is_within());
        assert!((ambient_noise_db(1200.0, 10.0).value - thermal_noise_db(1200.0)).abs() < 0.01);
        let low = ambient_noise_db(10.0, 10.0);
        assert!((low.value - wind_noise_db(10.0, 10.0).value).abs() < 0.01);
        assert!(!ambient_noise_db(1200.0, 10.0).is_within());
    }
}
