//! Every value of every recipe set, taken out and added to, in texts of all line ends.

use super::*;
use crate::recipe::path::{item, under};
use crate::recipe::{Kind, Node};

fn yaml(text: &str) -> Node {
    parse("value", text, Origin::Given).unwrap()
}

/// Paths of all values below one.
fn paths(node: &Node, path: &str, found: &mut Vec<String>) {
    for (key, value) in node.entries() {
        found.push(under(path, &key.text));
        paths(value, &under(path, &key.text), found);
    }
    for (index, value) in node.items().iter().enumerate() {
        found.push(item(path, index));
        paths(value, &item(path, index), found);
    }
}

/// What can be done at a path.
fn acts(tree: &Node, path: &str) -> Vec<Act> {
    let long = format!(
        "{{one: {{{}}}, two: [1, {{a: b}}]}}",
        (0..30).map(|i| format!("key-{i}: {i}")).collect::<Vec<_>>().join(", ")
    );
    let values = ["7", "{uniform: [0.5, 3]}", "a: b # c", "[]", "[{pick: {catalog: starter}, count: 2}, x]", &long];
    let set = |text: &&str| Act::set(path, if text.contains('#') { super::super::act::word(text) } else { yaml(text) });
    // Half of the values each, in turn.
    let mut acts: Vec<Act> = values.iter().skip(path.len() % 2).step_by(2).map(set).collect();
    acts.push(Act::Remove { path: path.to_owned() });
    let node = tree.at(path).unwrap();
    if let Kind::Map(_) = node.kind {
        acts.extend(["new", "turbidity", "pick"].map(|key| Act::set(under(path, key), yaml("{rest: {within_m: 3}}"))));
    }
    if let Kind::Seq(items) = &node.kind {
        let insert = |index| Act::Insert { list: path.to_owned(), index, value: yaml("{pick: {uid: tire}, count: 2}") };
        acts.extend((0..=items.len()).map(insert));
    }
    acts
}

/// Lines of two texts that are alike at the beginning and at the end.
fn kept(before: &str, after: &str) -> (usize, usize) {
    let (before, after): (Vec<&str>, Vec<&str>) = (before.split('\n').collect(), after.split('\n').collect());
    if before == after {
        return (before.len(), before.len());
    }
    let front = before.iter().zip(&after).take_while(|(a, b)| a == b).count();
    let most = before.len().min(after.len()) - front;
    let back = before.iter().rev().zip(after.iter().rev()).take(most).take_while(|(a, b)| a == b).count();
    (front, back)
}

/// Lines that an act at a path may change: those of its value, with its key's, its comments and a blank line.
fn own_lines(text: &str, path: &str) -> (usize, usize) {
    let root = Place::of(text).unwrap();
    let steps = steps(path).unwrap();
    let around = root.at(&steps[..steps.len() - 1]).unwrap();
    let part = around.part(steps.last().unwrap()).unwrap().1;
    let column = lines::column(text, around.range.start);
    let mut first = lines::own_comments(text, part.start(), column);
    while let Some(above) = lines::previous(text, first)
        && lines::is_blank(lines::line(text, above))
    {
        first = above;
    }
    let last = lines::next(text, lines::entry_end(text, part.place.range.end, column));
    (text[..first].matches('\n').count(), text[last..].matches('\n').count())
}

fn try_all(name: &str, text: &str) -> usize {
    let tree = parse(name, text, Origin::Given).unwrap();
    let mut found = Vec::new();
    paths(&tree, "", &mut found);
    let mut tried = 0;
    for path in &found {
        for act in acts(&tree, path) {
            let mut wanted = tree.clone();
            act.on(&mut wanted).unwrap();
            let after = apply(name, text, &act).unwrap_or_else(|error| panic!("{act:?} in\n{text}\n{error}"));
            assert_eq!(parse(name, &after, Origin::Given).unwrap().json(), wanted.json(), "{act:?}");
            let ((front, back), (own_front, own_back)) = (kept(text, &after), own_lines(text, path));
            // A part that is added or goes stands right before or behind its neighbours.
            let whole = matches!(act, Act::Insert { .. } | Act::Remove { .. }) || tree.at(act.path()).is_none();
            let slack = if whole { 2 } else { 0 };
            assert!(front + slack >= own_front && back + slack >= own_back, "{act:?} in {name}:\n{after}");
            assert_eq!(after.starts_with('\u{feff}'), text.starts_with('\u{feff}'));
            assert!(!text.contains('\r') || after.matches('\n').count() == after.matches("\r\n").count());
            tried += 1;
        }
    }
    tried
}

