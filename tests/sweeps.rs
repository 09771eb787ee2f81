//! Sweeps through the program: variants that differ in what is swept and in nothing else.
#![cfg(unix)]

mod support;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use serde_json::Value;
use support::cli::{Desk, messages, small_recipe};

fn plan(desk: &Desk, text: &str) -> Value {
    desk.file("a.yaml", text);
    let output = desk.run(&["plan", "a.yaml", "--json"]);
    assert!(output.status.success(), "{}", messages(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn list<'a>(plan: &'a Value, key: &str) -> &'a Vec<Value> {
    plan[key].as_array().expect("a list")
}

#[test]
fn variants_share_every_draw_that_is_not_swept() {
    let desk = Desk::new();
    let plain = plan(&desk, &small_recipe(2));
    let swept = plan(
        &desk,
        &(small_recipe(2)
            + "sweep: {grid: {sonar.beams: [96, 64], water.temperature_c: [{uniform: [0, 1]}, {uniform: [10, 12]}]}}\n"),
    );
    assert_eq!(list(&swept, "variants").len(), 4);
    assert_eq!(swept["variants"][3]["id"], "v003");
    assert_eq!(swept["variants"][3]["set"]["sonar.beams"], 64);
    assert_eq!((list(&swept, "scenes").len(), list(&swept, "jobs").len()), (8, 24));
    for (i, scene) in list(&swept, "scenes").iter().enumerate() {
        for key in ["index", "split", "spec", "drawn"] {
            assert_eq!(scene[key], plain["scenes"][i % 2][key], "{key}");
        }
    }
    for (i, job) in list(&swept, "jobs").iter().enumerate() {
        assert_eq!(job["id"], i);
        assert_eq!(job["variant"], format!("v{:03}", i / 6));
        assert_eq!(job["trajectory"], plain["jobs"][i % 6]["trajectory"]);
        assert_eq!(job["sonar"]["beams"], if i < 12 { 96 } else { 64 });
    }
    let warm = |job: usize| swept["jobs"][job]["looks"][0]["water"]["temperature_c"].as_f64().expect("a number");
    assert!((warm(6) - (10.0 + 2.0 * warm(0))).abs() < 1e-9, "the same place in another range");
}

#[test]
fn repeats_differ_in_their_seed_and_the_first_is_the_recipe_itself() {
    let desk = Desk::new();
    let plain = plan(&desk, &small_recipe(3));
    let swept = plan(&desk, &(small_recipe(3) + "sweep: {count: 3}\n"));
    let seeds: BTreeSet<String> = list(&swept, "variants").iter().map(|variant| variant["seed"].to_string()).collect();
    assert_eq!(seeds.len(), 3);
    let scenes = list(&swept, "scenes");
    for index in 0..3 {
        assert_eq!(scenes[index]["drawn"], plain["scenes"][index]["drawn"]);
        assert_ne!(scenes[index]["drawn"], scenes[index + 3]["drawn"]);
        assert_eq!(scenes[index]["split"], scenes[index + 3]["split"], "a scene stays in its split");
    }
}

#[test]
fn a_swept_dataset_names_its_variants_and_its_first_is_the_plain_one() {
    let desk = Desk::new();
    desk.file("plain.yaml", &small_recipe(2));
    desk.file("swept.yaml", &(small_recipe(2) + "sweep: {grid: {image.tvg_db_per_decade: [30, 40]}}\n"));
    let run = |arguments: &[&str]| {
        let output = desk.run(arguments);
        assert!(output.status.success(), "{}", messages(&output));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    run(&["run", "plain.yaml", "-o", "plain"]);
    run(&["run", "swept.yaml", "-o", "swept", "--limit", "7"]);
    assert!(run(&["status", "swept"]).contains("7 of 12 frames"));
    run(&["run", "swept.yaml", "-o", "swept"]);
    let read = |path: &str| fs::read(desk.path().join(path)).expect(path);
    for id in 0..6 {
        let plain = read(&format!("plain/images/fan/{id:06}.png"));
        assert!(read(&format!("swept/images/fan/{id:06}_v000.png")) == plain, "the variant that sets the default");
        assert!(read(&format!("swept/images/fan/{:06}_v001.png", id + 6)) != plain, "another gain");
        let mask = read(&format!("plain/masks/fan/{id:06}.png"));
        assert!(read(&format!("swept/masks/fan/{:06}_v001.png", id + 6)) == mask, "the same world and pose");
    }
    let mut variants: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut table = csv::Reader::from_path(desk.path().join("swept/frames.csv")).expect("a table");
    assert_eq!(&table.headers().expect("a header")[3], "variant");
    for row in table.records().map(|row| row.expect("a row")) {
        variants.entry(row[4].to_owned()).or_default().insert(row[2].to_owned());
        assert!(row[1].ends_with(&row[3]));
    }
    assert!(variants.values().all(|splits| splits.len() == 1), "a scene is in one split in all variants");
    let mut images = 0;
    for split in ["train", "val", "test"] {
        let coco: Value = serde_json::from_slice(&read(&format!("swept/annotations/fan_{split}.json"))).expect("JSON");
        for image in list(&coco, "images") {
            assert!(image["file_name"].as_str().expect("a name").contains(image["variant"].as_str().expect("a name")));
            images += 1;
        }
    }
    assert_eq!(images, 12);
    let card = String::from_utf8(read("swept/README.md")).expect("text");
    assert!(card.contains("| Variant v001 | image.tvg_db_per_decade=40 |"), "{card}");
}
