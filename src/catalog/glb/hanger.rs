//! What meshes hang on: a node with its instances, or nothing in a file without nodes.

use glam::DAffine3;

use super::file::File;
use super::nodes::{Nodes, category};
use super::schema::{Instancing, Text};
use super::transform::placed;
use crate::catalog::error::ModelFault;

/// Longest name that is kept, characters.
const MAX_NAME: usize = 200;

/// Most instances on one node.
const MAX_INSTANCES: u64 = 1_000_000;

/// A place for a mesh.
#[derive(Debug, Default)]
pub(super) struct Hanger<'a> {
    /// Name of the thing that it belongs to.
    pub name: String,
    /// Number of that thing.
    pub number: u32,
    /// Category of that thing.
    pub category: String,
    /// How far each morph target is on, if the node says so.
    pub weights: Option<&'a [f32]>,
    pub skin: Option<u32>,
    /// World from mesh, one for each copy.
    pub worlds: Vec<DAffine3>,
}

impl<'a> Hanger<'a> {
    /// The place that a node is.
    pub fn of(file: &'a File, nodes: &Nodes, number: usize) -> Result<Self, ModelFault> {
        let node = &file.root.nodes[number];
        let owner = &file.root.nodes[nodes.owner[number]];
        let world = nodes.world[number];
        let instancing = node.extensions.as_ref().and_then(|extensions| extensions.instancing.as_ref());
        Ok(Self {
            name: plain(owner.name.as_ref()),
            number: nodes.owner[number] as u32,
            category: cut(&category(owner).unwrap_or_default()),
            weights: node.weights.as_deref(),
            skin: node.skin,
            worlds: match instancing {
                None => vec![world],
                Some(instancing) => {
                    instances(file, instancing, number)?.into_iter().map(|local| world * local).collect()
                }
            },
        })
    }

    /// A mesh that hangs on nothing.
    pub fn nowhere(number: u32) -> Self {
        Self { number, worlds: vec![DAffine3::IDENTITY], ..Self::default() }
    }
}

/// A name without control characters, which no label can have, and of a bearable length.
pub(super) fn plain(name: Option<&Text>) -> String {
    name.map_or_else(String::new, |name| cut(&name.0))
}

fn cut(name: &str) -> String {
    name.chars().filter(|letter| !letter.is_control()).take(MAX_NAME).collect()
}

/// Node from each of its instances.
///
/// Source: EXT_mesh_gpu_instancing.
fn instances(file: &File, instancing: &Instancing, node: usize) -> Result<Vec<DAffine3>, ModelFault> {
    let at = &instancing.attributes;
    let mut counts = [at.translation, at.rotation, at.scale].into_iter().flatten().map(|accessor| file.count(accessor));
    let count = counts.next().unwrap_or(Ok(0))?;
    for other in counts {
        if other? != count {
            return Err(ModelFault::broken(format!("nodes[{node}]"), "its instances have unequal numbers of places"));
        }
    }
    if count > MAX_INSTANCES {
        let what = format!("instances on nodes[{node}]");
        return Err(ModelFault::TooLarge { what, count, limit: MAX_INSTANCES });
    }
    let translations = at.translation.map(|accessor| file.floats::<3>(accessor)).transpose()?;
    let rotations = at.rotation.map(|accessor| file.floats::<4>(accessor)).transpose()?;
    let scales = at.scale.map(|accessor| file.floats::<3>(accessor)).transpose()?;
    let instance = |k: usize| {
        placed(
            translations.as_ref().map_or([0.0; 3], |all| all[k]),
            rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |all| all[k]),
            scales.as_ref().map_or([1.0; 3], |all| all[k]),
        )
    };
    Ok((0..count as usize).map(instance).collect())
}
