//! From visible segments to energy in cells.
//!
//! Each sample stands for the surface around it, up to where the next one takes over; that piece of a segment is spread
//! over every range bin that it spans, so the image has no holes at grazing incidence. Where the surface changes between
//! two samples, the segments' own ends say where: silhouettes and shadow edges are finer than the samples.

use super::beams::{Beams, Split};
use super::echoes::Detail;
use super::visibility::{Planes, Segment};
use super::{BodyEcho, Grid};

/// How a segment's surface scatters and whose it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Body number, 0 for background.
    pub body: u16,
    /// Index into the scene's materials.
    pub material: u16,
    /// Lambert coefficient.
    pub mu: f32,
}

/// Cells being filled.
#[derive(Clone, Debug)]
pub struct Cells {
    grid: Grid,
    near: f32,
    per_m: f32,
    /// Energy of each cell.
    pub energy: Vec<f32>,
    /// Contributions of bodies in the order they came; a cell may appear several times.
    pub bodies: Vec<BodyEcho>,
    /// Energy-weighted sums, where asked for.
    pub detail: Option<DetailSums>,
}

/// Sums that become [`Detail`].
#[derive(Clone, Debug)]
pub struct DetailSums {
    elevation: Vec<f32>,
    incidence: Vec<f32>,
    material: Vec<u16>,
    strongest: Vec<f32>,
}

/// A piece of a segment between two tangents.
#[derive(Clone, Copy)]
struct Piece {
    low: f32,
    high: f32,
}

/// Where one sample's piece ends and the next one's begins.
#[derive(Clone, Copy)]
struct Border {
    /// Upper end of the lower sample's piece.
    end: f32,
    /// Lower end of the upper sample's piece.
    start: f32,
}

impl Cells {
    /// Empty cells.
    #[must_use]
    pub fn new(grid: Grid, with_detail: bool) -> Self {
        let cells = grid.len();
        let detail = with_detail.then(|| DetailSums {
            elevation: vec![0.0; cells],
            incidence: vec![0.0; cells],
            material: vec![0; cells],
            strongest: vec![0.0; cells],
        });
        Self {
            grid,
            near: grid.near_m as f32,
            per_m: (1.0 / grid.bin_m()) as f32,
            energy: vec![0.0; cells],
            bodies: Vec::new(),
            detail,
        }
    }

    /// Adds the energy of one beam plane. `nearest` and `segment` are the plane's depth buffer.
    pub fn add_plane(&mut self, plane: &PlaneView, surface_of: impl Fn(&Segment) -> Surface) {
        let samples = plane.nearest.len();
        let at = |j: usize| (plane.nearest[j] > 0.0).then(|| &plane.segments[plane.segment[j] as usize]);
        let mut here = at(0);
        let mut low = here.map_or(0.0, |s| s.t0.max(plane.planes.t_low));
        for j in 0..samples {
            let next = if j + 1 < samples { at(j + 1) } else { None };
            let Some(segment) = here else {
                low = next.map_or(0.0, |s| s.t0.max(plane.planes.t[j]));
                here = next;
                continue;
            };
            let border = match next {
                None => {
                    let edge = if j + 1 < samples { plane.planes.t[j + 1] } else { plane.planes.t_high };
                    Border { end: segment.t1.min(edge), start: 0.0 }
                }
                Some(next) => border(plane.planes, j, segment, next),
            };
            let sample = Sample { plane, j, surface: surface_of(segment) };
            self.add_piece(&sample, segment, Piece { low, high: border.end });
            if let Some(next) = next
                && border.start > border.end
            {
                self.add_gap(&sample, segment, next, border);
            }
            low = border.start;
            here = next;
        }
    }

    /// Spreads a piece of a segment over the range bins that it spans.
    fn add_piece(&mut self, sample: &Sample, segment: &Segment, piece: Piece) {
        let span = piece.high - piece.low;
        if span <= 0.0 {
            return;
        }
        let middle = 0.5 * (piece.low + piece.high);
        let w = segment.inverse_rho(middle);
        let facing = (segment.normal_rho + segment.normal_z * middle).abs();
        let energy = sample.plane.beams.weight[sample.j] * sample.surface.mu * facing * w * w * span;
        let range = |t: f32| (1.0 + t * t).sqrt() / segment.inverse_rho(t);
        self.spread(sample, energy, facing, [range(piece.low), range(piece.high)]);
    }

    /// Fills what lies between the ends of two segments of one surface whose pieces in between fell through the samples.
    fn add_gap(&mut self, sample: &Sample, below: &Segment, above: &Segment, border: Border) {
        let middle = 0.5 * (border.end + border.start);
        let (w0, w1) = (below.inverse_rho(border.end), above.inverse_rho(border.start));
        let w = 0.5 * (w0 + w1);
        let facing = 0.5
            * ((below.normal_rho + below.normal_z * middle).abs() + (above.normal_rho + above.normal_z * middle).abs());
        let span = border.start - border.end;
        let energy = sample.plane.beams.weight[sample.j] * sample.surface.mu * facing * w * w * span;
        let slant = (1.0 + middle * middle).sqrt();
        self.spread(sample, energy, facing, [slant / w0, slant / w1]);
    }

