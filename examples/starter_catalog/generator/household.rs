//! Household things that people throw into the water: furniture, sanitary ware, appliances.

use glam::DVec3;

use super::curve::{Point, arc, ellipse, rounded_rectangle, spline};
use super::object::{Material, Object, Part};
use super::shape::{capped, cuboid, cylinder, lathe, lathe_ring, plank, rod, torus, tube};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![chair(), table(), bathtub(), toilet(), washing_machine(), refrigerator()]
}

/// A level ring of points about (x, y) at height z.
fn level(outline: &[Point], [x, y, z]: [f64; 3]) -> Vec<DVec3> {
    outline.iter().map(|p| DVec3::new(p[0] + x, p[1] + y, z)).collect()
}

/// A wooden kitchen chair, 0.9 m high, fallen on its back.
fn chair() -> Object {
    let seat = |grow: f64, z: f64| level(&rounded_rectangle(0.43 + grow, 0.43 + grow, 0.04, 3), [0.0, 0.0, z]);
    let seat = capped(&[seat(-0.01, 0.44), seat(0.0, 0.446), seat(0.0, 0.46), seat(-0.01, 0.466)]);
    let legs =
        [[0.18, 0.18], [0.18, -0.18]].map(|[x, y]| plank([x + 0.01, y, 0.0], [x, y, 0.45], DVec3::X, [0.038, 0.038]));
    let posts = [0.18, -0.18].map(|y| {
        let line = [[-0.22, y, 0.0], [-0.185, y, 0.25], [-0.18, y, 0.46], [-0.20, y, 0.68], [-0.25, y, 0.90]];
        tube(&spline(&line, 3), 0.021, 8)
    });
    let rungs = [
        rod([0.185, 0.18, 0.16], [-0.20, 0.18, 0.16], 0.012, 8),
        rod([0.185, -0.18, 0.16], [-0.20, -0.18, 0.16], 0.012, 8),
        rod([0.183, 0.18, 0.24], [0.183, -0.18, 0.24], 0.012, 8),
        rod([-0.187, 0.18, 0.24], [-0.187, -0.18, 0.24], 0.012, 8),
    ];
    let back = [[-0.200, 0.66], [-0.215, 0.76], [-0.24, 0.86]]
        .map(|[x, z]| plank([x, -0.18, z], [x, 0.18, z], DVec3::X, [0.018, 0.062]));
    let fallen = |solid: Solid| solid.turned(Axis::Y, -92.0);
    Object {
        uid: "chair",
        name: "wooden chair, fallen over",
        label: "chair",
        tags: "kitchen chair;furniture;household;litter",
        parts: vec![
            Part::new(
                "legs and back",
                Material::Wood,
                legs.into_iter().chain(posts).chain(rungs).chain(back).map(fallen).collect::<Vec<_>>(),
            ),
            Part::new("seat", Material::Wood, [fallen(seat)]),
        ],
    }
}

/// A table, 1.2 × 0.75 × 0.74 m: turned legs, aprons, boards.
fn table() -> Object {
    let boards = (0..5).map(|i| cuboid([1.2, 0.147, 0.028], [0.0, -0.30 + 0.15 * f64::from(i), 0.726]));
    let battens = [-0.45, 0.45].map(|x| cuboid([0.06, 0.66, 0.03], [x, 0.0, 0.70]));
    let aprons = [
        cuboid([1.0, 0.022, 0.10], [0.0, 0.31, 0.66]).mirrored(Axis::Y),
        cuboid([0.022, 0.62, 0.10], [0.53, 0.0, 0.66]).mirrored(Axis::X),
    ];
    let turned = [
        [0.0, 0.0],
        [0.020, 0.0],
        [0.026, 0.03],
        [0.022, 0.06],
        [0.024, 0.30],
        [0.032, 0.46],
        [0.022, 0.50],
        [0.034, 0.54],
        [0.034, 0.712],
        [0.0, 0.712],
    ];
    let legs =
        [[0.53, 0.31], [0.53, -0.31], [-0.53, 0.31], [-0.53, -0.31]].map(|[x, y]| lathe(&turned, 14).at(x, y, 0.0));
    Object {
        uid: "table",
        name: "wooden table",
        label: "table",
        tags: "kitchen table;desk;furniture;household;litter",
        parts: vec![
            Part::new("boards", Material::Wood, boards.chain(battens).chain(aprons.concat()).collect::<Vec<_>>()),
            Part::new("legs", Material::Wood, legs),
        ],
    }
}

