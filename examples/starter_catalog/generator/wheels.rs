//! Things on wheels: tires, car wheel, bicycle, shopping trolley.

use ensonify::math::real::{cos, radians, sin};
use glam::DVec3;

use super::curve::{Point, circle, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{capped, cuboid, cylinder, lathe, lathe_ring, plank, rod, torus, tube};
use super::solid::{Axis, Solid, turn};

pub fn all() -> Vec<Object> {
    vec![tire(), car_wheel(), bicycle(), shopping_trolley(), truck_tire()]
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
#[must_use]
pub fn tyre(around: usize) -> Solid {
    let mirror = |p: &Point| [p[0], -p[1]];
    let mut section: Vec<Point> = TYRE_OUTSIDE.to_vec();
    section.extend(TYRE_OUTSIDE.iter().rev().skip(1).map(mirror));
    section.extend(TYRE_INSIDE.iter().rev().map(mirror));
    section.extend(TYRE_INSIDE.iter().skip(1));
    let step = std::f64::consts::TAU / around as f64;
    let mut solid = lathe_ring(&section, around);
    for (row, [radius, height]) in section.into_iter().enumerate() {
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
    // On its side it leans on pedal and handlebar: a few degrees off flat, raised at the front.
    let lie = turn(Axis::Y, -7.0) * turn(Axis::X, 84.0);
    let lying = |part: Part| part.mapped(|p| lie * p);
    let tyres = HUBS.map(|hub| on_axle(torus(0.322, 0.036, [48, 8]), hub));
    Object {
        uid: "bicycle",
        name: "bicycle",
        label: "bicycle",
        tags: "bike;vehicle;debris",
        parts: vec![
            lying(Part::new("frame", Material::Steel, bicycle_frame())),
            lying(Part::new("wheels", Material::Steel, HUBS.map(spoked_wheel).concat())),
            lying(Part::new("handlebar and drive", Material::Steel, bicycle_drive())),
            lying(Part::new("tyres", Material::Rubber, tyres)),
            lying(Part::new("saddle, grips, pedals", Material::Plastic, bicycle_touch_points())),
        ],
    }
}

/// The bicycle's rear and front hub and its crank's axle; it rides towards x.
const HUBS: [[f64; 3]; 2] = [[-0.44, 0.0, 0.34], [0.62, 0.0, 0.34]];
const CRANK: [f64; 3] = [0.0, 0.0, 0.28];

/// A disc about z as a wheel on this axle, which runs across.
fn on_axle(disc: Solid, [x, y, z]: [f64; 3]) -> Solid {
    disc.turned(Axis::X, 90.0).at(x, y, z)
}

/// Rim, hub and two sets of ten spokes that lean either way.
fn spoked_wheel(hub: [f64; 3]) -> Vec<Solid> {
    let rim = [[0.298, -0.010], [0.312, -0.012], [0.312, 0.012], [0.298, 0.010]];
    let spoke = |lean: f64| rod([0.0, 0.02, lean], [0.3, 0.0, 0.0], 0.002, 3);
    let mut wheel = vec![lathe_ring(&rim, 48), cylinder(0.022, [-0.045, 0.045], 12)];
    wheel.extend(spoke(0.03).around(10));
    wheel.extend(spoke(-0.03).turned(Axis::Z, 18.0).around(10));
    wheel.into_iter().map(|solid| on_axle(solid, hub)).collect()
}

/// A diamond frame with its fork.
fn bicycle_frame() -> Vec<Solid> {
    let (seat, head, crown) = ([-0.17, 0.0, 0.80], [0.45, 0.0, 0.85], [0.485, 0.0, 0.72]);
    let mut frame = vec![
        rod(CRANK, [-0.20, 0.0, 0.88], 0.015, 10),
        rod(CRANK, crown, 0.018, 10),
        rod(seat, head, 0.015, 10),
        rod([0.50, 0.0, 0.67], [0.435, 0.0, 0.90], 0.019, 10),
        on_axle(cylinder(0.022, [-0.04, 0.04], 12), CRANK),
        rod([0.487, -0.055, 0.70], [0.487, 0.055, 0.70], 0.014, 8),
    ];
    let [[rear, _, height], [front, ..]] = HUBS;
    for y in [-1.0, 1.0] {
        frame.push(rod([0.0, 0.03 * y, CRANK[2]], [rear, 0.06 * y, height], 0.009, 8));
        frame.push(rod([seat[0], 0.02 * y, seat[2]], [rear, 0.06 * y, height], 0.008, 8));
        let blade = [[0.487, 0.045, 0.70], [0.52, 0.05, 0.55], [0.57, 0.05, 0.41], [front, 0.05, height]];
        frame.push(tube(&spline(&blade.map(|[x, half, z]| [x, half * y, z]), 3), 0.011, 8));
    }
    frame
}

/// Handlebar with its stem, chainring and cranks.
fn bicycle_drive() -> Vec<Solid> {
    let bar = [
        [0.30, 0.29, 1.00],
        [0.42, 0.27, 1.02],
        [0.49, 0.16, 1.03],
        [0.47, 0.0, 0.98],
        [0.49, -0.16, 1.03],
        [0.42, -0.27, 1.02],
        [0.30, -0.29, 1.00],
    ];
    let chainring = prism(&circle(0.085, 32), &[circle(0.065, 24)], [-0.002, 0.002]);
    vec![
        tube(&spline(&bar, 4), 0.011, 8),
        rod([0.44, 0.0, 0.88], [0.47, 0.0, 0.99], 0.013, 8),
        on_axle(chainring, [0.0, -0.05, 0.28]),
        plank([0.0, -0.05, 0.36], [0.0, -0.05, 0.20], DVec3::X, [0.014, 0.004]),
        plank([0.0, -0.06, 0.28], [0.15, -0.06, 0.20], DVec3::Y, [0.014, 0.022]),
        plank([0.0, 0.06, 0.28], [-0.15, 0.06, 0.36], DVec3::Y, [0.014, 0.022]),
    ]
}

/// Pedals, saddle and grips.
fn bicycle_touch_points() -> Vec<Solid> {
    let pedal = [0.09, 0.085, 0.024];
    let mut points = vec![cuboid(pedal, [0.15, -0.12, 0.20]), cuboid(pedal, [-0.15, 0.12, 0.36]), saddle()];
    points.extend([-1.0, 1.0].map(|y| rod([0.38, 0.282 * y, 1.012], [0.285, 0.292 * y, 0.997], 0.017, 10)));
    points
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
    let handle = rod([-0.475, -0.285, 1.03], [-0.475, 0.285, 1.03], 0.017, 12);
    let castors = [[-0.39, 0.25], [-0.39, -0.25], [0.37, 0.17], [0.37, -0.17]];
    let wheel = cylinder(0.0625, [-0.015, 0.015], 20);
    Object {
        uid: "shopping-trolley",
        name: "shopping trolley",
        label: "shopping-trolley",
        tags: "shopping cart;trolley;cart;debris;urban",
        parts: vec![
            Part::new("basket", Material::Steel, trolley_basket()),
            Part::new("chassis", Material::Steel, trolley_chassis()),
            Part::new("castors", Material::Steel, castors.map(castor).concat()),
            Part::new("wheels", Material::Rubber, castors.map(|[x, y]| on_axle(wheel.clone(), [x, y, 0.0625]))),
            Part::new("handle", Material::Plastic, [handle]),
        ],
    }
}

/// The wire basket: it narrows and its floor rises from back to front.
fn trolley_basket() -> Vec<Solid> {
    // Starboard edges from the back (0) to the front (1).
    let rim = |t: f64| DVec3::new(-0.42 + 0.86 * t, 0.27 - 0.07 * t, 0.98 - 0.08 * t);
    let floor = |t: f64| DVec3::new(-0.38 + 0.74 * t, 0.22 - 0.05 * t, 0.50 + 0.10 * t);
    let other = |p: DVec3| DVec3::new(p.x, -p.y, p.z);
    let wire = |a: DVec3, b: DVec3| tube(&[a, b], 0.003, 4);
    let mut wires = Vec::new();
    for t in (0..=14).map(|i| f64::from(i) / 14.0) {
        wires.push(wire(rim(t), floor(t)));
        wires.push(wire(other(rim(t)), other(floor(t))));
        wires.push(wire(floor(t), other(floor(t))));
    }
    for s in (1..10).map(|i| f64::from(i) / 10.0) {
        let (back, front) = (floor(0.0).lerp(other(floor(0.0)), s), floor(1.0).lerp(other(floor(1.0)), s));
        wires.push(wire(back, front));
        wires.push(wire(rim(0.0).lerp(other(rim(0.0)), s), back));
        wires.push(wire(rim(1.0).lerp(other(rim(1.0)), s), front));
    }
    for (depth, thick) in [(0.0, 0.014), (0.25, 0.006), (0.5, 0.008), (0.75, 0.006), (1.0, 0.010)] {
        let level = |t: f64| rim(t).lerp(floor(t), depth);
        let corners = [level(0.0), level(1.0), other(level(1.0)), other(level(0.0))];
        wires.extend((0..4).map(|i| tube(&[corners[i], corners[(i + 1) % 4]], thick / 2.0, 4)));
    }
    wires
}

fn trolley_chassis() -> Vec<Solid> {
    let side = [
        [-0.47, 0.25, 1.02],
        [-0.44, 0.25, 0.92],
        [-0.40, 0.235, 0.50],
        [-0.42, 0.25, 0.22],
        [-0.36, 0.25, 0.165],
        [0.40, 0.17, 0.165],
    ];
    let mut chassis = vec![
        rod([0.40, -0.17, 0.165], [0.40, 0.17, 0.165], 0.013, 8),
        rod([-0.40, -0.235, 0.50], [-0.40, 0.235, 0.50], 0.011, 8),
    ];
    chassis.extend(tube(&spline(&side, 3), 0.013, 8).mirrored(Axis::Y));
    chassis.extend(rod([-0.30, 0.245, 0.17], [0.33, 0.17, 0.58], 0.010, 8).mirrored(Axis::Y));
    chassis
}

/// Pivot and fork of a castor whose wheel stands at this place.
fn castor([x, y]: Point) -> Vec<Solid> {
    let leg = |side: f64| plank([x + 0.02, y + side, 0.14], [x, y + side, 0.0625], DVec3::Y, [0.004, 0.035]);
    vec![cylinder(0.012, [0.13, 0.17], 8).at(x + 0.03, y, 0.0), leg(-0.02), leg(0.02)]
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
