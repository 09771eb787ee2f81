//! Water with what is suspended in it: what a recipe's `water` section says.
//!
//! Adds nothing of its own: absorptions of water and suspension add, and the suspension alone scatters.

use serde::{Deserialize, Serialize};

use super::sediment_load::{Carrier, SedimentLoad, Suspension};
use super::stated::Stated;
use super::turbidity::Turbidity;
use super::water::Water;
use crate::math::Impossible;

/// A body of water and its load, alike everywhere; flat in recipes and plans.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Section", into = "Section")]
pub struct TurbidWater {
    /// The water itself.
    pub water: Water,
    /// What is suspended in it.
    pub turbidity: Load,
}

/// What is suspended in a water, by name or by its figures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Load {
    /// Open ocean and clear lakes, see [`Turbidity::Clear`].
    Clear,
    /// Shelf seas and harbours, see [`Turbidity::Coastal`].
    Coastal,
    /// Estuaries and rivers, see [`Turbidity::Turbid`].
    Turbid,
    /// Dredging plumes, see [`Turbidity::VeryTurbid`].
    VeryTurbid,
    /// Grains of one size.
    Sediment(SedimentLoad),
}

/// How it is written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Section {
    temperature_c: f64,
    salinity_ppt: f64,
    ph: f64,
    depth_m: f64,
    turbidity: Load,
}

impl TurbidWater {
    /// Refuses figures that no water has.
    ///
    /// # Errors
    /// The first figure out of range, with its key and the range.
    pub fn validate(&self) -> Result<(), Impossible> {
        self.water.validate()?;
        let placed = |fault: Impossible| {
            let key = match fault.key {
                "concentration_kg_m3" => "turbidity.sediment.concentration_kg_m3",
                "grain_radius_m" => "turbidity.sediment.grain_radius_m",
                "grain_density_kg_m3" => "turbidity.sediment.grain_density_kg_m3",
                other => other,
            };
            Impossible { key, ..fault }
        };
        self.turbidity.grains().validate().map_err(placed)
    }

    /// What the load does to sound of a frequency, beside the water's own absorption.
    pub fn suspension(&self, frequency_khz: f64) -> Stated<Suspension> {
        self.turbidity.grains().acoustics(&Carrier::of(&self.water), 1000.0 * frequency_khz)
    }

    /// Absorption of water and load together, dB/m one way: they add.
    ///
    /// Source: Richards, Heathershaw & Thorne (1996), J. Acoust. Soc. Am. 100:1447–1450, eq. 1.
    #[must_use]
    pub fn absorption_db_per_m(&self, frequency_khz: f64) -> f64 {
        self.water.absorption_db_per_m(frequency_khz) + self.suspension(frequency_khz).value.absorption_db_per_m()
    }
}

impl Load {
    /// The grains that it is.
    #[must_use]
    pub fn grains(self) -> SedimentLoad {
        match self {
            Self::Clear => Turbidity::Clear.load(),
            Self::Coastal => Turbidity::Coastal.load(),
            Self::Turbid => Turbidity::Turbid.load(),
            Self::VeryTurbid => Turbidity::VeryTurbid.load(),
            Self::Sediment(load) => load,
        }
    }
}

impl From<Section> for TurbidWater {
    fn from(section: Section) -> Self {
        let Section { temperature_c, salinity_ppt, ph, depth_m, turbidity } = section;
        Self { water: Water { temperature_c, salinity_ppt, ph, depth_m }, turbidity }
    }
}

impl From<TurbidWater> for Section {
    fn from(TurbidWater { water, turbidity }: TurbidWater) -> Self {
        let Water { temperature_c, salinity_ppt, ph, depth_m } = water;
        Self { temperature_c, salinity_ppt, ph, depth_m, turbidity }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(turbidity: serde_json::Value) -> TurbidWater {
        let section = serde_json::json!({
            "temperature_c": 10.0, "salinity_ppt": 35.0, "ph": 8.0, "depth_m": 5.0, "turbidity": turbidity
        });
        serde_json::from_value(section).unwrap()
    }

    #[test]
    fn a_name_is_the_load_that_it_stands_for() {
        for level in Turbidity::ALL {
            let water = read(level.name().into());
            assert_eq!(water.turbidity.grains(), level.load());
            let alone = level.acoustics(&water.water, 900.0).value;
            assert_eq!(water.suspension(900.0).value, alone);
            let both = water.water.absorption_db_per_m(900.0) + alone.absorption_db_per_m();
            assert!((water.absorption_db_per_m(900.0) - both).abs() < 1e-12);
        }
    }

    #[test]
    fn a_load_by_figures_is_read_written_and_checked() {
        let load = |mass: f64| {
            read(serde_json::json!({"sediment": {
                "concentration_kg_m3": mass, "grain_radius_m": 2e-5, "grain_density_kg_m3": 2650.0
            }}))
        };
        let water = load(0.2);
        let again: TurbidWater = serde_json::from_value(serde_json::to_value(water).unwrap()).unwrap();
        assert_eq!(again, water);
        assert!(water.validate().is_ok());
        assert_eq!(load(500.0).validate().unwrap_err().key, "turbidity.sediment.concentration_kg_m3");
    }
}
