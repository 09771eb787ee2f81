//! Draws: what moves them, and what must not.
#![cfg(unix)]

mod support;

use std::collections::BTreeMap;

use ensonify::recipe::{Address, Kind, Level, Node, Origin, parse};
use serde_json::Value;
use support::cli::{Desk, messages, small_recipe};

fn plan(desk: &Desk, text: &str) -> Value {
    desk.file("a.yaml", text);
    let output = desk.run(&["plan", "a.yaml", "--json"]);
    assert!(output.status.success(), "{}", messages(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Every draw of a plan, by scene or job and path.
fn draws(plan: &Value) -> BTreeMap<String, Value> {
    let mut draws = BTreeMap::new();
    for list in ["scenes", "jobs"] {
        for (i, item) in plan[list].as_array().expect("a list").iter().enumerate() {
            for (path, value) in item["drawn"].as_object().expect("draws") {
                draws.insert(format!("{list}[{i}] {path}"), value.clone());
            }
        }
    }
    draws
}

/// Asserts that all draws of the first plan are in the second, the same.
fn kept(before: &Value, after: &Value) {
    let (before, after) = (draws(before), draws(after));
    assert!(!before.is_empty());
    for (path, value) in &before {
        assert_eq!(after.get(path), Some(value), "{path}");
    }
}

/// The plan hash that a command line gives.
fn hash(command: &mut std::process::Command) -> String {
    let output = command.output().expect("started");
    assert!(output.status.success(), "{}", messages(&output));
    String::from_utf8(output.stdout).expect("text").lines().next().expect("a line").to_owned()
}

#[test]
fn a_new_field_or_object_moves_no_other_draw() {
    let desk = Desk::new();
    let before = plan(&desk, &small_recipe(5));
    let object = "  - {pick: {catalog: starter, label: rock}, count: {int: [0, 4]}, pose: {rest: {burial: {uniform: [0, 1]}}}}\ntrajectory";
    for (from, to) in [
        ("frequency_khz: 900", "frequency_khz: {uniform: [700, 900], per: frame}"),
        ("water: {", "water: {ph: {uniform: [7, 8]}, "),
        ("extent_m: 20", "extent_m: {uniform: [20, 24]}"),
        ("within_m: 2", "within_m: 2, burial: {uniform: [0, 0.3]}"),
        ("altitude_m: 1.8", "altitude_m: {normal: [1.8, 0.1]}"),
        ("seed: 5", "seed: 5\nlet: {a: {uniform: [0, 1]}}"),
        ("seed: 5", "seed: 5\nimage: {tvg_db_per_decade: {uniform: [20, 40]}}"),
        ("trajectory", object),
    ] {
        let text = small_recipe(5).replacen(from, to, 1);
        assert_ne!(text, small_recipe(5));
        let after = plan(&desk, &text);
        kept(&before, &after);
        assert!(draws(&after).len() > draws(&before).len(), "{to} is drawn");
        let models = |plan: &Value| -> Vec<Value> {
            let scenes = plan["scenes"].as_array().expect("scenes").iter();
            scenes.map(|scene| scene["spec"]["bodies"][0]["uid"].clone()).collect()
        };
        assert_eq!(models(&before), models(&after), "{to} chooses no other model");
    }
}

#[test]
fn more_scenes_and_frames_move_no_other_draw() {
    let desk = Desk::new();
    let few = plan(&desk, &small_recipe(3));
    let many = plan(&desk, &small_recipe(9));
    kept(&few, &many);
    for (a, b) in few["scenes"].as_array().expect("scenes").iter().zip(many["scenes"].as_array().expect("scenes")) {
        assert_eq!(a, b, "a scene stays what it is, its split too");
    }
}

/// The tree with the keys of every map the other way round.
fn turned(node: &Node) -> Node {
    let kind = match &node.kind {
        Kind::Map(entries) => {
            Kind::Map(entries.iter().rev().map(|(key, value)| (key.clone(), turned(value))).collect())
        }
        Kind::Seq(items) => Kind::Seq(items.iter().map(turned).collect()),
        other => other.clone(),
    };
    Node { kind, span: node.span.clone() }
}

#[test]
fn the_order_of_keys_changes_nothing() {
    let desk = Desk::new();
    let tree = parse("a.yaml", &small_recipe(4), Origin::Given).expect("YAML");
    let before = plan(&desk, &small_recipe(4));
    // JSON is YAML, with its keys in alphabetical order.
    let sorted = plan(&desk, &tree.json().to_string());
    assert_eq!(before, sorted);
    let address = Address { seed: 5, scene: 2, level: Level::Scene };
    let drawn = |tree: &Node| tree.draw("", &address).expect("drawn").json();
    assert_eq!(drawn(&tree), drawn(&turned(&tree)));
}

#[test]
fn a_sweep_of_two_by_three_shares_all_that_it_does_not_sweep() {
    let desk = Desk::new();
    let plain = plan(&desk, &small_recipe(2));
    let sweep = "sweep: {grid: {sonar.beams: [64, 96], water.salinity_ppt: [0, 20, 35]}}\n";
    let swept = plan(&desk, &(small_recipe(2) + sweep));
    let variants = swept["variants"].as_array().expect("variants");
    assert_eq!(variants.len(), 6);
    let jobs = swept["jobs"].as_array().expect("jobs");
    let scenes = swept["scenes"].as_array().expect("scenes");
    assert_eq!((scenes.len(), jobs.len()), (12, 36));
    for (number, variant) in variants.iter().enumerate() {
        let of_variant = |list: &'_ [Value], each: usize| list[number * each..(number + 1) * each].to_vec();
        let part = serde_json::json!({"scenes": of_variant(scenes, 2), "jobs": of_variant(jobs, 6)});
        assert_eq!(draws(&part), draws(&plain), "variant {number} draws what the plain recipe does");
        for job in part["jobs"].as_array().expect("jobs") {
            assert_eq!(job["sonar"]["beams"], variant["set"]["sonar.beams"]);
            let salinity = job["looks"][0]["water"]["salinity_ppt"].as_f64();
            assert_eq!(salinity, variant["set"]["water.salinity_ppt"].as_f64());
        }
    }
}

#[test]
fn the_plan_hash_does_not_depend_on_where_and_how_the_program_runs() {
    let desk = Desk::new();
    let recipe = desk.file("deep/down/a.yaml", &small_recipe(3));
    desk.file("elsewhere/x", "");
    let usual = hash(&mut desk.command(&["plan", "deep/down/a.yaml"]));
    assert!(usual.starts_with("plan hash ") && usual.len() == 74, "{usual}");
    let absolute = recipe.to_str().expect("text");
    for path in ["deep/down/../down/a.yaml", "./deep//down/a.yaml", absolute] {
        assert_eq!(hash(&mut desk.command(&["plan", path])), usual, "{path}");
    }
    for (folder, path) in [("deep/down", "a.yaml"), ("elsewhere", "../deep/down/a.yaml"), ("elsewhere", absolute)] {
        let mut command = desk.command(&["plan", path]);
        assert_eq!(hash(command.current_dir(desk.path().join(folder))), usual, "in {folder}: {path}");
    }
    for (key, value) in [
        ("LC_ALL", "de_DE.UTF-8"),
        ("LANG", "tr_TR.UTF-8"),
        ("TZ", "Pacific/Kiritimati"),
        ("RAYON_NUM_THREADS", "7"),
        ("HOME", "/nowhere"),
        ("COLUMNS", "20"),
    ] {
        assert_eq!(hash(desk.command(&["plan", "deep/down/a.yaml"]).env(key, value)), usual, "{key}={value}");
    }
    let mut bare = desk.command(&["plan", "deep/down/a.yaml"]);
    assert_eq!(hash(bare.env_clear()), usual, "without any environment");
    // Comments, spaces and the style of the YAML are not drawn from.
    desk.file(
        "b.yaml",
        &format!("# words\n{}\n\n", small_recipe(3).replace("{uniform: [4, 22]}", "{ 'uniform' : [ 4.0, 22 ] }")),
    );
    assert_eq!(hash(&mut desk.command(&["plan", "b.yaml"])), usual);
}
