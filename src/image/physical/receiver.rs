//! The receiver by range: noise, ringing, blanking, time-varied gain and the level at which it clips.
//!
//! Powers are relative to the source's at 1 m. Knows no directions: each value holds for a whole row of bins.

use serde::{Deserialize, Serialize};

use super::pulse::Pulse;
use crate::image::{Channel, Noise};
use crate::math::Impossible;
use crate::math::real::power_from_db;
use crate::physics::levels::time_varied_gain_db;
use crate::sonar::Grid;

/// A receiver beside what its bandwidth and directivity say.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Receiver {
    /// Looks averaged in a bin that is longer than the pulse, at most; 1 for a receiver that keeps one sample a bin.
    pub most_looks: u32,
    /// Noise of the electronics: how far it lifts the noise above the thermal noise of the water, dB.
    pub noise_figure_db: f64,
    /// Slant range up to which the receiver is off, metres.
    pub blanking_m: f64,
    /// The transducer's ringing after the pulse.
    pub ringing: Ringing,
    /// Greatest time-varied gain, dB.
    pub max_gain_db: f64,
    /// Steps in which the gain rises, dB; 0 for a gain without steps.
    pub gain_step_db: f64,
    /// Full scale of an element's converter above the rms of its noise at the greatest gain, dB: about 6 for each bit above it.
    pub full_scale_db: f64,
}

/// How a transducer rings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ringing {
    /// Level at the end of the pulse, as if it came through the water, dB re 1 µPa.
    pub level_db: f64,
    /// How fast it dies away, dB per metre of slant range.
    pub decay_db_per_m: f64,
}

/// What multiplies or adds up in the bins of a grid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Levels {
    /// Power of an echo after absorption both ways, over its energy in a cell.
    pub echo: Vec<f32>,
    /// Power of volume reverberation for each steradian of open water.
    pub volume: Vec<f32>,
    /// Power of noise and ringing in each direction.
    pub noise: Vec<f32>,
    /// Power of a quadrature of one element's noise that fills the converter; infinite without noise.
    pub full_scale: Vec<f64>,
}

impl Receiver {
    /// Refuses receivers that cannot be built.
    ///
    /// # Errors
    /// The first impossible figure, with its key.
    pub(super) fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("model.physical.receiver.most_looks", f64::from(self.most_looks), 1.0, 64.0)?;
        Impossible::outside("model.physical.receiver.noise_figure_db", self.noise_figure_db, 0.0, 60.0)?;
        Impossible::outside("model.physical.receiver.blanking_m", self.blanking_m, 0.0, 1000.0)?;
        Impossible::outside("model.physical.receiver.ringing.level_db", self.ringing.level_db, -200.0, 260.0)?;
        Impossible::outside("model.physical.receiver.ringing.decay_db_per_m", self.ringing.decay_db_per_m, 0.0, 1e6)?;
        Impossible::outside("model.physical.receiver.max_gain_db", self.max_gain_db, 0.0, 300.0)?;
        Impossible::outside("model.physical.receiver.gain_step_db", self.gain_step_db, 0.0, 60.0)?;
        Impossible::outside("model.physical.receiver.full_scale_db", self.full_scale_db, 0.0, 300.0)
    }

    /// Time-varied gain at a range, dB: `k·log R + 2αR`, no more than the receiver has, in its steps (rounded down).
    ///
    /// Source: `physics::levels::time_varied_gain_db`.
    #[must_use]
    pub fn gain_db(&self, per_decade_db: f64, absorption_db_per_m: f64, range_m: f64) -> f64 {
        let gain = time_varied_gain_db(per_decade_db, absorption_db_per_m, range_m).min(self.max_gain_db);
        if self.gain_step_db > 0.0 { (gain / self.gain_step_db).floor() * self.gain_step_db } else { gain }
    }

    /// Power of thermal and electronic noise in each direction, relative to the source's, behind the pulse's filter.
    pub(super) fn steady_noise(&self, pulse: &Pulse, channel: &Channel) -> f64 {
        channel.noise_power * pulse.noise_gain(channel.bandwidth_hz) * power_from_db(self.noise_figure_db)
    }

    /// The levels on a grid. `cell_gain` is the power of an even field over its energy in a cell of one direction and bin.
    pub(super) fn levels(&self, grid: &Grid, channel: &Channel, given: &Given<'_>) -> Levels {
        let mut levels = Levels { echo: vec![], volume: vec![], noise: vec![], full_scale: vec![] };
        let steady = self.steady_noise(given.pulse, channel);
        for bin in 0..grid.bins {
            let range = grid.range_m(bin);
            let on = if range < self.blanking_m { 0.0 } else { 1.0 };
            let noise = match given.noise {
                Noise::Heard => on * (steady + self.ringing_power(range, channel.source_level_db)),
                Noise::Silent => 0.0,
            };
            let echo = on * given.cell_gain * power_from_db(-2.0 * channel.absorption_db_per_m * range);
            levels.echo.push(echo as f32);
            levels.volume.push((echo * volume_energy(channel.volume_per_m, grid.bin_m(), range)) as f32);
            levels.noise.push(noise as f32);
            let gain = self.gain_db(given.tvg_db_per_decade, channel.gain_absorption_db_per_m, range);
            levels.full_scale.push(match given.noise {
                Noise::Heard => 0.5 * steady * power_from_db(self.full_scale_db + self.max_gain_db - gain),
                Noise::Silent => f64::INFINITY,
            });
        }
        levels
    }

    /// Power of the ringing at a range, relative to the source's: falls by a fixed number of decibels a metre.
    ///
    /// Source: Sherman & Butler (2007), Transducers and Arrays for Underwater Sound, ch. 2: free decay of a resonator.
    fn ringing_power(&self, range_m: f64, source_level_db: f64) -> f64 {
        power_from_db(self.ringing.level_db - self.ringing.decay_db_per_m * range_m - source_level_db)
    }
}

