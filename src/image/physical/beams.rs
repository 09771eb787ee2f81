//! From a device's beams to directions evenly spaced in u = sin θ, and back.
//!
//! Knows nothing of ranges: the tables say which rows are mixed with which weights.

use super::aperture::{Aperture, Array, transmit_power};
use crate::math::real::{radians, sin};
use crate::sonar::Grid;

/// Taps of the interpolation between directions.
pub(super) const TAPS: usize = 6;

/// Beams ↔ directions.
#[derive(Clone, Debug)]
pub(super) struct BeamTables {
    /// For each direction, the beams whose echoes it takes, with their shares of power (transmit pattern included).
    pub heard: Vec<Vec<(usize, f32)>>,
    /// For each beam, the direction of the first tap, and the taps: real weights of the field's amplitudes (ripple included).
    pub taps: Vec<(usize, [f32; TAPS])>,
    /// For each beam, power in it of an even fan of one unit a beam, without transmit pattern and ripple: 1/cos θ for the wider
    /// footprint, and less at the edges of the fan, beyond which there is nothing.
    pub even: Vec<f64>,
}

impl BeamTables {
    /// The tables of a grid's beams on an aperture's directions.
    pub fn new(grid: &Grid, aperture: &Aperture, array: &Array) -> Self {
        let shares = shares(grid, aperture);
        let even = even(grid, aperture, &shares);
        let mut heard = shares;
        if let Some(width) = array.transmit_width_deg {
            for (beam, share) in heard.iter_mut().flatten() {
                *share *= transmit_power(sin(grid.bearing_rad(*beam as u32)), radians(width)) as f32;
            }
        }
        let interpolator = Interpolator::new(aperture);
        let ripple = array.ripple(grid.beams as usize);
        let taps = (0..grid.beams)
            .map(|beam| {
                let place = aperture.place(sin(grid.bearing_rad(beam)));
                let (first, taps) = interpolator.taps(aperture, place);
                (first, taps.map(|tap| (tap * ripple[beam as usize]) as f32))
            })
            .collect();
        Self { heard, taps, even }
    }
}

/// Deals each beam's power out to the directions by overlap in u: all of it arrives.
fn shares(grid: &Grid, aperture: &Aperture) -> Vec<Vec<(usize, f32)>> {
    let mut heard = vec![Vec::new(); aperture.directions];
    let half = 0.5 * grid.beam_rad();
    for beam in 0..grid.beams {
        let bearing = grid.bearing_rad(beam);
        // Direction i is the stretch from i − ½ to i + ½.
        let [low, high] = [bearing - half, bearing + half].map(|edge| aperture.place(sin(edge)) + 0.5);
        let span = low.max(0.0) as usize..(high.max(0.0).ceil() as usize).min(aperture.directions);
        for (direction, heard) in span.clone().zip(&mut heard[span]) {
            let (from, to) = (low.max(direction as f64), high.min(direction as f64 + 1.0));
            if to > from {
                heard.push((beam as usize, ((to - from) / (high - low)) as f32));
            }
        }
    }
    heard
}

/// Mean power in each beam where every beam of the fan receives 1, see [`BeamTables::even`].
fn even(grid: &Grid, aperture: &Aperture, shares: &[Vec<(usize, f32)>]) -> Vec<f64> {
    const REACH: usize = 48;
    let count = aperture.directions;
    let density: Vec<f64> = shares.iter().map(|heard| heard.iter().map(|&(_, share)| f64::from(share)).sum()).collect();
    let reach = REACH.min(count / 2 - 1);
    let pattern: Vec<f64> = (0..=reach).map(|offset| aperture.response_at(offset as f64)).map(|a| a * a).collect();
    let all = pattern[0] + 2.0 * pattern[1..].iter().sum::<f64>();
    let smooth = |direction: usize| {
        let at = |direction: usize| density[direction % count];
        let sides = pattern.iter().enumerate().skip(1);
        let sum: f64 = sides.map(|(o, p)| p * (at(direction + o) + at(direction + count - o))).sum();
        (pattern[0] * at(direction) + sum) / all
    };
    let smooth: Vec<f64> = (0..count).map(smooth).collect();
    (0..grid.beams)
        .map(|beam| {
            let place = aperture.place(sin(grid.bearing_rad(beam)));
            let (below, part) = (place as usize, place - place.floor());
            smooth[below % count] * (1.0 - part) + smooth[(below + 1) % count] * part
        })
        .collect()
}

/// The best mix of neighbouring directions for a place between them: least mean-square error over echoes from everywhere,
/// whose spectrum over the aperture is known, then scaled so that no place is brighter than another.
///
/// Source: Wiener interpolation, e.g. Oppenheim & Schafer (2010), Discrete-Time Signal Processing; Van Trees (2002), ch. 2.
struct Interpolator {
    /// Correlations of directions 0, 1, … apart.
    correlation: [f64; TAPS],
}

impl Interpolator {
    fn new(aperture: &Aperture) -> Self {
        Self { correlation: std::array::from_fn(|offset| aperture.power_at(offset as f64)) }
    }

