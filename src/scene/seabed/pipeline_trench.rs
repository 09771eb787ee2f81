//! A trench cut for a pipeline or a cable: a level floor, sloping sides, spoil heaped along both.

use serde::{Deserialize, Serialize};

use super::fractal::Fractal;
use super::noise::Noise;
use super::{HeightGrid, SeabedError, direction, not_negative, positive, within};
use crate::math::real::{cos, exp, radians, sin, tan};
use crate::math::rng::Stream;

/// One trench through the world's origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PipelineTrench {
    /// Width of its floor, metres; at least two cells.
    pub floor_m: f64,
    /// Below the ground, metres.
    pub depth_m: f64,
    /// Of its sides from the level, degrees; 5 to 80.
    pub side_deg: f64,
    /// Along the trench, degrees counter-clockwise from x.
    pub direction_deg: f64,
    /// Height of the spoil on both sides, metres.
    pub bank_m: f64,
    /// Root mean square height of the ground, metres.
    pub rms_m: f64,
}

impl PipelineTrench {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        positive("floor_m", self.floor_m)?;
        super::shown("floor_m", self.floor_m, cell_m, 2.0)?;
        not_negative("depth_m", self.depth_m)?;
        within("side_deg", self.side_deg, [5.0, 80.0], "5 to 80")?;
        direction("direction_deg", self.direction_deg)?;
        not_negative("bank_m", self.bank_m)?;
        not_negative("rms_m", self.rms_m)
    }

    /// Adds ground, trench and spoil to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        Fractal::rough(self.rms_m, 5.0, grid).raise(grid, stream);
        let (s, c) = (sin(radians(self.direction_deg)), cos(radians(self.direction_deg)));
        let steepness = tan(radians(self.side_deg));
        let reach = self.depth_m / steepness;
        let [ragged, clods] = [3.5, 1.3].map(|wave: f64| Noise::new(wave.max(2.0 * grid.cell()), grid.reach(), stream));
        let width = 0.6 * (reach + self.floor_m);
        grid.add(|x, y| {
            let off = (c * y - s * x).abs() - 0.5 * self.floor_m;
            let edge = off + 0.06 * reach * ragged.at(x, y);
            let cut = (edge * steepness - self.depth_m).clamp(-self.depth_m, 0.0);
            let from_heap = (off - reach - width) / (0.5 * width);
            let heap = self.bank_m * exp(-from_heap * from_heap) * (1.0 + 0.15 * clods.at(x, y));
            cut + if cut < 0.0 { 0.0 } else { heap }
        });
    }
}
