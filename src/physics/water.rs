//! The water that sound passes through.

use serde::{Deserialize, Serialize};

use super::absorption::francois_garrison_db_per_km;
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

    /// Absorption at a frequency, dB/m one way (Francois & Garrison).
    #[must_use]
    pub fn absorption_db_per_m(&self, frequency_khz: f64) -> f64 {
        francois_garrison_db_per_km(frequency_khz, self) / 1000.0
    }
}
