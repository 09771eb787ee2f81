//! Second kinds of containers, so that one label is more than one shape: pail, crates, drum, bottles, amphora, cylinder.

use glam::DVec3;

use super::curve::{Point, arc, ellipse, rounded_rectangle, smooth, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Path, capped, cuboid, cylinder, dome, lathe, sweep, torus, tube};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![
        beer_bottle(),
        zinc_bucket(),
        fish_crate(),
        round_amphora(),
        gas_cylinder(),
        pallet(),
        plastic_drum(),
        jerrycan(),
    ]
}

/// Along x instead of upright.
fn lying(solid: Solid) -> Solid {
    solid.turned(Axis::Y, 90.0)
}

/// A long-necked beer bottle, 61 × 230 mm, open and hollow, on its side.
fn beer_bottle() -> Object {
    let mut profile = vec![[0.0, 0.008], [0.018, 0.006], [0.024, 0.0], [0.029, 0.002], [0.0305, 0.008]];
    profile.extend(smooth(&[[0.0305, 0.120], [0.0290, 0.138], [0.0210, 0.165], [0.0155, 0.190], [0.0138, 0.212]], 3));
    profile.extend([[0.0155, 0.214], [0.0155, 0.220], [0.0130, 0.222], [0.0130, 0.230], [0.0095, 0.230]]);
    profile.extend([[0.0095, 0.205], [0.0130, 0.186], [0.0185, 0.162], [0.0265, 0.136], [0.0280, 0.120]]);
    profile.extend([[0.0280, 0.010], [0.0, 0.013]]);
    Object {
        uid: "beer-bottle",
        name: "beer bottle",
        label: "bottle",
        tags: "glass bottle;beer bottle;debris;litter;container",
        parts: vec![Part::new("bottle", Material::Glass, [lying(lathe(&profile, 32))])],
    }
}

/// A zinc pail of 12 l with its bail folded to one side, upright.
fn zinc_bucket() -> Object {
    let profile = [
        [0.0, 0.012],
        [0.098, 0.012],
        [0.102, 0.0],
        [0.110, 0.002],
        [0.113, 0.020],
        [0.128, 0.120],
        [0.131, 0.122],
        [0.132, 0.132],
        [0.129, 0.134],
        [0.146, 0.268],
        [0.152, 0.270],
        [0.152, 0.280],
        [0.145, 0.280],
        [0.142, 0.262],
        [0.108, 0.020],
        [0.0, 0.017],
    ];
    let ear = cuboid([0.010, 0.034, 0.045], [0.150, 0.0, 0.255]).mirrored(Axis::X);
    let bail: Vec<DVec3> = arc([0.0, 0.0], 0.158, [0.0, 180.0], 24)
        .into_iter()
        .map(|p| DVec3::new(p[0], 0.93 * p[1], 0.262 + 0.12 * p[1]))
        .collect();
    Object {
        uid: "bucket-zinc",
        name: "zinc bucket",
        label: "bucket",
        tags: "pail;metal bucket;debris;litter;container",
        parts: vec![
            Part::new("bucket", Material::Steel, [lathe(&profile, 44)]),
            Part::new("ears", Material::Steel, ear),
            Part::new("bail", Material::Steel, [tube(&bail, 0.003, 6)]),
        ],
    }
}

/// A plastic fish crate, 800 × 450 × 200 mm: open above, ribbed, with hand holds.
fn fish_crate() -> Object {
    let (x, y, z, wall) = (0.40, 0.225, 0.20, 0.008);
    let hold = |at: f64| -> Vec<Point> {
        rounded_rectangle(0.12, 0.035, 0.012, 3).iter().map(|p| [p[0], p[1] + at]).collect()
    };
    let end = prism(&[[-y, 0.0], [y, 0.0], [y, z], [-y, z]], &[hold(0.15)], [-wall / 2.0, wall / 2.0])
        .turned(Axis::X, 90.0)
        .turned(Axis::Z, 90.0);
    let ends = [-1.0, 1.0].map(|side| end.clone().at(side * (x - wall), 0.0, 0.0));
    let sides = cuboid([2.0 * x, wall, z], [0.0, y - wall, z / 2.0]).mirrored(Axis::Y);
    let ribs = (0..7)
        .flat_map(|i| cuboid([0.012, 0.012, z - 0.03], [-0.33 + 0.11 * f64::from(i), y, z / 2.0]).mirrored(Axis::Y));
    let rim = [
        cuboid([2.0 * x + 0.03, 0.024, 0.016], [0.0, y, z]).mirrored(Axis::Y),
        cuboid([0.024, 2.0 * y, 0.016], [x, 0.0, z]).mirrored(Axis::X),
    ];
    let floor = [cuboid([2.0 * x - 0.02, 2.0 * y - 0.02, wall], [0.0, 0.0, 0.016])];
    let feet = (0..3).map(|i| cuboid([0.04, 2.0 * y - 0.06, 0.014], [-0.3 + 0.3 * f64::from(i), 0.0, 0.007]));
    Object {
        uid: "fish-crate",
        name: "plastic fish crate",
        label: "crate",
        tags: "fish box;plastic crate;fishing;debris;container",
        parts: vec![
            Part::new("walls", Material::Plastic, ends.into_iter().chain(sides).collect::<Vec<_>>()),
            Part::new("ribs", Material::Plastic, ribs.collect::<Vec<_>>()),
            Part::new("rim", Material::Plastic, rim.concat()),
            Part::new("floor", Material::Plastic, floor.into_iter().chain(feet).collect::<Vec<_>>()),
        ],
    }
}