#[test]
fn every_value_of_every_recipe_can_be_changed() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes");
    let mut tried = 0;
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.display().to_string();
        tried += try_all(&name, &text);
        if name.ends_with("quickstart.yaml") {
            tried += try_all(&name, &text.replace('\n', "\r\n"));
            tried += try_all(&name, &format!("\u{feff}{}", text.trim_end()));
        }
    }
    assert!(tried > 5000, "{tried}");
}

#[test]
fn other_ways_of_writing_are_kept() {
    tried_and_kept(
        "list:\n- a: 1\n  b: 2\n\n- c: 3 # c\n# own\n- [x,y , z ]\n-   - 1\n    - 2\nmap: {a: 1,\n  b: [2,\n   3], }\n",
    );
    tried_and_kept(
        "a:\n    - b: 'it''s'\n\n      c: \"q # r\"   # s\n      # of d\n      d:\n    - e: |\n        two\n        lines\n\n\n# end\nf: >-\n  g\n",
    );
    tried_and_kept("{a: 1, b: {c: [1, 2], d: }, e: [], f: {}}");
}

fn tried_and_kept(text: &str) {
    assert!(try_all("a", text) > 10);
}

fn edited(text: &str, act: &Act) -> String {
    apply("a", text, act).unwrap()
}

#[test]
fn what_a_careful_person_would_write() {
    let text = "ensonify: 1\nseed: 7         # of draws\n\nwater:   # cold\n  ph: 8\n\nobjects:\n  # tires\n  - pick: {uid: tire}\n    count: 2\n  # an anchor\n  - pick: {uid: anchor}\n\nlooks:\n  - {name: a}\n";
    for (act, from, to) in [
        (Act::set("seed", yaml("12345")), "seed: 7         # of draws", "seed: 12345     # of draws"),
        (Act::set("frames", yaml("3")), "draws\n", "draws\nframes: 3\n"),
        (Act::set("water.depth_m", yaml("3")), "ph: 8\n", "ph: 8\n  depth_m: 3\n"),
        (Act::set("water.temperature_c", yaml("3")), "  ph: 8\n", "  temperature_c: 3\n  ph: 8\n"),
        (Act::set("water", yaml("null")), "water:   # cold\n  ph: 8\n", "water: null   # cold\n"),
        (Act::set("seabed.shape", yaml("flat")), "ph: 8\n\n", "ph: 8\n\nseabed:\n  shape: flat\n\n"),
        (Act::set("splits.by", yaml("asset")), "name: a}\n", "name: a}\n\nsplits: {by: asset}\n"),
        (Act::Remove { path: "objects[0]".into() }, "  # tires\n  - pick: {uid: tire}\n    count: 2\n", ""),
        (Act::Remove { path: "objects[1]".into() }, "  # an anchor\n  - pick: {uid: anchor}\n", ""),
        (Act::Remove { path: "water".into() }, "water:   # cold\n  ph: 8\n\n", ""),
        (Act::Remove { path: "water.ph".into() }, "water:   # cold\n  ph: 8\n", "water: {}   # cold\n"),
        (
            Act::Insert { list: "objects".into(), index: 2, value: yaml("{pick: {uid: crate}, count: 3}") },
            "  - pick: {uid: anchor}\n",
            "  - pick: {uid: anchor}\n  - pick: {uid: crate}\n    count: 3\n",
        ),
        (
            Act::Insert { list: "looks".into(), index: 1, value: yaml("{name: b}") },
            "{name: a}\n",
            "{name: a}\n  - {name: b}\n",
        ),
        (Act::set("objects[1].count", yaml("5")), "uid: anchor}\n", "uid: anchor}\n    count: 5\n"),
        (Act::set("objects[0].label", yaml("x")), "- pick: {uid: tire}\n", "- label: x\n    pick: {uid: tire}\n"),
        (Act::set("objects[0].pick.uid", yaml("[tire, car-wheel]")), "{uid: tire}", "{uid: [tire, car-wheel]}"),
    ] {
        assert_eq!(edited(text, &act), text.replacen(from, to, 1), "{act:?}");
    }
}

#[test]
fn ways_of_writing_that_cannot_be_changed_are_refused() {
    let error = apply("a", "? a\n: b: 1\n", &Act::set("a.b", yaml("2"))).map(|text| yaml(&text).json().to_string());
    assert!(error.is_err() || error == Ok(r#"{"a":{"b":2}}"#.to_owned()));
    assert!(apply("a", "a: [", &Act::set("a", yaml("2"))).is_err());
}
