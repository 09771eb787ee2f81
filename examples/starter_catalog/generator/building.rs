//! Things built with: cinder blocks, pipes, valve, ladders, traffic cone, tetrapod.

use ensonify::math::real::{acos, cos, degrees, radians, sin};
use glam::DVec3;

use super::curve::{Point, circle, ellipse, rounded_rectangle};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Path, capped, cuboid, cylinder, dome, lathe, lathe_ring, rod, sweep, torus};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![
        cinder_block(),
        pipe(),
        concrete_pipe(),
        valve(),
        ladder(),
        traffic_cone(),
        tetrapod(),
        wooden_ladder(),
        broken_block(),
    ]
}

/// A hollow concrete block, 390 × 190 × 190 mm: two cores through it, hollowed ends.
fn cinder_block() -> Object {
    let (x, y) = (0.195, 0.095);
    let mut outline = Vec::new();
    // Counter-clockwise from the front right corner: each end is hollowed between two ears.
    for side in [1.0, -1.0] {
        outline.extend(
            [
                [x, -y],
                [x, -0.062],
                [x - 0.006, -0.052],
                [x - 0.024, -0.044],
                [x - 0.024, 0.044],
                [x - 0.006, 0.052],
                [x, 0.062],
                [x, y],
            ]
            .map(|p: Point| [side * p[0], side * p[1]]),
        );
    }
    let core: Vec<Point> = rounded_rectangle(0.125, 0.125, 0.025, 4);
    let cores = [-0.078, 0.078].map(|at| core.iter().map(|p| [p[0] + at, p[1]]).collect());
    // Blocks are cast with tapered cores: the webs are thicker at the top.
    let block = prism(&outline, &cores, [0.0, 0.19]).mapped(|p| {
        let inside = p.y.abs() < 0.07 && p.x.abs() < 0.15;
        let middle = if p.x < 0.0 { -0.078 } else { 0.078 };
        let taper = if inside && p.z > 0.1 { 0.93 } else { 1.0 };
        DVec3::new(middle + (p.x - middle) * taper, p.y * taper, p.z)
    });
    Object {
        uid: "cinder-block",
        name: "cinder block",
        label: "cinder-block",
        tags: "concrete block;breeze block;masonry;debris;sinker",
        parts: vec![Part::new("block", Material::Concrete, [block])],
    }
}

/// Hexagonal bolts on a circle about z.
fn bolts(radius: f64, count: usize, heights: [f64; 2], size: f64) -> Vec<Solid> {
    cylinder(size, heights, 6).at(radius, 0.0, 0.0).around(count)
}

/// A steel pipe DN 250, 2 m long, with a welded flange at each end; open, lying.
fn pipe() -> Object {
    let half = 1.0;
    let (bore, wall, flange) = (0.1275, 0.1365, 0.2025);
    let mut outside: Vec<Point> = vec![
        [bore, -half],
        [flange, -half],
        [flange, -half + 0.026],
        [0.160, -half + 0.026],
        [0.150, -half + 0.034],
        [wall, -half + 0.065],
    ];
    let upper: Vec<Point> = outside.iter().rev().map(|p| [p[0], -p[1]]).collect();
    outside.extend([[wall, -0.012], [0.1395, -0.005], [0.1395, 0.005], [wall, 0.012]]);
    outside.extend(upper);
    let mut studs = bolts(0.1775, 12, [-half - 0.001, -half + 0.046], 0.014);
    studs.extend(bolts(0.1775, 12, [half - 0.046, half + 0.001], 0.014));
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0).turned(Axis::X, 15.0);
    Object {
        uid: "pipe",
        name: "flanged steel pipe",
        label: "pipe",
        tags: "steel pipe;pipeline;flange;infrastructure;debris",
        parts: vec![
            Part::new("pipe", Material::Steel, [lying(lathe_ring(&outside, 48))]),
            Part::new("bolts", Material::Steel, studs.into_iter().map(lying).collect::<Vec<_>>()),
        ],
    }
}

