//! The water that sound passes through.

use serde::{Deserialize, Serialize};

use super::absorption::francois_garrison_db_per_km;

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

/// A figure that no water has.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key}: {value} is outside {low} to {high}")]
pub struct WaterError {
    /// Key in the water section.
    pub key: &'static str,
    /// The figure.
    pub value: f64,
    /// Lowest possible.
    pub low: f64,
    /// Highest possible.
    pub high: f64,
}

impl Water {
    /// Refuses figures outside what water on Earth shows and the equations cover.
    ///
    /// # Errors
    /// The first figure out of range, with its key and the range.
    pub fn validate(&self) -> Result<(), WaterError> {
        let ranges = [
            ("temperature_c", self.temperature_c, -2.0, 40.0),
            ("salinity_ppt", self.salinity_ppt, 0.0, 45.0),
            ("ph", self.ph, 6.0, 9.0),
            ("depth_m", self.depth_m, 0.0, 11_000.0),
        ];
        for (key, value, low, high) in ranges {
            if !(low..=high).contains(&value) {
                return Err(WaterError { key, value, low, high });
            }
        }
        Ok(())
    }

    /// Absorption at a frequency, dB/m one way (Francois & Garrison).
    #[must_use]
    pub fn absorption_db_per_m(&self, frequency_khz: f64) -> f64 {
        francois_garrison_db_per_km(frequency_khz, self) / 1000.0
    }
}
