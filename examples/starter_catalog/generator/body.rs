//! Bodies of animals, people and hulls: smooth lofts, tapering limbs, thin fins.
//!
//! Knows nothing of objects. All results are closed and face outwards.

use glam::DVec3;

use super::curve::{Point, circle, ellipse, smooth, spline};
use super::prism::{area, prism};
use super::shape::{Path, capped, sweep};
use super::solid::{Axis, Solid, across};

/// A smooth body along x through stations of (x, half width, half height, height of the middle), `steps` rings between
/// two of them, `around` corners each.
#[must_use]
pub fn body(stations: &[[f64; 4]], steps: usize, around: usize) -> Solid {
    let sizes: Vec<[f64; 3]> = stations.iter().map(|s| [s[0], s[1], s[2]]).collect();
    let middles: Vec<Point> = stations.iter().map(|s| [s[0], s[3]]).collect();
    let rings: Vec<Vec<DVec3>> = spline(&sizes, steps)
        .into_iter()
        .zip(smooth(&middles, steps))
        .map(|(size, [_, middle])| {
            let section = ellipse(size.y.max(0.001), size.z.max(0.001), around);
            section.into_iter().map(|[y, z]| DVec3::new(size.x, y, middle + z)).collect()
        })
        .collect();
    capped(&rings)
}

/// A round limb through joints of (x, y, z, radius), `steps` rings between two of them.
#[must_use]
pub fn limb(joints: &[[f64; 4]], steps: usize, sides: usize) -> Solid {
    let places: Vec<[f64; 3]> = joints.iter().map(|j| [j[0], j[1], j[2]]).collect();
    let radii: Vec<Point> = joints.iter().map(|j| [j[3], 0.0]).collect();
    let (path, radii) = (spline(&places, steps), smooth(&radii, steps));
    sweep(&path, Path::Open, across(path[1] - path[0]), |i| circle(radii[i][0].max(0.0005), sides))
}

/// A thin plate in the x-z plane over an outline of (x, z), either way round.
#[must_use]
pub fn fin(outline: &[Point], thickness: f64) -> Solid {
    let mut outline = outline.to_vec();
    if area(&outline) < 0.0 {
        outline.reverse();
    }
    prism(&outline, &[], [-thickness / 2.0, thickness / 2.0]).turned(Axis::X, 90.0)
}

/// As [`fin`], lying in the x-y plane over an outline of (x, y).
#[must_use]
pub fn flat_fin(outline: &[Point], thickness: f64) -> Solid {
    fin(outline, thickness).turned(Axis::X, -90.0)
}

/// A wing: a lens-shaped section of (chord, thickness) from a leading edge at `from` to one at `to`; it flies towards x.
#[must_use]
pub fn wing(root: Point, tip: Point, from: DVec3, to: DVec3) -> Solid {
    let ring = |[chord, thick]: Point, nose: DVec3| -> Vec<DVec3> {
        let profile: [Point; 8] =
            [[0.0, 0.0], [0.1, 0.35], [0.35, 0.5], [0.7, 0.3], [1.0, 0.03], [0.7, -0.3], [0.35, -0.5], [0.1, -0.35]];
        let span = (to - from).normalize();
        let up = DVec3::X.cross(span).normalize();
        profile.map(|[x, z]| nose - DVec3::X * (x * chord) + up * (z * thick)).to_vec()
    };
    let rings: Vec<Vec<DVec3>> = (0..=4)
        .map(|i| f64::from(i) / 4.0)
        .map(|t| ring([root[0] + (tip[0] - root[0]) * t, root[1] + (tip[1] - root[1]) * t], from + (to - from) * t))
        .collect();
    capped(&rings)
}
