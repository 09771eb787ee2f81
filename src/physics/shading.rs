//! Shading: weights over an aperture that trade side lobes for beam width.
//!
//! Knows nothing of directions: `array` makes beams of weights.

use serde::{Deserialize, Serialize};

use crate::math::Impossible;
use crate::math::real::{acos, acosh, cos, cosh, pow};

/// A shading of an aperture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// All elements alike: −13.26 dB.
    Uniform,
    /// Raised cosine that falls to zero one element beyond each end: −31.5 dB.
    Hann,
    /// Raised cosine on a pedestal of 0.08: −42.7 dB.
    Hamming,
    /// Taylor's: the `near` nearest side lobes held at a level, the rest falling off.
    Taylor {
        /// Level of the near side lobes below the main lobe, dB (positive).
        side_lobe_db: f64,
        /// Side lobes held, counting the main lobe: n̄.
        near: u32,
    },
    /// Dolph–Chebyshev: all side lobes at one level, the narrowest beam for it.
    Chebyshev {
        /// Level of the side lobes below the main lobe, dB (positive).
        side_lobe_db: f64,
    },
}

impl Shading {
    /// The weights of `count` elements, the greatest 1 (for Taylor: the one at the middle of the aperture).
    ///
    /// Source: Harris (1978), Proc. IEEE 66:51–83; Taylor (1955), IRE Trans. Antennas Propag. 3:16–28, discrete as in Carrara,
    /// Goodman & Majewski (1995), app. D; Dolph (1946), Proc. IRE 34:335–348.
    ///
    /// # Errors
    /// Fewer than 1 or more than 65 536 elements, side lobes outside of 15–120 dB, a Taylor `near` outside of 2–50.
    pub fn weights(&self, count: u32) -> Result<Vec<f64>, Impossible> {
        Impossible::outside("elements", f64::from(count), 1.0, 65_536.0)?;
        let cosine_of = |denominator: f64, offset: f64| {
            move |i: u32| cos(2.0 * std::f64::consts::PI * (f64::from(i) + offset) / denominator)
        };
        let n = f64::from(count);
        Ok(match *self {
            Self::Uniform => vec![1.0; count as usize],
            Self::Hann => (0..count).map(cosine_of(n + 1.0, 1.0)).map(|c| 0.5 - 0.5 * c).collect(),
            Self::Hamming if count == 1 => vec![1.0],
            Self::Hamming => (0..count).map(cosine_of(n - 1.0, 0.0)).map(|c| 0.54 - 0.46 * c).collect(),
            Self::Taylor { side_lobe_db, near } => {
                Impossible::outside("side_lobe_db", side_lobe_db, 15.0, 120.0)?;
                Impossible::outside("near", f64::from(near), 2.0, 50.0)?;
                taylor(count, side_lobe_db, near)
            }
            Self::Chebyshev { side_lobe_db } => {
                Impossible::outside("side_lobe_db", side_lobe_db, 15.0, 120.0)?;
                chebyshev(count, side_lobe_db)
            }
        })
    }
}

/// `1 + 2·Σ Fₘ·cos(2πm·(i − (n−1)/2)/n)` over m < n̄, over its value at the middle.
fn taylor(count: u32, side_lobe_db: f64, near: u32) -> Vec<f64> {
    let a = acosh(pow(10.0, side_lobe_db / 20.0)) / std::f64::consts::PI;
    let bar = f64::from(near);
    let dilation = bar * bar / (a * a + (bar - 0.5) * (bar - 0.5));
    let coefficient = |m: u32| {
        let m2 = f64::from(m) * f64::from(m);
        let mut ratio = if m % 2 == 1 { 0.5 } else { -0.5 };
        for other in (1..near).map(f64::from) {
            ratio *= 1.0 - m2 / dilation / (a * a + (other - 0.5) * (other - 0.5));
            if other != f64::from(m) {
                ratio /= 1.0 - m2 / (other * other);
            }
        }
        ratio
    };
    let coefficients: Vec<f64> = (1..near).map(coefficient).collect();
    let at = |position: f64| {
        let turn = 2.0 * std::f64::consts::PI * position / f64::from(count);
        let terms = coefficients.iter().zip(1_u32..);
        1.0 + 2.0 * terms.map(|(f, m)| f * cos(turn * f64::from(m))).sum::<f64>()
    };
    let (middle, centre) = (0.5 * (f64::from(count) - 1.0), at(0.0));
    (0..count).map(|i| at(f64::from(i) - middle) / centre).collect()
}

/// The inverse transform of `T_{n−1}(x₀·cos(πk/n))`.
fn chebyshev(count: u32, side_lobe_db: f64) -> Vec<f64> {
    let n = f64::from(count);
    let order = n - 1.0;
    if count == 1 {
        return vec![1.0];
    }
    let x0 = cosh(acosh(pow(10.0, side_lobe_db / 20.0)) / order);
    let polynomial = |x: f64| if x <= 1.0 { cos(order * acos(x)) } else { cosh(order * acosh(x)) };
    let turn = std::f64::consts::PI / n;
    let half = count.div_ceil(2);
    let spectrum: Vec<f64> = (0..half).map(|k| polynomial(x0 * cos(turn * f64::from(k)))).collect();
    let raw: Vec<f64> = (0..count)
        .map(|i| {
            let position = 2.0 * f64::from(i) - order;
            let terms = spectrum.iter().zip(0_u32..).skip(1);
            spectrum[0] + 2.0 * terms.map(|(value, k)| value * cos(turn * f64::from(k) * position)).sum::<f64>()
        })
        .collect();
    let greatest = raw.iter().copied().fold(f64::MIN, f64::max);
    raw.into_iter().map(|weight| weight / greatest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Shading; 5] = [
        Shading::Uniform,
        Shading::Hann,
        Shading::Hamming,
        Shading::Taylor { side_lobe_db: 30.0, near: 5 },
        Shading::Chebyshev { side_lobe_db: 40.0 },
    ];

    #[test]
    fn weights_are_symmetric_and_positive() {
        for shading in ALL {
            for count in [1, 2, 7, 64] {
                let weights = shading.weights(count).unwrap();
                assert_eq!(weights.len(), count as usize);
                for (a, b) in weights.iter().zip(weights.iter().rev()) {
                    assert!((a - b).abs() < 1e-9 && *a > 0.0 && *a <= 1.0 + 1e-12, "{shading:?} {count}: {weights:?}");
                }
            }
        }
    }

    #[test]
    fn known_weights() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} {b}");
        close(Shading::Hamming.weights(5).unwrap()[0], 0.08);
        close(Shading::Hann.weights(3).unwrap()[0], 0.5);
        // Four elements at 20 dB: x₀ = 1.5466…, weights 0.5761 : 1 (Stutzman & Thiele, example).
        let four = Shading::Chebyshev { side_lobe_db: 20.0 }.weights(4).unwrap();
        assert!((four[0] - 0.5761).abs() < 1e-3, "{four:?}");
    }

    #[test]
    fn shadings_that_cannot_be_are_refused() {
        assert!(Shading::Taylor { side_lobe_db: 30.0, near: 1 }.weights(8).is_err());
        assert!(Shading::Chebyshev { side_lobe_db: -30.0 }.weights(8).is_err());
        assert!(Shading::Uniform.weights(0).is_err());
    }
}
