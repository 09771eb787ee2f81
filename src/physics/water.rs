//! The water that sound passes through.

use serde::{Deserialize, Serialize};

use super::absorption::francois_garrison;
use super::seawater::{Seawater, pressure_dbar};
use super::sound_speed::mackenzie_m_s;
use super::stated::Stated;
use crate::math::Impossible;

/// A body of water, alike everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Water {
    /// Temperature, °C.
    pub temperature_c: f64,
    /// Salinity, parts per thousand.
    pub salinity_ppt: f64,
    /// Acidity.
    pub ph: f64,
    /// Depth of the scene below the surface, metres.
    pub depth_m: f64,
}

/// The equation that a sound speed comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpeedEquation {
    /// Mackenzie (1981), within its range: the open sea.
    Mackenzie,
    /// TEOS-10, everywhere else: lakes, estuaries, brackish and warm seas, trenches.
    Teos10,
}

impl Water {
    /// Refuses figures outside what water on Earth shows and the equations cover.
    ///
    /// # Errors
    /// The first figure out of range, with its key and the range.
    pub fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("temperature_c", self.temperature_c, -2.0, 40.0)?;
        Impossible::outside("salinity_ppt", self.salinity_ppt, 0.0, 45.0)?;
        Impossible::outside("ph", self.ph, 6.0, 9.0)?;
        Impossible::outside("depth_m", self.depth_m, 0.0, 11_000.0)
    }

    /// Absorption at a frequency, dB/m one way (Francois & Garrison; beyond its range carried on as
    /// [`francois_garrison`] documents, which also says where).
    #[must_use]
    pub fn absorption_db_per_m(&self, frequency_khz: f64) -> f64 {
        francois_garrison(frequency_khz, self).value.total() / 1000.0
    }

    /// Speed of sound, m/s: see [`Self::sound_speed`].
    #[must_use]
    pub fn sound_speed_m_s(&self) -> f64 {
        self.sound_speed().1.value
    }

    /// Speed of sound, m/s, and its equation: Mackenzie's where its range holds, as oceanographers would; TEOS-10, which has
    /// no gap between fresh water and brine, elsewhere. They differ by less than 0.1 m/s where they meet.
    pub fn sound_speed(&self) -> (SpeedEquation, Stated<f64>) {
        let mackenzie = mackenzie_m_s(self.temperature_c, self.salinity_ppt, self.depth_m);
        if mackenzie.is_within() {
            (SpeedEquation::Mackenzie, mackenzie)
        } else {
            (SpeedEquation::Teos10, self.seawater().sound_speed_m_s())
        }
    }

    /// Wavelength, m, at a frequency in kHz: `c / f`.
    #[must_use]
    pub fn wavelength_m(&self, frequency_khz: f64) -> f64 {
        self.sound_speed_m_s() / (1000.0 * frequency_khz)
    }

    /// The state that thermodynamics knows; pressure at 45° latitude, where it is the mean of all oceans within 0.3 %.
    #[must_use]
    pub fn seawater(&self) -> Seawater {
        Seawater {
            temperature_c: self.temperature_c,
            salinity_ppt: self.salinity_ppt,
            pressure_dbar: pressure_dbar(self.depth_m, 45.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEA: Water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 5.0 };

    #[test]
    fn the_sea_goes_by_mackenzie_and_a_lake_by_teos_10() {
        let (equation, speed) = SEA.sound_speed();
        assert_eq!(equation, SpeedEquation::Mackenzie);
        assert!((speed.value - 1489.884).abs() < 0.01, "{}", speed.value);
        let lake = Water { salinity_ppt: 0.0, depth_m: 0.0, ..SEA };
        assert_eq!(lake.sound_speed().0, SpeedEquation::Teos10);
        assert!((lake.sound_speed_m_s() - 1447.28).abs() < 0.05, "{}", lake.sound_speed_m_s());
    }

    #[test]
    fn the_choice_of_equation_leaves_no_step() {
        let [salty, brackish] = [30.0, 29.999].map(|salinity_ppt| Water { salinity_ppt, ..SEA }.sound_speed_m_s());
        assert!((salty - brackish).abs() < 0.1, "{salty} {brackish}");
    }

    #[test]
    fn absorption_and_wavelength() {
        assert!((SEA.absorption_db_per_m(750.0) - 0.222_32).abs() < 1e-5);
        assert!((SEA.wavelength_m(750.0) - 1.9865e-3).abs() < 1e-6);
    }
}
