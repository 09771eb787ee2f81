//! Ground tackle: anchors, chain, mooring block, mooring buoy, crane hook.

use ensonify::math::real::{atan2, cos, degrees, radians, sin};
use glam::DVec3;

use super::curve::{Point, arc, circle, ellipse, interpolate, rounded_rectangle, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Path, capped, cuboid, cylinder, icosphere, lathe, lathe_ring, rod, sweep, torus};
use super::solid::{Axis, Solid, turn};

pub fn all() -> Vec<Object> {
    vec![anchor(), stockless_anchor(), chain(), mooring_block(), crane_hook(), mooring_buoy()]
}

/// An admiralty anchor, shank 1.7 m, as it comes to rest: on the lower bill and the two ends of the stock.
fn anchor() -> Object {
    // Crown at the origin, shank along x, arms in the x-z plane, stock along y.
    let sides = |i: usize| [0.085, 0.080, 0.070, 0.060, 0.058][i];
    let shank: Vec<DVec3> = [-0.02, 0.4, 0.8, 1.2, 1.68].map(|x| DVec3::new(x, 0.0, 0.0)).to_vec();
    let shank = sweep(&shank, Path::Open, DVec3::Y, |i| chamfered(sides(i)));
    let curve: Vec<DVec3> = arc([0.66, 0.0], 0.66, [180.0 - 68.0, 180.0 + 68.0], 28)
        .into_iter()
        .map(|[x, z]| DVec3::new(x, 0.0, z))
        .collect();
    let arms = sweep(&curve, Path::Open, DVec3::Y, |i| {
        let from_tip = (i.min(28 - i)) as f64 / 14.0;
        let [w, h] = [
            interpolate(&[[0.0, 0.010], [0.12, 0.045], [1.0, 0.095]], from_tip),
            interpolate(&[[0.0, 0.008], [1.0, 0.120]], from_tip),
        ];
        ellipse(w / 2.0, h / 2.0, 10)
    });
    let palms = palm().mirrored(Axis::Z);
    let stock_x = 1.54;
    let stock_path: Vec<DVec3> = [-0.78, -0.4, 0.0, 0.4, 0.78].map(|y| DVec3::new(stock_x, y, 0.0)).to_vec();
    let stock = sweep(&stock_path, Path::Open, DVec3::X, |i| circle([0.026, 0.032, 0.040, 0.032, 0.026][i], 14));
    let knob = |y: f64| icosphere(4).mapped(|p| p * 0.065 + DVec3::new(stock_x, y, 0.0));
    let collar = cylinder(0.062, [-0.06, 0.06], 20).turned(Axis::X, 90.0).at(stock_x, 0.0, 0.0);
    // Lying: lean the shank until bill and stock touch the same level.
    let bill = curve[0];
    let (rise, run) = (bill.z - 0.065, stock_x - bill.x);
    let lean = degrees(atan2(rise, run));
    // The ring lies flat on the bottom.
    let ring = torus(0.125, 0.040, [32, 10]).at(0.125, 0.0, 0.0).turned(Axis::Y, -lean).at(1.63, 0.0, 0.0);
    let lean = turn(Axis::Y, lean);
    let lying = |part: Part| part.mapped(|p| lean * p);
    Object {
        uid: "anchor",
        name: "admiralty anchor",
        label: "anchor",
        tags: "admiralty anchor;mooring;ship;wreck;archaeology",
        parts: vec![
            lying(Part::new("shank", Material::Iron, [shank])),
            lying(Part::new("arms", Material::Iron, [arms])),
            lying(Part::new("palms", Material::Iron, palms)),
            lying(Part::new("stock", Material::Iron, [stock, knob(-0.79), knob(0.79), collar])),
            lying(Part::new("ring", Material::Iron, [ring])),
        ],
    }
}

fn chamfered(width: f64) -> Vec<Point> {
    rounded_rectangle(width, width, 0.22 * width, 1)
}

/// The upper palm of the anchor: a pointed shield across the inner face of the arm near its bill.
fn palm() -> Solid {
    let shield = [
        [0.0, 0.22],
        [-0.075, 0.155],
        [-0.125, 0.05],
        [-0.120, -0.06],
        [-0.085, -0.14],
        [0.0, -0.165],
        [0.085, -0.14],
        [0.120, -0.06],
        [0.125, 0.05],
        [0.075, 0.155],
    ];
    // Upright shield facing x; laid on the arm's inside, 50 degrees up its arc, its point towards the bill.
    let plate = prism(&shield, &[], [-0.012, 0.012]).mapped(|p| DVec3::new(p.z, p.x, p.y));
    let up = 50.0;
    let (s, c) = (sin(radians(up)), cos(radians(up)));
    let on_arc = DVec3::new(0.66 - 0.635 * c, 0.0, 0.635 * s);
    plate.turned(Axis::Y, up).mapped(|p| p + on_arc)
}

