//! What swims: salmon, cod, shark, ray, sea turtle.

use glam::DVec3;

use super::body::{body, fin, flat_fin, limb, wing};
use super::curve::{Point, circle, smooth};
use super::object::{Material, Object, Part};
use super::prism::prism;
use super::shape::{capped, icosphere, plank};
use super::solid::Axis;

pub fn all() -> Vec<Object> {
    vec![salmon(), cod(), shark(), ray(), turtle()]
}

/// An Atlantic salmon, 0.75 m, swimming along x.
fn salmon() -> Object {
    let outline = smooth(
        &[[-0.31, 0.022], [-0.24, 0.03], [-0.1, 0.068], [0.06, 0.082], [0.2, 0.074], [0.3, 0.048], [0.355, 0.018]],
        4,
    );
    let rings: Vec<Vec<DVec3>> = outline
        .iter()
        .map(|&[x, r]| circle(r, 16).into_iter().map(|[y, z]| DVec3::new(x, 0.55 * y, z)).collect())
        .collect();
    let fin = |outline: &[Point]| prism(outline, &[], [-0.004, 0.004]).turned(Axis::X, 90.0);
    let tail =
        fin(&[[-0.3, -0.02], [-0.395, -0.105], [-0.365, 0.0], [-0.395, 0.105], [-0.3, 0.02]].map(|[x, y]| [x, -y]));
    let back = fin(&[[0.02, 0.125], [-0.05, 0.115], [-0.06, 0.062], [0.08, 0.07]]);
    let belly = fin(&[[-0.13, -0.055], [-0.21, -0.033], [-0.2, -0.085]].map(|[x, y]| [x, y]));
    let side = plank([0.2, 0.035, -0.03], [0.12, 0.1, -0.075], DVec3::X, [0.05, 0.006]).mirrored(Axis::Y);
    Object {
        uid: "salmon",
        name: "Atlantic salmon",
        label: "fish",
        tags: "salmon;animal;fauna;farmed fish",
        parts: vec![
            Part::new("body", Material::Flesh, [capped(&rings)]),
            Part::new("fins", Material::Flesh, [vec![tail, back, belly], side.into()].concat()),
        ],
    }
}

/// A cod of 0.8 m: heavy head with its barbel, three fins on the back, two below, square tail.
fn cod() -> Object {
    let trunk = body(
        &[
            [-0.315, 0.010, 0.020, 0.010],
            [-0.26, 0.016, 0.026, 0.010],
            [-0.15, 0.036, 0.052, 0.004],
            [0.0, 0.062, 0.086, -0.004],
            [0.14, 0.076, 0.098, -0.006],
            [0.25, 0.072, 0.086, -0.004],
            [0.33, 0.052, 0.060, -0.008],
            [0.385, 0.026, 0.030, -0.016],
            [0.400, 0.008, 0.010, -0.018],
        ],
        3,
        18,
    );
    let back = [
        fin(&[[0.20, 0.080], [0.125, 0.150], [0.055, 0.085], [0.08, 0.07]], 0.006),
        fin(&[[0.04, 0.078], [-0.02, 0.130], [-0.105, 0.060], [-0.08, 0.045]], 0.006),
        fin(&[[-0.12, 0.055], [-0.165, 0.098], [-0.235, 0.038], [-0.2, 0.028]], 0.006),
        fin(&[[0.02, -0.080], [-0.045, -0.128], [-0.115, -0.055], [-0.08, -0.045]], 0.006),
        fin(&[[-0.13, -0.045], [-0.17, -0.088], [-0.235, -0.025], [-0.2, -0.018]], 0.006),
    ];
    let tail = fin(&[[-0.29, 0.028], [-0.40, 0.082], [-0.388, 0.0], [-0.40, -0.070], [-0.29, -0.010]], 0.006);
    let side = wing([0.05, 0.006], [0.03, 0.004], DVec3::new(0.20, 0.060, -0.02), DVec3::new(0.12, 0.13, -0.05))
        .mirrored(Axis::Y);
    let below = wing([0.03, 0.005], [0.015, 0.003], DVec3::new(0.235, 0.025, -0.08), DVec3::new(0.20, 0.05, -0.125))
        .mirrored(Axis::Y);
    let barbel = limb(&[[0.37, 0.0, -0.035, 0.003], [0.365, 0.0, -0.055, 0.002], [0.372, 0.0, -0.070, 0.0012]], 2, 6);
    Object {
        uid: "cod",
        name: "Atlantic cod",
        label: "fish",
        tags: "cod;codfish;animal;fauna",
        parts: vec![
            Part::new("body", Material::Flesh, [trunk]),
            Part::new("fins", Material::Flesh, [back.to_vec(), vec![tail, barbel], side.into(), below.into()].concat()),
        ],
    }
}

