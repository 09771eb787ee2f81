//! Every body of a scene finds its place, one after the other; what finds none says why.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DAffine3;

use super::in_view::View;
use super::shape::Shape;
use super::taken::Whose;
use super::{Around, Asking, BodySpec, Candidate, Miss, PoseSpec, Taken};
use crate::math::rng::Stream;
use crate::scene::environment::Role;
use crate::scene::ground::Ground;
use crate::scene::mesh::Mesh;

/// Tries that a fall counts for: it takes that much longer.
const FALL: u32 = 5;

/// A placed body.
#[derive(Clone, Debug)]
pub(in crate::scene) struct Standing {
    pub world_from_mesh: DAffine3,
    /// What moors it or joins it to another, in world coordinates.
    pub rope: Option<Arc<Mesh>>,
    /// Of a body with a given pose: numbers of the objects, and of the structures, that it passes through.
    pub overlaps: Vec<Whose>,
    tied: Option<super::Rope>,
}

/// A body without a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::scene) struct Failure {
    /// Why, as words.
    pub reason: String,
}

/// What bodies are placed with.
pub(in crate::scene) struct Search<'a> {
    pub bodies: &'a [BodySpec],
    /// Of each body.
    pub shapes: &'a [Arc<Shape>],
    pub ground: &'a Ground,
    /// In which order, see [`super::order`].
    pub order: &'a [usize],
    /// A random stream by its purpose.
    pub stream: &'a dyn Fn(&str) -> Stream,
}

/// What is known of places when a scene is laid out again.
pub(in crate::scene) struct Before<'a> {
    /// Those that stay.
    pub kept: &'a [Option<Standing>],
    /// How often each body has been laid out before.
    pub again: &'a [u32],
    /// Every frame's view, where some body asks for it.
    pub views: &'a [View],
}

impl Search<'_> {
    /// A place for every body, in the order of the bodies.
    pub fn lay(&self, before: &Before) -> Vec<Result<Standing, Failure>> {
        let mut taken: Vec<Taken> = self.ground.environment.iter().flat_map(Taken::of_environment).collect();
        let mut places: Vec<Option<Result<Standing, Failure>>> = vec![None; self.bodies.len()];
        for &body in self.order {
            if let Some(standing) = &before.kept[body] {
                self.take(body, standing, &mut taken);
                places[body] = Some(Ok(standing.clone()));
            }
        }
        for &body in self.order {
            if places[body].is_none() {
                let place = self.place(body, &taken, before);
                if let Ok(standing) = &place {
                    self.take(body, standing, &mut taken);
                }
                places[body] = Some(place);
            }
        }
        let none = || Err(Failure { reason: "it is in no order".to_owned() });
        places.into_iter().map(|place| place.unwrap_or_else(none)).collect()
    }

    fn take(&self, body: usize, standing: &Standing, taken: &mut Vec<Taken>) {
        let label = &self.bodies[body].label;
        taken.extend(Taken::object(body, label, &self.shapes[body], standing.world_from_mesh));
        taken.extend(standing.tied.as_ref().and_then(Taken::rope));
    }

    fn place(&self, body: usize, taken: &[Taken], before: &Before) -> Result<Standing, Failure> {
        let spec = &self.bodies[body];
        let mut mates = BTreeMap::new();
        let (mut own, mut others) = (Vec::new(), Vec::new());
        let refers_to = spec.pose.refers_to().map(|(_, label)| label);
        for (number, other) in taken.iter().enumerate() {
            let is_mate = match other.whose {
                Whose::Object(other) => self.bodies[other].item == spec.item,
                Whose::Part(_) | Whose::Rope => false,
            };
            if let (true, Whose::Object(mate)) = (is_mate, other.whose) {
                mates.insert(self.bodies[mate].instance, number);
            }
            if refers_to.is_some() && refers_to == other.label.as_deref() {
                if is_mate { own.push(number) } else { others.push(number) }
            }
        }
        let asking = Asking {
            shape: &self.shapes[body],
            around: Around { ground: self.ground, taken },
            instance: spec.instance,
            clear_m: spec.clear_m,
            shared: &|| (self.stream)(&format!("objects[{}].place", spec.item)),
            // Only where no other item has the label: those of its own.
            others: if others.is_empty() { &own } else { &others },
            mates: &mates,
        };
        let views = spec.in_view.as_ref().map_or_else(Vec::new, |in_view| in_view.of(before.views));
        let mut misses: BTreeMap<Miss, u32> = BTreeMap::new();
        for round in 0..spec.on_failure.rounds() {
            let again = before.again[body];
            let mut stream = match (again, round) {
                (0, 0) => (self.stream)(&spec.purpose("place")),
                _ => (self.stream)(&spec.purpose(&format!("place/{again}/{round}"))),
            };
            if let Some(standing) = tries(spec, &asking, &views, &mut stream, &mut misses) {
                return Ok(standing);
            }
        }
        Err(failure(spec, &misses))
    }
}

