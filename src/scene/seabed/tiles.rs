//! The mesh of a height grid: tiles of 16 × 16 cells, coarser far from the middle, without gaps between them.
//!
//! A tile of level k has cells 2^k times as large. Where it meets a finer tile its edge takes that one's vertices, and all
//! vertices are points of the grid: surfaces that share an edge share its bits.

use glam::Vec3;

use super::HeightGrid;
use crate::math::real::ln;
use crate::scene::mesh::{Cluster, Mesh};

/// Cells along the side of a tile: 2 · 16² triangles are one full cluster.
const TILE: usize = 16;
/// Most doublings: a tile of two triangles.
const COARSEST: u8 = 4;

impl HeightGrid {
    /// The surface as a mesh; its material slots are [`HeightGrid::sediments`].
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let tiles = self.tiles();
        let all = (0..tiles).flat_map(|row| (0..tiles).map(move |column| [column, row]));
        let clusters = all.flat_map(|tile| Tile::new(self, tile).clusters());
        Mesh::from_clusters(clusters.collect(), self.sediments.clone())
    }

    /// Makes cells coarser beyond the middle square of side `fine` metres: twice as large from its border on, again at
    /// twice the distance from the middle and so on. Heights become those of the coarser surface.
    pub(super) fn coarsen(&mut self, fine: f64) {
        let tiles = self.tiles();
        let level = |column: usize, row: usize| {
            let [from_x, from_y] = [column, row].map(|tile| {
                let [low, high] = self.tile_lines(tile).map(|line| self.place(line));
                low.max(-high).max(0.0)
            });
            let beyond = from_x.max(from_y) / (0.5 * fine);
            if beyond < 1.0 {
                return 0;
            }
            let wanted = (1.0 + ln(beyond) / std::f64::consts::LN_2).floor().min(COARSEST.into()) as u8;
            // Cells at the far edges may not be a whole number of coarse ones.
            let fits = |level: &u8| {
                [column, row].iter().all(|&tile| {
                    let [low, high] = self.tile_lines(tile);
                    (high - low) % (1 << level) == 0
                })
            };
            (0..=wanted).rev().find(fits).unwrap_or(0)
        };
        self.levels = (0..tiles * tiles).map(|tile| level(tile % tiles, tile / tiles)).collect();
        // The coarsest first: an edge between two tiles is the coarser one's.
        for level in (1..=COARSEST).rev() {
            for tile in (0..tiles * tiles).filter(|&tile| self.levels[tile] == level).collect::<Vec<_>>() {
                self.flatten([tile % tiles, tile / tiles], 1 << level);
            }
        }
    }

    /// Puts the vertices that a tile's coarse cells leave out onto those cells' triangles.
    fn flatten(&mut self, [column, row]: [usize; 2], step: usize) {
        let ([west, east], [south, north]) = (self.tile_lines(column), self.tile_lines(row));
        let side = self.cells + 1;
        for (j, i) in (south..=north).flat_map(|j| (west..=east).map(move |i| (j, i))) {
            let (left, low) = (west + (i - west) / step * step, south + (j - south) / step * step);
            let (right, high) = ((left + step).min(east), (low + step).min(north));
            let at = |i: usize, j: usize| f64::from(self.heights[j * side + i]);
            let (s, t) = ((i - left) as f64 / step as f64, (j - low) as f64 / step as f64);
            let corner = at(left, low);
            let height = if s >= t {
                corner + s * (at(right, low) - corner) + t * (at(right, high) - at(right, low))
            } else {
                corner + t * (at(left, high) - corner) + s * (at(right, high) - at(left, high))
            };
            if s > 0.0 || t > 0.0 {
                self.heights[j * side + i] = height as f32;
            }
        }
    }

    /// Tiles along a side.
    fn tiles(&self) -> usize {
        self.cells.div_ceil(TILE)
    }

    /// First and last grid line of a row or column of tiles.
    fn tile_lines(&self, tile: usize) -> [usize; 2] {
        [tile * TILE, ((tile + 1) * TILE).min(self.cells)]
    }

    /// Cells of the grid along a cell of a tile; none beyond the square.
    fn step(&self, column: Option<usize>, row: Option<usize>) -> Option<usize> {
        let tiles = self.tiles();
        let (column, row) = (column.filter(|&tile| tile < tiles)?, row.filter(|&tile| tile < tiles)?);
        Some(1 << self.levels.get(row * tiles + column).copied().unwrap_or(0))
    }
}

