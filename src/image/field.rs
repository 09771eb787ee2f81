//! The complex pressure field at the receiver: many scatterers in each cell, their phases random.

use crate::math::fast::fill_complex_normals;
use crate::math::real::power_from_db;
use crate::math::rng::Stream;
use crate::sonar::Echoes;

/// A complex field over the cells of a grid, in cell order.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Real part.
    pub re: Vec<f32>,
    /// Imaginary part.
    pub im: Vec<f32>,
}

/// Draws a field whose mean power in each cell is its echo energy after absorption both ways.
///
/// `A = √(E·10^(−2αR/10))·(n₁ + i·n₂)/√2` with standard normals: Rayleigh amplitude, exponential power.
/// Source: Goodman (2007), Speckle Phenomena in Optics, ch. 3, fully developed speckle.
#[must_use]
pub fn speckle(echoes: &Echoes, absorption_db_per_m: f64, stream: &mut Stream) -> Field {
    let grid = &echoes.grid;
    let cells = grid.len();
    let mut field = Field { re: vec![0.0; cells], im: vec![0.0; cells] };
    fill_complex_normals(stream, &mut field.re, &mut field.im);
    let loss: Vec<f32> = (0..grid.bins)
        .map(|bin| (0.5 * power_from_db(-2.0 * absorption_db_per_m * grid.range_m(bin))) as f32)
        .collect();
    let bins = grid.bins as usize;
    let beams = field.re.chunks_exact_mut(bins).zip(field.im.chunks_exact_mut(bins));
    for ((re, im), energy) in beams.zip(echoes.energy.chunks_exact(bins)) {
        for (((re, im), energy), loss) in re.iter_mut().zip(im).zip(energy).zip(&loss) {
            let amplitude = (energy * loss).sqrt();
            *re *= amplitude;
            *im *= amplitude;
        }
    }
    field
}

/// Adds complex Gaussian noise of mean power `power` to every cell.
pub fn add_noise(field: &mut Field, power: f64, stream: &mut Stream) {
    let sigma = (0.5 * power).sqrt() as f32;
    const BLOCK: usize = 4096;
    let (mut re, mut im) = ([0.0; BLOCK], [0.0; BLOCK]);
    for (field_re, field_im) in field.re.chunks_mut(BLOCK).zip(field.im.chunks_mut(BLOCK)) {
        let (re, im) = (&mut re[..field_re.len()], &mut im[..field_im.len()]);
        fill_complex_normals(stream, re, im);
        field_re.iter_mut().zip(re).for_each(|(f, n)| *f += sigma * *n);
        field_im.iter_mut().zip(im).for_each(|(f, n)| *f += sigma * *n);
    }
}
