//! From a recipe to a plan: sections drawn scene by scene and frame by frame, models chosen, everything checked.

use std::cell::RefCell;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::deal::Deal;
use super::sections::{ObjectEntry, SWEPT, Sections, Turn, World};
use super::{AssetLock, Header, Job, Plan, PlanError, ScenePlan, Split, SplitBy, VariantPlan};
use crate::catalog::{Asset, Catalog, CatalogError, materials};
use crate::math::rng::Stream;
use crate::recipe::{self, Address, Draws, Level, Recipe, Variant};
use crate::scene::{AssetCache, BodySpec, EnvironmentSpec, InView, Labels, SceneError, SceneSpec};
use crate::vehicle::Trajectory;

/// Compiles a recipe. `stem` names the dataset where the recipe does not; `recipe_dir` is where relative paths begin.
///
/// Every model that a scene uses is loaded into `assets`, so what a run would refuse is refused here.
///
/// # Errors
/// The first fault of the recipe, of a catalog or of a model, located in the recipe.
pub fn compile(recipe: &Recipe, stem: &str, recipe_dir: &Path, assets: &AssetCache) -> Result<Plan, PlanError> {
    recipe.completed().version()?;
    let (variants, all) = variants(recipe)?;
    let first = Sections::new(&all[0].recipe, recipe_dir)?;
    let header = first.header(stem, all.len() as u64)?;
    let names = variants.iter().enumerate().map(|(number, variant)| named(number, variant, header.seed)).collect();
    let mut plan = Plan {
        ensonify: env!("CARGO_PKG_VERSION"),
        sets: Vec::new(),
        header,
        variants: names,
        assets: BTreeMap::new(),
        scenes: Vec::new(),
        jobs: Vec::new(),
    };
    let mut first = Some(first);
    for (number, variant) in all.iter().enumerate() {
        let sections = match first.take() {
            Some(sections) => sections,
            None => Sections::new(&variant.recipe, recipe_dir)?,
        };
        Compiler::new(sections, &plan, number, Files { recipe_dir, assets }).scenes(&mut plan)?;
    }
    Ok(plan)
}

/// The variants of a sweep; and of a recipe without one, the recipe itself.
pub(super) fn variants(recipe: &Recipe) -> Result<(Vec<Variant>, Vec<Variant>), PlanError> {
    let variants = recipe.variants(&SWEPT)?;
    let unswept = || vec![Variant { recipe: recipe.clone(), set: BTreeMap::new(), repeat: None }];
    let all = if variants.is_empty() { unswept() } else { variants.clone() };
    Ok((variants, all))
}

/// What a person should know of a recipe that can be run.
#[must_use]
pub fn notes(recipe: &Recipe) -> Vec<recipe::Error> {
    recipe.unused_lets(recipe.node())
}

/// A variant as the plan tells of it.
fn named(number: usize, variant: &Variant, seed: u64) -> VariantPlan {
    let seed = match variant.repeat {
        None | Some(0) => seed,
        Some(repeat) => Stream::at(seed, "variant", repeat, "seed").bits(),
    };
    let (id, description) = (format!("v{number:03}"), variant.description());
    VariantPlan { id, description, set: variant.set.clone(), repeat: variant.repeat, seed }
}

/// Where files are found and kept.
#[derive(Clone, Copy)]
pub(super) struct Files<'a> {
    pub recipe_dir: &'a Path,
    pub assets: &'a AssetCache,
}

/// One variant on its way into the plan.
pub(super) struct Compiler<'a> {
    pub sections: Sections,
    recipe_dir: &'a Path,
    assets: &'a AssetCache,
    seed: u64,
    variant: Option<VariantPlan>,
    /// Of each catalog by name, where models are dealt out.
    deals: RefCell<BTreeMap<String, Deal>>,
}

