//! The echo of a rigid sphere of any size: the exact solution, which the asymptotic forms are held against.

use super::numeric::Complex;
use super::stated::Stated;
use crate::math::real::{cos, db_from_power, pow, sin};

/// Backscattering cross-section of a rigid sphere over its radius squared, dB: `10·log |1/ka · Σ (2n+1)(−1)ⁿ·jₙ′/hₙ′|²`.
///
/// −6.02 dB (a²/4) for large ka. The sum is carried out for ka of 1e-4 to 1e4; outside of that the value is NaN.
/// Source: Anderson (1950), J. Acoust. Soc. Am. 22:426–431, rigid limit; Morse & Ingard (1968), ch. 8.2.
pub fn rigid_sphere_exact(ka: f64) -> Stated<f64> {
    let limits = [("ka", ka, 1e-4, 1e4)];
    if !(1e-4..=1e4).contains(&ka) {
        return Stated::new(f64::NAN, &limits);
    }
    // Beyond this order the wave passes by the sphere: jₙ falls off faster than any power.
    let orders = (ka + 4.0 * pow(ka, 1.0 / 3.0) + 12.0).ceil() as usize;
    let (j, y) = (regular(ka, orders), irregular(ka, orders));
    let mut sum = Complex::real(0.0);
    for n in 0..orders {
        let h_slope = Complex::new(slope(&j, n, ka), slope(&y, n, ka));
        let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
        let weight = Complex::real(sign * (2 * n + 1) as f64);
        sum = sum + weight * Complex::real(slope(&j, n, ka)) / h_slope;
    }
    Stated::new(db_from_power(sum.power() / (ka * ka)), &limits)
}

/// `fₙ′(x)` of a spherical Bessel function: `fₙ₋₁ − (n+1)/x·fₙ`, and `f₀′ = −f₁`.
fn slope(f: &[f64], n: usize, x: f64) -> f64 {
    if n == 0 { -f[1] } else { f[n - 1] - (n + 1) as f64 / x * f[n] }
}

/// Spherical Bessel functions j₀ … j_orders, `orders` beyond x, by recurrence downwards, the direction in which errors
/// die (Miller).
fn regular(x: f64, orders: usize) -> Vec<f64> {
    let top = orders + 20;
    let mut j = vec![0.0; top + 2];
    j[top] = 1e-280;
    for n in (1..=top).rev() {
        j[n - 1] = (2 * n + 1) as f64 / x * j[n] - j[n + 1];
        if j[n - 1].abs() > 1e200 {
            j[n - 1..].iter_mut().for_each(|value| *value *= 1e-280);
        }
    }
    let exact = [sin(x) / x, sin(x) / (x * x) - cos(x) / x];
    // Scale by whichever is not near a zero.
    let scale = if exact[0].abs() > exact[1].abs() { exact[0] / j[0] } else { exact[1] / j[1] };
    j.truncate(orders + 1);
    j.iter_mut().for_each(|value| *value *= scale);
    j
}

/// Spherical Neumann functions y₀ … y_orders by recurrence upwards.
fn irregular(x: f64, orders: usize) -> Vec<f64> {
    let mut y = vec![-cos(x) / x, -cos(x) / (x * x) - sin(x) / x];
    for n in 1..orders {
        y.push((2 * n + 1) as f64 / x * y[n] - y[n - 1]);
    }
    y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_functions_keep_their_wronskian() {
        for (x, orders) in [(0.01, 12), (0.7, 12), (3.0, 20), (50.0, 80)] {
            let (j, y) = (regular(x, orders), irregular(x, orders));
            for n in 1..orders {
                let wronskian = j[n] * y[n - 1] - j[n - 1] * y[n];
                assert!((wronskian * x * x - 1.0).abs() < 1e-9, "x {x} n {n}");
            }
        }
    }

    #[test]
    fn small_spheres_scatter_after_rayleigh_and_large_ones_by_geometry() {
        // Rayleigh: (ka)⁴·(1/3 + 1/2)².
        let small: f64 = 1e-3;
        let rayleigh = db_from_power(small * small * small * small * 25.0 / 36.0);
        assert!((rigid_sphere_exact(small).value - rayleigh).abs() < 1e-3);
        assert!((rigid_sphere_exact(5.0).value + 5.6815).abs() < 1e-3);
        for large in [1000.0, 1e4] {
            assert!((rigid_sphere_exact(large).value + 6.0206).abs() < 0.02, "{large}");
        }
        assert!((rigid_sphere_exact(1e-4).value - (rayleigh - 40.0)).abs() < 1e-3);
    }

    #[test]
    fn beyond_its_range_it_says_so() {
        assert!(rigid_sphere_exact(5.0).is_within());
        let beyond = rigid_sphere_exact(1e5);
        assert!(beyond.value.is_nan() && !beyond.is_within());
    }
}
