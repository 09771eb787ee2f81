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
        let mut cell = Vec::with_capacity(width as usize * height as usize);
        for row in 0..height {
            let ahead = grid.far_m - (f64::from(row) + 0.5) * pixel_m;
            for column in 0..width {
                let port = (0.5 * f64::from(width) - f64::from(column) - 0.5) * pixel_m;
                let range = (ahead * ahead + port * port).sqrt();
                let at = grid.bin_of(range).zip(grid.beam_of(atan2(port, ahead)));
                cell.push(at.map_or(Self::OUTSIDE, |(bin, beam)| grid.cell(beam, bin) as u32));
            }
        }
        Self { width, height, pixel_m, cell }
    }

    /// Looks every pixel up in `cells`; pixels outside the fan get `outside`.
    #[must_use]
    pub fn view<T: Copy>(&self, cells: &[T], outside: T) -> Vec<T> {
        self.cell.iter().map(|&c| cells.get(c as usize).copied().unwrap_or(outside)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fan_shows_port_on_the_left_and_far_at_the_top() {
        let grid = Grid { beams: 64, bins: 100, azimuth_deg: 90.0, near_m: 1.0, far_m: 11.0 };
        let fan = FanMap::new(&grid, 200);
        let at = |row: u32, column: u32| fan.cell[(row * fan.width + column) as usize];
        let middle = at(0, fan.width / 2);
        assert_eq!(middle % grid.bins, 99, "the top of the middle column is the last bin");
        assert!((30..34).contains(&(middle / grid.bins)));
        assert_eq!(at(199, 0), FanMap::OUTSIDE);
        let port = (0..fan.width).map(|c| at(60, c)).find(|&c| c != FanMap::OUTSIDE).unwrap();
        assert_eq!(port / grid.bins, 63, "the leftmost pixel inside belongs to the most port beam");
    }
}
