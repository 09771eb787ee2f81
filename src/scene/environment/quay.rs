//! Quay walls of sheet piling, with fenders and ladders: what piers and harbours have in common.

use glam::DVec3;

use super::solid::Solid;
use super::structure::Structure;

/// A straight quay wall. Its face looks to port of the way from `from` to `to`.
pub(super) struct Quay {
    /// One end of the wall's face, at z = 0.
    pub from: DVec3,
    /// The other end.
    pub to: DVec3,
    /// Top of the wall above z = 0, metres.
    pub height: f64,
    /// Between fenders, metres; none if 0.
    pub fenders: f64,
}

impl Quay {
    pub(super) fn raise(&self, structure: &mut Structure) {
        let way = self.to - self.from;
        let along = way.normalize();
        let out = DVec3::new(-along.y, along.x, 0.0);
        let foot = structure.site.foot;
        let middle = 0.5 * (foot + self.height);
        // A slab at right angles to the face: `depth` of it before the face line, the rest behind.
        let slab = |start: f64, end: f64, before: f64| {
            let depth = 1.0 + before;
            let line = out * (before - 0.5 * depth) + DVec3::Z * middle;
            Solid::bar(self.from + along * start + line, self.from + along * end + line, [depth, self.height - foot])
        };
        // Pans of sheet piles stand out and back in turn.
        const PAN_M: f64 = 0.7;
        let pans = (way.length() / PAN_M).ceil().max(1.0) as u32;
        let width = way.length() / f64::from(pans);
        let sheet: Vec<Solid> = (0..pans)
            .map(|k| slab(f64::from(k) * width, f64::from(k + 1) * width, if k % 2 == 0 { 0.0 } else { -0.35 }))
            .collect();
        structure.part("quay-wall", "steel", &sheet);
        if self.fenders > 0.0 {
            let count = (way.length() / self.fenders).floor() as u32;
            for k in 0..count {
                let place = self.from + along * ((f64::from(k) + 0.5) * way.length() / f64::from(count));
                self.fender(place + out * 0.25, structure);
                if k % 3 == 1 {
                    self.ladder(place + along * (0.3 * self.fenders) + out * 0.12, along, structure);
                }
            }
        }
    }

    /// A rubber cylinder that hangs before the wall down to a third of its height.
    fn fender(&self, place: DVec3, structure: &mut Structure) {
        let [low, high] = [0.35, 0.9].map(|share| place + DVec3::Z * (share * self.height));
        structure.part("fender", "rubber", &[Solid::rod(low, high, 0.25, 16)]);
    }

    fn ladder(&self, place: DVec3, along: DVec3, structure: &mut Structure) {
        let rail = |side: f64, z: f64| place + along * side + DVec3::Z * z;
        let (low, high) = (0.25 * self.height, self.height);
        let mut solids: Vec<Solid> =
            [-0.22, 0.22].map(|side| Solid::bar(rail(side, low), rail(side, high), [0.05, 0.05])).into();
        let rungs = ((high - low) / 0.3).floor() as u32;
        solids.extend(
            (1..rungs).map(|k| low + 0.3 * f64::from(k)).map(|z| Solid::rod(rail(-0.22, z), rail(0.22, z), 0.015, 6)),
        );
        structure.part("ladder", "steel", &solids);
    }
}
