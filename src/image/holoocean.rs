//! The chain of HoloOcean's imaging sonar.
//!
//! `I = mean over the rays of a cell of |R|²·cos θ · w`, each ray shifted outwards by range noise x and weighted with
//! `w = e^(−x/σ)`; then `I·(m + N(0, σ²)) +` Rayleigh noise, and a linear display from 0 to 1. There is no absorption, no
//! spreading loss and no beam; far ranges differ from near ones by their noise alone.
//!
//! Source: Potokar et al. (2022), HoloOcean: Realistic Sonar Simulation, IROS; documentation of the class `ImagingSonar`.
//! Here rays take the place of octree leaves; multipath and azimuth streaks are left out.

use serde::{Deserialize, Serialize};

use super::linear::{grey, normals, rayleigh};
use crate::math::Impossible;
use crate::math::real::{degrees, exp, ln};
use crate::math::rng::Stream;
use crate::sonar::{Grid, Rays};

/// Parameters of the chain, by the names of HoloOcean's configuration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HoloOcean {
    /// `AddSigma`: scale of the additive Rayleigh noise.
    pub add_sigma: f64,
    /// `MultSigma`: standard deviation of the Gaussian factor.
    pub mult_sigma: f64,
    /// Mean of the Gaussian factor: 1 at first, 0.5 in later versions of its imaging sonar.
    pub mult_mean: f64,
    /// `RangeSigma`: mean of the exponential noise that is added to the range of each ray, metres.
    pub range_sigma: f64,
    /// `ScaleNoise`: whether additive noise grows with the square of range and is half as strong again amidships.
    pub scale_noise: bool,
    /// Intensity shown white; HoloOcean's own displays show 1 so.
    pub white: f64,
}

