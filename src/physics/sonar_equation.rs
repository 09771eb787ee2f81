//! The active sonar equation: levels of echo, reverberation and noise at the receiver.
//!
//! Takes strengths and absorption as given. Levels are dB re 1 µPa, ranges m.

use super::levels::band_level_db;
use crate::math::real::{asin, cos, db_from_power, log10};

/// One-way transmission loss, dB: spherical spreading and absorption, `20·log R + α·R`; α in dB/m.
///
/// Source: Urick (1983), ch. 5.
#[must_use]
pub fn transmission_loss_db(range_m: f64, absorption_db_per_m: f64) -> f64 {
    20.0 * log10(range_m) + absorption_db_per_m * range_m
}

/// What an active sonar brings into the equation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// Source level SL, dB re 1 µPa at 1 m.
    pub source_db: f64,
    /// Spectrum level NL of the noise, dB re 1 µPa²/Hz.
    pub noise_db: f64,
    /// Directivity index DI of the receiver, dB.
    pub directivity_db: f64,
    /// Bandwidth B of the receiver, Hz.
    pub bandwidth_hz: f64,
    /// Processing gain PG of a coded pulse (10·log of bandwidth × duration), dB.
    pub processing_db: f64,
}

impl Levels {
    /// Level of an echo, `SL − 2·TL + TS`. Source: Urick (1983), ch. 2.
    #[must_use]
    pub fn echo_db(&self, transmission_loss_db: f64, target_strength_db: f64) -> f64 {
        self.source_db - 2.0 * transmission_loss_db + target_strength_db
    }

    /// Level of the noise in the receiver's band and beam, `NL − DI + 10·log B`. Source: Urick (1983), ch. 2.
    #[must_use]
    pub fn noise_level_db(&self) -> f64 {
        band_level_db(self.noise_db, self.bandwidth_hz) - self.directivity_db
    }

    /// Signal-to-noise ratio of an echo, `SL − 2·TL + TS − (NL − DI + 10·log B) + PG` dB. Source: Urick (1983), ch. 2.
    #[must_use]
    pub fn snr_db(&self, transmission_loss_db: f64, target_strength_db: f64) -> f64 {
        self.echo_db(transmission_loss_db, target_strength_db) - self.noise_level_db() + self.processing_db
    }
}

/// Grazing angle at which a slant range meets level seabed, rad: `asin(H/R)`; none for ranges short of the altitude.
///
/// Source: plane geometry.
#[must_use]
pub fn seabed_grazing_rad(altitude_m: f64, slant_range_m: f64) -> Option<f64> {
    (slant_range_m >= altitude_m).then(|| asin(altitude_m / slant_range_m))
}

/// Area of level seabed in a resolution cell, m²: `R·φ·Δr/cos γ`, Δr = c/2B the resolution in slant range.
///
/// For grazing angles away from the vertical, where the cell is a disc instead. Source: Urick (1983), ch. 8.
#[must_use]
pub fn seabed_cell_area_m2(slant_range_m: f64, beam_rad: f64, resolution_m: f64, grazing_rad: f64) -> f64 {
    slant_range_m * beam_rad * resolution_m / cos(grazing_rad)
}

/// Target strength of a patch of seabed, `S_b + 10·log A`. Source: Urick (1983), ch. 8.
#[must_use]
pub fn seabed_strength_db(backscatter_db: f64, area_m2: f64) -> f64 {
    backscatter_db + db_from_power(area_m2)
}

/// Target strength of a volume of water, `S_v + 10·log(R²·Ψ·Δr)`: Ψ the equivalent two-way beam angle in sr, Δr = c/2B.
///
/// Source: Urick (1983), ch. 8.
#[must_use]
pub fn volume_strength_db(backscatter_db: f64, range_m: f64, beam_sr: f64, resolution_m: f64) -> f64 {
    backscatter_db + db_from_power(range_m * range_m * beam_sr * resolution_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::{degrees, radians};
    use crate::physics::levels::lambert_strength_db;

    const SONAR: Levels =
        Levels { source_db: 205.0, noise_db: 42.5, directivity_db: 30.0, bandwidth_hz: 1e5, processing_db: 0.0 };

    #[test]
    fn seabed_reverberation_at_ten_metres() {
        let grazing = seabed_grazing_rad(2.0, 10.0).unwrap();
        assert!((degrees(grazing) - 11.537).abs() < 1e-3);
        let area = seabed_cell_area_m2(10.0, radians(1.0), 0.0075, grazing);
        let strength = seabed_strength_db(lambert_strength_db(-18.0, grazing), area);
        let level = SONAR.echo_db(transmission_loss_db(10.0, 0.222_32), strength);
        assert!((level - 99.8322).abs() < 1e-3, "{level}");
        assert!((SONAR.noise_level_db() - 62.5).abs() < 1e-9);
        assert!((SONAR.snr_db(transmission_loss_db(10.0, 0.222_32), strength) - 37.3322).abs() < 1e-3);
    }

    #[test]
    fn no_seabed_is_nearer_than_the_altitude() {
        assert_eq!(seabed_grazing_rad(2.0, 1.9), None);
        assert!((degrees(seabed_grazing_rad(2.0, 2.0).unwrap()) - 90.0).abs() < 1e-9);
    }

    #[test]
    fn a_volume_grows_with_the_square_of_range() {
        let [near, far] = [10.0, 100.0].map(|range| volume_strength_db(-60.0, range, 0.01, 0.0075));
        assert!((far - near - 20.0).abs() < 1e-12);
    }
}
