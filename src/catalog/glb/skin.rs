//! Skins in their rest pose: where the joints' nodes stand.

use std::collections::BTreeMap;
use std::rc::Rc;

use glam::{DAffine3, DMat3, DVec3};

use super::file::File;
use super::nodes::Nodes;
use super::transform::affine;
use crate::catalog::error::ModelFault;

/// The joint matrices of each skin that was asked for.
#[derive(Debug, Default)]
pub(super) struct Skins(BTreeMap<u32, Rc<[DAffine3]>>);

impl Skins {
    /// World from mesh for each joint of a skin: joint node · inverse bind matrix.
    pub fn matrices(&mut self, file: &File, nodes: &Nodes, number: u32) -> Result<Rc<[DAffine3]>, ModelFault> {
        if let Some(matrices) = self.0.get(&number) {
            return Ok(matrices.clone());
        }
        let matrices: Rc<[DAffine3]> = matrices(file, nodes, number)?.into();
        self.0.insert(number, matrices.clone());
        Ok(matrices)
    }
}

fn matrices(file: &File, nodes: &Nodes, number: u32) -> Result<Vec<DAffine3>, ModelFault> {
    let broken = |problem: String| ModelFault::broken(format!("skins[{number}]"), problem);
    let skin = file.root.skins.get(number as usize).ok_or_else(|| broken("it does not exist".into()))?;
    let count = skin.joints.len();
    let bind = match skin.inverse_bind_matrices {
        Some(accessor) => file.first_floats::<16>(accessor, count as u64)?.into_iter().map(affine).collect(),
        None => vec![DAffine3::IDENTITY; count],
    };
    if bind.len() < count || count == 0 {
        return Err(broken(format!("{} matrices for {count} joints", bind.len())));
    }
    let joint = |(&joint, bind): (&u32, DAffine3)| match nodes.world.get(joint as usize) {
        Some(world) => Ok(*world * bind),
        None => Err(broken(format!("its joint {joint} is no node"))),
    };
    skin.joints.iter().zip(bind).map(joint).collect()
}

/// What the joints do to the vertices of one primitive.
pub(super) struct Joints {
    matrices: Rc<[DAffine3]>,
    /// One for each four joints that a vertex may hang on.
    sets: Vec<JointSet>,
}

/// Four joints of each vertex, and how much each counts.
pub(super) struct JointSet {
    pub numbers: Vec<[u32; 4]>,
    pub weights: Vec<[f32; 4]>,
}

impl Joints {
    /// Sets with as many entries as there are vertices, their joints in range.
    pub fn new(matrices: Rc<[DAffine3]>, sets: Vec<JointSet>, vertices: usize) -> Result<Self, String> {
        for JointSet { numbers, weights } in &sets {
            if numbers.len() < vertices || weights.len() < vertices {
                return Err("fewer joints or weights than vertices".into());
            }
            if let Some(joint) = numbers.iter().flatten().find(|&&joint| joint as usize >= matrices.len()) {
                return Err(format!("joint {joint} of {}", matrices.len()));
            }
        }
        Ok(Self { matrices, sets })
    }

    /// `Σ w·(joint · inverse bind)` of a vertex, weights scaled to the sum 1.
    ///
    /// Source: glTF 2.0 specification, section 3.7.3.3 (skinned mesh attributes).
    pub fn blend(&self, vertex: usize) -> DAffine3 {
        let pairs = || {
            self.sets.iter().flat_map(|JointSet { numbers, weights }| {
                numbers[vertex].iter().map(|&joint| joint as usize).zip(weights[vertex].map(f64::from))
            })
        };
        let total: f64 = pairs().map(|(_, weight)| weight).sum();
        if total.is_nan() || total <= 0.0 {
            return pairs().next().map_or(DAffine3::IDENTITY, |(joint, _)| self.matrices[joint]);
        }
        let (mut linear, mut translation) = (DMat3::ZERO, DVec3::ZERO);
        for (joint, weight) in pairs().filter(|(_, weight)| *weight != 0.0) {
            linear += self.matrices[joint].matrix3 * (weight / total);
            translation += self.matrices[joint].translation * (weight / total);
        }
        DAffine3 { matrix3: linear, translation }
    }
}
