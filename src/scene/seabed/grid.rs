//! Heights on a square grid and the sediments of its cells: what is added to it, what stands on it.

use glam::{DVec2, DVec3};

/// Heights at the corners of square cells about the world's origin; between them the two triangles of each cell.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightGrid {
    /// Row by row from low y, low x first.
    pub(super) heights: Vec<f32>,
    /// Cells along a side.
    pub(super) cells: usize,
    /// Side of the square, metres.
    extent: f64,
    /// Names of sediments; the first covers what no other does.
    pub(super) sediments: Vec<String>,
    /// Number of each cell's sediment, row by row; empty if all have the first.
    pub(super) cover: Vec<u8>,
    /// Doublings of the cells of each tile; empty if there are none.
    pub(super) levels: Vec<u8>,
}

impl HeightGrid {
    /// All heights 0, in cells of about `cell` metres: as many as fit best.
    pub(super) fn flat(extent: f64, cell: f64) -> Self {
        let cells = ((extent / cell).round() as usize).max(1);
        let heights = vec![0.0; (cells + 1) * (cells + 1)];
        Self { heights, cells, extent, sediments: vec![String::new()], cover: Vec::new(), levels: Vec::new() }
    }

    /// Side of the square, metres.
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.extent
    }

    /// Side of a cell, metres.
    #[must_use]
    pub fn cell(&self) -> f64 {
        self.extent / self.cells as f64
    }

    /// Row by row from low y, low x first, metres.
    #[must_use]
    pub fn heights(&self) -> &[f32] {
        &self.heights
    }

    /// Names of the sediments that it is made of: the material slots of its mesh.
    #[must_use]
    pub fn sediments(&self) -> &[String] {
        &self.sediments
    }

    /// Height of the surface at a point of the world, metres; beyond the square that of its nearest edge.
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        let (column, s) = self.cell_at(x);
        let (row, t) = self.cell_at(y);
        let at = |i: usize, j: usize| f64::from(self.heights[j * (self.cells + 1) + i]);
        let (low, high) = (at(column, row), at(column + 1, row + 1));
        // The diagonal from low to high parts the cell, as in the mesh.
        if s >= t {
            let right = at(column + 1, row);
            low + s * (right - low) + t * (high - right)
        } else {
            let left = at(column, row + 1);
            low + t * (left - low) + s * (high - left)
        }
    }

    /// Whether the straight way between two points lies above the surface, both ends left out by a millimetre.
    ///
    /// Along the way the surface is straight from edge to edge of its triangles, so heights are compared there only.
    #[must_use]
    pub fn is_clear(&self, from: DVec3, to: DVec3) -> bool {
        const MARGIN_M: f64 = 1e-3;
        let way = to - from;
        let margin = MARGIN_M / way.length();
        if margin.is_nan() || margin >= 0.5 {
            return true;
        }
        let above = |share: f64| {
            let place = from + way * share;
            let outside = place.x.abs().max(place.y.abs()) > 0.5 * self.extent;
            outside || place.z >= self.height(place.x, place.y)
        };
        let cell = self.cell();
        let crossings = |start: f64, end: f64| {
            let (start, end) = (start / cell, end / cell);
            let lines = start.min(end).ceil() as i64..=start.max(end).floor() as i64;
            lines.map(move |line| (line as f64 - start) / (end - start))
        };
        // Grid lines lie a whole number of cells from the corner; diagonals where those of x and of y are as far apart.
        let corner = 0.5 * self.extent;
        let across =
            [(from.x + corner, to.x + corner), (from.y + corner, to.y + corner), (from.x - from.y, to.x - to.y)];
        let inner = |share: &f64| (margin..=1.0 - margin).contains(share);
        [margin, 1.0 - margin].into_iter().all(above)
            && across.into_iter().flat_map(|(start, end)| crossings(start, end)).filter(inner).all(above)
    }

    /// Furthest distance from the origin to a corner of the square, metres.
    pub(super) fn reach(&self) -> f64 {
        self.extent * std::f64::consts::FRAC_1_SQRT_2
    }

    /// Adds a height field.
    pub(super) fn add(&mut self, height: impl Fn(f64, f64) -> f64) {
        let side = self.cells + 1;
        for row in 0..side {
            let y = self.place(row);
            for column in 0..side {
                let x = self.place(column);
                let here = &mut self.heights[row * side + column];
                *here = (f64::from(*here) + height(x, y)) as f32;
            }
        }
    }

    /// Adds another grid of the same cells, scaled.
    pub(super) fn add_grid(&mut self, other: &Self, scale: f64) {
        for (here, there) in self.heights.iter_mut().zip(&other.heights) {
            *here = (f64::from(*here) + scale * f64::from(*there)) as f32;
        }
    }

    /// Lifts the surface to `top` where that is higher, within a distance of a place; what is lifted is of a sediment.
    pub(super) fn raise_to(&mut self, middle: DVec2, radius: f64, top: impl Fn(f64, f64) -> f64, sediment: &str) {
        let number = self.number(sediment);
        let lines = |coordinate: f64, top: usize| {
            let line = |v: f64| ((v / self.extent + 0.5) * self.cells as f64).clamp(0.0, self.cells as f64) as usize;
            line(coordinate - radius)..=(line(coordinate + radius) + 1).min(top)
        };
        let half = 0.5 * self.cell();
        let (cells_x, cells_y) = (lines(middle.x, self.cells - 1), lines(middle.y, self.cells - 1));
        let (lines_x, lines_y) = (lines(middle.x, self.cells), lines(middle.y, self.cells));
        for (row, column) in cells_y.flat_map(|row| cells_x.clone().map(move |column| (row, column))) {
            let (x, y) = (self.place(column) + half, self.place(row) + half);
            if top(x, y) > self.height(x, y) {
                self.cover[row * self.cells + column] = number;
            }
        }
        for (row, column) in lines_y.flat_map(|row| lines_x.clone().map(move |column| (row, column))) {
            let top = top(self.place(column), self.place(row)) as f32;
            let here = &mut self.heights[row * (self.cells + 1) + column];
            *here = here.max(top);
        }
    }

    /// Makes the cells whose middle is `within` of a sediment.
    pub(super) fn paint(&mut self, sediment: &str, within: impl Fn(f64, f64) -> bool) {
        let chosen = self.of_cells(within);
        self.paint_cells(sediment, |cell| chosen[cell]);
    }

    /// Makes chosen cells, by their number, of a sediment.
    pub(super) fn paint_cells(&mut self, sediment: &str, mut chosen: impl FnMut(usize) -> bool) {
        let number = self.number(sediment);
        for (cell, cover) in self.cover.iter_mut().enumerate() {
            if chosen(cell) {
                *cover = number;
            }
        }
    }

    /// A value for the middle of each cell, row by row.
    pub(super) fn of_cells<T>(&self, value: impl Fn(f64, f64) -> T) -> Vec<T> {
        let half = 0.5 * self.cell();
        let cells = (0..self.cells).flat_map(|row| (0..self.cells).map(move |column| (row, column)));
        cells.map(|(row, column)| value(self.place(column) + half, self.place(row) + half)).collect()
    }

    /// Height of each cell above the mean of the square of cells within `reach` metres of it along x and y.
    pub(super) fn relief(&self, reach: f64) -> Vec<f32> {
        let n = self.cells;
        let here = self.of_cells(|x, y| self.height(x, y));
        // sums[j·(n + 1) + i] is the sum of all cells below row j and left of column i.
        let mut sums = vec![0.0; (n + 1) * (n + 1)];
        for (row, line) in here.chunks_exact(n).enumerate() {
            let mut along = 0.0;
            for (column, height) in line.iter().enumerate() {
                along += height;
                sums[(row + 1) * (n + 1) + column + 1] = sums[row * (n + 1) + column + 1] + along;
            }
        }
        let near = ((reach / self.cell()).round() as usize).max(1);
        let around = |cell: usize| (cell.saturating_sub(near), (cell + near + 1).min(n));
        let mean = |row: usize, column: usize| {
            let ((south, north), (west, east)) = (around(row), around(column));
            let at = |row: usize, column: usize| sums[row * (n + 1) + column];
            let sum = at(north, east) - at(north, west) - at(south, east) + at(south, west);
            sum / ((north - south) * (east - west)) as f64
        };
        here.iter().enumerate().map(|(cell, height)| (height - mean(cell / n, cell % n)) as f32).collect()
    }

    pub(super) fn subtract_mean(&mut self) {
        let mean = self.heights.iter().map(|&h| f64::from(h)).sum::<f64>() / self.heights.len() as f64;
        self.heights.iter_mut().for_each(|h| *h = (f64::from(*h) - mean) as f32);
    }

    pub(super) fn rms(&self) -> f64 {
        let squares: f64 = self.heights.iter().map(|&h| f64::from(h) * f64::from(h)).sum();
        (squares / self.heights.len() as f64).sqrt()
    }

    /// Coordinate of a grid line, metres.
    pub(super) fn place(&self, line: usize) -> f64 {
        self.extent * (line as f64 / self.cells as f64 - 0.5)
    }

    /// Number of a sediment, a new one if it is not known yet. From here on every cell has its number.
    fn number(&mut self, sediment: &str) -> u8 {
        if self.cover.is_empty() {
            self.cover = vec![0; self.cells * self.cells];
        }
        let known = self.sediments.iter().position(|name| name == sediment);
        // The table of sediments is far shorter than 256.
        known.unwrap_or_else(|| {
            self.sediments.push(sediment.into());
            self.sediments.len() - 1
        }) as u8
    }

    /// Cell of a coordinate and the share of it that lies below the coordinate.
    fn cell_at(&self, coordinate: f64) -> (usize, f64) {
        let place = ((coordinate / self.extent + 0.5) * self.cells as f64).clamp(0.0, self.cells as f64);
        let cell = (place as usize).min(self.cells - 1);
        (cell, place - cell as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Stream;
    use crate::scene::bvh::Bvh;
    use glam::DAffine3;

    #[test]
    fn sight_over_the_grid_is_sight_over_its_mesh() {
        let mut grid = HeightGrid::flat(8.0, 0.2);
        grid.add(|x, y| 0.4 * crate::math::real::sin(2.0 * x) * crate::math::real::cos(3.0 * y));
        let mesh = grid.mesh();
        let bvh = Bvh::of([(&mesh, DAffine3::IDENTITY)]);
        let mut stream = Stream::at(1, "test", 0, "sight");
        let mut point = |low: f64| {
            let (x, y) = (stream.uniform(-4.0, 4.0), stream.uniform(-4.0, 4.0));
            DVec3::new(x, y, grid.height(x, y) + low + stream.uniform(0.01, 0.5))
        };
        let mut clear = 0;
        for _ in 0..2000 {
            let (from, to) = (point(0.2), point(0.0));
            assert_eq!(grid.is_clear(from, to), bvh.is_clear(from, to), "{from} {to}");
            clear += u32::from(grid.is_clear(from, to));
        }
        assert!((300..1700).contains(&clear), "{clear} clear ways are no test");
        let (above, on) = (DVec3::new(0.3, 0.2, 2.0), DVec3::new(0.3, 0.2, grid.height(0.3, 0.2)));
        assert!(grid.is_clear(above, on) && !grid.is_clear(above, on - DVec3::Z));
    }
}
