//! What an acoustician would measure on the images.

mod bits;
mod level;
mod pattern;
mod statistics;

use super::*;
use crate::image::{Display, ImageModel, Model};
use crate::physics::Water;
use crate::physics::shading::Shading;

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
    water: Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 },
    absorption_db_per_m: 0.0,
    gain_absorption_db_per_m: 0.0,
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
