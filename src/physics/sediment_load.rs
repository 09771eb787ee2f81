//! What mineral grains in suspension do to sound: viscous and scattering absorption, and volume backscatter.
//!
//! One grain size, single scattering, no flocs, bubbles or plankton. `turbidity` gives loads by name.

use serde::{Deserialize, Serialize};

use super::absorption::DB_PER_NEPER;
use super::stated::Stated;
use super::water::Water;
use crate::math::Impossible;
use crate::math::real::{db_from_power, exp};

/// Grains in suspension.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SedimentLoad {
    /// Mass of the grains in a volume of water, kg/m³ (1 kg/m³ = 1000 mg/l).
    pub concentration_kg_m3: f64,
    /// Radius of a grain, m.
    pub grain_radius_m: f64,
    /// Density of a grain, kg/m³; quartz has 2650.
    pub grain_density_kg_m3: f64,
}

/// The water around the grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carrier {
    /// Speed of sound, m/s.
    pub sound_speed_m_s: f64,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
    /// Kinematic viscosity, m²/s.
    pub kinematic_viscosity_m2_s: f64,
}

impl Carrier {
    /// The carrier that a body of water is: density after TEOS-10, viscosity after Sharqawy et al.
    #[must_use]
    pub fn of(water: &Water) -> Self {
        let state = water.seawater();
        Self {
            sound_speed_m_s: water.sound_speed_m_s(),
            density_kg_m3: state.density_kg_m3().value,
            kinematic_viscosity_m2_s: state.kinematic_viscosity_m2_s().value,
        }
    }
}

/// What a suspension does to sound of one frequency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Suspension {
    /// Absorption by the grains' lag behind the water, dB/m one way.
    pub viscous_db_per_m: f64,
    /// Absorption by scattering out of the path, dB/m one way.
    pub scattering_db_per_m: f64,
    /// Backscattering cross-section of a volume, m⁻¹ (per steradian).
    pub backscatter_per_m: f64,
}

impl Suspension {
    /// Both absorptions together, dB/m one way.
    #[must_use]
    pub fn absorption_db_per_m(&self) -> f64 {
        self.viscous_db_per_m + self.scattering_db_per_m
    }

    /// Volume backscattering strength S_v, dB re 1 m⁻¹; −∞ without grains.
    #[must_use]
    pub fn volume_strength_db(&self) -> f64 {
        db_from_power(self.backscatter_per_m)
    }
}

impl SedimentLoad {
    /// Refuses loads that are no suspension.
    ///
    /// # Errors
    /// The first figure out of range, with its key and the range: beyond 100 kg/m³ it is mud, not water.
    pub fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("concentration_kg_m3", self.concentration_kg_m3, 0.0, 100.0)?;
        Impossible::outside("grain_radius_m", self.grain_radius_m, 1e-8, 0.01)?;
        Impossible::outside("grain_density_kg_m3", self.grain_density_kg_m3, 1000.0, 8000.0)
    }

    /// The suspension's effect at a frequency in Hz. Stated for up to 1 % of the volume, where grains scatter one by
    /// one, and `k·a` up to 10: both are bounds of this project; larger grains do not stay in suspension before a sonar.
    ///
    /// Source: the three functions of this module.
    pub fn acoustics(&self, carrier: &Carrier, frequency_hz: f64) -> Stated<Suspension> {
        let value = Suspension {
            viscous_db_per_m: viscous_absorption_db_per_m(self, carrier, frequency_hz),
            scattering_db_per_m: scattering_absorption_db_per_m(self, carrier, frequency_hz),
            backscatter_per_m: backscatter_per_m(self, carrier, frequency_hz),
        };
        Stated::new(
            value,
            &[
                ("volume fraction of sediment", self.concentration_kg_m3 / self.grain_density_kg_m3, 0.0, 0.01),
                ("ka", self.ka(carrier, frequency_hz), 0.0, 10.0),
            ],
        )
    }

    /// Size of a grain in wavelengths: `k·a`. Source: definition.
    #[must_use]
    pub fn ka(&self, carrier: &Carrier, frequency_hz: f64) -> f64 {
        angular(frequency_hz) / carrier.sound_speed_m_s * self.grain_radius_m
    }
}

