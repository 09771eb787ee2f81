//! At a given pose.

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};

use super::{ANY_DEG, FAR_M, outside};
use crate::math::Pose;
use crate::math::real::radians;

/// At a pose of the model's base centre, whatever else stands there: what overlaps is told.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct At {
    /// Of the middle of the model's base, world, metres.
    pub position_m: [f64; 3],
    /// Counter-clockwise from x, degrees.
    pub yaw_deg: f64,
    /// Nose (the model's x) up, degrees.
    pub pitch_deg: f64,
    /// Port side (the model's y) up, degrees.
    pub roll_deg: f64,
}

impl At {
    pub(super) fn fault(&self) -> Option<String> {
        let [x, y, z] = self.position_m;
        let place = [x, y, z].map(|value| ("position_m", value, -FAR_M, FAR_M));
        let angles = [("yaw_deg", self.yaw_deg), ("pitch_deg", self.pitch_deg), ("roll_deg", self.roll_deg)];
        outside(&place).or_else(|| outside(&angles.map(|(name, value)| (name, value, ANY_DEG.0, ANY_DEG.1))))
    }

    /// Where the mesh stands then.
    pub(super) fn stand(&self) -> DAffine3 {
        let position = DVec3::from_array(self.position_m);
        let pose = Pose::from_angles(position, radians(self.yaw_deg), radians(self.pitch_deg), radians(self.roll_deg));
        DAffine3 { matrix3: pose.rotation, translation: position }
    }
}
