//! People and likenesses of them: a diver, a mannequin, a statue.

use glam::DVec3;

use super::body::limb;
use super::curve::{Point, ellipse, rectangle, rounded_rectangle, smooth, spline};
use super::object::{Material, Object, Part};
use super::shape::{Path, capped, cuboid, cylinder, dome, lathe, sweep, torus, tube};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![diver(), mannequin(), statue()]
}

/// Where the joints of a person of 1.75 m are, upright, facing x, left at +y; right limb first.
struct Pose {
    elbows: [[f64; 3]; 2],
    hands: [[f64; 3]; 2],
    knees: [[f64; 3]; 2],
    ankles: [[f64; 3]; 2],
    toes: [[f64; 3]; 2],
}

/// A column along z whose sections of (z, forward, half width, half depth) are joined smoothly.
fn column(sections: &[[f64; 4]], around: usize) -> Solid {
    let path: Vec<[f64; 3]> = sections.iter().map(|s| [s[1], 0.0, s[0]]).collect();
    let sizes: Vec<Point> = sections.iter().map(|s| [s[2], s[3]]).collect();
    let sizes = smooth(&sizes, 2);
    sweep(&spline(&path, 2), Path::Open, DVec3::Y, |i| ellipse(sizes[i][0], sizes[i][1], around))
}

/// Torso with neck, then arms, hands, legs and feet.
fn figure(pose: &Pose) -> Vec<Solid> {
    let mut solids = vec![column(
        &[
            [0.80, 0.00, 0.09, 0.07],
            [0.86, 0.00, 0.155, 0.105],
            [0.95, -0.01, 0.170, 0.120],
            [1.07, 0.00, 0.142, 0.102],
            [1.20, 0.01, 0.160, 0.112],
            [1.33, 0.00, 0.182, 0.122],
            [1.42, -0.01, 0.175, 0.100],
            [1.465, -0.01, 0.095, 0.070],
            [1.50, 0.00, 0.060, 0.060],
            [1.57, 0.02, 0.056, 0.060],
        ],
        20,
    )];
    for (i, side) in [-1.0, 1.0].into_iter().enumerate() {
        let joint = |[x, y, z]: [f64; 3], radius: f64| [x, y, z, radius];
        let between = |a: [f64; 3], b: [f64; 3], t: f64| [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t);
        let shoulder = [0.0, 0.175 * side, 1.40];
        let (elbow, hand) = (pose.elbows[i], pose.hands[i]);
        solids.push(limb(
            &[
                joint(between(elbow, shoulder, 1.12), 0.030),
                joint(shoulder, 0.062),
                joint(between(shoulder, elbow, 0.5), 0.050),
                joint(elbow, 0.042),
                joint(between(elbow, hand, 0.35), 0.044),
                joint(between(elbow, hand, 0.85), 0.030),
                joint(between(elbow, hand, 1.0), 0.042),
                joint(between(elbow, hand, 1.32), 0.034),
                joint(between(elbow, hand, 1.42), 0.010),
            ],
            2,
            10,
        ));
        let hip = [0.0, 0.085 * side, 0.90];
        let (knee, ankle, toe) = (pose.knees[i], pose.ankles[i], pose.toes[i]);
        solids.push(limb(
            &[
                joint(between(knee, hip, 1.10), 0.050),
                joint(hip, 0.092),
                joint(between(hip, knee, 0.5), 0.078),
                joint(knee, 0.056),
                joint(between(knee, ankle, 0.3), 0.060),
                joint(between(knee, ankle, 0.9), 0.040),
                joint(between(knee, ankle, 1.12), 0.036),
            ],
            2,
            12,
        ));
        let heel = between(toe, ankle, 1.25);
        solids.push(limb(
            &[joint(heel, 0.030), joint(ankle, 0.046), joint(between(ankle, toe, 0.7), 0.042), joint(toe, 0.020)],
            2,
            10,
        ));
    }
    solids
}

fn head() -> Solid {
    column(
        &[
            [1.525, 0.03, 0.040, 0.050],
            [1.555, 0.03, 0.060, 0.082],
            [1.62, 0.02, 0.076, 0.100],
            [1.68, 0.015, 0.077, 0.098],
            [1.73, 0.01, 0.055, 0.070],
            [1.75, 0.01, 0.018, 0.022],
        ],
        18,
    )
}

