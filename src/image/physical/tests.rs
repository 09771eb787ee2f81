//! What an acoustician would measure on the images: statistics, beams, levels.

use sha2::{Digest as _, Sha256};

use super::*;
use crate::image::display::Scale;
use crate::image::vectors::tests::narrow;
use crate::image::{Display, ImageModel, Model, linear};
use crate::math::real::{asin, db_from_power, degrees, ln, power_from_db, radians, sin};
use crate::physics::array::LineArray;
use crate::physics::response::PulseWindow;
use crate::physics::shading::Shading;
use crate::physics::sonar_equation::{Levels, seabed_cell_area_m2, seabed_strength_db, transmission_loss_db};
use crate::physics::{Load, TurbidWater, Water};

const PERFECT: Array = Array {
    shading: Shading::Uniform,
    gain_error_db: 0.0,
    phase_error_deg: 0.0,
    ripple_db: 0.0,
    focus: Focus::Dynamic,
    transmit_width_deg: None,
    unit: 1,
};
const QUIET: Receiver = Receiver {
    most_looks: 1,
    noise_figure_db: 0.0,
    blanking_m: 0.0,
    ringing: Ringing { level_db: -200.0, decay_db_per_m: 0.0 },
    max_gain_db: 100.0,
    gain_step_db: 0.0,
    full_scale_db: 200.0,
};
const IDEAL: Physical = Physical { array: PERFECT, pulse: Pulse::Tone, receiver: QUIET };
const GRID: Grid = Grid { beams: 256, bins: 512, azimuth_deg: 120.0, near_m: 1.0, far_m: 11.24 };
/// Bins of 20 mm, pulses of 7.5 mm: one sample of the pulse a bin.
const CHANNEL: Channel = Channel {
    frequency_khz: 900.0,
    water: crate::physics::Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 },
    absorption_db_per_m: 0.0,
    volume_per_m: 0.0,
    noise_power: 1e-16,
    beam_width_deg: 1.0,
    pulse_m: 0.0075,
    wavelength_m: 0.0016,
    bandwidth_hz: 100e3,
    source_level_db: 210.0,
};

fn even(grid: Grid, energy: f32) -> Echoes {
    Echoes { energy: vec![energy; grid.len()], ..Echoes::silence(grid) }
}

fn stream(index: u64) -> Stream {
    Stream::at(1, "test", index, "image")
}

fn chain(grid: &Grid, physical: &Physical, channel: &Channel, noise: Noise) -> Chain {
    Chain::new(grid, &Setup { physical, tvg_db_per_decade: 30.0, noise }, channel)
}

/// Powers of an even field over what theory expects in each cell.
fn relative(physical: &Physical, channel: &Channel, grid: Grid) -> Vec<f64> {
    let chain = chain(&grid, physical, channel, Noise::Silent);
    let powers = chain.powers(&even(grid, 1.0), &mut stream(0));
    let cell_m2 = grid.beam_rad() * grid.bin_m();
    let beams = powers.chunks_exact(grid.bins as usize).zip(chain.footprint_m2());
    beams.flat_map(|(powers, area)| powers.iter().map(move |&p| f64::from(p) * cell_m2 / area)).collect()
}

fn moments(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / values.len() as f64;
    (mean, variance.sqrt() / mean)
}

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
        let lobe = 10.0 * ln(pattern[null..].iter().copied().fold(0.0, f64::max)) / ln(10.0);
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

#[test]
fn a_seabed_has_the_level_of_the_sonar_equation() {
    let grid = Grid { beams: 256, bins: 512, azimuth_deg: 60.0, near_m: 19.0, far_m: 21.0 };
    let channel = Channel { absorption_db_per_m: 0.3, pulse_m: 0.02, beam_width_deg: 1.0, ..CHANNEL };
    // Seabed of −30 dB at 20 m: energy of a cell is its area times that, over R⁴.
    let cell = seabed_cell_area_m2(20.0, grid.beam_rad(), grid.bin_m(), 0.0);
    let echoes = even(grid, (power_from_db(-30.0) * cell / (20.0 * 20.0 * 20.0 * 20.0)) as f32);
    let model = ImageModel {
        model: Model::Physical(IDEAL),
        tvg_db_per_decade: 30.0,
        display: Display { white_db: 0.0, dynamic_range_db: 60.0, gamma: 1.0 },
    };
    let image = linear(&echoes, &model, &channel, &stream(0)).unwrap();
    let middle = |beam: usize| beam * 512 + 240..beam * 512 + 272;
    let ahead: Vec<f64> = (64..192).flat_map(|b| image.noise_free[middle(b)].iter().map(|&v| f64::from(v))).collect();
    let level = db_from_power(moments(&ahead).0);
    let sonar = Levels { source_db: 210.0, noise_db: 0.0, directivity_db: 0.0, bandwidth_hz: 1.0, processing_db: 0.0 };
    // A uniform beam of −3 dB width w is worth a rectangle of w/0.886; a tone's triangle ⅔ of c/2B.
    let area = seabed_cell_area_m2(20.0, radians(1.0) / 0.885_893, 0.02 * 2.0 / 3.0, 0.0);
    let theory = sonar.echo_db(transmission_loss_db(20.0, 0.3), seabed_strength_db(-30.0, area));
    assert!((level - theory).abs() < 0.3, "{level} {theory}");
}

