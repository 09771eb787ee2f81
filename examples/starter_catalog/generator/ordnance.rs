//! What mine hunters and clearance divers look for: mines, bomb, shell, torpedo, cannon.

use ensonify::math::real::{cos, radians, sin};
use glam::DVec3;

use super::anchors::link;
use super::curve::{Point, arc, rounded_rectangle, smooth};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{capped, cuboid, cylinder, dome, lathe, lathe_ring, plank, rod, torus};
use super::solid::{Axis, Solid, turn};
use super::vessels::screw;

pub fn all() -> Vec<Object> {
    vec![
        moored_mine(),
        contact_mine(),
        bottom_mine(),
        cylinder_mine(),
        aerial_bomb(),
        artillery_shell(),
        torpedo(),
        cannon(),
    ]
}

/// A moored contact mine: a 1 m sphere with Hertz horns on a chain over its sinker, 3.1 m in all.
fn moored_mine() -> Object {
    let centre = DVec3::new(0.0, 0.0, 2.45);
    let shell = mine_shell(centre);
    let links = (0..16).map(|i| {
        let link = link([0.128, 0.076], 0.020, [3, 6]).turned(Axis::Y, 90.0);
        link.turned(Axis::Z, f64::from(i % 2) * 90.0).at(0.0, 0.0, 1.90 - 0.088 * f64::from(i))
    });
    Object {
        uid: "moored-mine",
        name: "moored contact mine",
        label: "moored-mine",
        tags: "mine-like;ordnance;contact mine;naval mine;mine;sea mine",
        parts: vec![
            Part::new("mine", Material::Steel, shell),
            Part::new("horns", Material::Steel, horns(centre)),
            Part::new("chain", Material::Steel, links.collect::<Vec<_>>()),
            Part::new("sinker", Material::Steel, sinker()),
        ],
    }
}

/// The same without chain and sinker: for moorings of any length, and for mines adrift.
fn contact_mine() -> Object {
    let centre = DVec3::new(0.0, 0.0, 0.55);
    Object {
        uid: "contact-mine",
        name: "contact mine without its mooring",
        label: "moored-mine",
        tags: "ordnance;contact mine;drifting mine;naval mine;mine;sea mine",
        parts: vec![
            Part::new("mine", Material::Steel, mine_shell(centre)),
            Part::new("horns", Material::Steel, horns(centre)),
        ],
    }
}

/// A sphere of 1 m with a belt and the foot that its chain hangs on.
fn mine_shell(centre: DVec3) -> [Solid; 3] {
    let meridian: Vec<Point> = arc([0.0, 0.0], 0.5, [-90.0, 90.0], 22);
    let belt = lathe_ring(&[[0.485, -0.03], [0.515, -0.03], [0.515, 0.03], [0.485, 0.03]], 56);
    let foot = lathe(&[[0.0, -0.55], [0.05, -0.55], [0.08, -0.53], [0.13, -0.47], [0.13, -0.40], [0.0, -0.40]], 24);
    [lathe(&meridian, 44), belt, foot].map(|solid| solid.mapped(|p| p + centre))
}

/// Hertz horns in rings about the mine's shell.
fn horns(centre: DVec3) -> Vec<Solid> {
    let mut horn: Vec<Point> = vec![[0.0, -0.03], [0.058, -0.03], [0.058, 0.018], [0.046, 0.024], [0.030, 0.028]];
    horn.extend(dome(0.027, 0.105, 0.027, 2));
    let horn = lathe(&horn, 8);
    let mut horns = Vec::new();
    for (count, elevation, first) in [(1, 90.0, 0.0), (4, 52.0, 45.0), (6, 18.0, 0.0), (4, -32.0, 45.0)] {
        for i in 0..count {
            let bearing = radians(first + 360.0 * f64::from(i) / f64::from(count));
            let (s, c) = (sin(radians(elevation)), cos(radians(elevation)));
            let out = DVec3::new(c * cos(bearing), c * sin(bearing), s);
            horns.push(horn.clone().aimed(out, centre + out * 0.497));
        }
    }
    horns
}

