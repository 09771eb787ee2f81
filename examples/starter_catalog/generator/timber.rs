//! Wooden hulls and a yacht: the wreck of a sailing ship, a sunk sailing boat, a plank.

use ensonify::math::real::{cos, pow, sin};
use glam::DVec3;

use super::body::wing;
use super::curve::{Point, interpolate, rectangle, spline};
use super::noise::Noise;
use super::object::{Material, Object, Part};
use super::shape::{Path, capped, cuboid, cylinder, icosphere, plank, rod, sweep};
use super::solid::{Axis, Solid, turn};

pub fn all() -> Vec<Object> {
    vec![wooden_wreck(), sailboat(), loose_plank()]
}

/// Length on the keel and greatest half breadth of the ship, metres.
const LENGTH: f64 = 15.0;
const HALF_BEAM: f64 = 2.5;

/// A point of the hull at a share of the length from the stern and a share of the girth from the keel to the rail.
fn moulded(t: f64, girth: f64) -> DVec3 {
    let beam = HALF_BEAM
        * interpolate(
            &[[0.0, 0.30], [0.1, 0.62], [0.25, 0.92], [0.45, 1.0], [0.7, 0.95], [0.88, 0.62], [1.0, 0.12]],
            t,
        );
    let hollow = interpolate(&[[0.0, 1.6], [0.15, 1.1], [0.35, 0.75], [0.65, 0.75], [0.85, 1.0], [1.0, 1.5]], t);
    let up = 2.7 * pow(girth, 1.55) + 0.35 * (2.0 * t - 1.0) * (2.0 * t - 1.0) * girth;
    DVec3::new(LENGTH * (t - 0.5), beam * pow(sin(std::f64::consts::FRAC_PI_2 * girth), hollow), up)
}

/// How much of the girth is left of the frames of a side: high at the ends, broken low amidships.
fn left_standing(noise: &Noise, t: f64, side: f64) -> f64 {
    let share = interpolate(&[[0.0, 0.86], [0.2, 0.72], [0.45, 0.48], [0.7, 0.62], [0.9, 0.88], [1.0, 0.95]], t);
    (share + 0.10 * side + 0.28 * noise.at(DVec3::new(31.0 * t, 2.0 * side + 0.4, 0.6))).clamp(0.28, 1.0)
}

fn frame(t: f64, side: f64, top: f64) -> Solid {
    let path: Vec<DVec3> = (0..=6)
        .map(|i| moulded(t, 0.03 + (top - 0.03) * f64::from(i) / 6.0))
        .map(|p| DVec3::new(p.x, side * p.y, p.z + 0.05))
        .collect();
    let end = [0.02, -0.03][usize::from(side > 0.0)];
    let path: Vec<DVec3> = path.iter().enumerate().map(|(i, p)| *p + DVec3::X * (end * (i as f64 / 6.0))).collect();
    sweep(&path, Path::Open, DVec3::X, |i| rectangle(0.17, 0.17 - 0.01 * i as f64))
}

/// A strake on the outside of the frames from one share of the length to another.
fn strake(from: f64, to: f64, girth: f64, side: f64) -> Solid {
    let path: Vec<DVec3> = (0..=5)
        .map(|i| moulded(from + (to - from) * f64::from(i) / 5.0, girth))
        .map(|p| DVec3::new(p.x, side * (p.y + 0.06), p.z - 0.02))
        .collect();
    let steep = girth * 1.3 - 0.25;
    sweep(&path, Path::Open, DVec3::new(0.0, side * cos(steep), sin(steep)), |_| rectangle(0.30, 0.06))
}