impl<'a> Compiler<'a> {
    /// The compiler of a variant by its number; of a recipe without a sweep that is 0.
    pub fn new(sections: Sections, plan: &Plan, number: usize, files: Files<'a>) -> Self {
        let variant = plan.variants.get(number).cloned();
        let seed = variant.as_ref().map_or(plan.header.seed, |variant| variant.seed);
        let Files { recipe_dir, assets } = files;
        Self { sections, recipe_dir, assets, seed, variant, deals: RefCell::default() }
    }

    /// Adds every scene and frame of the variant to the plan.
    fn scenes(&self, plan: &mut Plan) -> Result<(), PlanError> {
        let first = plan.scenes.len();
        for index in 0..plan.header.scenes {
            let scene = self.scene(&plan.header, index, &mut plan.assets)?;
            let split = scene.split;
            plan.scenes.push(scene);
            for frame in 0..plan.header.frames {
                let address = self.address(index, Level::Frame(frame));
                let shared = self.sections.lets.draw(&address)?;
                let sections = self.sections.frame(&Turn { address, shared: &shared, corner: None })?;
                self.poses(&sections.trajectory, plan)?;
                plan.jobs.push(Job {
                    id: plan.jobs.len() as u64,
                    variant: self.variant.as_ref().map(|variant| variant.id.clone()),
                    scene: index,
                    frame,
                    split,
                    sonar: sections.sonar,
                    looks: sections.looks,
                    vehicle: sections.vehicle,
                    trajectory: sections.trajectory,
                    drawn: sections.drawn,
                });
            }
        }
        self.check_relations(&plan.scenes[first..])
    }

    pub fn address(&self, scene: u64, level: Level) -> Address {
        Address { seed: self.seed, scene, level }
    }

    /// Draws a scene: its world, then every instance of every item of `objects`.
    fn scene(
        &self,
        header: &Header,
        index: u64,
        locks: &mut BTreeMap<String, AssetLock>,
    ) -> Result<ScenePlan, PlanError> {
        let mut drawn = Draws::new();
        let shared = self.sections.lets.draw(&self.address(index, Level::Scene))?;
        drawn.extend(shared.drawn.clone());
        let turn = |level| Turn { address: self.address(index, level), shared: &shared, corner: None };
        let World { seabed, environment, multipath } = self.sections.world(&turn(Level::Scene), &mut drawn)?;
        let split = self.split(header, index)?;
        self.check_labels(header, environment.as_ref())?;
        let mut spec = SceneSpec { seabed, environment, multipath, bodies: Vec::new() };
        for item in 0..self.sections.object_items()? {
            let count = self.sections.count(item, &turn(Level::Scene), &mut drawn)?;
            for instance in 0..u64::from(count) {
                let entry = self.sections.object(item, &turn(Level::Instance(instance)), &mut drawn)?;
                let purpose = format!("objects[{item}]#{instance}.pick");
                let mut choice = Stream::at(self.seed, "scene", index, &purpose);
                let choice = &mut Choice { stream: &mut choice, header, split };
                spec.bodies.push(self.body([item as u64, instance], entry, choice, locks)?);
            }
        }
        self.check(&spec, locks)?;
        let (variant, seed) = (self.variant.as_ref().map(|variant| variant.id.clone()), self.seed);
        Ok(ScenePlan { variant, index, seed, split, spec, drawn })
    }

    /// Refuses labelled parts of environments where models are dealt out.
    pub fn check_labels(&self, header: &Header, environment: Option<&EnvironmentSpec>) -> Result<(), PlanError> {
        if header.splits.by != SplitBy::Asset || environment.is_none_or(|spec| spec.labels == Labels::None) {
            return Ok(());
        }
        let fault = "the bodies of an environment stand in every split; write `labels: none`, or split by scene";
        Err(self.refuse("environment.labels", &fault))
    }

