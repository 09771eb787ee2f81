//! Quick elementary functions for whole images: a few units of the last place from exact, plain `+ − × ÷ √` only, so the
//! bits are the same on every machine and the loops vectorise.

use super::rng::Stream;

/// Natural logarithm of a positive, finite, normal `x`; relative error below 3e-7 away from 1, absolute below 1e-7 near it.
///
/// x = m·2ᵉ with m in [√½, √2); ln m = 2·artanh((m − 1)/(m + 1)) as its power series.
#[inline]
#[must_use]
pub fn ln(x: f32) -> f32 {
    const SQRT_HALF_BITS: u32 = 0x3f35_04f3;
    let bits = x.to_bits().wrapping_sub(SQRT_HALF_BITS);
    let exponent = (bits as i32 >> 23) as f32;
    let m = f32::from_bits((bits & 0x007f_ffff) + SQRT_HALF_BITS);
    let s = (m - 1.0) / (m + 1.0);
    let q = s * s;
    let series = 1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0))));
    2.0 * s * series + exponent * std::f32::consts::LN_2
}

/// Level of a power ratio in decibels, `10·log10(x)`, through [`ln`].
#[inline]
#[must_use]
pub fn db(x: f32) -> f32 {
    ln(x) * (10.0 / std::f32::consts::LN_10)
}

/// (sin, cos) of 2π·`turn` for `turn` in [0, 1); absolute error below 2e-7.
#[inline]
#[must_use]
pub fn sin_cos_turn(turn: f32) -> (f32, f32) {
    let quarter = (turn * 4.0 + 0.5) as i32;
    let r = (turn - quarter as f32 * 0.25) * std::f32::consts::TAU;
    let q = r * r;
    let sine = r * (1.0 + q * (-1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * (1.0 / 362_880.0)))));
    let cosine = 1.0 + q * (-0.5 + q * (1.0 / 24.0 + q * (-1.0 / 720.0 + q * (1.0 / 40_320.0))));
    let (s, c) = if quarter & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let sign_s = if quarter & 2 == 0 { 1.0 } else { -1.0 };
    let sign_c = if (quarter + 1) & 2 == 0 { 1.0 } else { -1.0 };
    (sign_s * s, sign_c * c)
}

/// Fills `re` and `im` (equal lengths) with independent standard normals, by Box–Muller on 32-bit draws.
///
/// Values are bounded by √(64·ln 2) ≈ 6.7 standard deviations.
pub fn fill_complex_normals(stream: &mut Stream, re: &mut [f32], im: &mut [f32]) {
    const PAIRS: usize = 512;
    let mut bytes = [0u8; PAIRS * 8];
    for (re, im) in re.chunks_mut(PAIRS).zip(im.chunks_mut(PAIRS)) {
        let bytes = &mut bytes[..re.len() * 8];
        stream.fill_bits(bytes);
        for ((re, im), draw) in re.iter_mut().zip(im).zip(bytes.chunks_exact(8)) {
            let [a, b, c, d, e, f, g, h] = *draw else { unreachable!("chunks of 8") };
            let radius_bits = u32::from_le_bytes([a, b, c, d]);
            let angle_bits = u32::from_le_bytes([e, f, g, h]);
            // (0, 1]: never the logarithm of 0.
            let uniform = (radius_bits as f32 + 1.0) * (1.0 / 4_294_967_296.0);
            let radius = (-2.0 * ln(uniform)).max(0.0).sqrt();
            let (sine, cosine) = sin_cos_turn((angle_bits >> 8) as f32 * (1.0 / 16_777_216.0));
            *re = radius * cosine;
            *im = radius * sine;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real;

    #[test]
    fn close_to_the_exact_functions() {
        for i in 1..40_000u32 {
            let x = f32::from_bits(i * 53_000 + 0x0080_0000);
            let exact = real::ln(f64::from(x));
            assert!((f64::from(ln(x)) - exact).abs() < 3e-7 * exact.abs() + 1e-7, "ln {x}");
        }
        for i in 0..10_000 {
            let turn = i as f32 / 10_000.0;
            let (s, c) = sin_cos_turn(turn);
            let angle = std::f64::consts::TAU * f64::from(turn);
            assert!((f64::from(s) - real::sin(angle)).abs() < 3e-7, "sin {turn}");
            assert!((f64::from(c) - real::cos(angle)).abs() < 3e-7, "cos {turn}");
        }
    }

    #[test]
    fn normals_have_the_moments_of_normals() {
        let n = 400_001;
        let (mut re, mut im) = (vec![0.0; n], vec![0.0; n]);
        fill_complex_normals(&mut Stream::at(3, "test", 0, "normals"), &mut re, &mut im);
        let mean = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>() / n as f64;
        assert!(mean(&|i| f64::from(re[i])).abs() < 0.006);
        assert!((mean(&|i| f64::from(re[i] * re[i])) - 1.0).abs() < 0.01);
        assert!((mean(&|i| f64::from(im[i] * im[i])) - 1.0).abs() < 0.01);
        assert!(mean(&|i| f64::from(re[i] * im[i])).abs() < 0.006);
        assert!((mean(&|i| f64::from(re[i]).powi(4)) - 3.0).abs() < 0.08);
    }
}
