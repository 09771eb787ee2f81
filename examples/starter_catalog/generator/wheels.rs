//! Things on wheels: tire, car wheel, bicycle, shopping trolley.

use ensonify::math::real::{cos, radians, sin};
use glam::DVec3;

use super::curve::{Point, circle, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Path, capped, cuboid, cylinder, lathe, lathe_ring, plank, rod, sweep, torus, tube};
use super::solid::{Axis, Solid, turn};

pub fn all() -> Vec<Object> {
    vec![tire(), car_wheel(), bicycle(), shopping_trolley()]
}

/// Half the section of a 205/55 R16 tyre as (radius, height) from the inside of the bead over the sidewall to the crown.
const TYRE_OUTSIDE: [Point; 16] = [
    [0.2035, 0.070],
    [0.2030, 0.086],
    [0.2120, 0.0900],
    [0.2280, 0.0975],
    [0.2550, 0.1025],
    [0.2800, 0.1000],
    [0.2960, 0.0940],
    [0.3060, 0.0860],
    [0.3110, 0.0730],
    [0.3128, 0.0540],
    [0.3050, 0.0525],
    [0.3050, 0.0455],
    [0.3138, 0.0440],
    [0.3158, 0.0125],
    [0.3075, 0.0110],
    [0.3075, 0.0],
];
const TYRE_INSIDE: [Point; 5] = [[0.3000, 0.0], [0.2970, 0.050], [0.2840, 0.0820], [0.2480, 0.0900], [0.2150, 0.0750]];

/// The tyre about z. Every third row is cut down at the shoulders, which leaves the lugs of the tread.
fn tyre(around: usize) -> Solid {
    let mirror = |p: &Point| [p[0], -p[1]];
    let mut section: Vec<Point> = TYRE_OUTSIDE.to_vec();
    section.extend(TYRE_OUTSIDE.iter().rev().skip(1).map(mirror));
    section.extend(TYRE_INSIDE.iter().rev().map(mirror));
    section.extend(TYRE_INSIDE.iter().skip(1));
    let step = std::f64::consts::TAU / around as f64;
    let mut solid = lathe_ring(&section, around);
    let rows = section.len();
    for row in 0..rows {
        let [radius, height] = section[row];
        let shoulder = radius > 0.3055 && (0.050..0.090).contains(&height.abs());
        for k in (0..around).filter(|k| shoulder && (k + usize::from(height > 0.0)) % 3 == 0) {
            let (angle, depth) = (step * k as f64, radius - 0.0085);
            solid.positions[row * around + k] = DVec3::new(depth * cos(angle), depth * sin(angle), height);
        }
    }
    solid
}

/// A car tyre 205/55 R16 without its wheel, lying flat: hollow, so water and sound go in.
fn tire() -> Object {
    Object {
        uid: "tire",
        name: "car tire",
        label: "tire",
        tags: "tyre;car;vehicle;debris;pollution",
        parts: vec![Part::new("tyre", Material::Rubber, [tyre(72)])],
    }
}

/// The tyre on a steel wheel with round holes, hub and five nuts, lying flat.
fn car_wheel() -> Object {
    let rim = [
        [0.2150, 0.0960],
        [0.2150, 0.0860],
        [0.2030, 0.0830],
        [0.2000, 0.0550],
        [0.1780, 0.0420],
        [0.1780, 0.0000],
        [0.1950, -0.0600],
        [0.2000, -0.0850],
        [0.2150, -0.0870],
        [0.2150, -0.0970],
        [0.1970, -0.0920],
        [0.1740, 0.0000],
        [0.1740, 0.0460],
        [0.1960, 0.0600],
        [0.1990, 0.0880],
    ];
    let holes: Vec<Vec<Point>> = (0..10)
        .map(|i| radians(36.0 * f64::from(i)))
        .map(|a| circle(0.024, 12).into_iter().map(|p| [p[0] + 0.138 * cos(a), p[1] + 0.138 * sin(a)]).collect())
        .collect();
    let dish = prism(&circle(0.178, 40), &holes, [0.000, 0.006])
        .mapped(|p| p + DVec3::Z * (0.045 - 0.9 * (p.truncate().length() - 0.10).abs()));
    let hub = lathe(&[[0.0, 0.0], [0.098, 0.0], [0.092, 0.058], [0.040, 0.062], [0.034, 0.085], [0.0, 0.085]], 32);
    let nuts = cylinder(0.0105, [0.05, 0.078], 6).at(0.057, 0.0, 0.0).around(5);
    Object {
        uid: "car-wheel",
        name: "car wheel",
        label: "wheel",
        tags: "car wheel;tire;tyre;rim;car;vehicle;debris",
        parts: vec![
            Part::new("tyre", Material::Rubber, [tyre(48)]),
            Part::new("rim", Material::Steel, [lathe_ring(&rim, 40), dish, hub]),
            Part::new("nuts", Material::Steel, nuts),
        ],
    }
}

