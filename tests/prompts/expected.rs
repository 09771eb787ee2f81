//! What a prompt must become, as the YAML files say; their format stands at the head of `prompts.yaml`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::number::{Number, Words};

/// A prompt and all that it says.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    pub prompt: String,
    pub kind: Kind,
    pub set: Option<Set>,
    pub refused: Option<Vec<String>>,
    pub images: Option<Number>,
    pub versions: Option<Number>,
    pub scenes: Option<Number>,
    pub seed: Option<Number>,
    pub name: Option<String>,
    #[serde(default)]
    pub objects: BTreeMap<String, Number>,
    #[serde(default)]
    pub without: Vec<String>,
    #[serde(default)]
    pub pose: BTreeMap<String, Kinds>,
    #[serde(default)]
    pub burial: BTreeMap<String, Number>,
    #[serde(default)]
    pub floating: BTreeMap<String, Number>,
    #[serde(default)]
    pub tipped: BTreeMap<String, Number>,
    #[serde(default)]
    pub lying: Vec<String>,
    #[serde(default)]
    pub area_m: BTreeMap<String, [[f64; 2]; 2]>,
    pub sediment: Option<Words>,
    pub shape: Option<Kinds>,
    pub depth_m: Option<Number>,
    pub temperature_c: Option<Number>,
    pub salinity_ppt: Option<Number>,
    pub turbidity: Option<Words>,
    pub sonar: Option<Words>,
    pub sonars: Option<Vec<String>>,
    pub frequency_khz: Option<Number>,
    pub beams: Option<Number>,
    pub range_bins: Option<Number>,
    pub fov_deg: Option<Number>,
    pub range_m: Option<Number>,
    pub near_m: Option<Number>,
    pub pitch_deg: Option<Number>,
    #[serde(default)]
    pub motion: BTreeMap<String, Number>,
    pub object_range_m: Option<Number>,
    pub altitude_m: Option<Number>,
    pub deepest_m: Option<Number>,
    pub path_m: Option<Number>,
    pub trajectory: Option<Kinds>,
    pub environment: Option<Kinds>,
    pub multipath: Option<String>,
    #[serde(default)]
    pub splits: BTreeMap<String, serde_json::Value>,
    #[serde(default)]
    pub output: BTreeMap<String, serde_json::Value>,
}

/// Groups of prompts.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    Complete,
    Sonar,
    Scene,
    Mission,
    Vague,
    Language,
    Awkward,
}

/// Whether who works on drafting looks at a prompt.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Set {
    Dev,
    HeldOut,
}

/// Kinds of which each is right, or one with parameters.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Kinds {
    Plain(Words),
    With(BTreeMap<String, BTreeMap<String, Number>>),
}

impl Kinds {
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::Plain(words) => words.all().iter().map(String::as_str).collect(),
            Self::With(kinds) => kinds.keys().map(String::as_str).collect(),
        }
    }

    /// Kind, parameter and what is expected of it.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, &str, &Number)> {
        let kinds = match self {
            Self::Plain(_) => None,
            Self::With(kinds) => Some(kinds),
        };
        kinds.into_iter().flatten().flat_map(|(kind, parameters)| {
            parameters.iter().map(move |(name, number)| (kind.as_str(), name.as_str(), number))
        })
    }
}

/// Which labels, models and sediments a word stands for.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vocabulary {
    pub things: BTreeMap<String, Vec<String>>,
    pub groups: Vec<String>,
    pub sediments: BTreeMap<String, Vec<String>>,
}

/// The cases of a file in `tests`.
pub fn cases(file: &str) -> Vec<Case> {
    read(file)
}

pub fn vocabulary() -> Vocabulary {
    read("prompts_words.yaml")
}

fn read<T: DeserializeOwned>(file: &str) -> T {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
    serde_yaml::from_str(&text).unwrap_or_else(|error| panic!("{file}: {error}"))
}
