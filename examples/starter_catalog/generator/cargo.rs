//! What goods travel in: a shipping container, a wooden barrel, a chest, a suitcase.

use glam::DVec3;

use super::curve::{Point, arc, interpolate, rounded_rectangle, smooth, spline};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{capped, cuboid, cylinder, lathe, lathe_ring, rod, torus, tube};
use super::solid::{Axis, Solid};

pub fn all() -> Vec<Object> {
    vec![shipping_container(), barrel(), chest(), suitcase()]
}

/// A sheet of this length along x whose corrugations, of a pitch of 278 mm, go `deep` into +y; `heights` bound it.
fn corrugated(length: f64, deep: f64, heights: [f64; 2]) -> Solid {
    let thick = 0.02;
    let count = (length / 0.278) as usize;
    let pitch = length / count as f64;
    let mut line: Vec<Point> = Vec::new();
    for i in 0..count {
        let from = pitch * i as f64 - length / 2.0;
        line.extend([[0.0, 0.0], [0.25, 0.0], [0.5, deep], [0.75, deep]].map(|[t, y]| [from + t * pitch, y]));
    }
    line.push([length / 2.0, 0.0]);
    let back: Vec<Point> = line.iter().rev().map(|p| [p[0], p[1] + thick]).collect();
    prism(&[line, back].concat(), &[], heights)
}

/// A 20 ft container after ISO 668, 6.058 × 2.438 × 2.591 m: corrugated walls in a frame with corner castings, two door leaves
/// with their locking bars.
fn shipping_container() -> Object {
    let (x, y, z) = (3.029, 1.219, 2.591);
    let mut frame = Vec::new();
    for (sx, sy) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        frame.push(cuboid([0.15, 0.15, z - 0.2], [sx * (x - 0.080), sy * (y - 0.080), z / 2.0]));
        for height in [0.059, z - 0.059] {
            frame.push(cuboid([0.178, 0.162, 0.118], [sx * (x - 0.089), sy * (y - 0.081), height]));
        }
    }
    let rails = [
        cuboid([2.0 * x - 0.3, 0.06, 0.155], [0.0, y - 0.035, 0.105]).mirrored(Axis::Y),
        cuboid([2.0 * x - 0.3, 0.06, 0.06], [0.0, y - 0.035, z - 0.045]).mirrored(Axis::Y),
        cuboid([0.10, 2.0 * y - 0.28, 0.155], [x - 0.055, 0.0, 0.105]).mirrored(Axis::X),
        cuboid([0.08, 2.0 * y - 0.28, 0.11], [x - 0.045, 0.0, z - 0.07]).mirrored(Axis::X),
    ];
    let floor = cuboid([2.0 * x - 0.2, 2.0 * y - 0.1, 0.05], [0.0, 0.0, 0.15]);
    frame.extend(rails.concat());
    frame.push(floor);
    let side = corrugated(2.0 * x - 0.28, 0.036, [0.17, z - 0.06]).at(0.0, -(y - 0.012), 0.0);
    let front = corrugated(2.0 * y - 0.28, 0.045, [0.17, z - 0.11]).turned(Axis::Z, 90.0).at(x - 0.02, 0.0, 0.0);
    let roof = corrugated(2.0 * x - 0.28, 0.02, [-(y - 0.05), y - 0.05]).turned(Axis::X, -90.0).at(0.0, 0.0, z - 0.02);
    let mut walls = side.mirrored(Axis::Y).to_vec();
    walls.extend([front, roof]);
    Object {
        uid: "shipping-container",
        name: "shipping container, 20 ft",
        label: "shipping-container",
        tags: "container;freight container;sea container;cargo;intermodal;harbour",
        parts: vec![
            Part::new("walls", Material::Steel, walls),
            Part::new("frame", Material::Steel, frame),
            Part::new("doors", Material::Steel, container_doors(x, y, z)),
        ],
    }
}

