//! The same pose in all frames.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{TrajectoryError, finite};
use crate::math::Pose;
use crate::math::real::radians;

/// A fixed pose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hover {
    /// In the world, metres.
    pub position_m: [f64; 3],
    /// Counter-clockwise from x, degrees.
    pub yaw_deg: f64,
    /// Nose up, degrees.
    pub pitch_deg: f64,
    /// Port side up, degrees.
    pub roll_deg: f64,
}

impl Hover {
    pub(super) fn check(&self) -> Result<(), TrajectoryError> {
        self.position_m.iter().try_for_each(|&value| finite("position_m", value))?;
        finite("yaw_deg", self.yaw_deg)?;
        finite("pitch_deg", self.pitch_deg)?;
        finite("roll_deg", self.roll_deg)
    }

    pub(super) fn pose(&self) -> Pose {
        let [yaw, pitch, roll] = [self.yaw_deg, self.pitch_deg, self.roll_deg].map(radians);
        Pose::from_angles(DVec3::from_array(self.position_m), yaw, pitch, roll)
    }
}
