//! Statistics of speckle: moments of amplitude and intensity, nothing drawn at random.

use super::stated::Stated;
use crate::math::real::{exp, lgamma, ln, log10};

/// Amplitude of a complex Gaussian field whose two quadratures have variance σ².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rayleigh {
    /// Standard deviation σ of each quadrature.
    pub sigma: f64,
}

impl Rayleigh {
    /// `σ·√(π/2)`. Source of this and the next four: Goodman (2007), Speckle Phenomena in Optics, ch. 3.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.sigma * std::f64::consts::FRAC_PI_2.sqrt()
    }

    /// `(2 − π/2)·σ²`. Source: as [`Self::mean`].
    #[must_use]
    pub fn variance(&self) -> f64 {
        (2.0 - std::f64::consts::FRAC_PI_2) * self.sigma * self.sigma
    }

    /// `2σ²`, the mean intensity. Source: as [`Self::mean`].
    #[must_use]
    pub fn mean_square(&self) -> f64 {
        2.0 * self.sigma * self.sigma
    }

    /// `σ·√(2·ln 2)`. Source: as [`Self::mean`].
    #[must_use]
    pub fn median(&self) -> f64 {
        self.sigma * (2.0 * std::f64::consts::LN_2).sqrt()
    }

    /// Standard deviation over mean, `√(4/π − 1)` = 0.5227. Source: as [`Self::mean`].
    #[must_use]
    pub fn variation(&self) -> f64 {
        (4.0 / std::f64::consts::PI - 1.0).sqrt()
    }
}

/// Intensity of speckle averaged over L independent looks: Gamma-distributed with shape L. One look is exponential.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speckle {
    /// Mean intensity.
    pub mean: f64,
    /// Looks L; positive, not necessarily whole.
    pub looks: f64,
}

impl Speckle {
    /// `mean²/L`. Source: Goodman (2007), ch. 3; Oliver & Quegan (2004), Understanding SAR Images, ch. 4.
    #[must_use]
    pub fn variance(&self) -> f64 {
        self.mean * self.mean / self.looks
    }

    /// Standard deviation over mean, `1/√L`. Source: as [`Self::variance`].
    #[must_use]
    pub fn variation(&self) -> f64 {
        1.0 / self.looks.sqrt()
    }

    /// `2/√L`. Source: as [`Self::variance`].
    #[must_use]
    pub fn skewness(&self) -> f64 {
        2.0 / self.looks.sqrt()
    }

    /// `6/L`. Source: as [`Self::variance`].
    #[must_use]
    pub fn excess_kurtosis(&self) -> f64 {
        6.0 / self.looks
    }

    /// Mean of `10·log I`, dB: `10·log(mean) + 10/ln 10·(ψ(L) − ln L)`; −2.51 dB below the mean for one look.
    ///
    /// Source: Oliver & Quegan (2004), ch. 4, logarithm of a Gamma variable.
    #[must_use]
    pub fn mean_db(&self) -> f64 {
        10.0 * log10(self.mean) + DB_PER_LN * (digamma(self.looks) - ln(self.looks))
    }

    /// Standard deviation of `10·log I`, dB: `10/ln 10·√ψ₁(L)`; 5.57 dB for one look. Source: as [`Self::mean_db`].
    #[must_use]
    pub fn deviation_db(&self) -> f64 {
        DB_PER_LN * trigamma(self.looks).sqrt()
    }
}

/// Probability that the intensity of one look exceeds a threshold, `e^(−I/mean)`. Source: Goodman (2007), ch. 3.
#[must_use]
pub fn exceedance(threshold: f64, mean: f64) -> f64 {
    exp(-threshold / mean)
}

/// Median intensity of one look, `mean·ln 2`. Source: Goodman (2007), ch. 3.
#[must_use]
pub fn median_intensity(mean: f64) -> f64 {
    mean * std::f64::consts::LN_2
}

/// K-distributed intensity: speckle of L looks on a Gamma texture of shape ν, mean 1. Spiky for small ν, speckle for large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KDistribution {
    /// Shape ν of the texture; positive.
    pub shape: f64,
    /// Looks L; positive.
    pub looks: f64,
}

impl KDistribution {
    /// `⟨I²⟩/⟨I⟩² = (1 + 1/L)·(1 + 1/ν)`; 2·(1 + 1/ν) for one look.
    ///
    /// Source: Jakeman & Pusey (1976), IEEE Trans. Antennas Propag. 24:806–814; Oliver & Quegan (2004), ch. 5.
    #[must_use]
    pub fn second_moment(&self) -> f64 {
        (1.0 + 1.0 / self.looks) * (1.0 + 1.0 / self.shape)
    }

