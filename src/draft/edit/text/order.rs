//! Where a key usually stands among others.

use std::sync::LazyLock;

use crate::recipe::path::pattern;
use crate::recipe::{DEFAULTS, Node, Origin, parse};

/// Sections as recipes have them.
const SECTIONS: [&str; 22] = [
    "ensonify",
    "include",
    "name",
    "seed",
    "scenes",
    "frames",
    "let",
    "sweep",
    "sonar",
    "water",
    "seabed",
    "environment",
    "multipath",
    "objects",
    "trajectory",
    "vehicle",
    "image",
    "looks",
    "licences",
    "labels",
    "splits",
    "output",
];
/// Keys whose order the defaults do not show, by pattern.
const USUAL: [(&str, &[&str]); 4] = [
    ("sonar", &["device", "frequency_khz", "beams", "azimuth_deg", "range_m", "range_bins", "bandwidth_khz", "mount"]),
    ("seabed", &["extent_m", "cell_m", "fine_m", "shape", "sediment", "patches"]),
    ("objects[]", &["label", "pick", "count", "clear_m", "tries", "on_failure", "pose", "in_view"]),
    ("environment", &["labels", "kind"]),
];

static DEFAULT: LazyLock<Node> =
    LazyLock::new(|| parse("defaults", DEFAULTS, Origin::BuiltIn).expect("the built-in defaults are YAML: tested"));

/// Number that a new key gets in the map at `path` among the keys that are there.
pub(super) fn place_of(path: &str, keys: &[&str], new: &str) -> usize {
    let usual = usual(&pattern(path));
    let rank = |key: &str| usual.iter().position(|usual| *usual == key);
    let Some(own) = rank(new) else { return keys.len() };
    if let Some(before) = keys.iter().rposition(|key| rank(key).is_some_and(|rank| rank < own)) {
        return before + 1;
    }
    keys.iter().position(|key| rank(key).is_some()).unwrap_or(keys.len())
}

fn usual(pattern: &str) -> Vec<&'static str> {
    if pattern.is_empty() {
        return SECTIONS.to_vec();
    }
    if let Some((_, keys)) = USUAL.iter().find(|(known, _)| *known == pattern) {
        return keys.to_vec();
    }
    let keys = |node: &'static Node| node.entries().iter().map(|(key, _)| key.text.as_str()).collect();
    DEFAULT.at(pattern).map_or_else(|| of_kind(pattern).map_or_else(Vec::new, keys), keys)
}

/// Parameters of a kind: `objects[].pose.rest`.
fn of_kind(pattern: &str) -> Option<&'static Node> {
    let (around, kind) = pattern.rsplit_once('.')?;
    DEFAULT.get("kinds")?.get(around)?.get(kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_stand_where_they_usually_do() {
        for (path, keys, new, index) in [
            ("", &["ensonify", "name", "water", "objects"][..], "seed", 2),
            ("", &["ensonify", "water", "objects"], "image", 3),
            ("", &["water"], "ensonify", 0),
            ("water", &["temperature_c", "turbidity"], "depth_m", 1),
            ("objects[3]", &["pick", "pose"], "count", 1),
            ("objects[3].pose.rest", &["within_m"], "burial", 0),
            ("objects[3].pose.rest", &["tip_deg", "within_m"], "unheard", 2),
            ("trajectory.hover", &["position_m"], "yaw_deg", 1),
            ("sonar.mount", &["position_m", "roll_deg"], "pitch_deg", 1),
        ] {
            assert_eq!(place_of(path, keys, new), index, "{path} {new}");
        }
    }
}
