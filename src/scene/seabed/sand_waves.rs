//! Sand waves: dunes metres long, steep on the lee side, with ripples riding on them.

use serde::{Deserialize, Serialize};

use super::ripples::Ripples;
use super::{HeightGrid, SeabedError, direction, within};
use crate::math::rng::Stream;

/// Dunes under ripples, both driven by one current.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SandWaves {
    /// Crest to crest, metres.
    pub wavelength_m: f64,
    /// Crest to trough, metres.
    pub height_m: f64,
    /// Where the lee sides look, across the crests, degrees counter-clockwise from x.
    pub direction_deg: f64,
    /// 0 straight crests, 0.3 wandering, from about 0.5 crests fork and end, up to 1.
    pub irregularity: f64,
    /// Crest to crest of the ripples on the waves, metres; at least four cells.
    pub ripple_wavelength_m: f64,
    /// Crest to trough of the ripples, metres.
    pub ripple_height_m: f64,
    /// How far the ripples' crests are turned from those of the waves, degrees.
    pub ripple_turn_deg: f64,
    /// Root mean square height of the roughness under the ripples, metres.
    pub rms_m: f64,
}

impl SandWaves {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        direction("ripple_turn_deg", self.ripple_turn_deg)?;
        super::positive("ripple_wavelength_m", self.ripple_wavelength_m)?;
        within("ripple_height_m", self.ripple_height_m, [0.0, f64::MAX], "0 or more")?;
        super::shown("ripple_wavelength_m", self.ripple_wavelength_m, cell_m, 4.0)?;
        self.waves().check(cell_m)?;
        self.ripples().check(cell_m)
    }

    /// Adds waves and ripples to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        self.waves().raise(grid, stream);
        self.ripples().raise(grid, stream);
    }

    fn waves(&self) -> Ripples {
        Ripples {
            wavelength_m: self.wavelength_m,
            height_m: self.height_m,
            direction_deg: self.direction_deg,
            irregularity: self.irregularity,
            rms_m: 0.0,
        }
    }

    fn ripples(&self) -> Ripples {
        Ripples {
            wavelength_m: self.ripple_wavelength_m,
            height_m: self.ripple_height_m,
            direction_deg: self.direction_deg + self.ripple_turn_deg,
            irregularity: self.irregularity,
            rms_m: self.rms_m,
        }
    }
}
