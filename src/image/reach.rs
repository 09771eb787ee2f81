//! How far a sonar sees at best: where the seabed's echo drowns in thermal noise, that of the electronics left out.

use super::Channel;
use crate::math::real::{power_from_db, radians};
use crate::physics::numeric::crossing;

/// Backscattering strength of the seabed that reach is told for, dB: sand at some ten degrees of grazing.
pub const REACH_SEABED_DB: f64 = -30.0;

impl Channel {
    /// Slant range at which the echo of a beam's and a pulse's footprint on a seabed of [`REACH_SEABED_DB`] is as loud as
    /// the thermal noise, metres.
    ///
    /// `S_b·φ·(c/2B)·10^(−2αR/10) / R³ = N`, powers relative to the source's at 1 m. Source: the sonar equation, Urick (1983), ch. 2.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        let footprint = power_from_db(REACH_SEABED_DB) * radians(self.beam_width_deg) * self.pulse_m;
        let heard = |range: f64| {
            let loss = power_from_db(-2.0 * self.absorption_db_per_m * range) / (range * range * range);
            footprint * loss > self.noise_power
        };
        crossing(1e-3, 1e7, heard)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Water;

    #[test]
    fn at_the_reach_echo_and_noise_are_level() {
        let channel = Channel {
            absorption_db_per_m: 0.2,
            gain_absorption_db_per_m: 0.2,
            volume_per_m: 0.0,
            noise_power: 1e-14,
            beam_width_deg: 1.0,
            pulse_m: 0.0075,
            frequency_khz: 750.0,
            water: Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 },
            wavelength_m: 0.002,
            bandwidth_hz: 1e5,
            source_level_db: 210.0,
        };
        let range = channel.reach_m();
        // −30 dB − 17.58 dB − 21.25 dB − 30 log R − 0.4 R = −140 dB.
        let level = -30.0 + 10.0 * crate::math::real::log10(radians(1.0) * 0.0075)
            - 30.0 * crate::math::real::log10(range)
            - 0.4 * range;
        assert!((level + 140.0).abs() < 0.01, "{range} m: {level} dB");
    }
}