/// A city bicycle with 28-inch wheels, lying on its left side on pedal, handlebar and wheels.
fn bicycle() -> Object {
    let (rear, front) = ([-0.44, 0.0, 0.34], [0.62, 0.0, 0.34]);
    let (crank, seat, head) = ([0.0, 0.0, 0.28], [-0.17, 0.0, 0.80], [0.45, 0.0, 0.85]);
    let crown = [0.485, 0.0, 0.72];
    let wheel = |solid: Solid, hub: [f64; 3]| solid.turned(Axis::X, 90.0).at(hub[0], hub[1], hub[2]);
    let mut tyres = Vec::new();
    let mut metal = Vec::new();
    for hub in [rear, front] {
        tyres.push(wheel(torus(0.322, 0.036, [48, 8]), hub));
        let rim = [[0.298, -0.010], [0.312, -0.012], [0.312, 0.012], [0.298, 0.010]];
        metal.push(wheel(lathe_ring(&rim, 48), hub));
        metal.push(wheel(cylinder(0.022, [-0.045, 0.045], 12), hub));
        let spoke = |lean: f64| rod([0.0, 0.02, lean], [0.3, 0.0, 0.0], 0.002, 3).around(10);
        metal.extend(spoke(0.03).into_iter().map(|s| wheel(s, hub)));
        metal.extend(spoke(-0.03).into_iter().map(|s| wheel(s.turned(Axis::Z, 18.0), hub)));
    }
    let mut frame = vec![
        rod(crank, [-0.20, 0.0, 0.88], 0.015, 10),
        rod(crank, crown, 0.018, 10),
        rod(seat, head, 0.015, 10),
        rod([0.50, 0.0, 0.67], [0.435, 0.0, 0.90], 0.019, 10),
        rod([0.0, -0.04, 0.28], [0.0, 0.04, 0.28], 0.022, 12),
    ];
    for y in [-1.0, 1.0] {
        let [rx, _, rz] = rear;
        frame.push(rod([0.0, 0.03 * y, 0.28], [rx, 0.06 * y, rz], 0.009, 8));
        frame.push(rod([seat[0], 0.02 * y, seat[2]], [rx, 0.06 * y, rz], 0.008, 8));
        let blade =
            [[0.487, 0.045 * y, 0.70], [0.52, 0.05 * y, 0.55], [0.57, 0.05 * y, 0.41], [front[0], 0.05 * y, front[2]]];
        frame.push(tube(&spline(&blade, 3), 0.011, 8));
    }
    frame.push(rod([0.487, -0.055, 0.70], [0.487, 0.055, 0.70], 0.014, 8));
    let bar = [
        [0.30, 0.29, 1.00],
        [0.42, 0.27, 1.02],
        [0.49, 0.16, 1.03],
        [0.47, 0.0, 0.98],
        [0.49, -0.16, 1.03],
        [0.42, -0.27, 1.02],
        [0.30, -0.29, 1.00],
    ];
    metal.push(tube(&spline(&bar, 4), 0.011, 8));
    metal.push(rod([0.44, 0.0, 0.88], [0.47, 0.0, 0.99], 0.013, 8));
    let ring = prism(&circle(0.085, 32), &[circle(0.065, 24)], [-0.002, 0.002]);
    metal.push(wheel(ring, [0.0, -0.05, 0.28]));
    metal.push(plank([0.0, -0.05, 0.36], [0.0, -0.05, 0.20], DVec3::X, [0.014, 0.004]));
    metal.push(plank([0.0, -0.06, 0.28], [0.15, -0.06, 0.20], DVec3::Y, [0.014, 0.022]));
    metal.push(plank([0.0, 0.06, 0.28], [-0.15, 0.06, 0.36], DVec3::Y, [0.014, 0.022]));
    let mut soft = vec![
        cuboid([0.09, 0.085, 0.024], [0.15, -0.12, 0.20]),
        cuboid([0.09, 0.085, 0.024], [-0.15, 0.12, 0.36]),
        saddle(),
    ];
    for y in [-1.0, 1.0] {
        soft.push(rod([0.38, 0.282 * y, 1.012], [0.285, 0.292 * y, 0.997], 0.017, 10));
    }
    // On its side it leans on pedal and handlebar: a few degrees off flat, raised at the front.
    let lie = turn(Axis::Y, -7.0) * turn(Axis::X, 84.0);
    let lying = |part: Part| part.mapped(|p| lie * p);
    Object {
        uid: "bicycle",
        name: "bicycle",
        label: "bicycle",
        tags: "bike;vehicle;debris",
        parts: vec![
            lying(Part::new("frame", Material::Steel, frame)),
            lying(Part::new("wheels and drive", Material::Steel, metal)),
            lying(Part::new("tyres", Material::Rubber, tyres)),
            lying(Part::new("saddle, grips, pedals", Material::Plastic, soft)),
        ],
    }
}

