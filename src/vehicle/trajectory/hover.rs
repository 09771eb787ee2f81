//! At one place, drifting about it.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::super::wander::Wander;
use super::{Voyage, finite, metres, not_negative, positive};
use crate::math::real::radians;
use crate::math::{Impossible, Pose};

/// A pose that is held as well as a pilot can.
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
    /// How far it strays.
    pub drift: Drift,
}

/// Root mean squares of a slow, smooth drift about the pose, one for each scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drift {
    /// Along x and along y, metres.
    pub horizontal_m: f64,
    /// Up and down, metres.
    pub vertical_m: f64,
    /// Of the heading, degrees.
    pub yaw_deg: f64,
    /// Mean period, seconds.
    pub period_s: f64,
}

impl Hover {
    pub(super) fn check(&self) -> Result<(), Impossible> {
        self.position_m.iter().try_for_each(|&value| metres("position_m", value))?;
        finite("yaw_deg", self.yaw_deg)?;
        finite("pitch_deg", self.pitch_deg)?;
        finite("roll_deg", self.roll_deg)?;
        not_negative("drift.horizontal_m", self.drift.horizontal_m)?;
        not_negative("drift.vertical_m", self.drift.vertical_m)?;
        not_negative("drift.yaw_deg", self.drift.yaw_deg)?;
        positive("drift.period_s", self.drift.period_s)
    }

    pub(super) fn pose(&self, time_s: f64, voyage: &Voyage) -> Pose {
        let drift = &self.drift;
        let wander = |rms, purpose| Wander { rms, period_s: drift.period_s }.at(time_s, (voyage.scene_stream)(purpose));
        let strayed = DVec3::new(
            wander(drift.horizontal_m, "hover.x"),
            wander(drift.horizontal_m, "hover.y"),
            wander(drift.vertical_m, "hover.z"),
        );
        let yaw_deg = self.yaw_deg + wander(drift.yaw_deg, "hover.yaw");
        let [yaw, pitch, roll] = [yaw_deg, self.pitch_deg, self.roll_deg].map(radians);
        Pose::from_angles(DVec3::from_array(self.position_m) + strayed, yaw, pitch, roll)
    }
}
