//! The cells of a ping while they are filled: energy, whose it is, and what else is asked for.

use super::beams::Split;
use super::echoes::{Detail, Rays};
use super::{BodyEcho, Echoes, Grid, Keep};

/// What adds up in the cells.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    grid: Grid,
    near: f32,
    per_m: f32,
    energy: Vec<f32>,
    /// Solid angle that ends just behind each cell; summed up from the far end, it becomes the open water.
    water: Vec<f32>,
    /// Contributions of bodies in the order they came; a cell may appear several times.
    bodies: Vec<BodyEcho>,
    detail: Option<DetailSums>,
    rays: Option<Rays>,
}

/// A piece of surface as the cells see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// Who hears it.
    pub split: Split,
    /// Energy of all of it.
    pub energy: f32,
    /// Slant ranges of its ends, in any order.
    pub ranges: [f32; 2],
    /// Body number, 0 for background.
    pub body: u16,
    /// Index into the scene's materials.
    pub material: u16,
    /// Cosine of the angle of incidence.
    pub cosine: f32,
    /// Tangent of the elevation.
    pub t: f32,
}

/// Sums that become [`Detail`].
#[derive(Clone, Debug)]
struct DetailSums {
    elevation: Vec<f32>,
    incidence: Vec<f32>,
    material: Vec<u16>,
    strongest: Vec<f32>,
}

impl Cells {
    pub fn new(grid: Grid, keep: Keep) -> Self {
        let zeros = || vec![0.0; grid.len()];
        let detail = keep.detail.then(|| DetailSums {
            elevation: zeros(),
            incidence: zeros(),
            material: vec![0; grid.len()],
            strongest: zeros(),
        });
        Self {
            grid,
            near: grid.near_m as f32,
            per_m: (1.0 / grid.bin_m()) as f32,
            energy: zeros(),
            water: zeros(),
            bodies: Vec::new(),
            detail,
            rays: keep.rays.then(|| Rays { count: zeros(), cosine: zeros() }),
        }
    }

    /// Adds a patch, its energy spread evenly over the range bins that it spans.
    pub fn add(&mut self, patch: &Patch) {
        let bin = |range: f32| (range - self.near) * self.per_m;
        let (low, high) = (bin(patch.ranges[0].min(patch.ranges[1])), bin(patch.ranges[0].max(patch.ranges[1])));
        if !(patch.energy > 0.0 && high > 0.0 && low < self.grid.bins as f32) {
            return;
        }
        let (from, to) = (low.max(0.0) as u32, (high.max(0.0) as u32).min(self.grid.bins - 1));
        for (beam, share) in self.heard_by(patch.split) {
            let (row, energy) = (beam * self.grid.bins, patch.energy * share);
            if low >= 0.0 && high as u32 == low as u32 {
                self.add_to_cell(row + from, energy, patch);
                continue;
            }
            let per_bin = energy / (high - low);
            for bin in from..=to {
                let overlap = (high.min(bin as f32 + 1.0) - low.max(bin as f32)).max(0.0);
                self.add_to_cell(row + bin, per_bin * overlap, patch);
            }
        }
    }

    /// Adds the solid angle of a ray: water is open as far as `range`, or all the way where nothing is met.
    pub fn add_water(&mut self, split: Split, solid_angle: f32, range: Option<f32>) {
        let open = range.map_or(self.grid.bins as f32, |range| (range - self.near) * self.per_m);
        // Up to the last bin that is open from end to end.
        let Some(last) = (open.min(self.grid.bins as f32) as u32).checked_sub(1) else { return };
        for (beam, share) in self.heard_by(split) {
            self.water[(beam * self.grid.bins + last) as usize] += solid_angle * share;
        }
    }

    /// Counts a ray that met a surface, where rays are asked for.
    pub fn add_ray(&mut self, split: Split, range: f32, cosine: f32) {
        let bin = (range - self.near) * self.per_m;
        if !(0.0..self.grid.bins as f32).contains(&bin) {
            return;
        }
        for (beam, share) in self.heard_by(split) {
            if let Some(rays) = &mut self.rays {
                let cell = (beam * self.grid.bins + bin as u32) as usize;
                rays.count[cell] += share;
                rays.cosine[cell] += share * cosine;
            }
        }
    }

    /// The finished echoes.
    pub fn echoes(mut self) -> Echoes {
        for beam in self.water.chunks_exact_mut(self.grid.bins as usize) {
            let mut open = 0.0;
            beam.iter_mut().rev().for_each(|solid_angle| {
                open += *solid_angle;
                *solid_angle = open;
            });
        }
        let detail = self.detail.map(|sums| sums.means(&self.energy));
        let bodies = merged(self.bodies);
        Echoes { grid: self.grid, energy: self.energy, water: self.water, bodies, detail, rays: self.rays }
    }