/// A stockless (Hall) anchor of about 500 kg lying with its flukes dropped.
fn stockless_anchor() -> Object {
    let shank: Vec<DVec3> = [0.0, 0.5, 1.0, 1.35].map(|x| DVec3::new(x, 0.0, 0.0)).to_vec();
    let shank = sweep(&shank, Path::Open, DVec3::Y, |i| {
        rounded_rectangle([0.14, 0.12, 0.10, 0.09][i], [0.16, 0.13, 0.10, 0.09][i], 0.025, 1)
    });
    let eye = torus(0.075, 0.05, [24, 10]).turned(Axis::X, 90.0).at(1.40, 0.0, 0.0);
    let shackle: Vec<DVec3> =
        arc([1.53, 0.0], 0.085, [-140.0, 140.0], 20).into_iter().map(|[x, y]| DVec3::new(x, y, 0.0)).collect();
    let shackle = sweep(&shackle, Path::Open, DVec3::Z, |_| circle(0.021, 10));
    let pin = rod([1.465, -0.10, 0.0], [1.465, 0.10, 0.0], 0.021, 10);
    let station = |x: f64, y: f64, width: f64, thick: f64| -> Vec<DVec3> {
        ellipse(width / 2.0, thick / 2.0, 14).into_iter().map(|[u, v]| DVec3::new(x, y + u, v)).collect()
    };
    let fluke = capped(&[
        station(-0.10, 0.20, 0.20, 0.17),
        station(0.00, 0.22, 0.27, 0.20),
        station(0.12, 0.24, 0.25, 0.15),
        station(0.30, 0.26, 0.22, 0.10),
        station(0.50, 0.27, 0.17, 0.075),
        station(0.68, 0.27, 0.09, 0.055),
        station(0.80, 0.27, 0.02, 0.030),
    ]);
    let across = |y: f64, width: f64, thick: f64| -> Vec<DVec3> {
        rounded_rectangle(width, thick, 0.04, 2).into_iter().map(|[u, v]| DVec3::new(u - 0.04, y, v)).collect()
    };
    let head = capped(&[
        across(-0.46, 0.20, 0.14),
        across(-0.40, 0.26, 0.22),
        across(-0.10, 0.28, 0.26),
        across(0.10, 0.28, 0.26),
        across(0.40, 0.26, 0.22),
        across(0.46, 0.20, 0.14),
    ]);
    let tips = cuboid([0.05, 0.26, 0.30], [-0.13, 0.30, 0.0]).mirrored(Axis::Y);
    let drop = turn(Axis::Y, -22.0);
    let [port, starboard] = fluke.mirrored(Axis::Y);
    let [tip, other] = tips;
    Object {
        uid: "anchor-stockless",
        name: "stockless anchor",
        label: "anchor",
        tags: "stockless anchor;hall anchor;mooring;ship",
        parts: vec![
            Part::new("head and flukes", Material::Iron, [head, port, starboard, tip, other]).mapped(|p| drop * p),
            Part::new("shank", Material::Iron, [shank, eye]).mapped(|p| turn(Axis::Y, 4.0) * p),
            Part::new("shackle", Material::Iron, [shackle, pin]).mapped(|p| turn(Axis::Y, 4.0) * p),
        ],
    }
}

/// One link of a chain about the origin, along x and flat in the x-y plane; `size` is outer length and width.
#[must_use]
pub fn link(size: Point, bar: f64, [bend, sides]: [usize; 2]) -> Solid {
    let radius = (size[1] - bar) / 2.0;
    let straight = (size[0] - size[1]) / 2.0;
    let mut path = arc([straight, 0.0], radius, [-90.0, 90.0], bend);
    path.extend(arc([-straight, 0.0], radius, [90.0, 270.0], bend));
    let path: Vec<DVec3> = path.into_iter().map(|[x, y]| DVec3::new(x, y, 0.0)).collect();
    sweep(&path, Path::Closed, DVec3::Z, |_| circle(bar / 2.0, sides))
}

