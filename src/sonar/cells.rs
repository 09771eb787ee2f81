//! The cells of a ping while they are filled: energy, whose it is, and what else is asked for.

use super::beams::Split;
use super::echoes::{Detail, RayRange, Rays};
use super::{BodyEcho, Echoes, Grid, Keep};

/// What adds up in the cells.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    grid: Grid,
    axis: Axis,
    energy: Vec<f32>,
    /// Solid angle that ends just behind each cell; summed up from the far end, it becomes the open water.
    water: Vec<f32>,
    /// Energy that came by a mirror, once there is any.
    ghosts: Option<Vec<f32>>,
    /// Contributions of bodies in the order they came; a cell may appear several times.
    bodies: Vec<BodyEcho>,
    detail: Option<DetailSums>,
    rays: Option<(RayRange, Rays)>,
}

/// The cells that something falls into.
#[derive(Clone, Copy, Debug)]
struct Axis {
    beams: i32,
    bins: u32,
    near: f32,
    per_m: f32,
    /// Beams that the array turns past a target at 1 m before its echo is back; grows with range.
    turn_per_m: f32,
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
    /// How many rays it stands for.
    pub rays: f32,
    /// Its material's reflectivity.
    pub reflectivity: f32,
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
    /// Empty cells; the array turns by `turn_per_m` beams to port for each metre of slant range.
    pub fn new(grid: Grid, keep: Keep, turn_per_m: f64) -> Self {
        let zeros = || vec![0.0; grid.len()];
        let detail = keep.detail.then(|| DetailSums {
            elevation: zeros(),
            incidence: zeros(),
            material: vec![0; grid.len()],
            strongest: zeros(),
        });
        Self {
            grid,
            axis: Axis {
                beams: grid.beams as i32,
                bins: grid.bins,
                near: grid.near_m as f32,
                per_m: (1.0 / grid.bin_m()) as f32,
                turn_per_m: turn_per_m as f32,
            },
            energy: zeros(),
            water: zeros(),
            ghosts: None,
            bodies: Vec::new(),
            detail,
            rays: keep.rays.map(|range| (range, Rays::none(grid.len()))),
        }
    }

    /// Adds a patch, its energy spread evenly over the range bins that it spans.
    pub fn add(&mut self, patch: &Patch) {
        let axis = self.axis;
        if patch.energy > 0.0 {
            axis.spread(patch.split, patch.ranges, patch.energy, |cell, energy| self.add_to_cell(cell, energy, patch));
        }
        let Some((range, rays)) = &mut self.rays else { return };
        let ranges = match range {
            RayRange::Slant => patch.ranges,
            RayRange::Horizontal => {
                let cosine = 1.0 / (1.0 + patch.t * patch.t).sqrt();
                patch.ranges.map(|slant| slant * cosine)
            }
        };
        axis.spread(patch.split, ranges, patch.rays, |cell, count| {
            rays.count[cell as usize] += count;
            rays.reflected[cell as usize] += count * patch.reflectivity * patch.cosine;
        });
    }

    /// Adds energy that came by a mirror, spread evenly between two ranges.
    pub fn add_ghost(&mut self, split: Split, energy: f32, ranges: [f32; 2]) {
        let axis = self.axis;
        let ghosts = self.ghosts.get_or_insert_with(|| vec![0.0; axis.beams as usize * axis.bins as usize]);
        axis.spread(split, ranges, energy, |cell, energy| ghosts[cell as usize] += energy);
    }

