//! More ordnance: missile, depth charge, limpet mine, grenade, cannonball, and second kinds of torpedo and shell.

use glam::DVec3;

use super::body::wing;
use super::curve::{Point, ellipse, smooth, spline};
use super::noise::Noise;
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{Path, cuboid, cylinder, icosphere, lathe, lathe_ring, sweep, torus, tube};
use super::solid::{Axis, Solid};
use super::vessels::screw;

pub fn all() -> Vec<Object> {
    vec![missile(), depth_charge(), limpet_mine(), grenade(), cannonball(), light_torpedo(), mortar_bomb()]
}

/// Along x, the nose at the far end.
fn lying(solid: Solid) -> Solid {
    solid.turned(Axis::Y, 90.0)
}

/// An anti-ship missile, 0.35 × 4.7 m: ogive, four wings, four control fins, motor's nozzle; lying on two wings.
fn missile() -> Object {
    let mut profile: Vec<Point> =
        vec![[0.0, 0.06], [0.10, 0.04], [0.12, 0.0], [0.150, 0.0], [0.168, 0.03], [0.175, 0.10]];
    for joint in [1.25, 2.30, 3.45] {
        profile.extend([
            [0.175, joint - 0.012],
            [0.171, joint - 0.008],
            [0.171, joint + 0.008],
            [0.175, joint + 0.012],
        ]);
    }
    profile.extend(smooth(&[[0.175, 3.75], [0.166, 4.02], [0.138, 4.32], [0.088, 4.56], [0.040, 4.67]], 3));
    profile.push([0.0, 4.70]);
    let four = |solid: Solid| (0..4).map(move |i| solid.clone().turned(Axis::X, 45.0 + 90.0 * f64::from(i)));
    let wings = four(wing([0.95, 0.030], [0.42, 0.012], DVec3::new(2.55, 0.0, 0.16), DVec3::new(2.08, 0.0, 0.50)));
    let controls = four(wing([0.36, 0.026], [0.20, 0.012], DVec3::new(0.48, 0.0, 0.16), DVec3::new(0.36, 0.0, 0.38)));
    let tunnel = cuboid([2.6, 0.07, 0.04], [2.0, 0.0, -0.18]);
    let lugs = [1.6, 2.9].map(|x| cuboid([0.10, 0.05, 0.06], [x, 0.0, 0.19]));
    Object {
        uid: "missile",
        name: "anti-ship missile, 4.7 m",
        label: "missile",
        tags: "ordnance;uxo;rocket;cruise missile;unexploded ordnance;munition",
        parts: vec![
            Part::new(
                "body",
                Material::Steel,
                [lying(lathe(&profile, 40)), tunnel].into_iter().chain(lugs).collect::<Vec<_>>(),
            ),
            Part::new("wings and fins", Material::Aluminium, wings.chain(controls).collect::<Vec<_>>()),
        ],
    }
}

/// A depth charge of the drum kind, 0.45 × 0.70 m, with its pistol in the end, on its side.
fn depth_charge() -> Object {
    let profile = [
        [0.0, 0.020],
        [0.205, 0.020],
        [0.210, 0.0],
        [0.225, 0.0],
        [0.225, 0.030],
        [0.219, 0.036],
        [0.219, 0.225],
        [0.226, 0.232],
        [0.226, 0.250],
        [0.219, 0.257],
        [0.219, 0.443],
        [0.226, 0.450],
        [0.226, 0.468],
        [0.219, 0.475],
        [0.219, 0.664],
        [0.225, 0.670],
        [0.225, 0.70],
        [0.210, 0.70],
        [0.205, 0.680],
        [0.0, 0.680],
    ];
    let pistol = lathe(&[[0.0, 0.67], [0.075, 0.67], [0.075, 0.690], [0.050, 0.694], [0.050, 0.730], [0.0, 0.735]], 24);
    let bolts = cylinder(0.009, [0.675, 0.700], 6).at(0.062, 0.0, 0.0).around(8);
    let filler = cylinder(0.035, [0.0, 0.026], 16).at(0.11, 0.0, 0.0);
    let primer = lathe(&[[0.0, -0.012], [0.045, -0.012], [0.045, 0.028], [0.0, 0.028]], 20);
    Object {
        uid: "depth-charge",
        name: "depth charge",
        label: "depth-charge",
        tags: "depth bomb;ordnance;uxo;anti-submarine;unexploded ordnance;munition",
        parts: vec![
            Part::new("drum", Material::Steel, [lying(lathe(&profile, 48))]),
            Part::new(
                "pistol",
                Material::Steel,
                [pistol, filler, primer].into_iter().chain(bolts).map(lying).collect::<Vec<_>>(),
            ),
        ],
    }
}

