//! Where a drawn value came from: its distribution, how often it is drawn, its place in the recipe.

use std::path::Path;

use super::PlanError;
use super::compile::variants;
use super::sections::Sections;
use crate::recipe::{Node, Recipe};

/// Longest distribution that is shown whole, in characters.
const LONGEST_LAW: usize = 100;

/// Where a drawn value came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// The distribution as it is written, cut where it is long.
    pub law: String,
    /// How often it is drawn: "once a scene" and the like.
    pub often: &'static str,
    /// File, line and column.
    pub place: String,
}

/// The distributions of one variant of a recipe.
pub struct Origins {
    sections: Sections,
    recipe: Recipe,
}

impl Origins {
    /// Those of a variant by its number; 0 is the recipe itself where there is no sweep.
    ///
    /// # Errors
    /// A fault of the recipe, as in compiling it.
    pub fn of(recipe: &Recipe, variant: usize, recipe_dir: &Path) -> Result<Self, PlanError> {
        let (_, mut all) = variants(recipe)?;
        let recipe = all.swap_remove(variant.min(all.len() - 1)).recipe;
        Ok(Self { sections: Sections::new(&recipe, recipe_dir)?, recipe })
    }

    /// Where the value came from that stands under this path in the draws of a plan.
    #[must_use]
    pub fn origin(&self, drawn: &str) -> Option<Origin> {
        let path = without_instance(drawn);
        let node = match path.strip_prefix("looks.").and_then(|rest| rest.split_once('.')) {
            Some((name, rest)) => self.sections.look(name)?.node().distribution_on(rest)?,
            None if path.starts_with("let.") => self.recipe.node().distribution_on(&path)?,
            None => self.sections.tree.node().distribution_on(&path)?,
        };
        let mut law = node.json();
        law.as_object_mut().map(|keys| keys.remove("per"));
        let mut law = law.to_string();
        if let Some((end, _)) = law.char_indices().nth(LONGEST_LAW) {
            law.truncate(end);
            law.push('…');
        }
        Some(Origin { law, often: often(node, &path), place: node.span.to_string() })
    }
}

/// `objects[0]#3.pose` is drawn from `objects[0].pose`.
fn without_instance(path: &str) -> String {
    match path.split_once('#') {
        Some((item, rest)) => format!("{item}{}", rest.trim_start_matches(|c: char| c.is_ascii_digit())),
        None => path.to_owned(),
    }
}

fn often(node: &Node, path: &str) -> &'static str {
    match node.get("per").and_then(Node::text) {
        Some("dataset") => "once for all",
        Some("frame") => "each frame",
        None if path.starts_with("objects[") && !path.ends_with("].count") => "each instance",
        _ => "once a scene",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_traced_to_their_distributions() {
        let text =
            "ensonify: 1\nsonar: {device: gemini-720is, range_m: [1, 9]}\nseabed: {sediment: {choice: [silt, mud]}}
water: {temperature_c: {uniform: [1, 2], per: frame}}\nlooks: [{name: a, water: {ph: {uniform: [7, 8]}}}]
objects: [{pick: {catalog: starter}, pose: {rest: {burial: {uniform: [0, 1]}}}, count: {int: [0, 2]}}]
let: {d: {uniform: [1, 2], per: dataset}}\ntrajectory: {orbit: {radius_m: $d, altitude_m: 2}}\n";
        let recipe = Recipe::parse("a.yaml", text).unwrap();
        let origins = Origins::of(&recipe, 0, Path::new(".")).unwrap();
        for (path, law, often, place) in [
            ("seabed.sediment", r#"{"choice":["silt","mud"]}"#, "once a scene", "a.yaml:3:20"),
            ("looks.a.water.ph", r#"{"uniform":[7,8]}"#, "once a scene", "a.yaml:5:31"),
            ("looks.a.water.temperature_c", r#"{"uniform":[1,2]}"#, "each frame", "a.yaml:4:24"),
            ("objects[0]#12.pose.rest.burial", r#"{"uniform":[0,1]}"#, "each instance", "a.yaml:6:60"),
            ("objects[0].count", r#"{"int":[0,2]}"#, "once a scene", "a.yaml:6:88"),
            ("let.d", r#"{"uniform":[1,2]}"#, "once for all", "a.yaml:7:10"),
        ] {
            let origin = origins.origin(path).unwrap_or_else(|| panic!("{path}"));
            assert_eq!((origin.law.as_str(), origin.often, origin.place.as_str()), (law, often, place), "{path}");
        }
        let default = origins.origin("objects[0]#0.pose.rest.yaw_deg").unwrap();
        assert!(default.place.starts_with("defaults:") && default.often == "each instance", "{default:?}");
        assert_eq!(origins.origin("sonar.beams"), None);
    }
}
