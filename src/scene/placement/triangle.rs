//! Two triangles: whether they meet or come near each other; and a triangle as seen from a point.

use glam::DVec3;

use crate::math::real::atan2;

/// Corners, counter-clockwise seen from outside.
pub(super) type Triangle = [DVec3; 3];

/// Sides of a triangle by corner numbers.
const SIDES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

/// Whether two triangles cross, or lie closer than `distance` to each other. Those that touch at an edge may count as crossing.
pub(super) fn are_closer(a: &Triangle, b: &Triangle, distance: f64) -> bool {
    if are_apart(a, b, distance) {
        return false;
    }
    if SIDES.iter().any(|&(i, j)| pierces(a[i], a[j], b)) || SIDES.iter().any(|&(i, j)| pierces(b[i], b[j], a)) {
        return true;
    }
    let square = distance * distance;
    distance > 0.0
        && (a.iter().any(|&p| (nearest(b, p) - p).length_squared() < square)
            || b.iter().any(|&p| (nearest(a, p) - p).length_squared() < square)
            || SIDES.iter().any(|&(i, j)| SIDES.iter().any(|&(k, l)| between(a[i], a[j], b[k], b[l]) < square)))
}

/// Whether the boxes about two triangles, or the plane of one, tell at once that they lie farther apart.
fn are_apart(a: &Triangle, b: &Triangle, distance: f64) -> bool {
    let [low_a, low_b] = [a, b].map(|t| t[0].min(t[1]).min(t[2]));
    let [high_a, high_b] = [a, b].map(|t| t[0].max(t[1]).max(t[2]));
    let room = DVec3::splat(distance);
    low_a.cmpgt(high_b + room).any()
        || low_b.cmpgt(high_a + room).any()
        || is_beside(a, b, distance)
        || is_beside(b, a, distance)
}

/// Whether a triangle lies farther than `distance` to one side of another's plane.
fn is_beside([a, b, c]: &Triangle, other: &Triangle, distance: f64) -> bool {
    let normal = (b - a).cross(c - a);
    let heights = other.map(|p| normal.dot(p - a));
    let least = distance * normal.length();
    heights.iter().all(|&height| height > least) || heights.iter().all(|&height| height < -least)
}

/// Solid angle of a triangle from a point, positive from behind, steradians.
///
/// Source: Van Oosterom & Strackee (1983), The solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, eq. 8.
pub(super) fn solid_angle(triangle: &Triangle, from: DVec3) -> f64 {
    let [a, b, c] = triangle.map(|p| p - from);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let above = a.dot(b.cross(c));
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * atan2(above, below)
}

/// Whether a segment goes through a triangle, from one side to the other.
fn pierces(from: DVec3, to: DVec3, [a, b, c]: &Triangle) -> bool {
    let normal = (b - a).cross(c - a);
    let (start, end) = (normal.dot(from - a), normal.dot(to - a));
    // Points within a nanometre of the plane lie on it.
    let least = 1e-9 * normal.length();
    if !(start > least && end < -least || start < -least && end > least) {
        return false;
    }
    let point = from + (to - from) * (start / (start - end));
    [(a, b), (b, c), (c, a)].iter().all(|(p, q)| normal.dot((*q - *p).cross(point - *p)) >= 0.0)
}

/// The point of a triangle that is nearest to another.
///
/// Source: Ericson (2005), Real-time collision detection, section 5.1.5.
pub(super) fn nearest([a, b, c]: &Triangle, p: DVec3) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    if sum > 0.0 { a + ab * (vb / sum) + ac * (vc / sum) } else { *a }
}

/// Squared distance between two segments.
///
/// Source: Ericson (2005), Real-time collision detection, section 5.1.9.
fn between(p1: DVec3, q1: DVec3, p2: DVec3, q2: DVec3) -> f64 {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, e, f) = (d1.length_squared(), d2.length_squared(), d2.dot(r));
    let (c, b) = (d1.dot(r), d1.dot(d2));
    let share = |above: f64, below: f64| if below > 0.0 { (above / below).clamp(0.0, 1.0) } else { 0.0 };
    let s = share(b * f - c * e, a * e - b * b);
    let t = if e > 0.0 { (b * s + f) / e } else { 0.0 };
    let (s, t) = match t {
        _ if t < 0.0 => (share(-c, a), 0.0),
        _ if t > 1.0 => (share(b - c, a), 1.0),
        _ => (s, t),
    };
    (r + d1 * s - d2 * t).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Stream;

    #[test]
    fn distances_agree_with_a_search() {
        let mut stream = Stream::at(1, "test", 0, "triangles");
        let mut corner =
            |away: f64| DVec3::new(stream.uniform(-1.0, 1.0) + away, stream.uniform(-1.0, 1.0), stream.unit());
        for round in 0..30 {
            let a: Triangle = std::array::from_fn(|_| corner(0.0));
            let b: Triangle = std::array::from_fn(|_| corner(1.7));
            let points = |t: &Triangle| -> Vec<DVec3> {
                let n = 40;
                let at = |i: usize, j: usize| {
                    t[0] + (t[1] - t[0]) * (i as f64 / n as f64) + (t[2] - t[0]) * (j as f64 / n as f64)
                };
                (0..=n).flat_map(|i| (0..=n - i).map(move |j| at(i, j))).collect()
            };
            let (ours, theirs) = (points(&a), points(&b));
            let apart = |p: &DVec3| theirs.iter().map(|q| (*p - *q).length()).fold(f64::MAX, f64::min);
            let found = ours.iter().map(apart).fold(f64::MAX, f64::min);
            assert!(are_closer(&a, &b, found + 1e-9), "round {round}: {found}");
            let lower = found - 0.08;
            assert!(lower <= 0.0 || !are_closer(&a, &b, lower), "round {round}: nearer than {lower}");
        }
    }

    #[test]
    fn a_closed_surface_fills_the_sphere_from_inside() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|face| face.map(|k: usize| corners[k]));
        let angle = |p: DVec3| faces.iter().map(|face| solid_angle(face, p)).sum::<f64>();
        assert!((angle(DVec3::splat(0.2)) - 2.0 * std::f64::consts::TAU).abs() < 1e-12);
        assert!(angle(DVec3::splat(0.5)).abs() < 1e-12);
    }
}
