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
