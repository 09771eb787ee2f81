//! A structure under construction: its parts, each a thing of one material, and what it takes of the ground.

use std::sync::Arc;

use glam::DVec3;

use super::solid::Solid;
use super::{Labels, Role, Surface, Thing};
use crate::catalog::Part;
use crate::scene::mesh::Mesh;
use crate::scene::placement::Footprint;

/// Objects at rest keep clear of what is lower than this above the ground, metres.
const HEADROOM_M: f64 = 1.5;

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
    pub footprints: Vec<Footprint>,
}

impl<'a> Structure<'a> {
    pub fn new(site: &'a Site<'a>) -> Self {
        Self { site, things: Vec::new(), footprints: Vec::new() }
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
        for solid in solids {
            let lowest = solid.positions.iter().map(|p| p.z - (self.site.ground)(p.x, p.y)).fold(f64::MAX, f64::min);
            if lowest < HEADROOM_M {
                self.footprints.push(Footprint::of(&solid.positions, solid.axis));
            }
        }
        let materials = vec![Surface::Material(material.into())];
        let node = format!("{name}_{}", self.things.len());
        self.things.push(Thing { mesh: mesh(material, solids), node, label, materials, role: Role::Structure });
    }

    /// Adds ground to stand on.
    pub fn floor(&mut self, material: &str, solid: Solid) {
        let materials = vec![Surface::Material(material.into())];
        let mesh = mesh(material, &[solid]);
        self.things.push(Thing { mesh, node: "floor".into(), label: None, materials, role: Role::Ground });
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