    /// Adds `energy` evenly between two ranges, to the beams that hear the sample.
    fn spread(&mut self, sample: &Sample, energy: f32, facing: f32, ranges: [f32; 2]) {
        let Split { first, share } = sample.plane.beams.split(sample.plane.number, sample.j);
        let bin = |range: f32| (range - self.near) * self.per_m;
        let (low, high) = (bin(ranges[0].min(ranges[1])), bin(ranges[0].max(ranges[1])));
        let bins = self.grid.bins as f32;
        if !(energy > 0.0 && high > 0.0 && low < bins) {
            return;
        }
        let (from, to) = (low.max(0.0) as u32, (high.max(0.0) as u32).min(self.grid.bins - 1));
        let incidence = sample.incidence(facing);
        for (beam, energy) in [(first, energy * share), (first + 1, energy * (1.0 - share))] {
            if energy <= 0.0 || beam < 0 || beam >= self.grid.beams as i32 {
                continue;
            }
            let cell = beam as u32 * self.grid.bins;
            if high as u32 == low as u32 && low >= 0.0 {
                self.add(cell + from, energy, sample, incidence);
                continue;
            }
            let per_bin = energy / (high - low);
            for bin in from..=to {
                let overlap = (high.min(bin as f32 + 1.0) - low.max(bin as f32)).max(0.0);
                self.add(cell + bin, per_bin * overlap, sample, incidence);
            }
        }
    }

    #[inline]
    fn add(&mut self, cell: u32, energy: f32, sample: &Sample, incidence: f32) {
        let Surface { body, material, .. } = sample.surface;
        self.energy[cell as usize] += energy;
        if body != 0 && energy > 0.0 {
            // Samples of one facing surface fall into one cell again and again: the latest entries are worth a look.
            let recent = self.bodies.len().saturating_sub(4);
            match self.bodies[recent..].iter_mut().rfind(|echo| echo.cell == cell && echo.body == body) {
                Some(echo) => echo.energy += energy,
                None => self.bodies.push(BodyEcho { cell, body, energy }),
            }
        }
        if let Some(sums) = &mut self.detail {
            sums.add(cell as usize, energy, sample.plane.planes.t[sample.j], incidence, material);
        }
    }
}

/// A beam plane with its part of the depth buffer.
#[derive(Clone, Copy, Debug)]
pub struct PlaneView<'a> {
    /// Number of the plane.
    pub number: usize,
    /// Geometry of all planes.
    pub planes: &'a Planes,
    /// Tables over all samples.
    pub beams: &'a Beams,
    /// 1/ρ at each sample of this plane.
    pub nearest: &'a [f32],
    /// Segment at each sample of this plane.
    pub segment: &'a [u32],
    /// All segments of the ping.
    pub segments: &'a [Segment],
}

struct Sample<'a> {
    plane: &'a PlaneView<'a>,
    j: usize,
    surface: Surface,
}

impl Sample<'_> {
    /// Angle of incidence from `|n · (1, t)|`, radians.
    fn incidence(&self, facing: f32) -> f32 {
        let t = self.plane.planes.t[self.j];
        facing / (1.0 + t * t).sqrt()
    }
}

/// Finds where, between samples j and j + 1, the surface of the one gives way to that of the other.
fn border(planes: &Planes, j: usize, below: &Segment, above: &Segment) -> Border {
    let (t0, t1) = (planes.t[j], planes.t[j + 1]);
    let middle = 0.5 * (t0 + t1);
    if std::ptr::eq(below, above) {
        return Border { end: middle, start: middle };
    }
    let end = below.t1.clamp(t0, t1);
    let start = above.t0.clamp(t0, t1);
    if end >= start {
        // Both are there: the nearer one hides the other. Neighbours that share an edge meet exactly.
        let overlap = 0.5 * (end + start);
        let at = if below.inverse_rho(overlap) >= above.inverse_rho(overlap) { end } else { start };
        return Border { end: at, start: at };
    }
    let far_apart = if below.instance == above.instance { !continuous(below, above, end, start) } else { true };
    if far_apart {
        // A silhouette: behind it the farther surface goes on.
        let at = if below.inverse_rho(end) >= above.inverse_rho(start) { end } else { start };
        return Border { end: at, start: at };
    }
    Border { end, start }
}

/// Whether the surface between two segments' ends can be one sheet: the step in range is no more than a few times what
/// the segments' own slopes give.
fn continuous(below: &Segment, above: &Segment, end: f32, start: f32) -> bool {
    let (w0, w1) = (below.inverse_rho(end), above.inverse_rho(start));
    let steepest = below.slope.abs().max(above.slope.abs());
    (w1 - w0).abs() <= 4.0 * steepest * (start - end) + 1e-3 * w0 * w1
}

impl DetailSums {
    fn add(&mut self, cell: usize, energy: f32, t: f32, cos_incidence: f32, material: u16) {
        self.elevation[cell] += energy * t;
        self.incidence[cell] += energy * cos_incidence;
        if energy > self.strongest[cell] {
            self.strongest[cell] = energy;
            self.material[cell] = material + 1;
        }
    }

    /// The means: sums divided by each cell's energy.
    #[must_use]
    pub fn means(self, energy: &[f32]) -> Detail {
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
