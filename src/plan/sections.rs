//! Sections of a recipe as types: drawn, completed and checked, every fault located in the recipe.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::Look;
use super::header::{Header, Output, Splits};
use super::looks::{self, LookTree};
use crate::catalog::{LicencePolicy, Pick, sonars};
use crate::label::LabelSettings;
use crate::recipe::{self, Address, Corner, DEFAULTS, Draws, Lets, Level, Node, Origin, Recipe, Shared, Tree};
use crate::scene::{EnvironmentSpec, InView, Multipath, OnFailure, PoseSpec, SeabedSpec};
use crate::sonar::Sonar;
use crate::vehicle::{Trajectory, Vehicle};

/// Top-level keys of a recipe.
const KEYS: [&str; 21] = [
    "ensonify",
    "name",
    "seed",
    "scenes",
    "frames",
    "sonar",
    "water",
    "seabed",
    "environment",
    "multipath",
    "objects",
    "licences",
    "vehicle",
    "trajectory",
    "image",
    "looks",
    "labels",
    "splits",
    "output",
    "let",
    "sweep",
];

/// Sections that a sweep may vary: what differs from scene to scene or frame to frame.
pub(super) const SWEPT: [&str; 10] =
    ["let", "sonar", "water", "seabed", "environment", "multipath", "objects", "vehicle", "trajectory", "image"];

/// Keys and sections that are the same for all frames.
const CONSTANT: [&str; 8] = ["name", "seed", "scenes", "frames", "licences", "labels", "splits", "output"];

/// An item of `objects`, one instance of it drawn.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectEntry {
    /// Category in the annotations; the asset's own label without it.
    pub label: Option<String>,
    /// Which models may be taken.
    pub pick: Pick,
    /// How it lies.
    pub pose: PoseSpec,
    /// Free water to any other body, metres.
    pub clear_m: f64,
    /// Places tried.
    pub tries: u32,
    /// What becomes of it where there is no place.
    pub on_failure: OnFailure,
    /// From which frames it must be seen.
    pub in_view: Option<InView>,
}

/// A recipe made ready for drawing.
pub(super) struct Sections {
    /// With defaults.
    pub tree: Tree,
    /// What several leaves share.
    pub lets: Lets,
    /// The recipe as each look sees it; at least one.
    looks: Vec<LookTree>,
    /// The user's sonar section alone: device files go between it and the defaults.
    sonar: Node,
    sonar_defaults: Node,
    devices: std::cell::RefCell<BTreeMap<String, Node>>,
    recipe_dir: std::path::PathBuf,
}

/// Checks what can be checked without drawing everything: the form of distributions.
pub(super) struct Checker<'a> {
    pub tree: &'a Tree,
    lets: &'a Lets,
    seed: u64,
}

impl Checker<'_> {
    fn distributions(&self, path: &str, level: Level) -> Result<(), recipe::Error> {
        self.distributions_of(self.tree, path, level)
    }

    /// The distributions at a path of a tree, with shared draws as they come out first.
    pub fn distributions_of(&self, tree: &Tree, path: &str, level: Level) -> Result<(), recipe::Error> {
        let Some(node) = tree.at(path) else { return Ok(()) };
        let shared = self.lets.draw(&Address { seed: self.seed, scene: 0, level })?;
        shared.complete_into(node, path)?.check_distributions(path, level)
    }
}

/// What is drawn now: an address, the shared draws there, and a leaf that is at a corner instead.
#[derive(Clone, Copy)]
pub(super) struct Turn<'a> {
    pub address: Address,
    pub shared: &'a Shared,
    pub corner: Option<&'a Corner>,
}

impl Turn<'_> {
    /// A part of the recipe drawn: shared draws written in, then every leaf; and what was drawn.
    pub fn draw(&self, node: &Node, path: &str) -> Result<(Node, Draws), recipe::Error> {
        self.shared.complete_into(node, path)?.draw_at(path, &self.address, self.corner)
    }
}