    /// The split of a scene: the same in all variants, but where variants themselves are dealt out.
    fn split(&self, header: &Header, scene: u64) -> Result<Split, PlanError> {
        match (header.splits.by, &self.variant) {
            (SplitBy::Scene | SplitBy::Asset, _) => Ok(header.splits.of_scene(header.seed, scene)),
            (SplitBy::Variant, Some(variant)) => Ok(header.splits.of_key(header.seed, &variant.description)),
            (SplitBy::Variant, None) => {
                let fault = "there are no variants to deal out; add a `sweep`, or write `by: scene`";
                Err(self.refuse("splits.by", &fault))
            }
        }
    }

    /// Chooses a model for an instance, all that match being equally likely; of the scene's split alone where models are
    /// dealt out.
    pub fn body(
        &self,
        [item, instance]: [u64; 2],
        entry: ObjectEntry,
        choice: &mut Choice<'_>,
        locks: &mut BTreeMap<String, AssetLock>,
    ) -> Result<BodySpec, PlanError> {
        let refuse = |fault: CatalogError| self.refuse(&format!("objects[{item}].pick"), &fault);
        let ObjectEntry { label, pick, pose, clear_m, tries, on_failure, in_view } = entry;
        self.check_frames(item, in_view.as_ref(), choice.header)?;
        let catalog = self.assets.catalog(&pick.catalog).map_err(refuse)?;
        let matching = self.assets.pick(&pick).map_err(refuse)?;
        let dealt = self.dealt(&catalog, &pick.catalog, &matching, choice);
        if dealt.is_empty() {
            let fault = format!(
                "none of the models of this pick is dealt to the split {}; pick among more models, change the shares, or \
                 split by scene",
                choice.split
            );
            return Err(self.refuse(&format!("objects[{item}].pick"), &fault));
        }
        let policy = &choice.header.licences;
        let not_allowed = |fault: String| self.refuse(&format!("objects[{item}].pick"), &fault);
        let allowed = policy.narrowed(dealt).map_err(not_allowed)?;
        let asset = allowed[choice.stream.below(allowed.len() as u64) as usize];
        let key = format!("{}/{}", pick.catalog, asset.uid);
        policy.check(&key, &asset.licence).map_err(not_allowed)?;
        self.assets.solid(&pick.catalog, &asset.uid).map_err(refuse)?;
        if let Entry::Vacant(place) = locks.entry(key) {
            place.insert(AssetLock::of_model(asset).map_err(|error| self.unreadable(item, &asset.path, &error))?);
        }
        Ok(BodySpec {
            label: label.unwrap_or_else(|| asset.label.clone()),
            catalog: pick.catalog,
            uid: asset.uid.clone(),
            pose,
            clear_m,
            tries,
            on_failure,
            in_view,
            item: item as u32,
            instance: instance as u32,
        })
    }

    /// Refuses frames that a scene does not have.
    fn check_frames(&self, item: u64, in_view: Option<&InView>, header: &Header) -> Result<(), PlanError> {
        match in_view.and_then(InView::last) {
            Some(last) if last >= header.frames => {
                let frames = header.frames;
                let fault = format!("there is no frame {last}: a scene has {frames}, numbered from 0");
                Err(self.refuse(&format!("objects[{item}].in_view.frames"), &fault))
            }
            _ => Ok(()),
        }
    }