/// Both leaves of the doors at the end at -x, their ribs, hinges, locking bars and handles.
fn container_doors(x: f64, y: f64, z: f64) -> Vec<Solid> {
    let face = -(x - 0.055);
    let half = y - 0.15;
    let mut solids = Vec::new();
    for side in [-1.0, 1.0] {
        let middle = side * half / 2.0;
        solids.push(cuboid([0.04, half - 0.015, z - 0.33], [face + 0.03, middle, z / 2.0 + 0.03]));
        for i in 0..5 {
            let height = 0.42 + 0.44 * f64::from(i);
            solids.push(cuboid([0.03, half - 0.12, 0.22], [face, middle, height]));
        }
        for at in [0.22, 0.80] {
            let bar = side * at * half;
            solids.push(rod([face - 0.025, bar, 0.10], [face - 0.025, bar, z - 0.06], 0.017, 8));
            for height in [0.35, 1.15, 1.95] {
                solids.push(cuboid([0.045, 0.09, 0.07], [face - 0.012, bar, height]));
            }
            solids.push(rod([face - 0.035, bar, 1.0], [face - 0.035, bar - side * 0.38, 0.98], 0.013, 6));
        }
        for i in 0..4 {
            solids.push(cuboid([0.05, 0.06, 0.16], [face, side * (half + 0.01), 0.42 + 0.58 * f64::from(i)]));
        }
    }
    solids
}

/// A cask of 225 l, 0.70 × 0.95 m: staves, six iron hoops, heads within the chime, a bung; on its side.
fn barrel() -> Object {
    let side = smooth(
        &[[0.285, 0.0], [0.317, 0.20], [0.338, 0.36], [0.345, 0.475], [0.338, 0.59], [0.317, 0.75], [0.285, 0.95]],
        2,
    );
    let mut profile: Vec<Point> = vec![[0.0, 0.045], [0.268, 0.045], [0.268, 0.005]];
    profile.extend(&side);
    profile.extend([[0.268, 0.945], [0.268, 0.905], [0.0, 0.905]]);
    let radius_at = |z: f64| interpolate(&side.iter().map(|p| [p[1], p[0]]).collect::<Vec<_>>(), z);
    let hoops = [0.03, 0.15, 0.30, 0.65, 0.80, 0.92].map(|z| {
        let (low, high) = (radius_at(z - 0.022), radius_at(z + 0.022));
        lathe_ring(
            &[[low - 0.004, z - 0.022], [low + 0.004, z - 0.022], [high + 0.004, z + 0.022], [high - 0.004, z + 0.022]],
            48,
        )
    });
    let bung = cylinder(0.035, [0.33, 0.362], 12).turned(Axis::Y, -90.0).at(0.0, 0.0, 0.475);
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0);
    Object {
        uid: "barrel",
        name: "wooden barrel, 225 l",
        label: "barrel",
        tags: "wooden barrel;cask;wine barrel;keg;container;cargo;archaeology",
        parts: vec![
            // One facet a stave.
            Part::new("staves and heads", Material::Wood, [lathe(&profile, 26), bung].map(lying)),
            Part::new("hoops", Material::Iron, hoops.map(lying)),
        ],
    }
}