/// The wreck of a wooden sailing ship, 17 m: keel, stem and sternpost, bare frames, strakes left low on the sides, keelson with
/// a mast's stump, ballast stones, loose planks.
fn wooden_wreck() -> Object {
    let noise = Noise::of("shipwreck-wooden");
    let heel = |solid: Solid| solid.turned(Axis::X, 9.0);
    let (frames, strakes) = sides(&noise);
    let beams = [[-4.6, 2.0, 1.9], [-3.4, 2.1, 1.7], [5.2, 1.7, 2.0]]
        .map(|[x, y, z]| plank([x, -y, z - 0.2], [x + 0.15, y, z], DVec3::X, [0.2, 0.2]));
    let windlass = [
        cylinder(0.24, [-1.1, 1.1], 12).turned(Axis::X, 90.0).at(5.9, 0.0, 1.75),
        plank([5.9, -0.9, 0.5], [5.9, -0.9, 2.2], DVec3::X, [0.25, 0.16]),
        plank([5.9, 0.9, 0.5], [5.9, 0.9, 2.2], DVec3::X, [0.25, 0.16]),
    ];
    Object {
        uid: "shipwreck-wooden",
        name: "wreck of a wooden sailing ship, 17 m",
        label: "shipwreck",
        tags: "wooden wreck;wooden ship;sailing ship;ship;wreck;vessel;hull;archaeology;ribs",
        parts: vec![
            Part::new("frames", Material::Wood, frames.into_iter().map(heel).collect::<Vec<_>>()),
            Part::new("strakes", Material::Wood, strakes.into_iter().map(heel).collect::<Vec<_>>()),
            Part::new("keel, stem, stern", Material::Wood, spine().into_iter().map(heel).collect::<Vec<_>>()),
            Part::new(
                "beams and windlass",
                Material::Wood,
                beams.into_iter().chain(windlass).map(heel).collect::<Vec<_>>(),
            ),
            Part::new("ballast", Material::Rock, ballast(&noise).into_iter().map(heel).collect::<Vec<_>>()),
            Part::new("loose timber", Material::Wood, loose_timber()),
        ],
    }
}

/// Frames and strakes of both sides.
fn sides(noise: &Noise) -> (Vec<Solid>, Vec<Solid>) {
    let mut frames = Vec::new();
    let mut strakes = Vec::new();
    for (k, side) in [-1.0, 1.0].into_iter().enumerate() {
        let stations = (0..23).map(|i| 0.03 + 0.94 * f64::from(i) / 22.0);
        // A few are gone altogether.
        frames.extend(
            stations
                .enumerate()
                .filter(|(i, _)| ![9, 15].contains(&(i + 4 * k)))
                .map(|(_, t)| frame(t, side, left_standing(noise, t, side))),
        );
        for row in 0..7 {
            let girth = 0.10 + 0.095 * f64::from(row);
            let inner = 0.10 * f64::from(row) * (1.0 + 0.5 * noise.at(DVec3::new(f64::from(row) * 1.7, side, 4.2)));
            if row < 3 {
                strakes.push(strake(0.03, 0.97, girth, side));
            } else {
                strakes.push(strake(0.02, 0.42 - 0.45 * inner, girth, side));
                strakes.push(strake(0.50 + 0.45 * inner, 0.97, girth, side));
            }
        }
    }
    (frames, strakes)
}

/// Keel, keelson, mast's stump, transom, rudder, stem and sternpost.
fn spine() -> Vec<Solid> {
    let curved = |points: &[[f64; 3]], size: Point| {
        sweep(&spline(points, 4), Path::Open, DVec3::Y, |_| rectangle(size[0], size[1]))
    };
    let stem =
        curved(&[[7.0, 0.0, -0.1], [7.7, 0.0, 0.25], [8.1, 0.0, 1.2], [8.3, 0.0, 2.4], [8.35, 0.0, 3.0]], [0.26, 0.34]);
    let post = curved(&[[-7.4, 0.0, -0.1], [-7.6, 0.0, 0.9], [-7.9, 0.0, 2.3]], [0.26, 0.36]);
    let spine = [
        plank([-7.6, 0.0, -0.12], [7.3, 0.0, -0.12], DVec3::Y, [0.30, 0.34]),
        plank([-6.6, 0.0, 0.26], [6.2, 0.0, 0.26], DVec3::Y, [0.28, 0.26]),
        cylinder(0.24, [0.3, 1.5], 14).turned(Axis::Y, 8.0).at(1.2, 0.0, 0.0),
        cuboid([0.10, 2.2, 1.5], [-7.55, 0.0, 1.9]),
        plank([-7.8, 0.0, 0.1], [-8.3, 0.0, 2.2], DVec3::Y, [0.10, 0.7]),
    ];
    spine.into_iter().chain([stem, post]).collect()
}

