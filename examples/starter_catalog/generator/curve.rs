//! Outlines in the plane and paths in space that surfaces are drawn along.
//!
//! Knows nothing of triangles. Metres and degrees.

use ensonify::math::real::{cos, radians, sin};
use glam::DVec3;

/// A point of an outline (x, y), of a profile (radius, height) or of a section (side, up).
pub type Point = [f64; 2];

/// A circle about the origin as a polygon whose first corner lies on +x.
#[must_use]
pub fn circle(radius: f64, corners: usize) -> Vec<Point> {
    ellipse(radius, radius, corners)
}

/// An ellipse about the origin as a polygon whose first corner lies on +x.
#[must_use]
pub fn ellipse(x: f64, y: f64, corners: usize) -> Vec<Point> {
    (0..corners).map(|i| std::f64::consts::TAU * i as f64 / corners as f64).map(|a| [x * cos(a), y * sin(a)]).collect()
}

/// A rectangle about the origin with its corners rounded by `radius`, each in `steps` chords.
#[must_use]
pub fn rounded_rectangle(width: f64, height: f64, radius: f64, steps: usize) -> Vec<Point> {
    let (x, y) = (width / 2.0 - radius, height / 2.0 - radius);
    [([x, y], 0.0), ([-x, y], 90.0), ([-x, -y], 180.0), ([x, -y], 270.0)]
        .into_iter()
        .flat_map(|(centre, from)| arc(centre, radius, [from, from + 90.0], steps))
        .collect()
}

/// A rectangle about the origin.
#[must_use]
pub fn rectangle(width: f64, height: f64) -> Vec<Point> {
    let (x, y) = (width / 2.0, height / 2.0);
    vec![[x, y], [-x, y], [-x, -y], [x, -y]]
}

/// The arc from one angle to another, both ends given, in `steps` chords.
#[must_use]
pub fn arc(centre: Point, radius: f64, degrees: [f64; 2], steps: usize) -> Vec<Point> {
    (0..=steps)
        .map(|i| radians(degrees[0] + (degrees[1] - degrees[0]) * i as f64 / steps as f64))
        .map(|a| [centre[0] + radius * cos(a), centre[1] + radius * sin(a)])
        .collect()
}

/// A smooth path through `points` (Catmull–Rom), `steps` chords between neighbours.
#[must_use]
pub fn spline(points: &[[f64; 3]], steps: usize) -> Vec<DVec3> {
    let point = |i: isize| DVec3::from_array(points[i.clamp(0, points.len() as isize - 1) as usize]);
    let mut path = Vec::new();
    for i in 0..points.len() as isize - 1 {
        let (a, b, c, d) = (point(i - 1), point(i), point(i + 1), point(i + 2));
        for step in 0..steps {
            let t = step as f64 / steps as f64;
            let bend = (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t) + (b * 3.0 - a - c * 3.0 + d) * (t * t * t);
            path.push((b * 2.0 + (c - a) * t + bend) * 0.5);
        }
    }
    path.push(point(points.len() as isize - 1));
    path
}

/// A smooth profile through `points`, `steps` chords between neighbours.
#[must_use]
pub fn smooth(points: &[Point], steps: usize) -> Vec<Point> {
    let in_space: Vec<[f64; 3]> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    spline(&in_space, steps).into_iter().map(|p| [p.x, p.y]).collect()
}

/// The value at `x` of the line through (x, value) `points`, which must be sorted; held constant beyond the ends.
#[must_use]
pub fn interpolate(points: &[Point], x: f64) -> f64 {
    let after = points.iter().position(|p| p[0] > x).unwrap_or(points.len());
    if after == 0 || after == points.len() {
        return points[after.min(points.len() - 1)][1];
    }
    let ([x0, y0], [x1, y1]) = (points[after - 1], points[after]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}