/// A sea chest, 0.95 × 0.52 × 0.58 m: domed lid, iron straps, corner plates, lock, rings at the ends.
fn chest() -> Object {
    let section = |half: f64, grow: f64| -> Vec<Point> {
        let mut outline = vec![[half + grow, 0.30 - grow]];
        outline.extend(
            arc([0.0, 0.33], half + grow, [0.0, 180.0], 14).into_iter().map(|[y, z]| [y, 0.33 + 0.95 * (z - 0.33)]),
        );
        outline.push([-half - grow, 0.30 - grow]);
        outline
    };
    let lengthwise = |outline: Vec<Point>, from: f64, to: f64| {
        capped(&[from, to].map(|x| outline.iter().map(|p| DVec3::new(x, p[0], p[1])).collect::<Vec<_>>()))
    };
    let boards =
        (0..3).map(|i| cuboid([0.93, 0.50 - 0.008 * f64::from(i % 2), 0.10], [0.0, 0.0, 0.05 + 0.10 * f64::from(i)]));
    let lid = lengthwise(section(0.25, 0.0), -0.465, 0.465);
    let straps = [-0.36, 0.0, 0.36].map(|x| lengthwise(section(0.25, 0.008), x - 0.03, x + 0.03));
    let bands = [-0.36, 0.36].map(|x| cuboid([0.06, 0.516, 0.30], [x, 0.0, 0.152]));
    let corners = [-1.0, 1.0]
        .into_iter()
        .flat_map(|x| [-1.0, 1.0].map(|y| cuboid([0.05, 0.05, 0.31], [x * 0.45, y * 0.238, 0.155])));
    let lock = cuboid([0.12, 0.02, 0.15], [0.0, -0.262, 0.30]);
    let rings = torus(0.055, 0.018, [20, 6]).turned(Axis::Y, 78.0).at(0.478, 0.0, 0.20).mirrored(Axis::X);
    let iron = straps.into_iter().chain(bands).chain(corners).chain([lock]).chain(rings);
    Object {
        uid: "chest",
        name: "treasure chest",
        label: "chest",
        tags: "treasure chest;sea chest;trunk;box;container;cargo;archaeology",
        parts: vec![
            Part::new("boards and lid", Material::Wood, boards.chain([lid]).collect::<Vec<_>>()),
            Part::new("fittings", Material::Iron, iron.collect::<Vec<_>>()),
        ],
    }
}

/// A hard-shelled suitcase, 0.8 × 0.47 × 0.28 m with castors and handle, lying flat.
fn suitcase() -> Object {
    let level = |shrink: f64, z: f64| -> Vec<DVec3> {
        rounded_rectangle(0.68 - shrink, 0.47 - shrink, 0.06, 4).into_iter().map(|[x, y]| DVec3::new(x, y, z)).collect()
    };
    let half =
        capped(&[level(0.05, 0.0), level(0.015, 0.012), level(0.0, 0.035), level(0.0, 0.128), level(0.015, 0.130)]);
    let shell = [half.clone(), half.turned(Axis::X, 180.0).at(0.0, 0.0, 0.268)];
    let seam = capped(&[level(0.012, 0.120), level(0.012, 0.148)]);
    let ribs: Vec<Solid> = [-0.15, -0.05, 0.05, 0.15]
        .into_iter()
        .flat_map(|y| [-0.002, 0.270].map(|z| cuboid([0.50, 0.03, 0.014], [0.0, y, z])))
        .collect();
    let wheels: Vec<Solid> = [-1.0, 1.0]
        .into_iter()
        .flat_map(|y| {
            [0.05, 0.218].map(|z| cylinder(0.028, [-0.02, 0.02], 16).turned(Axis::X, 90.0).at(-0.362, 0.19 * y, z))
        })
        .collect();
    let forks = wheels.iter().map(|wheel| {
        let middle = wheel.positions.iter().copied().sum::<DVec3>() / wheel.positions.len() as f64;
        cuboid([0.03, 0.03, 0.03], [-0.344, middle.y, middle.z])
    });
    let handle = tube(
        &spline(
            &[
                [0.335, -0.10, 0.134],
                [0.365, -0.085, 0.134],
                [0.37, 0.0, 0.134],
                [0.365, 0.085, 0.134],
                [0.335, 0.10, 0.134],
            ],
            3,
        ),
        0.011,
        8,
    );
    let grip = [
        rod([0.33, -0.07, 0.245], [0.41, -0.07, 0.245], 0.008, 8),
        rod([0.33, 0.07, 0.245], [0.41, 0.07, 0.245], 0.008, 8),
        rod([0.41, -0.085, 0.245], [0.41, 0.085, 0.245], 0.014, 10),
    ];
    Object {
        uid: "suitcase",
        name: "suitcase on wheels",
        label: "suitcase",
        tags: "luggage;trolley case;box;litter;container",
        parts: vec![
            Part::new("shell", Material::Plastic, shell.into_iter().chain([seam]).chain(ribs).collect::<Vec<_>>()),
            Part::new(
                "castors, handle",
                Material::Plastic,
                forks.chain(wheels.iter().cloned()).chain([handle]).collect::<Vec<_>>(),
            ),
            Part::new("pull handle", Material::Aluminium, grip),
        ],
    }
}
