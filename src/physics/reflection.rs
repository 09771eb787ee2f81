//! How much of a plane wave an interface sends back: half spaces, layers, the sea surface.
//!
//! Fluids only: shear waves in solids are left out, which is exact at normal incidence. Knows no materials by name.

use super::numeric::Complex;
use crate::math::real::{acos, cos, exp, log10, sin};

/// A fluid, or a solid as its compressional waves see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Density, kg/m³.
    pub density_kg_m3: f64,
    /// Speed of compressional waves, m/s.
    pub sound_speed_m_s: f64,
    /// Loss parameter δ: the ratio of the imaginary to the real part of the wavenumber; 0 where nothing is absorbed.
    pub loss: f64,
}

impl Medium {
    /// Characteristic impedance ρ·c, rayl. Source: definition; Urick (1983), ch. 1.
    #[must_use]
    pub fn impedance_rayl(&self) -> f64 {
        self.density_kg_m3 * self.sound_speed_m_s
    }
}

/// Pressure reflection coefficient of a half space at normal incidence, `(Z₂ − Z₁)/(Z₂ + Z₁)`; negative from a softer one.
///
/// Source: Urick (1983), ch. 5; Medwin & Clay (1998), ch. 2.
#[must_use]
pub fn normal_incidence(impedance_1_rayl: f64, impedance_2_rayl: f64) -> f64 {
    (impedance_2_rayl - impedance_1_rayl) / (impedance_2_rayl + impedance_1_rayl)
}

/// Level of a reflection, `20·log |R|` dB, not below −180 dB: what is perfectly matched returns that instead of −∞.
///
/// Source: definition of the reflection loss; Urick (1983), ch. 5.
#[must_use]
pub fn reflection_db(coefficient: f64) -> f64 {
    20.0 * log10(coefficient.abs().max(1e-9))
}

/// Magnitude of the reflection coefficient of a plane interface of two fluids, grazing angle γ in radians (0–π/2).
///
/// `R = (m·sin γ − √(n² − cos²γ)) / (m·sin γ + √(n² − cos²γ))`, m = ρ₂/ρ₁, n = (1 + iδ)·c₁/c₂; the loss of the first
/// medium is not used. Source: Rayleigh; Brekhovskikh & Lysanov (2003), ch. 3; loss as in APL-UW TR 9407 (1994), ch. IV.
#[must_use]
pub fn rayleigh(first: &Medium, second: &Medium, grazing_rad: f64) -> f64 {
    let n = Complex::real(first.sound_speed_m_s / second.sound_speed_m_s) * Complex::new(1.0, second.loss);
    let cosine = cos(grazing_rad);
    let vertical = (n * n - Complex::real(cosine * cosine)).sqrt();
    let heavy = Complex::real(second.density_kg_m3 / first.density_kg_m3 * sin(grazing_rad));
    ((heavy - vertical) / (heavy + vertical)).abs()
}

/// Grazing angle in radians below which a faster second medium reflects all, `acos(c₁/c₂)`; none where it is slower.
///
/// Source: Snell's law; Urick (1983), ch. 5.
#[must_use]
pub fn critical_grazing_rad(first: &Medium, second: &Medium) -> Option<f64> {
    let ratio = first.sound_speed_m_s / second.sound_speed_m_s;
    (ratio < 1.0).then(|| acos(ratio))
}

/// A flat layer between two half spaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// What the layer is made of.
    pub medium: Medium,
    /// Its thickness, m.
    pub thickness_m: f64,
}

impl Layer {
    /// Magnitude of the reflection coefficient at normal incidence, between impedances before and behind, at a frequency in Hz.
    ///
    /// `R = (R₁₂ + R₂₃·e^(2ikd)) / (1 + R₁₂·R₂₃·e^(2ikd))`, k = (1 + iδ)·2πf/c. A wall a half wavelength thick vanishes; so
    /// does one much thinner. Loss damps the wave inside and is left out of the impedance, right for δ ≪ 1. Source: Brekhovskikh & Lysanov (2003), eq. 3.2.5; Medwin & Clay (1998), ch. 2.23.
    #[must_use]
    pub fn reflection(&self, frequency_hz: f64, before_rayl: f64, behind_rayl: f64) -> f64 {
        let impedance = self.medium.impedance_rayl();
        let front = Complex::real(normal_incidence(before_rayl, impedance));
        let back = Complex::real(normal_incidence(impedance, behind_rayl));
        let k = 2.0 * std::f64::consts::PI * frequency_hz / self.medium.sound_speed_m_s;
        let phase = 2.0 * k * self.thickness_m;
        let there_and_back = back * Complex::new(-self.medium.loss * phase, phase).exp();
        ((front + there_and_back) / (Complex::ONE + front * there_and_back)).abs()
    }
}

