//! What stands somewhere already, and whether a body keeps clear of it.

use std::sync::Arc;

use glam::DAffine3;

use super::Around;
use super::rope::Rope;
use super::shape::Shape;
use super::tree::{Box3, Tree};
use crate::scene::environment::{Environment, Role};

/// Something that takes room.
#[derive(Clone, Debug)]
pub(in crate::scene) struct Taken {
    pub(super) whose: Whose,
    /// Category, where it has one.
    pub(super) label: Option<String>,
    pub(super) world_from_mesh: DAffine3,
    pub(super) bounds: Box3,
    pub(super) tree: Surface,
}

/// Whose room it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene) enum Whose {
    /// An object, by its number in the scene's specification.
    Object(usize),
    /// A part of the environment.
    Part(Role),
    /// A rope's.
    Rope,
}

/// A surface in a tree; that of a part of an environment is made when it is first needed.
#[derive(Clone, Debug)]
pub(super) enum Surface {
    Tree(Arc<Tree>),
    Part(Arc<Environment>, usize),
}

impl std::ops::Deref for Surface {
    type Target = Tree;

    fn deref(&self) -> &Tree {
        match self {
            Self::Tree(tree) => tree,
            Self::Part(world, thing) => world.things[*thing].tree(),
        }
    }
}

impl Taken {
    /// Of every part of an environment.
    pub(super) fn of_environment(world: &Arc<Environment>) -> Vec<Self> {
        let part = |(number, thing): (usize, &crate::scene::environment::Thing)| Self {
            whose: Whose::Part(thing.role),
            label: thing.label.clone(),
            world_from_mesh: DAffine3::IDENTITY,
            bounds: Box3 { low: thing.mesh.low.as_dvec3(), high: thing.mesh.high.as_dvec3() },
            tree: Surface::Part(world.clone(), number),
        };
        world.things.iter().enumerate().map(part).collect()
    }

    pub(super) fn object(number: usize, label: &str, shape: &Shape, world_from_mesh: DAffine3) -> Option<Self> {
        let bounds = shape.tree.bounds(&world_from_mesh)?;
        let tree = Surface::Tree(shape.tree.clone());
        Some(Self { whose: Whose::Object(number), label: Some(label.to_owned()), world_from_mesh, bounds, tree })
    }

    pub(super) fn rope(rope: &Rope) -> Option<Self> {
        let world_from_mesh = Rope::world_from_mesh();
        let bounds = rope.tree.bounds(&world_from_mesh)?;
        let tree = Surface::Tree(rope.tree.clone());
        Some(Self { whose: Whose::Rope, label: None, world_from_mesh, bounds, tree })
    }

    /// Whether a surface meets this one or comes closer to it than `distance`, or one lies in the other.
    pub(super) fn is_closer(&self, tree: &Tree, world_from_tree: &DAffine3, bounds: &Box3, distance: f64) -> bool {
        if !bounds.grown(distance).meets(&self.bounds) {
            return false;
        }
        let (from_world, own_from_world) = (world_from_tree.inverse(), self.world_from_mesh.inverse());
        if tree.is_closer(&self.tree, &(from_world * self.world_from_mesh), distance) {
            return true;
        }
        let corner = |tree: &Tree, place: &DAffine3| tree.triangles().first().map(|t| place.transform_point3(t[0]));
        let holds = |tree: &Tree, from_world: &DAffine3, point: Option<glam::DVec3>| {
            point.is_some_and(|point| tree.has_inside(from_world.transform_point3(point)))
        };
        self.bounds.encloses(bounds) && holds(&self.tree, &own_from_world, corner(tree, world_from_tree))
            || bounds.encloses(&self.bounds) && holds(tree, &from_world, corner(&self.tree, &self.world_from_mesh))
    }
}

impl Around<'_> {
    /// The first of what is there that a surface meets, or comes closer to than `clear`; those in `touching` it may touch.
    pub(super) fn in_the_way(
        &self,
        tree: &Tree,
        world_from_tree: &DAffine3,
        clear: f64,
        touching: &[usize],
    ) -> Option<usize> {
        let bounds = tree.bounds(world_from_tree)?;
        self.taken.iter().enumerate().find_map(|(number, other)| {
            let asked = touching.contains(&number);
            // Ground is touched by all that rests on it.
            let passed = other.whose == Whose::Part(Role::Ground) && !asked;
            let distance = if asked { 0.0 } else { clear };
            (!passed && other.is_closer(tree, world_from_tree, &bounds, distance)).then_some(number)
        })
    }

    pub(super) fn is_free(&self, tree: &Tree, world_from_tree: &DAffine3, clear: f64, touching: &[usize]) -> bool {
        self.in_the_way(tree, world_from_tree, clear, touching).is_none()
    }

    /// Whether a surface touches one of those numbered, to within `reach` metres.
    pub(super) fn touches(&self, tree: &Tree, world_from_tree: &DAffine3, reach: f64, numbers: &[usize]) -> bool {
        let Some(bounds) = tree.bounds(world_from_tree) else { return false };
        numbers.iter().any(|&number| self.taken[number].is_closer(tree, world_from_tree, &bounds, reach))
    }
}
