//! Smooth noise of one wavelength: a turned lattice of random heights under a cubic B-spline.

use crate::math::real::{cos, sin};
use crate::math::rng::Stream;

/// Root mean square of the noise per that of the lattice, by the B-spline's weights in one dimension:
/// the mean over a cell of the sum of the squared weights, 151/315, once for each dimension.
const SPLINE_RMS: f64 = 151.0 / 315.0;

/// Noise of mean about 0 and root mean square about 1.
pub(super) struct Noise {
    heights: Vec<f32>,
    side: usize,
    /// Lattice steps a metre along the lattice's first axis, as (x, y).
    along: [f64; 2],
    /// Where the world's origin lies on the lattice.
    origin: [f64; 2],
}

impl Noise {
    /// Noise whose waves are about `wavelength` long, for points up to `reach` from the origin, metres.
    pub fn new(wavelength: f64, reach: f64, stream: &mut Stream) -> Self {
        // Two lattice points a wave; each octave is turned its own way, so that no lattice shows through.
        let steps = 2.0 / wavelength;
        let turn = std::f64::consts::TAU * stream.unit();
        let half = (reach * steps).ceil() + 2.0;
        let side = 2 * half as usize + 2;
        let origin = [half + stream.unit(), half + stream.unit()];
        // Uniform heights of unit variance reach ±√3: no lone spikes.
        let spread = 3f64.sqrt() / SPLINE_RMS;
        let heights = (0..side * side).map(|_| (spread * (2.0 * stream.unit() - 1.0)) as f32).collect();
        Self { heights, side, along: [steps * cos(turn), steps * sin(turn)], origin }
    }

    /// The noise at a point, metres.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let u = self.origin[0] + self.along[0] * x + self.along[1] * y;
        let v = self.origin[1] - self.along[1] * x + self.along[0] * y;
        let (column, across) = spline(u, self.side);
        let (row, up) = spline(v, self.side);
        let mut sum = 0.0;
        for (k, weight) in up.iter().enumerate() {
            let from = (row + k) * self.side + column;
            let line = &self.heights[from..from + 4];
            let along: f64 = line.iter().zip(&across).map(|(&height, weight)| f64::from(height) * weight).sum();
            sum += weight * along;
        }
        sum
    }
}

/// First of four lattice points about `place`, and their weights in a uniform cubic B-spline.
fn spline(place: f64, side: usize) -> (usize, [f64; 4]) {
    let cell = place.floor().clamp(1.0, side as f64 - 3.0);
    let t = (place - cell).clamp(0.0, 1.0);
    let s = 1.0 - t;
    let weights = [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    ];
    (cell as usize - 1, weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_has_unit_height_and_its_wavelength() {
        let noise = Noise::new(0.5, 30.0, &mut Stream::at(1, "test", 0, "noise"));
        let points: Vec<(f64, f64)> = (0..200)
            .flat_map(|i| (0..200).map(move |j| (0.2 * f64::from(i) - 20.0, 0.2 * f64::from(j) - 20.0)))
            .collect();
        let n = points.len() as f64;
        let mean_of = |f: &dyn Fn(f64, f64) -> f64| points.iter().map(|&(x, y)| f(x, y)).sum::<f64>() / n;
        let square = mean_of(&|x, y| noise.at(x, y) * noise.at(x, y));
        assert!((square - 1.0).abs() < 0.05, "{square}");
        assert!(mean_of(&|x, y| noise.at(x, y)).abs() < 0.05);
        // Alike over a tenth of a wave, unlike over several.
        assert!(mean_of(&|x, y| noise.at(x, y) * noise.at(x + 0.05, y)) > 0.9);
        assert!(mean_of(&|x, y| noise.at(x, y) * noise.at(x + 2.0, y)).abs() < 0.05);
    }
}
