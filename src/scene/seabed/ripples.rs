//! Sand ripples: sharp crests, a steep lee side, crests that wander, fork and end.

use serde::{Deserialize, Serialize};

use super::fractal::Fractal;
use super::noise::Noise;
use super::{HeightGrid, SeabedError, not_negative, positive, shown};
use crate::math::real::{atan2, cos, radians, sin};
use crate::math::rng::Stream;

/// How much crests are sharper than troughs. Under 1 together with [`SKEW`], so that each wave has one crest.
const SHARPNESS: f64 = 0.4;
/// How much the lee side is steeper than the stoss side.
const SKEW: f64 = 0.35;

/// Ripples over gentle roughness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ripples {
    /// Crest to crest, metres; at least four cells.
    pub wavelength_m: f64,
    /// Crest to trough, metres.
    pub height_m: f64,
    /// Where the lee sides look, across the crests, degrees counter-clockwise from x.
    pub direction_deg: f64,
    /// 0 straight crests, 0.3 wandering, from about 0.5 crests fork and end, up to 1.
    pub irregularity: f64,
    /// Root mean square height of the roughness under the ripples, metres.
    pub rms_m: f64,
}

impl Ripples {
    pub(super) fn check(&self, cell_m: f64) -> Result<(), SeabedError> {
        positive("wavelength_m", self.wavelength_m)?;
        not_negative("height_m", self.height_m)?;
        not_negative("rms_m", self.rms_m)?;
        if !self.direction_deg.is_finite() {
            return Err(SeabedError::Range { name: "direction_deg", value: self.direction_deg, range: "a number" });
        }
        if !(0.0..=1.0).contains(&self.irregularity) {
            return Err(SeabedError::Range { name: "irregularity", value: self.irregularity, range: "0 to 1" });
        }
        shown("wavelength_m", self.wavelength_m, cell_m, 4.0)
    }

    /// Adds ripples and roughness to a grid.
    ///
    /// The phase is that of a plane wave times `1 + noise`, the noise complex and slow: where it is small the crests
    /// wander, and where it cancels the 1 a crest ends or forks, and the ripple's height with it.
    pub(super) fn raise(&self, grid: &mut HeightGrid, stream: &mut Stream) {
        let reach = grid.reach();
        let wander = Noise::new(8.0 * self.wavelength_m, reach, stream);
        let [real, imaginary] = [(), ()].map(|()| Noise::new(3.5 * self.wavelength_m, reach, stream));
        let start = std::f64::consts::TAU * stream.unit();
        let wavenumber = std::f64::consts::TAU / self.wavelength_m;
        let direction = radians(self.direction_deg);
        let (kx, ky) = (wavenumber * cos(direction), wavenumber * sin(direction));
        let (mixed, bend) = (0.7 * self.irregularity, 2.5 * self.irregularity);
        grid.add(|x, y| {
            let (re, im) = (1.0 + mixed * real.at(x, y), mixed * imaginary.at(x, y));
            let phase = start + kx * x + ky * y + bend * wander.at(x, y) + atan2(im, re);
            // Only about the fork itself is the sand level.
            let height = (2.0 * (re * re + im * im).sqrt()).min(1.0);
            0.5 * self.height_m * height * profile(phase)
        });
        self.roughness(grid).raise(grid, stream);
    }

    fn roughness(&self, grid: &HeightGrid) -> Fractal {
        let shortest_m = (0.5 * self.wavelength_m).max(2.0 * grid.cell());
        Fractal { rms_m: self.rms_m, longest_m: (12.0 * self.wavelength_m).max(shortest_m), shortest_m, hurst: 0.8 }
    }
}

/// A wave of phase `phase` between −1 and 1 with a sharp crest and its steep side ahead.
fn profile(phase: f64) -> f64 {
    let (s, c) = (sin(phase), cos(phase));
    cos(phase + SHARPNESS * s - SKEW * c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lee_side_is_steep_and_crests_are_narrow() {
        let wave: Vec<f64> = (0..1000).map(|k| profile(std::f64::consts::TAU * f64::from(k) / 1000.0)).collect();
        let steps = || wave.iter().zip(wave.iter().cycle().skip(1)).map(|(a, b)| b - a);
        let (rise, fall) = (steps().fold(0.0, f64::max), steps().fold(0.0, f64::min));
        assert!(-fall > 1.15 * rise, "rise {rise}, fall {fall}");
        assert!(wave.iter().filter(|&&h| h > 0.0).count() < 450);
        assert_eq!(steps().zip(steps().cycle().skip(1)).filter(|(a, b)| *a > 0.0 && *b <= 0.0).count(), 1);
    }
}