/// A concrete sewer pipe with a socket, bore 0.5 m, 1.5 m long; open, lying.
fn concrete_pipe() -> Object {
    let profile = [
        [0.250, 0.0],
        [0.290, 0.0],
        [0.295, 0.060],
        [0.310, 0.075],
        [0.310, 1.300],
        [0.385, 1.380],
        [0.390, 1.490],
        [0.382, 1.500],
        [0.320, 1.500],
        [0.305, 1.400],
        [0.252, 1.390],
    ];
    Object {
        uid: "pipe-concrete",
        name: "concrete sewer pipe",
        label: "pipe",
        tags: "concrete pipe;sewer pipe;outfall;infrastructure",
        parts: vec![Part::new("pipe", Material::Concrete, [lathe_ring(&profile, 56).turned(Axis::Y, 90.0)])],
    }
}

/// A gate valve DN 150 with flanges, bonnet and hand wheel, upright in its line.
fn valve() -> Object {
    let body = [
        [0.070, -0.1335],
        [0.142, -0.1335],
        [0.142, -0.1115],
        [0.095, -0.105],
        [0.088, -0.070],
        [0.110, -0.040],
        [0.110, 0.040],
        [0.088, 0.070],
        [0.095, 0.105],
        [0.142, 0.1115],
        [0.142, 0.1335],
        [0.070, 0.1335],
    ];
    let mut nuts = bolts(0.120, 8, [-0.135, -0.1005], 0.012);
    nuts.extend(bolts(0.120, 8, [0.1005, 0.135], 0.012));
    let nuts = nuts.into_iter().map(|solid| solid.turned(Axis::Z, 22.5).turned(Axis::Y, 90.0));
    let oval = |x: f64, y: f64, z: f64| -> Vec<DVec3> {
        circle(1.0, 24).into_iter().map(|[u, v]| DVec3::new(x * u, y * v, z)).collect()
    };
    let bonnet = capped(&[
        oval(0.075, 0.112, -0.110),
        oval(0.080, 0.118, 0.000),
        oval(0.075, 0.115, 0.145),
        oval(0.100, 0.140, 0.150),
        oval(0.100, 0.140, 0.188),
        oval(0.070, 0.100, 0.200),
        oval(0.045, 0.055, 0.260),
        oval(0.030, 0.032, 0.300),
        oval(0.042, 0.042, 0.305),
        oval(0.042, 0.042, 0.335),
        oval(0.030, 0.030, 0.340),
    ]);
    let stem = cylinder(0.014, [0.30, 0.47], 12);
    let gland = [0.0, 180.0].map(|a| cylinder(0.008, [0.20, 0.35], 8).at(0.034, 0.0, 0.0).turned(Axis::Z, a));
    let mut wheel = vec![torus(0.125, 0.024, [40, 8]).at(0.0, 0.0, 0.425), cylinder(0.026, [0.405, 0.445], 16)];
    wheel.extend(rod([0.015, 0.0, 0.425], [0.122, 0.0, 0.425], 0.010, 8).around(5));
    let mut works = vec![bonnet, stem];
    works.extend(gland);
    Object {
        uid: "valve",
        name: "gate valve",
        label: "valve",
        tags: "gate valve;pipeline;infrastructure;debris",
        parts: vec![
            Part::new("body", Material::Iron, [lathe_ring(&body, 40).turned(Axis::Y, 90.0)]),
            Part::new("bonnet and stem", Material::Iron, works),
            Part::new("hand wheel", Material::Iron, wheel),
            Part::new("bolts", Material::Steel, nuts.collect::<Vec<_>>()),
        ],
    }
}