/// A heap of stones amidships.
fn ballast(noise: &Noise) -> Vec<Solid> {
    let stones = (0..26).map(|i| {
        let [u, v, w] = [1.3, 2.7, 4.9].map(|k| noise.at(DVec3::new(k * f64::from(i) + 0.37, k, 0.21 * f64::from(i))));
        let size = 0.17 + 0.10 * w.abs();
        let rough = move |p: DVec3| DVec3::new(p.x * 1.2, p.y, 0.75 * p.z) * size;
        let x = -2.6 + 0.145 * f64::from(i) + 1.2 * u;
        icosphere(2).mapped(rough).turned(Axis::Z, 40.0 * f64::from(i)).at(x, 1.5 * v, 0.34 + 0.35 * (0.5 - v.abs()))
    });
    stones.collect()
}

/// Planks and a spar on the bottom beside the wreck.
fn loose_timber() -> Vec<Solid> {
    let litter = [
        [-3.0, -4.0, 25.0],
        [0.5, -3.6, -12.0],
        [3.6, -4.2, 55.0],
        [-1.0, 4.1, 8.0],
        [4.4, 3.7, -40.0],
        [-5.6, 3.4, 70.0],
    ];
    let litter =
        litter.map(|[x, y, turn]| cuboid([3.2, 0.28, 0.07], [0.0, 0.0, 0.0]).turned(Axis::Z, turn).at(x, y, -0.24));
    let spar = rod([-6.0, -4.6, -0.13], [3.0, -3.2, -0.13], 0.14, 10);
    litter.into_iter().chain([spar]).collect()
}

/// A closed section of the yacht at a share of its length from the transom: round below, nearly flat deck above.
fn yacht_section(t: f64) -> Vec<DVec3> {
    let beam = interpolate(&[[0.0, 0.95], [0.2, 1.16], [0.45, 1.25], [0.7, 0.98], [0.9, 0.40], [1.0, 0.03]], t);
    let depth = interpolate(&[[0.0, 0.12], [0.2, 0.34], [0.45, 0.48], [0.7, 0.40], [0.9, 0.18], [1.0, -0.25]], t);
    let deck = 0.78 + 0.30 * t * t;
    let x = 7.4 * (t - 0.5) + 0.25 * (t - 0.5);
    let mut ring: Vec<DVec3> = (0..=14)
        .map(|i| std::f64::consts::PI * f64::from(i) / 14.0)
        .map(|a| {
            DVec3::new(x, beam * cos(a).signum() * pow(cos(a).abs(), 0.75), deck - (deck + depth) * pow(sin(a), 0.8))
        })
        .collect();
    ring.extend([-0.5, 0.0, 0.5].map(|y| DVec3::new(x, y * beam, deck + 0.05 * (1.0 - y.abs()))));
    ring
}

