//! Dredge marks: the furrows that a dragged head leaves, side by side, with the spoil along their edges.

use serde::{Deserialize, Serialize};

use super::fractal::Fractal;
use super::noise::Noise;
use super::{HeightGrid, SeabedError, direction, not_negative, positive};
use crate::math::real::{cos, exp, radians, sin};
use crate::math::rng::Stream;

/// Furrows in one direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trench {
    /// Across a furrow, edge to edge, metres; at least six cells.
    pub width_m: f64,
    /// Of a furrow below the ground, metres.
    pub depth_m: f64,
    /// From furrow to furrow, metres; each is off by up to a quarter of it.
    pub spacing_m: f64,
    /// Along the furrows, degrees counter-clockwise from x.
    pub direction_deg: f64,
    /// Of the spoil on both sides, metres.
    pub bank_m: f64,
    /// How far furrows stray from the straight line, root mean square, metres.
    pub wander_m: f64,
    /// Root mean square height of the ground, metres.
    pub rms_m: f64,
}

impl Trench {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        positive("width_m", self.width_m)?;
        super::shown("width_m", self.width_m, cell_m, 6.0)?;
        positive("spacing_m", self.spacing_m)?;
        direction("direction_deg", self.direction_deg)?;
        [("depth_m", self.depth_m), ("bank_m", self.bank_m), ("wander_m", self.wander_m), ("rms_m", self.rms_m)]
            .into_iter()
            .try_for_each(|(name, value)| not_negative(name, value))
    }

    /// Adds ground and furrows to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        Fractal::rough(self.rms_m, 4.0 * self.width_m, grid).raise(grid, stream);
        let reach = grid.reach();
        // One line of the noise is one furrow's way: far-apart lines stray on their own.
        let wander = Noise::new(12.0 * self.width_m, reach, stream);
        let deep = Noise::new(3.0 * self.width_m, reach, stream);
        let lines = (reach / self.spacing_m).ceil() as i64 + 1;
        let furrows: Vec<Furrow> = (-lines..=lines)
            .map(|line| Furrow {
                across: self.spacing_m * (line as f64 + stream.uniform(-0.25, 0.25)),
                depth: self.depth_m * stream.uniform(0.6, 1.0),
            })
            .collect();
        let (s, c) = (sin(radians(self.direction_deg)), cos(radians(self.direction_deg)));
        grid.add(|x, y| {
            let across = c * y - s * x + self.wander_m * wander.at(x, y);
            let line = (across / self.spacing_m).round() as i64 + lines;
            let near = (line - 2).max(0) as usize..((line + 3).max(0) as usize).min(furrows.len());
            let bite = 1.0 + 0.15 * deep.at(x, y);
            let Some(near) = furrows.get(near) else { return 0.0 };
            let cut = near.iter().map(|furrow| bite * furrow.cut(self, across)).fold(0.0, f64::min);
            let bank = near.iter().map(|furrow| furrow.bank(self, across)).fold(0.0, f64::max);
            if cut < 0.0 { cut } else { bank }
        });
    }
}

struct Furrow {
    /// Of its middle from the line through the origin, metres.
    across: f64,
    depth: f64,
}

impl Furrow {
    /// A bowl with steep edges; 0 outside.
    fn cut(&self, trench: &Trench, across: f64) -> f64 {
        let u = (across - self.across) / (0.5 * trench.width_m);
        -self.depth * (1.0 - u * u * u * u).max(0.0)
    }

    /// Spoil that falls off from the edge over a third of the furrow's width.
    fn bank(&self, trench: &Trench, across: f64) -> f64 {
        let beyond = (across - self.across).abs() - 0.5 * trench.width_m;
        let u = 3.0 * beyond.max(0.0) / trench.width_m;
        trench.bank_m * exp(-u * u)
    }
}
