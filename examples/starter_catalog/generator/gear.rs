//! Fishing gear and what falls off boats: lobster pot, bucket.

use glam::DVec3;

use super::curve::{Point, arc, rectangle, spline};
use super::object::{Material, Object, Part};
use super::shape::{Path, cuboid, lathe, plank, rod, sweep, torus, tube};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![lobster_pot(), bucket()]
}

/// A wooden lobster pot, 0.9 × 0.6 × 0.45 m: laths over three bows, netted ends with an entrance ring, two bricks as ballast.
fn lobster_pot() -> Object {
    let (half, radius, straight) = (0.45, 0.29, 0.14);
    let mut arch: Vec<Point> = vec![[radius, 0.02]];
    arch.extend(arc([0.0, straight], radius, [0.0, 180.0], 18));
    arch.push([-radius, 0.02]);
    let bow = |x: f64| {
        let path: Vec<DVec3> = arch.iter().map(|p| DVec3::new(x, p[0], p[1])).collect();
        sweep(&path, Path::Open, DVec3::X, |_| rectangle(0.03, 0.024))
    };
    let mut frame: Vec<Solid> = [-half + 0.02, 0.0, half - 0.02].map(bow).to_vec();
    for x in [-half + 0.02, 0.0, half - 0.02] {
        frame.push(cuboid([0.05, 2.0 * radius + 0.02, 0.035], [x, 0.0, 0.03]));
    }
    let mut laths = Vec::new();
    for i in 0..=12 {
        let p = arc([0.0, straight], radius + 0.018, [-4.0, 184.0], 12)[i];
        let out = DVec3::new(0.0, p[0], p[1] - straight);
        laths.push(plank([-half, p[0], p[1]], [half, p[0], p[1]], out.cross(DVec3::X), [0.042, 0.012]));
    }
    for side in [-1.0, 1.0] {
        laths.push(cuboid([2.0 * half, 0.012, 0.042], [0.0, side * (radius + 0.018), 0.060]));
    }
    for i in -3..=3 {
        laths.push(cuboid([2.0 * half, 0.042, 0.012], [0.0, 0.09 * f64::from(i), 0.006]));
    }
    let net = [-1.0, 1.0].map(|end| netted_end(end * (half - 0.02), [radius, straight])).concat();
    let bricks = [-0.16, 0.16].map(|y| cuboid([0.21, 0.10, 0.065], [0.0, y, 0.045]));
    let bridle = [
        [-0.43, 0.0, 0.44],
        [-0.30, 0.02, 0.53],
        [0.0, 0.04, 0.50],
        [0.22, 0.20, 0.46],
        [0.30, 0.40, 0.20],
        [0.42, 0.52, 0.012],
        [0.62, 0.56, 0.010],
        [0.74, 0.40, 0.010],
    ];
    Object {
        uid: "lobster-pot",
        name: "lobster pot",
        label: "lobster-pot",
        tags: "crab pot;trap;fishing gear;fishing;ghost gear;debris",
        parts: vec![
            Part::new("laths", Material::Wood, laths),
            Part::new("frame", Material::Wood, frame),
            Part::new("net", Material::Rope, net),
            Part::new("bricks", Material::Ceramic, bricks),
            Part::new("bridle", Material::Rope, [tube(&spline(&bridle, 5), 0.008, 6)]),
        ],
    }
}

/// The funnel of netting in the end at `x`, whose arch has this radius over this straight side, inwards to a ring.
fn netted_end(x: f64, [radius, straight]: [f64; 2]) -> Vec<Solid> {
    let rim = |degrees: f64, pieces: usize| arc([0.0, straight], radius, [-degrees, 180.0 + degrees], pieces);
    let hole = |degrees: f64, pieces: usize| arc([0.0, 0.21], 0.085, [-degrees, 180.0 + degrees], pieces);
    let depth = 0.12 * x.signum();
    // A point of the funnel between arch (0) and ring (1); the arch ends at the floor.
    let between = |outer: Point, inner: Point, share: f64| {
        let (from, to) = (DVec3::new(x, outer[0], outer[1].max(0.03)), DVec3::new(x - depth, inner[0], inner[1]));
        from.lerp(to, share)
    };
    let cord = |from: DVec3, to: DVec3| tube(&[from, to], 0.004, 4);
    let sides = rim(20.0, 9).into_iter().zip(hole(20.0, 9));
    let mut net: Vec<Solid> = sides.map(|(a, b)| cord(between(a, b, 0.0), between(a, b, 1.0))).collect();
    for inner in arc([0.0, 0.21], 0.085, [-40.0, -140.0], 3) {
        let outer = [2.3 * inner[0], 0.04];
        net.push(cord(between(outer, inner, 0.0), between(outer, inner, 1.0)));
    }
    for share in [0.30, 0.65] {
        let round: Vec<DVec3> =
            rim(25.0, 14).into_iter().zip(hole(25.0, 14)).map(|(a, b)| between(a, b, share)).collect();
        net.push(tube(&round, 0.004, 4));
    }
    net.push(torus(0.085, 0.014, [24, 6]).turned(Axis::Y, 90.0).at(x - depth, 0.0, 0.21));
    net
}

/// A 12 litre plastic bucket with its wire handle, lying on its side.
fn bucket() -> Object {
    let profile = [
        [0.0, 0.008],
        [0.092, 0.008],
        [0.096, 0.0],
        [0.104, 0.002],
        [0.110, 0.060],
        [0.131, 0.225],
        [0.137, 0.227],
        [0.138, 0.245],
        [0.134, 0.247],
        [0.140, 0.275],
        [0.148, 0.276],
        [0.148, 0.284],
        [0.139, 0.285],
        [0.134, 0.260],
        [0.102, 0.018],
        [0.0, 0.013],
    ];
    let ear = cuboid([0.012, 0.03, 0.04], [0.145, 0.0, 0.235]).mirrored(Axis::X);
    let bail: Vec<DVec3> = arc([0.0, 0.0], 0.152, [0.0, 180.0], 24)
        .into_iter()
        .map(|p| DVec3::new(p[0], 0.94 * p[1], 0.24 + 0.30 * p[1]))
        .collect();
    let grip = rod([-0.045, 0.140, 0.284], [0.045, 0.140, 0.284], 0.011, 12);
    let lying = |solid: Solid| solid.turned(Axis::X, 87.0);
    Object {
        uid: "bucket",
        name: "plastic bucket",
        label: "bucket",
        tags: "pail;debris;litter;container;plastic",
        parts: vec![
            Part::new("bucket", Material::Plastic, [lying(lathe(&profile, 44))]),
            Part::new("ears and grip", Material::Plastic, ear.into_iter().chain([grip]).map(lying).collect::<Vec<_>>()),
            Part::new("handle", Material::Steel, [lying(tube(&bail, 0.003, 6))]),
        ],
    }
}