/// A diver swimming level, 2.2 m from mask to fins: tank on the back, one leg at the end of its stroke.
fn diver() -> Object {
    let pose = Pose {
        elbows: [[0.24, -0.25, 1.30], [0.20, 0.27, 1.27]],
        hands: [[0.36, -0.10, 1.46], [0.36, 0.08, 1.42]],
        knees: [[0.10, -0.11, 0.50], [0.02, 0.11, 0.49]],
        ankles: [[-0.16, -0.12, 0.17], [0.03, 0.12, 0.08]],
        toes: [[-0.26, -0.13, 0.04], [0.06, 0.13, -0.08]],
    };
    let blades = [(0, -0.12), (1, 0.12)].map(|(i, y)| {
        let (ankle, toe) = (DVec3::from_array(pose.ankles[i]), DVec3::from_array(pose.toes[i]));
        let ahead = (toe - ankle).normalize();
        let bend = DVec3::new(if i == 0 { -0.07 } else { 0.07 }, 0.02 * f64::signum(y), 0.0);
        let at = |t: f64| ankle + ahead * (0.02 + 0.66 * t) + bend * (t * t);
        let path: Vec<DVec3> = (0..=6).map(|k| at(f64::from(k) / 6.0)).collect();
        sweep(&path, Path::Open, DVec3::Y, |k| {
            rectangle(
                [0.10, 0.12, 0.14, 0.165, 0.185, 0.20, 0.20][k],
                [0.085, 0.07, 0.035, 0.022, 0.016, 0.012, 0.010][k],
            )
        })
    });
    let mut tank: Vec<Point> = vec![[0.0, 0.92], [0.080, 0.925], [0.0865, 0.945], [0.0865, 1.2]];
    tank.extend(dome(0.0865, 1.42, 0.075, 5));
    let valve = [
        cylinder(0.018, [1.48, 1.56], 12),
        cylinder(0.03, [-0.05, 0.05], 12).turned(Axis::X, 90.0).at(0.0, 0.0, 1.545),
    ];
    let back = -0.215;
    let hose =
        [[back, 0.04, 1.54], [back + 0.06, 0.16, 1.60], [0.05, 0.19, 1.58], [0.15, 0.08, 1.57], [0.15, 0.0, 1.57]];
    let vest = column(
        &[
            [1.00, -0.01, 0.160, 0.118],
            [1.06, -0.02, 0.178, 0.140],
            [1.25, -0.02, 0.188, 0.150],
            [1.38, -0.02, 0.190, 0.138],
            [1.43, -0.02, 0.150, 0.100],
        ],
        20,
    );
    let belt = torus(1.0, 0.30, [20, 6]).mapped(|p| DVec3::new(0.105 * p.x - 0.005, 0.155 * p.y, 0.955 + 0.14 * p.z));
    let mask = cuboid([0.07, 0.150, 0.085], [0.105, 0.0, 1.655]);
    let mouthpiece = cylinder(0.034, [0.0, 0.055], 14).turned(Axis::Y, 90.0).at(0.115, 0.0, 1.575);
    let strap = torus(0.118, 0.02, [20, 6]).at(back + 0.03, 0.0, 1.2);
    let gauge = tube(
        &spline(&[[back, -0.04, 1.54], [back + 0.05, -0.2, 1.48], [0.04, -0.235, 1.2], [0.10, -0.2, 1.02]], 4),
        0.013,
        8,
    );
    // Prone: what was up is ahead, the face looks forwards and down.
    let prone = |solid: Solid| solid.turned(Axis::Y, 90.0);
    // The head is bent back about the nape, so that the mask looks ahead.
    let raised = |solid: Solid| solid.at(0.0, 0.0, -1.53).turned(Axis::Y, -38.0).at(0.0, 0.0, 1.53);
    let gear = vec![vest, strap, tube(&spline(&hose, 4), 0.014, 8), gauge];
    Object {
        uid: "diver",
        name: "scuba diver, swimming",
        label: "diver",
        tags: "scuba diver;frogman;swimmer;person;human",
        parts: vec![
            Part::new("suit", Material::Rubber, figure(&pose).into_iter().map(prone).collect::<Vec<_>>()),
            Part::new("head", Material::Flesh, [prone(raised(head()))]),
            Part::new(
                "tank",
                Material::Aluminium,
                [vec![lathe(&tank, 24)], valve.into()]
                    .concat()
                    .into_iter()
                    .map(|s| prone(s.at(back, 0.0, 0.0)))
                    .collect::<Vec<_>>(),
            ),
            Part::new("vest and hoses", Material::Rubber, gear.into_iter().map(prone).collect::<Vec<_>>()),
            Part::new("weights", Material::Iron, [prone(belt)]),
            Part::new("mask", Material::Glass, [prone(raised(mask))]),
            Part::new("mouthpiece", Material::Plastic, [prone(raised(mouthpiece))]),
            Part::new("fins", Material::Rubber, blades.map(prone)),
        ],
    }
}

