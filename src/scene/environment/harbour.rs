//! A harbour basin: quay walls on three sides, dolphins before the fourth.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::EnvironmentError;
use super::kinds::within;
use super::quay::Quay;
use super::solid::Solid;
use super::structure::Structure;
use crate::math::rng::Stream;

/// A basin about the world's origin, open towards positive x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Harbour {
    /// Along x, metres.
    pub length_m: f64,
    /// Along y, from quay to quay, metres.
    pub width_m: f64,
    /// Top of the quays above z = 0, metres.
    pub height_m: f64,
    /// From fender to fender, metres; none if 0.
    pub fender_spacing_m: f64,
    /// Mooring dolphins in the open side, 0 to 20.
    pub dolphins: u32,
}

impl Harbour {
    pub(super) const PARTS: &'static [&'static str] = &["dolphin", "dolphin-cap", "fender", "ladder", "quay-wall"];

    pub(super) fn check(&self) -> Result<(), EnvironmentError> {
        within("length_m", self.length_m, [2.0, 500.0])?;
        within("width_m", self.width_m, [2.0, 500.0])?;
        within("height_m", self.height_m, [1.0, 50.0])?;
        within("fender_spacing_m", self.fender_spacing_m, [0.0, 100.0])?;
        within("dolphins", self.dolphins.into(), [0.0, 20.0])
    }

    pub(super) fn raise(&self, structure: &mut Structure, stream: &mut Stream) {
        let corner = |x: f64, y: f64| DVec3::new(x * 0.5 * self.length_m, y * 0.5 * self.width_m, 0.0);
        let corners = [corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)];
        for ends in corners.windows(2) {
            Quay { from: ends[0], to: ends[1], height: self.height_m, fenders: self.fender_spacing_m }.raise(structure);
        }
        for dolphin in 0..self.dolphins {
            let share = (f64::from(dolphin) + 0.5) / f64::from(self.dolphins) - 0.5;
            self.dolphin(corner(0.8, 2.0 * share), structure, stream);
        }
    }

    /// Three raked piles under a cap.
    fn dolphin(&self, place: DVec3, structure: &mut Structure, stream: &mut Stream) {
        let turn = stream.uniform(0.0, std::f64::consts::TAU);
        let piles: Vec<Solid> = (0..3)
            .map(|k| {
                let angle = turn + std::f64::consts::TAU * f64::from(k) / 3.0;
                let out = DVec3::new(crate::math::real::cos(angle), crate::math::real::sin(angle), 0.0);
                let (foot, head) =
                    (place + out * 1.3 + DVec3::Z * structure.site.foot, place + out * 0.5 + DVec3::Z * self.height_m);
                Solid::rod(foot, head, 0.3, 20)
            })
            .collect();
        structure.part("dolphin", "steel", &piles);
        let cap = DVec3::new(1.0, 1.0, 0.0);
        let (low, high) = (place - cap + DVec3::Z * self.height_m, place + cap + DVec3::Z * (self.height_m + 0.8));
        structure.part("dolphin-cap", "concrete", &[Solid::block(low, high)]);
    }
}