/// A tile on its way to clusters, one a sediment.
struct Tile<'a> {
    grid: &'a HeightGrid,
    /// Grid lines of its borders.
    west: usize,
    east: usize,
    south: usize,
    north: usize,
    /// Cells of the grid along one of its own.
    step: usize,
    /// Between vertices on its west, east, south and north border.
    border: [usize; 4],
}

/// A point of the grid: column and row of its lines.
type Point = [usize; 2];

impl<'a> Tile<'a> {
    fn new(grid: &'a HeightGrid, [column, row]: [usize; 2]) -> Self {
        let ([west, east], [south, north]) = (grid.tile_lines(column), grid.tile_lines(row));
        let step = grid.step(Some(column), Some(row)).unwrap_or(1);
        let neighbours = [
            (column.checked_sub(1), Some(row)),
            (Some(column + 1), Some(row)),
            (Some(column), row.checked_sub(1)),
            (Some(column), Some(row + 1)),
        ];
        let border = neighbours.map(|(column, row)| grid.step(column, row).map_or(step, |there| there.min(step)));
        Self { grid, west, east, south, north, step, border }
    }

    fn clusters(&self) -> Vec<Cluster> {
        let mut of_sediment = vec![Vec::new(); self.grid.sediments.len()];
        for low in (self.south..self.north).step_by(self.step) {
            for left in (self.west..self.east).step_by(self.step) {
                let middle = (low + self.step / 2) * self.grid.cells + left + self.step / 2;
                let sediment = self.grid.cover.get(middle).copied().unwrap_or(0);
                self.cell([left, low], &mut of_sediment[usize::from(sediment)]);
            }
        }
        let filled = of_sediment.into_iter().enumerate().filter(|(_, triangles)| !triangles.is_empty());
        filled.map(|(sediment, triangles)| self.cluster(&triangles, sediment as u16)).collect()
    }

    /// Two triangles, more where its edges have more vertices.
    fn cell(&self, [left, low]: Point, out: &mut Vec<[Point; 3]>) {
        let (right, high) = (left + self.step, low + self.step);
        let edge = |on: bool, border: usize| if on { self.border[border] } else { self.step };
        let along_x =
            |y: usize, step: usize| (left + step..right).step_by(step).map(move |x| [x, y]).collect::<Vec<_>>();
        let along_y = |x: usize, step: usize| (low + step..high).step_by(step).map(move |y| [x, y]).collect::<Vec<_>>();
        let back = |points: Vec<Point>| points.into_iter().rev().collect::<Vec<_>>();
        let bottom = along_x(low, edge(low == self.south, 2));
        let side = along_y(right, edge(right == self.east, 1));
        split([[left, low], [right, low], [right, high]], &bottom, &side, out);
        let top = back(along_x(high, edge(high == self.north, 3)));
        let side = back(along_y(left, edge(left == self.west, 0)));
        split([[right, high], [left, high], [left, low]], &top, &side, out);
    }

    fn cluster(&self, triangles: &[[Point; 3]], sediment: u16) -> Cluster {
        let side = self.east - self.west + 1;
        let mut numbers = vec![u16::MAX; side * (self.north - self.south + 1)];
        triangles.iter().flatten().for_each(|&[i, j]| numbers[(j - self.south) * side + i - self.west] = 0);
        // Vertices in the order of the grid, whatever the order of triangles.
        let mut vertices = Vec::new();
        for (place, number) in numbers.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
            *number = vertices.len() as u16;
            vertices.push(self.vertex([self.west + place % side, self.south + place / side]));
        }
        let number = |[i, j]: Point| numbers[(j - self.south) * side + i - self.west];
        Cluster::new(&vertices, triangles.iter().map(|corners| corners.map(number)).collect(), sediment)
    }

    fn vertex(&self, [i, j]: Point) -> Vec3 {
        let height = self.grid.heights[j * (self.grid.cells + 1) + i];
        Vec3::new(self.grid.place(i) as f32, self.grid.place(j) as f32, height)
    }
}

