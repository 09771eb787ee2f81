//! Heights on a square grid: what is added to it, what stands on it, and its mesh.

use glam::{DVec3, Vec3};

use crate::scene::mesh::{Cluster, Mesh};

/// Cells along the side of a tile: 2 · 16² triangles are one full cluster.
const TILE: usize = 16;

/// Heights at the corners of square cells about the world's origin; between them the two triangles of each cell.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightGrid {
    /// Row by row from low y, low x first.
    heights: Vec<f32>,
    /// Cells along a side.
    cells: usize,
    /// Side of the square, metres.
    extent: f64,
}

impl HeightGrid {
    /// All heights 0, in cells of about `cell` metres: as many as fit best.
    pub(super) fn flat(extent: f64, cell: f64) -> Self {
        let cells = ((extent / cell).round() as usize).max(1);
        Self { heights: vec![0.0; (cells + 1) * (cells + 1)], cells, extent }
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

    /// The surface as a mesh of one material.
    #[must_use]
    pub fn mesh(&self, material: &str) -> Mesh {
        let starts = || (0..self.cells).step_by(TILE);
        let tiles = starts().flat_map(|row| starts().map(move |column| self.tile(column, row)));
        Mesh::from_clusters(tiles.collect(), vec![material.into()])
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

    pub(super) fn subtract_mean(&mut self) {
        let mean = self.heights.iter().map(|&h| f64::from(h)).sum::<f64>() / self.heights.len() as f64;
        self.heights.iter_mut().for_each(|h| *h = (f64::from(*h) - mean) as f32);
    }

    pub(super) fn rms(&self) -> f64 {
        let squares: f64 = self.heights.iter().map(|&h| f64::from(h) * f64::from(h)).sum();
        (squares / self.heights.len() as f64).sqrt()
    }

    /// Coordinate of a grid line, metres.
    fn place(&self, line: usize) -> f64 {
        self.extent * (line as f64 / self.cells as f64 - 0.5)
    }

    /// Cell of a coordinate and the share of it that lies below the coordinate.
    fn cell_at(&self, coordinate: f64) -> (usize, f64) {
        let place = ((coordinate / self.extent + 0.5) * self.cells as f64).clamp(0.0, self.cells as f64);
        let cell = (place as usize).min(self.cells - 1);
        (cell, place - cell as f64)
    }

    fn tile(&self, column: usize, row: usize) -> Cluster {
        let (wide, high) = (TILE.min(self.cells - column), TILE.min(self.cells - row));
        let side = wide + 1;
        let mut vertices = Vec::with_capacity(side * (high + 1));
        for j in row..=row + high {
            for i in column..=column + wide {
                let at = DVec3::new(self.place(i), self.place(j), self.heights[j * (self.cells + 1) + i].into());
                vertices.push(Vec3::new(at.x as f32, at.y as f32, at.z as f32));
            }
        }
        let mut triangles = Vec::with_capacity(2 * wide * high);
        for (j, i) in (0..high).flat_map(|j| (0..wide).map(move |i| (j, i))) {
            let low = (j * side + i) as u16;
            let (right, left) = (low + 1, low + side as u16);
            triangles.push([low, right, left + 1]);
            triangles.push([low, left + 1, left]);
        }
        Cluster::new(&vertices, triangles, 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mesh_is_the_surface_that_height_tells() {
        let mut grid = HeightGrid::flat(4.0, 0.1);
        grid.add(|x, y| 0.3 * x * y - 0.1 * x);
        let mesh = grid.mesh("silt");
        assert_eq!(mesh.triangle_count, 2 * 40 * 40);
        assert_eq!(mesh.clusters.len(), 9);
        let mut area = 0.0;
        for [a, b, c] in mesh.triangles() {
            let (normal, middle) = ((b - a).cross(c - a), (a + b + c) / 3.0);
            assert!(normal.z > 0.0);
            area += 0.5 * normal.z;
            assert!((grid.height(middle.x.into(), middle.y.into()) - f64::from(middle.z)).abs() < 1e-6);
        }
        assert!((area - 16.0).abs() < 1e-3, "{area}");
        assert_eq!(grid.height(50.0, 0.0), grid.height(2.0, 0.0));
    }
}
