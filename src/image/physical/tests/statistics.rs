//! Speckle: energies, moments, correlations.

use super::*;
use crate::math::real::db_from_power;
use crate::physics::response::PulseWindow;
use crate::physics::shading::Shading;

#[test]
fn an_even_field_keeps_its_energy_and_has_the_statistics_of_speckle() {
    for shading in [Shading::Uniform, Shading::Hamming, Shading::Taylor { side_lobe_db: 25.0, near: 4 }] {
        let physical = Physical { array: Array { shading, ..PERFECT }, ..IDEAL };
        let powers = relative(&physical, &CHANNEL, GRID);
        let (mean, variation) = moments(&powers);
        assert!((mean - 1.0).abs() < 0.02 && (variation - 1.0).abs() < 0.02, "{shading:?} {mean} {variation}");
        let levels: Vec<f64> = powers.iter().map(|&p| db_from_power(p) + 100.0).collect();
        let (level, spread) = moments(&levels);
        assert!((level - 100.0 + 2.51).abs() < 0.1 && (spread * level - 5.57).abs() < 0.1, "{level} {spread}");
    }
}

#[test]
fn an_even_field_keeps_its_energy_through_pulses_longer_than_bins() {
    let pulses = [PulseWindow::Uniform, PulseWindow::Hamming].map(|window| Pulse::Chirp { duration_ms: 0.1, window });
    for pulse in [Pulse::Tone, pulses[0], pulses[1]] {
        let long = Channel { pulse_m: 0.06, ..CHANNEL };
        let (mean, variation) = moments(&relative(&Physical { pulse, ..IDEAL }, &long, GRID));
        assert!((mean - 1.0).abs() < 0.03 && (variation - 1.0).abs() < 0.03, "{pulse:?} {mean} {variation}");
    }
}

#[test]
fn looks_average_as_gamma_does() {
    for looks in [2, 4] {
        // 20 mm hold four pulses of 7.5 mm × ⅔.
        let physical = Physical { receiver: Receiver { most_looks: looks, ..QUIET }, ..IDEAL };
        let (mean, variation) = moments(&relative(&physical, &CHANNEL, GRID));
        assert!((mean - 1.0).abs() < 0.02, "{mean}");
        assert!((variation * f64::from(looks).sqrt() - 1.0).abs() < 0.02, "{looks} {variation}");
    }
}

#[test]
fn speckle_is_as_wide_as_the_response() {
    let physical = Physical { pulse: Pulse::Chirp { duration_ms: 0.1, window: PulseWindow::Hamming }, ..IDEAL };
    let grid = Grid { beams: 512, ..GRID };
    let channel = Channel { pulse_m: 0.05, ..CHANNEL };
    let powers = relative(&physical, &channel, grid);
    let bins = grid.bins as usize;
    let covariance = |beams: usize, lag: usize| {
        let pairs = (100..300).flat_map(|beam| (50..400).map(move |bin| beam * bins + bin));
        let values: Vec<f64> =
            pairs.map(|cell| (powers[cell] - 1.0) * (powers[cell + beams * bins + lag] - 1.0)).collect();
        values.iter().sum::<f64>() / values.len() as f64
    };
    // Intensities of a Gaussian field correlate as the square of its own correlation (Goodman 2007, ch. 4).
    let variance = covariance(0, 0);
    let aperture = Aperture::new(&Shading::Uniform, Needs { beam_width_deg: 1.0, azimuth_deg: 120.0 });
    for beams in 1..8 {
        let steps = beams as f64 * grid.beam_rad() * 0.96 / aperture.u_step();
        let theory = (aperture.power_at(steps) / aperture.power_at(0.0)).powi(2);
        let measured = covariance(beams, 0) / variance;
        assert!((measured - theory).abs() < 0.06, "{beams} beams: {measured} {theory}");
    }
    let pulse = physical.pulse.sampled(0.05, grid.bin_m(), 1);
    let tap = |at: i32| pulse.taps.get(at.unsigned_abs() as usize).map_or(0.0, |&tap| f64::from(tap));
    for lag in 1..6 {
        let own: f64 = (-40..40).map(|at| tap(at) * tap(at + lag)).sum();
        let measured = covariance(0, lag as usize) / variance;
        assert!((measured - own * own).abs() < 0.06, "{lag} bins: {measured} {}", own * own);
    }
}
