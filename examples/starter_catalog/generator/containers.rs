//! Things that held something: drum, crate, bottle, amphora, can, carton, gas cylinder.

use glam::DVec3;

use super::curve::{Point, ellipse, interpolate, smooth, spline};
use super::object::{Material, Object, Part};
use super::shape::{Path, cuboid, cylinder, dome, lathe, lathe_ring, plank, rod, sweep, torus};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![oil_drum(), oil_drum_open(), wooden_crate(), bottle(), amphora(), can(), scuba_tank()]
}

/// Half the height of a 200 l drum's side from its rim to its middle: chime, corrugations, rolling hoop.
/// As (inset from the nominal radius, height above the bottom).
const DRUM_SIDE: [Point; 15] = [
    [0.004, 0.000],
    [0.000, 0.004],
    [0.000, 0.014],
    [0.006, 0.020],
    [0.0075, 0.030],
    [0.0075, 0.150],
    [0.0045, 0.165],
    [0.0075, 0.180],
    [0.0075, 0.260],
    [0.005, 0.266],
    [0.000, 0.278],
    [0.000, 0.286],
    [0.005, 0.298],
    [0.0075, 0.304],
    [0.0075, 0.440],
];
const DRUM_RADIUS: f64 = 0.2925;
const DRUM_HEIGHT: f64 = 0.88;

fn drum_side() -> Vec<Point> {
    let lower = DRUM_SIDE.iter().map(|&[inset, z]| [DRUM_RADIUS - inset, z]);
    let upper = DRUM_SIDE.iter().rev().skip(1).map(|&[inset, z]| [DRUM_RADIUS - inset, DRUM_HEIGHT - z]);
    lower.chain(upper).collect()
}

/// A tight-head 200 litre drum: 585 × 880 mm, two bungs in the sunken lid.
fn oil_drum() -> Object {
    let mut profile = vec![[0.0, 0.018], [0.276, 0.018], [0.280, 0.000]];
    profile.extend(drum_side());
    profile.extend([[0.280, DRUM_HEIGHT], [0.276, 0.862], [0.0, 0.862]]);
    let bung = |radius: f64, x: f64| {
        let top = [
            [0.0, 0.858],
            [1.5 * radius, 0.858],
            [1.5 * radius, 0.866],
            [radius, 0.867],
            [radius, 0.876],
            [0.0, 0.876],
        ];
        lathe(&top, 16).at(x, 0.0, 0.0)
    };
    Object {
        uid: "oil-drum",
        name: "oil drum, 200 l",
        label: "oil-drum",
        tags: "oil drum;drum;barrel;debris;container;pollution",
        parts: vec![
            Part::new("drum", Material::Steel, [lathe(&profile, 48)]),
            Part::new("bungs", Material::Steel, [bung(0.035, 0.20), bung(0.018, -0.20)]),
        ],
    }
}

/// The same drum without its lid, crushed on one side and lying down.
fn oil_drum_open() -> Object {
    let mut profile = vec![[0.0, 0.018], [0.276, 0.018], [0.280, 0.000]];
    profile.extend(drum_side());
    profile.push([0.281, DRUM_HEIGHT]);
    let inside = drum_side().into_iter().rev().filter(|p| (0.028..0.852).contains(&p[1]));
    profile.extend(inside.map(|p| [p[0] - 0.006, p[1]]));
    profile.push([0.0, 0.026]);
    let dent = |p: DVec3| {
        let offset = (p - DVec3::new(-0.33, 0.05, 0.56)) / DVec3::new(0.22, 0.26, 0.20);
        let depth = 0.13 / (1.0 + offset.length_squared() * offset.length_squared());
        p + DVec3::new(depth, -0.15 * depth, 0.0)
    };
    Object {
        uid: "oil-drum-open",
        name: "open oil drum, dented",
        label: "oil-drum",
        tags: "oil drum;drum;barrel;debris;container;damaged",
        parts: vec![Part::new("drum", Material::Steel, [lathe(&profile, 48).mapped(dent).turned(Axis::Y, 90.0)])],
    }
}

