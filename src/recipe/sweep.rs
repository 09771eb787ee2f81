//! Sweeps: one recipe becomes variants of itself that differ in what is swept and in nothing else.
//!
//! `grid` is every combination of its values, `zip` takes values side by side, `count` repeats everything under seeds of its
//! own. A variant is the recipe with the swept values put in their places, so every leaf that is not swept keeps its path
//! and with it its draws. Knows nothing of jobs.

use std::collections::BTreeMap;

use super::Recipe;
use super::error::{Error, quoted};
use super::nearest::did_you_mean;
use super::node::{Key, Kind, Node};
use super::path::{Step, steps};

/// Most variants of one recipe.
pub const MAX_VARIANTS: usize = 1000;
/// Most values in all variants of one recipe together.
const MAX_VALUES: usize = 4_000_000;
/// The key of a sweep.
const SWEEP: &str = "sweep";
/// What a sweep has.
const KEYS: [&str; 3] = ["grid", "zip", "count"];

/// A recipe with its swept values in place.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// The recipe, without its sweep.
    pub recipe: Recipe,
    /// What is set, by path; empty where nothing but `count` is swept.
    pub set: BTreeMap<String, serde_json::Value>,
    /// Number of the repeat, where there are several.
    pub repeat: Option<u64>,
}

/// A value on its way to its place.
#[derive(Clone)]
struct Setting<'a> {
    path: &'a Key,
    value: &'a Node,
}

impl Recipe {
    /// The variants in their order: the first path of `grid` varies slowest, then `zip`, then the repeats. None without a
    /// sweep. `sections` are the top-level keys that may be swept.
    ///
    /// # Errors
    /// A sweep of another form, paths that lead nowhere or may not be swept, too many variants.
    pub fn variants(&self, sections: &[&str]) -> Result<Vec<Variant>, Error> {
        let Some(sweep) = self.node().get(SWEEP) else { return Ok(Vec::new()) };
        let help = "write for example `sweep: {grid: {water.temperature_c: [5, 20]}}`";
        if !matches!(sweep.kind, Kind::Map(_)) || sweep.entries().is_empty() {
            return Err(Error::new(&sweep.span, SWEEP, "a sweep is a map of `grid`, `zip` or `count`", help));
        }
        sweep.allow_keys(SWEEP, &KEYS)?;
        let mut axes = grid(sweep)?;
        axes.extend(zip(sweep)?);
        let paths: Vec<&Key> = axes.iter().filter_map(|axis| axis.first()).flatten().map(|set| set.path).collect();
        check_paths(&paths, sections)?;
        let repeats = count(sweep)?;
        let size = axes.iter().try_fold(repeats.unwrap_or(1) as usize, |size, axis| size.checked_mul(axis.len()));
        if size.is_none_or(|size| size > MAX_VARIANTS) {
            let message = format!("the sweep has more than {MAX_VARIANTS} variants");
            return Err(Error::new(&sweep.span, SWEEP, message, "sweep fewer values, or make several datasets"));
        }
        let plain = self.without(SWEEP);
        if size.is_some_and(|size| size * plain.node().size() > MAX_VALUES) {
            let message = "the variants of this recipe are too large together";
            return Err(Error::new(&sweep.span, SWEEP, message, "sweep fewer values, or make several datasets"));
        }
        let mut variants = Vec::new();
        for settings in product(&axes) {
            let mut recipe = plain.clone();
            for setting in &settings {
                recipe.put(&setting.path.text, setting.value.clone(), &setting.path.span)?;
            }
            let set: BTreeMap<_, _> = settings.iter().map(|s| (s.path.text.clone(), s.value.json())).collect();
            let numbers = (0..repeats.unwrap_or(1)).map(|repeat| repeats.map(|_| repeat));
            variants.extend(numbers.map(|repeat| Variant { recipe: recipe.clone(), set: set.clone(), repeat }));
        }
        Ok(variants)
    }
}

impl Variant {
    /// What is set, in words: `sonar.device=gemini-720is, water.temperature_c=5, repeat 2`.
    #[must_use]
    pub fn description(&self) -> String {
        let value = |value: &serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let set = self.set.iter().map(|(path, given)| format!("{path}={}", value(given)));
        set.chain(self.repeat.map(|repeat| format!("repeat {repeat}"))).collect::<Vec<_>>().join(", ")
    }
}

