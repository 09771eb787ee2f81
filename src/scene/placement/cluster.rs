//! A heap or a scatter: instances let fall about a place that they share.

use serde::{Deserialize, Serialize};

use super::settle::Release;
use super::{Asking, Candidate, FAR_M, Miss, disc, disc_about, disc_fault, is_origin, outside};
use crate::math::rng::Stream;

/// Settled about a middle that is drawn once a scene for all instances of the item. With `clear_m: 0` they pile up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cluster {
    /// Of the disc about the cluster's middle over which each is let go, metres.
    pub radius_m: f64,
    /// Radius of the disc in which the cluster's middle lies, metres.
    pub within_m: f64,
    /// Middle of that disc: x east, y north, metres.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre_m: [f64; 2],
    /// As for [`super::Settle`].
    pub yaw_deg: f64,
    /// As for [`super::Settle`].
    pub pitch_deg: f64,
    /// As for [`super::Settle`].
    pub roll_deg: f64,
    /// As for [`super::Settle`].
    pub drop_m: f64,
    /// As for [`super::Settle`].
    pub burial: f64,
}

impl Cluster {
    pub(super) fn fault(&self) -> Option<String> {
        let radius = || outside(&[("radius_m", self.radius_m, 0.0, FAR_M)]);
        self.release().fault().or_else(radius).or_else(|| disc_fault(self.centre_m, self.within_m))
    }

    fn release(&self) -> Release {
        let Self { yaw_deg, pitch_deg, roll_deg, drop_m, burial, .. } = *self;
        Release { yaw_deg, pitch_deg, roll_deg, drop_m, burial }
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let middle = disc_about(self.centre_m, self.within_m, &mut (asking.shared)());
        self.release().settle(middle + disc(self.radius_m, stream), asking)
    }
}
