//! Upright on the ground, turned with the slope under it.

use glam::{DAffine3, DMat3, DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::footing::{Plane, from_up_to, sunk, touching};
use super::tree::Box3;
use super::{ANY_DEG, Asking, Candidate, Miss, disc_about, disc_fault, is_origin, outside};
use crate::math::Pose;
use crate::math::real::radians;
use crate::math::rng::Stream;

/// Steepest ground that a body rests on: its normal's z, here 45°.
const LEAST_UPRIGHT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// At rest on the ground in a disc about the world's origin or another place, as the model stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rest {
    /// Counter-clockwise from x, degrees.
    pub yaw_deg: f64,
    /// About the model's own x axis, before the yaw: 90 lays a standing barrel down, degrees.
    pub tip_deg: f64,
    /// Share of the body's height that lies below the ground, 0 to 1: height along the normal of the plane that fits the
    /// ground under the body best, ground as that plane. Lying in a hollow, it may be deeper already.
    pub burial: f64,
    /// Radius of the disc in which it lies, metres.
    pub within_m: f64,
    /// Middle of that disc: x east, y north, metres.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre_m: [f64; 2],
}

/// A body that stands, wherever that is.
pub(super) struct Stance {
    pub yaw_deg: f64,
    pub tip_deg: f64,
    pub burial: f64,
}

impl Rest {
    pub(super) fn fault(&self) -> Option<String> {
        self.stance().fault().or_else(|| disc_fault(self.centre_m, self.within_m))
    }

    fn stance(&self) -> Stance {
        Stance { yaw_deg: self.yaw_deg, tip_deg: self.tip_deg, burial: self.burial }
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        Ok(self.stance().stand(disc_about(self.centre_m, self.within_m, stream), asking)?.into())
    }
}

impl Stance {
    pub fn fault(&self) -> Option<String> {
        let angles = [("yaw_deg", self.yaw_deg), ("tip_deg", self.tip_deg)];
        outside(&[("burial", self.burial, 0.0, 1.0)])
            .or_else(|| outside(&angles.map(|(name, value)| (name, value, ANY_DEG.0, ANY_DEG.1))))
    }

    /// With the middle of its base at a place in plan.
    pub fn stand(&self, place: DVec2, asking: &Asking) -> Result<DAffine3, Miss> {
        let (ground, shape) = (asking.around.ground, asking.shape);
        if !ground.is_there(place.x, place.y) {
            return Err(Miss::NoGround);
        }
        let tip = Pose::from_angles(DVec3::ZERO, 0.0, 0.0, radians(self.tip_deg)).rotation;
        let turn = Pose::from_angles(DVec3::ZERO, radians(self.yaw_deg), 0.0, 0.0).rotation * tip;
        let bounds = Box3::about(shape.hull.iter().map(|p| tip * *p));
        let middle = bounds.middle();
        let base = turn * (tip.transpose() * DVec3::new(middle.x, middle.y, bounds.low.z));
        let level = DAffine3 { matrix3: turn, translation: place.extend(0.0) - base };
        let plane = Plane::under_body(ground, shape, &level);
        if plane.normal.z < LEAST_UPRIGHT {
            return Err(Miss::Steep);
        }
        let sloped: DMat3 = from_up_to(plane.normal);
        let stands = DAffine3 { matrix3: sloped * turn, translation: place.extend(0.0) - sloped * base };
        Ok(sunk(ground, shape, touching(ground, shape, stands), self.burial))
    }
}
