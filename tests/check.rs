//! `check` tells the truth: what could be drawn and would be refused is refused now; what a run takes, and what may not have
//! been meant.
#![cfg(unix)]

mod support;

use std::fs;

use serde_json::Value;
use support::cli::{Desk, files, messages, small_recipe};

/// The small recipe after changes.
fn changed(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(small_recipe(2), |text, (from, to)| {
        assert!(text.contains(from), "the change `{from}` is made");
        text.replacen(from, to, 1)
    })
}

/// The message of `check` about a recipe that `run` would take today, but not with every seed.
fn could_be(changes: &[(&str, &str)]) -> String {
    let desk = Desk::new();
    desk.file("a.yaml", &changed(changes));
    let plan = desk.run(&["plan", "a.yaml"]);
    assert!(plan.status.success(), "drawn as it is, it can be run: {}", messages(&plan));
    let output = desk.run(&["check", "a.yaml", "--quick"]);
    assert_eq!(output.status.code(), Some(2), "{changes:?} is refused");
    assert_eq!(desk.names(), ["a.yaml"]);
    messages(&output)
}

/// What `check --json` says of a recipe.
fn report(text: &str, arguments: &[&str]) -> Value {
    let desk = Desk::new();
    desk.file("a.yaml", text);
    let output = desk.run(&[&["check", "a.yaml", "--json"], arguments].concat());
    assert!(output.status.success(), "{}", messages(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn warnings(report: &Value, kind: &str) -> Vec<String> {
    let all = report["warnings"].as_array().expect("a list").iter();
    all.filter(|warning| warning["kind"] == kind).map(|warning| warning["text"].to_string()).collect()
}

#[test]
fn the_ends_of_distributions_are_tried() {
    for (from, to, place, words) in [
        ("{uniform: [4, 22]}", "{uniform: [4, 41]}", "a.yaml:7:24", "41 could be drawn: 41 is outside"),
        ("{uniform: [4, 22]}", "{normal: [12, 10]}", "a.yaml:7:24", "-18 could be drawn"),
        ("{uniform: [4, 22]}", "{normal: [12, 1], min: -9}", "a.yaml:7:24", "-9 could be drawn"),
        ("{uniform: [4, 5]}", "{uniform: [0, 5]}", "a.yaml:13:32", "0 could be drawn"),
        ("beams: 96", "beams: {choice: {96: 1, 9000: 1e-9}}", "a.yaml:6:16", "9000 could be drawn"),
        ("{int: [1, 3]}", "{choice: {2: 1, -1: 1e-9}}", "a.yaml:11:12", "-1 could be drawn"),
        ("[silt, gravel]", "{silt: 1, gravle: 1e-9}", "a.yaml:8:", "`gravle` could be drawn"),
        ("wavelength_m: 0.9", "wavelength_m: {normal: [0.9, 0.001], min: 0.3}", "a.yaml:8:", "0.3 could be drawn"),
        ("within_m: 2", "within_m: 2, burial: {normal: [0.5, 1e-3], max: 1.1}", "a.yaml:12:", "1.1 could be drawn"),
        ("tags: [debris]", "uid: {choice: {tire: 1, tyre: 1e-9}}", "a.yaml:10:", "did you mean `tire`"),
    ] {
        let message = could_be(&[(from, to)]);
        assert!(message.starts_with(&format!("error: {place}")) && message.contains(words), "{to}: {message}");
    }
}

#[test]
fn ends_are_tried_inside_choices_shared_draws_looks_and_sweeps() {
    let inside = "{choice: [flat, {ripples: {wavelength_m: {uniform: [0.1, 0.9]}}}], weights: [1, 1e-9]}";
    let message = could_be(&[("{ripples: {wavelength_m: 0.9}}", inside)]);
    assert!(message.contains("0.1 could be drawn") && message.contains("cell_m"), "{message}");
    let message = could_be(&[
        ("seed: 5", "seed: 5\nlet: {d: {normal: [4.5, 0.001], min: 0}}"),
        ("radius_m: {uniform: [4, 5]}", "radius_m: $d"),
    ]);
    assert!(message.starts_with("error: a.yaml:4:") && message.contains("0 could be drawn"), "{message}");
    let look = "seed: 5\nlooks: [{name: a}, {name: b, water: {ph: {normal: [8, 0.001], max: 9.5}}}]";
    assert!(could_be(&[("seed: 5", look)]).contains("9.5 could be drawn"));
    let sweep = "seed: 5\nsweep: {grid: {water.ph: [7, {normal: [8, 0.001], max: 9.5}]}}";
    assert!(could_be(&[("seed: 5", sweep)]).contains("9.5 could be drawn"));
}

#[test]
fn what_cannot_be_drawn_is_no_fault() {
    for (from, to) in [
        ("[silt, gravel]", "{silt: 1, gravle: 0}"),
        ("{uniform: [4, 22]}", "{normal: [12, 1]}"),
        ("{uniform: [4, 22]}", "{normal: [12, 10], min: -2, max: 40}"),
        ("count: {int: [1, 3]}", "count: 0"),
        // A look's own range is not tried in the others.
        ("seed: 5", "seed: 5\nlooks: [{name: a}, {name: b, water: {temperature_c: 3}}]"),
    ] {
        report(&changed(&[(from, to)]), &["--quick"]);
    }
}

#[test]
fn every_model_that_could_be_picked_is_opened() {
    let desk = Desk::new();
    let starter = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
    let tire = fs::read_to_string(starter.join("catalog.csv")).expect("readable");
    let row = |uid: &str| tire.lines().find(|line| line.starts_with(uid)).expect("listed").to_owned();
    let header = tire.lines().next().expect("a header");
    let path = row("tire,").split(',').find(|cell| cell.ends_with(".glb")).expect("a model").to_owned();
    desk.file("models/broken.glb", "no model");
    fs::create_dir_all(desk.path().join("models").join(&path).parent().expect("below")).expect("a folder");
    fs::copy(starter.join(&path), desk.path().join("models").join(&path)).expect("copied");
    let broken = row("tire,").replace("tire,", "broken,").replace(&path, "broken.glb");
    desk.file("models/catalog.csv", &format!("{header}\n{}\n{broken}\n", row("tire,")));
    let pick = "pick: {catalog: models, uid: {choice: {tire: 1, broken: 1e-12}}}";
    desk.file("a.yaml", &changed(&[("pick: {catalog: starter, tags: [debris]}", pick)]));
    assert!(desk.run(&["plan", "a.yaml"]).status.success());
    let output = desk.run(&["check", "a.yaml", "--quick"]);
    let message = messages(&output);
    assert!(output.status.code() == Some(2) && message.starts_with("error: a.yaml:10:"), "{message}");
    assert!(message.contains("broken.glb"), "{message}");
    // Where any of many would do, all of them are opened, though none but the whole one is drawn.
    desk.file(
        "a.yaml",
        &changed(&[
            ("pick: {catalog: starter, tags: [debris]}", "pick: {catalog: models}"),
            ("{int: [1, 3]}", "{int: [0, 1]}"),
        ]),
    );
    let seed = (0..50).map(|seed| format!("seed={seed}")).find(|seed| {
        let plan = desk.run(&["plan", "a.yaml", "--set", seed, "--set", "scenes=1"]);
        plan.status.success()
    });
    let seed = seed.expect("a seed that draws no broken model");
    let output = desk.run(&["check", "a.yaml", "--quick", "--set", &seed, "--set", "scenes=1"]);
    assert!(output.status.code() == Some(2) && messages(&output).contains("broken.glb"), "{}", messages(&output));
}

#[test]
fn counts_and_estimates_are_those_of_the_run() {
    let text = small_recipe(4)
        + "looks: [{name: a}, {name: b, water: {ph: 7}}]\nsweep: {grid: {water.salinity_ppt: [0, 30]}}\n";
    let report = report(&text, &["--jobs", "1"]);
    assert_eq!((&report["variants"], &report["scenes"], &report["frames"]), (&2.into(), &8.into(), &24.into()));
    assert_eq!((&report["images"], &report["looks"]), (&96.into(), &serde_json::json!(["a", "b"])));
    assert!(report["corners"].as_u64().expect("a number") >= 10);
    assert!(report["models_possible"].as_u64() >= report["models"].as_u64());
    let desk = Desk::new();
    desk.file("a.yaml", &text);
    let output = desk.run(&["run", "a.yaml", "-o", "out", "--jobs", "1"]);
    assert!(output.status.success(), "{}", messages(&output));
    let bytes: usize = files(&desk.path().join("out")).values().map(Vec::len).sum();
    let share = report["estimate"]["bytes"].as_f64().expect("a number") / bytes as f64;
    assert!((0.7..1.4).contains(&share), "the estimate is {share} of what is written");
    assert!(report["estimate"]["seconds"].as_f64().expect("a number") > 0.0);
    let quick = Desk::new();
    quick.file("a.yaml", &text);
    let output = quick.run(&["check", "a.yaml", "--json", "--quick"]);
    let quick: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(quick["estimate"].is_null() && quick["plan_hash"] == report["plan_hash"]);
}

#[test]
fn what_is_not_in_view_is_told_with_its_cause() {
    let told = |from: &str, to: &str, kind: &str| warnings(&report(&changed(&[(from, to)]), &[]), kind).join("\n");
    let far = told("range_m: [0.5, 9]", "range_m: [0.5, 1.2]", "in-view");
    assert!(far.contains("beyond range_m") && far.contains("no object in view"), "{far}");
    assert!(told("range_m: [0.5, 9]", "range_m: [0.5, 1.2]", "range").contains("do not reach the bottom"));
    let up = told("pitch_deg: -20", "pitch_deg: 60", "in-view");
    assert!(up.contains("above or below elevation_deg"), "{up}");
    assert!(told("pitch_deg: -20", "pitch_deg: 60", "range").contains("no ray goes down"));
    let away = told("mount: {pitch_deg: -20}", "mount: {yaw_deg: 0, pitch_deg: -20}", "in-view");
    assert_eq!(away, "", "the small recipe looks at its objects");
    let coarse = told("beams: 96", "beams: 2", "resolution");
    assert!(coarse.contains("smaller than a cell"), "{coarse}");
    let faint = report(&(changed(&[]) + "labels: {min_pixels: 100000}\n"), &[]);
    assert!(warnings(&faint, "resolution").iter().any(|text| text.contains("labels.min_pixels")), "{faint}");
    let crowded = told("within_m: 2", "within_m: 0.01", "dropped");
    assert!(crowded.contains("no free place"), "{crowded}");
}

#[test]
fn classes_that_are_rare_or_missing_are_told() {
    let rare = "objects:\n  - {pick: {catalog: starter, label: rock}, count: 15}\n  - {pick: {catalog: starter, uid: tire}}\n  -";
    let report = report(&changed(&[("objects:\n  -", rare), ("scenes: 2", "scenes: 12")]), &["--quick"]);
    let balance = warnings(&report, "balance").join("");
    assert!(balance.contains("`rock` stands 180 times"), "{balance}");
    assert!(warnings(&report, "splits").iter().any(|text| text.contains("lacks")), "{report}");
    assert_eq!(report["objects"]["tire"].as_u64().map(|tires| tires >= 12), Some(true));
}

#[test]
fn every_recipe_here_passes_and_a_plan_can_be_checked() {
    let desk = Desk::new();
    for entry in fs::read_dir(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes")).expect("readable") {
        let path = entry.expect("an entry").path();
        let output = desk.run(&["check", "--quick", path.to_str().expect("text")]);
        assert!(output.status.success(), "{}", messages(&output));
    }
    desk.file("a.yaml", &small_recipe(2));
    desk.file("p.json", &String::from_utf8(desk.run(&["plan", "a.yaml", "--json"]).stdout).expect("text"));
    let of = |arguments: &[&str]| -> Value {
        serde_json::from_slice(&desk.run(&[&["check", "--quick", "--json"], arguments].concat()).stdout).expect("JSON")
    };
    let (recipe, plan) = (of(&["a.yaml"]), of(&["--plan", "p.json"]));
    for key in ["plan_hash", "frames", "objects", "models", "warnings"] {
        assert_eq!(recipe[key], plan[key], "{key}");
    }
    assert_eq!(plan["corners"], 0);
}

#[test]
fn a_frame_is_explained() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(2));
    let output = desk.run(&["plan", "a.yaml", "--explain", "4"]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.starts_with("frame 000004: frame 1 of scene 1"), "{text}");
    assert!(text.contains(r#"from {"uniform":[4,22]}, once a scene, a.yaml:7:24"#), "{text}");
    assert!(text.contains("each instance, defaults:") && text.contains("range ") && text.contains("in view"), "{text}");
    desk.file("p.json", &String::from_utf8(desk.run(&["plan", "a.yaml", "--json"]).stdout).expect("text"));
    let output = desk.run(&["plan", "--plan", "p.json", "--explain", "4"]);
    assert!(output.status.success() && !String::from_utf8_lossy(&output.stdout).contains("once a scene"));
}
