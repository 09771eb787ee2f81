//! One model of a catalog: what is known of it, and its geometry at true size.

use std::collections::BTreeMap;
use std::path::PathBuf;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::error::CatalogError;
use super::glb::load_model_in;
use super::model::Model;
use super::paths;
use super::priors::{self, SizeFrom, Sized};
use super::simplify::{MOST_TRIANGLES, simplify};

/// One model of a catalog.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Asset {
    /// Unique in its catalog.
    pub uid: String,
    /// For people.
    pub name: String,
    /// Category that it is annotated with unless the recipe says otherwise.
    pub label: String,
    /// Words to pick it by.
    pub tags: Vec<String>,
    /// The model file, the catalog's root included.
    pub path: PathBuf,
    /// The folder that the file must lie in.
    pub root: PathBuf,
    /// Longest side of the bounding box, metres; without it the file and its label decide, see [`priors::size_of`].
    pub size_m: Option<f64>,
    /// How the size is known.
    pub size_from: SizeFrom,
    /// Which axis of the file's frame points up.
    pub up: Up,
    /// Material where the file's own material names say nothing; empty if not given.
    pub material: String,
    /// Materials by the name of a glTF material or node, over everything else.
    pub parts: BTreeMap<String, String>,
    /// Licence, as its source states it.
    pub licence: String,
    /// Whom to name.
    pub attribution: String,
    /// Where it comes from.
    pub source: String,
    /// Triangles in the file, where that is known.
    pub triangles: Option<u64>,
    /// Whether the surface is closed, where that is known.
    pub watertight: Option<bool>,
    /// What is wrong with it; empty if nothing is known to be.
    pub problems: String,
    /// Line in the index, from 1; 0 if it has none.
    pub line: u64,
}

/// Which axis of a model file's frame points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// As glTF wants it.
    #[default]
    Y,
    /// As many converters leave it.
    Z,
    /// What its label wants: see [`priors::up_of`].
    Auto,
}

impl Up {
    /// The axis that a word of an index names.
    ///
    /// # Errors
    /// If it names none.
    pub fn of(text: &str) -> Result<Self, String> {
        match text {
            "" | "y" => Ok(Self::Y),
            "z" => Ok(Self::Z),
            "auto" => Ok(Self::Auto),
            other => Err(format!("up `{other}` is neither y nor z nor auto")),
        }
    }

    /// Its word in an index.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Y => "y",
            Self::Z => "z",
            Self::Auto => "auto",
        }
    }
}

/// Marks a surface whose material is stated, not read from its name.
const STATED: char = '\u{1}';

impl Asset {
    /// The model file, links followed.
    ///
    /// # Errors
    /// If it is not there or a link leads out of the catalog.
    pub fn file(&self) -> Result<PathBuf, CatalogError> {
        paths::real(&self.root, &self.path)
    }

    /// The model, up turned to z, scaled so that its longest side is the real one, the middle of its base at the origin.
    ///
    /// # Errors
    /// As [`load_model_in`], or if the file leaves the catalog.
    pub fn scaled_model(&self) -> Result<Model, CatalogError> {
        // The file keeps its name in messages, whatever a link calls it.
        self.file()?;
        let mut model = load_model_in(&self.root, &self.path)?;
        let extent = model.bounds().map_or(Vec3::ZERO, |(low, high)| high - low);
        let in_file = Vec3::new(extent.x, extent.z, extent.y);
        let up = match self.up {
            Up::Auto => priors::up_of(&self.label, in_file).0,
            stated => stated,
        };
        if up == Up::Z {
            // The loader took y for up: back to the file's own axes.
            model.map(|p| Vec3::new(p.x, p.z, -p.y));
        }
        // More triangles than a sonar resolves cost time and show nothing.
        simplify(&mut model, MOST_TRIANGLES);
        model.rest_at_origin(self.size(f64::from(extent.max_element())).size_m);
        for part in &mut model.parts {
            if let Some(material) = self.stated_material(&part.material, &part.node) {
                part.material = format!("{STATED}{material}");
            }
        }
        Ok(model)
    }

    /// How many units the model's longest side has in its file.
    ///
    /// # Errors
    /// As [`load_model_in`].
    pub fn file_units(&self) -> Result<f64, CatalogError> {
        let bounds = load_model_in(&self.root, &self.path)?.bounds();
        Ok(bounds.map_or(0.0, |(low, high)| f64::from((high - low).max_element())))
    }

    /// Its size with how it is known, where the file spans so many units.
    #[must_use]
    pub fn size(&self, file_units: f64) -> Sized {
        match self.size_m {
            Some(size_m) => Sized { size_m, from: self.size_from, note: None },
            None => priors::size_of(&self.label, file_units),
        }
    }

    /// The acoustic material of a surface of [`Self::scaled_model`], by its name there.
    #[must_use]
    pub fn material_of<'a>(&'a self, surface: &'a str) -> &'a str {
        match surface.strip_prefix(STATED) {
            Some(stated) => stated,
            None => priors::material_of_surface(surface, &self.material),
        }
    }

    fn stated_material(&self, material: &str, node: &str) -> Option<&String> {
        let named = |name: &str| self.parts.iter().find(|(part, _)| part.eq_ignore_ascii_case(name)).map(|(_, m)| m);
        named(material).or_else(|| named(node))
    }
}
