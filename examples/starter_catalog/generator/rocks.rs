//! What nature left: boulders and a tree trunk.

use ensonify::math::real::{cos, radians, sin};
use ensonify::math::rng::Stream;
use glam::DVec3;

use super::curve::{circle, interpolate, spline};
use super::noise::Noise;
use super::object::{Material, Object, Part};
use super::shape::{Path, icosphere, sweep};
use super::solid::Solid;

pub fn all() -> Vec<Object> {
    vec![
        rock(
            ["rock-1", "angular rock"],
            "stone;boulder;natural;small",
            Boulder { size: [0.46, 0.38, 0.27], detail: 12, cuts: 9, cut_depth: 0.80, craggy: 0.10 },
        ),
        rock(
            ["rock-2", "rock slab"],
            "stone;boulder;natural;slab",
            Boulder { size: [0.95, 0.70, 0.42], detail: 15, cuts: 16, cut_depth: 0.72, craggy: 0.13 },
        ),
        rock(
            ["rock-3", "large boulder"],
            "stone;boulder;natural;large",
            Boulder { size: [1.45, 1.15, 0.95], detail: 16, cuts: 13, cut_depth: 0.76, craggy: 0.16 },
        ),
        rock(
            ["rock-4", "rounded boulder"],
            "stone;boulder;natural;cobble;rounded",
            Boulder { size: [0.62, 0.50, 0.40], detail: 12, cuts: 3, cut_depth: 0.92, craggy: 0.05 },
        ),
        tree_trunk(),
    ]
}

/// How a rock was broken and worn.
struct Boulder {
    /// Extent along x, y, z, metres.
    size: [f64; 3],
    /// Pieces that an edge of the icosahedron is cut in.
    detail: u32,
    /// How many planes broke pieces off it.
    cuts: usize,
    /// How near to the middle they may come, as a share of the radius.
    cut_depth: f64,
    /// Height of its roughness as a share of the radius.
    craggy: f64,
}

/// A sphere with pieces broken off along planes, roughened by ridges, flattened below, drawn to size.
fn rock([uid, name]: [&'static str; 2], tags: &'static str, boulder: Boulder) -> Object {
    let noise = Noise::of(uid);
    let mut stream = Stream::at(1, "starter-catalog", 1, uid);
    let mut cuts: Vec<(DVec3, f64)> = (0..boulder.cuts)
        .map(|_| {
            let out = DVec3::new(stream.normal(), stream.normal(), stream.normal()).normalize();
            (out, stream.uniform(boulder.cut_depth - 0.07, boulder.cut_depth + 0.12))
        })
        .collect();
    cuts.push((-DVec3::Z, 0.42));
    let rough = icosphere(boulder.detail).mapped(|p| {
        let broken = cuts.iter().fold(1.0, |radius: f64, (out, depth)| {
            let toward = p.dot(*out);
            if toward > 0.05 { radius.min(depth / toward) } else { radius }
        });
        let swell = 0.24 * noise.at(p * 0.9 + 7.0);
        let crags = boulder.craggy * (noise.ridged(p * 1.5 + 11.3, 3) + 0.5 * noise.fractal(p * 3.0 + 3.0, 2));
        p * (broken * (1.0 + swell) + crags)
    });
    let low = rough.positions.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = rough.positions.iter().copied().reduce(DVec3::max).unwrap_or_default();
    let scale = DVec3::from_array(boulder.size) / (high - low);
    Object {
        uid,
        name,
        label: "rock",
        tags,
        parts: vec![Part::new("rock", Material::Rock, [rough.mapped(|p| (p - low) * scale)])],
    }
}

/// A waterlogged trunk of 3.3 m with its root flare, bent, with broken branch stubs.
fn tree_trunk() -> Object {
    let line = [
        [-1.62, 0.02, 0.27],
        [-1.1, 0.0, 0.22],
        [-0.4, 0.10, 0.21],
        [0.35, 0.16, 0.24],
        [1.0, 0.06, 0.22],
        [1.66, -0.16, 0.16],
    ];
    let girth = [[0.0, 0.27], [0.06, 0.225], [0.14, 0.185], [0.35, 0.168], [0.7, 0.145], [1.0, 0.105]];
    let mut solids = vec![limb(&spline(&line, 11), &girth, 28)];
    for root in 0..5 {
        let angle = radians(72.0 * f64::from(root) + 20.0);
        let (y, z) = (cos(angle), sin(angle));
        let reach = 0.26 + 0.04 * f64::from(root % 3);
        let path = [
            [-1.40, 0.10 * y, 0.25 + 0.10 * z],
            [-1.55, 0.18 * y, 0.26 + 0.17 * z],
            [-1.66 - 0.04 * f64::from(root % 2), (0.18 + reach) * y, 0.26 + (0.10 + 0.7 * reach) * z],
        ];
        solids.push(limb(&spline(&path, 4), &[[0.0, 0.10], [0.5, 0.075], [1.0, 0.030]], 12));
    }
    let stubs: [[[f64; 3]; 3]; 5] = [
        [[-0.55, 0.08, 0.22], [-0.46, 0.22, 0.34], [-0.36, 0.34, 0.50]],
        [[0.10, 0.12, 0.22], [0.16, 0.02, 0.40], [0.30, -0.08, 0.58]],
        [[0.62, 0.12, 0.23], [0.74, 0.32, 0.26], [0.95, 0.52, 0.22]],
        [[0.80, 0.08, 0.22], [0.88, -0.12, 0.30], [0.90, -0.24, 0.36]],
        [[1.20, 0.0, 0.20], [1.34, 0.08, 0.34], [1.50, 0.12, 0.42]],
    ];
    for (stub, thick) in stubs.iter().zip([0.065, 0.060, 0.055, 0.050, 0.045]) {
        solids.push(limb(&spline(stub, 5), &[[0.0, 1.5 * thick], [0.45, thick], [1.0, 0.72 * thick]], 12));
    }
    Object {
        uid: "tree-trunk",
        name: "tree trunk",
        label: "tree-trunk",
        tags: "log;driftwood;wood;natural;debris;snag",
        parts: vec![Part::new("trunk", Material::Wood, solids)],
    }
}

/// A limb with bark ridges along it; `girth` gives its radius over the share of its length.
fn limb(path: &[DVec3], girth: &[[f64; 2]], sides: usize) -> Solid {
    let noise = Noise::of("tree-trunk");
    let last = (path.len() - 1) as f64;
    sweep(path, Path::Open, DVec3::Y, |i| {
        let radius = interpolate(girth, i as f64 / last);
        let rough = |[u, v]: [f64; 2]| {
            let bark = 0.16 * noise.fractal(DVec3::new(2.5 * path[i].x, 2.2 * u, 2.2 * v) + path[i].y, 3)
                + 0.06 * noise.ridged(DVec3::new(1.2 * path[i].x, 5.0 * u, 5.0 * v), 2);
            [radius * u * (1.0 + bark), radius * v * (1.0 + bark)]
        };
        circle(1.0, sides).into_iter().map(rough).collect()
    })
}
