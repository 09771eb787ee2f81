//! What is known of a thing by its label alone: how large it is, how it stands, what it is made of.
//!
//! Knows nothing of catalogs or files: it gets a label and a bounding box.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::asset::Up;
use super::error::CatalogError;
use super::materials::{self, UNKNOWN, material_in_name};

const TABLE: &str = include_str!("../../catalogs/labels.yaml");

static PRIORS: LazyLock<BTreeMap<String, Prior>> =
    LazyLock::new(|| read_table(TABLE).expect("the table in the program is sound: a test loads it"));

/// What is known of a label.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Prior {
    /// Least, typical and most of the longest side, metres.
    pub size_m: [f64; 3],
    /// How it stands.
    pub upright: Upright,
    /// Material of its main surface.
    pub material: String,
    /// Where the sizes come from.
    pub source: String,
}

/// How a thing stands.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Upright {
    /// Higher than wide.
    Tall,
    /// Lowest in height.
    Flat,
    /// Either.
    Any,
}

/// How a size is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SizeFrom {
    /// Someone stated it.
    #[default]
    Given,
    /// From the file's own units, which agree with what is known of its label.
    File,
    /// The typical size of its label.
    Prior,
    /// The file's numbers taken for metres, as nothing is known of its label.
    Guessed,
}

impl SizeFrom {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Given, Self::File, Self::Prior, Self::Guessed];

    /// Its word in `catalog.csv`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::File => "file",
            Self::Prior => "prior",
            Self::Guessed => "guessed",
        }
    }
}

/// What is known of a label, if anything is.
#[must_use]
pub fn prior(label: &str) -> Option<&'static Prior> {
    PRIORS.get(label)
}

/// All labels of which something is known.
pub fn priors() -> impl Iterator<Item = (&'static str, &'static Prior)> {
    PRIORS.iter().map(|(label, prior)| (label.as_str(), prior))
}

/// Units that files are found in: metres, centimetres, millimetres, inches.
const UNITS: [(f64, &str); 4] = [(1.0, "metres"), (0.01, "centimetres"), (0.001, "millimetres"), (0.0254, "inches")];

/// Longest side that is believed of a thing of which nothing is known, metres.
const BELIEVED: [f64; 2] = [0.01, 100.0];

/// A size with how it is known and, where that is worth saying, why.
#[derive(Clone, Debug, PartialEq)]
pub struct Sized {
    /// Longest side, metres.
    pub size_m: f64,
    /// How it is known.
    pub from: SizeFrom,
    /// What a person should know of it.
    pub note: Option<String>,
}

/// The real size of a model whose file spans so many units.
#[must_use]
pub fn size_of(label: &str, file_units: f64) -> Sized {
    let Some(Prior { size_m: [least, typical, most], .. }) = prior(label) else {
        let believed = (BELIEVED[0]..=BELIEVED[1]).contains(&file_units);
        let size_m = if believed { file_units } else { 1.0 };
        let note = if believed {
            format!("nothing is known of the size of `{label}`: the file's numbers are taken for metres")
        } else {
            format!(
                "nothing is known of the size of `{label}`, and {file_units:.3} m is hard to believe: 1 m is assumed"
            )
        };
        return Sized { size_m, from: SizeFrom::Guessed, note: Some(note) };
    };
    // Other units than metres are believed only near the typical size.
    let near = |size: f64| size >= 0.4 * typical && size <= 2.5 * typical;
    let fits = |(unit, _): &&(f64, &str)| {
        let size = unit * file_units;
        (*least..=*most).contains(&size) && (*unit == 1.0 || near(size))
    };
    match UNITS.iter().find(fits) {
        Some((unit, _)) if *unit == 1.0 => Sized { size_m: file_units, from: SizeFrom::File, note: None },
        Some((unit, name)) => Sized {
            size_m: unit * file_units,
            from: SizeFrom::File,
            note: Some(format!("the file's units are taken for {name}")),
        },
        None => Sized { size_m: *typical, from: SizeFrom::Prior, note: None },
    }
}

/// The axis of a file that points up, with the reason where it is not glTF's own: `size` in the file's axes.
#[must_use]
pub fn up_of(label: &str, size: Vec3) -> (Up, Option<&'static str>) {
    let wants_z = match prior(label).map_or(Upright::Any, |prior| prior.upright) {
        Upright::Any => false,
        // Clearly so, as a bottle with a handle may be as wide as high.
        Upright::Tall => size.y < 0.67 * size.z && size.z > size.x,
        Upright::Flat => size.z < 0.67 * size.y && size.z < size.x && size.y > 0.5 * size.x.max(size.y),
    };
    match (wants_z, prior(label).map(|prior| prior.upright)) {
        (true, Some(Upright::Tall)) => (Up::Z, Some("z is taken for up: such things stand higher than wide")),
        (true, _) => (Up::Z, Some("z is taken for up: such things are lowest in height")),
        (false, _) => (Up::Y, None),
    }
}