/// Two metres of stud-link ship's chain, 38 mm, lying in a curve.
fn chain() -> Object {
    let bar = 0.038;
    let pitch = 4.0 * bar;
    let count = 14;
    let stud = rod([0.0, -1.4 * bar, 0.0], [0.0, 1.4 * bar, 0.0], 0.3 * bar, 6);
    let (mut links, mut studs) = (Vec::new(), Vec::new());
    let mut place = DVec3::ZERO;
    for i in 0..count {
        let heading = 62.0 * cos(std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count));
        let roll = if i % 2 == 0 { 45.0 } else { -45.0 };
        let ahead = turn(Axis::Z, heading) * DVec3::X * pitch / 2.0;
        place += ahead;
        let lay = |solid: Solid| solid.turned(Axis::X, roll).turned(Axis::Z, heading).mapped(|p| p + place);
        links.push(lay(link([6.0 * bar, 3.6 * bar], bar, [8, 8])));
        studs.push(lay(stud.clone()));
        place += ahead;
    }
    Object {
        uid: "chain",
        name: "stud-link chain",
        label: "chain",
        tags: "anchor chain;mooring;ship;debris",
        parts: vec![Part::new("links", Material::Steel, links), Part::new("studs", Material::Steel, studs)],
    }
}

/// A concrete sinker, 1.2 m square and 0.6 m high, with a steel ring in its lug.
fn mooring_block() -> Object {
    let level = |width: f64, z: f64| -> Vec<DVec3> {
        rounded_rectangle(width, width, 0.05, 2).into_iter().map(|[x, y]| DVec3::new(x, y, z)).collect()
    };
    let block = capped(&[level(1.17, 0.0), level(1.20, 0.03), level(1.02, 0.57), level(0.97, 0.60)]);
    let mut lug = arc([0.0, 0.09], 0.075, [0.0, 180.0], 12);
    lug.extend([[-0.09, 0.0], [0.09, 0.0]]);
    let lug = prism(&lug, &[circle(0.034, 16).into_iter().map(|p| [p[0], p[1] + 0.09]).collect()], [-0.02, 0.02]);
    let lug = lug.turned(Axis::X, 90.0).at(0.0, 0.0, 0.59);
    let plate = cuboid([0.36, 0.26, 0.03], [0.0, 0.0, 0.605]);
    let ring = torus(0.15, 0.040, [36, 10])
        .at(0.15, 0.0, 0.0)
        .turned(Axis::Y, 7.5)
        .at(-0.005, 0.0, 0.68)
        .turned(Axis::Z, 20.0);
    Object {
        uid: "mooring-block",
        name: "concrete mooring block",
        label: "mooring-block",
        tags: "sinker;clump weight;concrete block;mooring;infrastructure",
        parts: vec![
            Part::new("block", Material::Concrete, [block]),
            Part::new("lug", Material::Steel, [lug, plate]),
            Part::new("ring", Material::Steel, [ring]),
        ],
    }
}

/// A crane hook, 0.55 m, with its eye and safety latch, lying flat.
fn crane_hook() -> Object {
    let line = [
        [0.0, 0.40, 0.0],
        [0.0, 0.30, 0.0],
        [-0.015, 0.22, 0.0],
        [-0.075, 0.15, 0.0],
        [-0.125, 0.06, 0.0],
        [-0.115, -0.045, 0.0],
        [-0.045, -0.115, 0.0],
        [0.055, -0.115, 0.0],
        [0.122, -0.05, 0.0],
        [0.138, 0.045, 0.0],
        [0.148, 0.105, 0.0],
    ];
    let path = spline(&line, 4);
    let last = path.len() - 1;
    let hook = sweep(&path, Path::Open, DVec3::Z, |i| {
        let t = i as f64 / last as f64;
        let deep =
            interpolate(&[[0.0, 0.032], [0.2, 0.034], [0.55, 0.052], [0.75, 0.044], [0.95, 0.020], [1.0, 0.006]], t);
        ellipse(0.75 * deep, deep, 12)
    });
    let eye = lathe(&[[0.0, -0.03], [0.045, -0.03], [0.05, -0.02], [0.05, 0.02], [0.045, 0.03], [0.0, 0.03]], 20);
    let eye = eye.turned(Axis::X, 90.0).at(0.0, 0.40, 0.0);
    let ring = torus(0.075, 0.045, [32, 10]).at(0.0, 0.47, 0.0);
    let latch = rod([-0.03, 0.21, 0.0], [0.135, 0.055, 0.0], 0.009, 8);
    Object {
        uid: "crane-hook",
        name: "crane hook",
        label: "hook",
        tags: "crane;tackle;debris",
        parts: vec![
            Part::new("hook", Material::Steel, [hook, eye, ring]),
            Part::new("latch", Material::Steel, [latch]),
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
