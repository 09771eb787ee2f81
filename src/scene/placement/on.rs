//! Let fall on another object, lying on it.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::footing::{clearance, raised};
use super::settle::Release;
use super::{Asking, Candidate, Miss};
use crate::math::rng::Stream;

/// Hull and triangles are this share of its size apart at most where it lies.
const LYING: f64 = 0.03;

/// Let go over another object; it must come to rest on it, off the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct On {
    /// Label of the other: an object of another item or a labelled part of the environment; one of several at random.
    pub of: String,
    /// As for [`super::Settle`].
    pub yaw_deg: f64,
    /// As for [`super::Settle`].
    pub pitch_deg: f64,
    /// As for [`super::Settle`].
    pub roll_deg: f64,
    /// Height of its lowest point above the other's highest as it is let go, metres.
    pub drop_m: f64,
}

impl On {
    pub(super) fn fault(&self) -> Option<String> {
        self.release().fault()
    }

    fn release(&self) -> Release {
        let Self { yaw_deg, pitch_deg, roll_deg, drop_m, of: _ } = *self;
        Release { yaw_deg, pitch_deg, roll_deg, drop_m, burial: 0.0 }
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let number = asking.one_of_others(stream)?;
        let Asking { shape, around, .. } = *asking;
        let other = &around.taken[number];
        let (middle, size) = (other.bounds.middle(), other.bounds.size());
        // Over the inner part, where it is more likely to stay.
        let aside = DVec2::new(stream.uniform(-0.3, 0.3) * size.x, stream.uniform(-0.3, 0.3) * size.y);
        let release = self.release();
        let low = release.over(middle.truncate() + aside, asking)?;
        let bottom = shape.tree.bounds(&low).ok_or(Miss::NoHold)?.low.z;
        let landed = release.fall(raised(low, (other.bounds.high.z - bottom).max(0.0) + self.drop_m), asking)?;
        let lies = asking.lifted(landed)?;
        let held = around.touches(&shape.tree, &lies, LYING * shape.size(), &[number]);
        let off_ground = clearance(around.ground, shape, &lies) > LYING * shape.size();
        if held && off_ground { Ok(Candidate { touching: vec![number], ..lies.into() }) } else { Err(Miss::NoHold) }
    }
}
