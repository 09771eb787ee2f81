//! The physical chain: what an array and a receiver make of the mean energies that a ping brings back.
//!
//! Mean power in each direction (echoes, volume reverberation, noise) → complex Gaussian field → elements' signals → pulse →
//! clipping, shading, errors, focus → beams → detection. `display` makes grey of it.

mod aperture;
mod beams;
mod fft;
mod pulse;
mod receiver;
mod response;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use aperture::{Array, Focus, error_rms};
pub use pulse::Pulse;
pub use receiver::{Receiver, Ringing, volume_energy};

use aperture::{Aperture, Needs};
use beams::BeamTables;
use receiver::Given;
use response::{Parts, Response};

use super::{Channel, Noise};
use crate::math::Impossible;
use crate::math::rng::Stream;
use crate::sonar::{Echoes, Grid};

/// Figures of a device that shape its images.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Physical {
    /// The receiving array.
    pub array: Array,
    /// What is sent.
    pub pulse: Pulse,
    /// What is behind the array.
    pub receiver: Receiver,
}

impl Physical {
    /// Refuses devices that cannot be.
    ///
    /// # Errors
    /// The first impossible figure, with its key in the section `image`.
    pub fn validate(&self) -> Result<(), Impossible> {
        self.array.validate()?;
        self.pulse.validate()?;
        self.receiver.validate()
    }
}

/// A device as it is set for a ping.
#[derive(Clone, Copy, Debug)]
pub struct Setup<'a> {
    /// The device.
    pub physical: &'a Physical,
    /// Slope of the time-varied gain, dB per decade of range.
    pub tvg_db_per_decade: f64,
    /// Whether the receiver's noise is heard.
    pub noise: Noise,
}

/// A device in a water, its tables ready for pings of one grid.
#[derive(Clone, Debug)]
pub struct Chain {
    response: Response,
    /// Gain of each bin, dB.
    gain_db: Vec<f64>,
    /// Area that each beam and pulse cover at 1 m, m²: power over it is backscattering strength.
    footprint_m2: Vec<f64>,
}

impl Chain {
    /// Makes the tables.
    #[must_use]
    pub fn new(grid: &Grid, setup: &Setup<'_>, channel: &Channel) -> Self {
        let Setup { physical: Physical { array, pulse, receiver }, tvg_db_per_decade, noise } = *setup;
        let needs = Needs { beam_width_deg: channel.beam_width_deg, azimuth_deg: grid.azimuth_deg };
        let aperture = Aperture::new(&array.shading, needs);
        let tables = BeamTables::new(grid, &aperture, array);
        let sampled = pulse.sampled(channel.pulse_m, grid.bin_m(), receiver.most_looks);
        // A beam and a pulse of peak 1 gather what falls on their equivalent widths.
        let cell_gain = aperture.equivalent_u() / aperture.u_step() * sampled.echo_gain;
        let levels = receiver.levels(grid, channel, &Given { pulse, cell_gain, tvg_db_per_decade, noise });
        let cell_m2 = grid.beam_rad() * grid.bin_m();
        let footprint_m2 = tables.even.iter().map(|even| even * cell_gain * cell_m2).collect();
        let gain = |bin| receiver.gain_db(tvg_db_per_decade, channel.gain_absorption_db_per_m, grid.range_m(bin));
        Self {
            gain_db: (0..grid.bins).map(gain).collect(),
            footprint_m2,
            response: Response::new(Parts { grid: *grid, aperture, tables, pulse: sampled, levels }, array, channel),
        }
    }

    /// Powers of one ping at the beams' outputs before gain, relative to the source's at 1 m, cell by cell.
    #[must_use]
    pub fn powers(&self, echoes: &Echoes, stream: &mut Stream) -> Vec<f32> {
        self.response.powers(echoes, stream)
    }

    /// Time-varied gain of each bin, dB.
    #[must_use]
    pub fn gain_db(&self) -> &[f64] {
        &self.gain_db
    }

    /// Area that each beam and the pulse cover at 1 m, m², the dimmer edges of the fan made up.
    #[must_use]
    pub fn footprint_m2(&self) -> &[f64] {
        &self.footprint_m2
    }
}