/// An enamelled bathtub, 1.7 × 0.75 × 0.58 m, hollow, on four feet.
fn bathtub() -> Object {
    let oval = |length: f64, width: f64, x: f64, z: f64| {
        level(&rounded_rectangle(length, width, 0.46 * width, 7), [x, 0.0, z])
    };
    let shell = capped(&[
        oval(1.20, 0.44, -0.03, 0.11),
        oval(1.34, 0.56, -0.02, 0.16),
        oval(1.46, 0.63, -0.01, 0.30),
        oval(1.56, 0.67, 0.0, 0.50),
        oval(1.68, 0.74, 0.0, 0.545),
        oval(1.70, 0.75, 0.0, 0.56),
        oval(1.68, 0.74, 0.0, 0.575),
        oval(1.56, 0.63, 0.0, 0.565),
        oval(1.48, 0.59, 0.0, 0.50),
        oval(1.38, 0.55, -0.01, 0.30),
        oval(1.24, 0.47, -0.02, 0.17),
        oval(1.10, 0.34, -0.03, 0.135),
    ]);
    let feet = [[0.44, 0.18], [0.44, -0.18], [-0.50, 0.18], [-0.50, -0.18]].map(|[x, y]| {
        lathe(&[[0.0, 0.0], [0.035, 0.0], [0.040, 0.02], [0.025, 0.06], [0.05, 0.14], [0.0, 0.15]], 12).at(x, y, 0.0)
    });
    let drain =
        [cylinder(0.03, [0.05, 0.13], 12).at(0.40, 0.0, 0.0), rod([0.40, 0.0, 0.07], [0.40, -0.24, 0.07], 0.02, 10)];
    Object {
        uid: "bathtub",
        name: "bathtub",
        label: "bathtub",
        tags: "bath;tub;household;sanitary;litter",
        parts: vec![
            Part::new("tub", Material::Ceramic, [shell]),
            Part::new("feet and drain", Material::Iron, feet.into_iter().chain(drain).collect::<Vec<_>>()),
        ],
    }
}

/// A ceramic toilet with its seat and cistern, 0.78 m high, upright.
fn toilet() -> Object {
    let oval = |length: f64, width: f64, x: f64, z: f64| level(&ellipse(length / 2.0, width / 2.0, 32), [x, 0.0, z]);
    let bowl = capped(&[
        oval(0.40, 0.22, -0.02, 0.0),
        oval(0.38, 0.21, -0.02, 0.03),
        oval(0.32, 0.19, -0.03, 0.16),
        oval(0.42, 0.30, 0.03, 0.30),
        oval(0.49, 0.36, 0.07, 0.385),
        oval(0.48, 0.355, 0.07, 0.40),
        oval(0.36, 0.25, 0.08, 0.395),
        oval(0.32, 0.21, 0.07, 0.33),
        oval(0.18, 0.12, 0.03, 0.22),
    ]);
    let shelf = cuboid([0.20, 0.34, 0.06], [-0.24, 0.0, 0.37]);
    let tank = |x: f64, y: f64, z: f64| level(&rounded_rectangle(x, y, 0.03, 3), [-0.29, 0.0, z]);
    let tank = [
        capped(&[tank(0.16, 0.36, 0.39), tank(0.18, 0.40, 0.44), tank(0.19, 0.42, 0.74)]),
        capped(&[tank(0.21, 0.44, 0.738), tank(0.21, 0.44, 0.765), tank(0.18, 0.41, 0.775)]),
    ];
    let seat = torus(1.0, 0.36, [32, 8]).mapped(|p| DVec3::new(0.07 + 0.20 * p.x, 0.155 * p.y, 0.413 + 0.07 * p.z));
    let button = cylinder(0.02, [0.765, 0.785], 14).at(-0.29, 0.0, 0.0);
    Object {
        uid: "toilet",
        name: "toilet with cistern",
        label: "toilet",
        tags: "lavatory;wc;household;sanitary;litter",
        parts: vec![
            Part::new("bowl", Material::Ceramic, [bowl, shelf]),
            Part::new("cistern", Material::Ceramic, tank),
            Part::new("seat and button", Material::Plastic, [seat, button]),
        ],
    }
}

