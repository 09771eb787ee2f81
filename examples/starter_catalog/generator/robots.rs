//! Vehicles under water: a survey vehicle, a glider, a remotely operated vehicle, a midget submarine.

use glam::DVec3;

use super::body::{body, wing};
use super::curve::{Point, ellipse, rounded_rectangle, smooth, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{capped, cuboid, cylinder, dome, lathe, lathe_ring, rod, tube};
use super::solid::{Axis, Solid};
use super::vessels::screw;

pub fn all() -> Vec<Object> {
    vec![auv(), glider(), rov(), submarine()]
}

/// A body turned about x, its nose ahead.
fn along_x(profile: &[Point], around: usize) -> Solid {
    lathe(profile, around).turned(Axis::Y, 90.0)
}

/// A torpedo-shaped survey vehicle, 0.2 × 2.0 m: side-scan strips, Doppler log below, mast above, four fins, one screw.
fn auv() -> Object {
    let radius = 0.100;
    let mut profile: Vec<Point> = vec![[0.0, -0.90], [0.026, -0.90]];
    profile.extend(smooth(&[[0.034, -0.88], [0.058, -0.78], [0.085, -0.64], [radius, -0.48]], 3));
    for joint in [-0.30, 0.28, 0.62] {
        profile.extend([
            [radius, joint - 0.008],
            [radius - 0.003, joint - 0.005],
            [radius - 0.003, joint + 0.005],
            [radius, joint + 0.008],
        ]);
    }
    profile.extend(dome(radius, 0.80, 0.17, 7));
    let fins = wing([0.15, 0.018], [0.10, 0.010], DVec3::new(-0.68, 0.0, 0.05), DVec3::new(-0.71, 0.0, 0.175));
    let fins: Vec<Solid> = (0..4).map(|i| fins.clone().turned(Axis::X, 45.0 + 90.0 * f64::from(i))).collect();
    let blades: Vec<Solid> = screw(0.085, 0.024, 0.14, 3, 6)
        .into_iter()
        .map(|blade| blade.turned(Axis::Y, 90.0).at(-0.945, 0.0, 0.0))
        .collect();
    let hub = along_x(&[[0.0, -1.0], [0.012, -0.99], [0.024, -0.96], [0.026, -0.895], [0.0, -0.895]], 16);
    let strips = cuboid([0.50, 0.02, 0.035], [0.0, 0.096, -0.03]).mirrored(Axis::Y);
    let log: Vec<Solid> = [[0.40, 0.035], [0.40, -0.035], [0.47, 0.035], [0.47, -0.035]]
        .map(|[x, y]| cylinder(0.026, [-0.112, -0.06], 14).at(x, y, 0.0))
        .into();
    let mast = wing([0.11, 0.03], [0.07, 0.02], DVec3::new(0.14, 0.0, 0.09), DVec3::new(0.11, 0.0, 0.26));
    let handle = [
        rod([0.50, 0.0, 0.08], [0.50, 0.0, 0.135], 0.009, 8),
        rod([0.70, 0.0, 0.06], [0.70, 0.0, 0.135], 0.009, 8),
        rod([0.49, 0.0, 0.135], [0.71, 0.0, 0.135], 0.010, 8),
    ];
    Object {
        uid: "auv",
        name: "torpedo-shaped survey AUV, 2 m",
        label: "auv",
        tags: "autonomous underwater vehicle;survey vehicle;robot;underwater robot;vehicle",
        parts: vec![
            Part::new("hull", Material::Aluminium, [along_x(&profile, 36)]),
            Part::new("fins and mast", Material::Plastic, [fins, vec![mast]].concat()),
            Part::new("screw", Material::Plastic, [blades, vec![hub]].concat()),
            Part::new("transducers", Material::Ceramic, [strips.to_vec(), log].concat()),
            Part::new("handle", Material::Steel, handle),
        ],
    }
}

/// A buoyancy-driven glider, 1.8 m with its antenna, wings of 1.0 m swept back.
fn glider() -> Object {
    let radius = 0.11;
    let mut hull: Vec<Point> = vec![[0.0, -0.42], [radius - 0.004, -0.42], [radius, -0.416]];
    for joint in [-0.12, 0.20] {
        hull.extend([
            [radius, joint - 0.008],
            [radius - 0.003, joint - 0.005],
            [radius - 0.003, joint + 0.005],
            [radius, joint + 0.008],
        ]);
    }
    hull.extend([[radius, 0.446], [radius - 0.004, 0.45], [0.0, 0.45]]);
    let mut nose: Vec<Point> = vec![[0.0, 0.44], [radius, 0.44]];
    nose.extend(smooth(&[[0.108, 0.50], [0.094, 0.60], [0.066, 0.68], [0.030, 0.722]], 3));
    nose.push([0.0, 0.73]);
    let mut tail: Vec<Point> = vec![[0.0, -0.80], [0.024, -0.80]];
    tail.extend(smooth(&[[0.032, -0.78], [0.058, -0.68], [0.090, -0.54], [radius, -0.42]], 3));
    tail.push([0.0, -0.41]);
    let wings =
        wing([0.16, 0.012], [0.10, 0.006], DVec3::new(0.06, 0.09, 0.0), DVec3::new(-0.36, 0.50, 0.0)).mirrored(Axis::Y);
    let fin = wing([0.20, 0.025], [0.13, 0.014], DVec3::new(-0.62, 0.0, 0.02), DVec3::new(-0.70, 0.0, 0.24));
    let boom = rod([-0.78, 0.0, 0.0], [-1.07, 0.0, 0.03], 0.012, 10);
    let sensor = cuboid([0.22, 0.035, 0.06], [0.12, 0.0, -0.12]);
    Object {
        uid: "glider",
        name: "underwater glider, 1.8 m",
        label: "auv",
        tags: "underwater glider;glider;autonomous underwater vehicle;profiler;ocean glider;robot;vehicle",
        parts: vec![
            Part::new("hull", Material::Aluminium, [along_x(&hull, 36)]),
            Part::new("nose and tail", Material::Plastic, [along_x(&nose, 36), along_x(&tail, 36)]),
            Part::new("wings", Material::Plastic, wings),
            Part::new("tail fin", Material::Plastic, [fin]),
            Part::new("antenna, sensor", Material::Plastic, [boom, sensor]),
        ],
    }
}

/// A thruster about z: duct, motor, three blades.
fn thruster() -> Vec<Solid> {
    let duct = lathe_ring(&[[0.050, -0.03], [0.056, -0.032], [0.060, 0.0], [0.056, 0.032], [0.050, 0.03]], 24);
    let motor = lathe(&[[0.0, -0.045], [0.014, -0.040], [0.020, -0.02], [0.020, 0.03], [0.0, 0.035]], 12);
    let struts = rod([-0.053, 0.0, 0.01], [0.053, 0.0, 0.01], 0.004, 4);
    [vec![duct, motor, struts], screw(0.047, 0.018, 0.08, 3, 2)].concat()
}

/// An observation ROV, its frame 0.72 × 0.45 × 0.43 m: foam on an open frame, six thrusters, electronics tube with camera dome, lamps,
/// gripper, tether.
fn rov() -> Object {
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0);
    let bars = [[-0.30, 0.03], [0.30, 0.03], [-0.28, 0.27], [0.28, 0.27], [0.0, 0.03]]
        .map(|[x, z]| rod([x, -0.22, z], [x, 0.22, z], 0.012, 8));
    let housing = lying(lathe(
        &[
            [0.0, -0.20],
            [0.085, -0.20],
            [0.085, -0.18],
            [0.078, -0.175],
            [0.078, 0.175],
            [0.085, 0.18],
            [0.085, 0.20],
            [0.0, 0.20],
        ],
        28,
    ))
    .at(0.02, 0.0, 0.19);
    let battery = lying(lathe(&[[0.0, -0.16], [0.055, -0.16], [0.055, 0.16], [0.0, 0.16]], 20)).at(-0.02, 0.0, 0.075);
    let mut cap: Vec<Point> = vec![[0.0, 0.195]];
    cap.extend(dome(0.076, 0.20, 0.07, 6));
    let camera = lying(lathe(&cap, 28)).at(0.02, 0.0, 0.19);
    let lamps = [[0.14, 0.27], [0.14, 0.10]].into_iter().flat_map(|[y, z]| {
        lying(lathe(&[[0.0, 0.24], [0.022, 0.24], [0.030, 0.29], [0.028, 0.33], [0.0, 0.335]], 14))
            .at(0.0, y, z)
            .mirrored(Axis::Y)
    });
    let gripper = [
        rod([0.26, 0.0, 0.05], [0.42, 0.0, 0.05], 0.016, 10),
        rod([0.42, 0.010, 0.05], [0.49, 0.03, 0.05], 0.007, 6),
        rod([0.42, -0.010, 0.05], [0.49, -0.03, 0.05], 0.007, 6),
    ];
    let tether =
        tube(&spline(&[[-0.19, 0.0, 0.22], [-0.34, 0.0, 0.27], [-0.42, 0.03, 0.40], [-0.46, 0.08, 0.58]], 5), 0.006, 8);
    Object {
        uid: "rov",
        name: "observation ROV, open frame",
        label: "rov",
        tags: "remotely operated vehicle;underwater robot;robot;inspection vehicle;vehicle",
        parts: vec![
            Part::new("frame", Material::Plastic, rov_frame()),
            Part::new(
                "tubes and bars",
                Material::Aluminium,
                [vec![housing, battery], bars.into(), gripper.into()].concat(),
            ),
            Part::new("camera and lamps", Material::Glass, lamps.chain([camera]).collect::<Vec<_>>()),
            Part::new("thrusters", Material::Plastic, rov_thrusters()),
            Part::new("tether", Material::Rubber, [tether]),
        ],
    }
}

