//! Laying one tree over another: what the user wrote over what holds otherwise.

use super::distribution::key_value;
use super::node::{Key, Kind, Node, Style};
use super::path;
use super::source::Span;

impl Node {
    /// This tree laid over `under`: maps merge key by key, everything else of this tree replaces what is under it.
    ///
    /// A distribution replaces whole; only the maps among the values of a `choice` are laid over a map under it, each for
    /// itself. The keys of `under` that this tree does not have come last, in their order. Places are kept.
    #[must_use]
    pub fn merged_over(&self, under: &Self) -> Self {
        merge(self, under, "", &|_| false)
    }
}

/// [`Node::merged_over`] that takes values whole where `whole` says so of their pattern (`objects[].pose`).
pub(super) fn merge(over: &Node, under: &Node, pattern: &str, whole: &dyn Fn(&str) -> bool) -> Node {
    if !matches!(under.kind, Kind::Map(_)) || under.is_distribution() || whole(pattern) {
        return over.clone();
    }
    if over.is_distribution() {
        return map_choices(over, &|value| merge(value, under, pattern, whole));
    }
    let Kind::Map(entries) = &over.kind else { return over.clone() };
    let merged = entries.iter().map(|(key, value)| {
        let pattern = path::under(pattern, &key.text);
        let value = under.get(&key.text).map_or_else(|| value.clone(), |below| merge(value, below, &pattern, whole));
        (key.clone(), value)
    });
    let rest = under.entries().iter().filter(|(key, _)| over.get(&key.text).is_none()).cloned();
    Node { kind: Kind::Map(merged.chain(rest).collect()), span: over.span.clone() }
}

/// The distribution with `change` made to each value of its list of choices; other distributions as they are.
pub(super) fn map_choices(distribution: &Node, change: &dyn Fn(&Node) -> Node) -> Node {
    let changed = distribution.entries().iter().map(|(key, value)| match &value.kind {
        Kind::Seq(items) if key.text == "choice" => {
            (key.clone(), Node { kind: Kind::Seq(items.iter().map(change).collect()), span: value.span.clone() })
        }
        _ => (key.clone(), value.clone()),
    });
    Node { kind: Kind::Map(changed.collect()), span: distribution.span.clone() }
}

/// `{choice: {a: 1, b: 2}}` as `{choice: [a, b], weights: [1, 2]}`, so that its words can become maps; others as they are.
pub(super) fn spread_weights(distribution: &Node) -> Node {
    let Some(Node { kind: Kind::Map(weighted), span }) = distribution.get("choice") else {
        return distribution.clone();
    };
    if distribution.get("weights").is_some() {
        return distribution.clone();
    }
    let seq = |items: Vec<Node>| Node { kind: Kind::Seq(items), span: span.clone() };
    let values = seq(weighted.iter().map(|(key, _)| key_value(key)).collect());
    let weights = seq(weighted.iter().map(|(_, weight)| weight.clone()).collect());
    let replaced = distribution
        .entries()
        .iter()
        .map(|(key, value)| (key.clone(), if key.text == "choice" { values.clone() } else { value.clone() }));
    let entries = replaced.chain([(word("weights", span), weights)]).collect();
    Node { kind: Kind::Map(entries), span: distribution.span.clone() }
}

/// A key that the user did not write, at the place of what it belongs to.
pub(super) fn word(text: &str, span: &Span) -> Key {
    Key { text: text.to_owned(), style: Style::Plain, span: span.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::{Origin, parse};

    fn merged(over: &str, under: &str) -> String {
        let tree = |text| parse("t", text, Origin::Given).unwrap();
        tree(over).merged_over(&tree(under)).json().to_string()
    }

    #[test]
    fn maps_merge_and_all_else_replaces() {
        for (over, under, expected) in [
            ("{a: {b: 1}}", "{a: {b: 2, c: 3}, d: 4}", r#"{"a":{"b":1,"c":3},"d":4}"#),
            ("{a: [1]}", "{a: [2, 3]}", r#"{"a":[1]}"#),
            ("{a: 1}", "{a: {b: 2}}", r#"{"a":1}"#),
            ("{a: null}", "{a: {b: 2}}", r#"{"a":null}"#),
            ("{a: {b: 2}}", "{a: 1}", r#"{"a":{"b":2}}"#),
            ("{a: {uniform: [0, 1]}}", "{a: {b: 2}}", r#"{"a":{"uniform":[0,1]}}"#),
            ("{a: {b: 1}}", "{a: {uniform: [0, 1]}}", r#"{"a":{"b":1}}"#),
            ("{a: {int: [0, 1]}}", "{a: {uniform: [0, 1]}}", r#"{"a":{"int":[0,1]}}"#),
            ("{a: {choice: [{b: 1}, word]}}", "{a: {c: 2}}", r#"{"a":{"choice":[{"b":1,"c":2},"word"]}}"#),
        ] {
            assert_eq!(merged(over, under), expected, "{over} over {under}");
        }
    }

    #[test]
    fn weights_are_spread_with_the_type_of_their_words() {
        let node = parse("t", "{choice: {1: 0.7, \"2\": 0.2, flat: 0.1}, per: scene}", Origin::Given).unwrap();
        let expected = r#"{"choice":[1,"2","flat"],"per":"scene","weights":[0.7,0.2,0.1]}"#;
        assert_eq!(spread_weights(&node).json().to_string(), expected);
    }
}
