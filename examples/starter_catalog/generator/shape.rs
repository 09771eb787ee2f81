//! Surfaces by lofting, turning and sweeping: everything that is round, bent or long.
//!
//! Knows nothing of objects. All results are closed and face outwards.

use std::collections::BTreeMap;

use ensonify::math::real::{cos, sin};
use glam::DVec3;

use super::curve::{Point, circle, rectangle};
use super::solid::{Solid, across};

/// What closes a loft at its first and last ring.
#[derive(Clone, Copy, Debug)]
pub enum Ends {
    /// A fan of triangles about these two points.
    Fans(DVec3, DVec3),
    /// A strip across a ring that runs out along one side and back along the other (a bent sheet).
    Folds,
    /// The last ring joins the first.
    Joined,
}

/// The surface over a row of rings, which all have the same number of points and run the same way round.
#[must_use]
pub fn loft(rings: &[Vec<DVec3>], ends: Ends) -> Solid {
    let n = rings[0].len();
    let mut positions: Vec<DVec3> = rings.iter().flatten().copied().collect();
    let mut triangles = Vec::new();
    let strips = rings.len() - usize::from(!matches!(ends, Ends::Joined));
    for (i, j) in (0..strips).map(|i| (i * n, (i + 1) % rings.len() * n)) {
        (0..n)
            .map(|k| (k, (k + 1) % n))
            .for_each(|(k, l)| quad(&positions, &mut triangles, [i + k, i + l, j + l, j + k]));
    }
    let last = (rings.len() - 1) * n;
    match ends {
        Ends::Joined => {}
        Ends::Fans(first_apex, last_apex) => {
            let apex = positions.len() as u32;
            positions.extend([first_apex, last_apex]);
            for (k, l) in (0..n).map(|k| (k, (k + 1) % n)) {
                triangles.push([apex, l as u32, k as u32]);
                triangles.push([apex + 1, (last + k) as u32, (last + l) as u32]);
            }
        }
        Ends::Folds => {
            for k in 0..n / 2 - 1 {
                quad(&positions, &mut triangles, [n - 1 - k, n - 2 - k, k + 1, k]);
                quad(&positions, &mut triangles, [last + k, last + k + 1, last + n - 2 - k, last + n - 1 - k]);
            }
        }
    }
    Solid::outward(positions, triangles)
}

/// Two triangles over four corners in order, split along the shorter diagonal.
fn quad(positions: &[DVec3], triangles: &mut Vec<[u32; 3]>, corners: [usize; 4]) {
    let [a, b, c, d] = corners;
    let across = |p: usize, q: usize| (positions[p] - positions[q]).length_squared();
    let [a, b, c, d] = if across(a, c) <= across(b, d) { [a, b, c, d] } else { [b, c, d, a] }.map(|v| v as u32);
    triangles.extend([[a, b, c], [a, c, d]]);
}

/// A loft whose ends are closed flat.
#[must_use]
pub fn capped(rings: &[Vec<DVec3>]) -> Solid {
    let centre = |ring: &[DVec3]| ring.iter().copied().sum::<DVec3>() / ring.len() as f64;
    loft(rings, Ends::Fans(centre(&rings[0]), centre(&rings[rings.len() - 1])))
}

/// A profile of (radius, height) points turned about z; it starts and ends on the axis or is closed flat there.
#[must_use]
pub fn lathe(profile: &[Point], around: usize) -> Solid {
    let on_axis = |p: &Point| DVec3::new(0.0, 0.0, p[1]);
    let rings: Vec<_> = profile.iter().filter(|p| p[0] > 1e-9).map(|p| ring(*p, around)).collect();
    loft(&rings, Ends::Fans(on_axis(&profile[0]), on_axis(&profile[profile.len() - 1])))
}

/// A closed profile that stays clear of the axis, turned about z: pipes, tyres, rings.
#[must_use]
pub fn lathe_ring(profile: &[Point], around: usize) -> Solid {
    let rings: Vec<_> = profile.iter().map(|p| ring(*p, around)).collect();
    loft(&rings, Ends::Joined)
}

fn ring([radius, height]: Point, around: usize) -> Vec<DVec3> {
    circle(radius, around).into_iter().map(|[x, y]| DVec3::new(x, y, height)).collect()
}

/// A cylinder about z.
#[must_use]
pub fn cylinder(radius: f64, heights: [f64; 2], around: usize) -> Solid {
    lathe(&[[radius, heights[0]], [radius, heights[1]]], around)
}

/// A torus about z.
#[must_use]
pub fn torus(radius: f64, thickness: f64, [around, sides]: [usize; 2]) -> Solid {
    let section: Vec<Point> = circle(thickness / 2.0, sides).into_iter().map(|[r, z]| [radius + r, z]).collect();
    lathe_ring(&section, around)
}

/// Whether a path comes back to its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    Open,
    Closed,
}