/// Upright, arms hanging.
const STANDING: Pose = Pose {
    elbows: [[-0.02, -0.245, 1.13], [-0.02, 0.245, 1.13]],
    hands: [[0.08, -0.27, 0.90], [0.08, 0.27, 0.90]],
    knees: [[0.02, -0.10, 0.49], [0.02, 0.10, 0.49]],
    ankles: [[-0.02, -0.11, 0.09], [-0.02, 0.11, 0.09]],
    toes: [[0.15, -0.13, 0.025], [0.15, 0.13, 0.025]],
};

/// A shop-window mannequin, 1.75 m, lying on its back.
fn mannequin() -> Object {
    let pose = Pose {
        hands: [[0.20, -0.30, 0.93], [0.05, 0.30, 0.89]],
        knees: [[0.02, -0.10, 0.49], [0.10, 0.11, 0.50]],
        ..STANDING
    };
    let lying = |solid: Solid| solid.turned(Axis::Y, -90.0);
    Object {
        uid: "mannequin",
        name: "shop-window mannequin",
        label: "mannequin",
        tags: "dummy;rescue dummy;victim;person;human;litter",
        parts: vec![
            Part::new("body", Material::Plastic, figure(&pose).into_iter().map(lying).collect::<Vec<_>>()),
            Part::new("head", Material::Plastic, [lying(head())]),
        ],
    }
}

/// A draped stone statue, 1.75 m, one arm raised, on its plinth.
fn statue() -> Object {
    let pose = Pose {
        elbows: [[0.12, -0.33, 1.46], [0.10, 0.25, 1.15]],
        hands: [[0.20, -0.34, 1.70], [0.20, 0.08, 1.12]],
        ..STANDING
    };
    let folds = |z: f64, radius: f64, depth: f64| -> Vec<DVec3> {
        ellipse(1.0, 1.0, 56)
            .into_iter()
            .enumerate()
            .map(|(i, [x, y])| {
                let r = radius + depth * [0.0, 0.7, 1.0, 0.3][i % 4];
                DVec3::new(0.78 * r * x, r * y, z)
            })
            .collect()
    };
    let robe = capped(&[
        folds(0.0, 0.27, 0.05),
        folds(0.25, 0.24, 0.045),
        folds(0.6, 0.20, 0.035),
        folds(0.95, 0.175, 0.02),
        folds(1.15, 0.155, 0.005),
    ]);
    let level = |width: f64, z: f64| -> Vec<DVec3> {
        rounded_rectangle(width, width, 0.02, 2).into_iter().map(|[x, y]| DVec3::new(x, y, z)).collect()
    };
    let plinth = capped(&[
        level(0.78, 0.0),
        level(0.78, 0.08),
        level(0.70, 0.11),
        level(0.68, 0.26),
        level(0.74, 0.28),
        level(0.74, 0.33),
    ]);
    let stand = |solid: Solid| solid.at(0.0, 0.0, 0.32);
    Object {
        uid: "statue",
        name: "stone statue on its plinth",
        label: "statue",
        tags: "sculpture;figure;monument;archaeology",
        parts: vec![
            Part::new(
                "figure",
                Material::Rock,
                figure(&pose).into_iter().chain([head(), robe]).map(stand).collect::<Vec<_>>(),
            ),
            Part::new("plinth", Material::Rock, [plinth]),
        ],
    }
}
