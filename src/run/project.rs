//! A recipe made ready to run: read, compiled, its models loaded.

use std::path::{Path, PathBuf};

use crate::plan::{Plan, PlanError, compile, notes};
use crate::recipe::{self, Recipe};
use crate::scene::AssetCache;

/// Everything a verb needs of a recipe.
pub struct Project {
    /// The recipe as given.
    pub recipe_text: String,
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
    /// Reads and compiles a recipe with `--set` changes (`path=value`) laid over it.
    ///
    /// # Errors
    /// The first fault, located; nothing has been written.
    pub fn load(path: &Path, sets: &[String]) -> Result<Self, PlanError> {
        let mut recipe = Recipe::read(path)?;
        for set in sets {
            let (key, value) = split_set(set)?;
            recipe.set(key, value)?;
        }
        let recipe_dir = folder_of(path);
        let stem = path.file_stem().map_or_else(|| "dataset".into(), |stem| stem.to_string_lossy());
        let assets = AssetCache::new(&recipe_dir);
        let plan = compile(&recipe, &stem, &recipe_dir, &assets)?;
        let plan_json = plan.json();
        let plan_hash = Plan::hash(&plan_json);
        let mut recipe_text = std::fs::read_to_string(path).unwrap_or_default();
        for set in sets {
            recipe_text.push_str(&format!("\n# --set {}", set.replace('\n', " ")));
        }
        Ok(Self { recipe_text, plan, plan_json, plan_hash, notes: notes(&recipe), assets })
    }
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
