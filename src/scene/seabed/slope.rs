//! A bottom that rises evenly: banks, beaches, the foot of a quay.

use serde::{Deserialize, Serialize};

use super::fractal::Fractal;
use super::{HeightGrid, SeabedError, direction, not_negative, within};
use crate::math::real::{cos, radians, sin, tan};
use crate::math::rng::Stream;

/// An inclined plane with roughness on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Slope {
    /// From the level, degrees; 0 to 60.
    pub angle_deg: f64,
    /// Where it rises to, degrees counter-clockwise from x.
    pub direction_deg: f64,
    /// Root mean square height of the roughness, metres.
    pub rms_m: f64,
    /// Longest wave of the roughness, metres.
    pub longest_m: f64,
}

impl Slope {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        within("angle_deg", self.angle_deg, [0.0, 60.0], "0 to 60")?;
        direction("direction_deg", self.direction_deg)?;
        not_negative("rms_m", self.rms_m)?;
        super::shown("longest_m", self.longest_m, cell_m, 2.0)
    }

    /// Adds the plane and its roughness to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        let (rise, towards) = (tan(radians(self.angle_deg)), radians(self.direction_deg));
        let (along_x, along_y) = (rise * cos(towards), rise * sin(towards));
        grid.add(|x, y| along_x * x + along_y * y);
        Fractal::rough(self.rms_m, self.longest_m, grid).raise(grid, stream);
    }
}
