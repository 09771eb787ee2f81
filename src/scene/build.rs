//! Specification to scene: seabed, environment, then bodies one after the other.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::assets::AssetCache;
use super::bvh::Bvh;
use super::environment::{Environment, EnvironmentError, EnvironmentSpec, Source, Surface};
use super::ground::Ground;
use super::multipath::Multipath;
use super::placement::{Before, BodySpec, OnFailure, ROPE, Search, Standing, View, Whose, is_seen, order};
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

/// A scene, the ground in it, and what found no place.
#[derive(Clone, Debug)]
pub struct Built {
    /// Instances: seabed, background of the environment, its bodies, then the objects in their order.
    pub scene: Scene,
    /// What altitudes are measured from. Does not include the objects.
    pub ground: Ground,
    /// Objects that are not in the scene.
    pub dropped: Vec<Dropped>,
    /// Objects with given poses that pass through others, or through structures.
    pub overlaps: Vec<Overlap>,
}

impl Built {
    /// What a person should know of its objects.
    pub fn notes(&self) -> impl Iterator<Item = String> + '_ {
        let dropped = self.dropped.iter().map(|object| format!("{} is left out: {}", object.asset, object.reason));
        let overlaps = self.overlaps.iter().map(|object| format!("{} passes through {}", object.asset, object.with));
        dropped.chain(overlaps)
    }
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

/// An object with a given pose that passes through something.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Overlap {
    /// Index into [`SceneSpec::bodies`].
    pub body: usize,
    /// Its category.
    pub label: String,
    /// Catalog and uid.
    pub asset: String,
    /// Catalog and uid of the other, or `the environment`.
    pub with: String,
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
            if let Some(problem) = spec.fault() {
                return Err(SceneError::Body { body, label: spec.label.clone(), problem });
            }
            assets.solid(&spec.catalog, &spec.uid)?;
        }
        order(&self.bodies).map(|_| ()).map_err(|body| {
            let (key, label) = self.bodies[body].pose.refers_to().unwrap_or_default();
            let problem = format!(
                "`{key}: {label}` goes in a circle: what it refers to waits, by way of others, for this object; place one of \
                 them by itself"
            );
            SceneError::Body { body, label: self.bodies[body].label.clone(), problem }
        })
    }
}

/// Builds a scene that is not looked at from anywhere yet. The same specification, models, seed and scene index give the
/// same bits.
///
/// # Errors
/// As [`build_in_view`]; objects with `in_view` cannot be placed by it.
pub fn build(spec: &SceneSpec, assets: &AssetCache, seed: u64, scene_index: u64) -> Result<Built, SceneError> {
    build_in_view(spec, assets, seed, scene_index, &|_| Ok(Vec::new()))
}

/// Builds a scene that is looked at: `views` tells, for a scene as it is then, what the sonar sees in each frame.
///
/// Objects with a given pose stand there whatever else does; what they pass through is listed in [`Built::overlaps`]. All
/// others keep clear of everything, or are left out and listed in [`Built::dropped`]. The same specification, models,
/// seed, scene index and views give the same bits.
///
/// # Errors
/// See [`SceneError`].
pub fn build_in_view(
    spec: &SceneSpec,
    assets: &AssetCache,
    seed: u64,
    scene_index: u64,
    views: &dyn Fn(&Built) -> Result<Vec<View>, SceneError>,
) -> Result<Built, SceneError> {
    spec.check(assets)?;
    let stream = |purpose: &str| Stream::at(seed, "scene", scene_index, purpose);
    let world = world(spec, assets, &stream)?;
    // The check has found every order.
    let order = order(&spec.bodies).unwrap_or_default();
    let mut shapes = Vec::new();
    for body in &spec.bodies {
        shapes.push(assets.solid(&body.catalog, &body.uid)?.shape().clone());
    }
    let search =
        Search { bodies: &spec.bodies, shapes: &shapes, ground: &world.ground, order: &order, stream: &stream };
    Layout { spec, assets, world: &world, search: &search, views }.build()
}

