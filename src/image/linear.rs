//! What the chains that average over rays share: two normals a cell, and a linear display.
//!
//! Knows nothing of decibels and gain.

use crate::math::fast::fill_complex_normals;
use crate::math::rng::Stream;

/// Mean of a Rayleigh variable of scale 1, `√(π/2)`.
pub const RAYLEIGH_MEAN: f32 = 1.253_314_1;

/// Two independent standard normals for each of `cells` cells. `√(x² + y²)` is a Rayleigh variable of scale 1,
/// `(x² + y²) / 2` an exponential one of mean 1.
pub(super) fn normals(cells: usize, stream: &mut Stream) -> impl Iterator<Item = [f32; 2]> + use<> {
    let (mut x, mut y) = (vec![0.0; cells], vec![0.0; cells]);
    fill_complex_normals(stream, &mut x, &mut y);
    x.into_iter().zip(y).map(|(x, y)| [x, y])
}

/// Rayleigh variable of scale 1 from two standard normals.
pub(super) fn rayleigh([x, y]: [f32; 2]) -> f32 {
    (x * x + y * y).sqrt()
}

/// Intensities as grey: 0 and below black, `white` and above 255, in proportion in between.
#[must_use]
pub fn grey(intensity: &[f32], white: f64) -> Vec<u8> {
    let scale = (255.0 / white) as f32;
    // A float becomes the nearest value that a byte can hold.
    intensity.iter().map(|value| (value * scale + 0.5) as u8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_is_proportional_and_clipped() {
        assert_eq!(grey(&[-1.0, 0.0, 0.1, 0.25, 0.5, 9.0], 0.5), [0, 0, 51, 128, 255, 255]);
    }

    #[test]
    fn rayleigh_draws_have_their_mean() {
        let n = 100_000;
        let mut stream = Stream::at(1, "test", 0, "rayleigh");
        let mean = normals(n, &mut stream).map(|pair| f64::from(rayleigh(pair))).sum::<f64>() / n as f64;
        assert!((mean / f64::from(RAYLEIGH_MEAN) - 1.0).abs() < 0.01, "{mean}");
    }
}