/// The sinker: a steel box with the chain's bell on top, on the four wheels by which it rolled off its ship.
fn sinker() -> Vec<Solid> {
    let level = |width: f64, length: f64, z: f64| -> Vec<DVec3> {
        rounded_rectangle(length, width, 0.04, 2).into_iter().map(|[x, y]| DVec3::new(x, y, z)).collect()
    };
    let hull = [level(0.58, 0.78, 0.08), level(0.60, 0.80, 0.10), level(0.60, 0.80, 0.40), level(0.50, 0.70, 0.46)];
    let bell = [[0.0, 0.45], [0.16, 0.45], [0.14, 0.52], [0.05, 0.54], [0.04, 0.60], [0.0, 0.60]];
    let wheel = [[0.0, -0.03], [0.10, -0.03], [0.10, 0.015], [0.12, 0.02], [0.12, 0.03], [0.0, 0.03]];
    let mut sinker = vec![capped(&hull), lathe(&bell, 24)];
    for x in [-0.27, 0.27] {
        sinker.extend(lathe(&wheel, 16).turned(Axis::X, 90.0).at(x, -0.33, 0.12).mirrored(Axis::Y));
        sinker.push(cuboid([0.06, 0.64, 0.30], [x, 0.0, 0.26]));
    }
    sinker.extend(cuboid([0.82, 0.05, 0.08], [0.0, 0.22, 0.25]).mirrored(Axis::Y));
    sinker
}

/// A bottom mine of the Manta kind: a flat truncated cone, 0.98 m across and 0.47 m high.
fn bottom_mine() -> Object {
    let mut profile: Vec<Point> =
        vec![[0.0, 0.0], [0.455, 0.0], [0.480, 0.010], [0.490, 0.030], [0.490, 0.062], [0.478, 0.075]];
    profile.extend([
        [0.470, 0.082],
        [0.290, 0.372],
        [0.278, 0.388],
        [0.255, 0.395],
        [0.250, 0.405],
        [0.250, 0.425],
        [0.240, 0.432],
        [0.0, 0.432],
    ]);
    let hatch = lathe(
        &[[0.0, 0.42], [0.130, 0.42], [0.130, 0.452], [0.118, 0.460], [0.070, 0.462], [0.064, 0.470], [0.0, 0.470]],
        32,
    );
    let bolts = cylinder(0.011, [0.43, 0.442], 6).at(0.205, 0.0, 0.0).around(12);
    let rib = plank([0.452, 0.0, 0.10], [0.315, 0.0, 0.322], DVec3::Y, [0.035, 0.05]).around(6);
    let lug = torus(0.045, 0.022, [16, 6]).turned(Axis::X, 90.0).at(0.40, 0.0, 0.215).turned(Axis::Z, 30.0).around(3);
    Object {
        uid: "bottom-mine",
        name: "truncated-cone bottom mine",
        label: "bottom-mine",
        tags: "mine-like;ordnance;manta mine;ground mine;naval mine;mine;sea mine",
        parts: vec![
            Part::new("shell", Material::Plastic, [lathe(&profile, 56)]),
            Part::new("ribs", Material::Plastic, rib),
            Part::new("hatch", Material::Steel, [hatch]),
            Part::new("bolts and lugs", Material::Steel, [bolts, lug].concat()),
        ],
    }
}

/// An air-laid cylindrical bottom mine, 0.53 × 2.1 m: cut-off nose, bands, lugs, square tail fins.
fn cylinder_mine() -> Object {
    let profile = [
        [0.0, 0.000],
        [0.175, 0.000],
        [0.215, 0.012],
        [0.250, 0.050],
        [0.266, 0.110],
        [0.266, 0.520],
        [0.272, 0.524],
        [0.272, 0.556],
        [0.266, 0.560],
        [0.266, 1.180],
        [0.272, 1.184],
        [0.272, 1.216],
        [0.266, 1.220],
        [0.266, 1.640],
        [0.240, 1.680],
        [0.235, 1.960],
        [0.245, 1.970],
        [0.245, 2.000],
        [0.200, 2.010],
        [0.0, 2.010],
    ];
    // Skewed nose: these mines break the water at an angle.
    let body = lathe(&profile, 44).mapped(|p| DVec3::new(p.x, p.y, p.z - 0.35 * p.x * (1.0 - p.z / 0.5).max(0.0)));
    let lug = torus(0.035, 0.022, [16, 6]).turned(Axis::X, 90.0);
    let lugs = [0.72, 1.08].map(|z| lug.clone().at(0.275, 0.0, z));
    let fin = plank([0.22, 0.0, 1.72], [0.22, 0.0, 1.99], DVec3::X, [0.20, 0.012]).turned(Axis::Z, 45.0).around(4);
    let hatch = lathe(&[[0.0, 0.24], [0.085, 0.24], [0.085, 0.276], [0.0, 0.276]], 24)
        .turned(Axis::Y, 90.0)
        .turned(Axis::Z, 90.0)
        .at(0.0, 0.0, 0.87);
    let bolts = cylinder(0.012, [1.99, 2.022], 6).at(0.16, 0.0, 0.0).around(8);
    let lying = |solid: Solid| solid.turned(Axis::Z, 20.0).turned(Axis::Y, 90.0);
    Object {
        uid: "bottom-mine-cylinder",
        name: "cylindrical bottom mine",
        label: "bottom-mine",
        tags: "mine-like;ordnance;cylindrical mine;ground mine;naval mine;mine;sea mine",
        parts: vec![
            Part::new("body", Material::Steel, [lying(body)]),
            Part::new("fins", Material::Steel, fin.into_iter().map(lying).collect::<Vec<_>>()),
            Part::new(
                "lugs and hatch",
                Material::Steel,
                lugs.into_iter().chain([hatch]).chain(bolts).map(lying).collect::<Vec<_>>(),
            ),
        ],
    }
}

