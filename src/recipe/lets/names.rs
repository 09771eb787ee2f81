//! Names in a recipe: which texts refer to one, and in which order names can be given values.

use std::collections::{BTreeMap, BTreeSet};

use super::LET;
use crate::recipe::error::{Error, quoted};
use crate::recipe::nearest::did_you_mean;
use crate::recipe::node::{Key, Kind, Node};
use crate::recipe::path;

/// The name that a text refers to.
pub(super) fn reference(text: &str) -> Option<&str> {
    text.strip_prefix('$').filter(|name| is_name(name))
}

pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-')
        && text.len() <= 64
}

/// `$$name` is the text `$name`.
fn is_escape(text: &str) -> bool {
    text.strip_prefix('$').is_some_and(|rest| reference(rest).is_some())
}

/// Whether a name or an escape stands anywhere in a tree.
pub(super) fn has_dollar(node: &Node) -> bool {
    let in_children =
        || node.entries().iter().any(|(_, value)| has_dollar(value)) || node.items().iter().any(has_dollar);
    node.text().is_some_and(|text| text.starts_with('$')) || in_children()
}

pub(super) fn unescaped(node: Node) -> Node {
    let kind = match node.kind {
        Kind::Text(text) if is_escape(&text) => Kind::Text(text[1..].to_owned()),
        Kind::Map(entries) => Kind::Map(entries.into_iter().map(|(key, value)| (key, unescaped(value))).collect()),
        Kind::Seq(items) => Kind::Seq(items.into_iter().map(unescaped).collect()),
        other => other,
    };
    Node { kind, span: node.span }
}

/// Calls `found` with every name that a tree refers to, in order.
pub(super) fn references<'a>(node: &'a Node, found: &mut dyn FnMut(&'a str, &'a Node)) {
    if let Some(name) = node.text().and_then(reference) {
        found(name, node);
    }
    node.entries().iter().for_each(|(_, value)| references(value, found));
    node.items().iter().for_each(|item| references(item, found));
}

/// Refuses names that `let` does not have.
pub(super) fn check_names(node: &Node, at: &str, names: &[&str]) -> Result<(), Error> {
    if let Some(name) = node.text().and_then(reference).filter(|name| names.binary_search(name).is_err()) {
        let message = format!("`let` has no name {}", quoted(name));
        let help = match names {
            [] => format!("write `let: {{{name}: …}}`; `$${name}` is the text itself"),
            names => did_you_mean(name, names),
        };
        return Err(Error::new(&node.span, at, message, help));
    }
    let mut entries = node.entries().iter();
    entries.try_for_each(|(key, value)| check_names(value, &path::under(at, &key.text), names))?;
    node.items().iter().enumerate().try_for_each(|(i, item)| check_names(item, &path::item(at, i), names))
}

/// Indices of the names, each after those that it refers to.
pub(super) fn order(named: &[(Key, Node)]) -> Result<Vec<usize>, Error> {
    let places: BTreeMap<&str, usize> = named.iter().enumerate().map(|(i, (key, _))| (key.text.as_str(), i)).collect();
    let mut names: Vec<&str> = places.keys().copied().collect();
    names.sort_unstable();
    // Kahn's algorithm, in the order of the file among those that are ready.
    let mut refers: Vec<BTreeSet<usize>> = Vec::new();
    for (key, node) in named {
        check_names(node, &path::under(LET, &key.text), &names)?;
        let mut to = BTreeSet::new();
        references(node, &mut |name, _| {
            to.extend(places.get(name));
        });
        refers.push(to);
    }
    let mut referred: Vec<Vec<usize>> = vec![Vec::new(); named.len()];
    refers.iter().enumerate().for_each(|(from, to)| to.iter().for_each(|&to| referred[to].push(from)));
    let mut ready: BTreeSet<usize> = (0..named.len()).filter(|&i| refers[i].is_empty()).collect();
    let mut order = Vec::new();
    while let Some(next) = ready.pop_first() {
        order.push(next);
        for &from in &referred[next] {
            refers[from].remove(&next);
            if refers[from].is_empty() {
                ready.insert(from);
            }
        }
    }
    match (0..named.len()).find(|&i| !refers[i].is_empty()) {
        Some(first) => Err(circle(first, named, &refers)),
        None => Ok(order),
    }
}

/// The fault of names that refer to each other in a circle, told from the one that stands first. Every name that is left
/// refers to one that is left, so following them from anywhere comes round in the end.
fn circle(start: usize, named: &[(Key, Node)], refers: &[BTreeSet<usize>]) -> Error {
    let (mut walk, mut places, mut at) = (Vec::new(), BTreeMap::new(), start);
    while let (None, Some(&next)) = (places.get(&at), refers[at].first()) {
        places.insert(at, walk.len());
        walk.push(at);
        at = next;
    }
    let mut round = walk.split_off(places.get(&at).copied().unwrap_or_default());
    let first = round.iter().enumerate().min_by_key(|(_, name)| **name).map_or(0, |(place, _)| place);
    round.rotate_left(first);
    let mut words: Vec<&str> = round.iter().take(8).map(|&name| named[name].0.text.as_str()).collect();
    words.push(if round.len() > 8 { "…" } else { words[0] });
    let message = format!("{} refers to itself: {}", quoted(words[0]), words.join(" → "));
    Error::new(&named[round[0]].0.span, LET, message, "give one of them a value of its own")
}
