//! From a recipe to a plan: sections drawn scene by scene and frame by frame, models chosen, everything checked.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;

use sha2::{Digest as _, Sha256};

use super::sections::{ObjectEntry, SWEPT, Sections, Turn, World};
use super::{AssetLock, Header, Job, Plan, PlanError, ScenePlan, Split, SplitBy, VariantPlan};
use crate::catalog::licence::Others;
use crate::catalog::{Asset, CatalogError, Licence, LicencePolicy, materials};
use crate::math::rng::Stream;
use crate::recipe::{self, Address, Draws, Level, Recipe, Variant};
use crate::scene::{AssetCache, BodySpec, Labels, SceneError, SceneSpec};

/// Compiles a recipe. `stem` names the dataset where the recipe does not; `recipe_dir` is where relative paths begin.
///
/// Every model that a scene uses is loaded into `assets`, so what a run would refuse is refused here.
///
/// # Errors
/// The first fault of the recipe, of a catalog or of a model, located in the recipe.
pub fn compile(recipe: &Recipe, stem: &str, recipe_dir: &Path, assets: &AssetCache) -> Result<Plan, PlanError> {
    recipe.completed().version()?;
    let variants = recipe.variants(&SWEPT)?;
    let unswept = [Variant { recipe: recipe.clone(), set: BTreeMap::new(), repeat: None }];
    let all = if variants.is_empty() { &unswept[..] } else { &variants };
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
        let seed = plan.variants.get(number).map_or(plan.header.seed, |variant| variant.seed);
        let variant = plan.variants.get(number).cloned();
        Compiler { sections, recipe_dir, assets, seed, variant }.scenes(&mut plan)?;
    }
    Ok(plan)
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

/// One variant on its way into the plan.
struct Compiler<'a> {
    sections: Sections,
    recipe_dir: &'a Path,
    assets: &'a AssetCache,
    seed: u64,
    variant: Option<VariantPlan>,
}

impl Compiler<'_> {
    /// Adds every scene and frame of the variant to the plan.
    fn scenes(&self, plan: &mut Plan) -> Result<(), PlanError> {
        for index in 0..plan.header.scenes {
            let scene = self.scene(&plan.header, index, &mut plan.assets)?;
            let split = scene.split;
            plan.scenes.push(scene);
            for frame in 0..plan.header.frames {
                let address = self.address(index, Level::Frame(frame));
                let shared = self.sections.lets.draw(&address)?;
                let sections = self.sections.frame(&Turn { address, shared: &shared })?;
                plan.jobs.push(Job {
                    id: plan.jobs.len() as u64,
                    variant: self.variant.as_ref().map(|variant| variant.id.clone()),
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
        Ok(())
    }

    fn address(&self, scene: u64, level: Level) -> Address {
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
        let turn = |level| Turn { address: self.address(index, level), shared: &shared };
        let World { seabed, environment, multipath } = self.sections.world(&turn(Level::Scene), &mut drawn)?;
        let split = self.split(header, index)?;
        if let (SplitBy::Asset, Some(Labels::ByNode)) = (header.splits.by, environment.as_ref().map(|e| e.labels)) {
            let fault = "the bodies of an environment stand in every split; write `labels: none`, or split by scene";
            return Err(self.refuse("environment.labels", &fault));
        }
        let mut spec = SceneSpec { seabed, environment, multipath, bodies: Vec::new() };
        let mut items = Vec::new();
        for item in 0..self.sections.object_items()? {
            let count = self.sections.count(item, &turn(Level::Scene), &mut drawn)?;
            for instance in 0..u64::from(count) {
                let entry = self.sections.object(item, &turn(Level::Instance(instance)), &mut drawn)?;
                let purpose = format!("objects[{item}]#{instance}.pick");
                let mut choice = Stream::at(self.seed, "scene", index, &purpose);
                spec.bodies.push(self.body(item, entry, &mut Choice { stream: &mut choice, header, split }, locks)?);
                items.push(item);
            }
        }
        self.check(&spec, &items, locks)?;
        let (variant, seed) = (self.variant.as_ref().map(|variant| variant.id.clone()), self.seed);
        Ok(ScenePlan { variant, index, seed, split, spec, drawn })
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
    fn body(
        &self,
        item: usize,
        entry: ObjectEntry,
        choice: &mut Choice<'_>,
        locks: &mut BTreeMap<String, AssetLock>,
    ) -> Result<BodySpec, PlanError> {
        let refuse = |fault: CatalogError| self.refuse(&format!("objects[{item}].pick"), &fault);
        let ObjectEntry { label, pick, pose } = entry;
        let matching = self.assets.pick(&pick).map_err(refuse)?;
        let dealt = choice.dealt(&matching);
        if dealt.is_empty() {
            let fault = format!(
                "none of the models of this pick is dealt to the split {}; pick among more models, change the shares, or \
                 split by scene",
                choice.split
            );
            return Err(self.refuse(&format!("objects[{item}].pick"), &fault));
        }
        let allowed = allowed(&choice.header.licences, &dealt)
            .map_err(|fault| self.refuse(&format!("objects[{item}].pick"), &fault))?;
        let asset = allowed[choice.stream.below(allowed.len() as u64) as usize];
        let whose = format!("{}/{}", pick.catalog, asset.uid);
        choice
            .header
            .licences
            .check(&whose, &asset.licence)
            .map_err(|fault| self.refuse(&format!("objects[{item}].pick"), &fault))?;
        self.assets.solid(&pick.catalog, &asset.uid).map_err(refuse)?;
        if let Entry::Vacant(place) = locks.entry(whose) {
            place.insert(AssetLock {
                sha256: sha256_of(&asset.path).map_err(|error| self.unreadable(item, &asset.path, &error))?,
                name: asset.name.clone(),
                licence: Licence::read(&asset.licence).id,
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

/// Who chooses a model, and for which split.
struct Choice<'a> {
    stream: &'a mut Stream,
    header: &'a Header,
    split: Split,
}

impl Choice<'_> {
    /// Those of the models that scenes of this split may show.
    ///
    /// Dealt by uid alone: a catalog may be reached by several names.
    fn dealt<'m>(&self, matching: &'m [Asset]) -> Vec<&'m Asset> {
        let Header { splits, seed, .. } = self.header;
        let of_ours = |asset: &&Asset| splits.of_key(*seed, &asset.uid) == self.split;
        match splits.by {
            SplitBy::Scene | SplitBy::Variant => matching.iter().collect(),
            SplitBy::Asset => matching.iter().filter(of_ours).collect(),
        }
    }
}

/// The models that a pick goes on with: where others are left out, those whose licence is allowed.
fn allowed<'m>(policy: &LicencePolicy, models: &[&'m Asset]) -> Result<Vec<&'m Asset>, String> {
    let may = |asset: &&&Asset| match policy.others {
        Others::Refuse => true,
        Others::LeaveOut => policy.allows(&Licence::read(&asset.licence)),
    };
    let allowed: Vec<&Asset> = models.iter().filter(may).copied().collect();
    if allowed.is_empty() {
        return Err(format!(
            "none of the {} models of this pick is under a licence that `licences` allows; allow more, or pick others",
            models.len()
        ));
    }
    Ok(allowed)
}

fn sha256_of(path: &Path) -> std::io::Result<String> {
    let bytes = std::fs::read(path)?;
    Ok(Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect())
}
