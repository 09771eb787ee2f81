//! A recipe made ready to run: read, compiled, its models loaded.

use std::path::{Path, PathBuf};

use crate::plan::{Plan, PlanError, compile, notes};
use crate::recipe::{self, Included, Outside, Recipe};
use crate::scene::AssetCache;
use crate::store::IncludeLock;

/// A recipe as it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a> {
    /// The file.
    pub path: &'a Path,
    /// Changes, `path=value`, in their order.
    pub sets: &'a [String],
    /// Whether it may include files from anywhere.
    pub outside: Outside,
}

/// Everything a verb needs of a recipe.
pub struct Project {
    /// The recipe as given.
    pub recipe_text: String,
    /// Files that it includes.
    pub includes: Vec<IncludeLock>,
    /// Every job.
    pub plan: Plan,
    /// The plan's JSON.
    pub plan_json: Vec<u8>,
    /// Hash of the plan.
    pub plan_hash: String,
    /// What a person should know of the recipe.
    pub notes: Vec<recipe::Error>,
    /// The models.
    pub assets: AssetCache,
}

impl Project {
    /// Reads and compiles a recipe.
    ///
    /// # Errors
    /// The first fault, located; nothing has been written.
    pub fn load(given: &Given<'_>) -> Result<Self, PlanError> {
        let Given { path, sets, outside } = *given;
        let (mut recipe, includes) = Recipe::read_whole(path, outside)?;
        for set in sets {
            let (key, value) = split_set(set)?;
            recipe.set(key, value)?;
        }
        let recipe_dir = folder_of(path);
        let stem = path.file_stem().map_or_else(|| "dataset".into(), |stem| stem.to_string_lossy());
        let assets = AssetCache::new(&recipe_dir);
        let mut plan = compile(&recipe, &stem, &recipe_dir, &assets)?;
        plan.sets = sets.to_vec();
        let plan_json = plan.json();
        let plan_hash = Plan::hash(&plan_json);
        let recipe_text = std::fs::read_to_string(path).unwrap_or_default();
        let includes = includes.iter().map(include_lock).collect();
        Ok(Self { recipe_text, includes, plan, plan_json, plan_hash, notes: notes(&recipe), assets })
    }
}

/// A file under the recipe, pinned by its content.
fn include_lock(included: &Included) -> IncludeLock {
    // A name from the root of a file system says nothing on another machine.
    let named = Path::new(&included.name);
    let name = if named.is_absolute() {
        named.file_name().unwrap_or_default().to_string_lossy()
    } else {
        named.to_string_lossy()
    };
    let bytes = std::fs::read(&included.path).unwrap_or_default();
    IncludeLock { name: name.into_owned(), sha256: Plan::hash(&bytes) }
}

/// Folder of a recipe: where its relative paths begin.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn split_set(set: &str) -> Result<(&str, &str), recipe::Error> {
    set.split_once('=').ok_or_else(|| {
        let place = recipe::Span::whole(&recipe::Source::new("--set", set, recipe::Origin::Given));
        recipe::Error::new(&place, "", format!("`{set}` has no `=`"), "write --set path=value, such as --set frames=5")
    })
}
