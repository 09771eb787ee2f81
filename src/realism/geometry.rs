//! Where the fan lies in a picture.

use serde::{Deserialize, Serialize};

use crate::math::real::{atan2, cos, radians, sin, tan};
use crate::sonar::{FanMap, Grid};

/// A fan in a picture: apex below, ahead is up. Pixel coordinates name middles of pixels, (0, 0) the top left one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FanGeometry {
    /// Apex, pixels to the right and down.
    pub apex_px: [f64; 2],
    /// Pixels down / pixels across of the same length; 1 where pixels are square.
    #[serde(default = "square")]
    pub vertical_stretch: f64,
    /// Far edge from the apex, pixels.
    pub rmax_px: f64,
    /// Near edge from the apex, pixels.
    pub rmin_px: f64,
    /// Horizontal aperture, degrees.
    pub fov_deg: f64,
    /// Beams that share the aperture evenly, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beams: Option<u32>,
}

fn square() -> f64 {
    1.0
}

/// How near to the fan's edge pixels are left out: there they may be mixed with what is outside.
const MARGIN_PX: f64 = 1.0;

impl FanGeometry {
    /// The fan picture of a polar grid, as [`FanMap`] lays it.
    #[must_use]
    pub fn of_map(grid: &Grid, map: &FanMap) -> Self {
        Self {
            apex_px: [0.5 * f64::from(map.width) - 0.5, grid.far_m / map.pixel_m - 0.5],
            vertical_stretch: 1.0,
            rmax_px: grid.far_m / map.pixel_m,
            rmin_px: grid.near_m / map.pixel_m,
            fov_deg: grid.azimuth_deg,
            beams: Some(grid.beams),
        }
    }

    /// The fan that just fills a picture: the far arc touches the top, its ends the sides, the near arc's ends the bottom.
    #[must_use]
    pub fn filling(width: u32, height: u32, fov_deg: f64) -> Self {
        let half = 0.5 * radians(fov_deg);
        let rmax_px = 0.5 * f64::from(width) / sin(half);
        let rmin_px = ((rmax_px - f64::from(height)) / cos(half)).max(0.0);
        let apex_px = [0.5 * f64::from(width) - 0.5, rmax_px - 0.5];
        Self { apex_px, vertical_stretch: 1.0, rmax_px, rmin_px, fov_deg, beams: None }
    }

    /// Range (pixels) and bearing (radians, positive to the left) of a place in the picture.
    #[must_use]
    pub fn polar(&self, x: f64, y: f64) -> (f64, f64) {
        let (port, ahead) = (self.apex_px[0] - x, self.ahead(y));
        ((port * port + ahead * ahead).sqrt(), atan2(port, ahead))
    }

    /// Range of a place in the picture, pixels.
    #[must_use]
    pub fn range(&self, x: f64, y: f64) -> f64 {
        let (port, ahead) = (self.apex_px[0] - x, self.ahead(y));
        (port * port + ahead * ahead).sqrt()
    }

    /// Place of a range (pixels) in a [`Direction`].
    #[must_use]
    pub fn place(&self, range: f64, direction: Direction) -> (f64, f64) {
        let ahead = range * direction.ahead * self.vertical_stretch;
        (self.apex_px[0] - range * direction.port, self.apex_px[1] - ahead)
    }

    /// Which pixels of a picture are in the fan and not at its very edge, row by row.
    #[must_use]
    pub fn inside(&self, width: u32, height: u32) -> Vec<bool> {
        let half = 0.5 * radians(self.fov_deg);
        let (slope, reach) = (tan(half), MARGIN_PX / cos(half));
        let [near, far] = [self.rmin_px + MARGIN_PX, self.rmax_px - MARGIN_PX];
        let mut inside = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            let ahead = self.ahead(f64::from(y));
            // Half the fan's width in this row, less the margin measured across the fan's side.
            let side = ahead * slope - reach;
            for x in 0..width {
                let port = f64::from(x) - self.apex_px[0];
                let squared = port * port + ahead * ahead;
                inside.push(port.abs() <= side && squared >= near * near && squared <= far * far);
            }
        }
        inside
    }

    fn ahead(&self, y: f64) -> f64 {
        (self.apex_px[1] - y) / self.vertical_stretch
    }
}

/// Sine and cosine of a bearing.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    port: f64,
    ahead: f64,
}

impl Direction {
    /// The direction of a bearing in radians, positive to port.
    #[must_use]
    pub fn new(bearing_rad: f64) -> Self {
        Self { port: sin(bearing_rad), ahead: cos(bearing_rad) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { beams: 64, bins: 100, azimuth_deg: 90.0, near_m: 1.0, far_m: 11.0 };

    #[test]
    fn the_inside_is_that_of_the_fan_map_but_for_its_edge() {
        let map = FanMap::new(&GRID, 300);
        let fan = FanGeometry::of_map(&GRID, &map);
        let inside = fan.inside(map.width, map.height);
        let covered = |at: usize| map.cell[at] != FanMap::OUTSIDE;
        assert!((0..inside.len()).all(|at| !inside[at] || covered(at)));
        let lost = (0..inside.len()).filter(|&at| covered(at) && !inside[at]).count();
        // Length of the edge: two sides and two arcs, one to two pixels thick.
        let edge = 2.0 * (fan.rmax_px - fan.rmin_px) + radians(90.0) * (fan.rmax_px + fan.rmin_px);
        assert!((lost as f64) > 0.8 * edge && (lost as f64) < 2.0 * edge, "{lost} {edge}");
    }

    #[test]
    fn places_turn_back_and_agree_with_the_grid() {
        let map = FanMap::new(&GRID, 300);
        let fan = FanGeometry::of_map(&GRID, &map);
        for (beam, bin) in [(3, 90), (32, 50), (60, 40)] {
            let (range, bearing) = (GRID.range_m(bin) / map.pixel_m, GRID.bearing_rad(beam));
            let (x, y) = fan.place(range, Direction::new(bearing));
            let pixel = (y + 0.5) as u32 * map.width + (x + 0.5) as u32;
            assert_eq!(map.cell[pixel as usize], GRID.cell(beam, bin) as u32);
            let (r, b) = fan.polar(x, y);
            assert!((r - range).abs() < 1e-9 && (b - bearing).abs() < 1e-12);
        }
        let stretched = FanGeometry { vertical_stretch: 1.239, ..fan };
        let (x, y) = stretched.place(200.0, Direction::new(0.2));
        assert!((stretched.range(x, y) - 200.0).abs() < 1e-9);
    }

    #[test]
    fn a_filling_fan_is_the_fan_maps() {
        let map = FanMap::new(&GRID, 400);
        let (given, found) = (FanGeometry::of_map(&GRID, &map), FanGeometry::filling(map.width, map.height, 90.0));
        assert!((given.rmax_px - found.rmax_px).abs() < 1.0 && (given.rmin_px - found.rmin_px).abs() < 1.5);
        assert!((given.apex_px[1] - found.apex_px[1]).abs() < 1.0);
    }
}
