//! Directions: beams, side lobes, focus, ghosts.

use super::*;
use crate::math::real::{asin, db_from_power, degrees, sin};
use crate::physics::array::LineArray;
use crate::physics::shading::Shading;

/// The pattern of a point in one direction: bearings, and powers over the greatest. Many narrow beams sample it.
fn point_pattern(array: Array, beam_width_deg: f64) -> (Vec<f64>, Vec<f64>) {
    let grid = Grid { beams: 2048, bins: 1, azimuth_deg: 30.0, near_m: 4.99, far_m: 5.01 };
    let channel = Channel { beam_width_deg, ..CHANNEL };
    let physical = Physical { array, ..IDEAL };
    let chain = chain(&grid, &physical, &channel, Noise::Silent);
    let mut echoes = Echoes::silence(grid);
    let heard = &chain.response.tables().heard;
    let whole = |heard: &&Vec<(usize, f32)>| heard.len() > 2 && heard[1].0 > 1020;
    echoes.energy[heard.iter().find(whole).unwrap()[1].0] = 1.0;
    let powers = chain.powers(&echoes, &mut stream(0));
    let peak = powers.iter().copied().fold(0.0, f32::max);
    let bearings = (0..grid.beams).map(|beam| degrees(grid.bearing_rad(beam))).collect();
    (bearings, powers.iter().map(|&p| f64::from(p / peak)).collect())
}

#[test]
fn beams_and_side_lobes_are_those_of_theory() {
    for shading in [
        Shading::Uniform,
        Shading::Hamming,
        Shading::Taylor { side_lobe_db: 25.0, near: 4 },
        Shading::Taylor { side_lobe_db: 35.0, near: 6 },
        Shading::Chebyshev { side_lobe_db: 30.0 },
    ] {
        let (bearings, pattern) = point_pattern(Array { shading, ..PERFECT }, 0.6);
        let peak = pattern.iter().position(|&p| p == 1.0).unwrap();
        let crossing = |mut range: Box<dyn Iterator<Item = usize>>| {
            let beam = range.find(|&beam| pattern[beam] < 0.5).unwrap();
            let inner = if beam > peak { beam - 1 } else { beam + 1 };
            let part = (pattern[inner] - 0.5) / (pattern[inner] - pattern[beam]);
            bearings[inner] + part * (bearings[beam] - bearings[inner])
        };
        let width = crossing(Box::new(peak..2048)) - crossing(Box::new((0..peak).rev()));
        assert!((width / 0.6 - 1.0).abs() < 0.02, "{shading:?} {width}");
        // Side lobes begin where the pattern first rises again.
        let null = (peak..2047).find(|&beam| pattern[beam + 1] > pattern[beam]).unwrap();
        let lobe = db_from_power(pattern[null..].iter().copied().fold(0.0, f64::max));
        let theory = LineArray::new(255, 0.5, &shading).unwrap().peak_side_lobe_db().unwrap();
        assert!((lobe - theory).abs() < 0.4, "{shading:?} {lobe} {theory}");
    }
}

#[test]
fn errors_of_the_elements_lift_the_floor_of_the_side_lobes() {
    let shading = Shading::Chebyshev { side_lobe_db: 60.0 };
    let floors: Vec<f64> = (0..12)
        .map(|unit| {
            let array = Array { shading, gain_error_db: 1.0, phase_error_deg: 8.0, unit, ..PERFECT };
            let (bearings, pattern) = point_pattern(array, 0.6);
            let far: Vec<f64> = bearings.iter().zip(&pattern).filter(|(b, _)| b.abs() > 4.0).map(|(_, p)| *p).collect();
            moments(&far).0
        })
        .collect();
    let aperture = Aperture::new(&shading, Needs { beam_width_deg: 0.6, azimuth_deg: 30.0 });
    let sum = aperture.response_at(0.0);
    let theory = error_rms(1.0, 8.0).powi(2) * aperture.power_at(0.0) / (sum * sum);
    let off = db_from_power(moments(&floors).0 / theory);
    assert!(off.abs() < 1.0, "{off} dB off {} dB", db_from_power(theory));
}