/// A slatted crate, 800 × 600 × 600 mm: boards nailed on corner posts, a brace across every side, gaps between boards.
fn wooden_crate() -> Object {
    let (x, y, z) = (0.4, 0.3, 0.6);
    let thick = 0.018;
    let board = 0.098;
    let mut boards = Vec::new();
    let mut frame = Vec::new();
    for row in 0..5 {
        let height = 0.06 + 0.12 * f64::from(row);
        for side in [-1.0, 1.0] {
            boards.push(cuboid([2.0 * x, thick, board], [0.0, side * (y - 1.5 * thick), height]));
            boards.push(cuboid([thick, 2.0 * (y - 2.0 * thick), board], [side * (x - 1.5 * thick), 0.0, height]));
        }
        let across = -y + 0.06 + 0.12 * f64::from(row);
        for height in [thick / 2.0, z - thick / 2.0] {
            boards.push(cuboid([2.0 * x - 4.0 * thick, board, thick], [0.0, across, height]));
        }
    }
    for side in [-1.0, 1.0] {
        let outer = side * (y - thick / 2.0);
        for end in [-1.0, 1.0] {
            frame.push(cuboid([0.09, thick, z], [end * (x - 0.045), outer, z / 2.0]));
            frame.push(cuboid([thick, 0.08, z], [end * (x - thick / 2.0), side * (y - 0.04), z / 2.0]));
        }
        for height in [0.045, z - 0.045] {
            frame.push(cuboid([2.0 * x - 0.18, thick, 0.09], [0.0, outer, height]));
            frame.push(cuboid([thick, 2.0 * y - 0.16, 0.09], [side * (x - thick / 2.0), 0.0, height]));
        }
        let (low, high) = (0.075, z - 0.075);
        let run = x - 0.075;
        frame.push(plank([-run, outer, low], [run, outer, high], DVec3::Y, [0.9 * thick, 0.08]));
        let (end, run) = (side * (x - thick / 2.0), y - 0.06);
        frame.push(plank([end, -run, low], [end, run, high], DVec3::X, [0.9 * thick, 0.08]));
    }
    Object {
        uid: "crate",
        name: "wooden crate",
        label: "crate",
        tags: "wooden crate;box;debris;container;cargo",
        parts: vec![Part::new("boards", Material::Wood, boards), Part::new("frame", Material::Wood, frame)],
    }
}

/// A Bordeaux wine bottle, 75 × 300 mm, open and hollow, on its side.
fn bottle() -> Object {
    let mut profile =
        vec![[0.0, 0.022], [0.010, 0.0205], [0.022, 0.011], [0.028, 0.0], [0.0345, 0.0015], [0.0375, 0.007]];
    profile.extend(smooth(&[[0.0375, 0.185], [0.0355, 0.202], [0.028, 0.217], [0.0185, 0.229], [0.0148, 0.243]], 2));
    profile.extend([[0.0142, 0.278], [0.0142, 0.281], [0.0158, 0.282], [0.0158, 0.290], [0.0142, 0.292]]);
    profile.extend([[0.0142, 0.2985], [0.0128, 0.300], [0.0100, 0.300], [0.0093, 0.298], [0.0098, 0.243]]);
    profile.extend([
        [0.0145, 0.227],
        [0.0250, 0.2145],
        [0.0325, 0.200],
        [0.0345, 0.185],
        [0.0345, 0.010],
        [0.0, 0.026],
    ]);
    Object {
        uid: "bottle",
        name: "wine bottle",
        label: "bottle",
        tags: "glass bottle;wine bottle;debris;litter;container",
        parts: vec![Part::new("bottle", Material::Glass, [lathe(&profile, 32).turned(Axis::Y, 90.0)])],
    }
}

/// A Roman wine amphora after Dressel 1B: 1.1 m, spiked toe, long neck, two handles; open, on its side.
fn amphora() -> Object {
    let outer: [Point; 13] = [
        [0.026, 0.000],
        [0.036, 0.015],
        [0.034, 0.080],
        [0.056, 0.140],
        [0.104, 0.230],
        [0.136, 0.360],
        [0.148, 0.490],
        [0.150, 0.580],
        [0.142, 0.655],
        [0.108, 0.722],
        [0.070, 0.775],
        [0.060, 0.850],
        [0.060, 1.020],
    ];
    let inner: [Point; 7] = [
        [0.046, 1.020],
        [0.046, 0.850],
        [0.056, 0.775],
        [0.128, 0.655],
        [0.135, 0.560],
        [0.120, 0.360],
        [0.050, 0.160],
    ];
    let mut profile = vec![[0.0, 0.0]];
    profile.extend(smooth(&outer, 2));
    profile.extend([[0.066, 1.032], [0.086, 1.042], [0.090, 1.070], [0.084, 1.098], [0.074, 1.100], [0.058, 1.092]]);
    profile.extend(smooth(&inner, 2));
    profile.push([0.0, 0.130]);
    let handle = [
        [0.045, 0.0, 1.005],
        [0.085, 0.0, 1.012],
        [0.128, 0.0, 0.995],
        [0.142, 0.0, 0.940],
        [0.136, 0.0, 0.840],
        [0.118, 0.0, 0.740],
        [0.098, 0.0, 0.690],
    ];
    let path = spline(&handle, 4);
    let handle = sweep(&path, Path::Open, DVec3::Y, |_| ellipse(0.026, 0.015, 12));
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0).turned(Axis::X, 90.0);
    Object {
        uid: "amphora",
        name: "wine amphora",
        label: "amphora",
        tags: "jar;pottery;archaeology;wreck;container",
        parts: vec![
            Part::new("body", Material::Ceramic, [lying(lathe(&profile, 36))]),
            Part::new("handles", Material::Ceramic, handle.mirrored(Axis::X).map(lying)),
        ],
    }
}