/// A section carried along a path. `section(i)` gives the outline at the i-th point as (along `side`, along tangent × side);
/// `side` is kept at right angles to the path and otherwise turns as little as it can.
#[must_use]
pub fn sweep(points: &[DVec3], path: Path, side: DVec3, section: impl Fn(usize) -> Vec<Point>) -> Solid {
    let n = points.len();
    let mut side = side;
    let mut rings = Vec::with_capacity(n);
    for i in 0..n {
        let (before, after) = match path {
            Path::Closed => ((i + n - 1) % n, (i + 1) % n),
            Path::Open => (i.saturating_sub(1), (i + 1).min(n - 1)),
        };
        let tangent = (points[after] - points[before]).normalize();
        side = (side - tangent * side.dot(tangent)).normalize();
        let up = tangent.cross(side);
        rings.push(section(i).into_iter().map(|[u, v]| points[i] + side * u + up * v).collect::<Vec<_>>());
    }
    match path {
        Path::Closed => loft(&rings, Ends::Joined),
        Path::Open => capped(&rings),
    }
}

/// A round bar along an open path.
#[must_use]
pub fn tube(points: &[DVec3], radius: f64, sides: usize) -> Solid {
    sweep(points, Path::Open, across(points[1] - points[0]), |_| circle(radius, sides))
}

/// A straight round bar.
#[must_use]
pub fn rod(from: [f64; 3], to: [f64; 3], radius: f64, sides: usize) -> Solid {
    tube(&[DVec3::from_array(from), DVec3::from_array(to)], radius, sides)
}

/// A straight rectangular bar; `size` is along `side` and across both.
#[must_use]
pub fn plank(from: [f64; 3], to: [f64; 3], side: DVec3, size: Point) -> Solid {
    let ends = [DVec3::from_array(from), DVec3::from_array(to)];
    sweep(&ends, Path::Open, side, |_| rectangle(size[0], size[1]))
}

/// A box of this size whose centre is at `centre`.
#[must_use]
pub fn cuboid(size: [f64; 3], centre: [f64; 3]) -> Solid {
    let [x, y, z] = centre;
    plank([x, y, z - size[2] / 2.0], [x, y, z + size[2] / 2.0], DVec3::X, [size[0], size[1]])
}

/// The unit sphere from an icosahedron, each edge cut in `frequency` pieces: 20 × frequency² triangles.
#[must_use]
pub fn icosphere(frequency: u32) -> Solid {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let corners: Vec<DVec3> = [(1.0, g), (1.0, -g), (-1.0, g), (-1.0, -g)]
        .into_iter()
        .flat_map(|(a, b)| [DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)])
        .map(DVec3::normalize)
        .collect();
    let mut positions = Vec::new();
    let mut numbers = BTreeMap::new();
    // A vertex is named by its share of each corner, so that neighbouring faces find the same one.
    let mut vertex = |face: [usize; 3], shares: [u32; 3]| {
        let mut name: Vec<(usize, u32)> = face.into_iter().zip(shares).filter(|(_, share)| *share > 0).collect();
        name.sort_unstable();
        let place: DVec3 = name.iter().map(|&(corner, share)| corners[corner] * f64::from(share)).sum();
        *numbers.entry(name).or_insert_with(|| {
            positions.push(place.normalize());
            positions.len() as u32 - 1
        })
    };
    let mut triangles = Vec::new();
    for face in nearest_triples(&corners) {
        let mut at = |i: u32, j: u32| vertex(face, [frequency - i - j, i, j]);
        for (i, j) in (0..frequency).flat_map(|i| (0..frequency - i).map(move |j| (i, j))) {
            triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
            if i + j + 1 < frequency {
                triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
    Solid::outward(positions, triangles)
}

/// The faces of the icosahedron: all triples of corners that are neighbours of each other, facing outwards.
fn nearest_triples(corners: &[DVec3]) -> Vec<[usize; 3]> {
    let near = |a: usize, b: usize| corners[a].dot(corners[b]) > 0.4;
    let mut faces = Vec::new();
    for a in 0..corners.len() {
        for b in a + 1..corners.len() {
            for c in (b + 1..corners.len()).filter(|&c| near(a, b) && near(b, c) && near(c, a)) {
                let out = corners[a].dot(corners[b].cross(corners[c])) > 0.0;
                faces.push(if out { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    faces
}

/// A dome of half a sphere as the (radius, height) profile from its rim at `height` to the axis, `rise` high.
#[must_use]
pub fn dome(radius: f64, height: f64, rise: f64, steps: usize) -> Vec<Point> {
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut profile: Vec<Point> = (0..steps)
        .map(|i| quarter * i as f64 / steps as f64)
        .map(|a| [radius * cos(a), height + rise * sin(a)])
        .collect();
    profile.push([0.0, height + rise]);
    profile
}