/// A limpet mine, 0.27 m across and 0.13 m high, with its ring of magnets, handle and fuze.
fn limpet_mine() -> Object {
    let mut profile: Vec<Point> = vec![
        [0.0, 0.018],
        [0.118, 0.018],
        [0.118, 0.012],
        [0.125, 0.012],
        [0.128, 0.020],
        [0.128, 0.034],
        [0.118, 0.040],
    ];
    profile.extend(smooth(&[[0.116, 0.050], [0.106, 0.084], [0.078, 0.104], [0.042, 0.110]], 3));
    profile.push([0.0, 0.110]);
    let magnets = cuboid([0.042, 0.036, 0.024], [0.104, 0.0, 0.012]).around(8);
    let fuze = lathe(&[[0.0, 0.105], [0.034, 0.105], [0.034, 0.124], [0.026, 0.126], [0.026, 0.136], [0.0, 0.138]], 20);
    let handle = tube(
        &spline(&[[-0.080, -0.05, 0.082], [-0.098, -0.048, 0.125], [-0.098, 0.048, 0.125], [-0.080, 0.05, 0.082]], 5),
        0.006,
        8,
    );
    let bolts = cylinder(0.006, [0.03, 0.042], 6).at(0.121, 0.0, 0.0).around(12);
    Object {
        uid: "limpet-mine",
        name: "limpet mine",
        label: "limpet-mine",
        tags: "limpet;ordnance;uxo;mine;naval mine;magnetic mine;munition",
        parts: vec![
            Part::new(
                "case",
                Material::Steel,
                [lathe(&profile, 40), fuze].into_iter().chain(bolts).collect::<Vec<_>>(),
            ),
            Part::new("magnets", Material::Iron, magnets),
            Part::new("handle", Material::Steel, [handle]),
        ],
    }
}

/// A fragmentation hand grenade of the pineapple kind, 58 × 115 mm, with its lever and ring, on its side.
fn grenade() -> Object {
    // Grooves between six rows of lugs, and eight grooves along.
    let mut profile: Vec<Point> = vec![[0.0, 0.0], [0.012, 0.0]];
    for row in 0..6 {
        let at = |t: f64| {
            let z = 0.004 + 0.0135 * (f64::from(row) + t);
            let u = (z - 0.046) / 0.047;
            [0.029 * (1.0 - 0.62 * u * u * u * u).max(0.2), z]
        };
        let [low, high] = [at(0.14), at(0.86)];
        profile.extend([[low[0] - 0.0025, low[1] - 0.0012], low, high, [high[0] - 0.0025, high[1] + 0.0012]]);
    }
    profile.extend([[0.012, 0.088], [0.0, 0.088]]);
    let body = lathe(&profile, 48);
    let grooved = |i: usize, p: DVec3| {
        let groove = (i % 48).is_multiple_of(6) && (0.004..0.086).contains(&p.z);
        let shrink = if groove { 0.91 } else { 1.0 };
        DVec3::new(shrink * p.x, shrink * p.y, p.z)
    };
    let positions = body.positions.iter().enumerate().map(|(i, &p)| grooved(i, p)).collect();
    let body = Solid::outward(positions, body.triangles);
    let head = lathe(&[[0.0, 0.084], [0.013, 0.084], [0.013, 0.092], [0.009, 0.094], [0.009, 0.112], [0.0, 0.114]], 20);
    let block = cuboid([0.024, 0.012, 0.014], [0.006, 0.0, 0.108]);
    let lever: Vec<[f64; 3]> =
        vec![[-0.010, 0.0, 0.116], [0.018, 0.0, 0.115], [0.030, 0.0, 0.100], [0.033, 0.0, 0.070], [0.032, 0.0, 0.030]];
    let lever = sweep(&spline(&lever, 4), Path::Open, DVec3::Y, |_| ellipse(0.0055, 0.0011, 8));
    let ring = torus(0.014, 0.0026, [24, 6]).turned(Axis::X, 60.0).at(0.004, -0.013, 0.108);
    Object {
        uid: "grenade",
        name: "hand grenade",
        label: "grenade",
        tags: "hand grenade;ordnance;uxo;unexploded ordnance;munition",
        parts: vec![
            Part::new("body", Material::Iron, [lying(body)]),
            Part::new("fuze and lever", Material::Steel, [head, block, lever, ring].map(lying)),
        ],
    }
}

/// A pitted cast-iron shot of a 12-pounder, 0.115 m across.
fn cannonball() -> Object {
    let noise = Noise::of("cannonball");
    let ball = icosphere(9).mapped(|p| p * (0.0575 + 0.0012 * noise.fractal(p * 5.0, 2)));
    let seam = lathe_ring(&[[0.0565, -0.0012], [0.0582, -0.0012], [0.0582, 0.0012], [0.0565, 0.0012]], 48)
        .turned(Axis::X, 35.0);
    Object {
        uid: "cannonball",
        name: "cannonball, 12 pounds",
        label: "cannonball",
        tags: "round shot;shot;ordnance;iron;archaeology",
        parts: vec![Part::new("ball", Material::Iron, [ball, seam])],
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