/// The first proposal that holds.
fn tries(
    spec: &BodySpec,
    asking: &Asking,
    views: &[&View],
    stream: &mut Stream,
    misses: &mut BTreeMap<Miss, u32>,
) -> Option<Standing> {
    let mut left = spec.tries;
    while left > 0 {
        let outcome = spec.pose.propose(asking, stream).and_then(|candidate| accept(spec, asking, views, candidate));
        let miss = match outcome {
            Ok(standing) => return Some(standing),
            Err(miss) => miss,
        };
        *misses.entry(miss).or_default() += 1;
        let cost = if matches!(miss, Miss::Restless | Miss::NoHold) { FALL } else { 1 };
        // What is not there will not come.
        left = if miss == Miss::Absent { 0 } else { left.saturating_sub(cost) };
    }
    None
}

/// Takes a proposal that keeps clear of everything and is seen.
fn accept(spec: &BodySpec, asking: &Asking, views: &[&View], candidate: Candidate) -> Result<Standing, Miss> {
    let Candidate { world_from_mesh, touching, rope } = candidate;
    let (around, tree) = (&asking.around, &*asking.shape.tree);
    let bounds = tree.bounds(&world_from_mesh);
    let exact = matches!(spec.pose, PoseSpec::At(_));
    if !exact && !around.is_free(tree, &world_from_mesh, spec.clear_m, &touching) {
        return Err(Miss::Taken);
    }
    if let Some(rope) = &rope
        && !around.is_free(&rope.tree, &super::Rope::world_from_mesh(), 0.0, &[])
        && !only_tied(around, rope)
    {
        return Err(Miss::Taken);
    }
    let centre = bounds.map_or(world_from_mesh.translation, |bounds| bounds.middle());
    if !views.iter().all(|view| view.holds_over(around.ground, centre)) {
        return Err(Miss::Unseen);
    }
    let overlaps = if exact { overlaps(around, asking, &world_from_mesh) } else { Vec::new() };
    Ok(Standing { world_from_mesh, rope: rope.as_ref().map(|rope| rope.mesh.clone()), overlaps, tied: rope })
}

/// Whether a rope meets nothing but what it is tied to.
fn only_tied(around: &Around, rope: &super::Rope) -> bool {
    let place = super::Rope::world_from_mesh();
    let meets = |number: &usize| around.touches(&rope.tree, &place, 0.0, &[*number]);
    let ground = |number: &usize| around.taken[*number].whose == Whose::Part(Role::Ground);
    let tied = |number: &usize| {
        let other = &around.taken[*number];
        // Ropes of the same string meet in the body between them.
        rope.tied_to.contains(number) || other.whose == Whose::Rope
    };
    (0..around.taken.len()).filter(|number| !tied(number) && !ground(number)).all(|number| !meets(&number))
}

/// Objects and structures that a body passes through.
fn overlaps(around: &Around, asking: &Asking, place: &DAffine3) -> Vec<Whose> {
    let meets = |number: &usize| around.touches(&asking.shape.tree, place, 0.0, &[*number]);
    let solid = |number: &usize| around.taken[*number].whose != Whose::Part(Role::Ground);
    (0..around.taken.len()).filter(solid).filter(meets).map(|number| around.taken[number].whose).collect()
}

fn failure(spec: &BodySpec, misses: &BTreeMap<Miss, u32>) -> Failure {
    let most = misses.iter().max_by_key(|(_, count)| **count).map(|(miss, _)| *miss);
    let rounds = match spec.on_failure.rounds() {
        1 => String::new(),
        rounds => format!(" in each of {rounds} rounds"),
    };
    let reason = match most {
        Some(Miss::Absent) => {
            let label = spec.pose.refers_to().map_or("environment", |(_, label)| label);
            format!("there is no `{label}` in this scene to put it by")
        }
        Some(miss) => format!("no free place in {} tries{rounds}; most often {}", spec.tries, miss.words()),
        None => "no free place".to_owned(),
    };
    Failure { reason }
}
