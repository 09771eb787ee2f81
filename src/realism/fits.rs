//! Laws fitted to a patch's greys by maximum likelihood, and how far each is from them.
//!
//! The distance is Kolmogorov and Smirnov's, of the 8-bit greys as they are: the largest difference between the law and the
//! stair of the sample, above and below each step. Greys are whole numbers, so even the right law is some hundredths away.
//! For laws that allow no 0, a grey of 0 counts as 1/2 in logarithms.

use super::quantiles::Histogram;
use super::special::{digamma, gamma_p, trigamma};
use crate::math::real::{erf, exp, ln, pow};

/// A law of grey levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Law {
    /// Parameters: mean, standard deviation.
    Normal,
    /// Parameter: m; the mean square is the sample's.
    Nakagami,
    /// Parameters: shape, scale.
    Gamma,
    /// Parameter: σ, the mode.
    Rayleigh,
    /// Parameters: shape, scale.
    Weibull,
    /// Parameters: standard deviation of ln x, median of x.
    Lognormal,
}

impl Law {
    /// All laws that are fitted.
    pub const ALL: [Self; 6] =
        [Self::Normal, Self::Nakagami, Self::Gamma, Self::Rayleigh, Self::Weibull, Self::Lognormal];

    /// Name in figures.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Nakagami => "nakagami",
            Self::Gamma => "gamma",
            Self::Rayleigh => "rayleigh",
            Self::Weibull => "weibull",
            Self::Lognormal => "lognormal",
        }
    }

    /// The most likely law of this kind. The sample must have at least two different greys.
    pub(super) fn fit(self, greys: &Histogram) -> Fitted {
        let mean = greys.mean();
        let power = greys.mean_of(|x| x * x);
        let (first, second) = match self {
            Self::Normal => (mean, (power - mean * mean).sqrt()),
            Self::Rayleigh => ((0.5 * power).sqrt(), 0.0),
            Self::Gamma => {
                let shape = gamma_shape(ln(mean) - greys.mean_of(log));
                (shape, mean / shape)
            }
            // The square of a Nakagami variable is gamma distributed with shape m.
            Self::Nakagami => (gamma_shape(ln(power) - 2.0 * greys.mean_of(log)), power),
            Self::Weibull => weibull(greys, mean),
            Self::Lognormal => {
                let centre = greys.mean_of(log);
                (greys.mean_of(|x| (log(x) - centre) * (log(x) - centre)).sqrt(), exp(centre))
            }
        };
        Fitted { law: self, first, second }
    }
}

/// A law with its parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted {
    law: Law,
    first: f64,
    second: f64,
}

impl Fitted {
    /// The parameters that [`Law`] names.
    pub fn parameters(&self) -> Vec<f64> {
        match self.law {
            Law::Rayleigh | Law::Nakagami => vec![self.first],
            Law::Normal | Law::Gamma | Law::Weibull | Law::Lognormal => vec![self.first, self.second],
        }
    }

    /// Kolmogorov–Smirnov distance to a sample.
    pub fn distance(&self, greys: &Histogram) -> f64 {
        let n = greys.total() as f64;
        let (mut below, mut distance) = (0u64, 0.0f64);
        for (&count, grey) in greys.counts.iter().zip(0u32..).filter(|(count, _)| **count > 0) {
            let law = self.probability_below(f64::from(grey));
            let after = below + count;
            distance = distance.max((law - below as f64 / n).abs()).max((after as f64 / n - law).abs());
            below = after;
        }
        distance
    }

    /// The law's probability of at most x.
    fn probability_below(&self, x: f64) -> f64 {
        let Self { law, first, second } = *self;
        match law {
            Law::Normal => 0.5 + 0.5 * erf((x - first) / (second * std::f64::consts::SQRT_2)),
            Law::Rayleigh => 1.0 - exp(-0.5 * (x / first) * (x / first)),
            Law::Gamma => gamma_p(first, x / second),
            Law::Nakagami => gamma_p(first, first * x * x / second),
            Law::Weibull => 1.0 - exp(-pow(x / second, first)),
            Law::Lognormal => 0.5 + 0.5 * erf((log(x) - ln(second)) / (first * std::f64::consts::SQRT_2)),
        }
    }
}

/// Logarithm of a grey.
fn log(grey: f64) -> f64 {
    ln(grey.max(0.5))
}

/// Shape of the gamma law with ln(mean) − mean(ln) = `gap`.
///
/// Source: Minka (2002), Estimating a Gamma distribution: first guess of eq. 5 in closed form, then Newton's method.
fn gamma_shape(gap: f64) -> f64 {
    let gap = gap.max(1e-9);
    let mut shape = (3.0 - gap + ((gap - 3.0) * (gap - 3.0) + 24.0 * gap).sqrt()) / (12.0 * gap);
    for _ in 0..20 {
        let step = (ln(shape) - digamma(shape) - gap) / (1.0 / shape - trigamma(shape));
        shape = (shape - step).max(0.5 * shape);
        if step.abs() < 1e-10 * shape {
            break;
        }
    }
    shape
}