#[test]
fn noise_rises_with_the_gain_and_with_nothing_else() {
    let channel = Channel { absorption_db_per_m: 0.5, noise_power: 1e-9, ..CHANNEL };
    let physical = Physical { receiver: Receiver { max_gain_db: 36.0, ..QUIET }, ..IDEAL };
    let chain = chain(&GRID, &physical, &channel, Noise::Heard);
    let powers = chain.powers(&Echoes::silence(GRID), &mut stream(0));
    let (mean, variation) = moments(&powers.iter().map(|&p| f64::from(p)).collect::<Vec<_>>());
    assert!((mean / 1e-9 - 1.0).abs() < 0.02 && (variation - 1.0).abs() < 0.02, "{mean} {variation}");
    let display = Display { white_db: 60.0, dynamic_range_db: 120.0, gamma: 1.0 };
    let grey = display.grey(&powers, &Scale { gain_db: chain.gain_db(), footprint_m2: chain.footprint_m2() });
    let shown = |bins: std::ops::Range<usize>| {
        let values: Vec<f64> =
            (20..236).flat_map(|b| bins.clone().map(move |r| b * 512 + r)).map(|c| f64::from(grey[c])).collect();
        moments(&values).0 * 120.0 / 255.0
    };
    let gain = |bins: std::ops::Range<usize>| {
        moments(
            &bins
                .map(|r| (30.0 * ln(GRID.range_m(r as u32)) / ln(10.0) + GRID.range_m(r as u32)).min(36.0))
                .collect::<Vec<_>>(),
        )
        .0
    };
    for (near, far) in [(0..40, 200..240), (0..40, 380..420), (440..470, 480..512)] {
        let (measured, theory) = (shown(far.clone()) - shown(near.clone()), gain(far) - gain(near));
        assert!((measured - theory).abs() < 0.25, "{measured} {theory}");
    }
}

#[test]
fn water_and_frequency_change_levels_as_the_equations_say() {
    let echoes = even(GRID, 1e-6);
    let model = ImageModel {
        model: Model::Physical(IDEAL),
        tvg_db_per_decade: 30.0,
        display: Display { white_db: 0.0, dynamic_range_db: 60.0, gamma: 1.0 },
    };
    let sonar = |frequency_khz: f64| crate::sonar::Sonar {
        device: None,
        source: None,
        beams: GRID.beams,
        azimuth_deg: GRID.azimuth_deg,
        beam_width_deg: 1.0,
        elevation_deg: 20.0,
        vertical_beam_deg: None,
        elevations: 2,
        range_m: [GRID.near_m, GRID.far_m],
        range_bins: GRID.bins,
        bearing: crate::sonar::Bearing::Cone,
        frequency_khz,
        bandwidth_khz: 100.0,
        source_level_db: 210.0,
        directivity_db: 30.0,
        yaw_rate_deg_s: 0.0,
        mount: crate::sonar::Mount { position_m: [0.0; 3], yaw_deg: 0.0, pitch_deg: 0.0, roll_deg: 0.0 },
    };
    let sea = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 };
    let usual = (sea, Load::Clear, 900.0);
    let cases = [
        (Water { salinity_ppt: 0.0, ..sea }, Load::Clear, 900.0),
        (Water { temperature_c: 25.0, ..sea }, Load::Clear, 900.0),
        (Water { depth_m: 5000.0, ..sea }, Load::Clear, 900.0),
        (sea, Load::Clear, 450.0),
        (sea, Load::VeryTurbid, 900.0),
    ];
    let channel = |(water, turbidity, khz)| Channel::new(&sonar(khz), &TurbidWater { water, turbidity });
    let image = |channel: &Channel| linear(&echoes, &model, channel, &stream(0)).unwrap().noise_free;
    let reference = channel(usual);
    let before = image(&reference);
    for case in cases {
        let here = channel(case);
        let after = image(&here);
        for bin in [100, 400] {
            let cell = 128 * 512 + bin;
            // The speckle is the same: only absorption, and a pulse as long as the speed of sound makes it.
            let measured = db_from_power(f64::from(after[cell] / before[cell]));
            let range = GRID.range_m(bin as u32);
            let absorbed = 2.0 * range * (here.absorption_db_per_m - reference.absorption_db_per_m);
            let theory = db_from_power(here.pulse_m / reference.pulse_m) - absorbed;
            assert!(absorbed.abs() > 0.02, "{case:?} makes no difference");
            assert!((measured - theory).abs() < 2e-3, "{case:?} {range} m: {measured} {theory}");
        }
    }
}