/// A Roman oil amphora after Dressel 20: a globe of 0.6 m with a short neck and two handles; open, on its side.
fn round_amphora() -> Object {
    let outer = [
        [0.030, 0.004],
        [0.100, 0.040],
        [0.200, 0.120],
        [0.275, 0.250],
        [0.290, 0.380],
        [0.240, 0.520],
        [0.150, 0.600],
        [0.085, 0.635],
        [0.070, 0.680],
    ];
    let inner = [
        [0.052, 0.680],
        [0.062, 0.640],
        [0.130, 0.590],
        [0.215, 0.510],
        [0.262, 0.380],
        [0.246, 0.250],
        [0.120, 0.080],
    ];
    let mut profile = vec![[0.0, 0.0]];
    profile.extend(smooth(&outer, 3));
    profile.extend([[0.082, 0.690], [0.092, 0.710], [0.084, 0.728], [0.066, 0.728]]);
    profile.extend(smooth(&inner, 2));
    profile.push([0.0, 0.040]);
    let handle =
        [[0.060, 0.0, 0.700], [0.110, 0.0, 0.712], [0.165, 0.0, 0.690], [0.185, 0.0, 0.630], [0.170, 0.0, 0.570]];
    let handle = sweep(&spline(&handle, 4), Path::Open, DVec3::Y, |_| ellipse(0.026, 0.022, 12));
    let turned = |solid: Solid| lying(solid).turned(Axis::X, 90.0);
    Object {
        uid: "amphora-globular",
        name: "globular oil amphora",
        label: "amphora",
        tags: "jar;pottery;archaeology;wreck;container",
        parts: vec![
            Part::new("body", Material::Ceramic, [turned(lathe(&profile, 44))]),
            Part::new("handles", Material::Ceramic, handle.mirrored(Axis::X).map(turned)),
        ],
    }
}

/// A 50 litre industrial gas cylinder with its cap, 0.23 × 1.64 m, on its side.
fn gas_cylinder() -> Object {
    let mut body: Vec<Point> = vec![[0.0, 0.030], [0.060, 0.020], [0.085, 0.0], [0.105, 0.010]];
    body.extend(smooth(&[[0.1145, 0.060], [0.1145, 1.300], [0.108, 1.380], [0.080, 1.440], [0.045, 1.470]], 3));
    body.extend([[0.042, 1.500], [0.0, 1.500]]);
    let mut cap: Vec<Point> = vec![[0.0, 1.46], [0.055, 1.46], [0.062, 1.48], [0.062, 1.58]];
    cap.extend(dome(0.060, 1.585, 0.055, 4));
    let ring = torus(0.062, 0.012, [32, 6]).at(0.0, 0.0, 1.475);
    Object {
        uid: "gas-cylinder",
        name: "industrial gas cylinder, 50 l",
        label: "gas-cylinder",
        tags: "gas bottle;oxygen cylinder;debris;container",
        parts: vec![
            Part::new("cylinder", Material::Steel, [lying(lathe(&body, 44))]),
            Part::new("cap", Material::Steel, [lathe(&cap, 32), ring].map(lying)),
        ],
    }
}