/// One axis for each path of `grid`.
fn grid(sweep: &Node) -> Result<Vec<Vec<Vec<Setting<'_>>>>, Error> {
    let Some(grid) = sweep.get("grid") else { return Ok(Vec::new()) };
    let lists = lists(grid, "sweep.grid")?;
    Ok(lists
        .into_iter()
        .map(|(path, values)| values.iter().map(|value| vec![Setting { path, value }]).collect())
        .collect())
}

/// One axis for all paths of `zip`.
fn zip(sweep: &Node) -> Result<Option<Vec<Vec<Setting<'_>>>>, Error> {
    let Some(zip) = sweep.get("zip") else { return Ok(None) };
    let lists = lists(zip, "sweep.zip")?;
    let length = lists[0].1.len();
    if let Some((path, values)) = lists.iter().find(|(_, values)| values.len() != length) {
        let message = format!(
            "{} has {} values, but {} has {length}",
            quoted(&path.text),
            values.len(),
            quoted(&lists[0].0.text)
        );
        return Err(Error::new(
            &path.span,
            "sweep.zip",
            message,
            "lists side by side are equally long; `grid` combines",
        ));
    }
    Ok(Some(
        (0..length).map(|i| lists.iter().map(|(path, values)| Setting { path, value: &values[i] }).collect()).collect(),
    ))
}

/// The paths of `grid` or `zip` with their values, at least one each.
fn lists<'a>(node: &'a Node, path: &str) -> Result<Vec<(&'a Key, &'a [Node])>, Error> {
    let help = "write `path: [value, value]` lines, such as `sonar.device: [gemini-720is, oculus-m1200d-lf]`";
    if node.entries().is_empty() {
        return Err(Error::new(
            &node.span,
            path,
            format!("expected paths with lists, found {}", node.describe()),
            help,
        ));
    }
    let list = |(key, values): &'a (Key, Node)| match &values.kind {
        Kind::Seq(items) if !items.is_empty() => Ok((key, items.as_slice())),
        _ => {
            let message = format!("{} is swept over a list of values, found {}", quoted(&key.text), values.describe());
            Err(Error::new(&values.span, path, message, help))
        }
    };
    node.entries().iter().map(list).collect()
}

fn count(sweep: &Node) -> Result<Option<u64>, Error> {
    let Some(node) = sweep.get("count") else { return Ok(None) };
    match node.kind {
        Kind::Int(count) if (1..=MAX_VARIANTS as i128).contains(&count) => Ok(Some(count as u64)),
        _ => {
            let message = format!("there cannot be {} of repeats", node.describe());
            let help = format!("write a whole number from 1 to {MAX_VARIANTS}");
            Err(Error::new(&node.span, "sweep.count", message, help))
        }
    }
}

/// Refuses paths outside of what differs from frame to frame, and two that set the same value.
fn check_paths(paths: &[&Key], sections: &[&str]) -> Result<(), Error> {
    let mut walked: Vec<(Vec<Step>, &Key)> = Vec::new();
    for key in paths {
        let fault = |message: String, help: String| Err(Error::new(&key.span, SWEEP, message, help));
        let steps = match steps(&key.text) {
            Ok(steps) if !steps.is_empty() => steps,
            Ok(_) => return fault("the path is empty".to_owned(), EXAMPLE.to_owned()),
            Err(why) => return fault(format!("the path {} is not one: {why}", quoted(&key.text)), EXAMPLE.to_owned()),
        };
        match &steps[0] {
            Step::Key(section) if sections.contains(&section.as_str()) => {}
            Step::Key(section) => {
                let message = format!("{} cannot be swept", quoted(section));
                return fault(message, did_you_mean(section, sections));
            }
            Step::Index(_) => return fault("a path begins with a section".to_owned(), EXAMPLE.to_owned()),
        }
        let overlaps = |(other, _): &&(Vec<Step>, &Key)| other.starts_with(&steps) || steps.starts_with(other);
        if let Some((_, first)) = walked.iter().find(overlaps) {
            let message = format!("{} and {} set the same value", quoted(&first.text), quoted(&key.text));
            return fault(message, "keep one of the two".to_owned());
        }
        walked.push((steps, key));
    }
    Ok(())
}