/// Seabed and environment.
fn world(spec: &SceneSpec, assets: &AssetCache, stream: &dyn Fn(&str) -> Stream) -> Result<Built, SceneError> {
    let mut ground = Ground::default();
    let mut builder = Builder::default();
    builder.scene.mirrors = spec.multipath.iter().flat_map(Multipath::mirrors).collect();
    builder.scene.texture_seed = stream("texture").bits();
    if let Some(seabed) = &spec.seabed {
        let grid = seabed.build(assets, &mut stream("seabed"))?;
        let sediments: Vec<Surface> = grid.sediments().iter().cloned().map(Surface::Sediment).collect();
        builder.add(Arc::new(grid.mesh()), DAffine3::IDENTITY, 0, &sediments)?;
        ground.seabed = Some(Arc::new(grid));
    }
    if let Some(environment) = &spec.environment {
        let world = match environment.source()? {
            Source::Glb(glb) => assets.environment(environment, glb)?,
            Source::Kind(kind) => {
                let seabed = ground.seabed.as_deref();
                Arc::new(Environment::generate(kind, environment.labels, seabed, &mut stream("environment")))
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
    Ok(Built { scene: builder.scene, ground, dropped: Vec::new(), overlaps: Vec::new() })
}

/// Most often that a scene is laid out again for objects that are not in view.
const LAYOUTS: u32 = 8;

/// A scene on its way.
struct Layout<'a> {
    spec: &'a SceneSpec,
    assets: &'a AssetCache,
    /// Without objects.
    world: &'a Built,
    search: &'a Search<'a>,
    views: &'a dyn Fn(&Built) -> Result<Vec<View>, SceneError>,
}

/// A place, or why there is none.
type Place = Result<Standing, String>;

impl Layout<'_> {
    /// Lays out every object; again those that are not in view, for where the sonar goes may depend on the objects.
    fn build(&self) -> Result<Built, SceneError> {
        let bodies = &self.spec.bodies;
        let watched = bodies.iter().position(|body| body.in_view.is_some());
        let mut views = if watched.is_some() { (self.views)(self.world)? } else { Vec::new() };
        if let (Some(body), true) = (watched, views.is_empty()) {
            let problem = "in_view needs frames, and this scene has none".to_owned();
            return Err(SceneError::Body { body, label: bodies[body].label.clone(), problem });
        }
        let mut again = vec![0; bodies.len()];
        let mut kept: Vec<Option<Standing>> = vec![None; bodies.len()];
        let mut out = std::collections::BTreeMap::new();
        loop {
            let before = Before { kept: &kept, again: &again, views: &views };
            let laid = self.search.lay(&before).into_iter().enumerate();
            let places: Vec<Place> = laid
                .map(|(body, place)| match out.get(&body) {
                    Some(reason) => Err(String::clone(reason)),
                    None => place.map_err(|failure| failure.reason),
                })
                .collect();
            let built = self.assemble(&places)?;
            if watched.is_none() {
                return Ok(built);
            }
            views = (self.views)(&built)?;
            let unseen = self.unseen(&built, &places, &views);
            if unseen.is_empty() {
                return Ok(built);
            }
            for &body in &unseen {
                again[body] += 1;
                if again[body] >= LAYOUTS {
                    out.insert(body, format!("it is not in view from where it was placed, {LAYOUTS} times"));
                }
            }
            kept = places.into_iter().map(Result::ok).collect();
            self.with_those_that_refer_to(unseen).into_iter().for_each(|body| kept[body] = None);
        }
    }

    /// Objects that are placed but not seen in the frames that they ask for.
    fn unseen(&self, built: &Built, places: &[Place], views: &[View]) -> Vec<usize> {
        let beside = built.scene.instances.iter().skip(usize::from(built.ground.seabed.is_some()));
        let beside = Bvh::of(beside.map(|instance| (&*instance.mesh, instance.world_from_mesh)));
        let mut number = self.world.scene.bodies.len() as u16;
        let mut unseen = Vec::new();
        for (body, spec) in self.spec.bodies.iter().enumerate().filter(|(body, _)| places[*body].is_ok()) {
            number += 1;
            let wanted = spec.in_view.as_ref().map_or_else(Vec::new, |in_view| in_view.of(views));
            if !is_seen(&built.scene, &built.ground, number, &wanted, &beside) {
                unseen.push(body);
            }
        }
        unseen
    }

    /// Objects, and all whose poses refer to something with their labels, by way of others too.
    fn with_those_that_refer_to(&self, mut bodies: Vec<usize>) -> Vec<usize> {
        let all = &self.spec.bodies;
        let mut next = 0;
        while let Some(&body) = bodies.get(next) {
            let refers =
                |other: &usize| all[*other].pose.refers_to().is_some_and(|(_, label)| label == all[body].label);
            let more: Vec<usize> = (0..all.len()).filter(refers).filter(|other| !bodies.contains(other)).collect();
            bodies.extend(more);
            next += 1;
        }
        bodies
    }

    /// The scene with its objects where they stand.
    fn assemble(&self, places: &[Place]) -> Result<Built, SceneError> {
        let Built { scene, ground, .. } = self.world;
        let mut builder = Builder { scene: scene.clone() };
        let (mut dropped, mut overlaps) = (Vec::new(), Vec::new());
        for (number, (body, place)) in self.spec.bodies.iter().zip(places).enumerate() {
            let (label, asset) = (body.label.clone(), asset_name(&body.catalog, &body.uid));
            let standing = match place {
                Ok(standing) => standing,
                Err(reason) if body.on_failure == OnFailure::Fail => {
                    let problem = format!("{asset} cannot be placed, and `on_failure` is `fail`: {reason}");
                    return Err(SceneError::Body { body: number, label, problem });
                }
                Err(reason) => {
                    dropped.push(Dropped { body: number, label, asset, reason: reason.clone() });
                    continue;
                }
            };
            overlaps.extend(standing.overlaps.iter().map(|whose| {
                let with = match whose {
                    Whose::Object(other) => {
                        let other = &self.spec.bodies[*other];
                        asset_name(&other.catalog, &other.uid)
                    }
                    Whose::Part(_) => "the environment".to_owned(),
                    Whose::Rope => "a rope".to_owned(),
                };
                Overlap { body: number, label: label.clone(), asset: asset.clone(), with }
            }));
            let solid = self.assets.solid(&body.catalog, &body.uid)?;
            let surfaces: Vec<Surface> = solid.materials.iter().cloned().map(Surface::Material).collect();
            let id = builder.body(&body.label, asset, &solid.mesh, &standing.world_from_mesh)?;
            builder.add(solid.mesh.clone(), standing.world_from_mesh, id, &surfaces)?;
            if let Some(rope) = &standing.rope {
                builder.add(rope.clone(), DAffine3::IDENTITY, 0, &[Surface::Material(ROPE.into())])?;
            }
        }
        Ok(Built { scene: builder.scene, ground: ground.clone(), dropped, overlaps })
    }
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
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = vertices.iter().fold(nothing, |(low, high), p| (low.min(*p), high.max(*p)));
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