/// An aluminium ladder, 3 m × 0.42 m, ten ribbed rungs in two box rails with rubber feet, lying flat.
fn ladder() -> Object {
    let (length, half) = (3.0, 0.21);
    let rail = prism(&rounded_rectangle(0.025, 0.068, 0.006, 3), &[], [0.015, length - 0.015])
        .turned(Axis::Y, 90.0)
        .turned(Axis::X, 90.0);
    let rails = [-1.0, 1.0].map(|side| rail.clone().at(0.0, side * (half - 0.0125), 0.0));
    let rungs = (0..10).map(|i| {
        let x = 0.24 + 0.28 * f64::from(i);
        cylinder(0.015, [-half + 0.006, half - 0.006], 16).turned(Axis::X, 90.0).at(x, 0.0, 0.0)
    });
    let foot = |x: f64, y: f64| {
        prism(&rounded_rectangle(0.033, 0.076, 0.008, 3), &[], [-0.025, 0.025])
            .turned(Axis::Y, 90.0)
            .turned(Axis::X, 90.0)
            .at(x, y, 0.0)
    };
    let feet: Vec<Solid> =
        [-1.0, 1.0].iter().flat_map(|side| [0.025, length - 0.025].map(|x| foot(x, side * (half - 0.0125)))).collect();
    Object {
        uid: "ladder",
        name: "aluminium ladder",
        label: "ladder",
        tags: "aluminium ladder;debris;harbour",
        parts: vec![
            Part::new("rails", Material::Aluminium, rails),
            Part::new("rungs", Material::Aluminium, rungs.collect::<Vec<_>>()),
            Part::new("feet", Material::Rubber, feet),
        ],
    }
}

/// A traffic cone, 0.75 m, hollow, with two raised collars on a square foot.
fn traffic_cone() -> Object {
    let side = |z: f64| 0.142 - 0.112 * (z - 0.03) / 0.72;
    let mut profile: Vec<Point> = vec![[0.134, 0.0], [0.165, 0.020], [0.150, 0.032], [side(0.05), 0.05]];
    for [low, high] in [[0.27, 0.40], [0.50, 0.61]] {
        profile.extend([
            [side(low), low],
            [side(low) + 0.004, low + 0.002],
            [side(high) + 0.004, high - 0.002],
            [side(high), high],
        ]);
    }
    profile.extend([[side(0.735), 0.735], [side(0.735) - 0.003, 0.748], [0.026, 0.750], [0.023, 0.745], [0.078, 0.36]]);
    let foot = prism(&rounded_rectangle(0.42, 0.42, 0.05, 5), &[circle(0.130, 40)], [0.012, 0.034]);
    let pads = cuboid([0.10, 0.10, 0.03], [0.145, 0.145, 0.015]).around(4);
    let mut base = vec![foot];
    base.extend(pads);
    Object {
        uid: "traffic-cone",
        name: "traffic cone",
        label: "traffic-cone",
        tags: "cone;pylon;debris;urban;calibration",
        parts: vec![
            Part::new("cone", Material::Plastic, [lathe_ring(&profile, 40)]),
            Part::new("foot", Material::Rubber, base),
        ],
    }
}

/// A breakwater tetrapod, 1.6 m, on three of its four legs.
fn tetrapod() -> Object {
    let mut leg: Vec<Point> = vec![[0.0, -0.05], [0.335, 0.0], [0.317, 0.18], [0.232, 0.86], [0.215, 0.90]];
    leg.extend(dome(0.19, 0.925, 0.004, 2));
    let leg = lathe(&leg, 32);
    let spread = degrees(acos(-1.0 / 3.0));
    let (s, c) = (sin(radians(spread)), cos(radians(spread)));
    let mut legs = vec![leg.clone()];
    legs.extend(leg.aimed(DVec3::new(s, 0.0, c), DVec3::ZERO).around(3));
    Object {
        uid: "tetrapod",
        name: "tetrapod",
        label: "tetrapod",
        tags: "breakwater;armour unit;concrete;infrastructure",
        parts: vec![Part::new("legs", Material::Concrete, legs)],
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
