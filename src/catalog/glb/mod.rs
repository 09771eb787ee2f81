//! glTF models: `.glb`, and `.gltf` with its buffers beside it or inside it.
//!
//! The `gltf` crate gives the container and the JSON types. Everything that a file can lie about (numbers, offsets,
//! counts, cycles) is checked here before use, so that a broken file is an error and never a panic. Appearance
//! (textures, normals, colours) and animation are not read; morph targets and skins stand in their rest pose.

mod accessor;
mod file;
mod nodes;
mod primitives;

use std::path::Path;

use self::file::File;
use self::nodes::Nodes;
use self::primitives::Reader;
use super::error::{CatalogError, ModelFault};
use super::model::Model;

/// Loads the default scene of a glTF 2.0 file, node transforms applied, turned from y up to z up: (x, y, z) → (x, −z, y).
///
/// Triangles, strips and fans are read, points and lines skipped, triangles without area dropped. A transform that
/// mirrors turns the winding back, so that fronts stay fronts.
///
/// # Errors
/// [`CatalogError::Model`] if the file is missing, broken, too large, needs an unknown extension or has no triangles.
pub fn load_model(path: &Path) -> Result<Model, CatalogError> {
    read(path).map_err(|fault| CatalogError::Model { path: path.to_path_buf(), fault })
}

fn read(path: &Path) -> Result<Model, ModelFault> {
    let file = File::open(path)?;
    let nodes = Nodes::of(&file.root)?;
    let mut reader = Reader::new(&file, &nodes);
    for &node in &nodes.shown {
        reader.node(node)?;
    }
    let mut parts = reader.parts;
    parts.retain(|part| !part.triangles.is_empty());
    if parts.is_empty() { Err(ModelFault::NoTriangles) } else { Ok(Model { parts }) }
}

#[cfg(test)]
pub(crate) mod tests;