#[test]
fn open_water_reverberates_where_it_is_turbid() {
    let channel = Channel { volume_per_m: 1e-5, absorption_db_per_m: 0.2, ..CHANNEL };
    let echoes = Echoes { water: vec![1e-3; GRID.len()], ..Echoes::silence(GRID) };
    let chain = chain(&GRID, &IDEAL, &channel, Noise::Silent);
    let powers = chain.powers(&echoes, &mut stream(0));
    let cell_m2 = GRID.beam_rad() * GRID.bin_m();
    let energy = |bins: std::ops::Range<usize>| {
        let cells = (20..236).flat_map(|b| bins.clone().map(move |r| (b, b * 512 + r)));
        moments(&cells.map(|(b, c)| f64::from(powers[c]) * cell_m2 / chain.footprint_m2()[b]).collect::<Vec<_>>()).0
    };
    for bin in [60, 450] {
        let range = GRID.range_m(bin);
        // Volume of the cell, R²·Ω·Δr, times s_v over R⁴ and absorption.
        let volume = range * range * 1e-3 * GRID.bin_m();
        let theory = 1e-5 * volume / (range * range * range * range) * power_from_db(-0.4 * range);
        let measured = energy(bin as usize - 8..bin as usize + 9);
        assert!((measured / theory - 1.0).abs() < 0.06, "{range} m: {measured:e} {theory:e}");
    }
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

/// An arbitrary picture with everything in it that the chain has.
fn everything() -> Vec<u8> {
    let grid = Grid { beams: 96, bins: 75, azimuth_deg: 90.0, near_m: 0.5, far_m: 3.5 };
    let physical = Physical {
        array: Array {
            shading: Shading::Taylor { side_lobe_db: 25.0, near: 4 },
            gain_error_db: 0.5,
            phase_error_deg: 3.0,
            ripple_db: 0.75,
            focus: Focus::Fixed { range_m: 2.0 },
            transmit_width_deg: Some(100.0),
            unit: 7,
        },
        pulse: Pulse::Chirp { duration_ms: 0.1, window: PulseWindow::Hamming },
        receiver: Receiver {
            most_looks: 2,
            noise_figure_db: 0.0,
            blanking_m: 0.6,
            ringing: Ringing { level_db: 150.0, decay_db_per_m: 80.0 },
            max_gain_db: 40.0,
            gain_step_db: 1.0,
            full_scale_db: 60.0,
        },
    };
    let model = ImageModel {
        model: Model::Physical(physical),
        tvg_db_per_decade: 30.0,
        display: Display { white_db: 10.0, dynamic_range_db: 90.0, gamma: 1.2 },
    };
    let channel = Channel { noise_power: 1e-12, volume_per_m: 1e-6, absorption_db_per_m: 0.3, ..CHANNEL };
    let energy = |cell: usize| 1e-6 * (1 + cell % 17) as f32 * if cell.is_multiple_of(701) { 1e4 } else { 1.0 };
    let echoes = Echoes {
        energy: (0..grid.len()).map(energy).collect(),
        water: vec![1e-4; grid.len()],
        ..Echoes::silence(grid)
    };
    crate::image::form(&echoes, &model, &channel, &mut stream(3))
}

#[test]
fn every_machine_makes_the_same_bits() {
    let grey = everything();
    assert_eq!(grey, narrow(everything), "vectors of another width");
    let hash: String = Sha256::digest(&grey).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(hash, "0af721851b710f75");
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