    /// Adds the solid angle of a ray: water is open as far as `range`, or all the way where nothing is met.
    pub fn add_water(&mut self, split: Split, solid_angle: f32, range: Option<f32>) {
        let open = range.map_or(self.grid.bins as f32, |range| self.axis.bin(range));
        // Up to the last bin that is open from end to end.
        let Some(last) = (open.min(self.grid.bins as f32) as u32).checked_sub(1) else { return };
        let split = split.moved(-self.axis.turn_per_m * range.unwrap_or(self.grid.far_m as f32));
        for (beam, share) in self.axis.heard_by(split) {
            self.water[(beam * self.grid.bins + last) as usize] += solid_angle * share;
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
        let rays = self.rays.map(|(_, rays)| rays);
        Echoes { grid: self.grid, energy: self.energy, water: self.water, ghosts: self.ghosts, bodies, detail, rays }
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

impl Axis {
    /// Spreads an amount evenly over the range bins that it spans and over the beams that hear it.
    #[inline]
    fn spread(self, split: Split, ranges: [f32; 2], amount: f32, mut put: impl FnMut(u32, f32)) {
        let (low, high) = (self.bin(ranges[0].min(ranges[1])), self.bin(ranges[0].max(ranges[1])));
        if !(high > 0.0 && low < self.bins as f32) {
            return;
        }
        let (from, to) = (low.max(0.0) as u32, (high.max(0.0) as u32).min(self.bins - 1));
        let split = split.moved(-self.turn_per_m * 0.5 * (ranges[0] + ranges[1]));
        for (beam, share) in self.heard_by(split) {
            let (row, amount) = (beam * self.bins, amount * share);
            if low >= 0.0 && high as u32 == low as u32 {
                put(row + from, amount);
                continue;
            }
            let per_bin = amount / (high - low);
            for bin in from..=to {
                let overlap = (high.min(bin as f32 + 1.0) - low.max(bin as f32)).max(0.0);
                put(row + bin, per_bin * overlap);
            }
        }
    }

    /// A range in bins from the nearest edge.
    #[inline]
    fn bin(self, range: f32) -> f32 {
        (range - self.near) * self.per_m
    }

    /// The beams of the grid that hear a sample, with their shares.
    #[inline]
    fn heard_by(self, split: Split) -> impl Iterator<Item = (u32, f32)> {
        [(split.first, split.share), (split.first + 1, 1.0 - split.share)]
            .into_iter()
            .filter(move |&(beam, share)| share > 0.0 && (0..self.beams).contains(&beam))
            .map(|(beam, share)| (beam as u32, share))
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
        cosine: 0.5,
        t: 0.75,
        rays: 4.0,
        reflectivity: 0.5,
    };

    #[test]
    fn a_patch_fills_the_bins_that_it_spans_and_keeps_its_energy() {
        let mut cells = Cells::new(GRID, Keep::ENERGY, 0.0);
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
    fn rays_are_counted_by_the_range_asked_for() {
        let rays = |range| {
            let mut cells = Cells::new(GRID, Keep { rays: Some(range), ..Keep::ENERGY }, 0.0);
            cells.add(&PATCH);
            cells.echoes().rays.unwrap()
        };
        let slant = rays(RayRange::Slant);
        assert!((slant.count.iter().sum::<f32>() - 4.0).abs() < 1e-5);
        assert!((slant.count[3] - 1.0).abs() < 1e-5 && slant.count[6] == 0.0);
        assert!((slant.mean()[3] - 0.25).abs() < 1e-6 && slant.mean()[6] == 0.0);
        // cos ε = 0.8: 1.25–1.55 m along the ray are 1.0–1.24 m ahead.
        let horizontal = rays(RayRange::Horizontal);
        assert!((horizontal.count[0] - 1.25).abs() < 1e-4 && horizontal.count[3] == 0.0);
    }

    #[test]
    fn water_is_open_as_far_as_the_surface() {
        let mut cells = Cells::new(GRID, Keep::ENERGY, 0.0);
        let split = Split { first: 1, share: 1.0 };
        cells.add_water(split, 0.5, Some(1.45));
        cells.add_water(split, 0.25, None);
        let echoes = cells.echoes();
        assert_eq!(echoes.water[10..15], [0.75, 0.75, 0.75, 0.75, 0.25]);
        assert_eq!(echoes.water[19], 0.25);
        assert!(echoes.water[..10].iter().all(|&open| open == 0.0));
    }
}
