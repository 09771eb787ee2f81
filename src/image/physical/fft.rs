//! A Fourier transform across rows: many columns at once, so that every step is plain arithmetic on contiguous numbers.
//!
//! Knows nothing of sonar. The same bits on every machine: `+ − ×` only, factors from `math::real`.

use crate::math::real::{cos, sin};

/// Complex numbers as two equally long arrays, rows after rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Rows {
    pub re: Vec<f32>,
    pub im: Vec<f32>,
}

impl Rows {
    /// `len` zeros.
    pub fn zeros(len: usize) -> Self {
        Self { re: vec![0.0; len], im: vec![0.0; len] }
    }
}

/// The transform of a fixed number of rows, a power of two.
#[derive(Clone, Debug)]
pub(super) struct Fft {
    len: usize,
    /// cos and sin of 2πj/len.
    factors: Vec<(f32, f32)>,
}

impl Fft {
    /// A transform of `len` rows, a power of two.
    pub fn new(len: usize) -> Self {
        debug_assert!(len.is_power_of_two());
        let factor = |j: usize| {
            let angle = std::f64::consts::TAU * j as f64 / len as f64;
            (cos(angle) as f32, sin(angle) as f32)
        };
        Self { len, factors: (0..len).map(factor).collect() }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.len
    }

    /// `X[k] = Σ x[i]·e^(−2πi·ki/len)`, of each column; rows are `width` long. The result comes back in `rows`.
    ///
    /// Source: Stockham's autosort transform, radix 4 with one pass of radix 2 for odd powers; Van Loan (1992),
    /// Computational Frameworks for the Fast Fourier Transform, ch. 1.7.
    #[inline(always)]
    pub fn forward(&self, rows: &mut Rows, spare: &mut Rows, width: usize) {
        self.passes((&mut rows.re, &mut rows.im), (&mut spare.re, &mut spare.im), width);
    }

    /// `x[i] = Σ X[k]·e^(+2πi·ki/len)`, not divided by `len`: the forward transform with real and imaginary parts swapped.
    #[inline(always)]
    pub fn backward(&self, rows: &mut Rows, spare: &mut Rows, width: usize) {
        self.passes((&mut rows.im, &mut rows.re), (&mut spare.im, &mut spare.re), width);
    }

    #[inline(always)]
    fn passes<'a>(&self, mut here: Parts<'a>, mut there: Parts<'a>, width: usize) {
        let (mut left, mut stride, mut swapped) = (self.len, 1, false);
        while left > 1 {
            let radix = if left % 4 == 0 { 4 } else { 2 };
            if radix == 4 {
                self.pass_4(&here, &mut there, left, stride * width);
            } else {
                self.pass_2(&here, &mut there, left, stride * width);
            }
            std::mem::swap(&mut here, &mut there);
            swapped = !swapped;
            (left, stride) = (left / radix, stride * radix);
        }
        if swapped {
            let len = self.len * width;
            there.0[..len].copy_from_slice(&here.0[..len]);
            there.1[..len].copy_from_slice(&here.1[..len]);
        }
    }

    /// Four quarters of the input to four neighbouring runs of the output; a run is `run` numbers long.
    #[inline(always)]
    fn pass_4(&self, from: &Parts<'_>, to: &mut Parts<'_>, left: usize, run: usize) {
        let quarter = left / 4;
        for p in 0..quarter {
            let factor = |times: usize| self.factors[times * p * (self.len / left)];
            let ((c1, s1), (c2, s2), (c3, s3)) = (factor(1), factor(2), factor(3));
            let input = |part: usize| (p + part * quarter) * run;
            let (ar, ai) = slices(from, input(0), run);
            let (br, bi) = slices(from, input(1), run);
            let (cr, ci) = slices(from, input(2), run);
            let (dr, di) = slices(from, input(3), run);
            let outputs = 4 * p * run..4 * (p + 1) * run;
            let [yr0, yr1, yr2, yr3] = quarters(&mut to.0[outputs.clone()], run);
            let [yi0, yi1, yi2, yi3] = quarters(&mut to.1[outputs], run);
            for q in 0..run {
                let (sum_r, sum_i) = (ar[q] + cr[q], ai[q] + ci[q]);
                let (dif_r, dif_i) = (ar[q] - cr[q], ai[q] - ci[q]);
                let (odd_r, odd_i) = (br[q] + dr[q], bi[q] + di[q]);
                // i·(b − d)
                let (turn_r, turn_i) = (di[q] - bi[q], br[q] - dr[q]);
                yr0[q] = sum_r + odd_r;
                yi0[q] = sum_i + odd_i;
                let (xr, xi) = (dif_r - turn_r, dif_i - turn_i);
                yr1[q] = xr * c1 + xi * s1;
                yi1[q] = xi * c1 - xr * s1;
                let (xr, xi) = (sum_r - odd_r, sum_i - odd_i);
                yr2[q] = xr * c2 + xi * s2;
                yi2[q] = xi * c2 - xr * s2;
                let (xr, xi) = (dif_r + turn_r, dif_i + turn_i);
                yr3[q] = xr * c3 + xi * s3;
                yi3[q] = xi * c3 - xr * s3;
            }
        }
    }

    /// The last pass of an odd power: sums and differences of two halves, all factors 1.
    #[inline(always)]
    fn pass_2(&self, from: &Parts<'_>, to: &mut Parts<'_>, left: usize, run: usize) {
        debug_assert_eq!(left, 2);
        let (ar, ai) = slices(from, 0, run);
        let (br, bi) = slices(from, run, run);
        let (sum_r, dif_r) = to.0[..2 * run].split_at_mut(run);
        let (sum_i, dif_i) = to.1[..2 * run].split_at_mut(run);
        for q in 0..run {
            sum_r[q] = ar[q] + br[q];
            sum_i[q] = ai[q] + bi[q];
            dif_r[q] = ar[q] - br[q];
            dif_i[q] = ai[q] - bi[q];
        }
    }
}

