//! What could be drawn beside what is: every distribution at its ends, every model that a pick could give.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};

use super::compile::{Choice, Compiler, Files, variants};
use super::sections::{Sections, Turn};
use super::{AssetLock, Plan, PlanError, Split, SplitBy};
use crate::catalog::licence::Others;
use crate::catalog::{Catalog, Pick};
use crate::math::rng::Stream;
use crate::recipe::{Address, Corner, Draws, Level, Recipe};
use crate::scene::{AssetCache, SceneSpec};

/// Values looked at for all corners together: seconds.
const MOST_WORK: usize = 30_000_000;

/// What was tried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tried {
    /// Corners of distributions that were tried.
    pub corners: usize,
    /// Corners that there are, of all variants.
    pub corners_in_all: usize,
    /// Models that picks could give.
    pub models: usize,
}

/// Tries a compiled recipe's corners, one leaf at an end of its distribution and all others as they are drawn first, and
/// loads every model that could be picked. Of recipes with more corners than can be tried in seconds, an even share.
///
/// # Errors
/// The first thing that could be drawn and would be refused then, at its distribution; the first model that cannot be used,
/// at its pick.
pub fn corners(recipe: &Recipe, plan: &Plan, recipe_dir: &Path, assets: &AssetCache) -> Result<Tried, PlanError> {
    let (_, all) = variants(recipe)?;
    let mut tried = Tried::default();
    let mut seen = BTreeSet::new();
    for (number, variant) in all.iter().enumerate() {
        let sections = Sections::new(&variant.recipe, recipe_dir)?;
        let compiler = Compiler::new(sections, plan, number, Files { recipe_dir, assets });
        let locks = RefCell::new(plan.assets.clone());
        let trial = Trial { compiler, plan, assets, locks, models: RefCell::default() };
        trial.corners(MOST_WORK / all.len(), &mut tried)?;
        trial.models(&mut seen)?;
    }
    tried.models = seen.len();
    Ok(tried)
}

/// A model: its catalog's name and its uid.
type Model = (String, String);

/// A variant whose corners are tried, at its first scene, frame and instance.
struct Trial<'a> {
    compiler: Compiler<'a>,
    plan: &'a Plan,
    assets: &'a AssetCache,
    /// Of the models that were chosen so far, so that none is hashed twice.
    locks: RefCell<BTreeMap<String, AssetLock>>,
    /// What could be picked, with the first item of `objects` that could.
    models: RefCell<BTreeMap<Model, usize>>,
}

/// What a corner changes.
enum Part {
    World,
    Item(usize),
    Frame,
    /// A shared draw may stand everywhere.
    All,
}

