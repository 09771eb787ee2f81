//! Second kinds of common things, so that one label is more than one shape.

use glam::DVec3;

use super::curve::{Point, arc, circle, ellipse, rounded_rectangle, smooth, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Path, capped, cuboid, cylinder, dome, lathe, lathe_ring, rod, sweep, torus, tube};
use super::solid::{Axis, Solid};
use super::vessels::screw;

pub fn all() -> Vec<Object> {
    vec![
        truck_tire(),
        beer_bottle(),
        zinc_bucket(),
        fish_crate(),
        round_amphora(),
        boat_propeller(),
        light_torpedo(),
        mortar_bomb(),
        gas_cylinder(),
        wooden_ladder(),
        pallet(),
        mooring_buoy(),
        plastic_drum(),
        broken_block(),
        jerrycan(),
        dinghy(),
    ]
}

fn lying(solid: Solid) -> Solid {
    solid.turned(Axis::Y, 90.0)
}

/// A lorry's tire 295/80 R22.5, 1.04 m across, with three grooves, lying flat.
fn truck_tire() -> Object {
    let half: [Point; 18] = [
        [0.290, 0.090],
        [0.288, 0.118],
        [0.305, 0.130],
        [0.350, 0.146],
        [0.410, 0.149],
        [0.460, 0.142],
        [0.490, 0.132],
        [0.508, 0.112],
        [0.514, 0.085],
        [0.500, 0.080],
        [0.500, 0.066],
        [0.516, 0.062],
        [0.519, 0.030],
        [0.503, 0.026],
        [0.503, 0.012],
        [0.520, 0.008],
        [0.520, 0.000],
        [0.520, -0.004],
    ];
    let mut section: Vec<Point> = half[..17].to_vec();
    section.extend(half[..16].iter().rev().map(|p| [p[0], -p[1]]));
    let inside: [Point; 5] = [[0.310, -0.100], [0.380, -0.130], [0.470, -0.110], [0.490, -0.050], [0.492, 0.0]];
    section.extend(inside);
    section.extend(inside.iter().rev().skip(1).map(|p| [p[0], -p[1]]));
    Object {
        uid: "truck-tire",
        name: "truck tire",
        label: "tire",
        tags: "tyre;truck;lorry;vehicle;debris;pollution",
        parts: vec![Part::new("tyre", Material::Rubber, [lathe_ring(&section, 56)])],
    }
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

/// A three-bladed propeller of an outboard motor, 0.38 m, lying on its blades.
fn boat_propeller() -> Object {
    let hub = [
        [0.0, -0.075],
        [0.020, -0.075],
        [0.022, -0.070],
        [0.056, -0.070],
        [0.060, -0.050],
        [0.056, 0.050],
        [0.048, 0.075],
        [0.0, 0.075],
    ];
    Object {
        uid: "propeller-outboard",
        name: "outboard propeller",
        label: "propeller",
        tags: "screw;boat;three-blade;vessel;debris",
        parts: vec![
            Part::new("blades", Material::Aluminium, screw(0.19, 0.055, 0.43, 3, 14)),
            Part::new("hub", Material::Aluminium, [lathe(&hub, 32)]),
        ],
    }
}

/// A lightweight torpedo of the Mk 46 kind, 0.324 × 2.6 m: blunt nose, tapered tail, four fins, two screws.
fn light_torpedo() -> Object {
    let mut profile = vec![[0.0, 0.0], [0.070, 0.0]];
    profile.extend(smooth(&[[0.105, 0.010], [0.140, 0.045], [0.158, 0.100], [0.162, 0.180]], 3));
    profile.extend([
        [0.162, 0.62],
        [0.160, 0.625],
        [0.160, 0.635],
        [0.162, 0.64],
        [0.162, 1.30],
        [0.160, 1.305],
        [0.160, 1.315],
        [0.162, 1.32],
    ]);
    profile.extend(smooth(&[[0.162, 1.95], [0.152, 2.10], [0.120, 2.28], [0.080, 2.42], [0.055, 2.50]], 3));
    profile.extend([[0.045, 2.58], [0.0, 2.595]]);
    let fin = prism(&[[0.06, 2.20], [0.145, 2.12], [0.160, 2.34], [0.160, 2.44], [0.06, 2.46]], &[], [-0.005, 0.005])
        .turned(Axis::X, 90.0)
        .around(4);
    let screws = [2.49, 2.55].into_iter().zip([0.30, -0.30]);
    let screws: Vec<Solid> = screws
        .flat_map(|(z, pitch)| screw(0.125, 0.05, pitch, 5, 8).into_iter().map(move |blade| blade.at(0.0, 0.0, z)))
        .collect();
    Object {
        uid: "torpedo-light",
        name: "lightweight torpedo",
        label: "torpedo",
        tags: "ordnance;uxo;munition;underwater vehicle",
        parts: vec![
            Part::new("body", Material::Steel, [lying(lathe(&profile, 44))]),
            Part::new("fins", Material::Steel, fin.into_iter().map(lying).collect::<Vec<_>>()),
            Part::new("screws", Material::Aluminium, screws.into_iter().map(lying).collect::<Vec<_>>()),
        ],
    }
}

/// An 81 mm mortar bomb with its fuze and six tail fins, 0.43 m, on its side.
fn mortar_bomb() -> Object {
    let mut profile = vec![[0.0, 0.0], [0.012, 0.0], [0.016, 0.010], [0.022, 0.050]];
    profile.extend(smooth(&[[0.024, 0.055], [0.034, 0.100], [0.040, 0.150]], 3));
    profile.extend([[0.0405, 0.190], [0.039, 0.193], [0.039, 0.199], [0.0405, 0.202]]);
    profile.extend(smooth(&[[0.0405, 0.215], [0.036, 0.260], [0.024, 0.310], [0.013, 0.340]], 3));
    profile.extend([[0.012, 0.425], [0.0, 0.427]]);
    let fin =
        prism(&[[0.008, 0.355], [0.026, 0.372], [0.038, 0.376], [0.038, 0.432], [0.008, 0.426]], &[], [-0.001, 0.001]);
    let fins = fin.turned(Axis::X, 90.0).around(6).into_iter().map(lying);
    Object {
        uid: "mortar-bomb",
        name: "mortar bomb, 81 mm",
        label: "shell",
        tags: "ordnance;uxo;projectile;mortar shell;unexploded ordnance;munition",
        parts: vec![
            Part::new("body", Material::Steel, [lying(lathe(&profile, 36))]),
            Part::new("fins", Material::Aluminium, fins.collect::<Vec<_>>()),
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

/// A wooden ladder, 2.4 m, eight round rungs in tapered rails, lying flat.
fn wooden_ladder() -> Object {
    let rail = |side: f64| {
        let from = [-1.2, side * 0.22, 0.0];
        sweep(&[DVec3::from_array(from), DVec3::new(1.2, side * 0.17, 0.0)], Path::Open, DVec3::Y, |_| {
            rounded_rectangle(0.034, 0.062, 0.008, 3)
        })
    };
    let rungs = (0..8).map(|i| {
        let x = -1.02 + 0.29 * f64::from(i);
        let half = 0.195 - 0.025 * x / 1.2;
        rod([x, -half, 0.0], [x, half, 0.0], 0.016, 14)
    });
    Object {
        uid: "ladder-wooden",
        name: "wooden ladder",
        label: "ladder",
        tags: "wooden ladder;debris;harbour",
        parts: vec![
            Part::new("rails", Material::Wood, [-1.0, 1.0].map(rail)),
            Part::new("rungs", Material::Wood, rungs.collect::<Vec<_>>()),
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

/// A mooring buoy sunk on its side: a foam-filled ball of 0.7 m with a belt, a rod through it and an eye at either end.
fn mooring_buoy() -> Object {
    let ball: Vec<Point> = arc([0.0, 0.0], 0.35, [-90.0, 90.0], 24);
    let belt = lathe_ring(&[[0.335, -0.04], [0.375, -0.035], [0.375, 0.035], [0.335, 0.04]], 52);
    let plate = |z: f64| cylinder(0.09, [z - 0.008, z + 0.008], 28);
    let eye = |z: f64| torus(0.045, 0.020, [20, 8]).turned(Axis::X, 90.0).at(0.0, 0.0, z);
    let metal = vec![cylinder(0.016, [-0.42, 0.42], 14), plate(0.352), plate(-0.352), eye(0.455), eye(-0.455)];
    let tipped = |solid: Solid| solid.turned(Axis::Y, 72.0);
    Object {
        uid: "mooring-buoy",
        name: "mooring buoy",
        label: "buoy",
        tags: "float;mooring;marker;debris;infrastructure",
        parts: vec![
            Part::new("ball", Material::Plastic, [tipped(lathe(&ball, 48))]),
            Part::new("belt", Material::Rubber, [tipped(belt)]),
            Part::new("rod and eyes", Material::Steel, metal.into_iter().map(tipped).collect::<Vec<_>>()),
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

/// Half a hollow concrete block, broken across its core.
fn broken_block() -> Object {
    let outline = [
        [-0.095, -0.095],
        [0.112, -0.095],
        [0.128, -0.084],
        [0.121, -0.070],
        [0.108, -0.063],
        [0.040, -0.062],
        [0.030, -0.052],
        [0.030, 0.052],
        [0.040, 0.062],
        [0.090, 0.063],
        [0.079, 0.074],
        [0.094, 0.083],
        [0.086, 0.095],
        [-0.095, 0.095],
    ];
    let core: Vec<Point> = rounded_rectangle(0.080, 0.125, 0.025, 4).iter().map(|p| [p[0] - 0.030, p[1]]).collect();
    // The break leans: it is no saw cut.
    let block = prism(&outline, &[core], [0.0, 0.19])
        .mapped(|p| DVec3::new(if p.x > 0.06 { p.x - 0.22 * (p.z - 0.08) * (p.y + 0.2) } else { p.x }, p.y, p.z));
    let rubble = [[0.20, 0.05, 0.05], [0.24, -0.06, 0.035], [0.17, -0.13, 0.028]].map(|[x, y, size]| {
        let ring = |radius: f64, z: f64| -> Vec<DVec3> {
            ellipse(radius, 0.7 * radius, 9).iter().map(|p| DVec3::new(p[0] + x, p[1] + y + 0.2 * z, z)).collect()
        };
        capped(&[
            ring(0.8 * size, 0.0),
            ring(size, 0.4 * size),
            ring(0.9 * size, 0.8 * size),
            ring(0.5 * size, 1.1 * size),
        ])
    });
    Object {
        uid: "cinder-block-broken",
        name: "broken cinder block",
        label: "cinder-block",
        tags: "concrete block;breeze block;masonry;debris;rubble",
        parts: vec![Part::new("block", Material::Concrete, [block]), Part::new("rubble", Material::Concrete, rubble)],
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

/// An inflatable dinghy, 2.7 × 1.5 m: one tube about the bow, transom, floor boards, thwart.
fn dinghy() -> Object {
    let radius = 0.20;
    let mut path: Vec<[f64; 3]> = vec![[-1.35, 0.55, 0.22], [-0.6, 0.55, 0.20], [0.2, 0.55, 0.20]];
    path.extend([[0.75, 0.46, 0.23], [1.08, 0.22, 0.29], [1.15, 0.0, 0.32]]);
    let mirrored: Vec<[f64; 3]> = path[..5].iter().rev().map(|p| [p[0], -p[1], p[2]]).collect();
    path.extend(mirrored);
    let path = spline(&path, 5);
    let last = path.len() - 1;
    let side_tube = sweep(&path, Path::Open, DVec3::Z, |i| {
        // Pointed behind the transom.
        let end = (i.min(last - i) as f64 / 4.0).min(1.0);
        circle(radius * (0.35 + 0.65 * end), 20)
    });
    let transom = cuboid([0.035, 0.78, 0.36], [-1.05, 0.0, 0.26]);
    let boards = (0..4).map(|i| cuboid([0.44, 0.74, 0.018], [-0.80 + 0.46 * f64::from(i), 0.0, 0.095]));
    let thwart = cuboid([0.24, 0.86, 0.025], [-0.25, 0.0, 0.33]);
    let floor = prism(
        &[
            [-1.05, -0.45],
            [0.35, -0.45],
            [0.80, -0.30],
            [1.0, -0.05],
            [1.0, 0.05],
            [0.80, 0.30],
            [0.35, 0.45],
            [-1.05, 0.45],
        ],
        &[],
        [0.060, 0.072],
    );
    Object {
        uid: "dinghy",
        name: "inflatable dinghy",
        label: "dinghy",
        tags: "boat;inflatable boat;rubber boat;wreck;vessel",
        parts: vec![
            Part::new("tube and floor", Material::Rubber, [side_tube, floor]),
            Part::new("transom, boards, thwart", Material::Wood, boards.chain([transom, thwart]).collect::<Vec<_>>()),
        ],
    }
}
