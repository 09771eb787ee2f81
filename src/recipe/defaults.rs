//! Defaults: what a recipe does not say. All of them stand in `templates/defaults.yaml`.
//!
//! Three sorts: values at a place; `sections`, the values of an optional section or of every item of a list, where the recipe
//! has one; `kinds`, the parameters of a kind wherever
//! that kind is written at its place. A place is a pattern such as `objects[].pose`.

use std::sync::LazyLock;

use super::merge::{map_choices, merge, spread_weights, word};
use super::node::{Kind, Node};
use super::parse::parse;
use super::path;
use super::source::Origin;

/// The text of the defaults, with its comments.
pub const DEFAULTS: &str = include_str!("../../templates/defaults.yaml");

static BUILT_IN: LazyLock<Defaults> = LazyLock::new(|| {
    Defaults::of(&parse("defaults", DEFAULTS, Origin::BuiltIn).expect("the built-in defaults are YAML: tested"))
});

/// Lays a recipe over the built-in defaults. Defaults may hold distributions, so this comes before drawing.
pub(super) fn complete(recipe: &Node) -> Node {
    BUILT_IN.complete(recipe)
}

/// A part of a recipe laid over the defaults of its place.
pub(super) fn complete_at(node: &Node, pattern: &str) -> Node {
    BUILT_IN.complete_at(node, pattern)
}

/// One section of a recipe over another, kinds whole.
pub(super) fn lay_over(over: &Node, under: &Node, section: &str) -> Node {
    BUILT_IN.over(over, under, section)
}

struct Defaults {
    /// Values at their places.
    values: Node,
    /// By pattern: values of an optional section or of each item of a list.
    sections: Node,
    /// By pattern and kind: parameters.
    kinds: Node,
}

impl Defaults {
    fn of(tree: &Node) -> Self {
        let empty = Node { kind: Kind::Map(Vec::new()), span: tree.span.clone() };
        let section = |name| tree.get(name).unwrap_or(&empty).clone();
        let is_value = |key: &str| !matches!(key, "sections" | "kinds");
        let values = tree.entries().iter().filter(|(key, _)| is_value(&key.text)).cloned().collect();
        let values = Node { kind: Kind::Map(values), span: tree.span.clone() };
        Self { values, sections: section("sections"), kinds: section("kinds") }
    }

    fn complete(&self, recipe: &Node) -> Node {
        self.fill(&self.over(recipe, &self.values, ""), "")
    }

    fn complete_at(&self, node: &Node, pattern: &str) -> Node {
        match self.values.at(pattern) {
            Some(under) => self.fill(&self.over(node, under, pattern), pattern),
            None => self.fill(node, pattern),
        }
    }

    /// `node` over `under`, except that a kind replaces another kind whole.
    fn over(&self, node: &Node, under: &Node, pattern: &str) -> Node {
        merge(node, under, pattern, &|pattern| self.kinds.get(pattern).is_some())
    }

    /// The node with the values of list items and the parameters of kinds, all the way down.
    fn fill(&self, node: &Node, pattern: &str) -> Node {
        if node.is_distribution() {
            let spread = if self.kinds.get(pattern).is_some() { spread_weights(node) } else { node.clone() };
            return map_choices(&spread, &|value| self.fill(value, pattern));
        }
        let node = match self.sections.get(pattern) {
            Some(under) => self.over(node, under, pattern),
            None => node.clone(),
        };
        let Node { kind, span } = self.with_parameters(node, pattern);
        let kind = match kind {
            Kind::Map(entries) => {
                let filled = entries.into_iter().map(|(key, value)| {
                    let value = self.fill(&value, &path::under(pattern, &key.text));
                    (key, value)
                });
                Kind::Map(filled.collect())
            }
            Kind::Seq(items) => {
                let pattern = format!("{pattern}[]");
                Kind::Seq(items.iter().map(|item| self.fill(item, &pattern)).collect())
            }
            scalar => scalar,
        };
        Node { kind, span }
    }