    /// Variance over squared mean of intensity, `⟨I²⟩/⟨I⟩² − 1`. Source: as [`Self::second_moment`].
    #[must_use]
    pub fn scintillation(&self) -> f64 {
        self.second_moment() - 1.0
    }

    /// Mean of the amplitude over its rms: `g(ν)·g(L)`, g(x) = Γ(x + ½)/(Γ(x)·√x). Source: as [`Self::second_moment`].
    #[must_use]
    pub fn amplitude_mean_over_rms(&self) -> f64 {
        let root = |x: f64| exp(lgamma(x + 0.5) - lgamma(x)) / x.sqrt();
        root(self.shape) * root(self.looks)
    }
}

/// Shape ν of a K distribution with a second moment `⟨I²⟩/⟨I⟩²` of one look: `1/(m/2 − 1)`; without clutter, m = 2, infinite.
///
/// Stated for moments above 2: below, no texture explains what was measured, and the value is infinite.
/// Source: method of moments on [`KDistribution::second_moment`].
pub fn k_shape(second_moment: f64) -> Stated<f64> {
    let excess = 0.5 * second_moment - 1.0;
    let shape = if excess > 0.0 { 1.0 / excess } else { f64::INFINITY };
    Stated::new(shape, &[("second moment of intensity", second_moment, 2.0, f64::INFINITY)])
}

/// 10/ln 10.
const DB_PER_LN: f64 = 10.0 / std::f64::consts::LN_10;

/// ψ(x), x > 0: raised by recurrence to where the asymptotic series holds 15 digits.
///
/// Source: Abramowitz & Stegun (1964), 6.3.5 and 6.3.18.
fn digamma(mut x: f64) -> f64 {
    let mut below = 0.0;
    while x < 12.0 {
        below += 1.0 / x;
        x += 1.0;
    }
    let i = 1.0 / (x * x);
    ln(x) - 0.5 / x - i * (1.0 / 12.0 - i * (1.0 / 120.0 - i * (1.0 / 252.0 - i * (1.0 / 240.0 - i / 132.0)))) - below
}

/// ψ₁(x), x > 0. Source: Abramowitz & Stegun (1964), 6.4.6 and 6.4.12.
fn trigamma(mut x: f64) -> f64 {
    let mut below = 0.0;
    while x < 12.0 {
        below += 1.0 / (x * x);
        x += 1.0;
    }
    let i = 1.0 / (x * x);
    let series = 1.0 / 6.0 - i * (1.0 / 30.0 - i * (1.0 / 42.0 - i * (1.0 / 30.0 - i * 5.0 / 66.0)));
    1.0 / x + 0.5 * i + series * i / x + below
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gamma_functions_at_one() {
        assert!((digamma(1.0) + 0.577_215_664_901_532_9).abs() < 1e-14);
        assert!((trigamma(1.0) - std::f64::consts::PI * std::f64::consts::PI / 6.0).abs() < 1e-13);
        assert!((digamma(0.5) + 1.963_510_026_021_423).abs() < 1e-13);
    }

    #[test]
    fn one_look_is_5_57_db_wide_and_2_51_db_low() {
        let one = Speckle { mean: 1.0, looks: 1.0 };
        assert!((one.mean_db() + 2.506_816).abs() < 1e-6);
        assert!((one.deviation_db() - 5.570_043).abs() < 1e-5);
        let louder = Speckle { mean: 10.0, ..one };
        assert!((louder.mean_db() - one.mean_db() - 10.0).abs() < 1e-12);
    }

    #[test]
    fn rayleigh_and_exponential_are_one_field() {
        let amplitude = Rayleigh { sigma: 0.7 };
        assert!((amplitude.variation() - 0.522_723_2).abs() < 1e-7);
        assert!((amplitude.variance() + amplitude.mean() * amplitude.mean() - amplitude.mean_square()).abs() < 1e-12);
        let median = amplitude.median();
        assert!((exceedance(median * median, amplitude.mean_square()) - 0.5).abs() < 1e-12);
        assert!((median * median - median_intensity(amplitude.mean_square())).abs() < 1e-12);
    }

    #[test]
    fn k_is_spiky_for_small_shapes_and_speckle_for_large() {
        let spiky = KDistribution { shape: 0.5, looks: 1.0 };
        assert!((spiky.second_moment() - 6.0).abs() < 1e-12 && (spiky.scintillation() - 5.0).abs() < 1e-12);
        assert!((spiky.amplitude_mean_over_rms() - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-9);
        let speckle = KDistribution { shape: 1e6, looks: 1.0 };
        assert!((speckle.amplitude_mean_over_rms() - 0.886_227).abs() < 1e-5);
        assert!((k_shape(spiky.second_moment()).value - 0.5).abs() < 1e-12);
        assert!(!k_shape(1.5).is_within());
    }
}
