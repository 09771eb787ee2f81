//! The absorption of the DeepSonar paper as printed, for comparison with images made by its letter.
//!
//! Nothing else calls these; the corrected equations are [`ainslie_mccolm`] and
//! [`transmission`](super::absorption::transmission).

use super::absorption::{Absorption, ainslie_mccolm};
use super::water::Water;
use crate::math::real::exp;

/// The unit in which the printed equations (6) and (8) take depth: the paper does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthUnit {
    /// Kilometres, as in Ainslie & McColm.
    Kilometres,
    /// Metres: it wipes out the magnesium sulphate of all but the shallowest water.
    Metres,
}

/// Ainslie & McColm's absorption as the DeepSonar paper prints it, dB/km, in its parts.
///
/// Two faults against the original: eq. (8) has `e^(+(T/27 + z/17))` in the viscous part, so that warm water absorbs more,
/// and the unit of z is not given. Source: the DeepSonar paper, eqs. 6 and 8, against Ainslie & McColm (1998).
#[must_use]
pub fn absorption_as_printed(frequency_khz: f64, water: &Water, unit: DepthUnit) -> Absorption {
    let z = match unit {
        DepthUnit::Kilometres => water.depth_m / 1000.0,
        DepthUnit::Metres => water.depth_m,
    };
    let as_if_km = Water { depth_m: 1000.0 * z, ..*water };
    let correct = ainslie_mccolm(frequency_khz, &as_if_km).value;
    let sign = exp(2.0 * (water.temperature_c / 27.0 + z / 17.0));
    Absorption { viscous: correct.viscous * sign, ..correct }
}

/// Intensity left after a path as eq. (9) prints it, `e^(−0.023·α·d)`: α dB/km, d km. Ten times too little in the exponent.
///
/// Source: the DeepSonar paper, eq. 9, against the definition of the decibel.
#[must_use]
pub fn transmission_as_printed(absorption_db_per_km: f64, path_km: f64) -> f64 {
    exp(-0.023 * absorption_db_per_km * path_km)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_equations_give_the_known_wrong_numbers() {
        let water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 };
        let total = |unit| absorption_as_printed(1200.0, &water, unit).total();
        assert!((total(DepthUnit::Kilometres) / 1070.8 - 1.0).abs() < 1e-3);
        assert!((total(DepthUnit::Metres) / 1849.5 - 1.0).abs() < 1e-3);
        assert!((transmission_as_printed(495.293, 0.02) - 0.7963).abs() < 1e-4);
    }
}
