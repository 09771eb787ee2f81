//! From a recipe to a plan: sections drawn scene by scene and frame by frame, models chosen, everything checked.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;

use sha2::{Digest as _, Sha256};

use super::sections::{ObjectEntry, Sections, World};
use super::{AssetLock, Header, Job, Plan, PlanError, ScenePlan};
use crate::catalog::{CatalogError, materials};
use crate::math::rng::Stream;
use crate::recipe::{Address, Draws, Level, Recipe};
use crate::scene::{AssetCache, BodySpec, SceneError, SceneSpec};

/// Compiles a recipe. `stem` names the dataset where the recipe does not; `recipe_dir` is where relative paths begin.
///
/// Every model that a scene uses is loaded into `assets`, so what a run would refuse is refused here.
///
/// # Errors
/// The first fault of the recipe, of a catalog or of a model, located in the recipe.
pub fn compile(recipe: &Recipe, stem: &str, recipe_dir: &Path, assets: &AssetCache) -> Result<Plan, PlanError> {
    let compiler = Compiler { sections: Sections::new(recipe, recipe_dir)?, recipe_dir, assets };
    let header = compiler.sections.header(stem)?;
    let mut plan = Plan {
        ensonify: env!("CARGO_PKG_VERSION"),
        header,
        assets: BTreeMap::new(),
        scenes: Vec::new(),
        jobs: Vec::new(),
    };
    for index in 0..plan.header.scenes {
        let scene = compiler.scene(&plan.header, index, &mut plan.assets)?;
        let split = scene.split;
        plan.scenes.push(scene);
        for frame in 0..plan.header.frames {
            let address = Address { seed: plan.header.seed, scene: index, level: Level::Frame(frame) };
            let sections = compiler.sections.frame(&address)?;
            plan.jobs.push(Job {
                id: index * plan.header.frames + frame,
                scene: index,
                frame,
                split,
                sonar: sections.sonar,
                looks: sections.looks,
                trajectory: sections.trajectory,
                drawn: sections.drawn,
            });
        }
    }
    Ok(plan)
}

struct Compiler<'a> {
    sections: Sections,
    recipe_dir: &'a Path,
    assets: &'a AssetCache,
}

impl Compiler<'_> {
    /// Draws a scene: its world, then every instance of every item of `objects`.
    fn scene(
        &self,
        header: &Header,
        index: u64,
        locks: &mut BTreeMap<String, AssetLock>,
    ) -> Result<ScenePlan, PlanError> {
        let mut drawn = Draws::new();
        let address = |level| Address { seed: header.seed, scene: index, level };
        let World { seabed, environment, multipath } = self.sections.world(&address(Level::Scene), &mut drawn)?;
        let mut spec = SceneSpec { seabed, environment, multipath, bodies: Vec::new() };
        let mut items = Vec::new();
        for item in 0..self.sections.object_items()? {
            let count = self.sections.count(item, &address(Level::Scene), &mut drawn)?;
            for instance in 0..u64::from(count) {
                let entry = self.sections.object(item, &address(Level::Instance(instance)), &mut drawn)?;
                let purpose = format!("objects[{item}]#{instance}.pick");
                let mut choice = Stream::at(header.seed, "scene", index, &purpose);
                spec.bodies.push(self.body(item, entry, &mut choice, locks)?);
                items.push(item);
            }
        }
        self.check(&spec, &items, locks)?;
        Ok(ScenePlan { index, split: header.splits.of_scene(header.seed, index), spec, drawn })
    }

    /// Chooses a model for an instance, all that match being equally likely.
    fn body(
        &self,
        item: usize,
        entry: ObjectEntry,
        choice: &mut Stream,
        locks: &mut BTreeMap<String, AssetLock>,
    ) -> Result<BodySpec, PlanError> {
        let refuse = |fault: CatalogError| self.refuse(&format!("objects[{item}].pick"), &fault);
        let ObjectEntry { label, pick, pose } = entry;
        let catalog = self.assets.catalog(&pick.catalog).map_err(refuse)?;
        let matching = catalog.pick(&pick).map_err(refuse)?;
        let asset = matching[choice.below(matching.len() as u64) as usize];
        self.assets.solid(&pick.catalog, &asset.uid).map_err(refuse)?;
        let key = format!("{}/{}", pick.catalog, asset.uid);
        if let Entry::Vacant(place) = locks.entry(key) {
            place.insert(AssetLock {
                sha256: sha256_of(&asset.path).map_err(|error| self.unreadable(item, &asset.path, &error))?,
                name: asset.name.clone(),
                licence: asset.licence.clone(),
                attribution: asset.attribution.clone(),
                source: asset.source.clone(),
            });
        }
        Ok(BodySpec {
            label: label.unwrap_or_else(|| asset.label.clone()),
            catalog: pick.catalog,
            uid: asset.uid.clone(),
            pose,
        })
    }

    /// Refuses what building the scene would refuse, with the place in the recipe. `items` tells each body's list item.
    fn check(
        &self,
        spec: &SceneSpec,
        items: &[usize],
        locks: &mut BTreeMap<String, AssetLock>,
    ) -> Result<(), PlanError> {
        if let Some(seabed) = &spec.seabed {
            materials::sediment(&seabed.sediment).map_err(|fault| self.refuse("seabed.sediment", &fault))?;
            if let Some(file) = seabed.file() {
                seabed.check(self.assets).map_err(|fault| self.refuse("seabed.shape", &fault))?;
                self.lock("seabed", file, locks).map_err(|error| self.refuse("seabed.shape", &error))?;
            }
        }
        if let Some(environment) = &spec.environment {
            materials::sediment(&environment.sediment).map_err(|fault| self.refuse("environment.sediment", &fault))?;
            if let Some(glb) = &environment.glb {
                self.assets.environment(environment, glb).map_err(|fault| self.refuse("environment.glb", &fault))?;
                self.lock("environment", glb, locks).map_err(|error| self.refuse("environment.glb", &error))?;
            }
        }
        spec.check(self.assets).map_err(|fault| match fault {
            SceneError::Seabed(fault) => self.refuse("seabed", &fault),
            SceneError::Environment(fault) => self.refuse("environment", &fault),
            SceneError::Body { body, problem, .. } => self.refuse(&format!("objects[{}].pose", items[body]), &problem),
            SceneError::Catalog(fault) => self.refuse("objects", &fault),
            SceneError::TooManyBodies { .. } => self.refuse("objects", &fault),
        })
    }

    /// Pins a file that is no model of a catalog.
    fn lock(&self, section: &str, file: &str, locks: &mut BTreeMap<String, AssetLock>) -> std::io::Result<()> {
        if let Entry::Vacant(place) = locks.entry(format!("{section}/{file}")) {
            let unknown = || "not stated".to_owned();
            place.insert(AssetLock {
                sha256: sha256_of(&self.recipe_dir.join(file))?,
                name: file.to_owned(),
                licence: unknown(),
                attribution: unknown(),
                source: file.to_owned(),
            });
        }
        Ok(())
    }

    /// A fault found by a module that knows no recipe, at its place in the recipe. Messages carry their own remedy.
    fn refuse(&self, path: &str, fault: &dyn std::fmt::Display) -> PlanError {
        self.sections.tree.reject(path, &fault.to_string(), "").into()
    }

    fn unreadable(&self, item: usize, path: &Path, error: &std::io::Error) -> PlanError {
        self.refuse(&format!("objects[{item}].pick"), &format!("{} cannot be read: {error}", path.display()))
    }
}

fn sha256_of(path: &Path) -> std::io::Result<String> {
    let bytes = std::fs::read(path)?;
    Ok(Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect())
}