/// A front-loading washing machine, 0.60 × 0.58 × 0.85 m.
fn washing_machine() -> Object {
    let outline = rounded_rectangle(0.56, 0.60, 0.02, 2);
    let small: Vec<Point> = outline.iter().map(|p| [0.96 * p[0], 0.96 * p[1]]).collect();
    let case = capped(&[
        level(&outline, [0.0, 0.0, 0.02]),
        level(&outline, [0.0, 0.0, 0.40]),
        level(&outline, [0.0, 0.0, 0.82]),
    ]);
    let top = capped(&[
        level(&outline, [0.0, 0.0, 0.822]),
        level(&outline, [0.0, 0.0, 0.84]),
        level(&small, [0.0, 0.0, 0.85]),
    ]);
    let ring =
        lathe_ring(&[[0.155, 0.27], [0.20, 0.27], [0.20, 0.305], [0.185, 0.325], [0.165, 0.325], [0.155, 0.305]], 40);
    let glass = lathe(&[[0.0, 0.26], [0.16, 0.26], [0.16, 0.30], [0.10, 0.31], [0.0, 0.315]], 32);
    let to_front = |solid: Solid| solid.turned(Axis::Y, 90.0).at(0.0, 0.0, 0.44);
    let panel = cuboid([0.02, 0.56, 0.10], [0.285, 0.0, 0.755]);
    let drawer = cuboid([0.02, 0.16, 0.07], [0.296, -0.18, 0.755]);
    let knob = lathe(&[[0.0, 0.29], [0.032, 0.29], [0.028, 0.325], [0.0, 0.328]], 18)
        .turned(Axis::Y, 90.0)
        .at(0.0, 0.02, 0.755);
    let plinth = cuboid([0.02, 0.54, 0.07], [0.282, 0.0, 0.06]);
    let feet = [[0.23, 0.25], [0.23, -0.25], [-0.23, 0.25], [-0.23, -0.25]]
        .map(|[x, y]| cylinder(0.022, [0.0, 0.03], 10).at(x, y, 0.0));
    let hose = tube(
        &spline(
            &[
                [-0.27, 0.2, 0.7],
                [-0.34, 0.2, 0.72],
                [-0.36, 0.17, 0.5],
                [-0.35, 0.10, 0.2],
                [-0.42, 0.0, 0.02],
                [-0.60, -0.12, 0.015],
            ],
            5,
        ),
        0.014,
        8,
    );
    Object {
        uid: "washing-machine",
        name: "washing machine",
        label: "washing-machine",
        tags: "washer;appliance;household;white goods;litter",
        parts: vec![
            Part::new("case", Material::Steel, [case, top]),
            Part::new("door", Material::Plastic, [to_front(ring), panel, drawer, knob, plinth]),
            Part::new("glass", Material::Glass, [to_front(glass)]),
            Part::new("feet and hose", Material::Rubber, feet.into_iter().chain([hose]).collect::<Vec<_>>()),
        ],
    }
}

/// A refrigerator with a freezer, 0.60 × 0.62 × 1.75 m, fallen on its back, one door ajar.
fn refrigerator() -> Object {
    let outline = rounded_rectangle(0.56, 0.60, 0.02, 2);
    let wall =
        |height: [f64; 2]| capped(&[level(&outline, [0.0, 0.0, height[0]]), level(&outline, [0.0, 0.0, height[1]])]);
    let leaf = |low: f64, high: f64| {
        let section = |x: f64, shrink: f64| {
            let outline = rounded_rectangle(0.60 - shrink, high - low - shrink, 0.02, 2);
            outline.iter().map(|p| DVec3::new(x, p[0], p[1] + (low + high) / 2.0)).collect::<Vec<_>>()
        };
        capped(&[section(0.0, 0.0), section(0.045, 0.0), section(0.06, 0.03)])
    };
    // The hinges are at +y; the lower door stands 35 degrees open.
    let upper = leaf(1.22, 1.74).at(0.285, 0.0, 0.0);
    let lower = leaf(0.08, 1.205).at(0.0, -0.30, 0.0).turned(Axis::Z, 35.0).at(0.285, 0.30, 0.0);
    let grip = |z: [f64; 2]| {
        let line = arc([0.0, 0.0], 0.04, [-80.0, 80.0], 4);
        let middle = (z[0] + z[1]) / 2.0;
        let points: Vec<DVec3> =
            line.into_iter().map(|[x, u]| DVec3::new(x, 0.0, middle + u / 0.04 * (z[1] - z[0]) / 2.0)).collect();
        tube(&points, 0.010, 8)
    };
    let handles = [
        grip([1.26, 1.50]).at(0.335, -0.27, 0.0),
        grip([0.75, 1.15]).at(0.05, -0.57, 0.0).turned(Axis::Z, 35.0).at(0.285, 0.30, 0.0),
    ];
    let compressor = [
        lathe(&[[0.0, 0.03], [0.09, 0.04], [0.10, 0.10], [0.09, 0.17], [0.0, 0.20]], 20).at(-0.18, 0.05, 0.0),
        cuboid([0.02, 0.54, 0.04], [-0.285, 0.0, 0.14]),
    ];
    let coil: Vec<Solid> = (0..14)
        .map(|i| rod([-0.292, -0.25, 0.35 + 0.09 * f64::from(i)], [-0.292, 0.25, 0.35 + 0.09 * f64::from(i)], 0.005, 6))
        .collect();
    let shelf = [0.45, 0.80, 1.05].map(|z| cuboid([0.03, 0.52, 0.012], [0.29, 0.0, z]));
    let fallen = |solid: Solid| solid.turned(Axis::Y, -90.0);
    Object {
        uid: "refrigerator",
        name: "refrigerator, fallen over",
        label: "refrigerator",
        tags: "fridge;freezer;appliance;household;white goods;litter",
        parts: vec![
            Part::new(
                "case",
                Material::Steel,
                [wall([0.20, 1.75]), wall([0.0, 0.03]), cuboid([0.42, 0.58, 0.2], [0.06, 0.0, 0.115])].map(fallen),
            ),
            Part::new("doors", Material::Steel, [upper, lower].map(fallen)),
            Part::new(
                "handles, shelves",
                Material::Plastic,
                handles.into_iter().chain(shelf).map(fallen).collect::<Vec<_>>(),
            ),
            Part::new(
                "compressor and coil",
                Material::Steel,
                compressor.into_iter().chain(coil).map(fallen).collect::<Vec<_>>(),
            ),
        ],
    }
}
