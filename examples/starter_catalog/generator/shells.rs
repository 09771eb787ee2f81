//! Shells of bivalves: an oyster, a mussel, a scallop.

use ensonify::math::real::{cos, pow, sin};
use glam::DVec3;

use super::body::body;
use super::curve::interpolate;
use super::noise::Noise;
use super::object::{Material, Object, Part};
use super::shape::capped;
use super::solid::Solid;

pub fn all() -> Vec<Object> {
    vec![oyster(), mussel(), scallop()]
}

/// Both valves of a shell in one closed surface: growth lines about the beak at the origin, which grow from ring to ring.
struct Bivalve<'a> {
    /// Corners of a ring.
    around: usize,
    /// Rings of a valve.
    rings: u32,
    /// Margin of the grown shell at an angle, seen from above, the beak at the origin.
    margin: &'a dyn Fn(f64) -> [f64; 2],
    /// Height of the upper and depth of the lower valve.
    bulge: [f64; 2],
    /// How far from the beak they reach it, metres.
    reach: f64,
    /// Shift of a point in height by (share of growth, angle).
    relief: &'a dyn Fn(f64, f64) -> f64,
}

impl Bivalve<'_> {
    fn solid(&self) -> Solid {
        let ring = |share: f64, rise: f64| -> Vec<DVec3> {
            (0..self.around)
                .map(|i| std::f64::consts::TAU * i as f64 / self.around as f64)
                .map(|angle| {
                    let [x, y] = (self.margin)(angle);
                    let x = x - 0.15 * self.reach;
                    let near = ((x * x + y * y).sqrt() * share / self.reach).min(1.0).sqrt();
                    let (height, relief) =
                        (rise * near * arch(share), rise.signum() * near * (self.relief)(share, angle));
                    // The margin is thin and both valves meet in it.
                    let edge = (1.0 - share).min(0.15) / 0.15;
                    DVec3::new(x * share, y * share, height + relief * edge)
                })
                .collect()
        };
        let [up, down] = self.bulge;
        let shares = || (1..=self.rings).map(|i| pow(f64::from(i) / f64::from(self.rings), 0.8));
        let mut rings: Vec<Vec<DVec3>> = shares().map(|share| ring(share, -down)).collect();
        rings.extend(shares().rev().skip(1).map(|share| ring(share, up)));
        capped(&rings)
    }
}

/// Height over the plane of the margin as a share of the bulge: it rises from the beak, is highest at a third of the way, and
/// comes down to the margin.
fn arch(share: f64) -> f64 {
    interpolate(
        &[[0.0, 0.30], [0.1, 0.62], [0.2, 0.86], [0.35, 1.0], [0.55, 0.90], [0.8, 0.55], [0.92, 0.25], [1.0, 0.0]],
        share,
    )
}

/// An oyster of 11 cm, cupped side down: ruffled margin, growth in frilled steps.
fn oyster() -> Object {
    let noise = Noise::of("oyster");
    let margin = |a: f64| {
        let ruffle = 1.0
            + 0.10 * noise.at(DVec3::new(4.0 * cos(a) + 7.0, 4.0 * sin(a), 3.3))
            + 0.05 * noise.at(DVec3::new(11.0 * cos(a), 11.0 * sin(a), 9.1));
        // A drop: narrow at the beak, bent a little to one side.
        let (x, y) = (0.056 * (1.0 - cos(a)), 0.040 * sin(a) * (1.0 - 0.30 * cos(a)));
        [ruffle * x, ruffle * y + 1.6 * x * x]
    };
    let relief = |share: f64, a: f64| {
        let step = 9.0 * share + 0.7 * noise.at(DVec3::new(2.0 * cos(a), 2.0 * sin(a), share));
        let frill = 0.0035 * (step - step.floor());
        frill + 0.004 * noise.at(DVec3::new(60.0 * share * cos(a) * 0.1, 6.0 * share * sin(a), 5.0 * share))
    };
    let shell =
        Bivalve { around: 48, rings: 22, margin: &margin, bulge: [0.010, 0.019], reach: 0.022, relief: &relief };
    Object {
        uid: "oyster",
        name: "oyster",
        label: "oyster",
        tags: "oyster shell;shell;shellfish;bivalve;mollusc;animal;fauna;aquaculture",
        parts: vec![Part::new("valves", Material::Ceramic, [shell.solid()])],
    }
}

/// A blue mussel of 7 cm, closed, on its side: pointed beak, one edge nearly straight, round at the far end.
fn mussel() -> Object {
    let stations = [
        [0.0000, 0.0010, 0.0010, 0.0],
        [0.0020, 0.0042, 0.0045, 0.0],
        [0.0100, 0.0090, 0.0090, 0.0],
        [0.0250, 0.0145, 0.0125, 0.0],
        [0.0420, 0.0172, 0.0120, 0.0],
        [0.0570, 0.0160, 0.0085, 0.0],
        [0.0660, 0.0105, 0.0042, 0.0],
        [0.0695, 0.0040, 0.0014, 0.0],
    ];
    let bent = |p: DVec3| p + DVec3::Y * (4.0 * p.x * (0.07 - p.x));
    // Both valves come to an edge all round.
    let edged = |p: DVec3| DVec3::new(p.x, p.y * (1.10 - 0.10 * (p.z / 0.0125).abs()), p.z);
    Object {
        uid: "mussel",
        name: "blue mussel",
        label: "mussel",
        tags: "mussel shell;shell;shellfish;bivalve;mollusc;animal;fauna;aquaculture",
        parts: vec![Part::new("valves", Material::Ceramic, [body(&stations, 4, 28).mapped(edged).mapped(bent)])],
    }
}

/// A great scallop of 12 cm: ribbed fan, flat valve up.
fn scallop() -> Object {
    let margin = |a: f64| {
        let t = (1.0 - cos(a)) / 2.0;
        [0.112 * t, 0.060 * sin(a) * (0.72 + 0.28 * t)]
    };
    let relief = |share: f64, a: f64| 0.0032 * share * cos(28.0 * a);
    let shell =
        Bivalve { around: 112, rings: 9, margin: &margin, bulge: [0.006, 0.024], reach: 0.024, relief: &relief };
    // The ears on either side of the beak.
    let ear = |z: f64| {
        [[0.004, -0.034], [0.004, 0.034], [0.030, 0.030], [0.030, -0.030]].map(|[x, y]| DVec3::new(x, y, z)).to_vec()
    };
    Object {
        uid: "scallop",
        name: "great scallop",
        label: "sea-shell",
        tags: "scallop;seashell;shell;shellfish;bivalve;mollusc;animal;fauna",
        parts: vec![Part::new("valves", Material::Ceramic, [shell.solid(), capped(&[ear(-0.004), ear(0.002)])])],
    }
}
