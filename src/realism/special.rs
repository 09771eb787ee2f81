//! Special functions that `libm` lacks: digamma, trigamma and the incomplete gamma function.

use crate::math::real::{exp, lgamma, ln};

/// ψ(x), the derivative of ln Γ, for x > 0.
///
/// Source: Abramowitz & Stegun (1964), eqs. 6.3.5 (recurrence) and 6.3.18 (asymptotic series).
pub(super) fn digamma(x: f64) -> f64 {
    let (mut x, mut shift) = (x, 0.0);
    while x < 10.0 {
        shift -= 1.0 / x;
        x += 1.0;
    }
    let y = 1.0 / (x * x);
    let series = y * (1.0 / 12.0 - y * (1.0 / 120.0 - y * (1.0 / 252.0 - y * (1.0 / 240.0 - y / 132.0))));
    shift + ln(x) - 0.5 / x - series
}

/// ψ′(x), for x > 0.
///
/// Source: Abramowitz & Stegun (1964), eqs. 6.4.6 (recurrence) and 6.4.12 (asymptotic series).
pub(super) fn trigamma(x: f64) -> f64 {
    let (mut x, mut shift) = (x, 0.0);
    while x < 10.0 {
        shift += 1.0 / (x * x);
        x += 1.0;
    }
    let y = 1.0 / (x * x);
    let series = y * (1.0 / 6.0 - y * (1.0 / 30.0 - y * (1.0 / 42.0 - y * (1.0 / 30.0 - y * 5.0 / 66.0))));
    shift + 1.0 / x + 0.5 * y + series / x
}

/// P(a, x), the regularised lower incomplete gamma function, for a > 0 and x ≥ 0.
///
/// Source: Abramowitz & Stegun (1964), eqs. 6.5.29 (series, for x < a + 1) and 6.5.31 (continued fraction, by Lentz's method).
pub(super) fn gamma_p(a: f64, x: f64) -> f64 {
    /// Terms needed grow with √a; this serves a up to millions.
    const MOST: u32 = 20_000;
    if x <= 0.0 {
        return 0.0;
    }
    let front = exp(a * ln(x) - x - lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        for _ in 0..MOST {
            n += 1.0;
            term *= x / n;
            sum += term;
            if term < sum * 1e-16 {
                break;
            }
        }
        return (front * sum).min(1.0);
    }
    let tiny = 1e-300;
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / tiny, 1.0 / b);
    let mut fraction = d;
    for i in 1..MOST {
        let i = f64::from(i);
        let numerator = -i * (i - a);
        b += 2.0;
        d = 1.0 / away_from_zero(numerator * d + b, tiny);
        c = away_from_zero(b + numerator / c, tiny);
        fraction *= d * c;
        if (d * c - 1.0).abs() < 1e-15 {
            break;
        }
    }
    (1.0 - front * fraction).max(0.0)
}

fn away_from_zero(value: f64, least: f64) -> f64 {
    if value.abs() < least { least } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{found} {expected}");
    }

    #[test]
    fn digamma_and_trigamma_at_known_points() {
        // −γ, −γ − 2 ln 2, H₉ − γ; π²/6, π²/2, π²/6 − Σ 1/n² to 9.
        near(digamma(1.0), -0.577_215_664_901_532_9);
        near(digamma(0.5), -1.963_510_026_021_423_5);
        near(digamma(10.0), 2.251_752_589_066_721);
        near(trigamma(1.0), 1.644_934_066_848_226_4);
        near(trigamma(0.5), 4.934_802_200_544_679);
        near(trigamma(10.0), 0.105_166_335_681_685_75);
    }

    #[test]
    fn incomplete_gamma_at_known_points() {
        // 1 − e^(−x); erf(√x); 1 − e^(−x)(1 + x + x²/2); chi-square tables: P(5, 9.15) is 95 % at 18.307 with 10 degrees.
        for x in [0.1, 1.0, 2.5, 9.0] {
            near(gamma_p(1.0, x), 1.0 - exp(-x));
            near(gamma_p(0.5, x), crate::math::real::erf(x.sqrt()));
            near(gamma_p(3.0, x), 1.0 - exp(-x) * (1.0 + x + 0.5 * x * x));
        }
        assert!((gamma_p(5.0, 0.5 * 18.307_038_053_275_146) - 0.95).abs() < 1e-12);
        assert!((gamma_p(50.0, 0.5 * 124.342_113_404_004_1) - 0.95).abs() < 1e-12);
        assert_eq!(gamma_p(2.0, 0.0), 0.0);
        // For a large shape the law is nearly normal about a − 1/3.
        assert!((gamma_p(1e4, 1e4 - 1.0 / 3.0) - 0.5).abs() < 1e-4);
    }
}
