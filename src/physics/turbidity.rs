//! Turbidity by name: loads of suspended sediment as recipes write them.
//!
//! Four points on a scale that is continuous in nature. Concentrations are round figures of the mass of suspended matter in
//! open, coastal and estuarine water: below 1 mg/l, some 10 mg/l, 100 mg/l and 1 g/l, each ten times the one before but for
//! the first. Source: Dyer (1986), Coastal and Estuarine Sediment Dynamics; Babin et al. (2003), Limnol. Oceanogr.
//! 48:843–859. Assumed, not measured: quartz of one radius (2650 kg/m³), coarser where a stronger current carries more, no
//! flocs, even through the water.

use serde::{Deserialize, Serialize};

use super::sediment_load::{Carrier, SedimentLoad, Suspension};
use super::stated::Stated;
use super::water::Water;

/// How turbid the water is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Turbidity {
    /// Open ocean and clear lakes: 0.5 mg/l of clay.
    #[default]
    Clear,
    /// Shelf seas and harbours in calm weather: 10 mg/l of fine silt.
    Coastal,
    /// Estuaries, rivers, after storms: 100 mg/l of silt.
    Turbid,
    /// Turbidity maxima, dredging plumes: 1 g/l of coarse silt.
    VeryTurbid,
}

impl Turbidity {
    /// All levels, clearest first.
    pub const ALL: [Self; 4] = [Self::Clear, Self::Coastal, Self::Turbid, Self::VeryTurbid];

    /// The level's name in recipes and reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Clear => "clear",
            Self::Coastal => "coastal",
            Self::Turbid => "turbid",
            Self::VeryTurbid => "very-turbid",
        }
    }

    /// The load that the name stands for. Source and assumptions: the module's documentation.
    #[must_use]
    pub fn load(self) -> SedimentLoad {
        let (concentration_kg_m3, grain_radius_m) = match self {
            Self::Clear => (0.000_5, 1e-6),
            Self::Coastal => (0.01, 4e-6),
            Self::Turbid => (0.1, 8e-6),
            Self::VeryTurbid => (1.0, 16e-6),
        };
        SedimentLoad { concentration_kg_m3, grain_radius_m, grain_density_kg_m3: 2650.0 }
    }

    /// What this load does to sound in a water at a frequency in kHz, beside the water's own absorption.
    pub fn acoustics(self, water: &Water, frequency_khz: f64) -> Stated<Suspension> {
        self.load().acoustics(&Carrier::of(water), 1000.0 * frequency_khz)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEA: Water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 5.0 };

    #[test]
    fn every_level_is_a_valid_load_and_harsher_than_the_last() {
        let effects = Turbidity::ALL.map(|level| {
            assert!(level.load().validate().is_ok());
            assert_eq!(serde_json::to_value(level).unwrap(), level.name());
            let effect = level.acoustics(&SEA, 1200.0);
            assert!(effect.is_within());
            effect.value
        });
        for pair in effects.windows(2) {
            assert!(pair[1].absorption_db_per_m() > 3.0 * pair[0].absorption_db_per_m());
            assert!(pair[1].volume_strength_db() > pair[0].volume_strength_db() + 10.0);
        }
    }

    #[test]
    fn clear_water_is_clear() {
        let clear = Turbidity::Clear.acoustics(&SEA, 1200.0).value;
        assert!(clear.absorption_db_per_m() < 0.005 * SEA.absorption_db_per_m(1200.0));
    }
}
