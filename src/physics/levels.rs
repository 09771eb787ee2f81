//! Levels of the sonar equation.

use crate::math::real::log10;

/// Thermal noise spectrum level, dB re 1 µPa²/Hz: what a receiver hears above about 150 kHz.
///
/// `NL = −15 + 20·log f`, f in kHz. Source: Mellen (1952), J. Acoust. Soc. Am. 24:478–480; Urick (1983), ch. 7.
#[must_use]
pub fn thermal_noise_db(frequency_khz: f64) -> f64 {
    -15.0 + 20.0 * log10(frequency_khz)
}

/// Level of a noise spectrum in a band, dB re 1 µPa: `NL + 10·log B`, B in Hz.
#[must_use]
pub fn band_level_db(spectrum_level_db: f64, bandwidth_hz: f64) -> f64 {
    spectrum_level_db + 10.0 * log10(bandwidth_hz)
}

/// Time-varied gain, dB: `k·log R + 2αR` with k = 20 for volume, 30 for seabed, 40 for point echoes; α in dB/m, R in m.
///
/// Source: Urick (1983), ch. 2, inverse of the two-way transmission loss over the scattering geometry.
#[must_use]
pub fn time_varied_gain_db(per_decade_db: f64, absorption_db_per_m: f64, range_m: f64) -> f64 {
    per_decade_db * log10(range_m) + 2.0 * absorption_db_per_m * range_m
}

/// Lambert backscattering strength, dB: `S_b = 10·log μ + 20·log sin γ`, γ the grazing angle in radians.
///
/// Source: Urick (1983), ch. 8, after Mackenzie (1961).
#[must_use]
pub fn lambert_strength_db(lambert_db: f64, grazing_rad: f64) -> f64 {
    lambert_db + 20.0 * log10(crate::math::real::sin(grazing_rad))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::radians;

    #[test]
    fn published_levels() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 2e-3, "{a} {b}");
        close(thermal_noise_db(100.0), 25.0);
        close(band_level_db(25.0, 10_000.0), 65.0);
        close(lambert_strength_db(-27.0, radians(10.0)), -42.2066);
        close(time_varied_gain_db(40.0, 0.222_32, 1.0), 0.444_64);
    }
}
