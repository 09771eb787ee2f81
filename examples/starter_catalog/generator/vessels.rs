//! Small boats and parts of vessels: propellers, rowing boat, dinghy.

use ensonify::math::real::{atan2, cos, pow, sin};
use glam::DVec3;

use super::curve::{Point, circle, interpolate, smooth, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Ends, Path, capped, cuboid, dome, lathe, loft, plank, sweep, torus};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![propeller(), rowing_boat(), boat_propeller(), dinghy()]
}

/// The blades of a screw about z: tip and hub radius in metres, pitch in metres a turn (negative: left-handed).
#[must_use]
pub fn screw(tip: f64, hub: f64, pitch: f64, count: usize, steps: u32) -> Vec<Solid> {
    // Chord as a share of the tip radius: widest at two thirds, rounded off at the tip.
    let chords = [[0.0, 0.42], [0.3, 0.66], [0.55, 0.80], [0.75, 0.80], [0.88, 0.65], [0.96, 0.42], [1.0, 0.16]];
    let chords = smooth(&chords, 6);
    let rings: Vec<Vec<DVec3>> = (0..=steps)
        .map(|i| {
            let t = f64::from(i) / f64::from(steps);
            let radius = 0.8 * hub + (tip - 0.8 * hub) * t;
            let chord = tip * interpolate(&chords, t);
            let thick = tip * (0.085 * (1.0 - t) + 0.012);
            let slope = atan2(pitch, std::f64::consts::TAU * radius);
            let skew = 0.35 * pow(t, 2.0) * if pitch < 0.0 { 1.0 } else { -1.0 };
            lens(chord, thick).into_iter().map(|p| on_cylinder(p, radius, slope, skew)).collect()
        })
        .collect();
    capped(&rings).around(count)
}

/// A blade's section: (along the chord, across it).
fn lens(chord: f64, thick: f64) -> Vec<Point> {
    let half: [Point; 8] = [
        [-0.5, 0.04],
        [-0.44, 0.20],
        [-0.28, 0.40],
        [-0.08, 0.5],
        [0.12, 0.48],
        [0.30, 0.34],
        [0.44, 0.16],
        [0.5, 0.04],
    ];
    let upper = half.iter().map(|p| [chord * p[0], thick * p[1]]);
    let lower = half.iter().rev().map(|p| [chord * p[0], -0.6 * thick * p[1]]);
    upper.chain(lower).collect()
}

fn on_cylinder([along, across]: Point, radius: f64, slope: f64, skew: f64) -> DVec3 {
    let round = (along * cos(slope) - across * sin(slope)) / radius + skew;
    DVec3::new(radius * cos(round), radius * sin(round), along * sin(slope) + across * cos(slope))
}

/// A four-bladed ship's propeller, 1.4 m, lying on its blades.
fn propeller() -> Object {
    let mut hub: Vec<Point> = vec![
        [0.0, -0.17],
        [0.070, -0.17],
        [0.070, -0.165],
        [0.150, -0.165],
        [0.158, -0.155],
        [0.150, 0.02],
        [0.128, 0.15],
    ];
    hub.extend(dome(0.118, 0.16, 0.15, 6));
    Object {
        uid: "propeller",
        name: "ship's propeller",
        label: "propeller",
        tags: "screw;ship;wreck;vessel",
        parts: vec![
            Part::new("blades", Material::Steel, screw(0.70, 0.14, 1.25, 4, 16)),
            Part::new("hub", Material::Steel, [lathe(&hub, 40)]),
        ],
    }
}

/// An open rowing boat, 3.3 × 1.3 m: planked shell with keel, stem, transom, gunwales, three thwarts, upright.
fn rowing_boat() -> Object {
    let shell: Vec<Vec<DVec3>> = along(20).map(station).collect();
    let transom = [0.03, -0.005].map(|x| hull_line(0.0, 0.0).iter().map(|p| *p + DVec3::X * x).collect::<Vec<_>>());
    let thwarts = [0.12, 0.42, 0.70].map(|t| {
        // As wide as the shell is at the narrower of the board's two edges, at its underside.
        let width = 2.0 * half_breadth(t - 0.04, 0.30).min(half_breadth(t + 0.04, 0.30));
        cuboid([0.24, width, 0.025], [hull_line(t, 0.0)[0].x, 0.0, 0.32])
    });
    let (bow, head) = (keel(1.0), sheer(1.0));
    let stem = plank([bow.x - 0.04, 0.0, bow.z - 0.04], [bow.x + 0.04, 0.0, head + 0.05], DVec3::Y, [0.04, 0.08]);
    let rowlock_at = hull_line(0.34, 0.0)[0];
    let rowlock = torus(0.03, 0.014, [16, 6]).turned(Axis::X, 90.0);
    let rowlocks = rowlock.at(rowlock_at.x, rowlock_at.y - 0.01, rowlock_at.z + 0.04).mirrored(Axis::Y);
    let mut timber = vec![capped(&transom), keel_bar(), stem];
    timber.extend(gunwale().mirrored(Axis::Y));
    Object {
        uid: "rowing-boat",
        name: "rowing boat",
        label: "boat",
        tags: "rowing boat;dinghy;wreck;vessel",
        parts: vec![
            Part::new("shell", Material::Wood, [loft(&shell, Ends::Folds)]),
            Part::new("keel, stem, transom, gunwales", Material::Wood, timber),
            Part::new("thwarts", Material::Wood, thwarts),
            Part::new("ribs", Material::Wood, [0.22, 0.32, 0.52, 0.62].map(rib)),
            Part::new("rowlocks", Material::Steel, rowlocks),
        ],
    }
}

