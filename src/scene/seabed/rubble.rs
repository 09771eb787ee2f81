//! Rubble: a bottom of cobbles, lying on each other where they are many.

use serde::{Deserialize, Serialize};

use super::fractal::Fractal;
use super::stones::{Form, Stones};
use super::{HeightGrid, SeabedError, not_negative, sediment, sizes, within};
use crate::math::rng::Stream;

/// Round stones side by side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rubble {
    /// Area of all stones per area of bottom, 0 to 2; from about 1.5 hardly any ground shows.
    pub cover: f64,
    /// Smallest and largest diameter, metres; small ones are more. At least three cells.
    pub size_m: [f64; 2],
    /// Sediment whose acoustics the stones have.
    pub sediment: String,
    /// Root mean square height of the ground under them, metres.
    pub rms_m: f64,
}

impl Rubble {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        within("cover", self.cover, [0.0, 2.0], "0 to 2")?;
        sizes("size_m", self.size_m, cell_m, 3.0)?;
        not_negative("rms_m", self.rms_m)?;
        sediment(&self.sediment)
    }

    /// Adds the ground and the stones to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        Fractal::rough(self.rms_m, 4.0, grid).raise(grid, stream);
        let stones = Stones { form: Form::Cobble, size_m: self.size_m, burial: 0.2, sediment: &self.sediment };
        let count = (self.cover * grid.extent() * grid.extent() / stones.mean_area()).round() as u64;
        stones.strew(count, grid, stream);
    }
}
