//! A scene as geometry: instances of meshes in the world, with the body and the materials that each stands for.
//!
//! Knows nothing of recipes, sonars or images.

pub mod assets;
pub mod build;
pub mod bvh;
pub mod environment;
pub mod ground;
pub mod mesh;
pub mod multipath;
pub mod placement;
pub mod seabed;

use std::sync::Arc;

use glam::{DAffine3, DVec3};

pub use assets::{AssetCache, Tracks};
pub use build::{Built, Dropped, Overlap, SceneError, SceneSpec, asset_name, build, build_in_view};
pub use bvh::{Bvh, Hit};
pub use environment::{EnvironmentError, EnvironmentSpec, Kind, Labels};
pub use ground::Ground;
pub use mesh::{Cluster, Mesh};
pub use multipath::{Mirror, Multipath};
pub use placement::{At, BodySpec, InView, OnFailure, PoseSpec, Rest, View};
pub use seabed::{HeightGrid, SeabedSpec};

/// A mesh at a place in the world.
#[derive(Clone, Debug)]
pub struct Instance {
    /// The shared surface.
    pub mesh: Arc<Mesh>,
    /// Rigid with a uniform scale.
    pub world_from_mesh: DAffine3,
    /// The body this is a part of: an index into [`Scene::bodies`] plus one, or 0 for unlabelled background.
    pub body: u16,
    /// For each material slot of the mesh, an index into [`Scene::materials`].
    pub materials: Vec<u16>,
}

/// A labelled thing in the scene: what a mask and a box will name.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Category in the annotations.
    pub label: String,
    /// Catalog and uid (`starter/tire`), or the node's name for parts of an environment.
    pub asset: String,
    /// Middle of the bounding box in the world, metres.
    pub centre: DVec3,
    /// Half the diagonal of the bounding box, metres.
    pub radius: f64,
}

/// How a surface scatters.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the material catalog.
    pub name: String,
    /// Lambert coefficient μ, at most 1/π.
    pub lambert_mu: f64,
    /// Share of the power that is reflected as by a mirror at normal incidence, |R|²; with the diffuse part at most 1.
    pub reflected: f64,
    /// Power reflected at normal incidence by its impedance against sea water, |R|², whatever the diffuse part is.
    pub reflectivity: f64,
    /// Rms slope of the surface's facets, radians: the width of the specular lobe.
    pub slope_rad: f64,
    /// Shape ν of the gamma-distributed patchiness; none for an even surface.
    pub texture_nu: Option<f64>,
}

impl Material {
    /// A surface that only scatters by Lambert's law.
    #[must_use]
    pub fn lambert(name: &str, mu: f64) -> Self {
        let reflectivity = (std::f64::consts::PI * mu).min(1.0);
        Self { name: name.into(), lambert_mu: mu, reflected: 0.0, reflectivity, slope_rad: 0.1, texture_nu: None }
    }
}

/// Everything a ping can meet.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// In a fixed order, background first.
    pub instances: Vec<Instance>,
    /// What the instances' material slots point to.
    pub materials: Vec<Material>,
    /// Labelled bodies; body number = index + 1.
    pub bodies: Vec<Body>,
    /// Level planes that sound bounces off.
    pub mirrors: Vec<Mirror>,
    /// Names the random patchiness of its surfaces: the same in every frame of a scene.
    pub texture_seed: u64,
}
