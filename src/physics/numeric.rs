//! The few numerical methods that closed forms leave over: a polynomial, a crossing, an integral, a complex number.
//!
//! Knows nothing of sound.

use std::ops::{Add, Div, Mul, Sub};

use crate::math::real::{cos, exp, sin};

/// `c₀ + c₁·x + c₂·x² + …` by Horner's rule.
pub(crate) fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Where `holds` turns from true (at `low`) to false (at `high`), halved until the interval cannot shrink.
pub(crate) fn crossing(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if holds(middle) { low = middle } else { high = middle }
    }
}

/// ∫ f over `from..to` by Simpson's rule on 512 intervals; for smooth integrands its error is far below 1e-9.
pub(crate) fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    const INTERVALS: u32 = 512;
    let step = (to - from) / f64::from(INTERVALS);
    let inner: f64 = (1..INTERVALS)
        .map(|i| {
            let weight = if i % 2 == 1 { 4.0 } else { 2.0 };
            weight * f(from + f64::from(i) * step)
        })
        .sum();
    (f(from) + inner + f(to)) * step / 3.0
}

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Complex {
    pub const ONE: Self = Self::new(1.0, 0.0);

    pub const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    pub const fn real(re: f64) -> Self {
        Self::new(re, 0.0)
    }

    /// `e^z`.
    pub fn exp(self) -> Self {
        let size = exp(self.re);
        Self::new(size * cos(self.im), size * sin(self.im))
    }

    /// |z|².
    pub fn power(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    /// |z|.
    pub fn abs(self) -> f64 {
        self.power().sqrt()
    }

    /// The square root with a real part that is not negative; that of a negative real number is `+i·√|z|`.
    pub fn sqrt(self) -> Self {
        let size = self.abs();
        let re = (0.5 * (size + self.re)).max(0.0).sqrt();
        let im = (0.5 * (size - self.re)).max(0.0).sqrt();
        Self::new(re, if self.im < 0.0 { -im } else { im })
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let power = other.power();
        let scaled = self * Self::new(other.re, -other.im);
        Self::new(scaled.re / power, scaled.im / power)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_meet_closed_forms() {
        assert!((polynomial(&[1.0, 2.0, 3.0], 2.0) - 17.0).abs() < 1e-15);
        assert!((crossing(0.0, 2.0, |x| x * x < 2.0) - 2.0_f64.sqrt()).abs() < 1e-15);
        assert!((integral(0.0, 1.0, exp) - (exp(1.0) - 1.0)).abs() < 1e-12);
    }

    #[test]
    fn complex_numbers_keep_their_rules() {
        let z = Complex::new(-3.0, 4.0);
        let root = z.sqrt();
        assert!((root * root - z).abs() < 1e-14 && root.re > 0.0);
        assert_eq!(Complex::real(-4.0).sqrt(), Complex::new(0.0, 2.0));
        assert!((z / root - root).abs() < 1e-14);
        assert!((Complex::new(0.0, std::f64::consts::PI).exp() + Complex::ONE).abs() < 1e-15);
    }
}
