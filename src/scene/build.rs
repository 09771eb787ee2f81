//! Specification to scene: seabed, environment, then bodies one after the other.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::assets::AssetCache;
use super::environment::{Environment, EnvironmentError, EnvironmentSpec, Source, Surface};
use super::ground::Ground;
use super::multipath::Multipath;
use super::placement::{Around, Footprint, PoseSpec, Standing, TRIES, bounds};
use super::seabed::{SeabedError, SeabedSpec};
use super::{Body, Instance, Material, Mesh, Scene};
use crate::catalog::CatalogError;
use crate::catalog::materials::{material, sediment};
use crate::math::real::radians;
use crate::math::rng::Stream;
use crate::physics::lambert::{MAX_LAMBERT_MU, lambert_mu};
use crate::physics::reflection::normal_incidence;

/// Specific impedance of sea water, kg/(m²·s).
const SEA_WATER_IMPEDANCE: f64 = 1.539e6;

/// Most bodies of a scene: masks number them with 16 bits.
const MAX_BODIES: usize = u16::MAX as usize;

/// A world to build.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneSpec {
    /// A generated bottom.
    pub seabed: Option<SeabedSpec>,
    /// A fixed world.
    pub environment: Option<EnvironmentSpec>,
    /// Mirrors for sound.
    pub multipath: Option<Multipath>,
    /// Objects, in this order.
    pub bodies: Vec<BodySpec>,
}

/// An object to place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodySpec {
    /// Category in the annotations.
    pub label: String,
    /// Name or folder of a catalog.
    pub catalog: String,
    /// Model of the catalog.
    pub uid: String,
    /// Where it stands.
    pub pose: PoseSpec,
}

/// A scene, the ground in it, and what found no place.
#[derive(Clone, Debug)]
pub struct Built {
    /// Instances: seabed, background of the environment, its bodies, then the objects in their order.
    pub scene: Scene,
    /// What altitudes are measured from. Does not include the objects.
    pub ground: Ground,
    /// Objects that are not in the scene.
    pub dropped: Vec<Dropped>,
}

/// An object that found no place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Dropped {
    /// Index into [`SceneSpec::bodies`].
    pub body: usize,
    /// Its category.
    pub label: String,
    /// Catalog and uid.
    pub asset: String,
    /// Why.
    pub reason: String,
}

