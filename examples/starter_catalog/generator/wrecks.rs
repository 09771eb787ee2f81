//! Wrecks of steel and aluminium: a coaster, an aircraft.

use ensonify::math::real::{cos, radians, sin};
use glam::DVec3;

use super::curve::{Point, circle, interpolate, rectangle, smooth};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Ends, capped, cuboid, cylinder, lathe_ring, loft, rod, tube};
use super::solid::{Axis, Solid};
use super::vessels::screw;

pub fn all() -> Vec<Object> {
    vec![ship(), aircraft()]
}

/// Length, greatest half breadth and depth of the coaster, metres.
const LENGTH: f64 = 24.0;
const HALF_BEAM: f64 = 3.0;
const DEPTH: f64 = 3.2;

/// Half breadth of the deck at a share of the length from the stern.
fn half_breadth(t: f64) -> f64 {
    HALF_BEAM * interpolate(&[[0.0, 0.55], [0.12, 0.86], [0.3, 1.0], [0.7, 1.0], [0.88, 0.62], [1.0, 0.03]], t)
}

/// Height of the deck's edge: it rises towards both ends.
fn sheer(t: f64) -> f64 {
    DEPTH + 1.4 * (t - 0.45) * (t - 0.45) * 2.5
}

/// Plating at a station: out along the outside from side to side under the keel, back along the inside.
fn station(t: f64) -> Vec<DVec3> {
    let line = |plate: f64| -> Vec<DVec3> {
        let (b, top) = ((half_breadth(t) - plate).max(0.01), sheer(t));
        (-8..=8)
            .map(|i| {
                let u = f64::from(i) / 8.0;
                let (side, share) = (if u < 0.0 { -1.0 } else { 1.0 }, u.abs());
                // Flat of the bottom, turn of the bilge, then the side.
                let y = b * interpolate(&[[0.0, 0.0], [0.4, 0.72], [0.55, 0.92], [0.7, 0.99], [1.0, 1.0]], share);
                let z = interpolate(&[[0.0, 0.0], [0.4, 0.04], [0.55, 0.12], [0.7, 0.34], [1.0, 1.0]], share);
                DVec3::new(LENGTH * (t - 0.5), side * y, plate + z * (top - plate))
            })
            .collect()
    };
    line(0.0).into_iter().chain(line(0.06).into_iter().rev()).collect()
}

/// The shell between two shares of the length.
fn shell(from: f64, to: f64) -> Solid {
    let rings: Vec<Vec<DVec3>> = (0..=14).map(|i| station(from + (to - from) * f64::from(i) / 14.0)).collect();
    loft(&rings, Ends::Folds)
}

/// A frame that stands bare where the plating is gone.
fn frame(t: f64) -> Solid {
    let inside = &station(t)[17..];
    tube(inside, 0.07, 6)
}

/// The deck between two shares, with a hatch in it.
fn deck(from: f64, to: f64, hatch: [f64; 4]) -> Solid {
    let shares: Vec<f64> = (0..=10).map(|i| from + (to - from) * f64::from(i) / 10.0).collect();
    let edge = |t: f64, side: f64| [LENGTH * (t - 0.5), side * (half_breadth(t) - 0.03).max(0.02)];
    let mut outline: Vec<Point> = shares.iter().map(|&t| edge(t, -1.0)).collect();
    outline.extend(shares.iter().rev().map(|&t| edge(t, 1.0)));
    let [x, y, length, width] = hatch;
    let hole = rectangle(length, width).into_iter().map(|[u, v]| [u + x, v + y]).collect();
    prism(&outline, &[hole], [DEPTH - 0.5, DEPTH - 0.44])
}

/// Four walls without a roof.
fn house(size: [f64; 3], wall: f64, place: [f64; 3]) -> Solid {
    let inner = rectangle(size[0] - 2.0 * wall, size[1] - 2.0 * wall);
    prism(&rectangle(size[0], size[1]), &[inner], [0.0, size[2]]).at(place[0], place[1], place[2])
}

/// A steel coaster, 24 m: broken in two behind the hold, the stern turned over to one side, mast and funnel fallen.
fn ship() -> Object {
    let fore = |solid: Solid| solid.turned(Axis::X, 9.0);
    let aft = |solid: Solid| solid.turned(Axis::X, -24.0).turned(Axis::Z, 13.0).at(-1.6, 1.1, 0.2);
    let mut plating = vec![fore(shell(0.44, 0.995)), aft(shell(0.0, 0.36))];
    plating.extend([fore(deck(0.5, 0.97, [3.2, 0.0, 6.0, 3.4])), aft(deck(0.02, 0.34, [-7.6, 0.0, 1.6, 1.6]))]);
    let mut frames: Vec<Solid> = [0.405, 0.42, 0.432].map(|t| fore(frame(t))).into();
    frames.extend([0.375, 0.39].map(|t| aft(frame(t))));
    let coaming = house([6.2, 3.6, 0.7], 0.08, [3.2, 0.0, DEPTH - 0.46]);
    let bridge = house([3.2, 3.6, 2.3], 0.07, [-9.4, 0.0, DEPTH - 0.46]);
    let wheelhouse = house([2.0, 2.6, 1.9], 0.07, [-9.2, 0.0, DEPTH + 1.84]);
    let blades: Vec<Solid> =
        screw(0.75, 0.14, 0.9, 4, 6).into_iter().map(|s| aft(s.turned(Axis::Y, 90.0).at(-12.1, 0.0, 0.85))).collect();
    let mast = rod([6.5, 1.4, DEPTH], [8.2, 7.6, 0.3], 0.13, 8);
    let boom = rod([7.0, 2.0, DEPTH - 0.2], [2.0, 6.4, 0.25], 0.08, 8);
    let funnel = lathe_ring(&[[0.52, 0.0], [0.58, 0.0], [0.58, 2.4], [0.52, 2.4]], 24);
    let winch = cylinder(0.32, [-0.6, 0.6], 16).turned(Axis::X, 90.0).at(8.8, 0.0, DEPTH + 0.1);
    let plates = [[-3.4, -4.6, 20.0], [-1.2, 4.9, 60.0], [0.6, -4.4, -35.0]]
        .map(|[x, y, yaw]| cuboid([1.9, 1.3, 0.05], [0.0; 3]).turned(Axis::X, 9.0).turned(Axis::Z, yaw).at(x, y, 0.16));
    Object {
        uid: "shipwreck",
        name: "wreck of a steel coaster, 24 m",
        label: "shipwreck",
        tags: "ship;wreck;coaster;vessel;hull;cargo ship",
        parts: vec![
            Part::new("plating and decks", Material::Iron, plating),
            Part::new("frames", Material::Iron, frames),
            Part::new("houses", Material::Iron, vec![fore(coaming), aft(bridge), aft(wheelhouse)]),
            Part::new("propeller", Material::Iron, blades),
            Part::new("mast, boom, winch", Material::Iron, vec![mast, boom, fore(winch)]),
            Part::new(
                "funnel",
                Material::Iron,
                vec![funnel.turned(Axis::Y, 90.0).turned(Axis::Z, 70.0).at(-6.4, -5.2, 0.58)],
            ),
            Part::new("loose plates", Material::Iron, plates),
        ],
    }
}

