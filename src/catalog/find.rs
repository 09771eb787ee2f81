//! Finding a catalog's folder by name.

use std::path::{Path, PathBuf};

use super::disk::DiskIndex;
use super::error::CatalogError;
use super::index::INDEX;

/// The folder of a catalog: `name` as a path from the recipe's folder, else `catalogs/name` in the recipe's folder and
/// its ancestors, in the current folder, and in the ancestors of this program's file.
///
/// # Errors
/// [`CatalogError::NotFound`] with every folder that was looked into.
pub fn find_catalog(name: &str, recipe_dir: &Path) -> Result<PathBuf, CatalogError> {
    let program = std::env::current_exe().ok();
    let mut looked: Vec<PathBuf> = Vec::new();
    let direct = std::iter::once(recipe_dir.join(name));
    let beside_recipe = absolute(recipe_dir);
    let named = beside_recipe.ancestors().chain(std::iter::once(Path::new("")));
    let named = named.chain(program.iter().flat_map(|file| file.ancestors().skip(1)));
    for folder in direct.chain(named.map(|folder| folder.join("catalogs").join(name))) {
        if folder.join(INDEX).is_file() || DiskIndex::is_in(&folder) {
            return Ok(folder);
        }
        if !looked.contains(&folder) {
            looked.push(folder);
        }
    }
    let looked = looked.iter().map(|folder| folder.display().to_string()).collect::<Vec<_>>().join(", ");
    Err(CatalogError::NotFound { name: name.into(), looked })
}

/// Every catalog by name: under `catalogs` of a folder and its ancestors, and of the ancestors of this program's file. Of
/// two with one name the first is taken.
#[must_use]
pub fn catalogs_near(dir: &Path) -> Vec<(String, PathBuf)> {
    let program = std::env::current_exe().ok();
    let here = absolute(dir);
    let folders = here.ancestors().chain(program.iter().flat_map(|file| file.ancestors().skip(1)));
    let mut found: Vec<(String, PathBuf)> = Vec::new();
    for folder in folders.map(|folder| folder.join("catalogs")) {
        let mut inside: Vec<PathBuf> =
            folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path()).collect();
        inside.sort();
        for catalog in inside.into_iter().filter(|dir| dir.join(INDEX).is_file() || DiskIndex::is_in(dir)) {
            let name = catalog.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if !found.iter().any(|(known, _)| *known == name) {
                found.push((name, catalog));
            }
        }
    }
    found
}

/// A relative folder has no ancestors to climb.
fn absolute(folder: &Path) -> PathBuf {
    std::path::absolute(if folder.as_os_str().is_empty() { Path::new(".") } else { folder })
        .unwrap_or_else(|_| folder.to_path_buf())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_path_comes_before_a_name_and_a_name_climbs() {
        let root = tempfile::tempdir().expect("a temporary folder");
        let recipes = root.path().join("deep/recipes");
        for folder in ["deep/recipes/mine", "catalogs/mine", "catalogs/other"] {
            fs::create_dir_all(root.path().join(folder)).expect("folders");
            fs::write(root.path().join(folder).join(INDEX), "").expect("write");
        }
        assert_eq!(find_catalog("mine", &recipes).expect("found"), recipes.join("mine"));
        assert_eq!(find_catalog("other", &recipes).expect("found"), root.path().join("catalogs/other"));
        assert!(find_catalog("../../catalogs/other", &recipes).expect("found").join(INDEX).exists());
        let error = find_catalog("none", &recipes).expect_err("not there").to_string();
        assert!(error.contains("`none`") && error.contains("deep/recipes/catalogs/none"), "{error}");
    }
}