impl Trial<'_> {
    fn corners(&self, most_work: usize, tried: &mut Tried) -> Result<(), PlanError> {
        for item in 0..self.compiler.sections.object_items()? {
            self.item(item, None)?;
        }
        let corners = self.all_corners()?;
        let work: usize = corners.iter().map(|(_, work)| work).sum();
        let step = work.div_ceil(most_work).max(1);
        tried.corners_in_all += corners.len();
        for (corner, _) in corners.iter().step_by(step) {
            tried.corners += 1;
            self.at(corner).map_err(|fault| match fault {
                PlanError::Recipe(fault) => corner.blame(fault).into(),
                other => other,
            })?;
        }
        Ok(())
    }

    /// Every corner with the number of values that are drawn to try it.
    fn all_corners(&self) -> Result<Vec<(Corner, usize)>, PlanError> {
        let Sections { lets, .. } = &self.compiler.sections;
        let [scene, frame] = [Level::Scene, Level::Frame(0)].map(|level| self.address(level));
        let parts = self.compiler.sections.parts(&lets.draw(&scene)?, &lets.draw(&frame)?)?;
        let whole: usize = parts.iter().map(|(_, node)| node.size()).sum();
        let mut shared = lets.corners(&scene)?;
        for corner in lets.corners(&frame)? {
            if !shared.contains(&corner) {
                shared.push(corner);
            }
        }
        let mut corners: Vec<(Corner, usize)> = shared.into_iter().map(|corner| (corner, whole)).collect();
        for (path, node) in &parts {
            corners.extend(node.corners(path)?.into_iter().map(|corner| (corner, node.size())));
        }
        Ok(corners)
    }

    fn at(&self, corner: &Corner) -> Result<(), PlanError> {
        let part = part_of(corner.path());
        if matches!(part, Part::World | Part::All) {
            self.world(corner)?;
        }
        if matches!(part, Part::Frame | Part::All) {
            self.frame(corner)?;
        }
        match part {
            Part::Item(item) => self.item(item, Some(corner)),
            Part::All => (0..self.compiler.sections.object_items()?).try_for_each(|i| self.item(i, Some(corner))),
            Part::World | Part::Frame => Ok(()),
        }
    }

    fn world(&self, corner: &Corner) -> Result<(), PlanError> {
        let address = self.address(Level::Scene);
        let shared = self.compiler.sections.lets.draw_at(&address, Some(corner))?;
        let turn = Turn { address, shared: &shared, corner: Some(corner) };
        let world = self.compiler.sections.world(&turn, &mut Draws::new())?;
        self.compiler.check_labels(&self.plan.header, world.environment.as_ref())?;
        let (seabed, environment, multipath) = (world.seabed, world.environment, world.multipath);
        let spec = SceneSpec { seabed, environment, multipath, bodies: Vec::new() };
        self.compiler.check(&spec, &mut self.locks.borrow_mut())
    }

    fn frame(&self, corner: &Corner) -> Result<(), PlanError> {
        let address = self.address(Level::Frame(0));
        let shared = self.compiler.sections.lets.draw_at(&address, Some(corner))?;
        self.compiler.sections.frame(&Turn { address, shared: &shared, corner: Some(corner) })?;
        Ok(())
    }

    /// The first instance of an item of `objects`, if there could be one.
    fn item(&self, item: usize, corner: Option<&Corner>) -> Result<(), PlanError> {
        let sections = &self.compiler.sections;
        let address = self.address(Level::Scene);
        let shared = sections.lets.draw_at(&address, corner)?;
        let turn = |level| Turn { address: self.address(level), shared: &shared, corner };
        if sections.count(item, &turn(Level::Scene), &mut Draws::new())? == 0 && !self.is_ever_there(item)? {
            return Ok(());
        }
        let entry = sections.object(item, &turn(Level::Instance(0)), &mut Draws::new())?;
        self.note(item, &entry.pick)?;
        for split in self.splits() {
            let mut stream = Stream::at(0, "corner", 0, "pick");
            let mut choice = Choice { stream: &mut stream, header: &self.plan.header, split };
            let locks = &mut self.locks.borrow_mut();
            let body = self.compiler.body([item as u64, 0], entry.clone(), &mut choice, locks)?;
            let spec = SceneSpec { bodies: vec![body], ..SceneSpec::default() };
            self.compiler.check(&spec, locks)?;
        }
        Ok(())
    }

    /// Whether an item's count can be above 0 at all.
    fn is_ever_there(&self, item: usize) -> Result<bool, PlanError> {
        let sections = &self.compiler.sections;
        let address = self.address(Level::Scene);
        let path = format!("objects[{item}].count");
        let shared = sections.lets.draw(&address)?;
        let counts = match sections.tree.at(&path) {
            Some(node) => shared.complete_into(node, &path)?.corners(&path)?,
            None => Vec::new(),
        };
        for corner in counts.iter().chain(&sections.lets.corners(&address)?) {
            let shared = sections.lets.draw_at(&address, Some(corner))?;
            let turn = Turn { address, shared: &shared, corner: Some(corner) };
            if sections.count(item, &turn, &mut Draws::new())? > 0 {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Splits that scenes of the plan are in, where that decides on models.
    fn splits(&self) -> BTreeSet<Split> {
        match self.plan.header.splits.by {
            SplitBy::Asset => self.plan.scenes.iter().map(|scene| scene.split).collect(),
            SplitBy::Scene | SplitBy::Variant => BTreeSet::from([Split::Train]),
        }
    }

    /// Notes what a pick could give.
    fn note(&self, item: usize, pick: &Pick) -> Result<(), PlanError> {
        let refuse = |fault| self.compiler.refuse(&format!("objects[{item}].pick"), &fault);
        let mut models = self.models.borrow_mut();
        for asset in self.assets.pick(pick).map_err(refuse)?.iter() {
            let policy = &self.plan.header.licences;
            let allowed = policy.check(&format!("{}/{}", pick.catalog, asset.uid), &asset.licence);
            match (allowed, policy.others) {
                (Ok(()), _) => {}
                (Err(_), Others::LeaveOut) => continue,
                (Err(fault), Others::Refuse) => {
                    return Err(self.compiler.refuse(&format!("objects[{item}].pick"), &fault));
                }
            }
            models.entry((pick.catalog.clone(), asset.uid.clone())).or_insert(item);
        }
        Ok(())
    }

    /// Loads what could be picked and was not looked at yet; nothing of it is kept.
    fn models(&self, seen: &mut BTreeSet<Model>) -> Result<(), PlanError> {
        let models = self.models.take();
        let fresh: Vec<(&Model, &usize)> = models.iter().filter(|(model, _)| !seen.contains(*model)).collect();
        let (plan, assets) = (self.plan, self.assets);
        let load = |((name, uid), item): (&Model, &usize)| {
            // Those of the plan were loaded when it was made.
            if plan.assets.contains_key(&format!("{name}/{uid}")) {
                return Ok(());
            }
            let of = |catalog: &Catalog| catalog.pick_uid(name, uid)?.scaled_model().map(|_| ());
            assets.catalog(name).and_then(|catalog| of(&catalog)).map_err(|fault| (*item, fault))
        };
        let loaded: Vec<Result<(), _>> = fresh.into_par_iter().map(load).collect();
        for outcome in loaded {
            outcome.map_err(|(item, fault)| self.compiler.refuse(&format!("objects[{item}].pick"), &fault))?;
        }
        seen.extend(models.into_keys());
        Ok(())
    }

    fn address(&self, level: Level) -> Address {
        self.compiler.address(0, level)
    }
}

/// What stands at a path of a recipe.
fn part_of(path: &str) -> Part {
    let item = |rest: &str| rest.split(']').next().and_then(|number| number.parse().ok());
    match path.split(['.', '[']).next() {
        Some("seabed" | "environment" | "multipath") => Part::World,
        Some("objects") => path.strip_prefix("objects[").and_then(item).map_or(Part::All, Part::Item),
        Some("sonar" | "water" | "image" | "trajectory") => Part::Frame,
        _ => Part::All,
    }
}
