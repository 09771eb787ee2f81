//! How a surface sends sound back, as tables that the energy of a ping is read from.

use crate::math::real::{exp, pow};
use crate::math::rng::Stream;
use crate::scene::{Material, Scene};

/// Steps of a table over the cosine of incidence.
const STEPS: usize = 256;
/// Entries of a table of patchiness; a power of two.
const PATCHES: usize = 4096;
/// Side of a patch of seabed, metres.
const PATCH_M: f32 = 0.12;

/// What every material of a scene gives back.
#[derive(Clone, Debug)]
pub struct Surfaces {
    materials: Vec<Surface>,
    salt: u32,
}

/// What one material gives back.
#[derive(Clone, Debug)]
struct Surface {
    /// Backscatter per solid angle at cos θ = i / STEPS.
    response: Vec<f32>,
    /// Draws of its patchiness, mean 1; empty for an even surface.
    patches: Vec<f32>,
    /// |R|² of its impedance.
    reflectivity: f32,
}

impl Surfaces {
    /// Tables for the materials of a scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let table = |(number, material): (usize, &Material)| Surface {
            response: (0..=STEPS).map(|i| backscatter(material, i as f64 / STEPS as f64) as f32).collect(),
            patches: material.texture_nu.map_or_else(Vec::new, |nu| patches(nu, scene.texture_seed, number as u64)),
            reflectivity: material.reflectivity as f32,
        };
        Self { materials: scene.materials.iter().enumerate().map(table).collect(), salt: scene.texture_seed as u32 }
    }

    /// Backscatter of a material per solid angle of the ray's bundle, at the cosine of incidence.
    #[inline]
    #[must_use]
    pub fn response(&self, material: u16, cosine: f32) -> f32 {
        let table = &self.materials[usize::from(material)].response;
        let place = cosine.min(1.0) * STEPS as f32;
        let low = (place as usize).min(STEPS - 1);
        table[low] + (place - low as f32) * (table[low + 1] - table[low])
    }

    /// Power that a material's impedance reflects at normal incidence.
    #[inline]
    #[must_use]
    pub fn reflectivity(&self, material: u16) -> f32 {
        self.materials[usize::from(material)].reflectivity
    }

    /// Whether a material is patchy.
    #[inline]
    #[must_use]
    pub fn is_patchy(&self, material: u16) -> bool {
        !self.materials[usize::from(material)].patches.is_empty()
    }

    /// Patchiness of a patchy material at a place of the world: gamma-distributed with mean 1, the same at each look.
    #[inline]
    #[must_use]
    pub fn patch(&self, material: u16, x: f32, y: f32) -> f32 {
        let cell = |v: f32| (v * (1.0 / PATCH_M)).floor() as i32 as u32;
        let mut hash = cell(x).wrapping_mul(0x9e37_79b1) ^ cell(y).wrapping_mul(0x85eb_ca77) ^ self.salt;
        hash = (hash ^ (hash >> 15)).wrapping_mul(0x2c1b_3c6d);
        hash ^= hash >> 13;
        self.materials[usize::from(material)].patches[hash as usize % PATCHES]
    }
}

/// Backscattering cross-section of a surface per unit solid angle that it fills, `σ / cos θ`:
/// diffuse `μ·cos θ` and facets turned to the sonar, `|R|²·exp(−tan²θ / 2s²) / (8π·s²·cos⁵θ)`.
///
/// Source: Lambert's law in Urick (1983), ch. 8; facets: Jackson & Richardson (2007), High-Frequency Seafloor Acoustics,
/// ch. 13, high-frequency Kirchhoff limit with rms slope s in each direction.
#[must_use]
pub fn backscatter(material: &Material, cosine: f64) -> f64 {
    let diffuse = material.lambert_mu * cosine;
    if cosine < 0.05 || material.reflected <= 0.0 {
        return diffuse;
    }
    let s2 = material.slope_rad * material.slope_rad;
    let tan2 = 1.0 / (cosine * cosine) - 1.0;
    let lobe = exp(-tan2 / (2.0 * s2)) / (8.0 * std::f64::consts::PI * s2 * pow(cosine, 5.0));
    diffuse + material.reflected * lobe
}

/// Draws from Gamma(ν, 1/ν), mean 1, by Marsaglia & Tsang (2000), ACM Trans. Math. Softw. 26:363–372.
fn patches(nu: f64, seed: u64, material: u64) -> Vec<f32> {
    let mut stream = Stream::at(seed, "material", material, "texture");
    // Below 1 the method draws Gamma(ν + 1) and multiplies by U^(1/ν).
    let shape = if nu < 1.0 { nu + 1.0 } else { nu };
    let d = shape - 1.0 / 3.0;
    let c = 1.0 / (9.0 * d).sqrt();
    let mut draw = || loop {
        let normal = stream.normal();
        let v = 1.0 + c * normal;
        if v <= 0.0 {
            continue;
        }
        let v = v * v * v;
        let u = 1.0 - stream.unit();
        if crate::math::real::ln(u) < 0.5 * normal * normal + d * (1.0 - v + crate::math::real::ln(v)) {
            let boost = if nu < 1.0 { pow(1.0 - stream.unit(), 1.0 / nu) } else { 1.0 };
            return d * v * boost / nu;
        }
    };
    let all: Vec<f64> = (0..PATCHES).map(|_| draw()).collect();
    // The mean of what was drawn is made 1, so that patchiness moves no level.
    let mean = all.iter().sum::<f64>() / PATCHES as f64;
    all.iter().map(|v| (v / mean) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_have_mean_1_and_the_variance_of_their_shape() {
        for nu in [0.7, 1.5, 5.0, 20.0] {
            let draws = patches(nu, 3, 0);
            let mean = draws.iter().map(|&v| f64::from(v)).sum::<f64>() / PATCHES as f64;
            let variance = draws.iter().map(|&v| (f64::from(v) - mean).powi(2)).sum::<f64>() / PATCHES as f64;
            assert!((mean - 1.0).abs() < 1e-5);
            assert!((variance * nu - 1.0).abs() < 0.15, "nu {nu}: variance {variance}");
        }
    }

    #[test]
    fn the_specular_lobe_stands_on_the_diffuse_floor() {
        let mirror = Material { reflected: 0.8, slope_rad: 0.1, ..Material::lambert("steel", 0.05) };
        let head_on = 0.05 + 0.8 / (8.0 * std::f64::consts::PI * 0.01);
        assert!((backscatter(&mirror, 1.0) - head_on).abs() < 1e-12);
        assert!((backscatter(&mirror, 0.5) - 0.025).abs() < 1e-9, "60 degrees off the lobe is gone");
    }
}
