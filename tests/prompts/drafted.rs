//! A drafted recipe, made ready to run, and what stands in its plan: read from the plan's JSON, as other programs would.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use ensonify::catalog::{Asset, Catalog, find_catalog};
use ensonify::recipe::Outside;
use ensonify::run::{Given, Project, World, spread};
use serde_json::Value;

use crate::expected::Vocabulary;

/// Worlds that are built, and frames of each that are looked at, where a plan alone does not tell.
const WORLDS: usize = 2;
const FRAMES: u64 = 24;

/// A recipe that is valid.
pub struct Drafted {
    project: Project,
    plan: Value,
    models: BTreeMap<(String, String), Asset>,
    views: OnceCell<Vec<View>>,
}

/// An object of a scene.
pub struct Body<'a> {
    pub label: &'a str,
    pub model: Option<&'a Asset>,
    /// Kind of its pose, and its parameters.
    pub pose: (&'a str, &'a Value),
}

/// Where a vehicle is in a world that was built.
pub struct View {
    pub vehicle: [f64; 3],
    pub ground_m: f64,
    /// Of every object: label, model (`catalog/uid`), middle.
    pub bodies: Vec<(String, String, [f64; 3])>,
    /// Depth of the water.
    pub depth_m: f64,
}

impl Drafted {
    /// Reads, compiles and tries a recipe, as `check` does.
    pub fn load(path: &Path) -> Result<Self, String> {
        let given = Given { path, sets: &[], outside: Outside::Refused };
        let project = Project::load(&given).map_err(|error| error.to_string())?;
        project.try_corners().map_err(|error| error.to_string())?;
        let plan: Value = serde_json::from_slice(&project.plan_json).map_err(|error| error.to_string())?;
        let models = models(&plan, &project.folder)?;
        Ok(Self { project, plan, models, views: OnceCell::new() })
    }

    /// The value at a pointer into the plan.
    pub fn at(&self, pointer: &str) -> &Value {
        self.plan.pointer(pointer).unwrap_or(&Value::Null)
    }

    pub fn scenes(&self) -> &[Value] {
        items(self.at("/scenes"))
    }

    pub fn jobs(&self) -> &[Value] {
        items(self.at("/jobs"))
    }

    pub fn variants(&self) -> usize {
        items(self.at("/variants")).len().max(1)
    }

    pub fn looks(&self) -> usize {
        self.jobs().first().map_or(0, |job| items(&job["looks"]).len())
    }

    /// What stands at a pointer in every frame, one value a world, or more where it changes from frame to frame.
    pub fn of_jobs(&self, pointer: &str) -> Vec<&Value> {
        self.gather(|job| vec![job.pointer(pointer).unwrap_or(&Value::Null)])
    }

    /// The same of every look.
    pub fn of_looks(&self, pointer: &str) -> Vec<&Value> {
        self.gather(|job| {
            items(&job["looks"]).iter().map(|look| look.pointer(pointer).unwrap_or(&Value::Null)).collect()
        })
    }

