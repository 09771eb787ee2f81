//! glTF models: `.glb`, and `.gltf` with its buffers beside it or inside it.
//!
//! Everything that a file can lie about (numbers, offsets, counts, cycles, paths) is checked before it is used, and what
//! one file may cost is limited, so that a broken or hostile file is an error that says where and never a panic, a hang
//! or a flood of memory. Appearance (textures, normals, colours) and animation are not read; morph targets and skins
//! stand in their rest pose.

mod accessor;
mod attributes;
mod container;
mod draco;
mod file;
mod folder;
mod hanger;
mod isolate;
mod meshopt;
mod nodes;
mod primitives;
mod schema;
mod skin;
mod source;
mod transform;
mod triangles;
mod uri;

use std::path::Path;

use self::file::File;
use self::folder::Folder;
use self::isolate::isolated;
use self::nodes::Nodes;
use self::primitives::Reader;
use super::error::{CatalogError, ModelFault};
use super::model::Model;

/// A model as its file has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// The surfaces, without triangles that have no area.
    pub model: Model,
    /// Triangles of the file's scene, those without area too; a mesh that several nodes share counts for each.
    pub triangles: u64,
}

/// Reads the default scene of a glTF 2.0 file, node transforms applied, turned from y up to z up: (x, y, z) → (x, −z, y).
///
/// Triangles, strips and fans are read, points and lines skipped, triangles without area dropped. A transform that
/// mirrors turns the winding back, so that fronts stay fronts. The file and its buffers must lie in the folder `root`
/// when links are followed; without one, buffers must lie in the file's own folder. Nothing is fetched from a network.
///
/// # Errors
/// [`CatalogError::Model`] if the file is missing, elsewhere, broken or too large, needs an unknown extension or has no
/// triangles at all.
pub fn read_model(path: &Path, root: Option<&Path>) -> Result<Reading, CatalogError> {
    let fault = |fault| CatalogError::Model { path: path.to_path_buf(), fault };
    isolated(|| read(path, root)).unwrap_or(Err(ModelFault::Crash)).map_err(fault)
}

/// As [`read_model`], for use where the file has it: its origin is the file's zero, and no surface at all is an error
/// too. Its buffers lie in its own folder.
///
/// # Errors
/// As [`read_model`].
pub fn load_model(path: &Path) -> Result<Model, CatalogError> {
    let mut model = surface_of(path, read_model(path, None)?)?;
    model.move_to_file_frame();
    Ok(model)
}

/// As [`load_model`], for a model of the catalog in the folder `root`; it keeps the origin that it was read with.
///
/// # Errors
/// As [`read_model`].
pub fn load_model_in(root: &Path, path: &Path) -> Result<Model, CatalogError> {
    surface_of(path, read_model(path, Some(root))?)
}

fn surface_of(path: &Path, Reading { model, triangles }: Reading) -> Result<Model, CatalogError> {
    if model.parts.is_empty() {
        return Err(CatalogError::Model { path: path.to_path_buf(), fault: ModelFault::Flat(triangles) });
    }
    Ok(model)
}

fn read(path: &Path, root: Option<&Path>) -> Result<Reading, ModelFault> {
    let folder = Folder::of(path, root)?;
    let bytes = folder.read_model()?;
    let file = File::parse(&bytes, &folder)?;
    let nodes = Nodes::of(&file.root)?;
    let mut reader = Reader::new(&file, &nodes);
    reader.all()?;
    if reader.triangles == 0 {
        return Err(ModelFault::NoTriangles);
    }
    let origin = reader.origin.unwrap_or_default();
    Ok(Reading { triangles: reader.triangles, model: Model { parts: reader.parts, origin } })
}

#[cfg(test)]
pub(crate) mod tests;
