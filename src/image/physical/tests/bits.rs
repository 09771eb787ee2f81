//! The same picture everywhere, and a picture of everything.

use sha2::{Digest as _, Sha256};

use super::*;
use crate::math::vectors::tests::narrow;
use crate::physics::response::PulseWindow;
use crate::physics::shading::Shading;

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
    let channel = Channel {
        noise_power: 1e-12,
        volume_per_m: 1e-6,
        absorption_db_per_m: 0.3,
        gain_absorption_db_per_m: 0.3,
        ..CHANNEL
    };
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

/// Grids and beams at the ends of what a sonar may have still give numbers, and their echoes arrive.
#[test]
fn the_oddest_sonars_have_images() {
    let grid = |beams, bins, azimuth_deg| Grid { beams, bins, azimuth_deg, near_m: 0.5, far_m: 3.0 };
    for (grid, beam_width_deg) in [
        (grid(1, 1, 0.01), 45.0),
        (grid(1, 3, 170.0), 45.0),
        (grid(2, 33, 0.01), 0.02),
        (grid(5, 40, 170.0), 0.1),
        (grid(700, 2, 3.0), 30.0),
    ] {
        for shading in [Shading::Uniform, Shading::Hann, Shading::Hamming, Shading::Chebyshev { side_lobe_db: 80.0 }] {
            for pulse_m in [1e-5, 7.5] {
                let physical = Physical { array: Array { shading, ..PERFECT }, ..IDEAL };
                let channel = Channel { beam_width_deg, pulse_m, ..CHANNEL };
                let chain = chain(&grid, &physical, &channel, Noise::Heard);
                let powers = chain.powers(&even(grid, 1.0), &mut stream(0));
                let right = powers.iter().all(|power| power.is_finite()) && powers.iter().any(|&power| power > 1e-9);
                assert!(right, "{grid:?} {beam_width_deg} {shading:?} {pulse_m}: {powers:?}");
                assert!(chain.footprint_m2().iter().all(|area| *area > 0.0 && area.is_finite()));
            }
        }
    }
}
