//! A string of pots: instances in a row on the ground, each joined to the one before it.

use serde::{Deserialize, Serialize};

use super::rest::Stance;
use super::rope::Rope;
use super::{ANY_DEG, Asking, Candidate, FAR_M, Miss, disc, disc_about, disc_fault, heading, is_origin, outside};
use crate::math::real::radians;
use crate::math::rng::Stream;

/// At rest along a course whose middle is drawn once a scene for all instances of the item; the first lies in the middle,
/// the others to both sides in turn, so that more of them move none. Ground ropes join neighbours; they are background.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// From one to the next along the course, metres.
    pub spacing_m: f64,
    /// Of the course, counter-clockwise from x, degrees: drawn `per: scene`, it is the same for all.
    pub heading_deg: f64,
    /// How far each may lie off its place on the course, metres.
    pub stray_m: f64,
    /// Thickness of the rope between neighbours, metres; none if 0.
    pub rope_m: f64,
    /// From the course to the body's own x, degrees.
    pub yaw_deg: f64,
    /// As for [`super::Rest`].
    pub tip_deg: f64,
    /// As for [`super::Rest`].
    pub burial: f64,
    /// Radius of the disc in which the line's middle lies, metres.
    pub within_m: f64,
    /// Middle of that disc: x east, y north, metres.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre_m: [f64; 2],
}

impl Line {
    pub(super) fn fault(&self) -> Option<String> {
        let lengths = [
            ("spacing_m", self.spacing_m, 0.01, FAR_M),
            ("heading_deg", self.heading_deg, ANY_DEG.0, ANY_DEG.1),
            ("stray_m", self.stray_m, 0.0, FAR_M),
            ("rope_m", self.rope_m, 0.0, 1.0),
        ];
        self.stance().fault().or_else(|| outside(&lengths)).or_else(|| disc_fault(self.centre_m, self.within_m))
    }

    fn stance(&self) -> Stance {
        Stance { yaw_deg: self.heading_deg + self.yaw_deg, tip_deg: self.tip_deg, burial: self.burial }
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let middle = disc_about(self.centre_m, self.within_m, &mut (asking.shared)());
        // 0, 1, −1, 2, −2 …
        let number = asking.instance;
        let slot = f64::from(number.div_ceil(2)) * if number % 2 == 1 { 1.0 } else { -1.0 };
        let nominal = middle + heading(radians(self.heading_deg)) * (slot * self.spacing_m);
        let world_from_mesh = self.stance().stand(nominal + disc(self.stray_m, stream), asking)?;
        let inner = match number {
            0 => None,
            1 | 2 => Some(0),
            _ => Some(number - 2),
        };
        let mate = inner.and_then(|inner| asking.mates.get(&inner)).filter(|_| self.rope_m > 0.0);
        let rope = mate.and_then(|&mate| {
            let (here, there) =
                (asking.shape.tree.bounds(&world_from_mesh)?.middle(), asking.around.taken[mate].bounds.middle());
            Some(Rope::along(asking.around.ground, here, there, self.rope_m, vec![mate]))
        });
        Ok(Candidate { rope, ..world_from_mesh.into() })
    }
}
