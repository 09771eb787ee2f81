//! What grows and sits on a reef: two corals, a sponge, starfish, sea urchin, crab.

use ensonify::math::real::{cos, pow, radians, sin};
use ensonify::math::rng::Stream;
use glam::DVec3;

use super::body::{body, limb};
use super::curve::{arc, circle};
use super::noise::Noise;
use super::object::{Material, Object, Part};
use super::shape::{capped, icosphere, lathe};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![brain_coral(), staghorn_coral(), sponge(), starfish(), sea_urchin(), crab()]
}

/// A head of brain coral, 0.8 m: a low dome with winding ridges.
fn brain_coral() -> Object {
    let noise = Noise::of("coral-head");
    let head = icosphere(17).mapped(|p| {
        let lobes = 1.0 + 0.16 * noise.at(p * 1.6);
        let ridges = 0.11 * noise.ridged(p * 4.5 + DVec3::splat(3.1), 1);
        let r = 0.40 * (lobes + if p.z > -0.2 { ridges } else { 0.0 });
        DVec3::new(r * p.x, 0.92 * r * p.y, if p.z > 0.0 { 0.85 * r * p.z } else { 0.30 * r * p.z })
    });
    Object {
        uid: "coral-head",
        name: "head of brain coral",
        label: "coral",
        tags: "brain coral;coral head;reef;bommie;natural;fauna",
        parts: vec![Part::new("head", Material::Rock, [head])],
    }
}

/// A thicket of staghorn coral, 0.7 m across, on its dead base.
fn staghorn_coral() -> Object {
    let mut stream = Stream::at(1, "starter-catalog", 0, "coral-staghorn");
    let mut between = |low: f64, high: f64| low + (high - low) * (f64::from(stream.below(1_000_001) as u32) / 1e6);
    let mut branches = Vec::new();
    for i in 0..15 {
        let (heading, lean) = (radians(137.5 * f64::from(i)), 0.18 + 0.062 * f64::from(i));
        let length = between(0.24, 0.36);
        let out = DVec3::new(cos(heading), sin(heading), 0.0);
        let from = out * (0.02 + 0.008 * f64::from(i)) + DVec3::Z * 0.03;
        let knee = from + (out * lean + DVec3::Z) * (0.5 * length);
        let tip = knee + (out * (0.6 * lean) + DVec3::Z) * (0.5 * length);
        branches.push(twig([from, knee, tip], 0.026, between(0.012, 0.016)));
        for side in [-1.0, 1.0] {
            let start = from + (knee - from) * between(0.45, 0.95);
            let turned = radians(137.5 * f64::from(i) + side * between(45.0, 80.0));
            let aside = DVec3::new(cos(turned), sin(turned), 0.0);
            let half = start + (aside * 0.9 + DVec3::Z * 0.5) * (0.22 * length);
            let end = half + (aside * 0.5 + DVec3::Z) * (0.24 * length);
            branches.push(twig([start, half, end], 0.017, 0.010));
        }
    }
    let noise = Noise::of("coral-staghorn");
    let base =
        icosphere(7).mapped(|p| p * DVec3::new(0.26, 0.24, 0.09) * (1.0 + 0.3 * noise.at(p * 2.0)) + DVec3::Z * 0.03);
    Object {
        uid: "coral-staghorn",
        name: "staghorn coral",
        label: "coral",
        tags: "staghorn coral;branching coral;reef;natural;fauna",
        parts: vec![Part::new("branches", Material::Rock, branches), Part::new("base", Material::Rock, [base])],
    }
}

/// A branch through three points, thick at its foot, round at its tip.
fn twig([a, b, c]: [DVec3; 3], foot: f64, tip: f64) -> Solid {
    let end = c + (c - b).normalize() * (0.9 * tip);
    let joint = |p: DVec3, radius: f64| [p.x, p.y, p.z, radius];
    limb(&[joint(a, foot), joint(b, 0.5 * (foot + tip)), joint(c, tip), joint(end, 0.3 * tip)], 2, 8)
}

/// A barrel sponge, 0.55 m high: a ribbed vase, hollow.
fn sponge() -> Object {
    let profile = [
        [0.0, 0.0],
        [0.13, 0.0],
        [0.16, 0.06],
        [0.20, 0.16],
        [0.225, 0.28],
        [0.215, 0.40],
        [0.185, 0.50],
        [0.165, 0.55],
        [0.125, 0.545],
        [0.120, 0.48],
        [0.130, 0.36],
        [0.110, 0.22],
        [0.0, 0.16],
    ];
    let noise = Noise::of("sponge");
    let vase = lathe(&profile, 60).mapped(|p| {
        let out = (p.x * p.x + p.y * p.y).sqrt();
        if out < 1e-6 {
            return p;
        }
        let rib = noise.ridged(DVec3::new(9.0 * p.x / out, 9.0 * p.y / out, 2.2 * p.z), 1);
        let grown = 1.0 + 0.16 * rib + 0.25 * noise.at(DVec3::new(4.0 * p.x, 4.0 * p.y, 3.0 * p.z));
        DVec3::new(p.x * grown + 0.10 * p.z * p.z, p.y * grown, p.z + 0.06 * noise.at(p * 7.0) * p.z)
    });
    Object {
        uid: "sponge",
        name: "barrel sponge",
        label: "sponge",
        tags: "barrel sponge;vase sponge;reef;natural;fauna",
        parts: vec![Part::new("sponge", Material::Plant, [vase])],
    }
}

