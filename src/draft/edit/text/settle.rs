//! What must be written anew so that one tree becomes another: as little as possible.

use super::order::place_of;
use crate::recipe::path::{item, under};
use crate::recipe::{Key, Kind, Node};

/// One edit of a text; paths are those of the text as the edits before left it.
#[derive(Debug, PartialEq)]
pub(super) enum Edit {
    /// Another value.
    Replace(String, Node),
    /// A key or an item more, before the part of that number.
    Add {
        /// Map or list.
        path: String,
        /// Its number there.
        index: usize,
        /// What.
        entry: Entry,
    },
    /// A key or an item less.
    Drop(String),
}

/// What is added.
#[derive(Debug, PartialEq)]
pub(super) struct Entry {
    /// None of an item.
    pub key: Option<Key>,
    pub value: Node,
    /// Whether it is a section of the recipe.
    pub is_section: bool,
}

/// The edits that make one tree of another.
pub(super) fn edits(old: &Node, new: &Node) -> Vec<Edit> {
    let mut edits = Vec::new();
    settle(old, new, "", &mut edits);
    edits
}

fn settle(old: &Node, new: &Node, path: &str, edits: &mut Vec<Edit>) {
    if same(old, new) {
        return;
    }
    match (&old.kind, &new.kind) {
        (Kind::Map(before), Kind::Map(after)) if before.iter().any(|(key, _)| new.get(&key.text).is_some()) => {
            maps(before, after, path, edits);
        }
        (Kind::Seq(before), Kind::Seq(after)) if !before.is_empty() && !after.is_empty() => {
            lists(before, after, path, edits);
        }
        _ => edits.push(Edit::Replace(path.to_owned(), new.clone())),
    }
}

fn maps(before: &[(Key, Node)], after: &[(Key, Node)], path: &str, edits: &mut Vec<Edit>) {
    let find = |entries: &[(Key, Node)], key: &Key| entries.iter().position(|(k, _)| k.text == key.text);
    let others = after.iter().any(|(key, _)| find(before, key).is_none());
    if path.ends_with(".choice") && others {
        // Words with their weights are one thing: they keep the order of what they were.
        let map = Node { kind: Kind::Map(after.to_vec()), span: after[0].1.span.clone() };
        edits.push(Edit::Replace(path.to_owned(), map));
        return;
    }
    for (key, value) in before {
        if let Some(index) = find(after, key) {
            settle(value, &after[index].1, &under(path, &key.text), edits);
        }
    }
    let mut keys: Vec<&str> = before.iter().map(|(key, _)| key.text.as_str()).collect();
    for (key, value) in after.iter().filter(|(key, _)| find(before, key).is_none()) {
        let index = place_of(path, &keys, &key.text);
        keys.insert(index, &key.text);
        let entry = Entry { key: Some(key.clone()), value: value.clone(), is_section: path.is_empty() };
        edits.push(Edit::Add { path: path.to_owned(), index, entry });
    }
    for (key, _) in before.iter().filter(|(key, _)| find(after, key).is_none()) {
        edits.push(Edit::Drop(under(path, &key.text)));
    }
}

fn lists(before: &[Node], after: &[Node], path: &str, edits: &mut Vec<Edit>) {
    let alike = |pair: &(&Node, &Node)| same(pair.0, pair.1);
    let front = before.iter().zip(after).take_while(alike).count();
    let back = before[front..].iter().rev().zip(after[front..].iter().rev()).take_while(alike).count();
    let (old, new) = (&before[front..before.len() - back], &after[front..after.len() - back]);
    let both = old.len().min(new.len());
    for (index, (old, new)) in old.iter().zip(new).enumerate() {
        settle(old, new, &item(path, front + index), edits);
    }
    for (index, value) in new.iter().enumerate().skip(both) {
        let entry = Entry { key: None, value: value.clone(), is_section: false };
        edits.push(Edit::Add { path: path.to_owned(), index: front + index, entry });
    }
    edits.extend((both..old.len()).rev().map(|index| Edit::Drop(item(path, front + index))));
}

fn same(a: &Node, b: &Node) -> bool {
    a.json() == b.json()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::{Origin, parse};

    fn told(old: &str, new: &str) -> Vec<String> {
        let tree = |text| parse("a", text, Origin::Given).unwrap();
        let tell = |edit| match edit {
            Edit::Replace(path, value) => format!("{path} = {}", value.json()),
            Edit::Add { path, index, entry } => format!("{path} + {index} {}", entry.value.json()),
            Edit::Drop(path) => format!("- {path}"),
        };
        edits(&tree(old), &tree(new)).into_iter().map(tell).collect()
    }

    #[test]
    fn as_little_as_possible_is_written_anew() {
        for (old, new, edits) in [
            ("{a: {uniform: [4, 22]}}", "{a: {uniform: [4, 9]}}", &["a.uniform[1] = 9"][..]),
            ("{a: {uniform: [4, 22]}}", "{a: 3}", &["a = 3"]),
            ("{a: {x: 1}}", "{a: {y: 1}}", &["a = {\"y\":1}"]),
            ("{a: {x: 1, z: 2}}", "{a: {z: 2, y: 1}}", &["a + 2 1", "- a.x"]),
            ("[1, 2, 3]", "[1, 3]", &["- [1]"]),
            ("[1, 2, 3, 4]", "[1, 5, 6, 7, 4]", &["[1] = 5", "[2] = 6", " + 3 7"]),
            ("[1]", "[1]", &[]),
            ("{a: []}", "{a: [1]}", &["a = [1]"]),
        ] {
            assert_eq!(told(old, new), edits, "{old} {new}");
        }
    }
}