/// A 330 ml drink can, 66 × 115 mm, on its side and squeezed in the middle.
fn can() -> Object {
    let profile = [
        [0.0, 0.010],
        [0.018, 0.007],
        [0.0235, 0.001],
        [0.0250, 0.0],
        [0.0268, 0.001],
        [0.0290, 0.006],
        [0.0322, 0.011],
        [0.0330, 0.015],
        [0.0330, 0.035],
        [0.0330, 0.050],
        [0.0330, 0.062],
        [0.0330, 0.080],
        [0.0330, 0.096],
        [0.0322, 0.100],
        [0.0275, 0.110],
        [0.0275, 0.1125],
        [0.0282, 0.1135],
        [0.0278, 0.115],
        [0.0266, 0.1150],
        [0.0258, 0.1100],
        [0.0235, 0.1105],
        [0.0225, 0.1122],
        [0.0, 0.1122],
    ];
    let squeeze = |p: DVec3| {
        let pinch = interpolate(&[[0.020, 0.0], [0.042, 0.55], [0.056, 1.0], [0.072, 0.5], [0.095, 0.0]], p.z);
        let side = (p.x / 0.033).max(0.0);
        DVec3::new(p.x - 0.020 * pinch * side * side, p.y, p.z)
    };
    let tab = cuboid([0.022, 0.014, 0.0012], [-0.005, 0.0, 0.1129]);
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0).turned(Axis::X, 60.0);
    Object {
        uid: "drink-can",
        name: "drink can, squeezed",
        label: "can",
        tags: "tin;beer can;soda can;debris;litter;container",
        parts: vec![
            Part::new("can", Material::Aluminium, [lying(lathe(&profile, 32).mapped(squeeze))]),
            Part::new("tab", Material::Aluminium, [lying(tab)]),
        ],
    }
}

/// A 12 litre diving cylinder with rubber boot, valve and pillar knob, on its side.
fn scuba_tank() -> Object {
    let mut tank: Vec<Point> = dome(0.086, -0.10, -0.05, 6).into_iter().rev().collect();
    tank.extend(smooth(&[[0.086, 0.42], [0.080, 0.455], [0.062, 0.487], [0.036, 0.508], [0.024, 0.520]], 3));
    tank.extend([[0.024, 0.530], [0.0, 0.530]]);
    let boot = [[0.084, -0.07], [0.090, -0.07], [0.091, -0.135], [0.078, -0.155], [0.05, -0.160], [0.05, -0.150]];
    let neck = lathe(&[[0.0, 0.52], [0.020, 0.52], [0.020, 0.545], [0.015, 0.548], [0.015, 0.605], [0.0, 0.605]], 20);
    let knob = lathe(&[[0.0, 0.075], [0.020, 0.075], [0.022, 0.080], [0.022, 0.098], [0.018, 0.104], [0.0, 0.104]], 20);
    let sideways = |solid: Solid| solid.turned(Axis::Y, 90.0).at(0.0, 0.0, 0.575);
    let stem = sideways(cylinder(0.011, [-0.04, 0.09], 16));
    let outlet = rod([0.0, -0.045, 0.59], [0.0, 0.0, 0.59], 0.015, 16);
    let band = |height: f64| torus(0.0865, 0.007, [40, 6]).at(0.0, 0.0, height);
    let handle = lathe_ring(&[[0.021, 0.535], [0.026, 0.535], [0.026, 0.545], [0.021, 0.545]], 20);
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0);
    Object {
        uid: "scuba-tank",
        name: "diving cylinder",
        label: "gas-cylinder",
        tags: "scuba tank;diving cylinder;gas cylinder;debris;diver",
        parts: vec![
            Part::new("cylinder", Material::Aluminium, [lathe(&tank, 40)].map(lying)),
            Part::new("boot", Material::Rubber, [lathe_ring(&boot, 40)].map(lying)),
            Part::new("valve", Material::Steel, [neck, stem, outlet, handle].map(lying)),
            Part::new("knob", Material::Plastic, [sideways(knob)].map(lying)),
            Part::new("bands", Material::Steel, [band(0.12), band(0.30)].map(lying)),
        ],
    }
}
