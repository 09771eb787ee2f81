//! Machines that go by themselves under water: a survey vehicle, a glider, a remotely operated vehicle.

use glam::DVec3;

use super::body::wing;
use super::curve::{Point, smooth};
use super::object::{Material, Object, Part};
use super::shape::{cuboid, cylinder, dome, lathe, rod};
use super::solid::{Axis, Solid};
use super::vessels::screw;

pub fn all() -> Vec<Object> {
    vec![auv(), glider()]
}

/// A body turned about x, its nose ahead.
fn along_x(profile: &[Point], around: usize) -> Solid {
    lathe(profile, around).turned(Axis::Y, 90.0)
}

/// A torpedo-shaped survey vehicle, 0.2 × 2.0 m: side-scan strips, Doppler log below, mast above, four fins, one screw.
fn auv() -> Object {
    let radius = 0.100;
    let mut profile: Vec<Point> = vec![[0.0, -0.90], [0.026, -0.90]];
    profile.extend(smooth(&[[0.034, -0.88], [0.058, -0.78], [0.085, -0.64], [radius, -0.48]], 3));
    for joint in [-0.30, 0.28, 0.62] {
        profile.extend([
            [radius, joint - 0.008],
            [radius - 0.003, joint - 0.005],
            [radius - 0.003, joint + 0.005],
            [radius, joint + 0.008],
        ]);
    }
    profile.extend(dome(radius, 0.80, 0.17, 7));
    let fins = wing([0.15, 0.018], [0.10, 0.010], DVec3::new(-0.68, 0.0, 0.05), DVec3::new(-0.71, 0.0, 0.175));
    let fins: Vec<Solid> = (0..4).map(|i| fins.clone().turned(Axis::X, 45.0 + 90.0 * f64::from(i))).collect();
    let blades: Vec<Solid> = screw(0.085, 0.024, 0.14, 3, 6)
        .into_iter()
        .map(|blade| blade.turned(Axis::Y, 90.0).at(-0.945, 0.0, 0.0))
        .collect();
    let hub = along_x(&[[0.0, -1.0], [0.012, -0.99], [0.024, -0.96], [0.026, -0.895], [0.0, -0.895]], 16);
    let strips = cuboid([0.50, 0.02, 0.035], [0.0, 0.096, -0.03]).mirrored(Axis::Y);
    let log: Vec<Solid> = [[0.40, 0.035], [0.40, -0.035], [0.47, 0.035], [0.47, -0.035]]
        .map(|[x, y]| cylinder(0.026, [-0.112, -0.06], 14).at(x, y, 0.0))
        .into();
    let mast = wing([0.11, 0.03], [0.07, 0.02], DVec3::new(0.14, 0.0, 0.09), DVec3::new(0.11, 0.0, 0.26));
    let handle = [
        rod([0.50, 0.0, 0.08], [0.50, 0.0, 0.135], 0.009, 8),
        rod([0.70, 0.0, 0.06], [0.70, 0.0, 0.135], 0.009, 8),
        rod([0.49, 0.0, 0.135], [0.71, 0.0, 0.135], 0.010, 8),
    ];
    Object {
        uid: "auv",
        name: "torpedo-shaped survey AUV, 2 m",
        label: "auv",
        tags: "autonomous underwater vehicle;survey vehicle;robot;underwater robot;vehicle",
        parts: vec![
            Part::new("hull", Material::Aluminium, [along_x(&profile, 36)]),
            Part::new("fins and mast", Material::Plastic, [fins, vec![mast]].concat()),
            Part::new("screw", Material::Plastic, [blades, vec![hub]].concat()),
            Part::new("transducers", Material::Ceramic, [strips.to_vec(), log].concat()),
            Part::new("handle", Material::Steel, handle),
        ],
    }
}

/// A buoyancy-driven glider, 1.8 m with its antenna, wings of 1.0 m swept back.
fn glider() -> Object {
    let radius = 0.11;
    let mut hull: Vec<Point> = vec![[0.0, -0.42], [radius - 0.004, -0.42], [radius, -0.416]];
    for joint in [-0.12, 0.20] {
        hull.extend([
            [radius, joint - 0.008],
            [radius - 0.003, joint - 0.005],
            [radius - 0.003, joint + 0.005],
            [radius, joint + 0.008],
        ]);
    }
    hull.extend([[radius, 0.446], [radius - 0.004, 0.45], [0.0, 0.45]]);
    let mut nose: Vec<Point> = vec![[0.0, 0.44], [radius, 0.44]];
    nose.extend(smooth(&[[0.108, 0.50], [0.094, 0.60], [0.066, 0.68], [0.030, 0.722]], 3));
    nose.push([0.0, 0.73]);
    let mut tail: Vec<Point> = vec![[0.0, -0.80], [0.024, -0.80]];
    tail.extend(smooth(&[[0.032, -0.78], [0.058, -0.68], [0.090, -0.54], [radius, -0.42]], 3));
    tail.push([0.0, -0.41]);
    let wings =
        wing([0.16, 0.012], [0.10, 0.006], DVec3::new(0.06, 0.09, 0.0), DVec3::new(-0.36, 0.50, 0.0)).mirrored(Axis::Y);
    let fin = wing([0.20, 0.025], [0.13, 0.014], DVec3::new(-0.62, 0.0, 0.02), DVec3::new(-0.70, 0.0, 0.24));
    let boom = rod([-0.78, 0.0, 0.0], [-1.07, 0.0, 0.03], 0.012, 10);
    let sensor = cuboid([0.22, 0.035, 0.06], [0.12, 0.0, -0.12]);
    Object {
        uid: "glider",
        name: "underwater glider, 1.8 m",
        label: "auv",
        tags: "underwater glider;glider;autonomous underwater vehicle;profiler;ocean glider;robot;vehicle",
        parts: vec![
            Part::new("hull", Material::Aluminium, [along_x(&hull, 36)]),
            Part::new("nose and tail", Material::Plastic, [along_x(&nose, 36), along_x(&tail, 36)]),
            Part::new("wings", Material::Plastic, wings),
            Part::new("tail fin", Material::Plastic, [fin]),
            Part::new("antenna, sensor", Material::Plastic, [boom, sensor]),
        ],
    }
}
