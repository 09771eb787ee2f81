//! What a model file holds, as far as an index wants to know it.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Component, Path, PathBuf};
use std::time::UNIX_EPOCH;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::relative;
use crate::catalog::error::{CatalogError, ModelFault};
use crate::catalog::glb::load_model_in;
use crate::catalog::paths;
use crate::catalog::solidity::solidity;
use crate::catalog::text::clean;

/// Facts of a model file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// SHA-256 of the model's file.
    pub sha256: String,
    /// Every file that it is made of, itself first.
    pub files: Vec<Stamp>,
    /// Triangles.
    pub triangles: u64,
    /// Whether its surface is closed.
    pub watertight: bool,
    /// Sides of its box in the file's axes and units.
    pub extent: [f32; 3],
    /// Area by name of the glTF material.
    pub areas: BTreeMap<String, f64>,
    /// What the file says about itself.
    pub about: About,
}

/// A file as it was when it was read.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stamp {
    /// Below the root.
    pub path: String,
    /// Its size.
    pub bytes: u64,
    /// When it was last written, nanoseconds since 1970.
    pub written: u64,
    /// SHA-256.
    pub sha256: String,
}

/// What exporters write into a file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct About {
    /// `asset.extras.title`.
    pub title: String,
    /// `asset.extras.author`, else `asset.copyright`.
    pub author: String,
    /// `asset.extras.license`.
    pub licence: String,
    /// `asset.extras.source`.
    pub source: String,
}

impl Facts {
    /// Reads a model file and everything that it refers to.
    ///
    /// # Errors
    /// If it cannot be used as a model, or a link leads out of the root.
    pub fn read(root: &Path, file: &Path) -> Result<Self, CatalogError> {
        paths::real(root, file)?;
        let json = json_of(file);
        let mut files = vec![file.to_path_buf()];
        files.extend(buffers(file, &json));
        let stamp = |path: &PathBuf| {
            paths::real(root, path)?;
            Stamp::of(root, path).map_err(|e| CatalogError::Model { path: path.clone(), fault: ModelFault::Io(e) })
        };
        let files: Vec<Stamp> = files.iter().map(stamp).collect::<Result<_, CatalogError>>()?;
        let solid = solidity(&load_model_in(root, file)?);
        Ok(Self {
            sha256: files[0].sha256.clone(),
            files,
            triangles: solid.triangles,
            watertight: solid.watertight,
            extent: solid.extent.to_array(),
            areas: solid.areas,
            about: about(&json),
        })
    }
}

impl Stamp {
    fn of(root: &Path, path: &Path) -> std::io::Result<Self> {
        let (bytes, written) = size_and_time(path)?;
        Ok(Self { path: relative(root, path), bytes, written, sha256: sha256_of(path)? })
    }

    /// Whether the file is as it was, by its size and time.
    pub fn holds(&self, root: &Path) -> bool {
        size_and_time(&root.join(&self.path)).is_ok_and(|now| now == (self.bytes, self.written))
    }
}

/// Size and last change of a file.
pub(crate) fn size_and_time(path: &Path) -> std::io::Result<(u64, u64)> {
    let facts = fs::metadata(path)?;
    let written = facts.modified()?.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos() as u64);
    Ok((facts.len(), written))
}

/// SHA-256 of a file, in hexadecimal.
///
/// # Errors
/// If it cannot be read.
pub fn sha256_of(path: &Path) -> std::io::Result<String> {
    let mut file = File::open(path)?;
    let mut hash = Sha256::new();
    let mut piece = vec![0; 1 << 16];
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()),
            count => hash.update(&piece[..count]),
        }
    }
}

/// The parts of a glTF's JSON that are of use here.
#[derive(Default, Deserialize)]
struct Json {
    #[serde(default)]
    asset: JsonAsset,
    #[serde(default)]
    buffers: Vec<JsonBuffer>,
}

#[derive(Default, Deserialize)]
struct JsonAsset {
    #[serde(default)]
    copyright: Option<String>,
    #[serde(default)]
    extras: serde_json::Value,
}

#[derive(Deserialize)]
struct JsonBuffer {
    #[serde(default)]
    uri: Option<String>,
}

/// The JSON of a model file; nothing if it has none, which the loader tells better.
fn json_of(file: &Path) -> Json {
    let parse = || -> Option<Json> {
        let bytes = fs::read(file).ok()?;
        let json = match bytes.strip_prefix(b"glTF") {
            Some(rest) => {
                let length = u32::from_le_bytes(rest.get(8..12)?.try_into().ok()?) as usize;
                rest.get(16..)?.get(..length)?
            }
            None => &bytes,
        };
        serde_json::from_slice(json).ok()
    };
    parse().unwrap_or_default()
}

/// Files beside a model that its buffers are in; those that leave its folder are the loader's to refuse.
fn buffers(file: &Path, json: &Json) -> Vec<PathBuf> {
    let uris = json.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
    let relative = uris.filter(|uri| !uri.starts_with("data:")).map(PathBuf::from);
    let inside = relative.filter(|uri| uri.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir)));
    inside.map(|uri| file.parent().unwrap_or(Path::new("")).join(uri)).filter(|path| path.is_file()).collect()
}

fn about(json: &Json) -> About {
    let extra = |key: &str| json.asset.extras.get(key).and_then(|value| value.as_str()).map(clean).unwrap_or_default();
    let author = extra("author");
    let copyright = json.asset.copyright.as_deref().map(clean).unwrap_or_default();
    About {
        title: extra("title"),
        author: if author.is_empty() { copyright } else { author },
        licence: extra("license"),
        source: extra("source"),
    }
}