/// Two side plates on skids, brackets, two blocks of foam.
fn rov_frame() -> Vec<Solid> {
    let plate = {
        let outline = [[-0.34, 0.0], [0.34, 0.0], [0.36, 0.05], [0.32, 0.30], [-0.32, 0.30], [-0.36, 0.05]];
        let hole = |x: f64, z: f64, w: f64, h: f64| {
            rounded_rectangle(w, h, 0.03, 3).into_iter().map(|p| [p[0] + x, p[1] + z]).collect()
        };
        prism(&outline, &[hole(-0.17, 0.15, 0.22, 0.17), hole(0.16, 0.15, 0.22, 0.17)], [-0.007, 0.007])
            .turned(Axis::X, 90.0)
    };
    let plates = [-0.22, 0.22].map(|y| plate.clone().at(0.0, y, 0.0));
    let skids = cuboid([0.70, 0.04, 0.02], [0.0, 0.22, 0.0]).mirrored(Axis::Y);
    let foam = |y: f64| {
        let ring = |shrink: f64, z: f64| -> Vec<DVec3> {
            rounded_rectangle(0.66 - shrink, 0.21 - shrink, 0.05, 4)
                .into_iter()
                .map(|[u, v]| DVec3::new(u, v + y, z))
                .collect()
        };
        capped(&[ring(0.02, 0.295), ring(0.0, 0.31), ring(0.0, 0.40), ring(0.05, 0.43)])
    };
    let mounts = cuboid([0.05, 0.06, 0.02], [0.0, 0.225, 0.31]).mirrored(Axis::Y);
    [plates.to_vec(), skids.into(), mounts.into(), vec![foam(0.115), foam(-0.115)]].concat()
}