/// What the levels depend on beside grid and channel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Given<'a> {
    pub pulse: &'a Pulse,
    pub cell_gain: f64,
    pub tvg_db_per_decade: f64,
    pub noise: Noise,
}

/// Echo energy of volume reverberation for each steradian of open water: `s_v·Δr/R²`, before absorption.
///
/// The volume `R²·Ω·Δr` scatters `s_v` of what falls on it, both ways lose 1/R² each. `volume_per_m` in m⁻¹, ranges in m.
/// Source: Urick (1983), ch. 8, volume reverberation.
#[must_use]
pub fn volume_energy(volume_per_m: f64, bin_m: f64, range_m: f64) -> f64 {
    volume_per_m * bin_m / (range_m * range_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::log10;

    const RECEIVER: Receiver = Receiver {
        most_looks: 1,
        noise_figure_db: 0.0,
        blanking_m: 0.6,
        ringing: Ringing { level_db: 150.0, decay_db_per_m: 40.0 },
        max_gain_db: 60.0,
        gain_step_db: 0.0,
        full_scale_db: 72.0,
    };
    const GRID: Grid = Grid { beams: 4, bins: 100, azimuth_deg: 1.0, near_m: 0.5, far_m: 10.5 };
    const CHANNEL: Channel = Channel {
        frequency_khz: 900.0,
        water: crate::physics::Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 },
        absorption_db_per_m: 0.3,
        gain_absorption_db_per_m: 0.25,
        volume_per_m: 1e-6,
        noise_power: 1e-14,
        beam_width_deg: 0.6,
        pulse_m: 0.0075,
        wavelength_m: 0.0016,
        bandwidth_hz: 100e3,
        source_level_db: 210.0,
    };

    fn levels(noise: Noise) -> Levels {
        RECEIVER.levels(&GRID, &CHANNEL, &Given { pulse: &Pulse::Tone, cell_gain: 2.0, tvg_db_per_decade: 30.0, noise })
    }

    #[test]
    fn gain_rises_in_steps_up_to_its_end() {
        let smooth = RECEIVER.gain_db(30.0, 0.3, 10.0);
        assert!((smooth - 36.0).abs() < 1e-12);
        let stepped = Receiver { gain_step_db: 5.0, ..RECEIVER };
        assert_eq!(stepped.gain_db(30.0, 0.3, 10.0), 35.0);
        assert_eq!(stepped.gain_db(30.0, 0.3, 0.5), -10.0);
        assert_eq!(RECEIVER.gain_db(40.0, 0.3, 100.0), 60.0);
    }

    #[test]
    fn ringing_dies_away_into_thermal_noise_behind_the_blanking() {
        let levels = levels(Noise::Heard);
        assert_eq!((levels.noise[0], levels.echo[0], levels.volume[0]), (0.0, 0.0, 0.0));
        let ringing = |bin: usize| 10.0 * log10(f64::from(levels.noise[bin]) - 1e-14);
        // 1 m of range is 10 bins: 40 dB less.
        assert!((ringing(5) - ringing(15) - 40.0).abs() < 1e-3);
        assert!((f64::from(levels.noise[99]) / 1e-14 - 1.0).abs() < 1e-3);
        let loud = Receiver { noise_figure_db: 10.0, ..RECEIVER };
        assert!((loud.steady_noise(&Pulse::Tone, &CHANNEL) / 1e-13 - 1.0).abs() < 1e-9);
        assert!(self::levels(Noise::Silent).noise.iter().all(|&noise| noise == 0.0));
    }

    #[test]
    fn volume_and_echo_lose_what_water_takes() {
        let levels = levels(Noise::Heard);
        let range = GRID.range_m(50);
        assert!((10.0 * log10(f64::from(levels.echo[50]) / 2.0) + 0.6 * range).abs() < 1e-5);
        let ratio = f64::from(levels.volume[50] / levels.echo[50]);
        assert!((ratio * range * range / (1e-6 * 0.1) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn full_scale_moves_with_the_gain() {
        let levels = levels(Noise::Heard);
        let above = |bin: u32| 10.0 * log10(levels.full_scale[bin as usize] / 0.5e-14);
        let gain = |bin: u32| RECEIVER.gain_db(30.0, 0.25, GRID.range_m(bin));
        for bin in [10, 90] {
            assert!((above(bin) - (72.0 + 60.0 - gain(bin))).abs() < 1e-9);
        }
    }
}
