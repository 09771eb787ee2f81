//! The chain of the DeepSonar paper, with its equations put right or, for comparison, as printed.
//!
//! `I = mean over the rays of a cell of ρ·cos θ · T(r)`, then speckle, then noise that grows with range, then a linear display.
//! The mean is the paper's and is kept: it is no energy, so near and far, many echoes and few look alike, and there is no
//! spreading loss and no beam. Only the `physical` chain has those.
//!
//! | Equation | Put right | As printed |
//! |---|---|---|
//! | (2) range | slant | in the sonar's horizontal plane: images lie beside their masks |
//! | (6), (8) absorption | Ainslie & McColm | z in metres, wrong sign in the viscous part |
//! | (9) transmission | `10^(−α·2R/10)`, there and back | `e^(−0.023·α·r)`, r km |
//! | (10) speckle `f + f·n` | `n = σ·(|a|² − 1)`, a complex Gaussian: at σ = 1 intensity is exponential | n ~ N(0, σ²) |
//! | (11) noise | Rayleigh less its mean, scale `σ·r / r_max` | Rayleigh, scale `σ·r / r_max` |
//!
//! The paper leaves open what ρ is, how n is distributed, how d counts a path, how far linear growth goes and where white is;
//! here ρ is |R|² of the material's impedance, d is r, growth reaches `noise_sigma` at the farthest range, white is a parameter.
//! Speckle is drawn cell by cell, as the paper has it: the chain has no beam and no pulse to correlate it over.

use serde::{Deserialize, Serialize};

use super::Channel;
use super::linear::{RAYLEIGH_MEAN, grey, normals, rayleigh};
use crate::math::Impossible;
use crate::math::rng::Stream;
use crate::physics::Water;
use crate::physics::absorption::{ainslie_mccolm, transmission};
use crate::physics::deepsonar::{DepthUnit, absorption_as_printed, transmission_as_printed};
use crate::sonar::{Grid, RayRange, Rays};

/// Parameters of the chain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeepSonar {
    /// Whether equations stand as printed, faults and all.
    pub as_printed: bool,
    /// Standard deviation of the speckle factor; 1 is fully developed speckle.
    pub speckle_sigma: f64,
    /// Scale of the Rayleigh noise at the farthest range, in intensity.
    pub noise_sigma: f64,
    /// Intensity shown white; a perfect mirror across the ray, without water, has 1.
    pub white: f64,
}

