//! A recipe or a plan made ready to run: read, compiled or verified, its models loaded.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use crate::plan::{self, Plan, PlanError, PlanFault, Tried, compile, corners, notes};
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

/// Longest plan that is read: that of a million frames.
const MAX_PLAN_BYTES: u64 = 1 << 32;

/// A plan as it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct GivenPlan<'a> {
    /// The file; `-` is standard input.
    pub path: &'a Path,
    /// Where its relative paths begin; its own folder without.
    pub base: Option<&'a Path>,
}

/// Everything a verb needs of a recipe or a plan.
pub struct Project {
    /// The recipe, where the project was not given as a plan.
    pub recipe: Option<Recipe>,
    /// Its text as given.
    pub recipe_text: Option<String>,
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
    /// Where relative paths begin.
    pub folder: PathBuf,
}

impl Project {
    /// Reads and compiles a recipe.
    ///
    /// # Errors
    /// The first fault, located; nothing has been written.
    pub fn load(given: &Given<'_>) -> Result<Self, PlanError> {
        let (recipe, includes) = Recipe::read_whole(given.path, given.outside)?;
        let text = std::fs::read_to_string(given.path).unwrap_or_default();
        Self::of_recipe(given, recipe, &includes, text)
    }

    /// Compiles a text that is to stand in the recipe's file.
    ///
    /// # Errors
    /// As [`Project::load`].
    pub fn load_text(given: &Given<'_>, text: &str) -> Result<Self, PlanError> {
        let (recipe, includes) = Recipe::parse_whole(given.path, text, given.outside)?;
        Self::of_recipe(given, recipe, &includes, text.to_owned())
    }

    fn of_recipe(
        given: &Given<'_>,
        mut recipe: Recipe,
        includes: &[Included],
        text: String,
    ) -> Result<Self, PlanError> {
        let Given { path, sets, .. } = *given;
        for set in sets {
            let (key, value) = split_set(set)?;
            recipe.set(key, value)?;
        }
        let recipe_dir = folder_of(path);
        let stem = path.file_stem().map_or_else(|| "dataset".into(), |stem| stem.to_string_lossy());
        let assets = AssetCache::new(&recipe_dir);
        let mut plan = compile(&recipe, &stem, &recipe_dir, &assets)?;
        plan.sets = sets.to_vec();
        let recipe_text = Some(text);
        let includes = includes.iter().map(include_lock).collect();
        let notes = notes(&recipe);
        Ok(Self { includes, recipe_text, notes, recipe: Some(recipe), ..Self::of(plan, assets, recipe_dir) })
    }

    /// Compiles the text of a recipe that is not in a file yet, as if it lay in a folder.
    ///
    /// # Errors
    /// The first fault, located in the text.
    pub fn of_text(name: &str, text: &str, folder: &Path) -> Result<Self, PlanError> {
        let recipe = Recipe::parse(name, text)?;
        let stem = name.strip_suffix(".yaml").unwrap_or(name);
        let assets = AssetCache::new(folder);
        let plan = compile(&recipe, stem, folder, &assets)?;
        let notes = notes(&recipe);
        let recipe_text = Some(text.to_owned());
        Ok(Self { recipe_text, notes, recipe: Some(recipe), ..Self::of(plan, assets, folder.to_owned()) })
    }

    /// Tries what could be drawn beside what is drawn; of a project that was given as a plan there is nothing to try.
    ///
    /// # Errors
    /// The first thing that would be refused, located in the recipe.
    pub fn try_corners(&self) -> Result<Tried, PlanError> {
        let recipe = self.recipe.as_ref();
        recipe.map_or(Ok(Tried::default()), |recipe| corners(recipe, &self.plan, &self.folder, &self.assets))
    }

    /// Reads and verifies a plan.
    ///
    /// # Errors
    /// The first fault, with its place in the plan; nothing has been written.
    pub fn load_plan(given: &GivenPlan<'_>) -> Result<Self, PlanError> {
        let GivenPlan { path, base } = *given;
        let from_input = path == Path::new("-");
        let name = if from_input { "standard input".to_owned() } else { path.display().to_string() };
        let json = match if from_input { bounded(io::stdin()) } else { File::open(path).and_then(bounded) } {
            Ok(json) => json,
            Err(error) => {
                let help = "give the plan.json of a dataset, or what `ensonify plan RECIPE --json` writes".to_owned();
                let problem = format!("cannot be read: {error}");
                return Err(PlanFault { file: name, place: String::new(), problem, help }.into());
            }
        };
        let folder = match base {
            Some(base) => base.to_owned(),
            None if from_input => PathBuf::from("."),
            None => folder_of(path),
        };
        let assets = AssetCache::new(&folder);
        let plan = plan::read(&name, &json, &folder, &assets)?;
        Ok(Self::of(plan, assets, folder))
    }

    fn of(plan: Plan, assets: AssetCache, folder: PathBuf) -> Self {
        let plan_json = plan.json();
        let plan_hash = Plan::hash(&plan_json);
        let (includes, notes) = (Vec::new(), Vec::new());
        Self { recipe: None, recipe_text: None, includes, plan, plan_json, plan_hash, notes, assets, folder }
    }
}

/// All that there is to read, unless it is without end.
fn bounded(mut source: impl io::Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.by_ref().take(1 << 10).read_to_end(&mut bytes)?;
    if !bytes.trim_ascii_start().starts_with(b"{") {
        return Err(io::Error::other("it does not begin as JSON does, with `{`"));
    }
    source.take(MAX_PLAN_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_PLAN_BYTES {
        return Err(io::Error::other(format!("it is longer than {MAX_PLAN_BYTES} bytes")));
    }
    Ok(bytes)
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