/// A triangle whose first and second edge may have vertices between their ends.
fn split([a, b, c]: [Point; 3], first: &[Point], second: &[Point], out: &mut Vec<[Point; 3]>) {
    let fan = |apex: Point, line: &[Point], out: &mut Vec<[Point; 3]>| {
        out.extend(line.windows(2).map(|pair| [apex, pair[0], pair[1]]));
    };
    let line = |from: Point, between: &[Point], to: Point| [&[from], between, &[to]].concat();
    match second {
        [] => fan(c, &line(a, first, b), out),
        // The first vertex beyond the corner sees all of the first edge, the first corner what is left of the second.
        [next, rest @ ..] => {
            fan(*next, &line(a, first, b), out);
            fan(a, &line(*next, rest, c), out);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn hills(extent: f64, cell: f64) -> HeightGrid {
        let mut grid = HeightGrid::flat(extent, cell);
        grid.add(|x, y| 0.3 * crate::math::real::sin(0.7 * x + 0.2 * y) + 0.004 * x * y);
        grid
    }

    /// How often each edge is run along, by the bits of its ends.
    fn edges(mesh: &Mesh) -> BTreeMap<[[u32; 3]; 2], i32> {
        let mut edges = BTreeMap::new();
        for corners in mesh.triangles() {
            let bits = corners.map(|v| (v + Vec3::ZERO).to_array().map(f32::to_bits));
            for (a, b) in [(bits[0], bits[1]), (bits[1], bits[2]), (bits[2], bits[0])] {
                assert_eq!(edges.insert([a, b], 1), None, "an edge is run along twice in one direction");
            }
        }
        edges
    }

    #[test]
    fn the_mesh_is_the_surface_that_height_tells() {
        for fine in [None, Some(1.0)] {
            let mut grid = HeightGrid::flat(9.6, 0.1);
            grid.add(|x, y| 0.3 * x * y - 0.1 * x);
            fine.iter().for_each(|&fine| grid.coarsen(fine));
            let mesh = grid.mesh();
            let mut area = 0.0;
            for [a, b, c] in mesh.triangles() {
                let (normal, middle) = ((b - a).cross(c - a), (a + b + c) / 3.0);
                assert!(normal.z > 0.0);
                area += 0.5 * f64::from(normal.z);
                let height = grid.height(middle.x.into(), middle.y.into());
                assert!((height - f64::from(middle.z)).abs() < 1e-5, "{height} {}", middle.z);
            }
            assert!((area - 92.16).abs() < 1e-2, "{area}");
            assert_eq!(grid.height(50.0, 0.0), grid.height(4.8, 0.0));
            match fine {
                None => assert_eq!((mesh.triangle_count, mesh.clusters.len()), (2 * 96 * 96, 36)),
                Some(_) => assert!(mesh.triangle_count < 96 * 96, "{}", mesh.triangle_count),
            }
        }
    }

    #[test]
    fn tiles_of_any_level_and_sediment_share_the_bits_of_their_edges() {
        for (extent, fine) in [(20.0, None), (20.0, Some(2.0)), (21.3, Some(3.0)), (7.0, Some(0.5))] {
            let mut grid = hills(extent, 0.1);
            grid.paint("mud", |x, y| x * y > 1.0);
            fine.iter().for_each(|&fine| grid.coarsen(fine));
            let edges = edges(&grid.mesh());
            let half = (0.5 * extent) as f32;
            let on_border = |v: &[u32; 3], w: &[u32; 3]| {
                (0..2).any(|axis| v[axis] == w[axis] && f32::from_bits(v[axis]).abs() == half)
            };
            let open = edges.keys().filter(|[a, b]| !edges.contains_key(&[*b, *a]) && !on_border(a, b)).count();
            assert_eq!(open, 0, "{extent} m, fine {fine:?}: {open} open edges of {}", edges.len());
        }
    }
}