impl HoloOcean {
    pub(super) fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("model.holoocean.add_sigma", self.add_sigma, 0.0, 10.0)?;
        Impossible::outside("model.holoocean.mult_sigma", self.mult_sigma, 0.0, 10.0)?;
        Impossible::outside("model.holoocean.mult_mean", self.mult_mean, 0.0, 10.0)?;
        Impossible::outside("model.holoocean.range_sigma", self.range_sigma, 0.0, 100.0)?;
        Impossible::outside("model.holoocean.white", self.white, 1e-6, 1e6)
    }

    /// The grey image, in cell order.
    #[must_use]
    pub(super) fn form(&self, rays: &Rays, grid: &Grid, stream: &mut Stream) -> Vec<u8> {
        grey(&self.intensity(rays, grid, stream), self.white)
    }

    /// Intensity of each cell before display.
    fn intensity(&self, rays: &Rays, grid: &Grid, stream: &mut Stream) -> Vec<f32> {
        let mut intensity = if self.range_sigma > 0.0 { self.shifted(rays, grid, stream).mean() } else { rays.mean() };
        let (factor, sigma, add) = (self.mult_mean as f32, self.mult_sigma as f32, self.add_sigma as f32);
        let multiplied = normals(grid.len(), stream);
        let mut draws = multiplied.zip(normals(grid.len(), stream));
        let along: Vec<f32> = (0..grid.bins).map(|bin| self.range_scale(grid, bin)).collect();
        for (number, beam) in intensity.chunks_exact_mut(grid.bins as usize).enumerate() {
            let across = self.bearing_scale(grid, number as u32);
            for ((value, along), (a, b)) in beam.iter_mut().zip(&along).zip(&mut draws) {
                *value = *value * (factor + sigma * a[0]) + add * across * along * rayleigh(b);
            }
        }
        intensity
    }

    /// Rays moved outwards along their beams by exponential range noise, each weighted with its probability density,
    /// scaled to 1 at no shift. What leaves the grid stays in the last bin.
    fn shifted(&self, rays: &Rays, grid: &Grid, stream: &mut Stream) -> Rays {
        let bins = grid.bins as usize;
        let per_bin = self.range_sigma / grid.bin_m();
        let mut moved = Rays::none(grid.len());
        for (cell, (&count, &reflected)) in rays.count.iter().zip(&rays.reflected).enumerate() {
            let (first, bin) = (cell / bins * bins, cell % bins);
            let parts = count.ceil();
            for _ in 0..parts as u32 {
                // x = −σ·ln U is exponential, and U = e^(−x/σ) is its density as a share of the highest.
                let (inside, weight) = (stream.unit(), 1.0 - stream.unit());
                let place = bin as f64 + inside - per_bin * ln(weight);
                let to = first + (place as usize).min(bins - 1);
                moved.count[to] += count / parts;
                moved.reflected[to] += reflected / parts * weight as f32;
            }
        }
        moved
    }

    /// Growth of additive noise with the square of range, 0 at the nearest and 1 at the farthest.
    fn range_scale(&self, grid: &Grid, bin: u32) -> f32 {
        let share = f64::from(bin) * grid.bin_m() / grid.far_m;
        if self.scale_noise { (share * share) as f32 } else { 1.0 }
    }

    /// Additive noise across the fan: `1 + ½·e^(−64·φ² / width)`, φ and the fan's width in degrees.
    fn bearing_scale(&self, grid: &Grid, beam: u32) -> f32 {
        let bearing = degrees(grid.bearing_rad(beam));
        let lobe = exp(-bearing * bearing * 64.0 / grid.azimuth_deg);
        if self.scale_noise { (1.0 + 0.5 * lobe) as f32 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { beams: 400, bins: 100, azimuth_deg: 100.0, near_m: 0.1, far_m: 10.1 };
    const QUIET: HoloOcean =
        HoloOcean { add_sigma: 0.0, mult_sigma: 0.0, mult_mean: 1.0, range_sigma: 0.0, scale_noise: false, white: 1.0 };

    fn intensity(model: &HoloOcean, rays: &Rays) -> Vec<f64> {
        let image = model.intensity(rays, &GRID, &mut Stream::at(4, "test", 0, "holoocean"));
        image.into_iter().map(f64::from).collect()
    }

    fn even(mean: f32) -> Rays {
        Rays { count: vec![3.0; GRID.len()], reflected: vec![3.0 * mean; GRID.len()] }
    }

    fn moments(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
        let n = values.clone().count() as f64;
        let mean = values.clone().sum::<f64>() / n;
        [mean, (values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / n).sqrt()]
    }

    #[test]
    fn without_noise_the_image_is_the_mean() {
        assert!(intensity(&QUIET, &even(0.25)).iter().all(|&value| value == 0.25));
        assert!(intensity(&QUIET, &Rays::none(GRID.len())).iter().all(|&value| value == 0.0));
    }

    #[test]
    fn noise_has_the_moments_of_its_kinds() {
        let multiplied = intensity(&HoloOcean { mult_sigma: 0.2, mult_mean: 0.5, ..QUIET }, &even(0.6));
        let [mean, deviation] = moments(multiplied.iter().copied());
        assert!((mean - 0.3).abs() < 0.003 && (deviation - 0.12).abs() < 0.003, "{mean} {deviation}");
        let added = intensity(&HoloOcean { add_sigma: 0.15, ..QUIET }, &even(0.6));
        let [mean, deviation] = moments(added.iter().copied());
        assert!((mean - 0.6 - 0.15 * 1.253_314).abs() < 0.003, "{mean}");
        assert!((deviation - 0.15 * 0.655_136).abs() < 0.003, "{deviation}");
    }

    #[test]
    fn scaled_noise_grows_with_the_square_of_range_and_amidships() {
        let noise = intensity(&HoloOcean { add_sigma: 0.2, scale_noise: true, ..QUIET }, &Rays::none(GRID.len()));
        let mean = |beams: std::ops::Range<u32>, bin| {
            moments(beams.map(|beam| noise[GRID.cell(beam, bin)]).collect::<Vec<_>>().into_iter())[0]
        };
        for (bin, scale) in [(0, 0.0), (49, 0.2353), (98, 0.9414)] {
            let found = mean(0..150, bin) / (0.2 * 1.253_314);
            assert!((found - scale).abs() <= 0.12 * scale, "bin {bin}: {found}");
        }
        let lift = (80..100).map(|bin| mean(198..202, bin) / mean(0..150, bin)).sum::<f64>() / 20.0;
        assert!((lift - 1.45).abs() < 0.2, "{lift}");
    }

    #[test]
    fn range_noise_smears_outwards_and_keeps_the_rays() {
        let mut point = Rays::none(GRID.len());
        for beam in 0..GRID.beams {
            let cell = GRID.cell(beam, 40);
            (point.count[cell], point.reflected[cell]) = (8.0, 8.0);
        }
        let model = HoloOcean { range_sigma: 0.5, ..QUIET };
        let moved = model.shifted(&point, &GRID, &mut Stream::at(4, "test", 0, "range"));
        let rays: f32 = moved.count.iter().sum();
        assert!((rays - 3200.0).abs() < 0.1, "no ray is lost: {rays}");
        // Mean shift σ = 5 bins; a weight uniform in (0, 1] leaves half.
        let shift: f32 = moved.count.iter().enumerate().map(|(cell, n)| n * ((cell % 100) as f32 - 40.0)).sum();
        assert!((shift / rays - 5.0).abs() < 0.4, "{}", shift / rays);
        assert!((moved.reflected.iter().sum::<f32>() / rays - 0.5).abs() < 0.02);
        assert!(moved.count.iter().enumerate().all(|(cell, &n)| n == 0.0 || cell % 100 >= 40));
    }

    #[test]
    fn the_image_is_pinned() {
        let model = HoloOcean { add_sigma: 0.15, mult_sigma: 0.2, range_sigma: 0.1, scale_noise: true, ..QUIET };
        let grey = model.form(&even(0.5), &GRID, &mut Stream::at(4, "test", 0, "holoocean"));
        assert_eq!([grey[0], grey[1], grey[50], grey[99], grey[GRID.len() - 1]], PINNED);
    }
    const PINNED: [u8; 5] = [51, 0, 72, 58, 89];
}