/// A flat surface of an aircraft from root to tip: chord, thickness, and where the leading edge of each stands.
fn panel(root: [f64; 2], tip: [f64; 2], from: DVec3, to: DVec3) -> Solid {
    let ring = |[chord, thick]: [f64; 2], nose: DVec3| -> Vec<DVec3> {
        let profile =
            [[0.0, 0.0], [0.08, 0.36], [0.3, 0.5], [0.65, 0.32], [1.0, 0.02], [0.65, -0.2], [0.3, -0.3], [0.08, -0.24]];
        profile.map(|[x, z]| nose + DVec3::new(-x * chord, 0.0, z * thick)).to_vec()
    };
    capped(&[ring(root, from), ring(tip, to)])
}

/// A single-engined fighter, 9 m long: one wing broken off and lying beside, the propeller bent.
fn aircraft() -> Object {
    let outline =
        smooth(&[[-4.6, 0.12], [-3.2, 0.34], [-1.2, 0.55], [0.6, 0.66], [2.2, 0.68], [3.6, 0.62], [4.2, 0.5]], 4);
    let rings: Vec<Vec<DVec3>> = outline
        .iter()
        .map(|&[x, r]| circle(1.0, 20).into_iter().map(|[y, z]| DVec3::new(x, 0.82 * r * y, 1.05 * r * z)).collect())
        .collect();
    let body = capped(&rings);
    let canopy = capped(&[[-0.9, 0.06], [-0.5, 0.3], [0.3, 0.38], [1.0, 0.26], [1.3, 0.05]].map(|[x, r]: Point| {
        circle(r, 12).into_iter().map(|[y, z]| DVec3::new(x, 0.9 * y, 0.55 + z)).collect::<Vec<_>>()
    }));
    let wing = panel([2.4, 0.34], [1.1, 0.14], DVec3::new(1.7, 0.4, -0.35), DVec3::new(1.2, 5.2, 0.05));
    let stump = panel([2.4, 0.34], [2.1, 0.28], DVec3::new(1.7, -0.4, -0.35), DVec3::new(1.6, -1.5, -0.26));
    let broken = panel([2.0, 0.26], [1.1, 0.14], DVec3::ZERO, DVec3::new(-0.4, -3.6, 0.1));
    let tail =
        panel([1.0, 0.12], [0.6, 0.06], DVec3::new(-3.5, 0.1, 0.15), DVec3::new(-3.8, 1.7, 0.2)).mirrored(Axis::Y);
    let fin =
        panel([1.3, 0.12], [0.7, 0.06], DVec3::new(-3.3, 0.0, 0.2), DVec3::new(-3.9, 1.5, 0.0)).turned(Axis::X, 90.0);
    let blade = |turn: f64, bend: f64| {
        let points: Vec<DVec3> = (0..=5)
            .map(|i| {
                let out = 0.15 + 0.27 * f64::from(i);
                DVec3::new(4.35 - bend * out * out, out * sin(radians(turn)), out * cos(radians(turn)))
            })
            .collect();
        tube(&points, 0.075, 6)
    };
    let mut blades: Vec<Solid> =
        [(70.0, 0.25), (190.0, 0.6), (310.0, 0.1)].map(|(turn, bend)| blade(turn, bend)).into();
    blades.push(cylinder(0.16, [4.1, 4.6], 16).turned(Axis::Y, 90.0));
    // On its belly, one wing low; its middle a little above the ground.
    let lying = |solid: Solid| solid.turned(Axis::X, -6.0);
    let metal = [vec![body, wing, stump, fin], tail.into()].concat();
    let mut hull: Vec<Solid> = metal.into_iter().map(lying).collect();
    hull.push(broken.turned(Axis::Z, 28.0).at(0.4, -2.6, -0.52));
    Object {
        uid: "aircraft",
        name: "wreck of a single-engined fighter, 9 m",
        label: "aircraft",
        tags: "plane;airplane;aeroplane;fighter;warbird;wreck",
        parts: vec![
            Part::new("body, wings, tail", Material::Aluminium, hull),
            Part::new("canopy", Material::Glass, vec![lying(canopy)]),
            Part::new("propeller", Material::Steel, blades.into_iter().map(lying).collect::<Vec<_>>()),
        ],
    }
}