    /// The beams of the grid that hear a sample, with their shares.
    #[inline]
    fn heard_by(&self, split: Split) -> impl Iterator<Item = (u32, f32)> + use<> {
        let beams = self.grid.beams as i32;
        [(split.first, split.share), (split.first + 1, 1.0 - split.share)]
            .into_iter()
            .filter(move |&(beam, share)| share > 0.0 && (0..beams).contains(&beam))
            .map(|(beam, share)| (beam as u32, share))
    }

    #[inline]
    fn add_to_cell(&mut self, cell: u32, energy: f32, patch: &Patch) {
        self.energy[cell as usize] += energy;
        if patch.body != 0 && energy > 0.0 {
            // Samples of one facing surface fall into one cell again and again: the latest entries are worth a look.
            let recent = self.bodies.len().saturating_sub(4);
            match self.bodies[recent..].iter_mut().rfind(|echo| echo.cell == cell && echo.body == patch.body) {
                Some(echo) => echo.energy += energy,
                None => self.bodies.push(BodyEcho { cell, body: patch.body, energy }),
            }
        }
        if let Some(sums) = &mut self.detail {
            sums.add(cell as usize, energy, patch);
        }
    }
}

/// Sorts by cell and body and adds up what belongs together. The sort is stable, so sums keep their order.
fn merged(mut echoes: Vec<BodyEcho>) -> Vec<BodyEcho> {
    echoes.sort_by_key(|echo| (echo.cell, echo.body));
    echoes.dedup_by(|later, kept| {
        let same = (later.cell, later.body) == (kept.cell, kept.body);
        if same {
            kept.energy += later.energy;
        }
        same
    });
    echoes
}

impl DetailSums {
    fn add(&mut self, cell: usize, energy: f32, patch: &Patch) {
        self.elevation[cell] += energy * patch.t;
        self.incidence[cell] += energy * patch.cosine;
        if energy > self.strongest[cell] {
            self.strongest[cell] = energy;
            self.material[cell] = patch.material + 1;
        }
    }

    /// The means: sums divided by each cell's energy, as angles.
    fn means(self, energy: &[f32]) -> Detail {
        use crate::math::real::{acos, atan2};
        let mean = |sums: Vec<f32>, angle: fn(f64) -> f64| -> Vec<f32> {
            let cells = sums.into_iter().zip(energy);
            cells.map(|(sum, &e)| if e > 0.0 { angle(f64::from(sum / e)) as f32 } else { 0.0 }).collect()
        };
        Detail {
            elevation_rad: mean(self.elevation, |t| atan2(t, 1.0)),
            incidence_rad: mean(self.incidence, |c| acos(c.clamp(-1.0, 1.0))),
            material: self.material,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { beams: 2, bins: 10, azimuth_deg: 10.0, near_m: 1.0, far_m: 2.0 };
    const PATCH: Patch = Patch {
        split: Split { first: 0, share: 0.75 },
        energy: 8.0,
        ranges: [1.55, 1.25],
        body: 3,
        material: 0,
        cosine: 1.0,
        t: 0.0,
    };

    #[test]
    fn a_patch_fills_the_bins_that_it_spans_and_keeps_its_energy() {
        let mut cells = Cells::new(GRID, Keep::ENERGY);
        cells.add(&PATCH);
        let echoes = cells.echoes();
        let close = |cell: usize, energy: f32| {
            assert!((echoes.energy[cell] - energy).abs() < 1e-4, "cell {cell}: {}", echoes.energy[cell]);
        };
        for (bin, energy) in [(1, 0.0), (2, 1.0), (3, 2.0), (4, 2.0), (5, 1.0), (6, 0.0)] {
            close(bin, energy);
        }
        close(13, 2.0 / 3.0);
        assert!((echoes.energy.iter().sum::<f32>() - 8.0).abs() < 1e-4);
        assert_eq!(echoes.bodies.len(), 8);
    }

    #[test]
    fn water_is_open_as_far_as_the_surface() {
        let mut cells = Cells::new(GRID, Keep::ENERGY);
        let split = Split { first: 1, share: 1.0 };
        cells.add_water(split, 0.5, Some(1.45));
        cells.add_water(split, 0.25, None);
        let echoes = cells.echoes();
        assert_eq!(echoes.water[10..15], [0.75, 0.75, 0.75, 0.75, 0.25]);
        assert_eq!(echoes.water[19], 0.25);
        assert!(echoes.water[..10].iter().all(|&open| open == 0.0));
    }
}