/// A scene that cannot be built.
#[derive(Debug, Error)]
pub enum SceneError {
    /// A catalog, a model, a sediment or a material.
    #[error(transparent)]
    Catalog(#[from] CatalogError),
    /// The seabed.
    #[error(transparent)]
    Seabed(#[from] SeabedError),
    /// A generated environment.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
    /// A file of poses.
    #[error(transparent)]
    Track(#[from] crate::vehicle::TrackError),
    /// An object.
    #[error("bodies[{body}] ({label}): {problem}")]
    Body {
        /// Index into [`SceneSpec::bodies`].
        body: usize,
        /// Its category.
        label: String,
        /// What is wrong.
        problem: String,
    },
    /// More bodies than a 16-bit mask can number.
    #[error("{count} bodies in one scene; masks number at most 65535: take fewer objects or `labels: none`")]
    TooManyBodies {
        /// How many there are.
        count: usize,
    },
}

impl SceneSpec {
    /// Finds what [`build`] would refuse, without meshing anything but the models, which stay in the cache.
    ///
    /// # Errors
    /// See [`SceneError`].
    pub fn check(&self, assets: &AssetCache) -> Result<(), SceneError> {
        if let Some(seabed) = &self.seabed {
            seabed.check(assets)?;
        }
        if let Some(environment) = &self.environment {
            match environment.source()? {
                Source::Glb(glb) => assets.environment(environment, glb).map(|_| ())?,
                Source::Kind(kind) if self.seabed.is_none() && !kind.has_floor() => {
                    return Err(EnvironmentError::NoSeabed.into());
                }
                Source::Kind(_) => {}
            }
        }
        if self.bodies.len() > MAX_BODIES {
            return Err(SceneError::TooManyBodies { count: self.bodies.len() });
        }
        for (body, spec) in self.bodies.iter().enumerate() {
            if let Some(problem) = spec.pose.fault() {
                return Err(SceneError::Body { body, label: spec.label.clone(), problem });
            }
            assets.solid(&spec.catalog, &spec.uid)?;
        }
        Ok(())
    }
}

/// Builds a scene. The same specification, models, seed and scene index give the same bits.
///
/// Objects that rest are placed after those with a given pose, else in their order. An object that finds no free place
/// is left out and listed in [`Built::dropped`]. Objects with given poses stand there whatever else does.
///
/// # Errors
/// See [`SceneError`].
pub fn build(spec: &SceneSpec, assets: &AssetCache, seed: u64, scene_index: u64) -> Result<Built, SceneError> {
    spec.check(assets)?;
    let mut ground = Ground::default();
    let mut builder = Builder::default();
    builder.scene.mirrors = spec.multipath.iter().flat_map(Multipath::mirrors).collect();
    builder.scene.texture_seed = Stream::at(seed, "scene", scene_index, "texture").bits();
    if let Some(seabed) = &spec.seabed {
        let grid = seabed.build(assets, &mut Stream::at(seed, "scene", scene_index, "seabed"))?;
        let sediments: Vec<Surface> = grid.sediments().iter().cloned().map(Surface::Sediment).collect();
        builder.add(Arc::new(grid.mesh()), DAffine3::IDENTITY, 0, &sediments)?;
        ground.seabed = Some(Arc::new(grid));
    }
    if let Some(environment) = &spec.environment {
        let world = match environment.source()? {
            Source::Glb(glb) => assets.environment(environment, glb)?,
            Source::Kind(kind) => {
                let mut stream = Stream::at(seed, "scene", scene_index, "environment");
                Arc::new(Environment::generate(kind, environment.labels, ground.seabed.as_deref(), &mut stream))
            }
        };
        for thing in &world.things {
            let body = match &thing.label {
                Some(label) => builder.body(label, thing.node.clone(), &thing.mesh, &DAffine3::IDENTITY)?,
                None => 0,
            };
            builder.add(thing.mesh.clone(), DAffine3::IDENTITY, body, &thing.materials)?;
        }
        ground.environment = Some(world);
    }
    let stream = |body: usize| Stream::at(seed, "scene", scene_index, &format!("bodies[{body}].place"));
    let places = place(spec, assets, &ground, &stream)?;
    let mut dropped = Vec::new();
    for (number, (body, standing)) in spec.bodies.iter().zip(places).enumerate() {
        let asset = asset_name(&body.catalog, &body.uid);
        let Some(standing) = standing else {
            let reason = format!("no free place on the ground in {TRIES} tries");
            dropped.push(Dropped { body: number, label: body.label.clone(), asset, reason });
            continue;
        };
        let solid = assets.solid(&body.catalog, &body.uid)?;
        let surfaces: Vec<Surface> = solid.materials.iter().cloned().map(Surface::Material).collect();
        let id = builder.body(&body.label, asset, &solid.mesh, &standing.world_from_mesh)?;
        builder.add(solid.mesh.clone(), standing.world_from_mesh, id, &surfaces)?;
    }
    Ok(Built { scene: builder.scene, ground, dropped })
}

/// A place for each body; given poses first, so that what rests keeps clear of them.
fn place(
    spec: &SceneSpec,
    assets: &AssetCache,
    ground: &Ground,
    stream: &dyn Fn(usize) -> Stream,
) -> Result<Vec<Option<Standing>>, SceneError> {
    let mut places: Vec<Option<Standing>> = vec![None; spec.bodies.len()];
    let mut taken: Vec<Footprint> = ground.environment.iter().flat_map(|world| world.footprints.clone()).collect();
    let rests = |pose: &PoseSpec| matches!(pose, PoseSpec::Rest(_));
    let mut order: Vec<usize> = (0..spec.bodies.len()).collect();
    order.sort_by_key(|&body| rests(&spec.bodies[body].pose));
    for body in order {
        let BodySpec { catalog, uid, pose, .. } = &spec.bodies[body];
        let mesh = &assets.solid(catalog, uid)?.mesh;
        places[body] = match pose {
            PoseSpec::At(at) => Some(at.stand(mesh)),
            PoseSpec::Rest(rest) => rest.stand(mesh, &Around { ground, taken: &taken }, &mut stream(body)),
        };
        taken.extend(places[body].iter().map(|standing| standing.footprint.clone()));
    }
    Ok(places)
}

/// What annotations call a model: catalog and uid; of a catalog given as a folder, the folder's own name.
#[must_use]
pub fn asset_name(catalog: &str, uid: &str) -> String {
    let catalog = catalog.trim_end_matches('/').rsplit('/').next().unwrap_or_default();
    format!("{catalog}/{uid}")
}

#[derive(Default)]
struct Builder {
    scene: Scene,
}

impl Builder {
    fn add(
        &mut self,
        mesh: Arc<Mesh>,
        world_from_mesh: DAffine3,
        body: u16,
        surfaces: &[Surface],
    ) -> Result<(), CatalogError> {
        let materials = surfaces.iter().map(|surface| self.material(surface)).collect::<Result<_, _>>()?;
        self.scene.instances.push(Instance { mesh, world_from_mesh, body, materials });
        Ok(())
    }

    /// Number of a new body.
    fn body(&mut self, label: &str, asset: String, mesh: &Mesh, world_from_mesh: &DAffine3) -> Result<u16, SceneError> {
        let vertices: Vec<DVec3> = mesh.vertices().map(|v| world_from_mesh.transform_point3(v.as_dvec3())).collect();
        let (low, high) = bounds(&vertices);
        let (centre, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
        self.scene.bodies.push(Body { label: label.into(), asset, centre, radius });
        let count = self.scene.bodies.len();
        u16::try_from(count).map_err(|_| SceneError::TooManyBodies { count })
    }

    fn material(&mut self, surface: &Surface) -> Result<u16, CatalogError> {
        let wanted = match surface {
            Surface::Sediment(name) => {
                let sediment = sediment(name)?;
                let facts = Facts { density: sediment.density, speed: sediment.speed, slope_deg: sediment.slope_deg };
                facts.material(name, sediment.lambert_db, Some(sediment.texture_nu))
            }
            Surface::Material(name) => {
                let material = material(name)?;
                let facts = Facts { density: material.density, speed: material.speed, slope_deg: material.slope_deg };
                facts.material(name, material.lambert_db, None)
            }
        };
        let known = self.scene.materials.iter().position(|material| *material == wanted);
        let number = known.unwrap_or_else(|| {
            self.scene.materials.push(wanted);
            self.scene.materials.len() - 1
        });
        // The tables have fewer entries than 16 bits can number.
        Ok(number as u16)
    }
}

/// What sediments and materials have in common.
struct Facts {
    density: f64,
    speed: f64,
    slope_deg: f64,
}

impl Facts {
    /// Reflects what its impedance does against sea water, as far as the diffuse part leaves power for it.
    fn material(&self, name: &str, lambert_db: f64, texture_nu: Option<f64>) -> Material {
        // The tables are checked when they are read, so nothing is cut off here.
        let mu = lambert_mu(lambert_db).unwrap_or(MAX_LAMBERT_MU);
        let r = normal_incidence(SEA_WATER_IMPEDANCE, self.density * self.speed);
        let reflectivity = r * r;
        let reflected = reflectivity.min(1.0 - std::f64::consts::PI * mu).max(0.0);
        let slope_rad = radians(self.slope_deg);
        Material { name: name.into(), lambert_mu: mu, reflected, reflectivity, slope_rad, texture_nu }
    }
}

#[cfg(test)]
mod tests;
