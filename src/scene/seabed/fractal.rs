//! Hills on hills: octaves of noise whose heights follow a power of their wavelength.

use serde::{Deserialize, Serialize};

use super::noise::Noise;
use super::{HeightGrid, SeabedError, not_negative, positive, shown};
use crate::math::real::{ln, pow};
use crate::math::rng::Stream;

/// Roughness between two wavelengths; the height of a wave goes with its length to the power `hurst`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fractal {
    /// Root mean square height, metres; met exactly in each seabed.
    pub rms_m: f64,
    /// Longest wave, metres.
    pub longest_m: f64,
    /// Shortest wave, metres; at least two cells.
    pub shortest_m: f64,
    /// Hurst exponent: 0.5 jagged, 0.8 as many seabeds, 1 smooth. Above 0, up to 1.5.
    pub hurst: f64,
}

impl Fractal {
    /// Roughness for a shape to stand on: from `longest_m` down to three cells.
    pub(super) fn rough(rms_m: f64, longest_m: f64, grid: &HeightGrid) -> Self {
        let shortest_m = 3.0 * grid.cell();
        Self { rms_m, longest_m: longest_m.max(shortest_m), shortest_m, hurst: 0.8 }
    }

    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        not_negative("rms_m", self.rms_m)?;
        positive("shortest_m", self.shortest_m)?;
        if !(self.longest_m.is_finite() && self.longest_m >= self.shortest_m) {
            return Err(SeabedError::Range { name: "longest_m", value: self.longest_m, range: "shortest_m or more" });
        }
        if !(self.hurst > 0.0 && self.hurst <= 1.5) {
            return Err(SeabedError::Range { name: "hurst", value: self.hurst, range: "above 0 and up to 1.5" });
        }
        shown("shortest_m", self.shortest_m, cell_m, 2.0)
    }

    /// Adds the roughness to a grid.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        if self.rms_m <= 0.0 {
            return;
        }
        let mut rough = HeightGrid::flat(grid.extent(), grid.cell());
        for wavelength in self.wavelengths() {
            let noise = Noise::new(wavelength, grid.reach(), stream);
            let height = pow(wavelength / self.longest_m, self.hurst);
            rough.add(|x, y| height * noise.at(x, y));
        }
        rough.subtract_mean();
        let rms = rough.rms();
        // A square much smaller than its waves may come out level: there is nothing to scale then.
        let scale = if rms > 0.0 { self.rms_m / rms } else { 0.0 };
        grid.add_grid(&rough, scale);
    }

    /// From the longest to the shortest wave in equal ratios of about 2.
    fn wavelengths(&self) -> impl Iterator<Item = f64> + use<> {
        let octaves = (ln(self.longest_m / self.shortest_m) / std::f64::consts::LN_2).ceil().max(0.0);
        let (longest, ratio) = (self.longest_m, self.shortest_m / self.longest_m);
        let steps = octaves.max(1.0);
        (0..=octaves as u32).map(move |k| longest * pow(ratio, f64::from(k) / steps))
    }
}
