//! What goods travel in: a shipping container, a wooden barrel, a chest, a suitcase.

use super::curve::Point;
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{cuboid, rod};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![shipping_container()]
}

/// A sheet of this length along x whose corrugations, of a pitch of 278 mm, go `deep` into +y; `heights` bound it.
fn corrugated(length: f64, deep: f64, heights: [f64; 2]) -> Solid {
    let thick = 0.02;
    let count = (length / 0.278) as usize;
    let pitch = length / count as f64;
    let mut line: Vec<Point> = Vec::new();
    for i in 0..count {
        let from = pitch * i as f64 - length / 2.0;
        line.extend([[0.0, 0.0], [0.25, 0.0], [0.5, deep], [0.75, deep]].map(|[t, y]| [from + t * pitch, y]));
    }
    line.push([length / 2.0, 0.0]);
    let back: Vec<Point> = line.iter().rev().map(|p| [p[0], p[1] + thick]).collect();
    prism(&[line, back].concat(), &[], heights)
}

/// A 20 ft container after ISO 668, 6.058 × 2.438 × 2.591 m: corrugated walls in a frame with corner castings, two door leaves
/// with their locking bars.
fn shipping_container() -> Object {
    let (x, y, z) = (3.029, 1.219, 2.591);
    let mut frame = Vec::new();
    for (sx, sy) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        frame.push(cuboid([0.15, 0.15, z - 0.2], [sx * (x - 0.080), sy * (y - 0.080), z / 2.0]));
        for height in [0.059, z - 0.059] {
            frame.push(cuboid([0.178, 0.162, 0.118], [sx * (x - 0.089), sy * (y - 0.081), height]));
        }
    }
    let rails = [
        cuboid([2.0 * x - 0.3, 0.06, 0.155], [0.0, y - 0.035, 0.105]).mirrored(Axis::Y),
        cuboid([2.0 * x - 0.3, 0.06, 0.06], [0.0, y - 0.035, z - 0.045]).mirrored(Axis::Y),
        cuboid([0.10, 2.0 * y - 0.28, 0.155], [x - 0.055, 0.0, 0.105]).mirrored(Axis::X),
        cuboid([0.08, 2.0 * y - 0.28, 0.11], [x - 0.045, 0.0, z - 0.07]).mirrored(Axis::X),
    ];
    let floor = cuboid([2.0 * x - 0.2, 2.0 * y - 0.1, 0.05], [0.0, 0.0, 0.15]);
    frame.extend(rails.concat());
    frame.push(floor);
    let side = corrugated(2.0 * x - 0.28, 0.036, [0.17, z - 0.06]).at(0.0, -(y - 0.012), 0.0);
    let front = corrugated(2.0 * y - 0.28, 0.045, [0.17, z - 0.11]).turned(Axis::Z, 90.0).at(x - 0.02, 0.0, 0.0);
    let roof = corrugated(2.0 * x - 0.28, 0.02, [-(y - 0.05), y - 0.05]).turned(Axis::X, -90.0).at(0.0, 0.0, z - 0.02);
    let mut walls = side.mirrored(Axis::Y).to_vec();
    walls.extend([front, roof]);
    Object {
        uid: "shipping-container",
        name: "shipping container, 20 ft",
        label: "shipping-container",
        tags: "container;freight container;sea container;cargo;intermodal;harbour",
        parts: vec![
            Part::new("walls", Material::Steel, walls),
            Part::new("frame", Material::Steel, frame),
            Part::new("doors", Material::Steel, container_doors(x, y, z)),
        ],
    }
}

/// Both leaves of the doors at the end at -x, their ribs, hinges, locking bars and handles.
fn container_doors(x: f64, y: f64, z: f64) -> Vec<Solid> {
    let face = -(x - 0.055);
    let half = y - 0.15;
    let mut solids = Vec::new();
    for side in [-1.0, 1.0] {
        let middle = side * half / 2.0;
        solids.push(cuboid([0.04, half - 0.015, z - 0.33], [face + 0.03, middle, z / 2.0 + 0.03]));
        for i in 0..5 {
            let height = 0.42 + 0.44 * f64::from(i);
            solids.push(cuboid([0.03, half - 0.12, 0.22], [face, middle, height]));
        }
        for at in [0.22, 0.80] {
            let bar = side * at * half;
            solids.push(rod([face - 0.025, bar, 0.10], [face - 0.025, bar, z - 0.06], 0.017, 8));
            for height in [0.35, 1.15, 1.95] {
                solids.push(cuboid([0.045, 0.09, 0.07], [face - 0.012, bar, height]));
            }
            solids.push(rod([face - 0.035, bar, 1.0], [face - 0.035, bar - side * 0.38, 0.98], 0.013, 6));
        }
        for i in 0..4 {
            solids.push(cuboid([0.05, 0.06, 0.16], [face, side * (half + 0.01), 0.42 + 0.58 * f64::from(i)]));
        }
    }
    solids
}
