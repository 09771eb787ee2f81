//! Let fall through the water, lying as it comes to rest.

use glam::{DAffine3, DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::fall::Drop;
use super::footing::{clearance, raised, sunk, touching};
use super::taken::Whose;
use super::tree::Box3;
use super::{ANY_DEG, Asking, Candidate, Miss, disc_about, disc_fault, is_origin, outside};
use crate::math::Pose;
use crate::math::real::radians;
use crate::math::rng::Stream;

/// A body whose hull lies on the ground may stand this share of its size above it, as a ring over a stone does.
const HOLLOW: f64 = 0.1;
/// A body's hull and the triangles of others that it lies on are this share of its size apart at most.
const LYING: f64 = 0.03;

/// One that fell on others is lifted by so much of its size at a time, so many times, until it is in none.
const LIFTS: (f64, u32) = (2e-3, 16);

/// Let go over a disc about the world's origin or another place, and left to a rigid-body engine: gravity, drag, friction, the shape of the ground. What
/// has fallen on others stays there only where `clear_m` is 0; else it keeps clear of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settle {
    /// As it is let go: counter-clockwise from x, degrees.
    pub yaw_deg: f64,
    /// As it is let go: nose (the model's x) up, degrees.
    pub pitch_deg: f64,
    /// As it is let go: port side (the model's y) up, degrees.
    pub roll_deg: f64,
    /// Height of its lowest point above the ground as it is let go, metres.
    pub drop_m: f64,
    /// Share of its height that sinks into the ground once it lies, as for [`super::Rest`].
    pub burial: f64,
    /// Radius of the disc over which it is let go, metres.
    pub within_m: f64,
    /// Middle of that disc: x east, y north, metres.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre_m: [f64; 2],
}

/// How a body is let go, wherever that is.
pub(super) struct Release {
    pub yaw_deg: f64,
    pub pitch_deg: f64,
    pub roll_deg: f64,
    pub drop_m: f64,
    pub burial: f64,
}

impl Settle {
    pub(super) fn fault(&self) -> Option<String> {
        self.release().fault().or_else(|| disc_fault(self.centre_m, self.within_m))
    }

    fn release(&self) -> Release {
        let Self { yaw_deg, pitch_deg, roll_deg, drop_m, burial, .. } = *self;
        Release { yaw_deg, pitch_deg, roll_deg, drop_m, burial }
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        self.release().settle(disc_about(self.centre_m, self.within_m, stream), asking)
    }
}

impl Release {
    pub fn fault(&self) -> Option<String> {
        let angles = [("yaw_deg", self.yaw_deg), ("pitch_deg", self.pitch_deg), ("roll_deg", self.roll_deg)];
        outside(&[("burial", self.burial, 0.0, 1.0), ("drop_m", self.drop_m, 0.0, 20.0)])
            .or_else(|| outside(&angles.map(|(name, value)| (name, value, ANY_DEG.0, ANY_DEG.1))))
    }

    /// Let go over a place in plan and settled on the ground, or on others where it keeps no water clear.
    pub fn settle(&self, place: DVec2, asking: &Asking) -> Result<Candidate, Miss> {
        let Asking { shape, around, clear_m, .. } = *asking;
        let low = self.over(place, asking)?;
        let start = if clear_m > 0.0 {
            // Where it would pass through others, it is not let go at all.
            if !around.is_free(&shape.tree, &low, clear_m, &[]) {
                return Err(Miss::Taken);
            }
            raised(low, self.drop_m)
        } else {
            raised(low, self.drop_m + asking.rise_over(&low))
        };
        let landed = self.fall(start, asking)?;
        let gap = clearance(around.ground, shape, &landed);
        let lies = touching(around.ground, shape, landed);
        if gap <= HOLLOW * shape.size() && around.is_free(&shape.tree, &lies, 0.0, &[]) {
            return Ok(sunk(around.ground, shape, lies, self.burial).into());
        }
        let lies = asking.lifted(raised(landed, (-gap).max(0.0)))?;
        let touches = around.touches(&shape.tree, &lies, LYING * shape.size(), &asking.objects());
        if touches && clear_m <= 0.0 { Ok(lies.into()) } else { Err(Miss::Restless) }
    }

    /// Turned as it is let go, its middle over a place in plan, touching the ground.
    pub fn over(&self, place: DVec2, asking: &Asking) -> Result<DAffine3, Miss> {
        let (shape, ground) = (asking.shape, asking.around.ground);
        if !ground.is_there(place.x, place.y) {
            return Err(Miss::NoGround);
        }
        let angles = [self.yaw_deg, self.pitch_deg, self.roll_deg].map(radians);
        let turn = Pose::from_angles(DVec3::ZERO, angles[0], angles[1], angles[2]).rotation;
        let middle = Box3::about(shape.hull.iter().map(|p| turn * *p)).middle();
        Ok(touching(ground, shape, DAffine3 { matrix3: turn, translation: place.extend(0.0) - middle }))
    }

    /// From there to where it comes to rest.
    pub fn fall(&self, start: DAffine3, asking: &Asking) -> Result<DAffine3, Miss> {
        let Asking { shape, around, .. } = *asking;
        if !around.is_free(&shape.tree, &start, 0.0, &[]) {
            return Err(Miss::Taken);
        }
        let landed = Drop { shape, world_from_mesh: start, burial: self.burial }.land(&around)?;
        let centre = landed.transform_point3(shape.balance.centre);
        if around.ground.is_there(centre.x, centre.y) { Ok(landed) } else { Err(Miss::NoGround) }
    }
}

impl Asking<'_> {
    /// A body that has come to rest on others, lifted until it is in none of them: it fell on coarser surfaces.
    pub(super) fn lifted(&self, landed: DAffine3) -> Result<DAffine3, Miss> {
        let steps = (0..=LIFTS.1).map(|k| raised(landed, LIFTS.0 * self.shape.size() * f64::from(k)));
        steps.into_iter().find(|place| self.around.is_free(&self.shape.tree, place, 0.0, &[])).ok_or(Miss::NoHold)
    }

    /// How much higher a body must be to be above all objects that it would meet, straight below and above.
    pub(super) fn rise_over(&self, low: &DAffine3) -> f64 {
        let Some(bounds) = self.shape.tree.bounds(low) else { return 0.0 };
        let column = Box3 { low: bounds.low.with_z(f64::MIN), high: bounds.high.with_z(f64::MAX) };
        let tops = self.objects().into_iter().map(|number| &self.around.taken[number].bounds);
        let top = tops.filter(|other| other.meets(&column)).map(|other| other.high.z).fold(f64::MIN, f64::max);
        (top - bounds.low.z).max(0.0)
    }

    /// Numbers of all that are objects, not structures or ropes.
    pub(super) fn objects(&self) -> Vec<usize> {
        let is_object = |number: &usize| matches!(self.around.taken[*number].whose, Whose::Object(_));
        (0..self.around.taken.len()).filter(is_object).collect()
    }
}
