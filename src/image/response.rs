//! What the receiver makes of a point: its main lobe in bearing and its pulse in range.
//!
//! Both are taken as Gaussian in amplitude with the −3 dB widths of the device. The field's amplitudes are convolved, so a
//! strong echo spreads over neighbouring beams and speckle is correlated over the response.

use super::field::Field;
use crate::math::real::{exp, ln, radians};
use crate::sonar::Grid;

/// Convolves `field` with the response: −3 dB widths `beam_width_deg` in bearing and `pulse_m` in slant range.
pub fn blur(field: &mut Field, grid: &Grid, beam_width_deg: f64, pulse_m: f64) {
    let across = kernel(radians(beam_width_deg) / grid.beam_rad());
    let along = kernel(pulse_m / grid.bin_m());
    for part in [&mut field.re, &mut field.im] {
        *part = convolve_beams(part, grid.bins as usize, &across);
        convolve_ranges(part, grid.bins as usize, &along);
    }
}

/// Half a symmetric kernel (middle tap first) of unit energy, whose power falls to one half at ± `width` / 2 samples.
fn kernel(width: f64) -> Vec<f32> {
    // Amplitude exp(−a·x²): power exp(−2a·x²) is ½ at x = width/2.
    let a = 2.0 * ln(2.0) / (width * width).max(1e-12);
    let reach = (width * 1.5).ceil().clamp(0.0, 32.0) as usize;
    let taps: Vec<f64> = (0..=reach).map(|x| exp(-a * (x * x) as f64)).filter(|&tap| tap > 1e-3).collect();
    let energy = taps[0] * taps[0] + 2.0 * taps[1..].iter().map(|tap| tap * tap).sum::<f64>();
    taps.iter().map(|tap| (tap / energy.sqrt()) as f32).collect()
}

/// Convolves across beams; beyond the outermost beams there is nothing.
fn convolve_beams(part: &[f32], bins: usize, kernel: &[f32]) -> Vec<f32> {
    let beams = part.len() / bins;
    let mut out: Vec<f32> = part.iter().map(|value| value * kernel[0]).collect();
    for (offset, tap) in kernel.iter().enumerate().skip(1) {
        for beam in 0..beams {
            let row = &mut out[beam * bins..(beam + 1) * bins];
            for neighbour in
                [beam.checked_sub(offset), Some(beam + offset).filter(|&b| b < beams)].into_iter().flatten()
            {
                let from = &part[neighbour * bins..(neighbour + 1) * bins];
                row.iter_mut().zip(from).for_each(|(out, value)| *out += tap * value);
            }
        }
    }
    out
}

/// Convolves along each beam; before the first and after the last bin there is nothing.
fn convolve_ranges(part: &mut [f32], bins: usize, kernel: &[f32]) {
    if kernel.len() == 1 {
        return;
    }
    let mut copy = vec![0.0; bins];
    for row in part.chunks_exact_mut(bins) {
        copy.copy_from_slice(row);
        row.iter_mut().for_each(|value| *value *= kernel[0]);
        for (offset, tap) in kernel.iter().enumerate().skip(1).filter(|&(offset, _)| offset < bins) {
            row[offset..].iter_mut().zip(&copy).for_each(|(out, value)| *out += tap * value);
            row.iter_mut().zip(&copy[offset..]).for_each(|(out, value)| *out += tap * value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_keeps_its_energy_and_gets_the_width_asked_for() {
        let grid = Grid { beams: 65, bins: 65, azimuth_deg: 16.25, near_m: 1.0, far_m: 1.65 };
        let mut field = Field { re: vec![0.0; grid.len()], im: vec![0.0; grid.len()] };
        field.re[grid.cell(32, 32)] = 2.0;
        blur(&mut field, &grid, 1.0, 0.04);
        let energy: f32 = field.re.iter().map(|v| v * v).sum();
        assert!((energy - 4.0).abs() < 1e-4, "{energy}");
        let power = |beam, bin| field.re[grid.cell(beam, bin)].powi(2);
        // 1° is 4 beams, 0.04 m is 4 bins: half the power two cells off the middle.
        assert!((power(34, 32) / power(32, 32) - 0.5).abs() < 1e-4);
        assert!((power(32, 30) / power(32, 32) - 0.5).abs() < 1e-4);
    }
}