/// A blue shark's like, 3.3 m, swimming: long snout, tall fin on the back, long breast fins, unequal tail.
fn shark() -> Object {
    let trunk = body(
        &[
            [-1.34, 0.030, 0.045, 0.030],
            [-1.15, 0.045, 0.060, 0.018],
            [-0.85, 0.095, 0.115, 0.004],
            [-0.40, 0.190, 0.215, -0.006],
            [0.10, 0.255, 0.285, -0.010],
            [0.55, 0.260, 0.285, -0.006],
            [0.95, 0.215, 0.220, 0.006],
            [1.25, 0.150, 0.135, 0.024],
            [1.45, 0.085, 0.065, 0.034],
            [1.55, 0.030, 0.022, 0.036],
        ],
        4,
        22,
    );
    let tail = fin(
        &[
            [-1.18, 0.06],
            [-1.36, 0.20],
            [-1.62, 0.56],
            [-1.76, 0.74],
            [-1.66, 0.40],
            [-1.55, 0.15],
            [-1.50, 0.02],
            [-1.56, -0.16],
            [-1.66, -0.36],
            [-1.44, -0.20],
            [-1.24, -0.03],
        ],
        0.035,
    );
    let back = fin(
        &[[0.32, 0.26], [0.16, 0.42], [-0.02, 0.64], [-0.10, 0.66], [-0.12, 0.50], [-0.12, 0.38], [-0.20, 0.22]],
        0.04,
    );
    let second = fin(&[[-0.78, 0.10], [-0.92, 0.20], [-0.95, 0.13], [-1.04, 0.07]], 0.02);
    let anal = fin(&[[-0.82, -0.10], [-0.97, -0.20], [-0.98, -0.12], [-1.06, -0.04]], 0.02);
    let breast = wing([0.34, 0.045], [0.10, 0.012], DVec3::new(0.66, 0.18, -0.14), DVec3::new(0.20, 0.92, -0.38))
        .mirrored(Axis::Y);
    let pelvic = wing([0.18, 0.02], [0.07, 0.008], DVec3::new(-0.42, 0.12, -0.15), DVec3::new(-0.58, 0.30, -0.26))
        .mirrored(Axis::Y);
    // The tail beats to one side.
    let bent = |p: DVec3| {
        let behind = (0.2 - p.x).max(0.0);
        p + DVec3::Y * (0.075 * behind * behind)
    };
    let fins = [vec![tail, back, second, anal], breast.into(), pelvic.into()].concat();
    Object {
        uid: "shark",
        name: "shark, 3.3 m",
        label: "shark",
        tags: "blue shark;fish;predator;animal;fauna",
        parts: vec![
            Part::new("body", Material::Flesh, [trunk.mapped(bent)]),
            Part::new("fins", Material::Flesh, fins.into_iter().map(|s| s.mapped(bent)).collect::<Vec<_>>()),
        ],
    }
}

