//! Reefs: ledges of rock that step up out of the sand, with coral heads on them.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::fractal::Fractal;
use super::noise::Noise;
use super::stones::{Form, MANY, Stones};
use super::{HeightGrid, SeabedError, not_negative, positive, sediment, sizes, within};
use crate::math::rng::Stream;

/// Share of a step's plan that its steep face takes.
const FACE: f64 = 0.15;

/// Terraced patches of reef in sand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reef {
    /// From the sand to the top of the reef, metres.
    pub relief_m: f64,
    /// Steps on the way up, each with a steep face; 1 to 8.
    pub ledges: u32,
    /// Across a patch of reef, metres.
    pub patch_m: f64,
    /// Part of the bottom that is reef, 0 to 1.
    pub share: f64,
    /// Coral heads on a hundred square metres of reef.
    pub heads_per_100_m2: f64,
    /// Smallest and largest diameter of the heads, metres; small ones are more. At least four cells.
    pub head_m: [f64; 2],
    /// Sediment whose acoustics the reef has.
    pub sediment: String,
    /// Root mean square height of the roughness, metres.
    pub rms_m: f64,
}

impl Reef {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        not_negative("relief_m", self.relief_m)?;
        within("ledges", self.ledges.into(), [1.0, 8.0], "1 to 8")?;
        positive("patch_m", self.patch_m)?;
        super::shown("patch_m", self.patch_m, cell_m, 8.0)?;
        within("share", self.share, [0.0, 1.0], "0 to 1")?;
        sizes("head_m", self.head_m, cell_m, 4.0)?;
        within("heads_per_100_m2", self.heads_per_100_m2, [0.0, 200.0 / self.heads().mean_area()], MANY)?;
        not_negative("rms_m", self.rms_m)?;
        sediment(&self.sediment)
    }

    /// Adds reef, heads and sand to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        Fractal::rough(self.rms_m, 0.5 * self.patch_m, grid).raise(grid, stream);
        let shore = Shore::new(self, grid.reach(), stream);
        let shore_at = shore.at_share(self.share, grid);
        let steps = f64::from(self.ledges);
        let knobs = Noise::new((0.1 * self.patch_m).max(4.0 * grid.cell()), grid.reach(), stream);
        let inland = |x: f64, y: f64| shore.at(x, y) - shore_at;
        // From the shore to the top over one unit of the noise: about its root mean square.
        let height = |x: f64, y: f64| {
            let place = (inland(x, y)).clamp(0.0, 1.0) * steps;
            let step = place.floor().min(steps - 1.0);
            let stepped = (step + ((place - step) / FACE).min(1.0)) * self.relief_m / steps;
            // Rock is rougher than the sand about it.
            if inland(x, y) <= 0.0 { 0.0 } else { stepped + self.rms_m * knobs.at(x, y) }
        };
        grid.add(height);
        grid.paint(&self.sediment, |x, y| inland(x, y) > 0.0);
        self.strew_heads(&inland, grid, stream);
    }

    fn heads(&self) -> Stones<'_> {
        Stones { form: Form::CoralHead, size_m: self.head_m, burial: 0.15, sediment: &self.sediment }
    }

    fn strew_heads(&self, inland: &dyn Fn(f64, f64) -> f64, grid: &mut HeightGrid, stream: &mut Stream) {
        let half = 0.5 * grid.extent();
        let count = (self.heads_per_100_m2 * grid.extent() * grid.extent() / 100.0).round() as u64;
        for _ in 0..count {
            let middle = DVec2::new(stream.uniform(-half, half), stream.uniform(-half, half));
            if inland(middle.x, middle.y) > 0.0 {
                self.heads().lay(middle, grid, stream);
            }
        }
    }
}

/// How far inland a place is: four octaves of noise.
struct Shore([Noise; 4]);

/// Wavelength of each octave, in patches, and its height.
const OCTAVES: [[f64; 2]; 4] = [[2.0, 1.0], [0.7, 0.35], [0.25, 0.14], [0.1, 0.07]];

impl Shore {
    fn new(reef: &Reef, reach: f64, stream: &mut Stream) -> Self {
        Self(OCTAVES.map(|[wave, _]| Noise::new(wave * reef.patch_m, reach, stream)))
    }

    fn at(&self, x: f64, y: f64) -> f64 {
        self.0.iter().zip(OCTAVES).map(|(noise, [_, height])| height * noise.at(x, y)).sum()
    }

    /// The level above which `share` of the square lies.
    fn at_share(&self, share: f64, grid: &HeightGrid) -> f64 {
        let place = |k: u32| grid.extent() * ((f64::from(k) + 0.5) / 64.0 - 0.5);
        let mut levels: Vec<f64> =
            (0..64).flat_map(|j| (0..64).map(move |i| (i, j))).map(|(i, j)| self.at(place(i), place(j))).collect();
        levels.sort_by(f64::total_cmp);
        let below = ((1.0 - share) * levels.len() as f64).round() as usize;
        levels.get(below).copied().unwrap_or(f64::MAX)
    }
}
