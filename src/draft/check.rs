//! A draft held to what any recipe is held to, before anybody sees it.

use std::path::Path;

use crate::plan::{Plan, PlanError, Tried, compile, corners};
use crate::recipe::Recipe;
use crate::scene::AssetCache;

/// A recipe that can be run.
#[derive(Debug)]
pub struct Checked {
    /// Every scene and frame.
    pub plan: Plan,
    /// Ends of distributions and models that were tried.
    pub tried: Tried,
}

/// Parses and compiles a recipe's text as if it lay in a folder, and tries its corners.
///
/// # Errors
/// The first fault that `check` would find, located in the text.
pub fn checked(text: &str, folder: &Path) -> Result<Checked, PlanError> {
    let recipe = Recipe::parse("draft.yaml", text)?;
    let assets = AssetCache::new(folder);
    let plan = compile(&recipe, "draft", folder, &assets)?;
    let tried = corners(&recipe, &plan, folder, &assets)?;
    Ok(Checked { plan, tried })
}