/// A stingray, disc 0.9 m wide, 1.7 m with its whip of a tail.
fn ray() -> Object {
    let disc = body(
        &[
            [-0.38, 0.04, 0.030, 0.0],
            [-0.33, 0.13, 0.040, 0.0],
            [-0.20, 0.31, 0.060, 0.0],
            [-0.02, 0.445, 0.078, 0.0],
            [0.08, 0.455, 0.084, 0.0],
            [0.22, 0.34, 0.078, 0.0],
            [0.34, 0.175, 0.055, 0.0],
            [0.42, 0.055, 0.026, 0.0],
            [0.44, 0.012, 0.010, 0.0],
        ],
        3,
        32,
    );
    // Thick in the middle, thin in the wings, which curl up; flat below.
    let winged = |p: DVec3| {
        let out = p.y.abs() / 0.455;
        let thick = (0.22 + 0.78 * (1.0 - out) * (1.0 - out)) * if p.z < 0.0 { 0.45 } else { 1.0 };
        DVec3::new(p.x, p.y, p.z * thick + 0.07 * out * out * out)
    };
    let tail = limb(
        &[
            [-0.30, 0.0, 0.0, 0.032],
            [-0.45, 0.0, 0.008, 0.022],
            [-0.75, 0.04, 0.015, 0.012],
            [-1.05, 0.02, 0.01, 0.007],
            [-1.28, -0.06, 0.005, 0.003],
        ],
        4,
        8,
    );
    let pelvic = flat_fin(&[[-0.28, 0.03], [-0.33, 0.15], [-0.43, 0.12], [-0.40, 0.03]], 0.012).mirrored(Axis::Y);
    let eyes =
        icosphere(3).mapped(|p| p * DVec3::new(0.028, 0.020, 0.022) + DVec3::new(0.24, 0.07, 0.062)).mirrored(Axis::Y);
    Object {
        uid: "ray",
        name: "stingray",
        label: "ray",
        tags: "stingray;skate;flatfish;fish;animal;fauna",
        parts: vec![
            Part::new("disc", Material::Flesh, [disc.mapped(winged)]),
            Part::new("tail, fins, eyes", Material::Flesh, [vec![tail], pelvic.into(), eyes.into()].concat()),
        ],
    }
}

/// A green turtle, shell 0.95 m, swimming: fore flippers spread.
fn turtle() -> Object {
    let shell = body(
        &[
            [-0.50, 0.03, 0.020, 0.0],
            [-0.44, 0.14, 0.065, 0.0],
            [-0.28, 0.29, 0.130, 0.0],
            [-0.02, 0.375, 0.175, 0.0],
            [0.22, 0.355, 0.165, 0.0],
            [0.38, 0.245, 0.115, 0.0],
            [0.45, 0.12, 0.060, 0.0],
        ],
        3,
        26,
    );
    // High above with a keel along the back, shallow below, a sharp rim between.
    let shaped = |p: DVec3| {
        let up = if p.z > 0.0 { p.z * (1.0 + 0.12 * (1.0 - (p.y.abs() / 0.06).min(1.0))) } else { 0.50 * p.z };
        DVec3::new(p.x, p.y * (1.05 - 0.3 * (p.z / 0.18).abs()), up)
    };
    let head = limb(
        &[
            [0.36, 0.0, 0.0, 0.070],
            [0.46, 0.0, 0.012, 0.066],
            [0.54, 0.0, 0.022, 0.074],
            [0.61, 0.0, 0.018, 0.062],
            [0.67, 0.0, 0.004, 0.022],
        ],
        3,
        14,
    );
    let fore = wing([0.20, 0.055], [0.07, 0.016], DVec3::new(0.36, 0.20, -0.02), DVec3::new(0.02, 0.82, -0.16))
        .mirrored(Axis::Y);
    let arm = limb(&[[0.24, 0.14, -0.01, 0.060], [0.27, 0.30, -0.03, 0.050], [0.20, 0.42, -0.06, 0.030]], 3, 10)
        .mirrored(Axis::Y);
    let hind = wing([0.15, 0.035], [0.11, 0.012], DVec3::new(-0.30, 0.16, -0.02), DVec3::new(-0.52, 0.38, -0.05))
        .mirrored(Axis::Y);
    let tail = limb(&[[-0.44, 0.0, -0.01, 0.035], [-0.52, 0.0, -0.015, 0.020], [-0.58, 0.0, -0.02, 0.006]], 2, 8);
    Object {
        uid: "sea-turtle",
        name: "green turtle",
        label: "turtle",
        tags: "sea turtle;tortoise;reptile;animal;fauna",
        parts: vec![
            Part::new("shell", Material::Ceramic, [shell.mapped(shaped)]),
            Part::new(
                "head and flippers",
                Material::Flesh,
                [vec![head, tail], fore.into(), arm.into(), hind.into()].concat(),
            ),
        ],
    }
}
