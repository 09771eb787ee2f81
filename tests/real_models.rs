//! Models as people have them, from several sources and in every unit: loaded, placed at their real size and labelled.

mod support;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use ensonify::catalog::Catalog;
use serde_json::Value;
use support::cli::{Desk, messages};

/// A catalog of the models beside the repository in a folder of its own, and a recipe that places each once.
fn desk() -> Option<(Desk, Vec<String>)> {
    let models = support::shared("models")?;
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/real-models.csv");
    let desk = Desk::new();
    desk.file("models/catalog.csv", &fs::read_to_string(table).expect("readable"));
    let mut uids = Vec::new();
    let mut objects = String::new();
    for asset in Catalog::open(&desk.path().join("models")).expect("a catalog").assets {
        let file = asset.path.file_name().expect("a name");
        fs::copy(models.join(file), &asset.path).expect("copied");
        objects +=
            &format!("  - {{pick: {{catalog: models, uid: {}}}, pose: {{rest: {{within_m: 30}}}}}}\n", asset.uid);
        uids.push(asset.uid);
    }
    let recipe = include_str!("data/real-models.yaml").replace("OBJECTS", &objects);
    desk.file("models.yaml", &recipe);
    Some((desk, uids))
}

#[test]
fn every_model_is_loaded_placed_and_labelled() {
    let Some((desk, uids)) = desk() else { return };
    assert_eq!(uids.len(), 51);
    let output = desk.run(&["run", "models.yaml", "-o", "out"]);
    assert!(output.status.success(), "{}", messages(&output));
    assert!(!messages(&output).contains("left out"), "all find a place: {}", messages(&output));
    let mut seen = BTreeSet::new();
    for split in ["train", "val", "test"] {
        let text = fs::read_to_string(desk.path().join(format!("out/annotations/fan_{split}.json"))).expect("readable");
        let coco: Value = serde_json::from_str(&text).expect("JSON");
        for annotation in coco["annotations"].as_array().expect("annotations") {
            seen.insert(annotation["asset"].as_str().expect("an asset").to_owned());
        }
    }
    let unseen: Vec<_> = uids.iter().filter(|uid| !seen.contains(&format!("models/{uid}"))).collect();
    assert!(unseen.is_empty(), "never labelled: {unseen:?}");
}

#[test]
fn sizes_come_from_the_catalog() {
    let Some((desk, _)) = desk() else { return };
    for asset in Catalog::open(&desk.path().join("models")).expect("a catalog").assets {
        let (low, high) = asset.scaled_model().expect("loads").bounds().expect("triangles");
        let longest = f64::from((high - low).max_element());
        let size_m = asset.size_m.expect("stated");
        assert!((longest - size_m).abs() < 1e-4 * size_m, "{}: {longest} m", asset.uid);
        assert!(low.z.abs() < 1e-4, "{}: stands on the ground", asset.uid);
    }
}
