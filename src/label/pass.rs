//! One pass over a view's pixels, column by column: run lengths, boxes and the mask of dominant bodies.

use super::slots::{Seen, Slots};
use super::{Annotation, LabelSettings, Rle, ViewLabels};
use crate::sonar::{Echoes, FanMap};

/// Labels of the polar view (pixels as [`Grid::polar_pixel`](crate::sonar::Grid::polar_pixel) lays them).
#[must_use]
pub fn label_polar(echoes: &Echoes, settings: &LabelSettings) -> ViewLabels {
    let grid = &echoes.grid;
    let slots = Slots::new(echoes, settings);
    let mut pass = Pass::new(&slots, grid.beams, grid.bins);
    let mut column_slots = vec![0; grid.bins as usize];
    // Column 0 is the last beam and row 0 the last bin, so the columns are the cells backwards.
    for (column, cells) in slots.of_cell.chunks_exact(grid.bins.max(1) as usize).rev().enumerate() {
        if cells.iter().fold(0, |any, slot| any | slot) != 0 {
            column_slots.iter_mut().zip(cells.iter().rev()).for_each(|(to, &from)| *to = from);
            pass.column(column as u32, &column_slots);
        }
    }
    pass.finish(settings.min_pixels)
}

/// Labels of the fan view that `fan` describes.
#[must_use]
pub fn label_fan(echoes: &Echoes, fan: &FanMap, settings: &LabelSettings) -> ViewLabels {
    /// Columns that are gathered together: one cache line of the table's cell numbers.
    const BLOCK: usize = 16;
    let (width, height) = (fan.width as usize, fan.height as usize);
    let slots = Slots::new(echoes, settings);
    let mut pass = Pass::new(&slots, fan.width, fan.height);
    let mut block = vec![0; BLOCK * height];
    for first in (0..width).step_by(BLOCK) {
        let last = (first + BLOCK).min(width);
        let mut any = 0;
        for (row, cells) in fan.cell.chunks_exact(width).enumerate() {
            for (column, &cell) in cells[first..last].iter().enumerate() {
                // Pixels outside the fan have a cell number beyond the table.
                let slot = slots.of_cell.get(cell as usize).copied().unwrap_or(0);
                block[column * height + row] = slot;
                any |= slot;
            }
        }
        if any != 0 {
            let columns = block.chunks_exact(height).take(last - first);
            columns.enumerate().for_each(|(column, slots)| pass.column((first + column) as u32, slots));
        }
    }
    pass.finish(settings.min_pixels)
}

/// A view in the making.
struct Pass<'a> {
    slots: &'a Slots,
    width: u32,
    height: u32,
    mask: Vec<u16>,
    /// One for each of [`Slots::bodies`].
    outlines: Vec<Outline>,
}

/// What is known of one body so far.
#[derive(Clone)]
struct Outline {
    /// Runs of visible pixels, column-major: (first pixel, length).
    runs: Vec<(u32, u32)>,
    left: u32,
    right: u32,
    top: u32,
    bottom: u32,
}

impl<'a> Pass<'a> {
    fn new(slots: &'a Slots, width: u32, height: u32) -> Self {
        let outline = Outline { runs: Vec::new(), left: u32::MAX, right: 0, top: u32::MAX, bottom: 0 };
        let mask = vec![0; width as usize * height as usize];
        Self { slots, width, height, mask, outlines: vec![outline; slots.bodies.len()] }
    }

    /// Takes the slots of one column's pixels, top to bottom. Columns come left to right; empty ones may be left out.
    fn column(&mut self, column: u32, slots: &[u32]) {
        let mut row = 0;
        for run in slots.chunk_by(|a, b| a == b) {
            let length = run.len() as u32;
            if run[0] != 0 {
                let seen = &self.slots.sets[run[0] as usize];
                self.run(seen, column, row, length);
            }
            row += length;
        }
    }