    /// First direction and weights for a place.
    fn taps(&self, aperture: &Aperture, place: f64) -> (usize, [f64; TAPS]) {
        let count = aperture.directions;
        let first = place.floor() as usize + count - (TAPS / 2 - 1);
        let offset = place - place.floor() + (TAPS / 2 - 1) as f64;
        let matrix: [[f64; TAPS]; TAPS] =
            std::array::from_fn(|row| std::array::from_fn(|column| self.correlation[row.abs_diff(column)]));
        let wanted: [f64; TAPS] = std::array::from_fn(|tap| aperture.power_at(offset - tap as f64));
        let taps = solve(&matrix, &wanted, 1e-7 * self.correlation[0]);
        let power: f64 = (0..TAPS).map(|r| (0..TAPS).map(|c| taps[r] * matrix[r][c] * taps[c]).sum::<f64>()).sum();
        let scale = (self.correlation[0] / power).sqrt();
        (first % count, taps.map(|tap| tap * scale))
    }
}

/// Solves a symmetric, positive definite system with `ridge` added to its diagonal, by elimination.
fn solve(matrix: &[[f64; TAPS]; TAPS], right: &[f64; TAPS], ridge: f64) -> [f64; TAPS] {
    let (mut m, mut x) = (*matrix, *right);
    (0..TAPS).for_each(|i| m[i][i] += ridge);
    for pivot in 0..TAPS {
        for row in pivot + 1..TAPS {
            let times = m[row][pivot] / m[pivot][pivot];
            let above = m[pivot];
            m[row].iter_mut().zip(above).skip(pivot).for_each(|(here, above)| *here -= times * above);
            x[row] -= times * x[pivot];
        }
    }
    for pivot in (0..TAPS).rev() {
        let known: f64 = (pivot + 1..TAPS).map(|column| m[pivot][column] * x[column]).sum();
        x[pivot] = (x[pivot] - known) / m[pivot][pivot];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::super::aperture::{Focus, Needs};
    use super::*;
    use crate::physics::shading::Shading;

    const GRID: Grid = Grid { beams: 512, bins: 8, azimuth_deg: 130.0, near_m: 0.5, far_m: 30.0 };
    const ARRAY: Array = Array {
        shading: Shading::Uniform,
        gain_error_db: 0.0,
        phase_error_deg: 0.0,
        ripple_db: 0.0,
        focus: Focus::Dynamic,
        transmit_width_deg: None,
        unit: 1,
    };

    fn tables(array: Array) -> (Aperture, BeamTables) {
        let aperture = Aperture::new(&array.shading, Needs { beam_width_deg: 0.6, azimuth_deg: 130.0 });
        let tables = BeamTables::new(&GRID, &aperture, &array);
        (aperture, tables)
    }

    #[test]
    fn all_power_of_a_beam_arrives() {
        let (_, tables) = tables(ARRAY);
        let mut sums = vec![0.0; 512];
        tables.heard.iter().flatten().for_each(|&(beam, share)| sums[beam] += f64::from(share));
        assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-5), "{sums:?}");
    }

    #[test]
    fn an_even_fan_is_brighter_where_beams_are_wider() {
        let (aperture, tables) = tables(ARRAY);
        let ahead = aperture.u_step() / GRID.beam_rad();
        assert!((tables.even[256] / ahead - 1.0).abs() < 0.01);
        let bearing = GRID.bearing_rad(440);
        assert!((tables.even[440] * crate::math::real::cos(bearing) / ahead - 1.0).abs() < 0.02);
        assert!(tables.even[511] * crate::math::real::cos(GRID.bearing_rad(511)) < 0.75 * ahead);
    }

    #[test]
    fn interpolation_is_exact_to_forty_five_decibels() {
        for shading in [Shading::Uniform, Shading::Hamming, Shading::Taylor { side_lobe_db: 25.0, near: 4 }] {
            let aperture = Aperture::new(&shading, Needs { beam_width_deg: 0.6, azimuth_deg: 130.0 });
            let interpolator = Interpolator::new(&aperture);
            for i in 0..16 {
                let place = 200.0 + f64::from(i) / 16.0;
                let (first, taps) = interpolator.taps(&aperture, place);
                // ⟨|Σ t·A(i) − A(place)|²⟩ over ⟨|A|²⟩.
                let between = |a: f64, b: f64| aperture.power_at(a - b) / aperture.power_at(0.0);
                let at = |tap: usize| (first + tap) as f64;
                let mut error = 1.0;
                for (r, a) in taps.iter().enumerate() {
                    error -= 2.0 * a * between(at(r), place);
                    error += taps.iter().enumerate().map(|(c, b)| a * b * between(at(r), at(c))).sum::<f64>();
                }
                assert!(error < 3e-5, "{shading:?} {i} {error:e}");
            }
        }
    }

    #[test]
    fn a_transmitter_dims_the_edges() {
        let (_, tables) = tables(Array { transmit_width_deg: Some(100.0), ..ARRAY });
        let sum = |beam: usize| tables.heard.iter().flatten().filter(|h| h.0 == beam).map(|h| h.1).sum::<f32>();
        // 50° is beam 452.4.
        assert!((sum(452) - 0.5).abs() < 0.01 && sum(256) > 0.999, "{}", sum(452));
    }
}
