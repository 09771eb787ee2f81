//! The model files below a folder.

use std::path::{Path, PathBuf};

use crate::catalog::error::CatalogError;
use crate::catalog::paths;

/// Deepest folder that is looked into.
const DEEPEST: usize = 12;

/// What lies below a folder.
#[derive(Debug, Default)]
pub struct Scanned {
    /// Models in the order of their paths.
    pub files: Vec<PathBuf>,
    /// What was not looked at, and why.
    pub refused: Vec<String>,
}

/// Every `.glb` and `.gltf` below a folder; hidden ones and links out of it are left out.
///
/// # Errors
/// If a folder cannot be read.
pub fn models(root: &Path) -> Result<Scanned, CatalogError> {
    let mut scanned = Scanned::default();
    walk(root, root, 0, &mut scanned)?;
    scanned.files.sort();
    Ok(scanned)
}

fn walk(root: &Path, folder: &Path, depth: usize, out: &mut Scanned) -> Result<(), CatalogError> {
    let fault =
        |e: std::io::Error| CatalogError::File { path: folder.to_path_buf(), problem: format!("cannot be read: {e}") };
    let mut entries: Vec<PathBuf> = Vec::new();
    for entry in folder.read_dir().map_err(fault)? {
        entries.push(entry.map_err(fault)?.path());
    }
    entries.sort();
    for path in entries {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with('.') {
            continue;
        }
        let is_model =
            path.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb") || e.eq_ignore_ascii_case("gltf"));
        let is_folder = path.is_dir();
        if !is_model && !is_folder {
            continue;
        }
        if path.is_symlink()
            && let Err(error) = paths::real(root, &path)
        {
            out.refused.push(error.to_string());
        } else if is_folder && path.is_symlink() {
            // A link within the folder shows what is found anyway, or goes in circles.
        } else if is_folder && depth < DEEPEST {
            walk(root, &path, depth + 1, out)?;
        } else if is_model && path.is_file() {
            out.files.push(path);
        }
    }
    Ok(())
}
