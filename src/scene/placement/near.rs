//! On the ground, at a distance from another object.

use glam::DAffine3;
use serde::{Deserialize, Serialize};

use super::rest::Stance;
use super::{ANY_DEG, Asking, Candidate, FAR_M, Miss, heading, outside};
use crate::math::real::radians;
use crate::math::rng::Stream;

/// Halvings on the way to the distance.
const HALVINGS: u32 = 20;
/// A place in a given direction may lie so far aside of it, degrees: on that side, and several find places there.
const ASIDE_DEG: f64 = 45.0;

/// At rest with so much water between it and another object, in a given or in a random direction from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Near {
    /// Label of the other: an object of another item or a labelled part of the environment; one of several at random.
    pub of: String,
    /// Least distance between the two surfaces, metres.
    pub distance_m: f64,
    /// In which direction from the other's middle, counter-clockwise from x (east), degrees; places up to [`ASIDE_DEG`]
    /// aside are tried. Any direction without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction_deg: Option<f64>,
    /// As for [`super::Rest`].
    pub yaw_deg: f64,
    /// As for [`super::Rest`].
    pub tip_deg: f64,
    /// As for [`super::Rest`].
    pub burial: f64,
}

impl Near {
    pub(super) fn fault(&self) -> Option<String> {
        let direction = ("direction_deg", self.direction_deg.unwrap_or(0.0), ANY_DEG.0, ANY_DEG.1);
        self.stance().fault().or_else(|| outside(&[("distance_m", self.distance_m, 0.0, FAR_M), direction]))
    }

    fn stance(&self) -> Stance {
        Stance { yaw_deg: self.yaw_deg, tip_deg: self.tip_deg, burial: self.burial }
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let number = asking.one_of_others(stream)?;
        let Asking { shape, around, .. } = *asking;
        let bounds = around.taken[number].bounds;
        let away = heading(match self.direction_deg {
            None => std::f64::consts::TAU * stream.unit(),
            Some(direction) => radians(direction + ASIDE_DEG * stream.uniform(-1.0, 1.0)),
        });
        let stand = |distance: f64| -> Result<DAffine3, Miss> {
            self.stance().stand(bounds.middle().truncate() + away * distance, asking)
        };
        let is_too_near = |place: &DAffine3| around.touches(&shape.tree, place, self.distance_m.max(1e-3), &[number]);
        let mut far = 0.5 * bounds.size().truncate().length() + shape.size() + self.distance_m;
        let mut place = stand(far)?;
        let mut near = 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            let there = stand(middle)?;
            if is_too_near(&there) {
                near = middle;
            } else {
                (far, place) = (middle, there);
            }
        }
        Ok(Candidate { touching: vec![number], ..place.into() })
    }
}

impl Asking<'_> {
    /// One of what the pose refers to.
    pub(super) fn one_of_others(&self, stream: &mut Stream) -> Result<usize, Miss> {
        match self.others.len() as u64 {
            0 => Err(Miss::Absent),
            count => Ok(self.others[stream.below(count) as usize]),
        }
    }
}