const EXAMPLE: &str = "write a path such as sonar.range_m or objects[0].count";

/// Every combination of one entry of each axis, the last axis varying fastest.
fn product<'a>(axes: &[Vec<Vec<Setting<'a>>>]) -> Vec<Vec<Setting<'a>>> {
    axes.iter().fold(vec![Vec::new()], |begun, axis| {
        let longer = |settings: &Vec<Setting<'a>>| {
            let begun = settings.clone();
            axis.iter().map(move |more| begun.iter().chain(more).cloned().collect()).collect::<Vec<_>>()
        };
        begun.iter().flat_map(longer).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variants(sweep: &str) -> Result<Vec<Variant>, Error> {
        let text = format!("ensonify: 1\nwater: {{depth_m: 3}}\nobjects: [{{count: 1}}]\nsweep: {sweep}\n");
        Recipe::parse("a", &text).unwrap().variants(&["water", "sonar", "objects"])
    }

    #[test]
    fn grids_multiply_zips_go_side_by_side_and_counts_repeat() {
        let found = variants(
            "{grid: {water.depth_m: [5, 9], sonar.device: [a, b]}, zip: {water.ph: [7, 8], \"objects[0].count\": [1, {int: [2, 3]}]}, count: 2}",
        )
        .unwrap();
        let words: Vec<String> = found.iter().map(Variant::description).collect();
        assert_eq!(words.len(), 16);
        assert_eq!(words[0], "objects[0].count=1, sonar.device=a, water.depth_m=5, water.ph=7, repeat 0");
        assert_eq!(words[1], "objects[0].count=1, sonar.device=a, water.depth_m=5, water.ph=7, repeat 1");
        assert_eq!(
            words[15],
            "objects[0].count={\"int\":[2,3]}, sonar.device=b, water.depth_m=9, water.ph=8, repeat 1"
        );
        let recipe = found[15].recipe.node();
        assert_eq!(recipe.at("water.depth_m").unwrap().number(), Some(9.0));
        assert_eq!(recipe.at("sonar.device").unwrap().text(), Some("b"));
        assert!(recipe.at("objects[0].count").unwrap().is_distribution() && recipe.get("sweep").is_none());
    }

    #[test]
    fn a_recipe_without_a_sweep_has_no_variants() {
        assert_eq!(Recipe::parse("a", "ensonify: 1").unwrap().variants(&["water"]), Ok(Vec::new()));
    }

    #[test]
    fn sweeps_that_cannot_be_are_refused_where_they_stand() {
        for (sweep, message, column) in [
            ("3", "a sweep is a map of `grid`, `zip` or `count`", 8),
            ("{}", "a sweep is a map of `grid`, `zip` or `count`", 8),
            ("{gird: {}}", "unknown key `gird`", 9),
            ("{grid: {}}", "expected paths with lists, found a map", 15),
            ("{grid: {water.ph: 7}}", "`water.ph` is swept over a list of values, found the number 7", 26),
            ("{zip: {water.ph: [7], sonar.device: [a, b]}}", "`sonar.device` has 2 values, but `water.ph` has 1", 30),
            ("{count: 0}", "there cannot be the number 0 of repeats", 16),
            ("{grid: {seed: [1, 2]}}", "`seed` cannot be swept", 16),
            ("{grid: {wather.ph: [1, 2]}}", "`wather` cannot be swept", 16),
            ("{grid: {water..ph: [1, 2]}}", "the path `water..ph` is not one: a key is missing", 16),
            ("{grid: {\"objects[3].count\": [1]}}", "there is no item [3]", 16),
            ("{grid: {water: [{}], water.ph: [7]}}", "`water` and `water.ph` set the same value", 29),
            ("{grid: {water.ph: [7]}, zip: {water.ph: [7]}}", "`water.ph` and `water.ph` set the same value", 38),
            ("{grid: {water.ph: [7, 8]}, count: 600}", "the sweep has more than 1000 variants", 8),
        ] {
            let error = variants(sweep).unwrap_err();
            assert_eq!(
                (error.message.as_str(), error.column(), error.line()),
                (message, Some(column), Some(4)),
                "{sweep}"
            );
            assert!(!error.help.is_empty(), "{sweep}");
        }
    }
}
