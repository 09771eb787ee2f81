//! Environments: a whole GLB as a fixed world, at the file's own scale.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use glam::DAffine3;
use serde::{Deserialize, Serialize};

use super::bvh::Bvh;
use super::mesh::Mesh;
use crate::catalog::materials::{self, UNKNOWN, material_in_name};
use crate::catalog::{CatalogError, Part, load_model};

/// Names of nodes that are no bodies.
const BACKGROUND: [&str; 5] = ["seabed", "ground", "terrain", "water", "background"];
/// Those of them that are made of the sediment.
const BOTTOM: [&str; 3] = ["seabed", "ground", "terrain"];

/// A fixed world: metres as in the file, its y-up frame turned to ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EnvironmentSpec {
    /// The file, from the recipe's folder.
    pub glb: String,
    /// What becomes a labelled body.
    pub labels: Labels,
    /// Sediment of the nodes called seabed, ground or terrain.
    pub sediment: String,
}

/// Which parts of an environment are labelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Labels {
    /// Nothing: all of it is background.
    None,
    /// Every node with a mesh but those called seabed, ground, terrain, water or background. The label is the node's
    /// `extras.categoryID`, else its name without trailing digits.
    ByNode,
}

/// A loaded environment.
pub struct Environment {
    /// Background first, else in file order.
    pub things: Vec<Thing>,
    bvh: OnceLock<Bvh>,
}

/// What hangs on one node of an environment.
#[derive(Debug)]
pub struct Thing {
    /// The surface, in world coordinates.
    pub mesh: Arc<Mesh>,
    /// Name of the node.
    pub node: String,
    /// `None` for background.
    pub label: Option<String>,
    /// What each material slot of the mesh is made of.
    pub materials: Vec<Surface>,
}

/// What a surface of an environment is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// A name in the table of sediments.
    Sediment(String),
    /// A name in the table of materials.
    Material(String),
}

impl Environment {
    /// Loads a file: a thing for each node that parts belong to.
    ///
    /// # Errors
    /// If the model is missing or broken or the sediment unknown.
    pub fn load(spec: &EnvironmentSpec, path: &Path) -> Result<Self, CatalogError> {
        materials::sediment(&spec.sediment)?;
        let model = load_model(path)?;
        let same_node = |a: &Part, b: &Part| a.node_number == b.node_number;
        let mut parts = model.parts;
        // Parts of one node may be far apart in the file; the sort is stable, so file order stays within a node.
        parts.sort_by_key(|part| part.node_number);
        let mut things: Vec<Thing> = parts.chunk_by(same_node).map(|parts| Thing::new(spec, parts)).collect();
        things.sort_by_key(|thing| thing.label.is_some());
        Ok(Self { things, bvh: OnceLock::new() })
    }

    /// All surfaces, for rays; built on first use.
    pub fn bvh(&self) -> &Bvh {
        self.bvh.get_or_init(|| Bvh::of(self.things.iter().map(|thing| (&*thing.mesh, DAffine3::IDENTITY))))
    }
}

impl std::fmt::Debug for Environment {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Environment").field("things", &self.things.len()).finish_non_exhaustive()
    }
}

impl Thing {
    fn new(spec: &EnvironmentSpec, parts: &[Part]) -> Self {
        let mesh = Mesh::from_parts(parts);
        let (node, category) = parts.first().map_or(("", ""), |part| (&part.node, &part.category));
        let name = if category.is_empty() { without_number(node) } else { category };
        let is_one_of = |names: &[&str]| {
            [name, without_number(node)].iter().any(|word| names.contains(&word.to_lowercase().as_str()))
        };
        let label = match spec.labels {
            Labels::ByNode if !is_one_of(&BACKGROUND) && !name.is_empty() => Some(name.to_string()),
            Labels::ByNode | Labels::None => None,
        };
        let surface = |material: &String| match material_in_name(material).or_else(|| material_in_name(name)) {
            _ if is_one_of(&BOTTOM) => Surface::Sediment(spec.sediment.clone()),
            Some(name) => Surface::Material(name.into()),
            None => Surface::Material(UNKNOWN.into()),
        };
        let materials = mesh.materials.iter().map(surface).collect();
        Self { mesh: Arc::new(mesh), node: node.to_string(), label, materials }
    }
}

/// `tire_02` and `tire.002` are tires.
fn without_number(name: &str) -> &str {
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let cut = bare.trim_end_matches(['_', '.', '-', ' ']);
    if bare.len() == name.len() || cut.is_empty() { name } else { cut }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use serde_json::json;

    use super::*;
    use crate::catalog::glb::tests::{cube, glb};

    #[test]
    fn nodes_become_bodies_and_the_seabed_does_not() {
        let nodes = json!([
            {"name": "anchor_01", "mesh": 0},
            {"name": "seabed", "mesh": 0},
            {"name": "whatever", "extras": {"categoryID": "tyre"}, "children": [3, 4]},
            {"name": "rim", "mesh": 0},
            {"name": "tread", "mesh": 0, "translation": [0.0, 2.0, 0.0]}
        ]);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("scene.glb");
        fs::write(&path, glb(&cube(), nodes, |root| root["materials"][0]["name"] = json!("mat_0"))).expect("write");
        let spec = |labels| EnvironmentSpec { glb: "scene.glb".into(), labels, sediment: "silt".into() };
        let world = Environment::load(&spec(Labels::ByNode), &path).expect("a sound file");
        let labels: Vec<_> = world.things.iter().map(|thing| thing.label.as_deref()).collect();
        assert_eq!(labels, [None, Some("anchor"), Some("tyre")]);
        assert_eq!(world.things[0].materials, [Surface::Sediment("silt".into())]);
        assert_eq!(world.things[2].materials, [Surface::Material("rubber".into())]);
        assert_eq!((world.things[2].mesh.triangle_count, world.things[2].mesh.high.z), (24, 2.5));
        assert!((world.bvh().highest(0.1, 0.2).expect("a surface") - 2.5).abs() < 1e-5);
        let world = Environment::load(&spec(Labels::None), &path).expect("a sound file");
        assert!(world.things.iter().all(|thing| thing.label.is_none()));
        let wrong = EnvironmentSpec { sediment: "slit".into(), ..spec(Labels::None) };
        assert!(Environment::load(&wrong, &path).expect_err("no such sediment").to_string().contains("`silt`"));
    }

    #[test]
    fn numbers_at_the_end_of_names_fall_off() {
        for (name, expected) in
            [("tire_02", "tire"), ("tire.002", "tire"), ("pipe12", "pipe"), ("42", "42"), ("a_b", "a_b")]
        {
            assert_eq!(without_number(name), expected);
        }
    }
}
