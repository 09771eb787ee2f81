//! Detection, gain and display: from a complex field to grey.

use serde::{Deserialize, Serialize};

use super::field::Field;
use super::{Channel, ImageModel};
use crate::math::fast::db;
use crate::math::real::db_from_power;
use crate::physics::levels::time_varied_gain_db;
use crate::sonar::Grid;

/// The levels that black and white stand for, as backscattering strength: after a 30 log R gain, a flat seabed shows its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Backscattering strength shown white (255), dB.
    pub white_db: f64,
    /// Decibels from white down to black (0).
    pub dynamic_range_db: f64,
}

/// Power → time-varied gain → decibels → grey. The gain follows the water's own absorption, as an operator would set it.
#[must_use]
pub fn detect(field: &Field, grid: &Grid, model: &ImageModel, channel: &Channel) -> Vec<u8> {
    let Display { white_db, dynamic_range_db } = model.display;
    // Divided by the area Δφ·Δr of a cell at 1 m, echo power becomes backscattering strength.
    let cell_db = db_from_power(grid.beam_rad() * grid.bin_m());
    let offset: Vec<f32> = (0..grid.bins)
        .map(|bin| {
            let gain = time_varied_gain_db(model.tvg_db_per_decade, channel.absorption_db_per_m, grid.range_m(bin));
            (gain - cell_db - (white_db - dynamic_range_db)) as f32
        })
        .collect();
    let grey_per_db = (255.0 / dynamic_range_db) as f32;
    let bins = grid.bins as usize;
    let mut grey = vec![0u8; field.re.len()];
    let beams = field.re.chunks_exact(bins).zip(field.im.chunks_exact(bins));
    for ((re, im), grey) in beams.zip(grey.chunks_exact_mut(bins)) {
        for (((re, im), offset), grey) in re.iter().zip(im).zip(&offset).zip(grey) {
            let power = (re * re + im * im).max(f32::MIN_POSITIVE);
            *grey = ((db(power) + offset) * grey_per_db + 0.5) as u8;
        }
    }
    grey
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Model;
    use crate::physics::Water;

    #[test]
    fn white_and_black_are_where_the_display_says() {
        let grid = Grid { beams: 1, bins: 3, azimuth_deg: 0.25, near_m: 0.5, far_m: 3.5 };
        let display = Display { white_db: -5.0, dynamic_range_db: 60.0 };
        let model = ImageModel { model: Model::Physical, tvg_db_per_decade: 30.0, display };
        let water = Water { temperature_c: 10.0, salinity_ppt: 35.0, ph: 8.0, depth_m: 10.0 };
        let channel = Channel {
            absorption_db_per_m: 0.3,
            noise_power: 0.0,
            beam_width_deg: 0.25,
            pulse_m: 1.0,
            frequency_khz: 900.0,
            water,
        };
        // A cell whose echo is that of backscattering strength `s` at its range.
        let amplitude = |s: f64, bin: u32| {
            let gain = time_varied_gain_db(30.0, 0.3, grid.range_m(bin));
            crate::math::real::power_from_db(s - gain + db_from_power(grid.beam_rad() * grid.bin_m())).sqrt() as f32
        };
        let field = Field { re: vec![amplitude(-5.0, 0), amplitude(-35.0, 1), amplitude(-70.0, 2)], im: vec![0.0; 3] };
        assert_eq!(detect(&field, &grid, &model, &channel), [255, 128, 0]);
    }
}