/// What a scene is made of beside its objects.
pub(super) struct World {
    pub seabed: Option<SeabedSpec>,
    pub environment: Option<EnvironmentSpec>,
    pub multipath: Option<Multipath>,
}

/// The sections that may differ from frame to frame.
pub(super) struct FrameSections {
    pub sonar: Sonar,
    pub looks: Vec<Look>,
    pub vehicle: Vehicle,
    pub trajectory: Trajectory,
    pub drawn: Draws,
}

impl Sections {
    /// Checks what can be checked without drawing: version, keys, the form of every distribution.
    pub fn new(recipe: &Recipe, recipe_dir: &std::path::Path) -> Result<Self, recipe::Error> {
        let (recipe, lets) = recipe.with_constants()?;
        let tree = recipe.completed();
        tree.node().allow_keys("", &KEYS)?;
        for section in CONSTANT {
            tree.refuse_draws(section)?;
        }
        let seed: u64 = tree.section("seed")?.unwrap_or_default();
        let check = Checker { tree: &tree, lets: &lets, seed };
        for section in ["sonar", "water", "image", "vehicle", "trajectory"] {
            check.distributions(section, Level::Frame(0))?;
        }
        for section in ["seabed", "environment", "multipath"] {
            check.distributions(section, Level::Scene)?;
        }
        for i in 0..tree.at("objects").map_or(0, |objects| objects.items().len()) {
            check.distributions(&format!("objects[{i}]"), Level::Instance(0))?;
        }
        let Some(sonar) = recipe.node().get("sonar").cloned() else {
            let help = "write `sonar: {device: oculus-m1200d-lf, range_m: [0.5, 10]}`";
            return Err(tree.reject("", "the section `sonar` is missing", help));
        };
        if tree.at("seabed").is_none() && tree.at("environment").is_none() {
            let help = "write `seabed: {shape: flat, sediment: fine-sand}` or `environment: {glb: scene.glb, labels: by-node}`";
            return Err(tree.reject("", "a scene needs a section `seabed` or `environment`", help));
        }
        if tree.at("trajectory").is_none() {
            let help = "write for example `trajectory: {orbit: {radius_m: 5, altitude_m: 2}}`";
            return Err(tree.reject("", "the section `trajectory` is missing", help));
        }
        let looks = looks::read(&recipe, &check)?;
        let defaults = recipe::parse("defaults", DEFAULTS, Origin::BuiltIn)?;
        let sonar_defaults = defaults.get("sonar").cloned().unwrap_or_else(|| sonar.clone());
        let recipe_dir = recipe_dir.to_owned();
        Ok(Self { lets, looks, sonar, sonar_defaults, devices: std::cell::RefCell::default(), recipe_dir, tree })
    }

    /// What holds for the whole dataset of so many variants; `stem` names it where the recipe does not.
    pub fn header(&self, stem: &str, variants: u64) -> Result<Header, recipe::Error> {
        let name: Option<String> = self.tree.section("name")?;
        let header = Header {
            name: name.unwrap_or_else(|| stem.to_owned()),
            seed: self.required("seed")?,
            scenes: self.required("scenes")?,
            frames: self.required("frames")?,
            licences: self.required::<LicencePolicy>("licences")?,
            labels: self.required::<LabelSettings>("labels")?,
            splits: self.required::<Splits>("splits")?,
            output: self.required::<Output>("output")?,
        };
        header.check(variants).map_err(|fault| self.tree.reject(fault.key, &fault.problem, &fault.remedy))?;
        Ok(header)
    }

    fn required<T: serde::de::DeserializeOwned>(&self, key: &str) -> Result<T, recipe::Error> {
        let help = format!("write `{key}: …`");
        self.tree.section(key)?.ok_or_else(|| self.tree.reject("", &format!("the key `{key}` is missing"), &help))
    }

