//! Where bodies stand, lie, float and hang, without ever passing through each other.
//!
//! A kind proposes poses, one a try; [`search`] takes the first that keeps clear of all that is there. Knows nothing of
//! catalogs, recipes or sonars: it places meshes, and is told from where they are looked at.

mod at;
mod attach;
mod cluster;
mod fall;
mod float;
mod footing;
mod in_view;
mod leaning;
mod line;
mod near;
mod on;
mod order;
mod rest;
mod rope;
mod search;
mod settle;
mod shape;
mod spec;
mod taken;
mod tree;
mod triangle;

use glam::{DAffine3, DVec2};
use serde::{Deserialize, Serialize};

pub use at::At;
pub use attach::Attach;
pub use cluster::Cluster;
pub use float::{Float, School};
pub use in_view::{Frames, InView, NamedFrames, View};
pub use leaning::Leaning;
pub use line::Line;
pub use near::Near;
pub use on::On;
pub use rest::Rest;
pub use settle::Settle;
pub use shape::Shape;
pub use spec::{BodySpec, OnFailure};
pub use tree::Tree;

pub(super) use in_view::is_seen;
pub(super) use order::order;
pub(super) use rope::ROPE;
pub(super) use search::{Before, Search, Standing};
pub(super) use taken::{Taken, Whose};

use crate::math::real::{cos, sin};
use crate::math::rng::Stream;
use crate::scene::ground::Ground;
use rope::Rope;

/// How a body is placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PoseSpec {
    /// Upright on the ground, at a random free place.
    Rest(Rest),
    /// Let fall on the ground, lying as it comes to rest.
    Settle(Settle),
    /// In mid-water, moored or free, alone or in a school.
    Float(Float),
    /// Its base against a structure or another object.
    Attach(Attach),
    /// Exactly there.
    At(At),
    /// On the ground, at a distance from another object.
    Near(Near),
    /// Let fall on another object, lying on it.
    On(On),
    /// Standing on its end, leaning against another object.
    Leaning(Leaning),
    /// Let fall about a place that all instances share.
    Cluster(Cluster),
    /// In a row on the ground, joined by a rope.
    Line(Line),
}

impl PoseSpec {
    /// What is wrong with the numbers, if anything.
    pub(super) fn fault(&self) -> Option<String> {
        match self {
            Self::Rest(rest) => rest.fault(),
            Self::Settle(settle) => settle.fault(),
            Self::Float(float) => float.fault(),
            Self::Attach(attach) => attach.fault(),
            Self::At(at) => at.fault(),
            Self::Near(near) => near.fault(),
            Self::On(on) => on.fault(),
            Self::Leaning(leaning) => leaning.fault(),
            Self::Cluster(cluster) => cluster.fault(),
            Self::Line(line) => line.fault(),
        }
    }

    /// The kind's name in recipes.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Rest(_) => "rest",
            Self::Settle(_) => "settle",
            Self::Float(_) => "float",
            Self::Attach(_) => "attach",
            Self::At(_) => "at",
            Self::Near(_) => "near",
            Self::On(_) => "on",
            Self::Leaning(_) => "leaning",
            Self::Cluster(_) => "cluster",
            Self::Line(_) => "line",
        }
    }

    /// The label of the objects that this pose needs, with the key that names it.
    #[must_use]
    pub fn refers_to(&self) -> Option<(&'static str, &str)> {
        match self {
            Self::Near(near) => Some(("of", &near.of)),
            Self::On(on) => Some(("of", &on.of)),
            Self::Leaning(leaning) => Some(("against", &leaning.against)),
            Self::Attach(attach) => attach.label().map(|label| ("to", label)),
            Self::Rest(_) | Self::Settle(_) | Self::Float(_) | Self::At(_) | Self::Cluster(_) | Self::Line(_) => None,
        }
    }

    /// Whether it can only be in a scene with an environment.
    #[must_use]
    pub fn needs_environment(&self) -> bool {
        matches!(self, Self::Attach(attach) if attach.label().is_none())
    }

    /// One try.
    fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        match self {
            Self::Rest(rest) => rest.propose(asking, stream),
            Self::Settle(settle) => settle.propose(asking, stream),
            Self::Float(float) => float.propose(asking, stream),
            Self::Attach(attach) => attach.propose(asking, stream),
            Self::At(at) => Ok(at.stand().into()),
            Self::Near(near) => near.propose(asking, stream),
            Self::On(on) => on.propose(asking, stream),
            Self::Leaning(leaning) => leaning.propose(asking, stream),
            Self::Cluster(cluster) => cluster.propose(asking, stream),
            Self::Line(line) => line.propose(asking, stream),
        }
    }
}

