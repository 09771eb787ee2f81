//! The fan view: where each pixel of a Cartesian picture lies in the polar grid.

use super::Grid;
use crate::math::real::{atan2, cos, radians, sin};

/// A table from fan pixels to polar cells. Apex at the bottom centre, ahead is up, port on the left, square pixels.
#[derive(Clone, Debug)]
pub struct FanMap {
    /// Pixels across.
    pub width: u32,
    /// Pixels from the apex side to the far arc.
    pub height: u32,
    /// Length of a pixel's side, metres.
    pub pixel_m: f64,
    /// For each pixel (row by row), the nearest cell, or [`FanMap::OUTSIDE`].
    pub cell: Vec<u32>,
    /// For each pixel, the four cells around it.
    around: Vec<Around>,
    bins: usize,
}

/// The cells around a pixel: the most starboard and nearest of the four, and how far the pixel is from it, in 1/256.
#[derive(Clone, Copy, Debug)]
struct Around {
    cell: u32,
    to_port: u8,
    to_far: u8,
}

impl FanMap {
    /// Marks pixels that no beam or no range bin covers.
    pub const OUTSIDE: u32 = u32::MAX;

    /// The fan of `grid`, `height` pixels high; the width follows from the aperture.
    #[must_use]
    pub fn new(grid: &Grid, height: u32) -> Self {
        let half = 0.5 * radians(grid.azimuth_deg);
        let bottom = grid.near_m * cos(half).max(0.0);
        let pixel_m = (grid.far_m - bottom) / f64::from(height);
        let reach = grid.far_m * if half < std::f64::consts::FRAC_PI_2 { sin(half) } else { 1.0 };
        let width = ((2.0 * reach / pixel_m).ceil() as u32).max(1);
        let pixels = width as usize * height as usize;
        let (mut cell, mut around) = (Vec::with_capacity(pixels), Vec::with_capacity(pixels));
        for row in 0..height {
            let ahead = grid.far_m - (f64::from(row) + 0.5) * pixel_m;
            for column in 0..width {
                let port = (0.5 * f64::from(width) - f64::from(column) - 0.5) * pixel_m;
                let (range, bearing) = ((ahead * ahead + port * port).sqrt(), atan2(port, ahead));
                let at = grid.bin_of(range).zip(grid.beam_of(bearing));
                cell.push(at.map_or(Self::OUTSIDE, |(bin, beam)| grid.cell(beam, bin) as u32));
                around.push(cells_around(grid, bearing, range));
            }
        }
        Self { width, height, pixel_m, cell, around, bins: grid.bins as usize }
    }

    /// A picture of grey cells, interpolated between the four cells around each pixel, as displays do; black outside.
    #[must_use]
    pub fn picture(&self, grey: &[u8]) -> Vec<u8> {
        let blend = |(&cell, around): (&u32, &Around)| {
            if cell == Self::OUTSIDE {
                return 0;
            }
            let near = around.cell as usize;
            let (far, port) =
                (near + usize::from(around.to_far > 0), near + usize::from(around.to_port > 0) * self.bins);
            let both = port + (far - near);
            let (u, v) = (u32::from(around.to_port), u32::from(around.to_far));
            let starboard_side = u32::from(grey[near]) * (256 - v) + u32::from(grey[far]) * v;
            let port_side = u32::from(grey[port]) * (256 - v) + u32::from(grey[both]) * v;
            ((starboard_side * (256 - u) + port_side * u + 32_768) >> 16) as u8
        };
        self.cell.iter().zip(&self.around).map(blend).collect()
    }
}

/// The four cells whose middles surround a point; at the grid's rim, those that there are.
fn cells_around(grid: &Grid, bearing: f64, range: f64) -> Around {
    let split = |place: f64, count: u32| {
        let place = place.clamp(0.0, f64::from(count - 1));
        let low = place.floor();
        (low as u32, ((place - low) * 256.0) as u8)
    };
    let (beam, to_port) = split((bearing + 0.5 * radians(grid.azimuth_deg)) / grid.beam_rad() - 0.5, grid.beams);
    let (bin, to_far) = split((range - grid.near_m) / grid.bin_m() - 0.5, grid.bins);
    Around { cell: grid.cell(beam, bin) as u32, to_port, to_far }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { beams: 64, bins: 100, azimuth_deg: 90.0, near_m: 1.0, far_m: 11.0 };

    #[test]
    fn the_fan_shows_port_on_the_left_and_far_at_the_top() {
        let fan = FanMap::new(&GRID, 200);
        let at = |row: u32, column: u32| fan.cell[(row * fan.width + column) as usize];
        let middle = at(0, fan.width / 2);
        assert_eq!(middle % GRID.bins, 99, "the top of the middle column is the last bin");
        assert!((30..34).contains(&(middle / GRID.bins)));
        assert_eq!(at(199, 0), FanMap::OUTSIDE);
        let port = (0..fan.width).map(|c| at(60, c)).find(|&c| c != FanMap::OUTSIDE).unwrap();
        assert_eq!(port / GRID.bins, 63, "the leftmost pixel inside belongs to the most port beam");
    }

    #[test]
    fn a_picture_is_smooth_inside_and_black_outside() {
        let fan = FanMap::new(&GRID, 300);
        let even = fan.picture(&vec![77; GRID.len()]);
        for (grey, &cell) in even.iter().zip(&fan.cell) {
            assert_eq!(*grey, if cell == FanMap::OUTSIDE { 0 } else { 77 });
        }
        // A ramp over the range bins stays a ramp along the middle column.
        let ramp: Vec<u8> = (0..GRID.len()).map(|cell| (2 * (cell % 100)) as u8).collect();
        let picture = fan.picture(&ramp);
        let column: Vec<u8> = (0..200).map(|row| picture[(row * fan.width + fan.width / 2) as usize]).collect();
        assert!(column.windows(2).all(|pair| pair[0] >= pair[1] && pair[0] - pair[1] <= 2), "{column:?}");
    }
}
