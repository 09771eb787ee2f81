//! Echoes → images: absorption, complex field, response, receiver noise, time-varied gain and display.
//!
//! Knows nothing of bodies and labels: noise made here cannot reach them.

pub mod deepsonar;
pub mod display;
pub mod holoocean;
pub mod linear;
pub mod physical;
pub mod reach;

use serde::{Deserialize, Serialize};

pub use deepsonar::DeepSonar;
pub use display::Display;
pub use holoocean::HoloOcean;
pub use physical::Physical;

use display::Scale;
use physical::{Chain, Setup};

use crate::math::Impossible;
use crate::math::real::power_from_db;
use crate::math::rng::Stream;
use crate::physics::response::pulse_resolution_m;
use crate::physics::{TurbidWater, Water, levels};
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
    /// Refuses gains and displays that show nothing, and devices that cannot be.
    ///
    /// # Errors
    /// The first impossible figure, with its key and a remedy.
    pub fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("tvg_db_per_decade", self.tvg_db_per_decade, 0.0, 80.0)?;
        self.display.validate()?;
        match &self.model {
            Model::Physical(physical) => physical.validate(),
            Model::Deepsonar(model) => model.validate(),
            Model::Holoocean(model) => model.validate(),
        }
    }

    /// The rays that this model averages over: what [`form`] needs a trace to keep. None where it sums energy.
    #[must_use]
    pub fn rays(&self) -> Option<RayRange> {
        match &self.model {
            Model::Physical(_) => None,
            Model::Deepsonar(model) => Some(model.ray_range()),
            Model::Holoocean(_) => Some(RayRange::Slant),
        }
    }

    fn setup<'a>(&self, physical: &'a Physical, noise: Noise) -> Setup<'a> {
        Setup { physical, tvg_db_per_decade: self.tvg_db_per_decade, noise }
    }
}

/// Chains of image formation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Complex Gaussian field, aperture and pulse, noise before gain, log display.
    Physical(Physical),
    /// The chain of the DeepSonar paper: a mean over rays, absorption, speckle, noise that grows with range.
    Deepsonar(DeepSonar),
    /// The chain of HoloOcean's imaging sonar: a mean over rays, range noise, Gaussian and Rayleigh noise.
    Holoocean(HoloOcean),
}

/// Whether the receiver's own noise is in an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noise {
    /// Thermal noise and ringing.
    Heard,
    /// Echoes and reverberation alone, with the same speckle; nothing clips.
    Silent,
}

/// What water and receiver do to a ping's echoes: levels from the sonar equation, widths of the response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// Absorption by water and what is suspended in it, dB/m one way.
    pub absorption_db_per_m: f64,
    /// Absorption that the gain makes up for, dB/m: the clear water's. Temperature and salinity are set on a sonar, turbidity
    /// is not.
    pub gain_absorption_db_per_m: f64,
    /// Backscattering cross-section of the water's volume, m⁻¹.
    pub volume_per_m: f64,
    /// Power of the receiver's noise in the unit of the echoes: relative to the source's power at 1 m.
    pub noise_power: f64,
    /// −3 dB width of a receive beam, degrees.
    pub beam_width_deg: f64,
    /// Resolution of the pulse, c/2B, metres of slant range.
    pub pulse_m: f64,
    /// Centre frequency, kHz: for chains with an absorption of their own.
    pub frequency_khz: f64,
    /// The water itself.
    pub water: Water,
    /// Wavelength, metres.
    pub wavelength_m: f64,
    /// Bandwidth, Hz.
    pub bandwidth_hz: f64,
    /// Source level, dB re 1 µPa at 1 m.
    pub source_level_db: f64,
}

impl Channel {
    /// The channel of a sonar in a water: noise is thermal, in the receiver's band, less the directivity index.
    #[must_use]
    pub fn new(sonar: &Sonar, water: &TurbidWater) -> Self {
        let bandwidth_hz = 1000.0 * sonar.bandwidth_khz;
        let spectrum = levels::thermal_noise_db(sonar.frequency_khz);
        let noise = levels::band_level_db(spectrum, bandwidth_hz) - sonar.directivity_db;
        Self {
            absorption_db_per_m: water.absorption_db_per_m(sonar.frequency_khz),
            gain_absorption_db_per_m: water.water.absorption_db_per_m(sonar.frequency_khz),
            volume_per_m: water.suspension(sonar.frequency_khz).value.backscatter_per_m,
            noise_power: power_from_db(noise - sonar.source_level_db),
            beam_width_deg: sonar.beam_width_deg,
            pulse_m: pulse_resolution_m(water.water.sound_speed_m_s(), bandwidth_hz),
            frequency_khz: sonar.frequency_khz,
            water: water.water,
            wavelength_m: water.water.wavelength_m(sonar.frequency_khz),
            bandwidth_hz,
            source_level_db: sonar.source_level_db,
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
        Model::Physical(physical) => {
            let chain = Chain::new(&echoes.grid, &model.setup(physical, Noise::Heard), channel);
            let powers = chain.powers(echoes, stream);
            model.display.grey(&powers, &Scale { gain_db: chain.gain_db(), footprint_m2: chain.footprint_m2() })
        }
        Model::Deepsonar(deepsonar) => deepsonar.form(rays(), &echoes.grid, channel, stream),
        Model::Holoocean(holoocean) => holoocean.form(rays(), &echoes.grid, stream),
    }
}

/// A ping's linear image, cell by cell: mean-square pressure at the receiver before gain, µPa². `10·log10` of it is a level
/// in dB re 1 µPa.
#[derive(Clone, Debug, PartialEq)]
pub struct Linear {
    /// Echoes and reverberation alone; nothing clips.
    pub noise_free: Vec<f32>,
    /// The same with the receiver's noise: what the grey image shows.
    pub noisy: Vec<f32>,
}

/// The calibrated linear image of a ping; none for models that know no pressure. A stream like that of [`form`] gives the
/// same speckle and noise.
#[must_use]
pub fn linear(echoes: &Echoes, model: &ImageModel, channel: &Channel, stream: &Stream) -> Option<Linear> {
    match &model.model {
        Model::Physical(physical) => {
            let source = power_from_db(channel.source_level_db) as f32;
            let of = |noise| {
                let chain = Chain::new(&echoes.grid, &model.setup(physical, noise), channel);
                chain.powers(echoes, &mut stream.clone()).into_iter().map(|power| power * source).collect()
            };
            Some(Linear { noise_free: of(Noise::Silent), noisy: of(Noise::Heard) })
        }
        Model::Deepsonar(_) | Model::Holoocean(_) => None,
    }
}
