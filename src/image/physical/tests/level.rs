//! Levels: seabed, noise, water, gain.

use super::*;
use crate::image::display::Scale;
use crate::image::linear;
use crate::math::real::{db_from_power, log10, power_from_db, radians};
use crate::physics::sonar_equation::{Levels, seabed_cell_area_m2, seabed_strength_db, transmission_loss_db};
use crate::physics::{Load, TurbidWater, Water};
use crate::sonar::{Bearing, Mount, Sonar};

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
    let channel = Channel { gain_absorption_db_per_m: 0.5, noise_power: 1e-9, ..CHANNEL };
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
                .map(|r| (30.0 * log10(GRID.range_m(r as u32)) + GRID.range_m(r as u32)).min(36.0))
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
    let sonar = |frequency_khz: f64| Sonar {
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
        bearing: Bearing::Cone,
        frequency_khz,
        bandwidth_khz: 100.0,
        source_level_db: 210.0,
        directivity_db: 30.0,
        yaw_rate_deg_s: 0.0,
        mount: Mount { position_m: [0.0; 3], yaw_deg: 0.0, pitch_deg: 0.0, roll_deg: 0.0 },
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

/// A sonar's gain is set for temperature and salinity: what turbidity takes besides is missing in the image.
#[test]
fn the_gain_makes_up_for_clear_water_only() {
    let of = |absorption_db_per_m| {
        let channel = Channel { absorption_db_per_m, gain_absorption_db_per_m: 0.3, ..CHANNEL };
        let chain = chain(&GRID, &IDEAL, &channel, Noise::Silent);
        let powers = chain.powers(&even(GRID, 1.0), &mut stream(0));
        (0..512).map(|bin| db_from_power(f64::from(powers[128 * 512 + bin])) + chain.gain_db()[bin]).collect::<Vec<_>>()
    };
    for (bin, (clear, turbid)) in of(0.3).into_iter().zip(of(0.7)).enumerate() {
        let missing = 2.0 * 0.4 * GRID.range_m(bin as u32);
        assert!((clear - turbid - missing).abs() < 1e-3, "{bin}: {clear} {turbid} {missing}");
    }
}