    /// What a scene is made of beside its objects.
    pub fn world(&self, turn: &Turn<'_>, drawn: &mut Draws) -> Result<World, recipe::Error> {
        let multipath: Option<Multipath> = self.drawn("multipath", turn, drawn)?;
        if let Some(Err(fault)) = multipath.as_ref().map(Multipath::validate) {
            return Err(self.tree.reject("multipath", &format!("{}: {}", fault.key, fault.problem), &fault.remedy));
        }
        let (seabed, environment) = (self.drawn("seabed", turn, drawn)?, self.drawn("environment", turn, drawn)?);
        Ok(World { seabed, environment, multipath })
    }

    /// The sections of one frame.
    pub fn frame(&self, turn: &Turn<'_>) -> Result<FrameSections, recipe::Error> {
        let mut drawn = Draws::new();
        let sonar = self.sonar(turn, &mut drawn)?;
        let looks = self.looks.iter().map(|look| look.draw(turn, &mut drawn)).collect::<Result<_, _>>()?;
        let trajectory: Trajectory = self.present("trajectory", turn, &mut drawn)?;
        let section = format!("trajectory.{}", trajectory.kind());
        trajectory.check().map_err(|fault| looks::impossible(&self.tree, &section, &fault))?;
        let vehicle: Vehicle = self.present("vehicle", turn, &mut drawn)?;
        vehicle.validate().map_err(|fault| looks::impossible(&self.tree, "vehicle", &fault))?;
        Ok(FrameSections { sonar, looks, vehicle, trajectory, drawn })
    }

    /// The sonar: the user's keys over the device's over the defaults.
    fn sonar(&self, turn: &Turn<'_>, drawn: &mut Draws) -> Result<Sonar, recipe::Error> {
        // Without defaults: those of the device come first.
        let user = turn.shared.write_into(&self.sonar, "sonar")?;
        let (user, draws) = user.draw_at("sonar", &turn.address, turn.corner)?;
        drawn.extend(draws);
        let under = match user.get("device") {
            Some(device) => self.device(device)?.merged_over(&self.sonar_defaults),
            None => self.sonar_defaults.clone(),
        };
        let sonar: Sonar = user.merged_over(&under).to("sonar")?;
        sonar.validate().map_err(|fault| looks::impossible(&self.tree, "sonar", &fault))?;
        Ok(sonar)
    }

    /// A device file: built in, or a YAML file named relative to the recipe.
    fn device(&self, node: &Node) -> Result<Node, recipe::Error> {
        let Some(name) = node.text() else {
            return Err(node.error("", "a device is named by a word", "write for example `device: oculus-m1200d-lf`"));
        };
        if let Some(known) = self.devices.borrow().get(name) {
            return Ok(known.clone());
        }
        let tree = if let Some(text) = sonars::find(name) {
            recipe::parse(&format!("catalogs/sonars/{name}.yaml"), text, Origin::BuiltIn)?
        } else if name.ends_with(".yaml") || name.ends_with(".yml") {
            recipe::read(&self.recipe_dir.join(name))?
        } else {
            let names: Vec<&str> = sonars::DEVICES.iter().map(|(name, _)| *name).collect();
            let help = recipe::did_you_mean(name, &names);
            return Err(self.tree.reject("sonar.device", &format!("there is no device `{name}`"), &help));
        };
        self.devices.borrow_mut().insert(name.to_owned(), tree.clone());
        Ok(tree)
    }

    /// How many instances an item of `objects` has in a scene.
    pub fn count(&self, item: usize, turn: &Turn<'_>, drawn: &mut Draws) -> Result<u32, recipe::Error> {
        let path = format!("objects[{item}].count");
        let count: u32 = self.present(&path, turn, drawn)?;
        if count > 1000 {
            return Err(self.tree.reject(&path, &format!("{count} of one object are too many"), "write at most 1000"));
        }
        Ok(count)
    }

