//! Scan conversion: triangles cut by beam planes, the nearest kept in a one-dimensional depth buffer a plane.
//!
//! All rays of a ping leave from one point, so a ping is a picture over (bearing, elevation) and needs no tree.
//! A triangle is cut by each beam plane that it spans; the cut is a segment in (t, 1/ρ), straight in both. Cuts are
//! computed from the edge's two vertices alone and in a fixed order, so triangles that share an edge share the cut's bits:
//! no crack between them, no sample twice.

use super::clip;
use super::planes::Planes;

/// A triangle's cut by one beam plane, as far as the sonar could see it: a straight line in (t, w = 1/ρ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Lower end, tangent of elevation.
    pub t0: f32,
    /// Upper end; `t0 < t1`.
    pub t1: f32,
    /// Tangent at the end that is farther off. Reckoned from there, 1/ρ only grows: nothing cancels, however near the
    /// other end comes.
    pub far_t: f32,
    /// 1/ρ at `far_t`, 1/m.
    pub far_w: f32,
    /// Change of 1/ρ with t.
    pub slope: f32,
    /// Component of the surface normal along ρ in this plane.
    pub normal_rho: f32,
    /// Component of the surface normal along z.
    pub normal_z: f32,
    /// Number of the triangle in its mesh.
    pub triangle: u32,
    /// Number of the instance in its scene.
    pub instance: u16,
    /// Material slot of the mesh.
    pub material: u16,
}

impl Segment {
    /// 1/ρ of the (extended) line at `t`.
    #[inline(always)]
    #[must_use]
    pub fn inverse_rho(&self, t: f32) -> f32 {
        self.far_w + self.slope * (t - self.far_t)
    }

    /// `|n · (1, t)|` in the plane: the cosine of incidence times the secant of elevation.
    #[inline(always)]
    #[must_use]
    pub fn facing(&self, t: f32) -> f32 {
        (self.normal_rho + self.normal_z * t).abs()
    }
}

/// What all triangles of a cluster have in common.
#[derive(Clone, Copy, Debug)]
pub struct Tag {
    /// Number of the cluster's first triangle in its mesh.
    pub first_triangle: u32,
    /// Number of the instance in its scene.
    pub instance: u16,
    /// Material slot of the mesh.
    pub material: u16,
}

/// Vertices of one cluster in the sonar's frame, one array a coordinate.
#[derive(Clone, Debug, Default)]
pub struct Vertices {
    /// Forward, metres.
    pub x: Vec<f32>,
    /// Port, metres.
    pub y: Vec<f32>,
    /// Up, metres.
    pub z: Vec<f32>,
    /// Azimuth counted in planes: plane p cuts an edge whose ends lie on either side of p.
    pub plane: Vec<f32>,
    /// Why the vertex is out of the picture: a bit each for above, below and behind.
    pub out: Vec<u8>,
}

/// Bit of [`Vertices::out`]: above the highest elevation.
const ABOVE: u8 = 1;
/// Bit of [`Vertices::out`]: below the lowest elevation.
const BELOW: u8 = 2;
/// Bit of [`Vertices::out`]: behind the clip plane.
const BEHIND: u8 = 4;

/// One-dimensional depth buffers of all planes, and the segments that were nearest somewhere when they were drawn.
#[derive(Clone, Debug, Default)]
pub struct DepthBuffer {
    /// 1/ρ of the nearest surface at each (plane, sample), plane by plane; 0 where nothing is.
    pub nearest: Vec<f32>,
    /// Index of its segment; meaningless where `nearest` is 0.
    pub segment: Vec<u32>,
    /// Segments in drawing order.
    pub segments: Vec<Segment>,
}

impl DepthBuffer {
    /// Empties the buffer for `planes`, keeping its memory.
    pub fn clear(&mut self, planes: &Planes) {
        let samples = planes.count() * planes.samples();
        self.nearest.clear();
        self.nearest.resize(samples, 0.0);
        self.segment.resize(samples, 0);
        self.segments.clear();
    }