/// Real and imaginary parts.
type Parts<'a> = (&'a mut [f32], &'a mut [f32]);

#[inline(always)]
fn slices<'a>(parts: &'a Parts<'_>, start: usize, len: usize) -> (&'a [f32], &'a [f32]) {
    (&parts.0[start..start + len], &parts.1[start..start + len])
}

#[inline(always)]
fn quarters(all: &mut [f32], len: usize) -> [&mut [f32]; 4] {
    let (low, high) = all.split_at_mut(2 * len);
    let (first, second) = low.split_at_mut(len);
    let (third, fourth) = high.split_at_mut(len);
    [first, second, third, fourth]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::fast::fill_complex_normals;
    use crate::math::rng::Stream;
    use crate::math::vectors::{Work, widest};

    fn noise(len: usize) -> Rows {
        let mut rows = Rows::zeros(len);
        fill_complex_normals(&mut Stream::at(1, "test", 0, "fft"), &mut rows.re, &mut rows.im);
        rows
    }

    #[test]
    fn the_transform_is_its_definition() {
        for len in [1, 2, 4, 8, 32, 64] {
            let width = 3;
            let given = noise(len * width);
            let mut rows = given.clone();
            Fft::new(len).forward(&mut rows, &mut Rows::zeros(len * width), width);
            for k in 0..len {
                for column in 0..width {
                    let (mut re, mut im) = (0.0, 0.0);
                    for i in 0..len {
                        let angle = std::f64::consts::TAU * (k * i % len) as f64 / len as f64;
                        let at = i * width + column;
                        let (x, y) = (f64::from(given.re[at]), f64::from(given.im[at]));
                        re += x * cos(angle) + y * sin(angle);
                        im += y * cos(angle) - x * sin(angle);
                    }
                    let at = k * width + column;
                    let off = (f64::from(rows.re[at]) - re).abs() + (f64::from(rows.im[at]) - im).abs();
                    assert!(off < 2e-5, "{len}: {off}");
                }
            }
        }
    }

    #[test]
    fn there_and_back_is_the_number_of_rows() {
        let (len, width) = (512, 5);
        let given = noise(len * width);
        let (mut rows, mut spare) = (given.clone(), Rows::zeros(len * width));
        let fft = Fft::new(len);
        fft.forward(&mut rows, &mut spare, width);
        fft.backward(&mut rows, &mut spare, width);
        for (a, b) in rows.re.iter().zip(&given.re).chain(rows.im.iter().zip(&given.im)) {
            assert!((a / 512.0 - b).abs() < 1e-5);
        }
    }

    struct Forward<'a>(&'a Fft, &'a mut Rows, &'a mut Rows, usize);

    impl Work for Forward<'_> {
        #[inline(always)]
        fn run(self) {
            self.0.forward(self.1, self.2, self.3);
        }
    }

    #[test]
    fn wide_vectors_change_no_bit() {
        let (fft, width) = (Fft::new(128), 11);
        let given = noise(128 * width);
        let (mut plain, mut wide, mut spare) = (given.clone(), given, Rows::zeros(128 * width));
        Forward(&fft, &mut plain, &mut spare, width).run();
        widest(Forward(&fft, &mut wide, &mut spare, width));
        assert_eq!(plain, wide);
    }
}