/// A 250 kg general-purpose bomb, 1.64 m: ogive body, lugs, conical tail with four fins in a ring.
fn aerial_bomb() -> Object {
    let mut profile = vec![[0.0, 0.0], [0.030, 0.0], [0.034, 0.030]];
    profile.extend(smooth(&[[0.045, 0.034], [0.100, 0.110], [0.150, 0.220], [0.178, 0.360], [0.184, 0.480]], 3));
    profile.extend(smooth(&[[0.184, 0.840], [0.176, 0.940], [0.150, 1.060], [0.110, 1.180]], 3));
    profile.extend([[0.113, 1.182], [0.113, 1.210], [0.105, 1.215], [0.055, 1.600], [0.0, 1.605]]);
    let fin = prism(&[[0.05, 1.26], [0.10, 1.21], [0.245, 1.40], [0.245, 1.64], [0.04, 1.64]], &[], [-0.004, 0.004])
        .turned(Axis::X, 90.0);
    let strut = lathe_ring(&[[0.172, 1.42], [0.178, 1.42], [0.178, 1.60], [0.172, 1.60]], 40);
    let lug = torus(0.030, 0.018, [14, 6]).turned(Axis::X, 90.0);
    let lugs = [0.52, 0.88].map(|z| lug.clone().at(0.19, 0.0, z));
    let lying = |solid: Solid| solid.turned(Axis::Z, 45.0).turned(Axis::Y, 90.0);
    let tail: Vec<Solid> = fin.around(4).into_iter().chain([strut]).map(lying).collect();
    Object {
        uid: "aerial-bomb",
        name: "aerial bomb, 250 kg",
        label: "bomb",
        tags: "ordnance;uxo;unexploded ordnance;munition",
        parts: vec![
            Part::new("body", Material::Steel, [lying(lathe(&profile, 40))]),
            Part::new("tail", Material::Steel, tail),
            Part::new("lugs", Material::Steel, lugs.map(|solid| solid.turned(Axis::Z, 0.0)).map(lying)),
        ],
    }
}

/// A 155 mm artillery shell, 0.70 m, with its copper driving band and lifting plug.
fn artillery_shell() -> Object {
    let mut profile =
        vec![[0.0, 0.004], [0.055, 0.004], [0.060, 0.0], [0.064, 0.003], [0.0765, 0.055], [0.0765, 0.080]];
    profile.extend([
        [0.0795, 0.083],
        [0.0795, 0.094],
        [0.078, 0.097],
        [0.0795, 0.100],
        [0.0795, 0.110],
        [0.0765, 0.113],
        [0.0765, 0.300],
        [0.0775, 0.305],
        [0.0775, 0.335],
    ]);
    profile.extend(smooth(&[[0.0770, 0.345], [0.0735, 0.420], [0.0650, 0.490], [0.0520, 0.555], [0.0365, 0.610]], 3));
    profile.extend([[0.0310, 0.612], [0.0310, 0.628], [0.0250, 0.632], [0.0120, 0.636], [0.0, 0.636]]);
    let eye = torus(0.028, 0.014, [24, 8]).turned(Axis::X, 90.0).at(0.0, 0.0, 0.662);
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0);
    Object {
        uid: "artillery-shell",
        name: "artillery shell, 155 mm",
        label: "shell",
        tags: "ordnance;uxo;projectile;unexploded ordnance;munition",
        parts: vec![Part::new("shell", Material::Steel, [lying(lathe(&profile, 36)), lying(eye)])],
    }
}

