//! The node tree: where each node stands in the file's world, and which thing it belongs to.
//!
//! Walks without recursion, so that neither depth nor cycles can overflow the stack.

use glam::DAffine3;
use serde::Deserialize;

use super::schema::{Node, Root};
use super::transform::local_transform;
use crate::catalog::error::ModelFault;

/// What is known of every node of a file.
pub(super) struct Nodes {
    /// File's world from the node, by node number.
    pub world: Vec<DAffine3>,
    /// Node that a mesh on this node belongs to, by node number.
    pub owner: Vec<usize>,
    /// Nodes of the default scene (the first without one, all without scenes), parents before children, without those
    /// that KHR_node_visibility hides.
    pub shown: Vec<usize>,
}

impl Nodes {
    pub fn of(root: &Root) -> Result<Self, ModelFault> {
        let parents = parents(root)?;
        let roots: Vec<usize> = (0..root.nodes.len()).filter(|&node| parents[node].is_none()).collect();
        let order = walk(root, &roots, |_| true);
        if order.len() < root.nodes.len() {
            return Err(ModelFault::broken(place(one_of_a_cycle(&parents, &order)), "it is its own ancestor"));
        }
        let mut world = vec![DAffine3::IDENTITY; root.nodes.len()];
        let mut owner: Vec<usize> = (0..root.nodes.len()).collect();
        let ranks: Vec<u8> = root.nodes.iter().map(rank).collect();
        for &node in &order {
            let parent = parents[node];
            let local = local_transform(&root.nodes[node]);
            world[node] = parent.map_or(local, |parent| world[parent] * local);
            if !world[node].is_finite() {
                return Err(ModelFault::broken(place(node), "its transform is not finite"));
            }
            owner[node] = match parent {
                Some(parent) if ranks[owner[parent]] > ranks[node] => owner[parent],
                _ => node,
            };
        }
        let shown = walk(root, &shown_roots(root)?.unwrap_or(roots), |node| !is_hidden(node));
        Ok(Self { world, owner, shown })
    }
}

/// `extras.categoryID` of a node.
pub(super) fn category(node: &Node) -> Option<String> {
    #[derive(Deserialize)]
    struct Extras {
        #[serde(rename = "categoryID")]
        category: Option<serde_json::Value>,
    }
    let extras: Extras = serde_json::from_str(node.extras?.get()).ok()?;
    match extras.category? {
        serde_json::Value::String(text) if !text.is_empty() => Some(text),
        serde_json::Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

/// A category names a thing better than a name, a name better than nothing.
fn rank(node: &Node) -> u8 {
    if category(node).is_some() { 2 } else { u8::from(node.name.as_ref().is_some_and(|name| !name.0.is_empty())) }
}

fn is_hidden(node: &Node) -> bool {
    let visibility = node.extensions.as_ref().and_then(|extensions| extensions.visibility.as_ref());
    visibility.is_some_and(|visibility| visibility.visible == Some(false))
}

fn place(node: usize) -> String {
    format!("nodes[{node}]")
}

fn parents(root: &Root) -> Result<Vec<Option<usize>>, ModelFault> {
    let mut parents = vec![None; root.nodes.len()];
    for (number, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().map(|&child| child as usize) {
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

/// A node on a cycle, where some nodes cannot be reached from above.
fn one_of_a_cycle(parents: &[Option<usize>], reached: &[usize]) -> usize {
    let mut open = vec![true; parents.len()];
    reached.iter().for_each(|&node| open[node] = false);
    let mut node = open.iter().position(|&open| open).unwrap_or(0);
    // Climbing from an unreached node ends in a cycle; the first node that comes twice is on it.
    while std::mem::take(&mut open[node]) {
        node = parents[node].unwrap_or(node);
    }
    node
}

fn shown_roots(root: &Root) -> Result<Option<Vec<usize>>, ModelFault> {
    if root.scene.is_none() && root.scenes.is_empty() {
        return Ok(None);
    }
    let number = root.scene.unwrap_or(0) as usize;
    let scene = root.scenes.get(number).ok_or_else(|| ModelFault::broken("scene", format!("no scenes[{number}]")))?;
    let roots: Vec<usize> = scene.nodes.iter().map(|&node| node as usize).collect();
    match roots.iter().find(|&&node| node >= root.nodes.len()) {
        Some(node) => Err(ModelFault::broken(format!("scenes[{number}]"), format!("its node {node} does not exist"))),
        None => Ok(Some(roots)),
    }
}

/// Everything below `roots` once, parents before children, in file order; not below nodes that `enters` refuses.
fn walk(root: &Root, roots: &[usize], enters: impl Fn(&Node) -> bool) -> Vec<usize> {
    let mut seen = vec![false; root.nodes.len()];
    let mut waiting: Vec<usize> = roots.iter().rev().copied().collect();
    let mut order = Vec::new();
    while let Some(node) = waiting.pop() {
        if !std::mem::replace(&mut seen[node], true) && enters(&root.nodes[node]) {
            order.push(node);
            waiting.extend(root.nodes[node].children.iter().rev().map(|&child| child as usize));
        }
    }
    order
}
