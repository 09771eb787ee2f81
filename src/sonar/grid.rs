//! The polar grid of a ping: beams in bearing, bins in slant range, and how cells lie in an image.

use crate::math::real::radians;

/// Beams evenly spaced in bearing and bins evenly spaced in slant range.
///
/// Beam 0 is the most starboard one (bearings grow to port), bin 0 the nearest. Cells are numbered beam by beam:
/// `cell = beam · bins + bin`. Images show port on the left and far ranges at the top, in the polar view as in the fan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Number of beams: image width of the polar view.
    pub beams: u32,
    /// Number of range bins: image height of the polar view.
    pub bins: u32,
    /// Horizontal aperture that the beams share evenly, degrees.
    pub azimuth_deg: f64,
    /// Slant range of the near edge of bin 0, metres.
    pub near_m: f64,
    /// Slant range of the far edge of the last bin, metres.
    pub far_m: f64,
}

impl Grid {
    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.beams as usize * self.bins as usize
    }

    /// A grid without cells has nothing to show.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of the cell at (beam, bin).
    #[must_use]
    pub fn cell(&self, beam: u32, bin: u32) -> usize {
        beam as usize * self.bins as usize + bin as usize
    }

    /// Length of one range bin, metres.
    #[must_use]
    pub fn bin_m(&self) -> f64 {
        (self.far_m - self.near_m) / f64::from(self.bins)
    }

    /// Slant range of the middle of a bin, metres.
    #[must_use]
    pub fn range_m(&self, bin: u32) -> f64 {
        self.near_m + (f64::from(bin) + 0.5) * self.bin_m()
    }

    /// Angle between neighbouring beams, radians.
    #[must_use]
    pub fn beam_rad(&self) -> f64 {
        radians(self.azimuth_deg) / f64::from(self.beams)
    }

    /// Bearing of the middle of a beam, radians, positive to port.
    #[must_use]
    pub fn bearing_rad(&self, beam: u32) -> f64 {
        (f64::from(beam) + 0.5) * self.beam_rad() - 0.5 * radians(self.azimuth_deg)
    }

    /// Bin that holds a slant range, `floor((r − near) / bin)`; `None` outside the grid.
    #[must_use]
    pub fn bin_of(&self, range_m: f64) -> Option<u32> {
        let bin = ((range_m - self.near_m) / self.bin_m()).floor();
        (bin >= 0.0 && bin < f64::from(self.bins)).then_some(bin as u32)
    }

    /// Beam that holds a bearing (radians, positive to port); `None` outside the grid.
    #[must_use]
    pub fn beam_of(&self, bearing_rad: f64) -> Option<u32> {
        let beam = ((bearing_rad + 0.5 * radians(self.azimuth_deg)) / self.beam_rad()).floor();
        (beam >= 0.0 && beam < f64::from(self.beams)).then_some(beam as u32)
    }

    /// Pixel of the polar image, `row · beams + column`: column 0 is the most port beam, row 0 the farthest bin.
    #[must_use]
    pub fn polar_pixel(&self, beam: u32, bin: u32) -> usize {
        let (column, row) = (self.beams - 1 - beam, self.bins - 1 - bin);
        row as usize * self.beams as usize + column as usize
    }

    /// Cell values rearranged as a polar image (rows of `beams` pixels, see [`Self::polar_pixel`]).
    #[must_use]
    pub fn to_polar_image<T: Copy + Default>(&self, cells: &[T]) -> Vec<T> {
        let (beams, bins) = (self.beams as usize, self.bins as usize);
        let mut image = vec![T::default(); self.len()];
        // Blocks of beams, so that a block's cells stay in cache while rows are written.
        for block in (0..beams).step_by(16) {
            for row in 0..bins {
                for beam in block..(block + 16).min(beams) {
                    image[row * beams + (beams - 1 - beam)] = cells[beam * bins + (bins - 1 - row)];
                }
            }
        }
        image
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { beams: 33, bins: 20, azimuth_deg: 130.0, near_m: 0.1, far_m: 10.1 };

    #[test]
    fn centres_fall_in_their_own_cells() {
        for beam in 0..GRID.beams {
            assert_eq!(GRID.beam_of(GRID.bearing_rad(beam)), Some(beam));
        }
        for bin in 0..GRID.bins {
            assert_eq!(GRID.bin_of(GRID.range_m(bin)), Some(bin));
        }
        assert_eq!(GRID.bin_of(0.05), None);
        assert_eq!(GRID.bin_of(10.1), None);
    }

    #[test]
    fn a_polar_image_has_port_left_and_far_up() {
        let mut cells = vec![0u8; GRID.len()];
        cells[GRID.cell(GRID.beams - 1, GRID.bins - 1)] = 1;
        cells[GRID.cell(2, 5)] = 2;
        let image = GRID.to_polar_image(&cells);
        assert_eq!(image[0], 1);
        assert_eq!(image[GRID.polar_pixel(2, 5)], 2);
        assert_eq!(image.iter().filter(|&&v| v != 0).count(), 2);
    }
}
