//! Standing on its end, leaning against another object.

use glam::{DAffine3, DMat3, DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::footing::{from_up_to, touching};
use super::tree::Box3;
use super::{ANY_DEG, Asking, Candidate, Miss, heading, outside};
use crate::math::Pose;
use crate::math::real::{cos, radians, sin};
use crate::math::rng::Stream;

/// It comes from afar in so many steps, and the last of them is halved so often.
const APPROACH: (u32, u32) = (48, 16);
/// By how much it leans more where it would tip over, and how far at most, degrees.
const STEEPER_DEG: (f64, f64) = (8.0, 84.0);
/// The other is this share of its size away at most from a point above its middle.
const HELD: f64 = 1.0 / 30.0;

/// On the ground and against another object, which holds it above its middle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Leaning {
    /// Label of the other: an object of another item or a labelled part of the environment; one of several at random.
    pub against: String,
    /// Of its longest side from the upright, towards the other, degrees; more where the other is so low that it would tip over.
    pub lean_deg: f64,
    /// About its longest side, degrees.
    pub turn_deg: f64,
}

impl Leaning {
    pub(super) fn fault(&self) -> Option<String> {
        outside(&[("lean_deg", self.lean_deg, 1.0, STEEPER_DEG.1), ("turn_deg", self.turn_deg, ANY_DEG.0, ANY_DEG.1)])
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let number = asking.one_of_others(stream)?;
        let towards = heading(std::f64::consts::TAU * stream.unit());
        // Against a spot beside the middle too, not only against the middle.
        let aside = 0.25 * stream.uniform(-1.0, 1.0);
        let mut lean_deg = self.lean_deg;
        while lean_deg <= STEEPER_DEG.1 {
            let turn = self.turn(lean_deg, towards, asking);
            let place = Approach { turn, towards, aside, number }.against(asking)?;
            if is_held(&place, number, asking) {
                return Ok(Candidate { touching: vec![number], ..place.into() });
            }
            lean_deg += STEEPER_DEG.0;
        }
        Err(Miss::NoHold)
    }

    /// Longest side up, turned about it, leaning towards a direction.
    fn turn(&self, lean_deg: f64, towards: DVec2, asking: &Asking) -> DMat3 {
        let size = asking.shape.bounds.size();
        let upright = if size.z >= size.x && size.z >= size.y {
            DMat3::IDENTITY
        } else if size.x >= size.y {
            DMat3::from_cols(DVec3::Z, DVec3::Y, DVec3::NEG_X)
        } else {
            DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y)
        };
        let about = Pose::from_angles(DVec3::ZERO, radians(self.turn_deg), 0.0, 0.0).rotation;
        let up = (towards * sin(radians(lean_deg))).extend(cos(radians(lean_deg)));
        from_up_to(up) * about * upright
    }
}

/// How a body comes to another.
struct Approach {
    turn: DMat3,
    towards: DVec2,
    /// Beside the other's middle, in its widths.
    aside: f64,
    number: usize,
}

impl Approach {
    /// On the ground, as far from the other as it can be and touch it.
    fn against(&self, asking: &Asking) -> Result<DAffine3, Miss> {
        let Asking { shape, around, .. } = *asking;
        let other = around.taken[self.number].bounds;
        let box_about = Box3::about(shape.hull.iter().map(|p| self.turn * *p));
        let width = other.size().truncate();
        let goal = other.middle().truncate() + self.towards.perp() * (self.aside * width.min_element());
        let stand = |distance: f64| {
            let place = goal - self.towards * distance;
            let level = DAffine3 { matrix3: self.turn, translation: place.extend(0.0) - box_about.middle() };
            touching(around.ground, shape, level)
        };
        let meets = |distance: f64| around.touches(&shape.tree, &stand(distance), 0.0, &[self.number]);
        let furthest = 0.5 * width.length() + 0.6 * shape.size() + 0.1;
        let step = furthest / f64::from(APPROACH.0);
        let first = (1..=APPROACH.0).find(|&k| meets(furthest - step * f64::from(k))).ok_or(Miss::NoHold)?;
        let (mut near, mut far) = (furthest - step * f64::from(first), furthest - step * f64::from(first - 1));
        for _ in 0..APPROACH.1 {
            let middle = 0.5 * (near + far);
            if meets(middle) { near = middle } else { far = middle }
        }
        let place = stand(far);
        let foot = place.translation;
        if around.ground.is_there(foot.x, foot.y) { Ok(place) } else { Err(Miss::NoGround) }
    }
}

/// Whether the other is against its upper half.
fn is_held(place: &DAffine3, number: usize, asking: &Asking) -> bool {
    let Asking { shape, around, .. } = *asking;
    let other = &around.taken[number];
    let middle = place.transform_point3(shape.balance.centre).z;
    let other_from_world = other.world_from_mesh.inverse();
    let above = shape.samples.iter().map(|p| place.transform_point3(*p)).filter(|p| p.z > middle);
    let reach = HELD * shape.size();
    above
        .filter(|p| other.bounds.grown(reach).holds(*p))
        .any(|p| other.tree.is_near(other_from_world.transform_point3(p), reach))
}
