//! From visible segments to energy in cells.
//!
//! Each sample stands for the surface around it, up to where the next one takes over; that piece of a segment is spread
//! over every range bin that it spans, so the image has no holes at grazing incidence. Where the surface changes between
//! two samples, the segments' own ends say where: silhouettes and shadow edges are finer than the samples.

use glam::DMat3;

use super::beams::Beams;
use super::cells::{Cells, Patch};
use super::surface::Surfaces;
use super::visibility::{DepthBuffer, Planes, Segment};
use crate::math::Pose;
use crate::scene::Scene;

/// A scanned ping: what is visible where, and how it sends sound back.
pub(super) struct Ping<'a> {
    pub planes: &'a Planes,
    pub beams: &'a Beams,
    pub depth: &'a DepthBuffer,
    pub scene: &'a Scene,
    pub surfaces: &'a Surfaces,
    pub world_from_sonar: &'a Pose,
}

/// One beam plane of a ping.
struct Plane<'a> {
    ping: &'a Ping<'a>,
    number: usize,
    nearest: &'a [f32],
    segment: &'a [u32],
    /// Ground track of the plane in the world: where (ρ, ρ·t) = (1, t) leads.
    ahead: [f32; 2],
    up: [f32; 2],
}

/// A piece of a segment between two tangents, belonging to one sample.
#[derive(Clone, Copy)]
struct Piece {
    sample: usize,
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

impl Ping<'_> {
    /// Adds the energy of every beam plane to the cells.
    pub fn deposit(&self, cells: &mut Cells) {
        let samples = self.planes.samples();
        let turn: &DMat3 = &self.world_from_sonar.rotation;
        for number in 0..self.planes.count() {
            let row = number * samples..(number + 1) * samples;
            let (cos, sin) = (f64::from(self.planes.cos[number]), f64::from(self.planes.sin[number]));
            let ahead = turn.x_axis * cos + turn.y_axis * sin;
            let plane = Plane {
                ping: self,
                number,
                nearest: &self.depth.nearest[row.clone()],
                segment: &self.depth.segment[row],
                ahead: [ahead.x as f32, ahead.y as f32],
                up: [turn.z_axis.x as f32, turn.z_axis.y as f32],
            };
            plane.deposit(cells);
        }
    }
}

impl Plane<'_> {
    /// The segment that a sample sees.
    fn seen(&self, sample: usize) -> Option<&Segment> {
        (*self.nearest.get(sample)? > 0.0).then(|| &self.ping.depth.segments[self.segment[sample] as usize])
    }

    fn deposit(&self, cells: &mut Cells) {
        let planes = self.ping.planes;
        let mut here = self.seen(0);
        let mut low = here.map_or(0.0, |segment| segment.t0.max(planes.t_low));
        for sample in 0..self.nearest.len() {
            let next = self.seen(sample + 1);
            self.deposit_water(cells, sample, here);
            let Some(segment) = here else {
                low = next.map_or(0.0, |segment| segment.t0.max(planes.t[sample]));
                here = next;
                continue;
            };
            let Some(next) = next else {
                let edge = planes.t.get(sample + 1).copied().unwrap_or(planes.t_high);
                self.deposit_piece(cells, segment, Piece { sample, low, high: segment.t1.min(edge) });
                here = None;
                continue;
            };
            let border = border(planes, sample, segment, next);
            self.deposit_piece(cells, segment, Piece { sample, low, high: border.end });
            if border.start > border.end {
                self.deposit_gap(cells, [segment, next], Piece { sample, low: border.end, high: border.start });
            }
            low = border.start;
            here = Some(next);
        }
    }

    /// Open water up to what a sample sees.
    fn deposit_water(&self, cells: &mut Cells, sample: usize, seen: Option<&Segment>) {
        let Ping { beams, .. } = self.ping;
        let split = beams.split(self.number, sample);
        let range = seen.map(|_| beams.secant[sample][0] / self.nearest[sample]);
        cells.add_water(split, beams.solid_angle[sample], range);
    }

    fn deposit_piece(&self, cells: &mut Cells, segment: &Segment, piece: Piece) {
        let middle = 0.5 * (piece.low + piece.high);
        let ([secant, slope], t) = (self.ping.beams.secant[piece.sample], self.ping.planes.t[piece.sample]);
        let range = |at: f32| (secant + slope * (at - t)) / segment.inverse_rho(at);
        let w = segment.inverse_rho(middle);
        let patch = Stretch { w, facing: segment.facing(middle), ranges: [range(piece.low), range(piece.high)] };
        self.deposit_stretch(cells, segment, piece, patch);
    }

    /// Fills what lies between the ends of two segments of one surface, where the segments in between fell through the
    /// samples.
    fn deposit_gap(&self, cells: &mut Cells, [below, above]: [&Segment; 2], piece: Piece) {
        let middle = 0.5 * (piece.low + piece.high);
        let (w0, w1) = (below.inverse_rho(piece.low), above.inverse_rho(piece.high));
        let slant = (1.0 + middle * middle).sqrt();
        let facing = 0.5 * (below.facing(middle) + above.facing(middle));
        let stretch = Stretch { w: 0.5 * (w0 + w1), facing, ranges: [slant / w0, slant / w1] };
        self.deposit_stretch(cells, below, piece, stretch);
    }

    fn deposit_stretch(&self, cells: &mut Cells, segment: &Segment, piece: Piece, stretch: Stretch) {
        let span = piece.high - piece.low;
        if span <= 0.0 {
            return;
        }
        let Ping { planes, beams, scene, surfaces, .. } = self.ping;
        let instance = &scene.instances[usize::from(segment.instance)];
        let material = instance.materials[usize::from(segment.material)];
        let (t, cosine) = (planes.t[piece.sample], stretch.facing * beams.cosine[piece.sample]);
        let mut energy =
            beams.weight[piece.sample] * surfaces.response(material, cosine) * stretch.w * stretch.w * span;
        if surfaces.is_patchy(material) {
            energy *= self.patchiness(material, t, 1.0 / stretch.w);
        }
        let split = beams.split(self.number, piece.sample);
        let (rays, reflectivity) = (span / planes.t_step, surfaces.reflectivity(material));
        let (ranges, body) = (stretch.ranges, instance.body);
        cells.add(&Patch { split, energy, ranges, body, material, cosine, t, rays, reflectivity });
    }

    /// Patchiness of a surface at (ρ, ρ·t), by its place in the world.
    fn patchiness(&self, material: u16, t: f32, rho: f32) -> f32 {
        let origin = self.ping.world_from_sonar.position;
        let place = |axis: usize, origin: f64| origin as f32 + rho * (self.ahead[axis] + t * self.up[axis]);
        self.ping.surfaces.patch(material, place(0, origin.x), place(1, origin.y))
    }
}

/// What a piece of surface looks like from the sonar.
struct Stretch {
    /// 1/ρ of its middle.
    w: f32,
    /// `|n · (1, t)|` at its middle.
    facing: f32,
    /// Slant ranges of its ends.
    ranges: [f32; 2],
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
    if below.instance != above.instance || !continuous(below, above, end, start) {
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