    fn run(&mut self, seen: &Seen, column: u32, row: u32, length: u32) {
        for &body in &seen.visible {
            self.outlines[body].add(column, row, length, self.height);
        }
        if seen.dominant != 0 {
            let width = self.width as usize;
            let first = row as usize * width + column as usize;
            for pixel in self.mask[first..].iter_mut().step_by(width).take(length as usize) {
                *pixel = seen.dominant;
            }
        }
    }

    fn finish(mut self, min_pixels: u32) -> ViewLabels {
        let pixels = self.width * self.height;
        let mut annotations = Vec::new();
        for (&body, outline) in self.slots.bodies.iter().zip(&self.outlines) {
            let area = outline.runs.iter().map(|run| run.1).sum::<u32>();
            if area >= min_pixels.max(1) {
                let rle = Rle::from_runs(pixels, &outline.runs);
                annotations.push(Annotation { body, bbox: outline.bbox(), area, rle });
            } else {
                erase(&mut self.mask, body, &outline.runs, self.width, self.height);
            }
        }
        ViewLabels { width: self.width, height: self.height, mask: self.mask, annotations }
    }
}

impl Outline {
    fn add(&mut self, column: u32, row: u32, length: u32, height: u32) {
        let start = column * height + row;
        match self.runs.last_mut() {
            Some((first, so_far)) if *first + *so_far == start => *so_far += length,
            _ => self.runs.push((start, length)),
        }
        (self.left, self.right) = (self.left.min(column), self.right.max(column));
        (self.top, self.bottom) = (self.top.min(row), self.bottom.max(row + length - 1));
    }

    fn bbox(&self) -> [u32; 4] {
        [self.left, self.top, self.right - self.left + 1, self.bottom - self.top + 1]
    }
}

