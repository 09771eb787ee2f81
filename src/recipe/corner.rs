//! Corners of distributions: what is extreme of all that could be drawn, one leaf at a time.
//!
//! A corner puts one leaf at one of its extreme values; every other leaf stays as it is drawn. So their number is that of the
//! ends of all distributions together, and each is a tree that a draw can give, or come as near to as one likes.

use super::distribution::{Distribution, Law, Number};
use super::error::{Error, quoted};
use super::node::{Kind, Node};
use super::path;
use super::source::Span;

/// Standard deviations from the mean that count as the end of a normal distribution without `min` or `max`: one draw of 370
/// lies beyond.
const NORMAL_ENDS: f64 = 3.0;

/// One leaf at one of its extreme values.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Choices on the way to the leaf, then the leaf itself.
    forced: Vec<Forced>,
}

/// What a distribution gives, whatever its stream says.
#[derive(Clone, Debug, PartialEq)]
struct Forced {
    path: String,
    /// Looks have distributions of their own at the same path.
    span: Span,
    given: Given,
    /// The value in words, for messages.
    what: String,
}

/// What is given instead of a draw.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Given {
    /// A number.
    Number(Kind),
    /// One of the values of a choice, by its place among them.
    Choice(usize),
}

impl Corner {
    /// What a distribution gives at this corner; `None` where it is drawn.
    pub(super) fn given(&self, node: &Node, path: &str) -> Option<&Given> {
        let here = |forced: &&Forced| forced.path == path && forced.span == node.span;
        self.forced.iter().find(here).map(|forced| &forced.given)
    }

    /// Path of the leaf.
    #[must_use]
    pub fn path(&self) -> &str {
        self.forced.last().map_or("", |forced| &forced.path)
    }

    /// The fault that a recipe has at this corner, told at the distribution that leads there; at its own place where the
    /// program wrote that distribution.
    #[must_use]
    pub fn blame(&self, fault: Error) -> Error {
        let Some(Forced { path, span, what, .. }) = self.forced.last() else { return fault };
        let elsewhere = fault.path != *path && !fault.path.is_empty();
        let place = if elsewhere { format!(" ({})", fault.path) } else { String::new() };
        let message = format!("{what} could be drawn: {}{place}", fault.message);
        let span = if span.is_built_in() { &fault.span } else { span };
        Error::new(span, path, message, fault.help)
    }
}

impl Node {
    /// The corners of every distribution of this tree, those inside choices too; `path` is where the node stands.
    ///
    /// # Errors
    /// The first malformed distribution.
    pub fn corners(&self, path: &str) -> Result<Vec<Corner>, Error> {
        let mut found = Vec::new();
        walk(self, path, &[], &mut found)?;
        Ok(found)
    }
}

/// `way` leads to the node.
fn walk(node: &Node, path: &str, way: &[Forced], found: &mut Vec<Corner>) -> Result<(), Error> {
    let Some(distribution) = Distribution::read(node, path)? else {
        let mut entries = node.entries().iter();
        entries.try_for_each(|(key, value)| walk(value, &path::under(path, &key.text), way, found))?;
        let mut items = node.items().iter().enumerate();
        return items.try_for_each(|(i, value)| walk(value, &path::item(path, i), way, found));
    };
    let further = |given, value: &Node| {
        let what = shown(value);
        let forced = Forced { path: path.to_owned(), span: node.span.clone(), given, what };
        way.iter().cloned().chain([forced]).collect::<Vec<_>>()
    };
    match &distribution.law {
        Law::Number(law) => {
            found.extend(ends(*law).into_iter().map(|end| {
                let value = Node { kind: end.clone(), span: node.span.clone() };
                Corner { forced: further(Given::Number(end), &value) }
            }));
        }
        Law::Choice(choices) => {
            for (i, choice) in choices.iter().enumerate().filter(|(_, choice)| choice.weight > 0.0) {
                let way = further(Given::Choice(i), &choice.value);
                let before = found.len();
                walk(&choice.value, path, &way, found)?;
                if found.len() == before {
                    found.push(Corner { forced: way });
                }
            }
        }
    }
    Ok(())
}

