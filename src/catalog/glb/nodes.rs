//! The node tree: where each node stands in the file's world, and which thing it belongs to.
//!
//! Walks without recursion, so that neither depth nor cycles can overflow the stack.

use std::collections::BTreeSet;

use glam::{DAffine3, DMat3, DVec3};
use gltf::json::Root;
use gltf::json::scene::Node;

use crate::catalog::error::ModelFault;

/// What is known of every node of a file.
pub(super) struct Nodes {
    /// File's world from the node, by node number.
    pub world: Vec<DAffine3>,
    /// Node that a mesh on this node belongs to, by node number.
    pub owner: Vec<usize>,
    /// Nodes of the default scene (the first without one, all without scenes), parents before children.
    pub shown: Vec<usize>,
}

impl Nodes {
    pub fn of(root: &Root) -> Result<Self, ModelFault> {
        let parents = parents(root)?;
        let roots: Vec<usize> = (0..root.nodes.len()).filter(|&node| parents[node].is_none()).collect();
        let order = walk(root, &roots);
        if order.len() < root.nodes.len() {
            return Err(ModelFault::broken("nodes", "some are their own ancestors"));
        }
        let mut world = vec![DAffine3::IDENTITY; root.nodes.len()];
        let mut owner: Vec<usize> = (0..root.nodes.len()).collect();
        for &node in &order {
            let parent = parents[node];
            let local = local_transform(&root.nodes[node]);
            world[node] = parent.map_or(local, |parent| world[parent] * local);
            if !world[node].is_finite() {
                return Err(ModelFault::broken(place(node), "its transform is not finite"));
            }
            owner[node] = match parent {
                Some(parent) if rank(&root.nodes[owner[parent]]) > rank(&root.nodes[node]) => owner[parent],
                _ => node,
            };
        }
        let shown = match shown_roots(root)? {
            Some(roots) => walk(root, &roots),
            None => order,
        };
        Ok(Self { world, owner, shown })
    }
}

/// `extras.categoryID` of a node.
pub(super) fn category(node: &Node) -> Option<String> {
    let extras: serde_json::Value = serde_json::from_str(node.extras.as_ref()?.get()).ok()?;
    match extras.get("categoryID")? {
        serde_json::Value::String(text) if !text.is_empty() => Some(text.clone()),
        serde_json::Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

/// A category names a thing better than a name, a name better than nothing.
fn rank(node: &Node) -> u8 {
    if category(node).is_some() { 2 } else { u8::from(node.name.as_ref().is_some_and(|name| !name.is_empty())) }
}

fn place(node: usize) -> String {
    format!("nodes[{node}]")
}

fn parents(root: &Root) -> Result<Vec<Option<usize>>, ModelFault> {
    let mut parents = vec![None; root.nodes.len()];
    for (number, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().flatten().map(|child| child.value()) {
            match parents.get_mut(child) {
                None => return Err(ModelFault::broken(place(number), format!("its child {child} does not exist"))),
                Some(Some(other)) if *other != number => {
                    return Err(ModelFault::broken(place(child), format!("both {other} and {number} are its parent")));
                }
                Some(parent) => *parent = Some(number),
            }
        }
    }
    Ok(parents)
}

fn shown_roots(root: &Root) -> Result<Option<Vec<usize>>, ModelFault> {
    let number = root.scene.map(|scene| scene.value());
    if number.is_none() && root.scenes.is_empty() {
        return Ok(None);
    }
    let number = number.unwrap_or(0);
    let scene = root.scenes.get(number).ok_or_else(|| ModelFault::broken("scene", format!("no scenes[{number}]")))?;
    let roots: Vec<usize> = scene.nodes.iter().map(|node| node.value()).collect();
    match roots.iter().find(|&&node| node >= root.nodes.len()) {
        Some(node) => Err(ModelFault::broken(format!("scenes[{number}]"), format!("its node {node} does not exist"))),
        None => Ok(Some(roots)),
    }
}

/// Everything below `roots` once, parents before children, in file order.
fn walk(root: &Root, roots: &[usize]) -> Vec<usize> {
    let mut seen = BTreeSet::new();
    let mut waiting: Vec<usize> = roots.iter().rev().copied().collect();
    let mut order = Vec::new();
    while let Some(node) = waiting.pop() {
        if seen.insert(node) {
            order.push(node);
            let children = root.nodes[node].children.iter().flatten().map(|child| child.value());
            let from = waiting.len();
            waiting.extend(children);
            waiting[from..].reverse();
        }
    }
    order
}

fn local_transform(node: &Node) -> DAffine3 {
    if let Some(m) = node.matrix {
        let m = m.map(f64::from);
        let column = |k: usize| DVec3::new(m[4 * k], m[4 * k + 1], m[4 * k + 2]);
        let linear = DMat3::from_cols(column(0), column(1), column(2));
        return DAffine3 { matrix3: linear, translation: column(3) };
    }
    let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let scale = vector(node.scale.unwrap_or([1.0; 3]));
    let rotation = rotation_matrix(node.rotation.unwrap_or_default().0.map(f64::from));
    let linear = DMat3::from_cols(rotation.x_axis * scale.x, rotation.y_axis * scale.y, rotation.z_axis * scale.z);
    DAffine3 { matrix3: linear, translation: vector(node.translation.unwrap_or([0.0; 3])) }
}

/// Rotation by a quaternion (x, y, z, w) of any length but 0, which turns nothing.
fn rotation_matrix([x, y, z, w]: [f64; 4]) -> DMat3 {
    let length_squared = x * x + y * y + z * z + w * w;
    if length_squared == 0.0 {
        return DMat3::IDENTITY;
    }
    let s = 2.0 / length_squared;
    DMat3::from_cols(
        DVec3::new(1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)),
        DVec3::new(s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)),
        DVec3::new(s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)),
    )
}
