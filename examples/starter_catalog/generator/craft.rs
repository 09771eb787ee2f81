//! What drove or flew before it sank: a car, a helicopter.

use glam::DVec3;

use super::body::{body, fin, wing};
use super::curve::{Point, arc, interpolate, rounded_rectangle, spline};
use super::object::{Material, Object, Part};
use super::shape::{capped, cuboid, cylinder, lathe, plank, rod, tube};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![car(), helicopter()]
}

/// Half of the distance between the axles, and the height of the wheels' axes.
const AXLES: f64 = 1.33;
const HUB: f64 = 0.315;

/// A saloon, 4.5 × 1.78 × 1.45 m, on its wheels.
fn car() -> Object {
    let roof = level_box([-1.02, 0.14, 0.555], 1.405);
    let roof = capped(&[roof, level_box([-1.04, 0.16, 0.56], 1.425), level_box([-0.98, 0.08, 0.50], 1.45)]);
    let pillars: Vec<Solid> =
        [[0.98, 0.76, 0.92, 0.14, 0.53], [-1.72, 0.74, 0.98, -1.02, 0.53], [-0.33, 0.77, 0.94, -0.36, 0.545]]
            .into_iter()
            .flat_map(|[x, y, z, x_top, y_top]| rod([x, y, z], [x_top, y_top, 1.415], 0.035, 6).mirrored(Axis::Y))
            .collect();
    let mirrors = cuboid([0.10, 0.20, 0.12], [0.72, 0.93, 1.0]).mirrored(Axis::Y);
    let bumpers = [
        cuboid([0.10, 1.34, 0.20], [2.24, 0.0, 0.42]),
        cuboid([0.10, 1.40, 0.22], [-2.24, 0.0, 0.45]),
        cuboid([0.03, 0.52, 0.11], [-2.27, 0.0, 0.72]),
    ];
    let lights = [
        cuboid([0.06, 0.34, 0.13], [2.19, 0.50, 0.67]).mirrored(Axis::Y),
        cuboid([0.06, 0.28, 0.14], [-2.23, 0.52, 0.80]).mirrored(Axis::Y),
    ];
    let below = [
        rod([-AXLES, -0.75, HUB], [-AXLES, 0.75, HUB], 0.05, 8),
        rod([AXLES, -0.75, HUB], [AXLES, 0.75, HUB], 0.05, 8),
        rod([-2.2, 0.45, 0.22], [0.9, 0.30, 0.22], 0.035, 8),
        cylinder(0.10, [-0.35, 0.35], 12).turned(Axis::Y, 90.0).at(-1.75, 0.45, 0.24),
    ];
    let (tyres, rims): (Vec<Solid>, Vec<Solid>) = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .into_iter()
        .map(|(ahead, side)| {
            let place = |solid: Solid| solid.turned(Axis::X, -90.0 * side).at(ahead * AXLES, side * 0.76, HUB);
            let tyre = [
                [0.0, -0.10],
                [0.29, -0.10],
                [0.315, -0.075],
                [0.315, 0.075],
                [0.295, 0.10],
                [0.215, 0.105],
                [0.205, 0.085],
                [0.0, 0.08],
            ];
            let rim = [[0.0, 0.07], [0.20, 0.07], [0.20, 0.095], [0.17, 0.085], [0.06, 0.10], [0.0, 0.11]];
            (place(lathe(&tyre, 32)), place(lathe(&rim, 24)))
        })
        .unzip();
    Object {
        uid: "car",
        name: "saloon car, 4.5 m",
        label: "car",
        tags: "sedan;saloon;automobile;vehicle;road vehicle;wreck",
        parts: vec![
            Part::new("body", Material::Steel, [car_body()]),
            Part::new("windows", Material::Glass, [car_windows()]),
            Part::new("roof, pillars, axles", Material::Steel, [vec![roof], pillars, below.into()].concat()),
            Part::new("bumpers, mirrors", Material::Plastic, [bumpers.to_vec(), mirrors.into()].concat()),
            Part::new("lights", Material::Glass, lights.concat()),
            Part::new("tyres", Material::Rubber, tyres),
            Part::new("rims", Material::Aluminium, rims),
        ],
    }
}

/// Bonnet, sides with their wheel arches, and boot, up to the line below the windows.
fn car_body() -> Solid {
    let arch = |x: f64| arc([x, HUB], 0.375, [189.0, -9.0], 12);
    let mut outline: Vec<Point> = vec![[-2.18, 0.28]];
    outline.extend(arch(-AXLES));
    outline.extend([[-0.5, 0.20], [0.5, 0.20]]);
    outline.extend(arch(AXLES));
    outline.extend([
        [2.10, 0.26],
        [2.24, 0.34],
        [2.26, 0.58],
        [2.20, 0.72],
        [1.9, 0.80],
        [1.4, 0.88],
        [1.0, 0.94],
        [0.4, 0.955],
    ]);
    outline.extend([[-0.6, 0.975], [-1.7, 1.01], [-2.12, 1.01], [-2.22, 0.90], [-2.26, 0.60], [-2.24, 0.36]]);
    fin(&outline, 1.78).mapped(|p| {
        let plan = interpolate(&[[-2.26, 0.82], [-1.9, 0.95], [-1.2, 1.0], [1.2, 1.0], [1.9, 0.92], [2.26, 0.74]], p.x);
        let side = interpolate(&[[0.2, 0.93], [0.45, 1.0], [0.75, 0.99], [1.01, 0.90]], p.z);
        DVec3::new(p.x, p.y * plan * side, p.z)
    })
}