/// A EUR pallet, 1200 × 800 × 144 mm: five deck boards, nine blocks, three skids.
fn pallet() -> Object {
    let mut boards = Vec::new();
    for (y, width) in [(-0.3275, 0.145), (-0.1775, 0.100), (0.0, 0.145), (0.1775, 0.100), (0.3275, 0.145)] {
        boards.push(cuboid([1.2, width, 0.022], [0.0, y, 0.133]));
    }
    for x in [-0.5275, 0.0, 0.5275] {
        boards.push(cuboid([0.145, 0.8, 0.022], [x, 0.0, 0.111]));
    }
    for y in [-0.35, 0.0, 0.35] {
        boards.push(cuboid([1.2, if y == 0.0 { 0.145 } else { 0.100 }, 0.022], [0.0, y, 0.011]));
    }
    let blocks = [-0.5275, 0.0, 0.5275].into_iter().flat_map(|x| {
        [-0.35, 0.0, 0.35].map(|y| cuboid([0.145, if y == 0.0 { 0.145 } else { 0.100 }, 0.078], [x, y, 0.061]))
    });
    Object {
        uid: "pallet",
        name: "wooden pallet",
        label: "pallet",
        tags: "euro pallet;wooden pallet;debris;cargo",
        parts: vec![
            Part::new("boards", Material::Wood, boards),
            Part::new("blocks", Material::Wood, blocks.collect::<Vec<_>>()),
        ],
    }
}

/// A 220 litre plastic drum with two bungs, 0.58 × 0.93 m, on its side.
fn plastic_drum() -> Object {
    let mut profile: Vec<Point> = vec![[0.0, 0.020], [0.200, 0.012], [0.230, 0.0], [0.262, 0.008]];
    profile.extend(smooth(&[[0.282, 0.050], [0.288, 0.120], [0.288, 0.300]], 3));
    profile.extend([
        [0.282, 0.312],
        [0.282, 0.324],
        [0.290, 0.336],
        [0.290, 0.600],
        [0.282, 0.612],
        [0.282, 0.624],
        [0.288, 0.636],
    ]);
    profile.extend(smooth(&[[0.288, 0.820], [0.276, 0.865], [0.250, 0.890]], 3));
    profile.extend([[0.262, 0.895], [0.262, 0.918], [0.246, 0.925], [0.236, 0.900], [0.0, 0.905]]);
    let bung = |x: f64, radius: f64| cylinder(radius, [0.89, 0.928], 18).at(x, 0.0, 0.0);
    Object {
        uid: "plastic-drum",
        name: "plastic drum, 220 l",
        label: "oil-drum",
        tags: "drum;barrel;plastic drum;debris;container;pollution",
        parts: vec![
            Part::new("drum", Material::Plastic, [lying(lathe(&profile, 48))]),
            Part::new("bungs", Material::Plastic, [bung(0.17, 0.034), bung(-0.17, 0.034)].map(lying)),
        ],
    }
}

/// A 20 litre steel jerrycan, 345 × 165 × 470 mm, with three handles and a spout, upright.
fn jerrycan() -> Object {
    let level = |shrink: f64, z: f64, slant: f64| -> Vec<DVec3> {
        rounded_rectangle(0.340 - shrink, 0.165 - shrink, 0.03, 4)
            .into_iter()
            .map(|[x, y]| DVec3::new(x, y, z - slant * (x - 0.06).max(0.0)))
            .collect()
    };
    let body = capped(&[
        level(0.030, 0.0, 0.0),
        level(0.004, 0.012, 0.0),
        level(0.0, 0.030, 0.0),
        level(0.012, 0.060, 0.0),
        level(0.012, 0.330, 0.0),
        level(0.0, 0.360, 0.0),
        level(0.004, 0.395, 0.25),
        level(0.040, 0.410, 0.30),
    ]);
    let seam =
        prism(&rounded_rectangle(0.346, 0.395, 0.03, 4), &[rounded_rectangle(0.30, 0.35, 0.03, 4)], [-0.004, 0.004])
            .turned(Axis::X, 90.0)
            .at(0.0, 0.0, 0.198);
    let handle = |y: f64| {
        let path = [
            [-0.105, y, 0.395],
            [-0.100, y, 0.440],
            [-0.070, y, 0.452],
            [0.020, y, 0.452],
            [0.048, y, 0.440],
            [0.052, y, 0.395],
        ];
        tube(&spline(&path, 3), 0.008, 10)
    };
    let spout =
        lathe(&[[0.0, -0.02], [0.030, -0.02], [0.030, 0.045], [0.036, 0.047], [0.036, 0.062], [0.0, 0.064]], 22)
            .turned(Axis::Y, 24.0)
            .at(0.115, 0.0, 0.385);
    Object {
        uid: "jerrycan",
        name: "steel jerrycan, 20 l",
        label: "jerrycan",
        tags: "canister;fuel can;petrol can;debris;container;pollution",
        parts: vec![
            Part::new("can", Material::Steel, [body, seam]),
            Part::new("handles", Material::Steel, [-0.045, 0.0, 0.045].map(handle)),
            Part::new("spout", Material::Steel, [spout]),
        ],
    }
}