/// A value in a message, cut when long.
fn shown(value: &Node) -> String {
    match (value.text(), value.number()) {
        (Some(text), _) => quoted(text),
        (None, Some(number)) => number.to_string(),
        (None, None) => quoted(&value.json().to_string()),
    }
}

/// Smallest and largest value, once where they are the same.
fn ends(law: Number) -> Vec<Kind> {
    let floats = |low, high| [Kind::Float(low), Kind::Float(high)];
    let [low, high] = match law {
        Number::Uniform { low, high } | Number::LogUniform { low, high } => floats(low, high),
        Number::Normal { mean, sd, low, high } => {
            let end = |bound: f64, usual: f64| if bound.is_finite() { bound } else { usual.clamp(f64::MIN, f64::MAX) };
            floats(end(low, mean - NORMAL_ENDS * sd), end(high, mean + NORMAL_ENDS * sd))
        }
        Number::Int { low, high } => [Kind::Int(low.into()), Kind::Int(high.into())],
    };
    if low == high { vec![low] } else { vec![low, high] }
}

#[cfg(test)]
mod tests {
    use crate::recipe::{Address, Level, Origin, parse};

    const ADDRESS: Address = Address { seed: 1, scene: 0, level: Level::Scene };

    /// The trees at all corners of a text.
    fn trees(text: &str) -> Vec<String> {
        let tree = parse("a", text, Origin::Given).unwrap();
        let corners = tree.corners("").unwrap();
        corners.iter().map(|corner| tree.draw_at("", &ADDRESS, Some(corner)).unwrap().0.json().to_string()).collect()
    }

    #[test]
    fn each_law_has_its_ends() {
        assert_eq!(trees("{x: {uniform: [2, 5]}}"), [r#"{"x":2.0}"#, r#"{"x":5.0}"#]);
        assert_eq!(trees("{x: {log_uniform: [2, 2]}}"), [r#"{"x":2.0}"#]);
        assert_eq!(trees("{x: {normal: [10, 2]}}"), [r#"{"x":4.0}"#, r#"{"x":16.0}"#]);
        assert_eq!(trees("{x: {normal: [10, 2], min: 9}}"), [r#"{"x":9.0}"#, r#"{"x":16.0}"#]);
        assert_eq!(trees("{x: {int: [1, 3]}}"), [r#"{"x":1}"#, r#"{"x":3}"#]);
        assert_eq!(trees("{x: {choice: {a: 1, b: 0, c: 2}}}"), [r#"{"x":"a"}"#, r#"{"x":"c"}"#]);
        assert!(trees("{x: 3}").is_empty());
    }

    #[test]
    fn one_leaf_moves_and_the_others_stay_as_drawn() {
        let text = "{x: {uniform: [2, 5]}, y: {int: [0, 1000000]}, z: {choice: [1, {a: {uniform: [7, 8]}}]}}";
        let tree = parse("a", text, Origin::Given).unwrap();
        let drawn = tree.draw("", &ADDRESS).unwrap().json();
        let found = trees(text);
        assert_eq!(found.len(), 2 + 2 + 3);
        for (i, tree) in found.iter().enumerate() {
            let tree: serde_json::Value = serde_json::from_str(tree).unwrap();
            let same = ["x", "y", "z"].map(|key| tree[key] == drawn[key]);
            assert!(same.iter().filter(|same| **same).count() >= 2, "corner {i}: {tree}");
        }
        assert!(found[5].contains(r#""z":{"a":7.0}"#) && found[6].contains(r#""z":{"a":8.0}"#));
    }

    #[test]
    fn a_fault_is_told_where_the_distribution_stands() {
        let tree = parse("a", "x:\n  y: {uniform: [0, 5]}\n", Origin::Given).unwrap();
        let corner = &tree.corners("").unwrap()[0];
        let fault = corner.blame(tree.error("x", "too low", ""));
        assert_eq!((fault.span.to_string().as_str(), fault.path.as_str()), ("a:2:6", "x.y"));
        assert_eq!(fault.message, "0 could be drawn: too low (x)");
    }
}