/// A sailing yacht of 7.6 m, sunk with her mast standing, heeled over on fin keel and bilge.
fn sailboat() -> Object {
    let rings: Vec<Vec<DVec3>> = (0..=14).map(|i| yacht_section(f64::from(i) / 14.0)).collect();
    let keel = wing([1.7, 0.22], [1.15, 0.15], DVec3::new(0.75, 0.0, -0.35), DVec3::new(0.45, 0.0, -1.35));
    let bulb = cylinder(0.13, [-0.75, 0.5], 12).turned(Axis::Y, 90.0).at(0.0, 0.0, -1.37);
    let rudder = wing([0.42, 0.08], [0.32, 0.05], DVec3::new(-3.25, 0.0, 0.0), DVec3::new(-3.35, 0.0, -0.95));
    let level = |from: f64, to: f64, half: f64, z: f64| -> Vec<DVec3> {
        [[from, -half], [to, -0.7 * half], [to, 0.7 * half], [from, half]].map(|[x, y]| DVec3::new(x, y, z)).to_vec()
    };
    let cabin = capped(&[level(-0.7, 2.0, 0.85, 0.75), level(-0.65, 1.6, 0.74, 1.22), level(-0.62, 1.5, 0.66, 1.26)]);
    let coaming = cuboid([2.0, 0.10, 0.24], [-1.7, 0.72, 0.94]).mirrored(Axis::Y);
    let windows = cuboid([0.55, 0.05, 0.16], [0.1, 0.76, 1.02]).mirrored(Axis::Y);
    let mast = rod([0.95, 0.0, 0.5], [0.75, 0.0, 9.2], 0.07, 10);
    let boom = rod([0.90, 0.0, 1.75], [-2.1, 0.55, 1.62], 0.05, 8);
    let spreaders = rod([0.85, 0.0, 5.2], [0.75, 0.65, 5.25], 0.025, 6).mirrored(Axis::Y);
    let stays = [
        rod([0.75, 0.0, 9.15], [3.75, 0.0, 1.06], 0.012, 5),
        rod([0.75, 0.0, 9.15], [-3.65, 0.0, 0.82], 0.012, 5),
        rod([0.75, 0.0, 9.1], [0.7, 1.15, 0.86], 0.012, 5),
        rod([0.75, 0.0, 9.1], [0.7, -1.15, 0.86], 0.012, 5),
    ];
    let pulpit: Vec<Solid> = [[3.6, 0.12], [2.9, 0.5], [-3.55, 0.85]]
        .into_iter()
        .flat_map(|[x, y]| rod([x, y, 0.8], [x, y, 1.45], 0.02, 6).mirrored(Axis::Y))
        .chain(rod([3.62, 0.0, 1.45], [2.9, 0.5, 1.45], 0.02, 6).at(0.0, 0.02, 0.0).mirrored(Axis::Y))
        .collect();
    let lean = turn(Axis::X, 52.0);
    let lying = |part: Part| part.mapped(|p| lean * p);
    Object {
        uid: "sailboat",
        name: "sailing yacht, 7.6 m, sunk",
        label: "sailboat",
        tags: "sailing boat;yacht;sloop;boat;wreck;vessel;hull",
        parts: vec![
            lying(Part::new(
                "hull and deck",
                Material::Plastic,
                [capped(&rings), cabin].into_iter().chain(coaming).collect::<Vec<_>>(),
            )),
            lying(Part::new("keel", Material::Iron, [keel, bulb])),
            lying(Part::new("rudder", Material::Plastic, [rudder])),
            lying(Part::new("windows", Material::Glass, windows)),
            lying(Part::new("mast and boom", Material::Aluminium, [vec![mast, boom], spreaders.into()].concat())),
            lying(Part::new("rigging", Material::Steel, [stays.to_vec(), pulpit].concat())),
        ],
    }
}

/// A waterlogged plank, 2.4 m × 220 mm × 45 mm, warped, one end splintered.
fn loose_plank() -> Object {
    let noise = Noise::of("plank");
    let rings: Vec<Vec<DVec3>> = (0..=24)
        .map(|i| -1.2 + 0.1 * f64::from(i))
        .map(|x| {
            let twist = turn(Axis::X, 5.0 * x);
            let sag = 0.02 * x * x;
            let outline = [
                [0.11, -0.0225],
                [0.11, 0.0225],
                [0.04, 0.0225],
                [-0.04, 0.0225],
                [-0.11, 0.0225],
                [-0.11, -0.0225],
                [-0.04, -0.0225],
                [0.04, -0.0225],
            ];
            outline
                .map(|[y, z]| {
                    let split = if x > 1.15 { 0.12 * noise.at(DVec3::new(14.0 * y, 0.5, 1.5)) + 0.05 } else { 0.0 };
                    twist * DVec3::new(x + split, y, z + 0.006 * noise.at(DVec3::new(3.0 * x, 9.0 * y, z)))
                        + DVec3::Z * sag
                })
                .to_vec()
        })
        .collect();
    Object {
        uid: "plank",
        name: "wooden plank, 2.4 m",
        label: "plank",
        tags: "board;timber;driftwood;lumber;wood",
        parts: vec![Part::new("plank", Material::Wood, [capped(&rings)])],
    }
}