/// Words that speak of a material in the names of things; those of [`materials`] speak in the names of surfaces.
const MADE_OF: [(&str, &str); 20] = [
    ("alloy", "aluminium"),
    ("aluminum", "aluminium"),
    ("brass", "aluminium"),
    ("bronze", "aluminium"),
    ("ceramic", "ceramic"),
    ("clay", "ceramic"),
    ("concrete", "concrete"),
    ("glass", "glass"),
    ("iron", "iron"),
    ("metal", "steel"),
    ("metallic", "steel"),
    ("plastic", "plastic"),
    ("rubber", "rubber"),
    ("rusted", "iron"),
    ("rusty", "iron"),
    ("steel", "steel"),
    ("stone", "rock"),
    ("terracotta", "ceramic"),
    ("wood", "wood"),
    ("wooden", "wood"),
];

/// The material that a thing's name tells of (`wooden crate`), else the one its label has, else none.
#[must_use]
pub fn material_of(label: &str, name: &str) -> Option<&'static str> {
    let words = super::words::words(name);
    let told = words.iter().find_map(|word| {
        MADE_OF.binary_search_by_key(&word.as_str(), |(word, _)| word).ok().map(|place| MADE_OF[place].1)
    });
    // Rust is on whatever it is made of, but on no wood.
    let known = prior(label).map(|prior| prior.material.as_str());
    match (told, known) {
        (Some("iron"), Some(known @ ("steel" | "iron"))) => Some(known),
        (Some(told), _) => Some(told),
        (None, known) => known,
    }
}

/// The material of a surface: what its glTF name speaks of, else `otherwise`, else [`UNKNOWN`].
///
/// Artists name materials after colours: what is made by hand has no surface of flesh or leaf, whatever its name says.
#[must_use]
pub fn material_of_surface<'a>(gltf_name: &str, otherwise: &'a str) -> &'a str {
    let otherwise = if otherwise.is_empty() { UNKNOWN } else { otherwise };
    let lives = |material: &str| matches!(material, "flesh" | "plant");
    match material_in_name(gltf_name) {
        Some(named) if lives(named) && !lives(otherwise) && otherwise != UNKNOWN => otherwise,
        Some(named) => named,
        None => otherwise,
    }
}

fn read_table(text: &str) -> Result<BTreeMap<String, Prior>, CatalogError> {
    let fault = |problem: String| CatalogError::Table { table: "labels.yaml", problem };
    let table: BTreeMap<String, Prior> = serde_yaml::from_str(text).map_err(|e| fault(e.to_string()))?;
    for (label, Prior { size_m: [least, typical, most], material, .. }) in &table {
        materials::material(material).map_err(|e| fault(format!("{label}: {e}")))?;
        if !(0.0 < *least && least <= typical && typical <= most) {
            return Err(fault(format!("{label}: size_m is not least, typical, most")));
        }
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_loads_and_every_label_names_a_source() {
        assert!(priors().count() >= 150);
        assert!(priors().all(|(_, prior)| !prior.source.is_empty()));
        assert!(MADE_OF.is_sorted());
        for (label, fault) in [("{size_m: [2, 1, 3]", "least"), ("{size_m: [1, 2, 3]", "material")] {
            let material = if fault == "material" { "butter" } else { "wood" };
            let text = format!("x: {label}, upright: any, material: {material}, source: s}}");
            assert!(read_table(&text).expect_err("refused").to_string().contains(fault));
        }
    }

    #[test]
    fn sizes_follow_file_units_where_they_agree_with_the_label() {
        let size = |label, units| {
            let sized = size_of(label, units);
            (sized.size_m, sized.from)
        };
        assert_eq!(size("tire", 0.65), (0.65, SizeFrom::File));
        assert_eq!(size("tire", 63.0), (0.63, SizeFrom::File));
        assert_eq!(size("shark", 15.8), (3.0, SizeFrom::Prior));
        assert_eq!(size("aircraft", 0.138), (9.0, SizeFrom::Prior));
        assert_eq!(size("thingamajig", 2.0), (2.0, SizeFrom::Guessed));
        assert_eq!(size("thingamajig", 2e5), (1.0, SizeFrom::Guessed));
    }

    #[test]
    fn what_should_stand_is_stood_up() {
        assert_eq!(up_of("bottle", Vec3::new(0.1, 0.3, 0.1)), (Up::Y, None));
        assert!(matches!(up_of("bottle", Vec3::new(0.1, 0.1, 0.3)), (Up::Z, Some(_))));
        assert!(matches!(up_of("starfish", Vec3::new(0.2, 0.2, 0.05)), (Up::Z, Some(_))));
        assert_eq!(up_of("starfish", Vec3::new(0.2, 0.05, 0.2)), (Up::Y, None));
        assert_eq!(up_of("torpedo", Vec3::new(5.8, 0.5, 0.5)), (Up::Y, None));
        assert_eq!(up_of("tire", Vec3::new(0.6, 0.6, 0.2)), (Up::Y, None));
    }

    #[test]
    fn materials_come_from_surfaces_then_names_then_labels() {
        assert_eq!(material_of("barrel", "plastic barrel"), Some("plastic"));
        assert_eq!(material_of("anchor", "rusty anchor"), Some("iron"));
        assert_eq!(material_of("oil-drum", "rusty drum"), Some("steel"));
        assert_eq!(material_of("thing", "thing"), None);
        assert_eq!(material_of_surface("DarkWood", "steel"), "wood");
        assert_eq!(material_of_surface("leaves", "glass"), "glass", "a colour");
        assert_eq!(material_of_surface("leaves", "plant"), "plant");
        assert_eq!(material_of_surface("Main", ""), UNKNOWN);
    }
}
