//! `ensonify realism` on a dataset, on a plain folder, and on what is neither.

mod support;

use std::fs;

use serde_json::Value;
use support::cli::{Desk, messages, small_recipe};

fn dataset() -> Desk {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(1));
    assert_eq!(desk.run(&["run", "a.yaml", "-o", "data"]).status.code(), Some(0));
    desk
}

#[test]
fn figures_of_a_dataset_are_no_distance_from_themselves() {
    let desk = dataset();
    let json = desk.run(&["realism", "--json", "data"]);
    assert_eq!(json.status.code(), Some(0), "{}", messages(&json));
    let figures: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(figures["intensity"]["all"]["frames"], 3);
    assert_eq!(figures["geometry"]["A"]["beams"], 96);
    assert!(figures["objects"]["contrast_mean_object_over_ring"]["median"].as_f64().unwrap() > 1.0);
    assert!(figures.get("comparison").is_none());

    fs::write(desk.path().join("ours.json"), &json.stdout).unwrap();
    let table = desk.run(&["realism", "--against", "ours.json", "data"]);
    assert_eq!(table.status.code(), Some(0), "{}", messages(&table));
    let text = String::from_utf8(table.stdout).unwrap();
    assert_eq!(text.lines().filter(|line| line.starts_with("  -> within 0 %")).count(), 7, "{text}");

    let both = desk.run(&["realism", "--against", "ours.json", "--json", "data"]);
    let both: Value = serde_json::from_slice(&both.stdout).unwrap();
    assert_eq!(both["comparison"]["groups"].as_array().unwrap().len(), 7);
    assert_eq!(both["intensity"], figures["intensity"]);
}

#[test]
fn the_images_of_a_dataset_measure_the_same_as_a_plain_folder() {
    let desk = dataset();
    let figures = |arguments: &[&str]| -> Value {
        let output = desk.run(arguments);
        assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let whole = figures(&["realism", "--json", "data"]);
    let plain =
        ["realism", "--json", "data/images/fan", "--masks", "data/masks/fan", "--fan-deg", "90", "--beams", "96"];
    let plain = figures(&plain);
    // The fan that fills the picture is the dataset's but for a part of a pixel.
    for path in ["/intensity/all/pooled_mean", "/objects/contrast_mean_object_over_ring/median", "/geometry/A/rmax_px"]
    {
        let value = |figures: &Value| figures.pointer(path).and_then(Value::as_f64).unwrap();
        assert!((value(&whole) / value(&plain) - 1.0).abs() < 0.02, "{path}: {} {}", value(&whole), value(&plain));
    }
    assert_eq!(plain["objects"]["per_class"], Value::Object(serde_json::Map::new()));
}

#[test]
fn what_cannot_be_measured_gets_one_message() {
    let desk = dataset();
    desk.file("stats.json", "{\"speckle\": 3}");
    desk.file("empty/notes.txt", "no images");
    for (arguments, word) in [
        (&["realism", "--against", "stats.json", "data"][..], "stats.json"),
        (&["realism", "--against", "none.json", "data"], "none.json"),
        (&["realism", "--json", "none"], "none"),
        (&["realism", "--json", "empty"], "no PNG image"),
        (&["realism", "--json", "data/images/fan"], "--fan-deg"),
        (&["realism", "--json", "data/images/fan", "--fan-deg", "90", "--masks", "empty"], "empty"),
    ] {
        let output = desk.run(arguments);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.starts_with("error: ") && message.contains(word), "{arguments:?}: {message}");
        assert_eq!((message.matches("error:").count(), output.stdout.len()), (1, 0), "{message}");
    }
    assert_eq!(desk.run(&["realism", "data"]).status.code(), Some(2), "nothing to compare with");
}