    /// Draws the triangles of one cluster.
    #[inline(always)]
    pub fn draw(&mut self, planes: &Planes, vertices: &Vertices, triangles: &[[u16; 3]], tag: Tag) {
        for (number, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(usize::from);
            let (oa, ob, oc) = (vertices.out[a], vertices.out[b], vertices.out[c]);
            if oa & ob & oc != 0 {
                continue;
            }
            let corner =
                |v: usize| Corner { p: [vertices.x[v], vertices.y[v], vertices.z[v]], plane: vertices.plane[v] };
            let triangle = tag.first_triangle + number as u32;
            if (oa | ob | oc) & BEHIND == 0 {
                // Most triangles of a fine mesh lie between two planes: they are dropped before anything is fetched.
                let (pa, pb, pc) = (vertices.plane[a], vertices.plane[b], vertices.plane[c]);
                if let Some(range) = planes_between(pa.min(pb).min(pc), pa.max(pb).max(pc), planes.count()) {
                    self.draw_triangle(planes, [corner(a), corner(b), corner(c)], range, triangle, tag);
                }
            } else {
                clip::in_front([corner(a).p, corner(b).p, corner(c).p], |points| {
                    let corners = points.map(|p| Corner { p, plane: plane_coordinate(planes, p[0], p[1]) });
                    let [pa, pb, pc] = corners.map(|corner| corner.plane);
                    if let Some(range) = planes_between(pa.min(pb).min(pc), pa.max(pb).max(pc), planes.count()) {
                        self.draw_triangle(planes, corners, range, triangle, tag);
                    }
                });
            }
        }
    }

    /// Cuts one triangle by the planes in `range` and keeps what is nearest.
    #[inline(always)]
    fn draw_triangle(
        &mut self,
        planes: &Planes,
        corners: [Corner; 3],
        range: std::ops::Range<usize>,
        triangle: u32,
        tag: Tag,
    ) {
        let mut normal = None;
        let [p, q, r] = corners.map(|corner| corner.p);
        for plane in range {
            let (cos, sin) = (planes.cos[plane], planes.sin[plane]);
            let side = |v: [f32; 3]| v[1] * cos - v[0] * sin;
            let (sp, sq, sr) = (side(p), side(q), side(r));
            let (front_p, front_q, front_r) = (sp >= 0.0, sq >= 0.0, sr >= 0.0);
            // The vertex alone on its side is an end of both edges that the plane cuts.
            let (alone, other, third) = match (front_p == front_q, front_q == front_r, front_p == front_r) {
                (true, true, _) => continue,
                (true, _, _) => ((r, sr), (p, sp), (q, sq)),
                (_, true, _) => ((p, sp), (q, sq), (r, sr)),
                _ => ((q, sq), (r, sr), (p, sp)),
            };
            let first = cut(alone, other, cos, sin);
            let second = cut(alone, third, cos, sin);
            let (low, high) = if first.t <= second.t { (first, second) } else { (second, first) };
            let Some((from, to)) = samples_between(planes, low.t, high.t) else { continue };
            let slope = (high.w - low.w) / (high.t - low.t);
            let far = if low.w <= high.w { low } else { high };
            let row = plane * planes.samples();
            let id = self.segments.len() as u32;
            let mut seen = false;
            let nearest = &mut self.nearest[row + from..row + to];
            let segment = &mut self.segment[row + from..row + to];
            for ((t, nearest), segment) in planes.t[from..to].iter().zip(nearest).zip(segment) {
                let w = far.w + slope * (t - far.t);
                if w > *nearest {
                    *nearest = w;
                    *segment = id;
                    seen = true;
                }
            }
            if seen {
                let [nx, ny, nz] = *normal.get_or_insert_with(|| unit_normal(p, q, r));
                self.segments.push(Segment {
                    t0: low.t,
                    t1: high.t,
                    far_t: far.t,
                    far_w: far.w,
                    slope,
                    normal_rho: nx * cos + ny * sin,
                    normal_z: nz,
                    triangle,
                    instance: tag.instance,
                    material: tag.material,
                });
            }
        }
    }
}

impl Vertices {
    /// Fills in azimuths and outcodes for the positions in `x`, `y`, `z`.
    #[inline(always)]
    pub fn classify(&mut self, planes: &Planes) {
        let count = self.x.len();
        self.plane.clear();
        self.plane.resize(count, 0.0);
        self.out.clear();
        self.out.resize(count, 0);
        let (first, step) = (planes.first_rad as f32, 1.0 / planes.step_rad as f32);
        let positions = self.x.iter().zip(&self.y).zip(&self.z);
        for (((&x, &y), &z), (plane, out)) in positions.zip(self.plane.iter_mut().zip(&mut self.out)) {
            *plane = (arctangent(y, x.max(clip::NEAR_M)) - first) * step;
            // Concave in (x, y, z), so three corners out on one side mean that the whole triangle is.
            let rho = (x * x + y * y).sqrt();
            *out = (u8::from(z > planes.t_high * rho) * ABOVE)
                | (u8::from(z < planes.t_low * rho) * BELOW)
                | (u8::from(x < clip::NEAR_M) * BEHIND);
        }
    }
}

