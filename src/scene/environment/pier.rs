//! A pier: bents of piles with caps and braces under a deck, before a quay wall.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::EnvironmentError;
use super::kinds::{material, within};
use super::quay::Quay;
use super::solid::Solid;
use super::structure::Structure;
use crate::math::rng::Stream;

/// A pier along x about the world's origin; the quay wall crosses its end at negative x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pier {
    /// Of the deck, along x, metres.
    pub length_m: f64,
    /// Of the deck, along y, metres.
    pub width_m: f64,
    /// Underside of the deck above z = 0, metres.
    pub height_m: f64,
    /// From bent to bent along the pier, metres.
    pub bent_spacing_m: f64,
    /// Piles of a bent, 1 to 12.
    pub piles: u32,
    /// Diameter of a pile, metres.
    pub pile_m: f64,
    /// How far a pile's foot strays from its place, metres.
    pub out_of_plumb_m: f64,
    /// Part of the piles that is broken off short, 0 to 1.
    pub broken: f64,
    /// What piles and beams are made of.
    pub material: String,
    /// Of the quay wall, along y, metres; none if 0.
    pub quay_m: f64,
}

impl Pier {
    pub(super) const PARTS: &'static [&'static str] =
        &["beam", "brace", "deck", "fender", "ladder", "pile", "quay-wall"];

    pub(super) fn check(&self) -> Result<(), EnvironmentError> {
        within("length_m", self.length_m, [1.0, 500.0])?;
        within("width_m", self.width_m, [0.5, 100.0])?;
        within("height_m", self.height_m, [1.0, 50.0])?;
        within("bent_spacing_m", self.bent_spacing_m, [0.5, 50.0])?;
        within("piles", self.piles.into(), [1.0, 12.0])?;
        within("pile_m", self.pile_m, [0.05, 3.0])?;
        within("out_of_plumb_m", self.out_of_plumb_m, [0.0, 2.0])?;
        within("broken", self.broken, [0.0, 1.0])?;
        within("quay_m", self.quay_m, [0.0, 500.0])?;
        material(&self.material)
    }

    pub(super) fn raise(&self, structure: &mut Structure, stream: &mut Stream) {
        let half = 0.5 * self.length_m;
        let bents = (self.length_m / self.bent_spacing_m).floor() as u32 + 1;
        let first = -0.5 * f64::from(bents - 1) * self.bent_spacing_m;
        for x in (0..bents).map(|bent| first + f64::from(bent) * self.bent_spacing_m) {
            self.bent(x, structure, stream);
        }
        let side = 0.5 * self.width_m;
        let top = self.height_m + 0.5;
        let deck = Solid::block(DVec3::new(-half, -side, top), DVec3::new(half, side, top + 0.4));
        structure.part("deck", "concrete", &[deck]);
        let stringers = [-0.4, 0.4].map(|share| {
            let end = |x: f64| DVec3::new(x, share * self.width_m, self.height_m + 0.25);
            Solid::bar(end(-half), end(half), [0.3, 0.5])
        });
        structure.part("beam", &self.material, &stringers);
        if self.quay_m > 0.0 {
            let at = |y: f64| DVec3::new(-half - 0.2, y, 0.0);
            let (from, to) = (at(0.5 * self.quay_m), at(-0.5 * self.quay_m));
            Quay { from, to, height: self.height_m + 0.9, fenders: 4.0 }.raise(structure);
        }
    }

    /// A row of piles across the pier, the beam on their heads, braces between those that stand.
    fn bent(&self, x: f64, structure: &mut Structure, stream: &mut Stream) {
        let step = self.width_m * 0.86 / f64::from(self.piles.saturating_sub(1).max(1));
        let mut standing: Vec<Option<[DVec3; 2]>> = Vec::new();
        for pile in 0..self.piles {
            let y = (f64::from(pile) - 0.5 * f64::from(self.piles - 1)) * step;
            let mut stray = || self.out_of_plumb_m * stream.uniform(-1.0, 1.0);
            let (head, foot) =
                (DVec3::new(x, y, self.height_m), DVec3::new(x + stray(), y + stray(), structure.site.foot));
            let radius = 0.5 * self.pile_m * stream.uniform(0.9, 1.1);
            let whole = stream.unit() >= self.broken;
            let stump = (structure.site.ground)(foot.x, foot.y) + stream.uniform(0.3, 0.5 * self.height_m);
            let end = if whole { head } else { foot + (head - foot) * ((stump - foot.z) / (head.z - foot.z)).min(1.0) };
            structure.part("pile", &self.material, &[Solid::rod(foot, end, radius, 20)]);
            standing.push(whole.then_some([head, foot]));
        }
        let reach = 0.5 * self.width_m;
        let z = self.height_m - 0.25;
        let cap = Solid::bar(DVec3::new(x, -reach, z), DVec3::new(x, reach, z), [0.5, 0.5]);
        structure.part("beam", &self.material, &[cap]);
        let braces: Vec<Solid> = standing
            .windows(2)
            .filter_map(|pair| Some((pair[0]?, pair[1]?)))
            .enumerate()
            .map(|(k, (a, b))| {
                let on = |[head, foot]: [DVec3; 2], z: f64| foot + (head - foot) * ((z - foot.z) / (head.z - foot.z));
                let [low, high] = [0.3, 0.8].map(|share| share * self.height_m);
                let (from, to) = if k % 2 == 0 { (low, high) } else { (high, low) };
                Solid::bar(on(a, from), on(b, to), [0.15, 0.25])
            })
            .collect();
        structure.part("brace", &self.material, &braces);
    }
}