    /// `ripples` or `{ripples: {…}}` with the parameters that it does not say.
    fn with_parameters(&self, node: Node, pattern: &str) -> Node {
        let Some(kinds) = self.kinds.get(pattern) else { return node };
        let entry = match &node.kind {
            Kind::Text(kind) => kinds.get(kind).map(|usual| (word(kind, &node.span), usual.clone(), &node.span)),
            Kind::Map(entries) => match entries.as_slice() {
                [(key, value)] => kinds.get(&key.text).map(|usual| match value.kind {
                    Kind::Null => (key.clone(), usual.clone(), &key.span),
                    _ => (key.clone(), value.merged_over(usual), &value.span),
                }),
                _ => None,
            },
            _ => None,
        };
        match entry {
            // The map of parameters stands where the user named the kind: there belongs what is missing in it.
            Some((key, value, span)) => {
                let value = Node { kind: value.kind, span: span.clone() };
                Node { kind: Kind::Map(vec![(key, value)]), span: node.span.clone() }
            }
            None => node,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: &str = "
sonar: {mount: {pitch_deg: -15, yaw_deg: 0}}
trajectory: {hover: {altitude_m: 5}}
kinds:
  seabed.shape: {flat: {}, ripples: {height_m: 0.03, wavelength_m: {uniform: [0.1, 0.5]}}}
  trajectory: {hover: {yaw_deg: 0}, orbit: {radius_m: 4}}
  \"objects[].pose\": {rest: {burial: 0, tip_deg: 0}, hang: {height_m: 1}}
sections:
  \"objects[]\": {count: 1, pose: {rest: {}}}
";

    fn completed(text: &str) -> Node {
        let defaults = Defaults::of(&parse("defaults", SMALL, Origin::BuiltIn).unwrap());
        defaults.complete(&parse("a", text, Origin::Given).unwrap())
    }

    fn at(text: &str, path: &str) -> String {
        completed(text).at(path).unwrap_or_else(|| panic!("nothing at {path}")).json().to_string()
    }

    #[test]
    fn values_lists_and_kinds_are_filled() {
        assert_eq!(at("sonar: {mount: {pitch_deg: 3}}", "sonar.mount"), r#"{"pitch_deg":3,"yaw_deg":0}"#);
        assert_eq!(at("a: 1", "trajectory"), r#"{"hover":{"altitude_m":5,"yaw_deg":0}}"#);
        assert_eq!(at("trajectory: orbit", "trajectory"), r#"{"orbit":{"radius_m":4}}"#);
        assert_eq!(at("trajectory: {orbit: {radius_m: 9}}", "trajectory"), r#"{"orbit":{"radius_m":9}}"#);
        assert_eq!(at("trajectory: {file: a.csv}", "trajectory"), r#"{"file":"a.csv"}"#);
        assert_eq!(at("trajectory: {orbit: }", "trajectory"), r#"{"orbit":{"radius_m":4}}"#);
        assert_eq!(at("seabed: {shape: flat}", "seabed.shape"), r#"{"flat":{}}"#);
        assert!(completed("a: 1").get("seabed").is_none());
        let objects = "objects: [{label: tire}, {pose: hang, count: {int: [1, 2]}}]";
        assert_eq!(at(objects, "objects[0]"), r#"{"count":1,"label":"tire","pose":{"rest":{"burial":0,"tip_deg":0}}}"#);
        assert_eq!(at(objects, "objects[1]"), r#"{"count":{"int":[1,2]},"pose":{"hang":{"height_m":1}}}"#);
    }

    #[test]
    fn choices_of_kinds_and_items_are_filled_inside() {
        let ripples = r#"{"ripples":{"height_m":0.03,"wavelength_m":{"uniform":[0.1,0.5]}}}"#;
        let listed = at("seabed: {shape: {choice: [flat, {ripples: {wavelength_m: 1}}]}}", "seabed.shape");
        assert_eq!(listed, r#"{"choice":[{"flat":{}},{"ripples":{"height_m":0.03,"wavelength_m":1}}]}"#);
        let weighted = at("seabed: {shape: {choice: {flat: 1, ripples: 2}}}", "seabed.shape");
        assert_eq!(weighted, format!(r#"{{"choice":[{{"flat":{{}}}},{ripples}],"weights":[1,2]}}"#));
        let items = at("objects: [{choice: [{label: a}, {label: b, count: 2}]}]", "objects[0].choice[1]");
        assert_eq!(items, r#"{"count":2,"label":"b","pose":{"rest":{"burial":0,"tip_deg":0}}}"#);
        let unknown = at("seabed: {shape: {choice: {flat: 1, hills: 2}}}", "seabed.shape.choice[1]");
        assert_eq!(unknown, "\"hills\"");
    }

    #[test]
    fn what_is_filled_is_located_where_the_user_named_it() {
        let tree = completed("seabed:\n  shape: ripples\n");
        let place = |path| tree.at(path).unwrap().span.to_string();
        assert_eq!(place("seabed.shape.ripples"), "a:2:10");
        assert!(place("seabed.shape.ripples.height_m").starts_with("defaults:5:"));
        assert_eq!(tree.error("seabed.shape.ripples.height_m", "bad", "").span.to_string(), "a:2:10");
    }

    #[test]
    fn the_built_in_defaults_hold_together() {
        let defaults = Defaults::of(&parse("defaults", DEFAULTS, Origin::BuiltIn).unwrap());
        for section in [&defaults.kinds, &defaults.sections] {
            assert!(!section.entries().is_empty());
            for (pattern, values) in section.entries() {
                assert!(path::steps(&pattern.text.replace("[]", "[0]")).is_ok(), "{}", pattern.text);
                assert!(matches!(values.kind, Kind::Map(_)), "{}", pattern.text);
            }
        }
        let tree = parse("defaults", DEFAULTS, Origin::BuiltIn).unwrap();
        tree.check_distributions("", crate::recipe::Level::Frame(0)).unwrap();
    }
}