/// Shape and scale of the most likely Weibull law, by Newton's method on its one equation for the shape.
fn weibull(greys: &Histogram, mean: f64) -> (f64, f64) {
    let relative = |x: f64| x.max(0.5) / mean;
    let mean_log = greys.mean_of(|x| ln(relative(x)));
    let spread = greys.mean_of(|x| (relative(x) - 1.0) * (relative(x) - 1.0)).sqrt();
    let mut shape = pow(spread.max(1e-6), -1.086);
    for _ in 0..50 {
        let moment = |order: i32| {
            greys.mean_of(|x| {
                let log = ln(relative(x));
                exp(shape * log) * (0..order).fold(1.0, |product, _| product * log)
            })
        };
        let (zeroth, first, second) = (moment(0), moment(1), moment(2));
        let ratio = first / zeroth;
        let step = (ratio - 1.0 / shape - mean_log) / (second / zeroth - ratio * ratio + 1.0 / (shape * shape));
        shape = (shape - step).max(0.5 * shape);
        if step.abs() < 1e-10 * shape {
            break;
        }
    }
    let scale = mean * pow(greys.mean_of(|x| pow(relative(x), shape)), 1.0 / shape);
    (shape, scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Stream;

    fn sample(draw: impl Fn(&mut Stream) -> f64) -> Histogram {
        let mut stream = Stream::at(5, "test", 0, "fits");
        Histogram::of((0..200_000).map(|_| (draw(&mut stream) + 0.5).clamp(0.0, 255.0) as u8))
    }

    fn check(law: Law, greys: &Histogram, expected: &[f64]) {
        let fitted = law.fit(greys);
        for (found, expected) in fitted.parameters().iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 0.02, "{law:?}: {found} {expected}");
        }
        assert!(fitted.distance(greys) < 0.02, "{law:?}: {}", fitted.distance(greys));
    }

    fn exponential(stream: &mut Stream) -> f64 {
        -ln(1.0 - stream.unit())
    }

    #[test]
    fn each_law_finds_itself() {
        let gamma = |stream: &mut Stream, shape: u32| (0..shape).map(|_| exponential(stream)).sum::<f64>();
        check(Law::Normal, &sample(|s| 100.0 + 15.0 * s.normal()), &[100.0, 15.0]);
        check(Law::Rayleigh, &sample(|s| 60.0 * (2.0 * exponential(s)).sqrt()), &[60.0]);
        check(Law::Gamma, &sample(|s| 5.0 * gamma(s, 20)), &[20.0, 5.0]);
        check(Law::Nakagami, &sample(|s| 100.0 * (gamma(s, 6) / 6.0).sqrt()), &[6.0]);
        check(Law::Weibull, &sample(|s| 90.0 * pow(exponential(s), 0.2)), &[5.0, 90.0]);
        check(Law::Lognormal, &sample(|s| 70.0 * exp(0.2 * s.normal())), &[0.2, 70.0]);
    }

    #[test]
    fn a_wrong_law_is_far() {
        let normal = sample(|s| 72.0 + 13.0 * s.normal());
        // √(mean square / 2) = 51.7; at x = 52 the Rayleigh law is 0.40, the sample 0.06: the published figure is 0.31.
        assert!((Law::Rayleigh.fit(&normal).distance(&normal) - 0.33).abs() < 0.03);
    }

    #[test]
    fn the_distance_is_that_of_both_sides_of_each_step() {
        // Three of grey 10 and one of 20 against a normal law of mean 12.5 and deviation 4.33: largest below 10, at 0.75.
        let greys = Histogram::of([10, 10, 10, 20].into_iter());
        let fitted = Law::Normal.fit(&greys);
        let expected = 0.75 - (0.5 + 0.5 * erf(-2.5 / (18.75f64.sqrt() * std::f64::consts::SQRT_2)));
        assert!((fitted.distance(&greys) - expected).abs() < 1e-12);
    }

    #[test]
    fn blacks_and_narrow_samples_are_survived() {
        for greys in [vec![0u8; 399], vec![255; 399]] {
            let greys = Histogram::of(greys.into_iter().chain([128]));
            for law in Law::ALL {
                let fitted = law.fit(&greys);
                assert!(fitted.parameters().iter().all(|p| p.is_finite()), "{law:?} {:?}", fitted.parameters());
                assert!((0.0..=1.0).contains(&fitted.distance(&greys)), "{law:?}");
            }
        }
    }
}
