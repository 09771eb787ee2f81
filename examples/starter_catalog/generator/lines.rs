//! What is made of rope and what hangs on it: a lost net, a coil, a sea cable, a lifebuoy, a tyre cast as a mooring.

use ensonify::math::real::{cos, sin};
use glam::DVec3;

use super::curve::{circle, ellipse, spline};
use super::noise::Noise;
use super::object::{Material, Object, Part};
use super::shape::{Path, cylinder, icosphere, lathe, rod, sweep, torus, tube};
use super::solid::{Axis, Solid};
use super::wheels::tyre;

pub fn all() -> Vec<Object> {
    vec![net(), rope_coil(), sea_cable(), lifebuoy(), tyre_mooring()]
}

/// A lost piece of trawl net, 2.2 m: a crumpled heap of meshes that runs out on one side, head rope with floats.
fn net() -> Object {
    let noise = Noise::of("net");
    // The sheet as it lies: u and v run from -1 to 1.
    let sheet = |u: f64, v: f64| {
        let crumple = |k: f64| {
            noise.at(DVec3::new(2.3 * u + k, 2.3 * v, 1.7 * k)) + 0.5 * noise.at(DVec3::new(5.0 * u, 5.0 * v + k, k))
        };
        let heap = 1.15 / (1.0 + 5.0 * (u + 0.25) * (u + 0.25) + 6.0 * v * v);
        let fold = 0.5 * crumple(4.6) + 0.5;
        let edge = 1.0 - (u * u).max(v * v);
        DVec3::new(
            1.0 * u + 0.30 * crumple(0.3),
            0.62 * v + 0.26 * crumple(2.9),
            0.03 + (heap * fold).max(0.0) * edge.max(0.0).sqrt(),
        )
    };
    let steps = 22;
    let line = |place: &dyn Fn(f64) -> DVec3, radius: f64, sides: usize| -> Solid {
        let path: Vec<DVec3> = (0..=steps).map(|i| place(2.0 * f64::from(i) / f64::from(steps) - 1.0)).collect();
        tube(&path, radius, sides)
    };
    let share = |i: i32, count: i32| 2.0 * (f64::from(i) + 0.5) / f64::from(count) - 1.0;
    let mut twine: Vec<Solid> = (0..15).map(|i| line(&|t| sheet(t, share(i, 15)), 0.007, 3)).collect();
    twine.extend((0..17).map(|i| line(&|t| sheet(share(i, 17), t), 0.007, 3)));
    let head_rope = line(&|t| sheet(t, -1.0) + DVec3::Z * 0.01, 0.016, 6);
    let floats = (0..6).map(|i| {
        let at = sheet(share(i, 6), -1.0);
        icosphere(3).mapped(move |p| DVec3::new(0.08 * p.x, 0.065 * p.y, 0.065 * p.z) + at + DVec3::Z * 0.05)
    });
    Object {
        uid: "net",
        name: "lost fishing net with floats",
        label: "net",
        tags: "fishing net;ghost net;trawl net;fishing gear;ghost gear;fishing",
        parts: vec![
            Part::new("meshes", Material::Rope, twine),
            Part::new("head rope", Material::Rope, [head_rope]),
            Part::new("floats", Material::Plastic, floats.collect::<Vec<_>>()),
        ],
    }
}

/// A coil of 32 mm rope, 0.7 m across in three layers, its end lying out.
fn rope_coil() -> Object {
    let noise = Noise::of("rope");
    let bar = 0.016;
    let turns = 9;
    let steps = 20;
    let mut path: Vec<DVec3> = (0..turns * steps)
        .map(|i| {
            let round = f64::from(i) / f64::from(steps);
            let a = std::f64::consts::TAU * round;
            // Three turns outwards, then a layer higher.
            let (layer, within) = ((round / 3.0).floor(), round % 3.0 / 3.0);
            let radius = 0.235
                + 0.095 * if layer % 2.0 == 0.0 { within } else { 1.0 - within }
                + 0.02 * noise.at(DVec3::new(0.6 * round, 2.0 * cos(a), 2.0 * sin(a)));
            DVec3::new(radius * cos(a), radius * sin(a), bar * (1.0 + 1.75 * layer + 0.25 * within))
        })
        .collect();
    let last = path[path.len() - 1];
    path.extend(spline(
        &[
            [last.x + 0.05, last.y + 0.07, 0.055],
            [0.40, 0.14, 0.02],
            [0.52, 0.02, bar],
            [0.70, -0.10, bar],
            [0.92, -0.06, bar],
        ],
        5,
    ));
    let end = path[path.len() - 1];
    let knot = icosphere(4).mapped(move |p| p * 0.03 + end + DVec3::Z * 0.012);
    // Three strands: the section is lobed and turns as it goes.
    let coil = sweep(&path, Path::Open, DVec3::Z, |i| {
        circle(1.0, 9)
            .into_iter()
            .enumerate()
            .map(|(k, p)| {
                let lobe = bar * if (k + i) % 3 == 0 { 0.80 } else { 1.0 };
                [lobe * p[0], lobe * p[1]]
            })
            .collect()
    });
    Object {
        uid: "rope",
        name: "coil of rope",
        label: "rope",
        tags: "coiled rope;hawser;mooring line;line;mooring",
        parts: vec![Part::new("rope", Material::Rope, [coil, knot])],
    }
}

