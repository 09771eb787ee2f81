//! A structure under construction: its parts, each a thing of one material.

use std::sync::Arc;

use glam::DVec3;

use super::solid::Solid;
use super::{Labels, Role, Surface, Thing};
use crate::catalog::Part;
use crate::scene::mesh::Mesh;

/// What a structure is built on.
pub(super) struct Site<'a> {
    /// Height of the seabed, metres; 0 without one.
    pub ground: &'a dyn Fn(f64, f64) -> f64,
    /// Down to where foundations reach, metres: below all ground.
    pub foot: f64,
    /// Whether there is a seabed.
    pub bottom: Bottom,
    pub labels: Labels,
}

/// Whether a recipe has a seabed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bottom {
    Seabed,
    Nothing,
}

/// Parts of a structure.
pub(super) struct Structure<'a> {
    pub site: &'a Site<'a>,
    pub things: Vec<Thing>,
}

impl<'a> Structure<'a> {
    pub fn new(site: &'a Site<'a>) -> Self {
        Self { site, things: Vec::new() }
    }

    /// Adds a part: what the recipe may have labelled with its name.
    pub fn part(&mut self, name: &str, material: &str, solids: &[Solid]) {
        if solids.is_empty() {
            return;
        }
        let label = match self.site.labels {
            Labels::ByNode => Some(name.to_owned()),
            Labels::None => None,
        };
        let materials = vec![Surface::Material(material.into())];
        let node = format!("{name}_{}", self.things.len());
        self.things.push(Thing::made(mesh(material, solids), node, label, materials, Role::Structure));
    }

    /// Adds ground to stand on.
    pub fn floor(&mut self, material: &str, solid: Solid) {
        let materials = vec![Surface::Material(material.into())];
        let mesh = mesh(material, &[solid]);
        self.things.push(Thing::made(mesh, "floor".into(), None, materials, Role::Ground));
    }
}

fn mesh(material: &str, solids: &[Solid]) -> Arc<Mesh> {
    let mut part = Part { material: material.into(), ..Part::default() };
    for solid in solids {
        let first = part.positions.len() as u32;
        part.positions.extend(solid.positions.iter().map(|p: &DVec3| p.as_vec3()));
        part.triangles.extend(solid.triangles.iter().map(|corners| corners.map(|v| first + v)));
    }
    Arc::new(Mesh::from_parts(&[part]))
}
