//! What surfaces are made of: sediments and the materials of objects, from tables in the program.
//!
//! Knows nothing of how sound scatters: it hands out densities, speeds and Lambert coefficients.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

use super::error::{CatalogError, did_you_mean};
use crate::physics::lambert::lambert_mu;

static SEDIMENTS: LazyLock<BTreeMap<String, Sediment>> = LazyLock::new(|| {
    read_table("sediments.yaml", include_str!("../../catalogs/sediments.yaml"), |s: &Sediment| s.lambert_db)
        .expect("the table in the program is sound: a test loads it")
});
static MATERIALS: LazyLock<BTreeMap<String, Material>> = LazyLock::new(|| {
    read_table("materials.yaml", include_str!("../../catalogs/materials.yaml"), |m: &Material| m.lambert_db)
        .expect("the table in the program is sound: a test loads it")
});

/// Name of the material that stands in where nothing is known.
pub const UNKNOWN: &str = "unknown";

/// A seabed.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Sediment {
    /// Mean grain size, φ = −log2 of the diameter in millimetres.
    pub grain_phi: f64,
    /// kg/m³.
    pub density: f64,
    /// Of compressional waves, m/s.
    pub speed: f64,
    /// 10·log10 of the Lambert coefficient.
    pub lambert_db: f64,
    /// Rms slope of the facets that are smaller than the mesh's, degrees.
    pub slope_deg: f64,
    /// Spread of `lambert_db` between sites, dB.
    pub lambert_spread_db: f64,
    /// Shape of the gamma-distributed patchiness of the backscatter.
    pub texture_nu: f64,
    /// Where the numbers come from.
    pub source: String,
}

/// A material of objects.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// kg/m³.
    pub density: f64,
    /// Of compressional waves, m/s.
    pub speed: f64,
    /// 10·log10 of the Lambert coefficient.
    pub lambert_db: f64,
    /// Rms slope of the facets that are smaller than the mesh's, degrees.
    pub slope_deg: f64,
    /// Other words for it in glTF files.
    pub also: Vec<String>,
    /// Where the numbers come from.
    pub source: String,
}

/// The sediment of that name.
///
/// # Errors
/// [`CatalogError::UnknownName`] with the nearest name.
pub fn sediment(name: &str) -> Result<&'static Sediment, CatalogError> {
    look_up(&SEDIMENTS, "sediment", name)
}

/// The material of that name.
///
/// # Errors
/// [`CatalogError::UnknownName`] with the nearest name.
pub fn material(name: &str) -> Result<&'static Material, CatalogError> {
    look_up(&MATERIALS, "material", name)
}

/// All sediments by name.
pub fn sediments() -> impl Iterator<Item = (&'static str, &'static Sediment)> {
    SEDIMENTS.iter().map(|(name, sediment)| (name.as_str(), sediment))
}

/// All materials by name.
pub fn materials() -> impl Iterator<Item = (&'static str, &'static Material)> {
    MATERIALS.iter().map(|(name, material)| (name.as_str(), material))
}

/// Name of the material that a glTF material's name speaks of (`DarkWood`, `mat_tyre_01`), if it speaks of one.
#[must_use]
pub fn material_in_name(gltf_name: &str) -> Option<&'static str> {
    let tokens = tokens(gltf_name);
    // The last word says what it is, those before it how: `wood rope` is a rope.
    tokens.iter().rev().find_map(|token| {
        MATERIALS.iter().find_map(|(name, material)| {
            let words = std::iter::once(name).chain(&material.also);
            let meant = words.into_iter().any(|word| speaks_of(token, word));
            (meant && name != UNKNOWN).then_some(name.as_str())
        })
    })
}

/// A compound's last part is what it is: `driftwood` is wood, `rocket` no rock. Short words must stand alone.
fn speaks_of(token: &str, word: &str) -> bool {
    let singular = token.strip_suffix('s').unwrap_or(token);
    [token, singular].iter().any(|token| *token == word || (word.len() >= 4 && token.ends_with(word)))
}

/// Lower-case words of a name, cut at anything but letters and before capitals.
fn tokens(name: &str) -> Vec<String> {
    let mut tokens = vec![String::new()];
    let mut after_small = false;
    for letter in name.chars() {
        if !letter.is_alphabetic() || (letter.is_uppercase() && after_small) {
            tokens.push(String::new());
        }
        if let Some(token) = tokens.last_mut().filter(|_| letter.is_alphabetic()) {
            token.extend(letter.to_lowercase());
        }
        after_small = letter.is_lowercase();
    }
    tokens.retain(|token| !token.is_empty());
    tokens
}

fn look_up<T>(table: &'static BTreeMap<String, T>, kind: &'static str, name: &str) -> Result<&'static T, CatalogError> {
    table.get(name).ok_or_else(|| CatalogError::UnknownName {
        kind,
        name: name.into(),
        nearest: did_you_mean(name, table.keys().map(String::as_str)),
        known: table.keys().map(String::as_str).collect::<Vec<_>>().join(", "),
    })
}

fn read_table<T: for<'de> Deserialize<'de>>(
    table: &'static str,
    text: &str,
    lambert_db: impl Fn(&T) -> f64,
) -> Result<BTreeMap<String, T>, CatalogError> {
    let entries: BTreeMap<String, T> =
        serde_yaml::from_str(text).map_err(|e| CatalogError::Table { table, problem: e.to_string() })?;
    for (name, entry) in &entries {
        if let Err(fault) = lambert_mu(lambert_db(entry)) {
            return Err(CatalogError::Table { table, problem: format!("{name}: {}", fault.problem) });
        }
    }
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_load_and_every_entry_names_its_source() {
        assert_eq!(sediments().count(), 10);
        assert!(sediments().all(|(_, s)| !s.source.is_empty() && s.density > 1000.0 && s.speed > 1400.0));
        assert!(materials().all(|(_, m)| !m.source.is_empty() && m.density > 900.0 && m.speed > 1400.0));
        assert_eq!(sediment("fine-sand").expect("known").lambert_db, -19.0);
    }

    #[test]
    fn a_word_belongs_to_one_material() {
        let words: Vec<&str> =
            materials().flat_map(|(name, m)| std::iter::once(name).chain(m.also.iter().map(String::as_str))).collect();
        for (k, word) in words.iter().enumerate() {
            assert!(!words[..k].contains(word), "{word} twice");
        }
    }

    #[test]
    fn names_lead_to_materials() {
        let cases = [
            ("DarkWood", Some("wood")),
            ("wood.002", Some("wood")),
            ("driftwood", Some("wood")),
            ("mat_tyre_01", Some("rubber")),
            ("carTire.009", Some("rubber")),
            ("RopeDark", Some("rope")),
            ("DarkMetal", Some("steel")),
            ("Rocks", Some("rock")),
            ("rocket", None),
            ("environment", None),
            ("Main_Dark", None),
            ("", None),
        ];
        for (name, expected) in cases {
            assert_eq!(material_in_name(name), expected, "{name}");
        }
    }

    #[test]
    fn unknown_names_get_the_nearest() {
        let error = sediment("fine_sand").expect_err("no such sediment").to_string();
        assert!(error.contains("did you mean `fine-sand`") && error.contains("gravel"), "{error}");
    }

    #[test]
    fn a_surface_brighter_than_possible_is_refused() {
        let row = "{density: 1, speed: 1, lambert_db: -4, also: [], source: x}";
        let text = format!("shiny: {row}");
        let error = read_table("t.yaml", &text, |m: &Material| m.lambert_db).expect_err("too bright").to_string();
        assert!(error.contains("shiny"), "{error}");
    }
}