/// A triangle's corner.
#[derive(Clone, Copy)]
struct Corner {
    p: [f32; 3],
    plane: f32,
}

/// A point of a beam plane.
#[derive(Clone, Copy)]
struct Cut {
    t: f32,
    w: f32,
}

/// Where the edge between two vertices on either side of a plane meets it. Always computed from the vertex on the
/// starboard side to that on the port side, whichever triangle asks.
#[inline(always)]
fn cut(one: ([f32; 3], f32), two: ([f32; 3], f32), cos: f32, sin: f32) -> Cut {
    let ((starboard, s0), (port, s1)) = if one.1 < two.1 { (one, two) } else { (two, one) };
    let share = s0 / (s0 - s1);
    let rho0 = starboard[0] * cos + starboard[1] * sin;
    let rho1 = port[0] * cos + port[1] * sin;
    let w = 1.0 / (rho0 + share * (rho1 - rho0));
    Cut { t: (starboard[2] + share * (port[2] - starboard[2])) * w, w }
}

/// Planes that may lie between two azimuths counted in planes; generous by a hundredth, since the sign test decides.
#[inline(always)]
fn planes_between(low: f32, high: f32, count: usize) -> Option<std::ops::Range<usize>> {
    let from = (low - 0.01).ceil().max(0.0);
    let to = (high + 0.01).floor().min(count as f32 - 1.0);
    (from <= to).then(|| from as usize..to as usize + 1)
}

/// Samples with `low <= t < high`, as a half-open range.
#[inline(always)]
fn samples_between(planes: &Planes, low: f32, high: f32) -> Option<(usize, usize)> {
    let count = planes.samples();
    let per_t = 1.0 / planes.t_step;
    let guess = |t: f32| (((t - planes.t_low) * per_t + 0.5).max(0.0) as usize).min(count);
    // The guess may be off by one where rounding decides; the table of samples is the judge.
    let settle = |t: f32| {
        let mut sample = guess(t);
        while sample > 0 && planes.t[sample - 1] >= t {
            sample -= 1;
        }
        while sample < count && planes.t[sample] < t {
            sample += 1;
        }
        sample
    };
    let (from, to) = (settle(low), settle(high));
    (from < to).then_some((from, to))
}

/// Azimuth of (x, y) counted in planes.
#[inline(always)]
fn plane_coordinate(planes: &Planes, x: f32, y: f32) -> f32 {
    (arctangent(y, x) - planes.first_rad as f32) * (1.0 / planes.step_rad as f32)
}

/// atan2(y, x) for x > 0, within 2e-6 rad: enough to choose planes, whose exact test follows.
///
/// Source: minimax polynomial of atan on [0, 1] in odd powers, Abramowitz & Stegun (1964), 4.4.49.
#[inline(always)]
fn arctangent(y: f32, x: f32) -> f32 {
    let size = y.abs();
    let (small, large) = (size.min(x), size.max(x));
    let q = small / large;
    let s = q * q;
    let poly =
        ((((((((0.002_866_226 * s - 0.016_165_737) * s + 0.042_909_615) * s - 0.075_289_64) * s + 0.106_562_64) * s
            - 0.142_089)
            * s
            + 0.199_935_51)
            * s
            - 0.333_331_45)
            * s
            + 1.0)
            * q;
    let angle = if size > x { std::f32::consts::FRAC_PI_2 - poly } else { poly };
    if y < 0.0 { -angle } else { angle }
}

/// Unit normal of a triangle (zero for a degenerate one).
#[inline(always)]
fn unit_normal(p: [f32; 3], q: [f32; 3], r: [f32; 3]) -> [f32; 3] {
    let u = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
    let v = [r[0] - p[0], r[1] - p[1], r[2] - p[2]];
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if length > 0.0 { n.map(|c| c / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real;

    #[test]
    fn the_quick_arctangent_is_close_enough_to_choose_planes() {
        for i in -2000..=2000 {
            let angle = f64::from(i) / 2000.0 * 1.55;
            let (y, x) = (real::sin(angle) as f32 * 7.0, real::cos(angle) as f32 * 7.0);
            assert!((f64::from(arctangent(y, x)) - angle).abs() < 3e-6, "{angle}");
        }
    }
}