/// What a body must get along with.
#[derive(Clone, Copy)]
struct Around<'a> {
    ground: &'a Ground,
    taken: &'a [Taken],
}

/// One body that looks for a place.
struct Asking<'a> {
    shape: &'a Shape,
    around: Around<'a>,
    /// Number among the instances of its item.
    instance: u32,
    /// Free water to any other body, metres.
    clear_m: f64,
    /// The stream of what the instances of its item share, from its beginning.
    shared: &'a dyn Fn() -> Stream,
    /// Numbers in `around.taken` of what its pose refers to.
    others: &'a [usize],
    /// Numbers in `around.taken` of its item's other instances, by their numbers.
    mates: &'a std::collections::BTreeMap<u32, usize>,
}

/// A pose that a kind proposes.
struct Candidate {
    world_from_mesh: DAffine3,
    /// Numbers of what it may touch, however much free water it asks for.
    touching: Vec<usize>,
    rope: Option<Rope>,
}

impl From<DAffine3> for Candidate {
    fn from(world_from_mesh: DAffine3) -> Self {
        Self { world_from_mesh, touching: Vec::new(), rope: None }
    }
}

/// Why a try came to nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Miss {
    NoGround,
    Steep,
    Taken,
    Restless,
    NoHold,
    Absent,
    Unseen,
}

impl Miss {
    fn words(self) -> &'static str {
        match self {
            Self::NoGround => "there is no ground",
            Self::Steep => "the ground is too steep",
            Self::Taken => "other bodies are in the way",
            Self::Restless => "it does not come to rest there",
            Self::NoHold => "it finds no hold",
            Self::Absent => "what its pose refers to is not in the scene",
            Self::Unseen => "it is not in view",
        }
    }
}

/// Uniform in the disc about the origin.
fn disc(radius: f64, stream: &mut Stream) -> DVec2 {
    let from_middle = radius * stream.unit().sqrt();
    from_middle * heading(std::f64::consts::TAU * stream.unit())
}

/// Uniform in the disc about a place.
fn disc_about(centre_m: [f64; 2], radius: f64, stream: &mut Stream) -> DVec2 {
    DVec2::from(centre_m) + disc(radius, stream)
}

/// What is wrong with the numbers of such a disc, if anything.
fn disc_fault([x, y]: [f64; 2], within_m: f64) -> Option<String> {
    outside(&[("within_m", within_m, 0.0, FAR_M), ("centre_m", x, -FAR_M, FAR_M), ("centre_m", y, -FAR_M, FAR_M)])
}

/// Plans leave out the place that most discs lie about.
fn is_origin(centre_m: &[f64; 2]) -> bool {
    *centre_m == [0.0; 2]
}

fn heading(yaw: f64) -> DVec2 {
    DVec2::new(cos(yaw), sin(yaw))
}

/// The first number that is not within its range: name, value, lowest, highest.
fn outside(numbers: &[(&str, f64, f64, f64)]) -> Option<String> {
    let wrong = numbers.iter().find(|(_, value, low, high)| !(*low..=*high).contains(value));
    wrong.map(|(name, value, low, high)| format!("{name} is {value}, which is not between {low} and {high}"))
}

/// Angles in degrees: any that a person may write.
const ANY_DEG: (f64, f64) = (-36_000.0, 36_000.0);
/// Places and distances in metres.
const FAR_M: f64 = 10_000.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_fill_the_disc_evenly() {
        let mut stream = Stream::at(1, "test", 0, "disc");
        let inner = (0..4000).filter(|_| disc(2.0, &mut stream).length() < 1.0).count();
        assert!((900..1100).contains(&inner), "{inner}");
    }

    #[test]
    fn what_is_no_number_is_outside() {
        assert_eq!(outside(&[("a", 1.0, 0.0, 1.0)]), None);
        assert!(
            outside(&[("a", 1.0, 0.0, 1.0), ("b", f64::NAN, 0.0, 1.0)]).is_some_and(|text| text.starts_with("b is"))
        );
    }
}