impl DeepSonar {
    pub(super) fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("model.deepsonar.speckle_sigma", self.speckle_sigma, 0.0, 1.0)?;
        Impossible::outside("model.deepsonar.noise_sigma", self.noise_sigma, 0.0, 1.0)?;
        Impossible::outside("model.deepsonar.white", self.white, 1e-6, 1e6)
    }

    /// The range by which rays fall into bins.
    #[must_use]
    pub fn ray_range(&self) -> RayRange {
        if self.as_printed { RayRange::Horizontal } else { RayRange::Slant }
    }

    /// Share of the intensity that the water leaves of an echo from `range_m`, equations 5–9.
    ///
    /// Source: Ainslie & McColm (1998); as printed: the DeepSonar paper, eqs. 5–9, z in metres, d the range.
    #[must_use]
    pub fn transmission(&self, frequency_khz: f64, water: &Water, range_m: f64) -> f64 {
        if self.as_printed {
            let absorption = absorption_as_printed(frequency_khz, water, DepthUnit::Metres).total();
            return transmission_as_printed(absorption, range_m / 1000.0);
        }
        transmission(ainslie_mccolm(frequency_khz, water).value.total() / 1000.0, 2.0 * range_m)
    }

    /// The grey image, in cell order.
    #[must_use]
    pub(super) fn form(&self, rays: &Rays, grid: &Grid, channel: &Channel, stream: &mut Stream) -> Vec<u8> {
        grey(&self.intensity(rays, grid, channel, stream), self.white)
    }

    /// Intensity of each cell before display, noise included; may be below 0 where noise is less than its mean.
    fn intensity(&self, rays: &Rays, grid: &Grid, channel: &Channel, stream: &mut Stream) -> Vec<f32> {
        let mut intensity = rays.mean();
        let row =
            |of: &dyn Fn(f64) -> f64| -> Vec<f32> { (0..grid.bins).map(|bin| of(grid.range_m(bin)) as f32).collect() };
        let left = row(&|range| self.transmission(channel.frequency_khz, &channel.water, range));
        let noise = row(&|range| self.noise_sigma * range / grid.far_m);
        let speckle = normals(grid.len(), stream);
        let mut draws = speckle.zip(normals(grid.len(), stream));
        for beam in intensity.chunks_exact_mut(grid.bins as usize) {
            for (((value, left), noise), (a, b)) in beam.iter_mut().zip(&left).zip(&noise).zip(&mut draws) {
                let f = *value * left;
                *value = f + f * self.speckle(a) + noise * self.unit_noise(b);
            }
        }
        intensity
    }

    /// n of equation 10.
    fn speckle(&self, [x, y]: [f32; 2]) -> f32 {
        let sigma = self.speckle_sigma as f32;
        // Below −1, a factor of the printed equation would turn an echo into its negative.
        if self.as_printed { (sigma * x).max(-1.0) } else { sigma * (0.5 * (x * x + y * y) - 1.0) }
    }

    /// Noise of equation 11 for a scale of 1.
    fn unit_noise(&self, pair: [f32; 2]) -> f32 {
        if self.as_printed { rayleigh(pair) } else { rayleigh(pair) - RAYLEIGH_MEAN }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::exp;

    const GRID: Grid = Grid { beams: 400, bins: 100, azimuth_deg: 100.0, near_m: 0.5, far_m: 20.5 };
    const QUIET: DeepSonar = DeepSonar { as_printed: false, speckle_sigma: 0.0, noise_sigma: 0.0, white: 1.0 };
    const CHANNEL: Channel = Channel {
        volume_per_m: 0.0,
        wavelength_m: 1.66e-3,
        bandwidth_hz: 1e5,
        source_level_db: 210.0,
        absorption_db_per_m: 0.0,
        gain_absorption_db_per_m: 0.0,
        noise_power: 0.0,
        beam_width_deg: 0.5,
        pulse_m: 0.01,
        frequency_khz: 1200.0,
        water: Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 },
    };

    /// Every cell met by two rays of mean ρ·cos θ.
    fn even(mean: f32) -> Rays {
        Rays { count: vec![2.0; GRID.len()], reflected: vec![2.0 * mean; GRID.len()] }
    }

    fn intensity(model: &DeepSonar, rays: &Rays) -> Vec<f32> {
        model.intensity(rays, &GRID, &CHANNEL, &mut Stream::at(4, "test", 0, "deepsonar"))
    }

    /// Mean and standard deviation of one range bin over all beams.
    fn moments(intensity: &[f32], bin: u32) -> [f64; 2] {
        let values = || (0..GRID.beams).map(|beam| f64::from(intensity[GRID.cell(beam, bin)]));
        let mean = values().sum::<f64>() / f64::from(GRID.beams);
        let variance = values().map(|v| (v - mean) * (v - mean)).sum::<f64>() / f64::from(GRID.beams);
        [mean, variance.sqrt()]
    }

    #[test]
    fn without_noise_the_image_is_the_mean_after_the_water() {
        for (model, exponent) in [
            (QUIET, 0.230_258_5 * 535.24 * 2.0 / 1000.0),
            (DeepSonar { as_printed: true, ..QUIET }, 0.023 * 1849.5 / 1000.0),
        ] {
            let intensity = intensity(&model, &even(0.5));
            for bin in [10, 90] {
                let expected = 0.5 * exp(-exponent * GRID.range_m(bin));
                let found = f64::from(intensity[GRID.cell(7, bin)]);
                assert!((found / expected - 1.0).abs() < 2e-3, "bin {bin}: {found} {expected}");
            }
        }
    }

    #[test]
    fn speckle_keeps_the_mean_and_has_the_deviation_asked_for() {
        for (as_printed, sigma) in [(false, 1.0), (false, 0.3), (true, 0.3)] {
            let model = DeepSonar { as_printed, speckle_sigma: sigma, ..QUIET };
            let (clean, speckled) =
                (intensity(&DeepSonar { as_printed, ..QUIET }, &even(1.0)), intensity(&model, &even(1.0)));
            let ratios: Vec<f64> = speckled.iter().zip(&clean).map(|(s, c)| f64::from(s / c)).collect();
            let n = ratios.len() as f64;
            let mean = ratios.iter().sum::<f64>() / n;
            let deviation = (ratios.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>() / n).sqrt();
            assert!((mean - 1.0).abs() < 0.02, "{model:?}: mean {mean}");
            assert!((deviation / sigma - 1.0).abs() < 0.03, "{model:?}: deviation {deviation}");
            assert!(ratios.iter().all(|&ratio| ratio >= 0.0));
        }
        // Fully developed speckle is exponential: a share e⁻¹ lies above the mean; a Gaussian has one half.
        let clean = intensity(&QUIET, &even(1.0));
        let full = intensity(&DeepSonar { speckle_sigma: 1.0, ..QUIET }, &even(1.0));
        let above = full.iter().zip(&clean).filter(|(s, c)| s > c).count() as f64 / clean.len() as f64;
        assert!((above - exp(-1.0)).abs() < 0.01, "{above}");
    }

    #[test]
    fn noise_grows_with_range_and_only_the_printed_one_has_a_mean() {
        let silence = Rays::none(GRID.len());
        for as_printed in [false, true] {
            let noise = intensity(&DeepSonar { as_printed, noise_sigma: 0.2, ..QUIET }, &silence);
            for bin in [20, 50, 99] {
                let scale = 0.2 * GRID.range_m(bin) / GRID.far_m;
                let [mean, deviation] = moments(&noise, bin);
                let expected = if as_printed { scale * f64::from(RAYLEIGH_MEAN) } else { 0.0 };
                assert!((mean - expected).abs() < 0.12 * scale, "bin {bin}: mean {mean}, not {expected}");
                assert!((deviation / (0.655_136 * scale) - 1.0).abs() < 0.15, "bin {bin}: deviation {deviation}");
            }
        }
    }

    #[test]
    fn the_image_is_pinned() {
        let noisy = DeepSonar { speckle_sigma: 1.0, noise_sigma: 0.05, white: 0.5, ..QUIET };
        let first = |as_printed| {
            let mut stream = Stream::at(4, "test", 0, "deepsonar");
            let grey = DeepSonar { as_printed, ..noisy }.form(&even(0.4), &GRID, &CHANNEL, &mut stream);
            [grey[0], grey[1], grey[50], grey[99], grey[GRID.len() - 1]]
        };
        assert_eq!([first(false), first(true)], PINNED);
    }
    const PINNED: [[u8; 5]; 2] = [[11, 176, 20, 0, 17], [255, 38, 27, 178, 147]];
}
