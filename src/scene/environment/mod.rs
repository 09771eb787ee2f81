//! Environments: a whole GLB as a fixed world, at the file's own scale, or structures that are generated on a seabed.

mod dam;
mod harbour;
mod kinds;
mod net_pen;
mod pier;
mod pipeline;
mod quay;
mod solid;
mod structure;
mod tank;

use std::path::Path;
use std::sync::{Arc, OnceLock};

use glam::DAffine3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use dam::Dam;
pub use harbour::Harbour;
pub use kinds::Kind;
pub use net_pen::NetPen;
pub use pier::Pier;
pub use pipeline::Pipeline;
pub use tank::Tank;

use super::assets::AssetCache;
use super::bvh::Bvh;
use super::mesh::Mesh;
use super::placement::Tree;
use super::seabed::HeightGrid;
use crate::catalog::materials::{self, UNKNOWN, material_in_name};
use crate::catalog::{CatalogError, Part, load_model};
use crate::math::rng::Stream;
use structure::{Bottom, Site, Structure};

/// Names of nodes that are no bodies.
const BACKGROUND: [&str; 5] = ["seabed", "ground", "terrain", "water", "background"];
/// Those of them that are made of the sediment.
const BOTTOM: [&str; 3] = ["seabed", "ground", "terrain"];

/// A fixed world: either a GLB file, metres as in the file and its y-up frame turned to ours, or a generated kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EnvironmentSpec {
    /// The file, from the recipe's folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub glb: Option<String>,
    /// What is generated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<Kind>,
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
    /// `extras.categoryID`, else its name without trailing digits. Of a generated kind every part, by its name.
    #[serde(alias = "by-part")]
    ByNode,
}

/// An environment that cannot be generated.
#[derive(Debug, Error, PartialEq)]
pub enum EnvironmentError {
    /// Neither a file nor a kind, or both.
    #[error("environment: write either `glb`, a file, or `kind`, what to generate")]
    Choice,
    /// A structure without ground.
    #[error("environment: this kind stands on a seabed; add for example `seabed: {{shape: flat}}`")]
    NoSeabed,
    /// A number beyond its range.
    #[error("environment: {name} is {value}, which is not from {low} to {high}")]
    Range {
        /// The parameter.
        name: &'static str,
        /// What it is.
        value: f64,
        /// Least that it may be.
        low: f64,
        /// Most that it may be.
        high: f64,
    },
    /// A material that no table has.
    #[error("environment: {0}")]
    Material(String),
    /// A net that is too fine.
    #[error("environment: a net of {mesh_m} m meshes has {bars:.0} bars, more than 40000; take a larger mesh_m")]
    TooManyBars {
        /// How many there are.
        bars: f64,
        /// Side of a mesh.
        mesh_m: f64,
    },
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
    /// Whether it is ground.
    pub role: Role,
    tree: OnceLock<Tree>,
}

/// What a thing of an environment is to what rests and moves in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Things rest on it, altitudes are measured from it.
    Ground,
    /// It stands in the way.
    Structure,
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

    /// Generates a kind on a seabed. The same stream gives the same bits.
    pub(super) fn generate(kind: &Kind, labels: Labels, seabed: Option<&HeightGrid>, stream: &mut Stream) -> Self {
        let bottom = if seabed.is_some() { Bottom::Seabed } else { Bottom::Nothing };
        let ground = |x: f64, y: f64| seabed.map_or(0.0, |grid| grid.height(x, y));
        let lowest = seabed.map_or(0.0, |grid| f64::from(grid.heights().iter().fold(0.0, |low: f32, &h| low.min(h))));
        let site = Site { ground: &ground, foot: (lowest - 1.0).min(-4.0), bottom, labels };
        let mut structure = Structure::new(&site);
        kind.raise(&mut structure, stream);
        let Structure { mut things, .. } = structure;
        things.sort_by_key(|thing| thing.label.is_some());
        Self { things, bvh: OnceLock::new() }
    }

    /// Its ground, for rays; built on first use.
    pub fn bvh(&self) -> &Bvh {
        let ground = || self.things.iter().filter(|thing| thing.role == Role::Ground);
        self.bvh.get_or_init(|| Bvh::of(ground().map(|thing| (&*thing.mesh, DAffine3::IDENTITY))))
    }
}

impl EnvironmentSpec {
    /// What it is made from.
    ///
    /// # Errors
    /// If it says neither or both, or a kind cannot be generated.
    pub fn source(&self) -> Result<Source<'_>, EnvironmentError> {
        match (&self.glb, &self.kind) {
            (Some(glb), None) => Ok(Source::Glb(glb)),
            (None, Some(kind)) => kind.check().map(|()| Source::Kind(kind)),
            _ => Err(EnvironmentError::Choice),
        }
    }

    /// Labels that its parts may have; of a file that cannot be read, none.
    #[must_use]
    pub fn part_labels(&self, assets: &AssetCache) -> Vec<String> {
        match self.source() {
            _ if self.labels == Labels::None => Vec::new(),
            Ok(Source::Kind(kind)) => kind.parts().iter().map(|&part| part.to_owned()).collect(),
            Ok(Source::Glb(glb)) => assets.environment(self, glb).map_or_else(
                |_| Vec::new(),
                |world| world.things.iter().filter_map(|thing| thing.label.clone()).collect(),
            ),
            Err(_) => Vec::new(),
        }
    }
}

/// What an environment is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source<'a> {
    /// A file.
    Glb(&'a str),
    /// A generated kind, whose numbers are sound.
    Kind(&'a Kind),
}

impl std::fmt::Debug for Environment {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Environment").field("things", &self.things.len()).finish_non_exhaustive()
    }
}

impl Thing {
    fn made(mesh: Arc<Mesh>, node: String, label: Option<String>, materials: Vec<Surface>, role: Role) -> Self {
        Self { mesh, node, label, materials, role, tree: OnceLock::new() }
    }

    /// Its surface, for what must not pass through it; built on first use.
    pub(super) fn tree(&self) -> &Tree {
        self.tree.get_or_init(|| Tree::of(&self.mesh))
    }

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
        Self::made(Arc::new(mesh), node.to_string(), label, materials, Role::Ground)
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
        let spec =
            |labels| EnvironmentSpec { glb: Some("scene.glb".into()), kind: None, labels, sediment: "silt".into() };
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
