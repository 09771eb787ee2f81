//! What is kept together when frames are dealt out.
#![cfg(unix)]

mod support;

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;
use support::cli::{Desk, messages, small_recipe};

fn plan(text: &str) -> Value {
    let desk = Desk::new();
    desk.file("a.yaml", text);
    let output = desk.run(&["plan", "a.yaml", "--json"]);
    assert!(output.status.success(), "{}", messages(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn refusal(text: &str) -> String {
    let desk = Desk::new();
    desk.file("a.yaml", text);
    let output = desk.run(&["check", "a.yaml"]);
    assert_eq!(output.status.code(), Some(2), "{}", messages(&output));
    messages(&output)
}

/// Splits in which each value of `key` of the plan's scenes stands.
fn splits_of(plan: &Value, key: impl Fn(&Value) -> Vec<String>) -> BTreeMap<String, BTreeSet<String>> {
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for scene in plan["scenes"].as_array().expect("scenes") {
        for value in key(scene) {
            found.entry(value).or_default().insert(scene["split"].to_string());
        }
    }
    found
}

fn assets(scene: &Value) -> Vec<String> {
    scene["spec"]["bodies"].as_array().expect("bodies").iter().map(|body| body["uid"].to_string()).collect()
}

#[test]
fn no_model_stands_in_two_splits_when_they_are_dealt_out() {
    let by_asset = small_recipe(40) + "splits: {train: 0.6, val: 0.2, test: 0.2, by: asset}\n";
    let (by_asset, by_scene) = (plan(&by_asset), plan(&small_recipe(40)));
    let dealt = splits_of(&by_asset, assets);
    assert!(dealt.len() > 8 && dealt.values().all(|splits| splits.len() == 1), "{dealt:?}");
    assert_eq!(dealt.values().flatten().collect::<BTreeSet<_>>().len(), 3, "each split has models");
    assert!(splits_of(&by_scene, assets).values().any(|splits| splits.len() > 1));
}

#[test]
fn a_model_stays_in_its_split_when_others_come() {
    let dealt = |tags: &str| {
        let text = small_recipe(30).replace("tags: [debris]", tags);
        splits_of(&plan(&(text + "splits: {train: 0.5, val: 0, test: 0.5, by: asset}\n")), assets)
    };
    let (few, many) = (dealt("tags: [debris]"), dealt("label: null"));
    assert!(few.iter().filter_map(|(uid, split)| Some((split, many.get(uid)?))).all(|(a, b)| a == b));
}

#[test]
fn a_pick_without_a_model_in_a_split_is_refused() {
    let text =
        small_recipe(20).replace("tags: [debris]", "uid: tire").replace("seed: 5", "seed: 5\nsplits: {by: asset}");
    let message = refusal(&text);
    assert!(message.contains("a.yaml:11:") && message.contains("dealt to the split"), "{message}");
}

#[test]
fn variants_are_dealt_out_whole() {
    let sweep = "sweep: {grid: {water.depth_m: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]}}\n";
    let text = small_recipe(2) + "splits: {train: 0.5, val: 0, test: 0.5, by: variant}\n";
    let found = splits_of(&plan(&(text.clone() + sweep)), |scene| vec![scene["variant"].to_string()]);
    assert!(found.len() == 12 && found.values().all(|splits| splits.len() == 1));
    assert_eq!(found.values().flatten().collect::<BTreeSet<_>>().len(), 2);
    let message = refusal(&text);
    assert!(message.contains("a.yaml:15:") && message.contains("no variants"), "{message}");
}

/// A catalog of so many models for each label, all of one file.
fn catalog(desk: &Desk, labels: &[(&str, usize)]) {
    let starter = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
    let index = std::fs::read_to_string(starter.join("catalog.csv")).expect("readable");
    let row = index.lines().find(|line| line.starts_with("tire,")).expect("listed");
    let path = row.split(',').find(|cell| cell.ends_with(".glb")).expect("a model");
    let mut rows = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n".to_owned();
    for (label, models) in labels {
        for i in 0..*models {
            rows += &format!("{label}-{i},{label},{label},all,m.glb,0.6,y,rubber,CC0-1.0,a,s\n");
        }
    }
    desk.file("models/catalog.csv", &rows);
    std::fs::copy(starter.join(path), desk.path().join("models/m.glb")).expect("copied");
}

/// Splits of each model, in a plan of many scenes that pick among all of the catalog.
fn dealt(desk: &Desk, stratify: &str) -> BTreeMap<String, BTreeSet<String>> {
    let splits = format!("splits: {{train: 0.6, val: 0.2, test: 0.2, by: asset, stratify: {stratify}}}\n");
    let text = small_recipe(120).replace("catalog: starter, tags: [debris]", "catalog: models") + &splits;
    desk.file("a.yaml", &text.replace("{int: [1, 3]}", "6"));
    let output = desk.run(&["plan", "a.yaml", "--json"]);
    assert!(output.status.success(), "{}", messages(&output));
    splits_of(&serde_json::from_slice(&output.stdout).expect("JSON"), assets)
}

#[test]
fn stratified_every_class_of_enough_models_is_in_every_split() {
    let desk = Desk::new();
    catalog(&desk, &[("few", 3), ("some", 5), ("many", 10), ("single", 1)]);
    let found = dealt(&desk, "label");
    assert!(found.len() == 19 && found.values().all(|splits| splits.len() == 1), "no model leaks: {found:?}");
    let counts = |label: &str| {
        ["train", "val", "test"].map(|split| {
            let of_label = found.iter().filter(|(uid, _)| uid.contains(label));
            of_label.filter(|(_, splits)| splits.contains(&format!("\"{split}\""))).count()
        })
    };
    assert_eq!((counts("few"), counts("some"), counts("many")), ([1, 1, 1], [3, 1, 1], [6, 2, 2]));
    // Without it, chance leaves small classes out of some split.
    let plain = dealt(&desk, "none");
    let splits_of_few: BTreeSet<_> = plain.iter().filter(|(uid, _)| uid.contains("few")).flat_map(|(_, s)| s).collect();
    assert!(plain != found && splits_of_few.len() <= 3);
}

#[test]
fn one_more_model_moves_few_others_and_none_of_another_class() {
    let desk = Desk::new();
    catalog(&desk, &[("some", 7), ("many", 10)]);
    let before = dealt(&desk, "label");
    catalog(&desk, &[("some", 8), ("many", 10)]);
    let after = dealt(&desk, "label");
    let moved: Vec<&String> =
        before.iter().filter(|(uid, splits)| after[*uid] != **splits).map(|(uid, _)| uid).collect();
    assert!(moved.len() <= 2 && moved.iter().all(|uid| uid.contains("some")), "{moved:?}");
}

#[test]
fn only_models_are_stratified() {
    let message = refusal(&(small_recipe(4) + "splits: {stratify: label}\n"));
    assert!(message.contains("a.yaml:15:") && message.contains("by: asset"), "{message}");
    let message = refusal(&(small_recipe(4) + "splits: {by: asset, stratify: labels}\n"));
    assert!(message.contains("did you mean `label`"), "{message}");
}