/// A G7-type torpedo, 0.533 × 7.2 m: rounded nose with pistol whiskers, four fins, two screws turning against each other.
fn torpedo() -> Object {
    let mut profile = vec![[0.0, 0.0], [0.035, 0.0], [0.045, 0.040]];
    profile.extend(smooth(&[[0.055, 0.042], [0.140, 0.100], [0.205, 0.200], [0.246, 0.360], [0.2665, 0.600]], 3));
    profile.extend([
        [0.2665, 1.30],
        [0.270, 1.305],
        [0.270, 1.33],
        [0.2665, 1.335],
        [0.2665, 3.60],
        [0.270, 3.605],
        [0.270, 3.63],
        [0.2665, 3.635],
    ]);
    profile.extend(smooth(&[[0.2665, 5.60], [0.255, 5.95], [0.215, 6.35], [0.150, 6.70], [0.085, 6.93]], 3));
    profile.extend([[0.080, 6.935], [0.072, 7.130], [0.060, 7.180], [0.030, 7.195], [0.0, 7.2]]);
    let fin = [[0.05, 6.20], [0.20, 6.25], [0.262, 6.42], [0.262, 6.84], [0.05, 6.88]];
    let fins = prism(&fin, &[], [-0.008, 0.008]).turned(Axis::X, 90.0).around(4);
    let rudder = prism(&[[0.09, 6.86], [0.262, 6.84], [0.262, 6.92], [0.09, 6.93]], &[], [-0.006, 0.006])
        .turned(Axis::X, 90.0)
        .around(4);
    let blades = |pitch: f64, z: f64| screw(0.255, 0.055, pitch, 4, 7).into_iter().map(move |s| s.at(0.0, 0.0, z));
    let whisker = rod([0.03, 0.0, 0.01], [0.13, 0.0, -0.005], 0.006, 6).around(4);
    let lying = |solid: Solid| solid.turned(Axis::Z, 45.0).turned(Axis::Y, 90.0);
    Object {
        uid: "torpedo",
        name: "torpedo",
        label: "torpedo",
        tags: "ordnance;uxo;munition;underwater vehicle",
        parts: vec![
            Part::new("body", Material::Steel, [lying(lathe(&profile, 40))]),
            Part::new("fins", Material::Steel, fins.into_iter().chain(rudder).map(lying).collect::<Vec<_>>()),
            Part::new(
                "screws",
                Material::Steel,
                blades(0.55, 7.00).chain(blades(-0.55, 7.10)).map(lying).collect::<Vec<_>>(),
            ),
            Part::new("whiskers", Material::Steel, whisker.into_iter().map(lying).collect::<Vec<_>>()),
        ],
    }
}

/// A muzzle-loading iron 12-pounder, 2.6 m: reinforce rings, swelling muzzle, trunnions, button.
fn cannon() -> Object {
    let profile = [
        [0.0, -0.190],
        [0.036, -0.183],
        [0.060, -0.160],
        [0.066, -0.130],
        [0.056, -0.100],
        [0.038, -0.078],
        [0.040, -0.060],
        [0.120, -0.045],
        [0.170, -0.020],
        [0.222, -0.015],
        [0.228, 0.000],
        [0.228, 0.040],
        [0.215, 0.045],
        [0.205, 0.080],
        [0.196, 0.700],
        [0.206, 0.705],
        [0.206, 0.740],
        [0.186, 0.745],
        [0.172, 1.180],
        [0.181, 1.185],
        [0.181, 1.220],
        [0.164, 1.225],
        [0.126, 2.060],
        [0.134, 2.065],
        [0.134, 2.085],
        [0.124, 2.095],
        [0.126, 2.180],
        [0.146, 2.290],
        [0.163, 2.350],
        [0.163, 2.375],
        [0.150, 2.385],
        [0.140, 2.410],
        [0.059, 2.410],
        [0.059, 1.200],
        [0.0, 1.180],
    ];
    let trunnions = cylinder(0.058, [-0.30, 0.30], 24).turned(Axis::X, 90.0).at(-0.04, 0.0, 1.10);
    let vent = cylinder(0.030, [0.15, 0.225], 12).turned(Axis::Y, -90.0).at(0.0, 0.0, 0.12);
    // Lying on its widest ring and the muzzle.
    let lying = |solid: Solid| solid.turned(Axis::Y, 90.0).mapped(|p| turn(Axis::Y, 1.5) * p);
    Object {
        uid: "cannon",
        name: "ship's cannon",
        label: "cannon",
        tags: "gun;wreck;archaeology;iron",
        parts: vec![Part::new("barrel", Material::Iron, [lathe(&profile, 44), trunnions, vent].map(lying))],
    }
}