/// Coherent reflection coefficient of the sea surface, `−e^(−2k²σ²·sin²γ)`: k in rad/m, σ the rms wave height in m.
///
/// A calm surface is a mirror of the opposite sign; a rough one scatters what is missing.
/// Source: Eckart (1953), J. Acoust. Soc. Am. 25:566–570; Brekhovskikh & Lysanov (2003), ch. 9.
#[must_use]
pub fn sea_surface(wavenumber_rad_m: f64, rms_height_m: f64, grazing_rad: f64) -> f64 {
    let roughness = wavenumber_rad_m * rms_height_m * sin(grazing_rad);
    -exp(-2.0 * roughness * roughness)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::radians;

    const WATER: Medium = Medium { density_kg_m3: 1026.0, sound_speed_m_s: 1500.0, loss: 0.0 };
    const SAND: Medium = Medium { density_kg_m3: 1980.0, sound_speed_m_s: 1790.0, loss: 0.0 };

    #[test]
    fn vertical_rayleigh_is_the_impedance_formula() {
        let vertical = rayleigh(&WATER, &SAND, radians(90.0));
        let normal = normal_incidence(WATER.impedance_rayl(), SAND.impedance_rayl());
        assert!((vertical - normal).abs() < 1e-12);
        assert!((normal - 0.39448).abs() < 1e-5);
    }

    #[test]
    fn below_the_critical_angle_all_returns_unless_there_is_loss() {
        let critical = critical_grazing_rad(&WATER, &SAND).unwrap();
        assert!((rayleigh(&WATER, &SAND, 0.9 * critical) - 1.0).abs() < 1e-12);
        assert!(rayleigh(&WATER, &SAND, 1.1 * critical) < 1.0);
        let lossy = rayleigh(&WATER, &Medium { loss: 0.017, ..SAND }, 0.5 * critical);
        assert!(lossy < 0.99 && lossy > 0.8, "{lossy}");
        assert_eq!(critical_grazing_rad(&SAND, &WATER), None);
    }

    #[test]
    fn layers_vanish_at_half_a_wavelength_and_turn_into_half_spaces_when_they_absorb() {
        let steel = Medium { density_kg_m3: 7850.0, sound_speed_m_s: 5900.0, loss: 0.0 };
        let water = WATER.impedance_rayl();
        let frequency = 750e3;
        let half_wave = Layer { medium: steel, thickness_m: 0.5 * 5900.0 / frequency };
        assert!(half_wave.reflection(frequency, water, water) < 1e-12);
        let plate = Layer { medium: steel, thickness_m: 0.005 };
        assert!((plate.reflection(frequency, 1.539e6, 1.539e6) - 0.99611).abs() < 1e-4);
        let thick = Layer { medium: Medium { loss: 0.1, ..steel }, thickness_m: 1.0 };
        let half_space = normal_incidence(water, steel.impedance_rayl());
        assert!((thick.reflection(frequency, water, water) - half_space).abs() < 1e-9);
    }

    #[test]
    fn a_calm_surface_is_a_mirror_and_a_rough_one_is_not() {
        assert_eq!(sea_surface(3000.0, 0.0, 0.5), -1.0);
        let k = 2.0 * std::f64::consts::PI / 0.002;
        assert!((sea_surface(k, 1e-4, radians(90.0)) + exp(-2.0 * 0.314_159_265 * 0.314_159_265)).abs() < 1e-8);
        assert!(sea_surface(k, 0.01, radians(30.0)).abs() < 1e-20);
    }

    #[test]
    fn a_matched_medium_reflects_minus_180_db() {
        assert_eq!(reflection_db(0.0), -180.0);
        assert!((reflection_db(-0.1) + 20.0).abs() < 1e-12);
    }
}