    /// One instance of an item of `objects`.
    pub fn object(&self, item: usize, turn: &Turn<'_>, drawn: &mut Draws) -> Result<ObjectEntry, recipe::Error> {
        let path = format!("objects[{item}]");
        let Some(node) = self.tree.at(&path) else {
            return Err(self.tree.reject("objects", &format!("there is no item {item}"), ""));
        };
        let node = turn.shared.complete_into(node, &path)?;
        let (node, draws) = without(&node, "count").draw_at(&path, &turn.address, turn.corner)?;
        let Level::Instance(instance) = turn.address.level else { unreachable!("objects are drawn by instance") };
        let named = |(leaf, value): (String, _)| {
            (format!("{path}#{instance}{}", leaf.strip_prefix(&path).unwrap_or_default()), value)
        };
        drawn.extend(draws.into_iter().map(named));
        node.to(&path)
    }

    /// Every part that is drawn for frames, scenes and instances, with its path: where distributions may stand. A part is
    /// as it is drawn from, shared draws written in.
    pub fn parts(&self, scene: &Shared, frame: &Shared) -> Result<Vec<(String, Node)>, recipe::Error> {
        let mut parts = vec![("sonar".to_owned(), frame.write_into(&self.sonar, "sonar")?)];
        let mut add = |tree: &Tree, path: &str, shared: &Shared| -> Result<(), recipe::Error> {
            if let Some(node) = tree.at(path) {
                let part = (path.to_owned(), shared.complete_into(node, path)?);
                // Looks share what they do not change.
                if !parts.contains(&part) {
                    parts.push(part);
                }
            }
            Ok(())
        };
        add(&self.tree, "trajectory", frame)?;
        for path in ["seabed", "environment", "multipath"] {
            add(&self.tree, path, scene)?;
        }
        for item in 0..self.object_items()? {
            add(&self.tree, &format!("objects[{item}]"), scene)?;
        }
        for (look, path) in self.looks.iter().flat_map(|look| looks::SECTIONS.map(|path| (look, path))) {
            add(&look.tree, path, frame)?;
        }
        Ok(parts)
    }

    /// The recipe as a look sees it.
    pub fn look(&self, name: &str) -> Option<&Tree> {
        self.looks.iter().find(|look| look.name.as_deref() == Some(name)).map(|look| &look.tree)
    }

    /// How many items `objects` has.
    pub fn object_items(&self) -> Result<usize, recipe::Error> {
        let Some(node) = self.tree.at("objects") else { return Ok(0) };
        match node.kind {
            recipe::Kind::Seq(ref items) => Ok(items.len()),
            recipe::Kind::Null => Ok(0),
            _ => Err(self.tree.reject("objects", "`objects` is a list", "begin each object with `- pick: …`")),
        }
    }

    fn drawn<T: serde::de::DeserializeOwned>(
        &self,
        path: &str,
        turn: &Turn<'_>,
        drawn: &mut Draws,
    ) -> Result<Option<T>, recipe::Error> {
        let Some(node) = self.tree.at(path) else { return Ok(None) };
        let (node, draws) = turn.draw(node, path)?;
        drawn.extend(draws);
        node.to(path).map(Some)
    }

    fn present<T: serde::de::DeserializeOwned>(
        &self,
        path: &str,
        turn: &Turn<'_>,
        drawn: &mut Draws,
    ) -> Result<T, recipe::Error> {
        let message = format!("`{path}` is missing");
        self.drawn(path, turn, drawn)?.ok_or_else(|| self.tree.reject("", &message, ""))
    }
}

/// A map without one of its keys.
fn without(node: &Node, key: &str) -> Node {
    let entries = node.entries().iter().filter(|(name, _)| name.text != key).cloned();
    match node.kind {
        recipe::Kind::Map(_) => Node { kind: recipe::Kind::Map(entries.collect()), span: node.span.clone() },
        _ => node.clone(),
    }
}