/// Takes a dropped body out of the mask: it can only be dominant where it is visible.
fn erase(mask: &mut [u16], body: u16, runs: &[(u32, u32)], width: u32, height: u32) {
    for pixel in runs.iter().flat_map(|&(start, length)| start..start + length) {
        let at = (pixel % height) as usize * width as usize + (pixel / height) as usize;
        if mask[at] == body {
            mask[at] = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Stream;
    use crate::sonar::{BodyEcho, Grid};

    const GRID: Grid = Grid { beams: 37, bins: 50, azimuth_deg: 120.0, near_m: 0.5, far_m: 10.5 };
    const SETTINGS: LabelSettings = LabelSettings { min_pixels: 5, min_share: 0.2 };

    /// Blobs of eight bodies in noise, with layover; body 40 is a single cell, body 900 is never visible.
    fn echoes() -> Echoes {
        let mut stream = Stream::at(3, "test", 0, "labels");
        let mut energy: Vec<f32> = (0..GRID.len()).map(|_| stream.uniform(0.1, 0.4) as f32).collect();
        let mut bodies = Vec::new();
        for (cell, energy) in energy.iter_mut().enumerate() {
            let (beam, bin) = ((cell as u32 / GRID.bins), (cell as u32 % GRID.bins));
            for body in [1u16, 2, 3, 5, 8, 13, 40, 900] {
                let (b, r) = (3 + 5 * u32::from(body % 8), 2 + 6 * u32::from(body % 9));
                let inside = match body {
                    40 => (beam, bin) == (35, 49),
                    _ => beam.abs_diff(b).pow(2) + bin.abs_diff(r).pow(2) < 60,
                };
                if inside {
                    let own = if body == 900 { 1e-6 } else { stream.uniform(0.0, 1.0) as f32 };
                    *energy += own;
                    bodies.push(BodyEcho { cell: cell as u32, body, energy: own });
                }
            }
        }
        Echoes { energy, bodies, ..Echoes::silence(GRID) }
    }

    /// The rules of the module applied to each pixel by itself; `cell_of` names the cell of (column, row).
    fn expected(echoes: &Echoes, size: (u32, u32), cell_of: impl Fn(u32, u32) -> Option<usize>) -> ViewLabels {
        let (width, height) = size;
        let mut labels = ViewLabels { width, height, mask: vec![0; (width * height) as usize], annotations: vec![] };
        let echo = |cell: usize| echoes.bodies.iter().filter(move |e| e.cell as usize == cell);
        for body in 1..=900u16 {
            let sees = |pixel: &u32| {
                cell_of(pixel / height, pixel % height).is_some_and(|cell| {
                    let share = SETTINGS.min_share * f64::from(echoes.energy[cell]);
                    echo(cell).any(|e| e.body == body && f64::from(e.energy) >= share)
                })
            };
            if !echoes.bodies.iter().any(|e| e.body == body) {
                continue;
            }
            let pixels: Vec<u32> = (0..width * height).filter(sees).collect();
            if pixels.len() < SETTINGS.min_pixels as usize {
                continue;
            }
            let mut runs: Vec<(u32, u32)> = vec![];
            for &pixel in &pixels {
                match runs.last_mut() {
                    Some((start, length)) if *start + *length == pixel => *length += 1,
                    _ => runs.push((pixel, 1)),
                }
                let cell = cell_of(pixel / height, pixel % height).unwrap();
                let all: f64 = echo(cell).map(|e| f64::from(e.energy)).sum();
                let own = echo(cell).find(|e| e.body == body).map(|e| f64::from(e.energy)).unwrap();
                let best = echo(cell).all(|e| f64::from(e.energy) <= own);
                if best && own >= f64::from(echoes.energy[cell]) - all {
                    labels.mask[((pixel % height) * width + pixel / height) as usize] = body;
                }
            }
            let columns = || pixels.iter().map(|p| p / height);
            let rows = || pixels.iter().map(|p| p % height);
            let (left, top) = (columns().min().unwrap(), rows().min().unwrap());
            let bbox = [left, top, columns().max().unwrap() - left + 1, rows().max().unwrap() - top + 1];
            let rle = Rle::from_runs(width * height, &runs);
            labels.annotations.push(Annotation { body, bbox, area: pixels.len() as u32, rle });
        }
        labels
    }

    #[test]
    fn the_polar_view_follows_the_rules_pixel_by_pixel() {
        let echoes = echoes();
        let labels = label_polar(&echoes, &SETTINGS);
        let cell_of = |column, row| Some(GRID.cell(GRID.beams - 1 - column, GRID.bins - 1 - row));
        assert_eq!(labels, expected(&echoes, (GRID.beams, GRID.bins), cell_of));
        let seen: Vec<u16> = labels.annotations.iter().map(|a| a.body).collect();
        assert_eq!(seen, [1, 2, 3, 5, 8, 13], "40 is one pixel, 900 is too faint");
        assert!(labels.mask.contains(&13) && !labels.mask.contains(&40));
        let pixels: u32 = labels.annotations.iter().map(|a| a.area).sum();
        assert!(pixels as usize > labels.mask.iter().filter(|&&m| m != 0).count(), "bodies overlap");
    }

    #[test]
    fn the_fan_view_follows_the_rules_pixel_by_pixel() {
        let echoes = echoes();
        let fan = FanMap::new(&GRID, 61);
        let cell_of = |column, row| {
            let cell = fan.cell[(row * fan.width + column) as usize];
            (cell != FanMap::OUTSIDE).then_some(cell as usize)
        };
        assert_eq!(label_fan(&echoes, &fan, &SETTINGS), expected(&echoes, (fan.width, fan.height), cell_of));
    }

    #[test]
    fn a_ping_without_bodies_has_an_empty_mask() {
        let echoes = Echoes { energy: vec![1.0; GRID.len()], ..Echoes::silence(GRID) };
        let labels = label_polar(&echoes, &SETTINGS);
        assert!(labels.annotations.is_empty() && labels.mask.iter().all(|&m| m == 0));
    }
}
