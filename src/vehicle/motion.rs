//! The vehicle itself: what the water does to it, how often it pings, how much room it needs.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::trajectory::Voyage;
use super::wander::Wander;
use crate::math::real::radians;
use crate::math::{Impossible, Pose};

/// What holds along every kind of trajectory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vehicle {
    /// How waves and current shake it.
    pub attitude_noise: AttitudeNoise,
    /// From frame to frame where a trajectory has no speed and no time of its own, seconds.
    pub ping_s: f64,
    /// Free water about the vehicle's and the sonar's origin: down to the bottom, and all round to objects and structures,
    /// metres.
    pub clear_m: f64,
}

/// Root mean squares of what is added to the pose of a trajectory: a slow, smooth function of time, one for each scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttitudeNoise {
    /// Port side up and down, degrees.
    pub roll_deg: f64,
    /// Nose up and down, degrees.
    pub pitch_deg: f64,
    /// Nose to port and starboard, degrees.
    pub yaw_deg: f64,
    /// Up and down as a whole, metres.
    pub heave_m: f64,
    /// Mean period, seconds.
    pub period_s: f64,
}

impl Vehicle {
    /// At rest in the water, half a second between frames, 0.3 m of room: what recipes have by default.
    pub const CALM: Self = Self {
        attitude_noise: AttitudeNoise { roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0.0, heave_m: 0.0, period_s: 6.0 },
        ping_s: 0.5,
        clear_m: 0.3,
    };

    /// Whether the numbers can be.
    ///
    /// # Errors
    /// The first that cannot.
    pub fn validate(&self) -> Result<(), Impossible> {
        let noise = &self.attitude_noise;
        Impossible::outside("attitude_noise.roll_deg", noise.roll_deg, 0.0, 30.0)?;
        Impossible::outside("attitude_noise.pitch_deg", noise.pitch_deg, 0.0, 30.0)?;
        Impossible::outside("attitude_noise.yaw_deg", noise.yaw_deg, 0.0, 90.0)?;
        Impossible::outside("attitude_noise.heave_m", noise.heave_m, 0.0, 10.0)?;
        Impossible::outside("attitude_noise.period_s", noise.period_s, 0.1, 3600.0)?;
        Impossible::outside("ping_s", self.ping_s, 1e-3, 3600.0)?;
        Impossible::outside("clear_m", self.clear_m, 0.0, 10.0)
    }

    /// A pose as the water shakes it at a time, seconds.
    pub(super) fn shaken(&self, pose: Pose, time_s: f64, voyage: &Voyage) -> Pose {
        let noise = &self.attitude_noise;
        let wander = |rms, purpose| Wander { rms, period_s: noise.period_s }.at(time_s, (voyage.scene_stream)(purpose));
        if [noise.roll_deg, noise.pitch_deg, noise.yaw_deg, noise.heave_m] == [0.0; 4] {
            return pose;
        }
        let yaw = radians(wander(noise.yaw_deg, "vehicle.yaw"));
        let pitch = radians(wander(noise.pitch_deg, "vehicle.pitch"));
        let roll = radians(wander(noise.roll_deg, "vehicle.roll"));
        let mut shaken = pose.then_inner(&Pose::from_angles(DVec3::ZERO, yaw, pitch, roll));
        shaken.position.z += wander(noise.heave_m, "vehicle.heave");
        shaken
    }
}
