//! Whether a plan that was read can be rendered: held to what compiling a recipe guarantees.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use super::looks::{MOST, is_name};
use super::{AssetLock, Job, Plan, PlanFault, ScenePlan};
use crate::catalog::{CatalogError, materials};
use crate::math::Impossible;
use crate::recipe::MAX_VARIANTS;
use crate::scene::{AssetCache, SceneError, SceneSpec};
use crate::vehicle::Trajectory;

/// What to do about numbers that contradict each other.
const AS_WRITTEN: &str = "plans count as `ensonify plan RECIPE --json` writes them";
/// What to do about a file that is not found.
const BASE: &str = "relative paths begin at the plan's folder; `--base DIR` names another, such as the recipe's";

/// What verifying takes beside the plan.
pub(super) struct Verifier<'a> {
    /// Of the plan, for messages.
    pub name: &'a str,
    /// Where relative paths begin.
    pub folder: &'a Path,
    pub assets: &'a AssetCache,
}

impl Verifier<'_> {
    /// The plan with the hashes of all that its scenes use.
    pub fn verified(&self, mut plan: Plan) -> Result<Plan, PlanFault> {
        self.variants(&plan)?;
        let variants = plan.variants.len().max(1) as u64;
        plan.header.check(variants).map_err(|fault| self.impossible("", &fault))?;
        self.count("scenes", plan.scenes.len(), plan.header.scenes * variants)?;
        self.count("jobs", plan.jobs.len(), plan.header.scenes * plan.header.frames * variants)?;
        let mut used = BTreeMap::new();
        for (number, scene) in plan.scenes.iter().enumerate() {
            self.scene(&plan, number, scene)?;
            self.lock(&plan, number, &scene.spec, &mut used)?;
        }
        for (number, job) in plan.jobs.iter().enumerate() {
            self.job(&plan, number, job)?;
            self.poses(&plan, number, job, &mut used)?;
        }
        plan.assets = used;
        Ok(plan)
    }

    /// Their names stand in file names.
    fn variants(&self, plan: &Plan) -> Result<(), PlanFault> {
        if plan.variants.len() > MAX_VARIANTS {
            let problem = format!("there are {} variants, more than {MAX_VARIANTS}", plan.variants.len());
            return Err(self.fault("variants", problem, "make several datasets"));
        }
        for (number, variant) in plan.variants.iter().enumerate() {
            self.same(&format!("variants[{number}].id"), &variant.id, &format!("v{number:03}"))?;
        }
        Ok(())
    }

    fn count(&self, place: &str, found: usize, expected: u64) -> Result<(), PlanFault> {
        if found as u64 == expected {
            return Ok(());
        }
        let problem = format!("there are {found} {place}, but the plan's counts ask for {expected}");
        Err(self.fault(place, problem, "set scenes_per_variant and frames_per_scene to what is there"))
    }

    fn scene(&self, plan: &Plan, number: usize, scene: &ScenePlan) -> Result<(), PlanFault> {
        let at = |key: &str| format!("scenes[{number}].{key}");
        let (variant, index) = (number as u64 / plan.header.scenes, number as u64 % plan.header.scenes);
        let variant = plan.variants.get(variant as usize);
        self.same(&at("variant"), &scene.variant.as_deref(), &variant.map(|variant| variant.id.as_str()))?;
        self.same(&at("index"), &scene.index, &index)?;
        self.same(&at("seed"), &scene.seed, &variant.map_or(plan.header.seed, |variant| variant.seed))?;
        let spec = &scene.spec;
        if spec.seabed.is_none() && spec.environment.is_none() {
            let problem = "a scene needs a seabed or an environment";
            return Err(self.fault(&at("spec"), problem, AS_WRITTEN));
        }
        if let Some(multipath) = &spec.multipath {
            multipath.validate().map_err(|fault| self.impossible(&at("spec.multipath"), &fault))?;
        }
        if let Some(environment) = &spec.environment {
            let place = at("spec.environment.sediment");
            materials::sediment(&environment.sediment).map_err(|fault| self.message(&place, &fault))?;
        }
        spec.check(self.assets).map_err(|fault| match &fault {
            SceneError::Seabed(_) => self.message(&at("spec.seabed"), &fault),
            SceneError::Environment(_) => self.message(&at("spec.environment"), &fault),
            SceneError::Body { body, problem, .. } => self.message(&at(&format!("spec.bodies[{body}].pose")), problem),
            SceneError::Catalog(problem) => self.unusable(&at("spec"), problem),
            SceneError::TooManyBodies { .. } | SceneError::Track(_) => self.message(&at("spec"), &fault),
        })
    }

    /// Holds what a scene uses against the plan's hashes and notes it in `used`.
    fn lock(
        &self,
        plan: &Plan,
        number: usize,
        spec: &SceneSpec,
        used: &mut BTreeMap<String, AssetLock>,
    ) -> Result<(), PlanFault> {
        for (i, body) in spec.bodies.iter().enumerate() {
            let key = format!("{}/{}", body.catalog, body.uid);
            if used.contains_key(&key) {
                continue;
            }
            let place = format!("scenes[{number}].spec.bodies[{i}]");
            let unusable = |fault: CatalogError| self.unusable(&place, &fault);
            let catalog = self.assets.catalog(&body.catalog).map_err(unusable)?;
            let asset = catalog.pick_uid(&body.catalog, &body.uid).map_err(unusable)?;
            let found = AssetLock::of_model(&asset).map_err(|error| self.unreadable(&place, &asset.path, &error))?;
            let lock = self.held(plan, &key, found)?;
            plan.header.licences.check(&key, &lock.licence).map_err(|fault| self.message(&place, &fault))?;
            used.insert(key, lock);
        }
        let seabed = spec.seabed.as_ref().and_then(|seabed| seabed.file()).map(|file| ("seabed", file));
        let glb = spec.environment.as_ref().and_then(|environment| environment.glb.as_deref());
        for (section, file) in seabed.into_iter().chain(glb.map(|file| ("environment", file))) {
            let key = format!("{section}/{file}");
            if used.contains_key(&key) {
                continue;
            }
            let place = format!("scenes[{number}].spec.{section}");
            let found = AssetLock::of_file(self.folder, file)
                .map_err(|error| self.unreadable(&place, &self.folder.join(file), &error))?;
            let lock = self.held(plan, &key, found)?;
            used.insert(key, lock);
        }
        Ok(())
    }

    /// Reads the file of poses that a job takes and holds it against the plan's hash.
    fn poses(
        &self,
        plan: &Plan,
        number: usize,
        job: &Job,
        used: &mut BTreeMap<String, AssetLock>,
    ) -> Result<(), PlanFault> {
        let Trajectory::Poses(poses) = &job.trajectory else { return Ok(()) };
        let place = format!("jobs[{number}].trajectory.poses.file");
        let track = self.assets.tracks().get(&poses.file).map_err(|fault| self.message(&place, &fault))?;
        let (rows, least) = (track.rows(), poses.least_rows(plan.header.frames));
        if rows < least {
            let problem = format!("{} has too few rows, {rows} of {least}", poses.file);
            return Err(self.fault(&place, problem, "add rows or ask for fewer frames"));
        }
        let key = format!("trajectory/{}", poses.file);
        if used.contains_key(&key) {
            return Ok(());
        }
        let path = self.folder.join(&poses.file);
        let found =
            AssetLock::of_file(self.folder, &poses.file).map_err(|error| self.unreadable(&place, &path, &error))?;
        let lock = self.held(plan, &key, found)?;
        used.insert(key, lock);
        Ok(())
    }

    /// The plan's own word about a file, if it has one and the file is still the same.
    fn held(&self, plan: &Plan, key: &str, found: AssetLock) -> Result<AssetLock, PlanFault> {
        let Some(planned) = plan.assets.get(key) else { return Ok(found) };
        let changed = if planned.sha256 != found.sha256 {
            format!("the file has changed: its SHA-256 is {}, planned was {}", found.sha256, planned.sha256)
        } else if planned.shown != found.shown {
            "size_m, up or material in its catalog have changed".to_owned()
        } else {
            return Ok(planned.clone());
        };
        let help = "bring back what was planned, or remove this entry to take what is there";
        Err(self.fault(&format!("assets[{key:?}]"), format!("{key}: {changed}"), help))
    }

    fn job(&self, plan: &Plan, number: usize, job: &Job) -> Result<(), PlanFault> {
        let at = |key: &str| format!("jobs[{number}].{key}");
        let scene = &plan.scenes[number / plan.header.frames as usize];
        self.same(&at("id"), &job.id, &(number as u64))?;
        self.same(&at("variant"), &job.variant, &scene.variant)?;
        self.same(&at("scene"), &job.scene, &scene.index)?;
        self.same(&at("frame"), &job.frame, &(number as u64 % plan.header.frames))?;
        self.same(&at("split"), &job.split, &scene.split)?;
        job.sonar.validate().map_err(|fault| self.impossible(&at("sonar"), &fault))?;
        job.vehicle.validate().map_err(|fault| self.impossible(&at("vehicle"), &fault))?;
        let section = at(&format!("trajectory.{}", job.trajectory.kind()));
        job.trajectory.check().map_err(|fault| self.impossible(&section, &fault))?;
        self.looks(plan, number, job)?;
        for (i, look) in job.looks.iter().enumerate() {
            let at = |section: &str| at(&format!("looks[{i}].{section}"));
            look.water.validate().map_err(|fault| self.impossible(&at("water"), &fault))?;
            look.image.validate().map_err(|fault| self.impossible(&at("image"), &fault))?;
        }
        Ok(())
    }

    /// The looks of a frame: those of the first frame, each with a name of its own unless there is but one.
    fn looks(&self, plan: &Plan, number: usize, job: &Job) -> Result<(), PlanFault> {
        let place = format!("jobs[{number}].looks");
        let names = |job: &Job| job.looks.iter().map(|look| look.name.clone()).collect::<Vec<_>>();
        let ours = names(job);
        if !(1..=MOST).contains(&ours.len()) {
            return Err(self.fault(&place, format!("there are {} looks", ours.len()), "a frame has 1 to 64 looks"));
        }
        if ours != names(&plan.jobs[0]) {
            return Err(self.fault(&place, "frames have different looks", "give all frames the looks of the first"));
        }
        if number > 0 || ours == [None] {
            return Ok(());
        }
        let twice = |i: usize| ours[..i].contains(&ours[i]);
        match (0..ours.len()).find(|&i| twice(i) || !ours[i].as_deref().is_some_and(is_name)) {
            Some(i) => {
                let help = "name each once, with letters, digits and `-`; a single look may be without a name";
                let problem = format!("`{}` cannot name a look here", ours[i].as_deref().unwrap_or_default());
                Err(self.fault(&format!("{place}[{i}].name"), problem, help))
            }
            None => Ok(()),
        }
    }

    fn same<T: PartialEq + Serialize>(&self, place: &str, found: &T, expected: &T) -> Result<(), PlanFault> {
        if found == expected {
            return Ok(());
        }
        let (found, expected) = (serde_json::json!(found), serde_json::json!(expected));
        Err(self.fault(place, format!("{found} stands where {expected} belongs"), AS_WRITTEN))
    }

    fn impossible(&self, section: &str, fault: &Impossible) -> PlanFault {
        let key = match fault.key {
            "scenes" => "scenes_per_variant",
            "frames" => "frames_per_scene",
            other => other,
        };
        let place = if section.is_empty() { key.to_owned() } else { format!("{section}.{key}") };
        self.fault(&place, fault.problem.clone(), &fault.remedy)
    }

    fn unreadable(&self, place: &str, path: &Path, error: &std::io::Error) -> PlanFault {
        self.fault(place, format!("{} cannot be read: {error}", path.display()), BASE)
    }

    fn unusable(&self, place: &str, fault: &CatalogError) -> PlanFault {
        let help = match fault {
            CatalogError::NotFound { .. } | CatalogError::Unreadable { .. } | CatalogError::Model { .. } => BASE,
            _ => "",
        };
        self.fault(place, fault.to_string(), help)
    }

    /// A fault whose message carries its own remedy.
    fn message(&self, place: &str, fault: &dyn std::fmt::Display) -> PlanFault {
        self.fault(place, fault.to_string(), "")
    }

    fn fault(&self, place: &str, problem: impl Into<String>, help: &str) -> PlanFault {
        PlanFault {
            file: self.name.to_owned(),
            place: place.to_owned(),
            problem: problem.into(),
            help: help.to_owned(),
        }
    }
}