/// `pieces` + 1 shares of the boat's length from transom to stem.
fn along(pieces: u32) -> impl Iterator<Item = f64> {
    (0..=pieces).map(move |i| f64::from(i) / f64::from(pieces))
}

fn keel_bar() -> Solid {
    let section = [[-0.015, -0.05], [0.015, -0.05], [0.015, 0.005], [-0.015, 0.005]];
    let rings: Vec<Vec<DVec3>> =
        along(16).map(|t| section.map(|[y, z]| keel(t) + DVec3::new(0.0, y, z)).to_vec()).collect();
    capped(&rings)
}

/// The rail on the port edge of the shell.
fn gunwale() -> Solid {
    let section = [[0.012, -0.03], [0.012, 0.012], [-0.028, 0.012], [-0.028, -0.03]];
    let rings: Vec<Vec<DVec3>> =
        along(20).map(|t| section.map(|[y, z]| hull_line(t, 0.0)[0] + DVec3::new(0.0, y, z)).to_vec()).collect();
    capped(&rings)
}

/// A bent frame against the inside of the shell.
fn rib(t: f64) -> Solid {
    let (outside, inside) = (hull_line(t, 0.012), hull_line(t, 0.034));
    let at = |x: f64| outside.iter().chain(inside.iter().rev()).map(|p| *p + DVec3::X * x).collect::<Vec<_>>();
    loft(&[at(0.0), at(0.03)], Ends::Folds)
}

/// Height of the gunwale over the share of the length from transom to stem.
fn sheer(t: f64) -> f64 {
    0.48 + 0.55 * (t - 0.35) * (t - 0.35)
}

/// The keel's line from transom to stem.
fn keel(t: f64) -> DVec3 {
    DVec3::new(-1.65 + 3.25 * t, 0.0, 0.05 + 0.03 * (1.0 - t) + 0.32 * pow(t, 7.0))
}

/// Half the inside width at `t` and this height, metres; a thwart's ends stay within the shell.
fn half_breadth(t: f64, height: f64) -> f64 {
    let mut rising: Vec<Point> = hull_line(t, 0.010).iter().filter(|p| p.y >= 0.0).map(|p| [p.z, p.y]).collect();
    rising.reverse();
    interpolate(&rising, height)
}

/// The shell's section at `t`, `inset` metres inside its surface, from gunwale to gunwale.
fn hull_line(t: f64, inset: f64) -> Vec<DVec3> {
    let beam = interpolate(
        &[[0.0, 0.46], [0.15, 0.56], [0.35, 0.635], [0.5, 0.64], [0.65, 0.585], [0.8, 0.43], [0.9, 0.27], [1.0, 0.035]],
        t,
    );
    let foot = keel(t);
    let (half, depth) = (beam - inset.min(0.6 * beam), sheer(t) - foot.z - inset);
    // Full amidships, sharp towards the stem.
    let fullness = 0.52 + 0.5 * t * t;
    let steps: i32 = 8;
    (-steps..=steps)
        .map(|k| {
            let s = f64::from(-k) / f64::from(steps);
            let height = if inset > 0.0 && k.abs() == steps { depth } else { depth * pow(s.abs(), 2.2) };
            DVec3::new(foot.x + 0.05 * t * height, half * s.signum() * pow(s.abs(), fullness), foot.z + inset + height)
        })
        .collect()
}

/// The shell's section: out along its outside and back along its inside.
fn station(t: f64) -> Vec<DVec3> {
    let mut ring = hull_line(t, 0.0);
    ring.extend(hull_line(t, 0.014).iter().rev());
    ring
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