/// A cut piece of armoured sea cable, 90 mm thick, 5 m along, its wires sprung open at one end.
fn sea_cable() -> Object {
    let line = spline(
        &[
            [-2.5, -0.25, 0.045],
            [-1.7, 0.25, 0.045],
            [-0.8, 0.42, 0.05],
            [0.1, 0.0, 0.075],
            [0.9, -0.45, 0.05],
            [1.7, -0.30, 0.045],
            [2.45, 0.20, 0.08],
        ],
        8,
    );
    let cable = sweep(&line, Path::Open, DVec3::Z, |i| {
        circle(1.0, 16)
            .into_iter()
            .enumerate()
            .map(|(k, p)| {
                let lay = 0.045 - if (k + i) % 4 == 0 { 0.003 } else { 0.0 };
                [lay * p[0], lay * p[1]]
            })
            .collect()
    });
    let end = DVec3::new(2.42, 0.18, 0.08);
    let wires = (0..9).map(|k| {
        let (s, c) = (sin(0.7 * f64::from(k)), cos(0.7 * f64::from(k)));
        let at = |ahead: f64, out: f64| {
            let p = end + DVec3::new(0.83 * ahead, 0.55 * ahead + out * c, out * s * 0.8 + 0.02 * ahead);
            [p.x, p.y, p.z.max(0.008)]
        };
        tube(
            &spline(&[at(-0.05, 0.036), at(0.06, 0.038), at(0.16, 0.065), at(0.24, 0.11 + 0.01 * f64::from(k % 3))], 3),
            0.006,
            5,
        )
    });
    let core = rod([2.40, 0.17, 0.08], [2.62, 0.315, 0.095], 0.02, 10);
    Object {
        uid: "cable",
        name: "piece of sea cable, 5 m",
        label: "cable",
        tags: "submarine cable;power cable;sea cable;infrastructure",
        parts: vec![
            Part::new("cable", Material::Rubber, [cable, core]),
            Part::new("wires", Material::Steel, wires.collect::<Vec<_>>()),
        ],
    }
}

/// A lifebuoy, 0.75 m across, with four bands and its grab line, lying flat.
fn lifebuoy() -> Object {
    let ring = torus(0.305, 0.14, [56, 16]).mapped(|p| DVec3::new(p.x, p.y, 0.75 * p.z));
    let band = |turn: f64| {
        let path: Vec<DVec3> = [-3.0, 0.0, 3.0].map(|y| DVec3::new(0.305, 0.012 * y, 0.0)).to_vec();
        sweep(&path, Path::Open, DVec3::X, |_| ellipse(0.0725, 0.0555, 16)).turned(Axis::Z, turn)
    };
    let bands = [45.0, 135.0, 225.0, 315.0].map(band);
    let grab: Vec<Solid> = (0..4)
        .map(|i| {
            let path: Vec<DVec3> = (0..=8)
                .map(|k| f64::from(k) / 8.0)
                .map(|t| {
                    (
                        std::f64::consts::FRAC_PI_2 * (f64::from(i) + 0.5 + 0.06 + 0.88 * t),
                        0.370 + 0.045 * sin(std::f64::consts::PI * t),
                    )
                })
                .map(|(a, r)| DVec3::new(r * cos(a), r * sin(a), -0.01))
                .collect();
            tube(&path, 0.006, 6)
        })
        .collect();
    Object {
        uid: "lifebuoy",
        name: "lifebuoy",
        label: "life-buoy",
        tags: "life ring;lifebelt;ring buoy;float;ship;rescue",
        parts: vec![
            Part::new("ring", Material::Plastic, [ring]),
            Part::new("bands", Material::Rope, bands),
            Part::new("grab line", Material::Rope, grab),
        ],
    }
}

/// A car tyre filled with concrete, an iron eye cast into it: a small boat's mooring.
fn tyre_mooring() -> Object {
    let fill = lathe(
        &[
            [0.0, -0.088],
            [0.20, -0.092],
            [0.285, -0.075],
            [0.298, 0.0],
            [0.285, 0.075],
            [0.20, 0.098],
            [0.10, 0.112],
            [0.0, 0.115],
        ],
        40,
    );
    let eye = torus(0.075, 0.026, [24, 10]).turned(Axis::X, 90.0).at(0.0, 0.0, 0.135);
    let bar = rod([-0.055, 0.0, 0.02], [0.055, 0.0, 0.02], 0.014, 10);
    let shackle = torus(0.045, 0.016, [20, 8]).turned(Axis::Y, 90.0).at(0.0, 0.0, 0.235);
    let pin = cylinder(0.012, [-0.06, 0.06], 10).turned(Axis::Y, 90.0).at(0.0, 0.03, 0.208);
    Object {
        uid: "tire-mooring",
        name: "tyre cast full of concrete, as a mooring",
        label: "mooring-block",
        tags: "sinker;clump weight;concrete tyre;mooring;harbour",
        parts: vec![
            Part::new("concrete", Material::Concrete, [fill]),
            Part::new("tyre", Material::Rubber, [tyre(48)]),
            Part::new("eye", Material::Steel, [eye, bar, shackle, pin]),
        ],
    }
}