    fn gather<'a>(&'a self, of: impl Fn(&'a Value) -> Vec<&'a Value>) -> Vec<&'a Value> {
        let frames = self.at("/frames_per_scene").as_u64().unwrap_or(1).max(1) as usize;
        let mut found = Vec::new();
        for world in self.jobs().chunks(frames) {
            let mut here: Vec<&Value> = Vec::new();
            for value in world.iter().flat_map(&of) {
                if !here.contains(&value) {
                    here.push(value);
                }
            }
            found.extend(here);
        }
        found
    }

    /// What stands at a pointer in every scene's `spec`.
    pub fn of_scenes(&self, pointer: &str) -> Vec<&Value> {
        self.scenes().iter().map(|scene| scene["spec"].pointer(pointer).unwrap_or(&Value::Null)).collect()
    }

    pub fn bodies<'a>(&'a self, scene: &'a Value) -> impl Iterator<Item = Body<'a>> {
        items(&scene["spec"]["bodies"]).iter().map(|body| {
            let key = (text(&body["catalog"]).to_owned(), text(&body["uid"]).to_owned());
            Body { label: text(&body["label"]), model: self.models.get(&key), pose: kind(&body["pose"]) }
        })
    }

    /// Whether an object is what a word says.
    pub fn is(&self, body: &Body<'_>, word: &str, words: &Vocabulary) -> bool {
        is(body.label, body.model, word, words)
    }

    /// The same of an object in a world that was built, by label and `catalog/uid`.
    pub fn is_built(&self, label: &str, asset: &str, word: &str, words: &Vocabulary) -> bool {
        let key = asset.split_once('/').map(|(catalog, uid)| (catalog.to_owned(), uid.to_owned()));
        is(label, key.and_then(|key| self.models.get(&key)), word, words)
    }

    /// Some frames of some worlds, built.
    pub fn views(&self) -> &[View] {
        self.views.get_or_init(|| {
            let worlds = spread(self.project.plan.scenes.len() as u64, WORLDS as u64);
            worlds.into_iter().flat_map(|number| self.views_of(number as usize)).collect()
        })
    }

    fn views_of(&self, number: usize) -> Vec<View> {
        let plan = &self.project.plan;
        let world = World::build(plan, number, &self.project.assets).expect("a recipe that passed its check");
        let jobs = plan.jobs_of(number);
        let view = |index: u64| {
            let job = &jobs[index as usize];
            let position = world.station(&plan.header, job).expect("a way without files").pose.position;
            let bodies = world.scene().bodies.iter();
            View {
                vehicle: position.to_array(),
                ground_m: world.built().ground.height(position.x, position.y),
                bodies: bodies.map(|body| (body.label.clone(), body.asset.clone(), body.centre.to_array())).collect(),
                depth_m: job.looks[0].water.water.depth_m,
            }
        };
        spread(jobs.len() as u64, FRAMES).into_iter().map(view).collect()
    }
}

fn is(label: &str, model: Option<&Asset>, word: &str, words: &Vocabulary) -> bool {
    let also = words.things.get(word).map(Vec::as_slice).unwrap_or_default();
    let called = |name: &str| word == "anything" || name == word || also.iter().any(|other| other == name);
    let in_group =
        |asset: &Asset| words.groups.iter().any(|group| group == word) && asset.tags.iter().any(|tag| tag == word);
    called(label) || model.is_some_and(|asset| called(&asset.label) || called(&asset.uid) || in_group(asset))
}

/// Every model that the scenes of a plan name.
fn models(plan: &Value, folder: &Path) -> Result<BTreeMap<(String, String), Asset>, String> {
    let bodies = items(&plan["scenes"]).iter().flat_map(|scene| items(&scene["spec"]["bodies"]));
    let named: BTreeSet<(String, String)> =
        bodies.map(|body| (text(&body["catalog"]).to_owned(), text(&body["uid"]).to_owned())).collect();
    let mut catalogs: BTreeMap<String, Catalog> = BTreeMap::new();
    let mut found = BTreeMap::new();
    for (catalog, uid) in named {
        if !catalogs.contains_key(&catalog) {
            let folder = find_catalog(&catalog, folder).map_err(|error| error.to_string())?;
            catalogs.insert(catalog.clone(), Catalog::open(&folder).map_err(|error| error.to_string())?);
        }
        if let Some(asset) = catalogs[&catalog].get(&uid).map_err(|error| error.to_string())? {
            found.insert((catalog, uid), asset);
        }
    }
    Ok(found)
}

pub fn items(value: &Value) -> &[Value] {
    value.as_array().map(Vec::as_slice).unwrap_or_default()
}

pub fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

/// A kind as it stands in a plan: `ripples`, or `{ripples: {…}}`.
pub fn kind(value: &Value) -> (&str, &Value) {
    match value {
        Value::Object(map) => map.iter().next().map_or(("", &Value::Null), |(name, of)| (name.as_str(), of)),
        other => (text(other), &Value::Null),
    }
}