    /// Refuses labels that no scene of the variant has, where poses refer to them.
    fn check_relations(&self, scenes: &[ScenePlan]) -> Result<(), PlanError> {
        for scene in scenes.iter().filter(|scene| scene.spec.environment.is_none()) {
            if let Some(body) = scene.spec.bodies.iter().find(|body| body.pose.needs_environment()) {
                let help = "add for example `environment: {kind: pier}`, or name a label in `to`";
                let path = format!("objects[{}].pose", body.item);
                return Err(self.sections.tree.reject(&path, "there is no `environment` to attach it to", help).into());
            }
        }
        let objects = scenes.iter().flat_map(|scene| &scene.spec.bodies).map(|body| body.label.clone());
        let parts = scenes.iter().filter_map(|scene| scene.spec.environment.as_ref());
        let labels: BTreeSet<String> = objects.chain(parts.flat_map(|world| world.part_labels(self.assets))).collect();
        for body in scenes.iter().flat_map(|scene| &scene.spec.bodies) {
            let Some((key, label)) = body.pose.refers_to().filter(|(_, label)| !labels.contains(*label)) else {
                continue;
            };
            let known: Vec<&str> = labels.iter().map(String::as_str).collect();
            let path = format!("objects[{}].pose.{}.{key}", body.item, body.pose.kind());
            let help = recipe::did_you_mean(label, &known);
            return Err(self.sections.tree.reject(&path, &format!("no object has the label `{label}`"), &help).into());
        }
        Ok(())
    }

    /// Those of the models that scenes of this split may show.
    fn dealt<'m>(&self, catalog: &Catalog, name: &str, matching: &'m [Asset], choice: &Choice<'_>) -> Vec<&'m Asset> {
        let Header { splits, seed, .. } = choice.header;
        if splits.by != SplitBy::Asset {
            return matching.iter().collect();
        }
        let mut deals = self.deals.borrow_mut();
        let deal = deals.entry(name.to_owned()).or_insert_with(|| Deal::of(splits, *seed, catalog));
        matching.iter().filter(|asset| deal.is_in(&asset.uid, choice.split)).collect()
    }

    /// Refuses what building the scene would refuse, with the place in the recipe.
    pub fn check(&self, spec: &SceneSpec, locks: &mut BTreeMap<String, AssetLock>) -> Result<(), PlanError> {
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
            SceneError::Body { body, problem, .. } => {
                self.refuse(&format!("objects[{}].pose", spec.bodies[body].item), &problem)
            }
            SceneError::Catalog(fault) => self.refuse("objects", &fault),
            SceneError::TooManyBodies { .. } => self.refuse("objects", &fault),
            SceneError::Track(fault) => self.refuse("trajectory.poses.file", &fault),
        })
    }

    /// Reads and pins the file of poses that a trajectory takes.
    fn poses(&self, trajectory: &Trajectory, plan: &mut Plan) -> Result<(), PlanError> {
        let Trajectory::Poses(poses) = trajectory else { return Ok(()) };
        let place = "trajectory.poses.file";
        let track = self.assets.tracks().get(&poses.file).map_err(|fault| self.refuse(place, &fault))?;
        let (rows, least) = (track.rows(), poses.least_rows(plan.header.frames));
        if rows < least {
            let fault = format!("{} has too few rows, {rows} of {least}; add rows or ask for fewer frames", poses.file);
            return Err(self.refuse(place, &fault));
        }
        self.lock("trajectory", &poses.file, &mut plan.assets).map_err(|error| self.refuse(place, &error))
    }

    /// Pins a file that is no model of a catalog.
    fn lock(&self, section: &str, file: &str, locks: &mut BTreeMap<String, AssetLock>) -> std::io::Result<()> {
        if let Entry::Vacant(place) = locks.entry(format!("{section}/{file}")) {
            place.insert(AssetLock::of_file(self.recipe_dir, file)?);
        }
        Ok(())
    }

    /// A fault found by a module that knows no recipe, at its place in the recipe. Messages carry their own remedy.
    pub fn refuse(&self, path: &str, fault: &dyn std::fmt::Display) -> PlanError {
        self.sections.tree.reject(path, &fault.to_string(), "").into()
    }

    fn unreadable(&self, item: u64, path: &Path, error: &std::io::Error) -> PlanError {
        self.refuse(&format!("objects[{item}].pick"), &format!("{} cannot be read: {error}", path.display()))
    }
}

/// Who chooses a model, and for which split.
pub(super) struct Choice<'a> {
    pub stream: &'a mut Stream,
    pub header: &'a Header,
    pub split: Split,
}
