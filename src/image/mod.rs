//! Echoes → images: absorption, complex field, response, receiver noise, time-varied gain and display.
//!
//! Knows nothing of bodies and labels: noise made here cannot reach them.

pub mod deepsonar;
pub mod display;
pub mod field;
pub mod holoocean;
pub mod linear;
pub mod response;

use serde::{Deserialize, Serialize};

pub use deepsonar::DeepSonar;
pub use display::Display;
pub use holoocean::HoloOcean;

use crate::math::Impossible;
use crate::math::rng::Stream;
use crate::physics::{Water, levels};
use crate::sonar::{Echoes, RayRange, Sonar};

/// How echoes become a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageModel {
    /// The chain of steps.
    pub model: Model,
    /// Time-varied gain of the physical chain, dB per decade of range: 20 levels volume, 30 seabed, 40 point echoes.
    pub tvg_db_per_decade: f64,
    /// Levels that the physical chain shows.
    pub display: Display,
}

impl ImageModel {
    /// Refuses gains and displays that show nothing.
    ///
    /// # Errors
    /// The first impossible figure, with its key and a remedy.
    pub fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("tvg_db_per_decade", self.tvg_db_per_decade, 0.0, 80.0)?;
        Impossible::outside("display.white_db", self.display.white_db, -200.0, 200.0)?;
        Impossible::outside("display.dynamic_range_db", self.display.dynamic_range_db, 1.0, 200.0)?;
        match &self.model {
            Model::Physical => Ok(()),
            Model::Deepsonar(model) => model.validate(),
            Model::Holoocean(model) => model.validate(),
        }
    }

    /// The rays that this model averages over: what [`form`] needs a trace to keep. None where it sums energy.
    #[must_use]
    pub fn rays(&self) -> Option<RayRange> {
        match &self.model {
            Model::Physical => None,
            Model::Deepsonar(model) => Some(model.ray_range()),
            Model::Holoocean(_) => Some(RayRange::Slant),
        }
    }
}

/// Chains of image formation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Complex Gaussian field, pulse and beam response, thermal noise before gain, log display.
    Physical,
    /// The chain of the DeepSonar paper: a mean over rays, absorption, speckle, noise that grows with range.
    Deepsonar(DeepSonar),
    /// The chain of HoloOcean's imaging sonar: a mean over rays, range noise, Gaussian and Rayleigh noise.
    Holoocean(HoloOcean),
}

/// What water and receiver do to a ping's echoes: levels from the sonar equation, widths of the response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// Absorption, dB/m one way.
    pub absorption_db_per_m: f64,
    /// Power of the receiver's noise in the unit of the echoes: relative to the source's power at 1 m.
    pub noise_power: f64,
    /// −3 dB width of a receive beam, degrees.
    pub beam_width_deg: f64,
    /// Length of the pulse after the receiver, metres of slant range.
    pub pulse_m: f64,
    /// Centre frequency, kHz: for chains with an absorption of their own.
    pub frequency_khz: f64,
    /// The water itself.
    pub water: Water,
}

impl Channel {
    /// The channel of a sonar in a water: noise is thermal, in the receiver's band, less the directivity index.
    #[must_use]
    pub fn new(sonar: &Sonar, water: &Water) -> Self {
        let spectrum = levels::thermal_noise_db(sonar.frequency_khz);
        let noise = levels::band_level_db(spectrum, sonar.bandwidth_khz * 1000.0) - sonar.directivity_db;
        Self {
            absorption_db_per_m: water.absorption_db_per_m(sonar.frequency_khz),
            noise_power: crate::math::real::power_from_db(noise - sonar.source_level_db),
            beam_width_deg: sonar.beam_width_deg,
            pulse_m: sonar.pulse_m(),
            frequency_khz: sonar.frequency_khz,
            water: *water,
        }
    }
}

/// Forms the grey image of a ping: one byte a cell, in cell order. The stream gives speckle and noise.
///
/// # Panics
/// Where the model averages over rays ([`ImageModel::rays`]) and the echoes were traced without.
#[must_use]
pub fn form(echoes: &Echoes, model: &ImageModel, channel: &Channel, stream: &mut Stream) -> Vec<u8> {
    let rays = || echoes.rays.as_ref().expect("traced with the rays that the model asks for");
    match &model.model {
        Model::Physical => {
            let mut field = field::speckle(echoes, channel.absorption_db_per_m, stream);
            response::blur(&mut field, &echoes.grid, channel.beam_width_deg, channel.pulse_m);
            field::add_noise(&mut field, channel.noise_power, stream);
            display::detect(&field, &echoes.grid, model, channel)
        }
        Model::Deepsonar(deepsonar) => deepsonar.form(rays(), &echoes.grid, channel, stream),
        Model::Holoocean(holoocean) => holoocean.form(rays(), &echoes.grid, stream),
    }
}