/// A level outline with rounded corners: from, to, half width.
fn level_box([from, to, half]: [f64; 3], z: f64) -> Vec<DVec3> {
    let outline = rounded_rectangle(to - from, 2.0 * half, 0.10, 3);
    outline.into_iter().map(|[x, y]| DVec3::new(x + (from + to) / 2.0, y, z)).collect()
}

fn car_windows() -> Solid {
    capped(&[
        level_box([-1.82, 1.08, 0.78], 0.92),
        level_box([-1.74, 0.96, 0.765], 0.98),
        level_box([-1.36, 0.54, 0.66], 1.20),
        level_box([-1.02, 0.14, 0.55], 1.41),
    ])
}

/// A light helicopter, 9.3 m body with a two-bladed rotor of 10 m, on its skids, one blade bent down.
fn helicopter() -> Object {
    let cabin = body(
        &[
            [2.55, 0.10, 0.10, 1.05],
            [2.40, 0.34, 0.30, 1.06],
            [1.95, 0.56, 0.52, 1.12],
            [1.30, 0.66, 0.68, 1.20],
            [0.40, 0.67, 0.72, 1.24],
            [-0.50, 0.60, 0.64, 1.30],
            [-1.20, 0.40, 0.44, 1.42],
            [-1.80, 0.24, 0.25, 1.52],
            [-3.50, 0.18, 0.18, 1.60],
            [-5.60, 0.11, 0.11, 1.68],
            [-6.05, 0.09, 0.09, 1.70],
        ],
        3,
        22,
    );
    let cowling = body(
        &[
            [0.95, 0.10, 0.08, 1.98],
            [0.75, 0.30, 0.22, 2.00],
            [0.0, 0.36, 0.30, 2.02],
            [-0.8, 0.30, 0.24, 1.98],
            [-1.5, 0.12, 0.08, 1.80],
        ],
        3,
        16,
    );
    let canopy = body(
        &[
            [2.44, 0.20, 0.16, 1.22],
            [2.28, 0.42, 0.34, 1.22],
            [1.95, 0.575, 0.46, 1.26],
            [1.45, 0.66, 0.52, 1.36],
            [1.10, 0.60, 0.45, 1.42],
        ],
        3,
        20,
    );
    let upright = fin(
        &[[-5.55, 1.70], [-5.95, 2.65], [-6.30, 2.70], [-6.15, 1.72], [-6.35, 1.10], [-6.05, 1.06], [-5.80, 1.62]],
        0.07,
    );
    let level =
        wing([0.42, 0.05], [0.36, 0.03], DVec3::new(-4.2, 0.05, 1.66), DVec3::new(-4.2, 0.95, 1.66)).mirrored(Axis::Y);
    let exhaust = rod([-0.75, 0.12, 2.1], [-1.05, 0.2, 2.38], 0.10, 10).mirrored(Axis::Y);
    Object {
        uid: "helicopter",
        name: "light helicopter, 9 m",
        label: "helicopter",
        tags: "chopper;rotorcraft;aircraft wreck;wreck;vehicle",
        parts: vec![
            Part::new(
                "body",
                Material::Aluminium,
                [cabin, cowling, upright].into_iter().chain(level).collect::<Vec<_>>(),
            ),
            Part::new("canopy", Material::Glass, [canopy]),
            Part::new("rotors", Material::Aluminium, rotors()),
            Part::new("skids", Material::Aluminium, skids()),
            Part::new("exhausts", Material::Steel, exhaust),
        ],
    }
}

/// Mast, main rotor with its bent blade, tail rotor.
fn rotors() -> Vec<Solid> {
    let mast = [
        cylinder(0.06, [2.1, 2.78], 12),
        cylinder(0.17, [2.66, 2.80], 16),
        rod([0.0, -0.45, 2.72], [0.0, 0.45, 2.72], 0.07, 8),
    ];
    let blade = |turn: f64, drop: f64| {
        let rings: Vec<Vec<DVec3>> = (0..=8)
            .map(|i| 0.4 + 0.58 * f64::from(i))
            .map(|out| {
                let z = 2.72 - drop * (out - 0.4) * (out - 0.4);
                [[0.10, 0.0], [0.0, 0.03], [-0.22, 0.0], [0.0, -0.02]].map(|[x, h]| DVec3::new(x, out, z + h)).to_vec()
            })
            .collect();
        capped(&rings).turned(Axis::Z, turn)
    };
    let tail_rotor: Vec<Solid> = [35.0, 215.0]
        .map(|a| {
            plank([0.0, 0.16, 0.05], [0.0, 0.16, 0.82], DVec3::X, [0.13, 0.025]).turned(Axis::Y, a).at(-5.98, 0.0, 1.95)
        })
        .into();
    [mast.to_vec(), vec![blade(62.0, 0.0), blade(242.0, 0.085)], tail_rotor].concat()
}

fn skids() -> Vec<Solid> {
    let skids = tube(
        &spline(
            &[[-1.45, 0.92, 0.05], [0.2, 0.92, 0.05], [1.4, 0.92, 0.06], [1.75, 0.92, 0.16], [1.92, 0.92, 0.30]],
            3,
        ),
        0.05,
        8,
    );
    let legs: Vec<Solid> = [-0.75, 0.95]
        .into_iter()
        .flat_map(|x| {
            tube(&spline(&[[x, 0.30, 0.66], [x, 0.62, 0.56], [x, 0.85, 0.25], [x, 0.92, 0.05]], 2), 0.04, 8)
                .mirrored(Axis::Y)
        })
        .collect();
    [skids.mirrored(Axis::Y).to_vec(), legs].concat()
}