/// Absorption by viscosity, dB/m one way, at a frequency in Hz: `φ·k·(σ − 1)²/2 · s/(s² + (σ + τ)²)` Np/m.
///
/// φ = volume fraction, σ = ρₛ/ρ, β = √(ω/2ν), s = 9/(4βa)·(1 + 1/(βa)), τ = ½ + 9/(4βa).
/// Source: Urick (1948), J. Acoust. Soc. Am. 20:283–289; Richards, Heathershaw & Thorne (1996), ibid. 100:1447–1450.
#[must_use]
pub fn viscous_absorption_db_per_m(load: &SedimentLoad, carrier: &Carrier, frequency_hz: f64) -> f64 {
    let omega = angular(frequency_hz);
    let ba = (omega / (2.0 * carrier.kinematic_viscosity_m2_s)).sqrt() * load.grain_radius_m;
    let sigma = load.grain_density_kg_m3 / carrier.density_kg_m3;
    let s = 9.0 / (4.0 * ba) * (1.0 + 1.0 / ba);
    let tau = 0.5 + 9.0 / (4.0 * ba);
    let fraction = load.concentration_kg_m3 / load.grain_density_kg_m3;
    let k = omega / carrier.sound_speed_m_s;
    let nepers = 0.5 * fraction * k * (sigma - 1.0) * (sigma - 1.0) * s / (s * s + (sigma + tau) * (sigma + tau));
    nepers * DB_PER_NEPER
}

/// Absorption by scattering, dB/m one way, at a frequency in Hz: `3·χ·M/(4·a·ρₛ)` Np/m,
/// χ = 0.29x⁴/(0.95 + 1.28x² + 0.25x⁴), x = ka.
///
/// Source: Thorne & Meral (2008), Continental Shelf Research 28:309–317, normalised total scattering cross-section.
#[must_use]
pub fn scattering_absorption_db_per_m(load: &SedimentLoad, carrier: &Carrier, frequency_hz: f64) -> f64 {
    let x = load.ka(carrier, frequency_hz);
    let x2 = x * x;
    let chi = 0.29 * x2 * x2 / (0.95 + 1.28 * x2 + 0.25 * x2 * x2);
    let nepers = 3.0 * chi * load.concentration_kg_m3 / (4.0 * load.grain_radius_m * load.grain_density_kg_m3);
    nepers * DB_PER_NEPER
}

/// Backscattering cross-section of a volume, m⁻¹, at a frequency in Hz: `3·f²·M/(16π·a·ρₛ)`.
///
/// f = x²·(1 − 0.35e^(−((x−1.5)/0.7)²))·(1 + 0.5e^(−((x−1.8)/2.2)²))/(1 + 0.9x²), x = ka.
/// Source: Thorne & Meral (2008), as above, form factor.
#[must_use]
pub fn backscatter_per_m(load: &SedimentLoad, carrier: &Carrier, frequency_hz: f64) -> f64 {
    let x = load.ka(carrier, frequency_hz);
    let bell = |middle: f64, width: f64| {
        let off = (x - middle) / width;
        exp(-off * off)
    };
    let form = x * x * (1.0 - 0.35 * bell(1.5, 0.7)) * (1.0 + 0.5 * bell(1.8, 2.2)) / (1.0 + 0.9 * x * x);
    3.0 * form * form * load.concentration_kg_m3
        / (16.0 * std::f64::consts::PI * load.grain_radius_m * load.grain_density_kg_m3)
}

fn angular(frequency_hz: f64) -> f64 {
    2.0 * std::f64::consts::PI * frequency_hz
}

#[cfg(test)]
mod tests {
    use super::*;

    const CARRIER: Carrier =
        Carrier { sound_speed_m_s: 1500.0, density_kg_m3: 1026.0, kinematic_viscosity_m2_s: 1.3e-6 };
    const SILT: SedimentLoad =
        SedimentLoad { concentration_kg_m3: 0.1, grain_radius_m: 3e-5, grain_density_kg_m3: 2650.0 };

    #[test]
    fn known_values_of_a_silt_suspension() {
        let silt = SILT.acoustics(&CARRIER, 750e3);
        assert!(silt.is_within());
        assert!((silt.value.viscous_db_per_m / 0.007_473_3 - 1.0).abs() < 1e-4);
        assert!((silt.value.scattering_db_per_m / 0.000_195_03 - 1.0).abs() < 1e-4);
        assert!((silt.value.volume_strength_db() + 50.294).abs() < 1e-3);
    }

    #[test]
    fn clay_absorbs_by_viscosity_and_sand_by_scattering() {
        let [clay, sand] = [2e-6, 2e-4].map(|grain_radius_m| SedimentLoad { grain_radius_m, ..SILT });
        let [clay, sand] = [clay, sand].map(|load| load.acoustics(&CARRIER, 1.2e6).value);
        assert!(clay.viscous_db_per_m > 1e3 * clay.scattering_db_per_m);
        assert!(sand.scattering_db_per_m > 10.0 * sand.viscous_db_per_m);
    }

    #[test]
    fn clean_water_does_nothing_and_mud_is_refused() {
        let clean = SedimentLoad { concentration_kg_m3: 0.0, ..SILT };
        let effect = clean.acoustics(&CARRIER, 1e6).value;
        assert_eq!((effect.absorption_db_per_m(), effect.backscatter_per_m), (0.0, 0.0));
        assert!(SedimentLoad { concentration_kg_m3: 500.0, ..SILT }.validate().is_err());
        assert!(!SedimentLoad { concentration_kg_m3: 50.0, ..SILT }.acoustics(&CARRIER, 1e6).is_within());
    }
}