#[test]
fn a_fixed_focus_is_sharp_at_its_range_and_blurred_elsewhere() {
    let grid = Grid { beams: 512, bins: 3, azimuth_deg: 30.0, near_m: 0.75, far_m: 9.75 };
    let channel = Channel { beam_width_deg: 0.3, ..CHANNEL };
    let power = |focus, bin: u32| {
        let physical = Physical { array: Array { focus, ..PERFECT }, ..IDEAL };
        let chain = chain(&grid, &physical, &channel, Noise::Silent);
        let mut echoes = Echoes::silence(grid);
        echoes.energy[grid.cell(256, bin)] = 1.0;
        let powers = chain.powers(&echoes, &mut stream(0));
        let row: Vec<f32> = (0..512).map(|beam| powers[grid.cell(beam, bin)]).collect();
        let total: f32 = row.iter().sum();
        (total, row.iter().copied().fold(0.0, f32::max) / total)
    };
    // Bins are centred on 2.25, 5.25 and 8.25 m.
    let fixed = Focus::Fixed { range_m: 5.25 };
    for bin in 0..3 {
        let ((all, sharp), (kept, blurred)) = (power(Focus::Dynamic, bin), power(fixed, bin));
        assert!((kept / all - 1.0).abs() < 0.02, "defocus keeps energy: {kept} {all}");
        match bin {
            1 => assert!((blurred / sharp - 1.0).abs() < 1e-3),
            _ => assert!(blurred < 0.8 * sharp, "{bin}: {blurred} {sharp}"),
        }
    }
}

/// Quadratures cut to squares: `sgn cos θ + i·sgn sin θ` has a third harmonic e^(−3iθ) of a third of the amplitude, so an
/// echo at u has a ghost at −3u, 9.54 dB below it.
#[test]
fn a_clipping_converter_makes_ghosts_of_a_strong_echo() {
    let target = GRID.beam_of(asin(0.2)).unwrap();
    let ghost = GRID.beam_of(asin(-0.6)).unwrap();
    let mut echoes = Echoes::silence(GRID);
    (0..GRID.bins).for_each(|bin| echoes.energy[GRID.cell(target, bin)] = 1.0);
    let ratio = |full_scale_db| {
        let receiver = Receiver { full_scale_db, max_gain_db: 0.0, ..QUIET };
        let channel = Channel { noise_power: 1e-14, ..CHANNEL };
        let chain = chain(&GRID, &Physical { receiver, ..IDEAL }, &channel, Noise::Heard);
        let powers = chain.powers(&echoes, &mut stream(0));
        let around = |beam: u32| -> f64 {
            let cells = (beam - 8..=beam + 8).flat_map(|b| (0..GRID.bins).map(move |r| GRID.cell(b, r)));
            cells.map(|cell| f64::from(powers[cell])).sum::<f64>()
        };
        db_from_power(around(ghost) / around(target))
    };
    let (clean, clipped) = (ratio(200.0), ratio(30.0));
    assert!(clean < -25.0 && (-12.0..-8.5).contains(&clipped), "{clean} {clipped}");
}

/// The direction of a beam's middle is where its pattern has its peak.
#[test]
fn echoes_stay_at_their_bearing() {
    let chain = chain(&GRID, &IDEAL, &CHANNEL, Noise::Silent);
    for beam in [3, 77, 128, 250] {
        let mut echoes = Echoes::silence(GRID);
        (0..GRID.bins).for_each(|bin| echoes.energy[GRID.cell(beam, bin)] = 1.0);
        let powers = chain.powers(&echoes, &mut stream(0));
        let of = |b: u32| f64::from(powers[GRID.cell(b, 0)..GRID.cell(b, 0) + 512].iter().sum::<f32>());
        let (sum, moment) = (beam - 3..=(beam + 3).min(255))
            .map(|b| (of(b), of(b) * sin(GRID.bearing_rad(b))))
            .fold((0.0, 0.0), |total, one| (total.0 + one.0, total.1 + one.1));
        let off = (asin(moment / sum) - GRID.bearing_rad(beam)) / GRID.beam_rad();
        assert!(off.abs() < 0.6, "beam {beam} is {off} beams off");
    }
}
