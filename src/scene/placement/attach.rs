//! Its base against a structure or another object: a charge on a pile, growth on a hull.

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};

use super::footing::from_up_to;
use super::taken::{Taken, Whose};
use super::{ANY_DEG, Asking, Candidate, FAR_M, Miss, outside};
use crate::math::Pose;
use crate::math::real::radians;
use crate::math::rng::Stream;

/// What stands for the whole environment.
const ENVIRONMENT: &str = "environment";
/// It moves out by shares of this of its size, so many times, where the surface bends into it.
const OUTWARDS: (f64, u32) = (0.01, 25);

/// At a height on the sides of something, its up direction away from the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Attach {
    /// `environment`, or a label: an object of another item or a labelled part of the environment.
    pub to: String,
    /// Above the foot of what it is on, metres: above the seabed, where that comes up higher.
    pub height_m: f64,
    /// From the surface to its base, metres.
    pub offset_m: f64,
    /// About the surface's normal, degrees.
    pub turn_deg: f64,
    /// On an environment: distance in plan from the world's origin, at most, metres.
    pub within_m: f64,
}

/// A level line across a triangle.
struct Cut {
    from: DVec3,
    to: DVec3,
    normal: DVec3,
    number: usize,
}

impl Attach {
    pub(super) fn fault(&self) -> Option<String> {
        outside(&[
            ("height_m", self.height_m, 0.0, FAR_M),
            ("offset_m", self.offset_m, 0.0, 100.0),
            ("turn_deg", self.turn_deg, ANY_DEG.0, ANY_DEG.1),
            ("within_m", self.within_m, 0.0, FAR_M),
        ])
    }

    /// The label of the objects that it may be on.
    pub(super) fn label(&self) -> Option<&str> {
        (self.to != ENVIRONMENT).then_some(&*self.to)
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let numbers: Vec<usize> = match self.label() {
            Some(_) => vec![asking.one_of_others(stream)?],
            None => asking.parts(),
        };
        let Asking { shape, around, .. } = *asking;
        let cuts: Vec<Cut> = numbers.iter().flat_map(|&number| self.cuts(number, asking)).collect();
        let Some(spot) = pick(&cuts, stream) else {
            return Err(if numbers.is_empty() { Miss::Absent } else { Miss::NoHold });
        };
        let (point, cut) = spot;
        let about = Pose::from_angles(DVec3::ZERO, radians(self.turn_deg), 0.0, 0.0).rotation;
        let turn = from_up_to(cut.normal) * about;
        let base = turn * shape.bounds.middle().with_z(shape.bounds.low.z);
        let at = |out: f64| DAffine3 { matrix3: turn, translation: point + cut.normal * out - base };
        // A hair off the surface: what lies on it does not pass through it by rounding.
        let place = (0..=OUTWARDS.1)
            .map(|k| at(self.offset_m.max(1e-4) + OUTWARDS.0 * shape.size() * f64::from(k)))
            .find(|place| !around.touches(&shape.tree, place, 0.0, &numbers))
            .ok_or(Miss::NoHold)?;
        let low = super::footing::clearance_of_seabed(around.ground, shape, &place);
        if low < 0.0 { Err(Miss::Taken) } else { Ok(Candidate { touching: vec![cut.number], ..place.into() }) }
    }

    /// Level lines at its height across the sides of something.
    fn cuts(&self, number: usize, asking: &Asking) -> Vec<Cut> {
        let other = &asking.around.taken[number];
        let height = foot(other, asking) + self.height_m;
        if !(other.bounds.low.z..=other.bounds.high.z).contains(&height) {
            return Vec::new();
        }
        let on_environment = matches!(other.whose, Whose::Part(_)) && self.label().is_none();
        let is_near = |cut: &Cut| !on_environment || cut.from.truncate().length() <= self.within_m;
        let place = other.world_from_mesh;
        let triangles = other.tree.triangles().iter().map(|t| t.map(|p| place.transform_point3(p)));
        triangles.filter_map(|triangle| across(triangle, height, number)).filter(is_near).collect()
    }
}

/// Height of the foot of something.
fn foot(other: &Taken, asking: &Asking) -> f64 {
    let middle = other.bounds.middle();
    let seabed = asking.around.ground.seabed.as_ref().map_or(f64::MIN, |grid| grid.height(middle.x, middle.y));
    other.bounds.low.z.max(seabed)
}

/// Where a level plane cuts a triangle.
fn across([a, b, c]: [DVec3; 3], height: f64, number: usize) -> Option<Cut> {
    let normal = (b - a).cross(c - a).try_normalize()?;
    let mut ends = [(a, b), (b, c), (c, a)].into_iter().filter_map(|(p, q)| {
        let crosses = (p.z - height) * (q.z - height) < 0.0;
        crosses.then(|| p + (q - p) * ((height - p.z) / (q.z - p.z)))
    });
    let (from, to) = (ends.next()?, ends.next()?);
    Some(Cut { from, to, normal, number })
}

/// A point on the lines, all equally likely by length.
fn pick<'c>(cuts: &'c [Cut], stream: &mut Stream) -> Option<(DVec3, &'c Cut)> {
    let total: f64 = cuts.iter().map(|cut| (cut.to - cut.from).length()).sum();
    let mut left = stream.unit() * total;
    for cut in cuts {
        let length = (cut.to - cut.from).length();
        if left < length {
            return Some((cut.from + (cut.to - cut.from) * (left / length), cut));
        }
        left -= length;
    }
    // Rounding may leave a hair beyond the last.
    cuts.last().map(|cut| (cut.to, cut))
}

impl Asking<'_> {
    /// Numbers of the parts of the environment.
    fn parts(&self) -> Vec<usize> {
        let is_part = |number: &usize| matches!(self.around.taken[*number].whose, Whose::Part(_));
        (0..self.around.taken.len()).filter(is_part).collect()
    }
}