fn saddle() -> Solid {
    let station = |x: f64, half_width: f64, z: f64| -> Vec<DVec3> {
        circle(1.0, 12).into_iter().map(|[u, v]| DVec3::new(x, half_width * u, z + 0.028 * v)).collect()
    };
    capped(&[
        station(-0.34, 0.050, 0.935),
        station(-0.32, 0.080, 0.930),
        station(-0.25, 0.078, 0.920),
        station(-0.18, 0.035, 0.915),
        station(-0.08, 0.022, 0.915),
        station(-0.06, 0.012, 0.910),
    ])
}

/// A supermarket trolley, 0.9 × 0.57 × 1.0 m: wire basket, handle, tubular chassis, four castors.
fn shopping_trolley() -> Object {
    // Half width and height of the basket's rim and floor at its front (x = 0.40) and back (x = -0.40).
    let rim = |t: f64| DVec3::new(-0.42 + 0.86 * t, 0.27 - 0.07 * t, 0.98 - 0.08 * t);
    let floor = |t: f64| DVec3::new(-0.38 + 0.74 * t, 0.22 - 0.05 * t, 0.50 + 0.10 * t);
    let port = |p: DVec3| DVec3::new(p.x, -p.y, p.z);
    let wire = |points: &[DVec3], thick: f64| tube(points, thick / 2.0, 4);
    let mut wires = Vec::new();
    for i in 0..=14 {
        let t = f64::from(i) / 14.0;
        wires.push(wire(&[rim(t), floor(t)], 0.006));
        wires.push(wire(&[port(rim(t)), port(floor(t))], 0.006));
        wires.push(wire(&[floor(t), port(floor(t))], 0.006));
    }
    for t in [0.0, 1.0] {
        for i in 1..10 {
            let s = f64::from(i) / 10.0;
            wires.push(wire(&[rim(t).lerp(port(rim(t)), s), floor(t).lerp(port(floor(t)), s)], 0.006));
        }
    }
    for i in 1..9 {
        let s = f64::from(i) / 9.0;
        wires.push(wire(&[floor(0.0).lerp(port(floor(0.0)), s), floor(1.0).lerp(port(floor(1.0)), s)], 0.006));
    }
    for (s, thick) in [(0.0, 0.014), (0.25, 0.006), (0.5, 0.008), (0.75, 0.006), (1.0, 0.010)] {
        let level = |t: f64| rim(t).lerp(floor(t), s);
        let loop_ = [level(0.0), level(1.0), port(level(1.0)), port(level(0.0))];
        for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
            wires.push(wire(&[loop_[a], loop_[b]], thick));
        }
    }
    let mut chassis = Vec::new();
    let mut wheels = Vec::new();
    for y in [-1.0, 1.0] {
        let side = [
            [-0.47, 0.25 * y, 1.02],
            [-0.44, 0.25 * y, 0.92],
            [-0.40, 0.235 * y, 0.50],
            [-0.42, 0.25 * y, 0.22],
            [-0.36, 0.25 * y, 0.165],
            [0.40, 0.17 * y, 0.165],
        ];
        chassis.push(tube(&spline(&side, 3), 0.013, 8));
        chassis.push(rod([-0.30, 0.245 * y, 0.17], [0.33, 0.17 * y, 0.58], 0.010, 8));
        for (x, half) in [(-0.36, 0.25), (0.40, 0.17)] {
            let (x, hub) = (x - 0.03, [x - 0.03, half * y, 0.0625]);
            chassis.push(cylinder(0.012, [0.13, 0.17], 8).at(x + 0.03, half * y, 0.0));
            for fork in [-0.02, 0.02] {
                chassis.push(plank(
                    [x + 0.02, half * y + fork, 0.14],
                    [hub[0], hub[1] + fork, hub[2]],
                    DVec3::Y,
                    [0.004, 0.035],
                ));
            }
            wheels.push(cylinder(0.0625, [-0.015, 0.015], 20).turned(Axis::X, 90.0).at(hub[0], hub[1], hub[2]));
        }
    }
    chassis.push(rod([0.40, -0.17, 0.165], [0.40, 0.17, 0.165], 0.013, 8));
    chassis.push(rod([-0.40, -0.235, 0.50], [-0.40, 0.235, 0.50], 0.011, 8));
    let handle =
        sweep(&[DVec3::new(-0.475, -0.285, 1.03), DVec3::new(-0.475, 0.285, 1.03)], Path::Open, DVec3::X, |_| {
            circle(0.017, 12)
        });
    Object {
        uid: "shopping-trolley",
        name: "shopping trolley",
        label: "shopping-trolley",
        tags: "shopping cart;trolley;cart;debris;urban",
        parts: vec![
            Part::new("basket", Material::Steel, wires),
            Part::new("chassis", Material::Steel, chassis),
            Part::new("wheels", Material::Rubber, wheels),
            Part::new("handle", Material::Plastic, [handle]),
        ],
    }
}