/// Four that push along and across, two that push up.
fn rov_thrusters() -> Vec<Solid> {
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0);
    let mut thrusters = Vec::new();
    for (x, turn) in [(0.23, 45.0), (-0.23, -45.0)] {
        for solid in thruster() {
            thrusters.extend(lying(solid).turned(Axis::Z, turn).at(x, 0.15, 0.17).mirrored(Axis::Y));
        }
    }
    thrusters.extend(thruster().into_iter().flat_map(|solid| solid.at(0.0, 0.29, 0.34).mirrored(Axis::Y)));
    thrusters
}

/// A midget submarine of the second world war, 12 m: spindle hull with its keel, low tower with dome, two torpedoes alongside,
/// shrouded screw, rudders.
fn submarine() -> Object {
    let hull = body(
        &[
            [-5.75, 0.06, 0.08, 0.10],
            [-5.2, 0.20, 0.26, 0.08],
            [-4.0, 0.46, 0.56, 0.03],
            [-2.0, 0.70, 0.80, 0.0],
            [0.5, 0.74, 0.84, 0.0],
            [3.0, 0.68, 0.78, 0.0],
            [4.6, 0.48, 0.60, 0.04],
            [5.6, 0.22, 0.34, 0.10],
            [6.0, 0.05, 0.12, 0.14],
        ],
        4,
        28,
    );
    let keel = cuboid([6.6, 0.5, 0.34], [0.2, 0.0, -0.85]);
    let deck = body(
        &[
            [-4.4, 0.10, 0.08, 0.62],
            [-3.2, 0.28, 0.16, 0.78],
            [0.0, 0.32, 0.18, 0.86],
            [3.4, 0.28, 0.16, 0.76],
            [4.9, 0.10, 0.10, 0.58],
        ],
        3,
        14,
    );
    let tower = |half: f64, length: f64, z: f64| -> Vec<DVec3> {
        ellipse(length / 2.0, half, 24).into_iter().map(|[x, y]| DVec3::new(x + 0.35, y, z)).collect()
    };
    let tower =
        capped(&[tower(0.40, 1.9, 0.75), tower(0.36, 1.6, 1.30), tower(0.33, 1.45, 1.42), tower(0.28, 1.3, 1.45)]);
    let mut dome_line: Vec<Point> = vec![[0.0, 1.40], [0.19, 1.40]];
    dome_line.extend(dome(0.18, 1.46, 0.15, 5));
    let hatch = lathe(&dome_line, 20).at(0.55, 0.0, 0.0);
    let pipes = [
        rod([0.05, 0.0, 1.4], [0.05, 0.0, 2.75], 0.045, 10),
        rod([0.0, 0.0, 2.72], [0.14, 0.0, 2.72], 0.055, 10),
        rod([-0.35, 0.0, 1.3], [-0.35, 0.0, 2.2], 0.06, 10),
    ];
    let mut eel: Vec<Point> = vec![[0.0, -3.5], [0.05, -3.48], [0.20, -2.7], [0.2665, -2.0], [0.2665, 3.0]];
    eel.extend(smooth(&[[0.262, 3.2], [0.22, 3.42], [0.12, 3.55]], 2));
    eel.push([0.0, 3.58]);
    let eels = along_x(&eel, 24).at(-0.2, 0.86, -0.62).mirrored(Axis::Y);
    let clamps = [-1.6, 1.6].into_iter().flat_map(|x| cuboid([0.12, 0.34, 0.16], [x, 0.68, -0.40]).mirrored(Axis::Y));
    let shroud = lathe_ring(&[[0.34, -0.16], [0.37, -0.16], [0.38, 0.16], [0.33, 0.16]], 28)
        .turned(Axis::Y, 90.0)
        .at(-6.0, 0.0, 0.10);
    let blades: Vec<Solid> =
        screw(0.31, 0.08, 0.5, 3, 5).into_iter().map(|blade| blade.turned(Axis::Y, 90.0).at(-6.0, 0.0, 0.10)).collect();
    let hub = along_x(&[[0.0, -6.16], [0.05, -6.12], [0.08, -6.0], [0.08, -5.7], [0.0, -5.7]], 14).at(0.0, 0.0, 0.10);
    let rudders = [
        wing([0.9, 0.08], [0.6, 0.05], DVec3::new(-5.0, 0.0, 0.2), DVec3::new(-5.3, 0.0, 0.85)),
        wing([0.9, 0.08], [0.6, 0.05], DVec3::new(-5.0, 0.0, -0.1), DVec3::new(-5.3, 0.0, -0.72)),
    ];
    let planes =
        wing([0.8, 0.08], [0.55, 0.04], DVec3::new(-5.0, 0.08, 0.08), DVec3::new(-5.25, 0.78, 0.08)).mirrored(Axis::Y);
    let fittings = [pipes.to_vec(), vec![shroud, hub], blades, rudders.into(), planes.into()].concat();
    Object {
        uid: "submarine",
        name: "midget submarine, 12 m",
        label: "submarine",
        tags: "u-boat;midget submarine;boat;wreck;vessel;hull",
        parts: vec![
            Part::new("hull", Material::Steel, [hull, keel, deck]),
            Part::new("tower", Material::Steel, [tower, hatch]),
            Part::new("fittings", Material::Steel, fittings),
            Part::new("torpedoes", Material::Steel, eels.into_iter().chain(clamps).collect::<Vec<_>>()),
        ],
    }
}
