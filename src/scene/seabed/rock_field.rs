//! A field of boulders on softer ground.

use serde::{Deserialize, Serialize};

use super::fractal::Fractal;
use super::stones::{Form, MANY, Stones};
use super::{HeightGrid, SeabedError, not_negative, sediment, sizes, within};
use crate::math::rng::Stream;

/// Boulders on gentle roughness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RockField {
    /// Boulders on a hundred square metres.
    pub per_100_m2: f64,
    /// Smallest and largest diameter, metres; small ones are more. At least four cells.
    pub size_m: [f64; 2],
    /// Share of its height by which each is sunk, 0 to 0.9.
    pub burial: f64,
    /// Sediment whose acoustics the boulders have.
    pub sediment: String,
    /// Root mean square height of the ground between them, metres.
    pub rms_m: f64,
}

impl RockField {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        sizes("size_m", self.size_m, cell_m, 4.0)?;
        within("per_100_m2", self.per_100_m2, [0.0, 200.0 / self.stones().mean_area()], MANY)?;
        within("burial", self.burial, [0.0, 0.9], "0 to 0.9")?;
        not_negative("rms_m", self.rms_m)?;
        sediment(&self.sediment)
    }

    /// Adds the ground and the boulders to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        Fractal::rough(self.rms_m, 6.0, grid).raise(grid, stream);
        let count = (self.per_100_m2 * grid.extent() * grid.extent() / 100.0).round() as u64;
        self.stones().strew(count, grid, stream);
    }

    fn stones(&self) -> Stones<'_> {
        Stones { form: Form::Boulder, size_m: self.size_m, burial: self.burial, sediment: &self.sediment }
    }
}