/// A common starfish, 0.26 m across.
fn starfish() -> Object {
    let arms = 5.0;
    let ring = |scale: f64, z: f64, slim: f64| -> Vec<DVec3> {
        circle(1.0, 80)
            .into_iter()
            .enumerate()
            .map(|(i, [x, y])| {
                let angle = std::f64::consts::TAU * i as f64 / 80.0;
                let arm = pow((0.5 + 0.5 * cos(arms * angle)).max(0.0), 1.0 / 0.55 * slim);
                let r = scale * (0.036 + 0.100 * arm);
                // Arms bend a little, none quite as its neighbour.
                let bend = 0.16 * arm * sin(2.0 * angle + 0.6);
                DVec3::new(r * (x - bend * y), r * (y + bend * x), z * (1.0 - 0.45 * arm * scale * scale))
            })
            .collect()
    };
    let skin = capped(&[
        ring(0.90, 0.000, 1.10),
        ring(1.00, 0.006, 1.00),
        ring(0.97, 0.014, 1.05),
        ring(0.86, 0.022, 1.25),
        ring(0.62, 0.030, 1.50),
        ring(0.30, 0.034, 1.70),
    ]);
    Object {
        uid: "starfish",
        name: "common starfish",
        label: "starfish",
        tags: "sea star;seastar;echinoderm;animal;fauna",
        parts: vec![Part::new("starfish", Material::Flesh, [skin])],
    }
}

/// A sea urchin: a test of 8 cm under a hundred spines of 4 cm.
fn sea_urchin() -> Object {
    let test = icosphere(8).mapped(|p| DVec3::new(0.040 * p.x, 0.040 * p.y, 0.027 * p.z));
    let count = 110;
    let golden = 137.507_764;
    let spines = (0..count).map(|i| {
        let z = 1.0 - 1.75 * (f64::from(i) + 0.5) / f64::from(count);
        let r = (1.0 - z * z).sqrt();
        let a = radians(golden * f64::from(i));
        let direction = DVec3::new(r * cos(a), r * sin(a), z);
        let length = 0.038 + 0.007 * cos(2.4 * f64::from(i));
        let spine = lathe(&[[0.0016, 0.0], [0.0013, 0.6 * length], [0.0004, length]], 5);
        spine.aimed(direction, DVec3::new(0.038 * direction.x, 0.038 * direction.y, 0.0255 * direction.z))
    });
    Object {
        uid: "sea-urchin",
        name: "sea urchin",
        label: "sea-urchin",
        tags: "urchin;echinoderm;animal;fauna",
        parts: vec![
            Part::new("test", Material::Ceramic, [test]),
            Part::new("spines", Material::Ceramic, spines.collect::<Vec<_>>()),
        ],
    }
}

/// An edible crab, shell 17 cm wide, on its legs, claws before it.
fn crab() -> Object {
    let shell = body(
        &[
            [-0.052, 0.022, 0.010, 0.045],
            [-0.040, 0.050, 0.017, 0.048],
            [-0.010, 0.078, 0.023, 0.050],
            [0.018, 0.086, 0.022, 0.050],
            [0.038, 0.070, 0.017, 0.048],
            [0.052, 0.030, 0.009, 0.045],
        ],
        4,
        28,
    );
    // A pie-crust edge.
    let crimped = |p: DVec3| {
        let edge = (1.0 - ((p.z - 0.049) / 0.012).abs()).max(0.0) * (p.y.abs() / 0.086);
        p + DVec3::new(0.004 * edge * cos(220.0 * p.y), 0.0, 0.0)
    };
    let legs = (0..4).flat_map(|i| {
        let (x, turn) = (0.022 - 0.020 * f64::from(i), 22.0 - 21.0 * f64::from(i));
        let joint = |out: f64, z: f64, radius: f64| {
            let a = radians(turn);
            [x + out * sin(a), 0.055 + out * cos(a), z, radius]
        };
        let joints = [
            joint(0.0, 0.040, 0.008),
            joint(0.035, 0.058, 0.008),
            joint(0.070, 0.052, 0.007),
            joint(0.098, 0.022, 0.005),
            joint(0.112, 0.002, 0.0015),
        ];
        limb(&joints, 2, 8).mirrored(Axis::Y)
    });
    let arm = limb(
        &[
            [0.035, 0.050, 0.042, 0.010],
            [0.060, 0.085, 0.045, 0.012],
            [0.092, 0.090, 0.040, 0.012],
            [0.105, 0.078, 0.038, 0.014],
        ],
        3,
        10,
    );
    let claw = limb(
        &[
            [0.098, 0.086, 0.038, 0.010],
            [0.110, 0.070, 0.037, 0.022],
            [0.118, 0.045, 0.035, 0.020],
            [0.118, 0.022, 0.034, 0.010],
            [0.112, 0.008, 0.034, 0.003],
        ],
        3,
        12,
    );
    let finger =
        limb(&[[0.106, 0.046, 0.035, 0.008], [0.098, 0.028, 0.034, 0.007], [0.102, 0.012, 0.034, 0.002]], 3, 8);
    let eyes = arc([0.0, 0.0], 0.012, [-60.0, 60.0], 1)
        .into_iter()
        .map(|[_, y]| icosphere(2).mapped(move |p| p * 0.004 + DVec3::new(0.055, y, 0.054)));
    let claws = [arm, claw, finger].into_iter().flat_map(|solid| solid.mirrored(Axis::Y));
    Object {
        uid: "crab",
        name: "edible crab",
        label: "crab",
        tags: "brown crab;crustacean;shellfish;animal;fauna",
        parts: vec![
            Part::new("shell", Material::Ceramic, [shell.mapped(crimped)]),
            Part::new("legs, claws, eyes", Material::Ceramic, legs.chain(claws).chain(eyes).collect::<Vec<_>>()),
        ],
    }
}
