//! The recipe language through the program: shared draws, recipes over recipes, settings.
#![cfg(unix)]

mod support;

use serde_json::Value;
use support::cli::{Desk, messages, small_recipe};

/// The plan of a recipe in a folder.
fn plan(desk: &Desk, arguments: &[&str]) -> Value {
    let output = desk.run(&[&["plan", "--json"], arguments].concat());
    assert!(output.status.success(), "{}", messages(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The message of a recipe that is refused.
fn refusal(desk: &Desk, arguments: &[&str]) -> String {
    let output = desk.run(&[&["check"], arguments].concat());
    let message = messages(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    message
}

#[test]
fn a_shared_draw_is_the_same_in_every_section_and_moves_no_other() {
    let desk = Desk::new();
    desk.file("plain.yaml", &small_recipe(3));
    let text = small_recipe(3)
        .replace("water: {", "let:\n  height: {uniform: [1.5, 2]}\n  lone: 3\n  n: 2\nwater: {depth_m: $height, ")
        .replace("altitude_m: 1.8", "altitude_m: $height")
        .replace("within_m: 2}", "within_m: $height}")
        .replace("frames: 3", "frames: $n")
        .replace("beams: 96,", "device: oculus-m1200d-lf, yaw_rate_deg_s: $height, elevations: 150,")
        .replace("elevations: 150, range_m", "range_m");
    desk.file("shared.yaml", &text);
    let (plain, shared) = (plan(&desk, &["plain.yaml"]), plan(&desk, &["shared.yaml"]));
    assert_eq!(shared["frames_per_scene"], 2);
    let mut heights = Vec::new();
    for job in shared["jobs"].as_array().expect("jobs") {
        let height = &job["trajectory"]["orbit"]["altitude_m"];
        assert_eq!(job["looks"][0]["water"]["depth_m"], *height);
        assert_eq!(job["sonar"]["yaw_rate_deg_s"], *height);
        assert_eq!(job["sonar"]["source_level_db"], plan_device_level(), "the device's figures stay");
        let scene = &shared["scenes"][job["scene"].as_u64().expect("a number") as usize];
        assert_eq!(scene["drawn"]["let.height"], *height);
        scene["spec"]["bodies"].as_array().expect("bodies").iter().for_each(|body| {
            assert_eq!(body["pose"]["rest"]["within_m"], *height);
        });
        heights.push(height.to_string());
    }
    assert!(heights[0] == heights[1] && heights[0] != heights[2], "once a scene");
    for i in 0..3 {
        let sediment = |plan: &Value| plan["scenes"][i]["drawn"]["seabed.sediment"].clone();
        assert_eq!(sediment(&plain), sediment(&shared));
    }
    let output = desk.run(&["check", "shared.yaml"]);
    assert!(output.status.success());
    assert!(messages(&output).contains("shared.yaml:9:3: nothing refers to `lone`"), "{}", messages(&output));
}

/// The source level in the file of the device that the test uses.
fn plan_device_level() -> Value {
    let text = ensonify::catalog::sonars::find("oculus-m1200d-lf").expect("a device");
    let device = ensonify::recipe::parse("device", text, ensonify::recipe::Origin::Given).expect("YAML");
    device.get("source_level_db").map_or(Value::from(210.0), |level| Value::from(level.number()))
}

#[test]
fn shared_draws_that_cannot_be_are_refused_with_place_and_remedy() {
    let desk = Desk::new();
    for (lets, from, to, words) in [
        (
            "{hight: 2}",
            "altitude_m: 1.8",
            "altitude_m: $hieght",
            &["a.yaml:14:", "`hieght`", "did you mean `hight`"][..],
        ),
        ("{n: {int: [1, 2]}}", "scenes: 1", "scenes: $n", &["a.yaml:4:", "`$n` has no value here", "constants"]),
        ("{a: $b, b: $a}", "ph", "ph", &["a.yaml:7:7", "a → b → a"]),
        ("{t: {uniform: [9, 2]}}", "{uniform: [4, 22]}", "$t", &["a.yaml:7:", "9 is greater than 2"]),
        ("{t: 400}", "{uniform: [4, 22]}", "$t", &["a.yaml:7:", "400 is outside"]),
        ("{c: {uniform: [0.2, 0.3], per: frame}}", "cell_m: 0.2", "cell_m: $c", &["a.yaml:9:", "each frame"]),
    ] {
        let text = small_recipe(1).replace("water:", &format!("let: {lets}\nwater:")).replace(from, to);
        desk.file("a.yaml", &text);
        let message = refusal(&desk, &["a.yaml"]);
        words.iter().for_each(|word| assert!(message.contains(word), "`{word}` is not in: {message}"));
    }
}

#[test]
fn a_sweep_may_set_a_shared_draw() {
    let desk = Desk::new();
    let text = small_recipe(1).replace("altitude_m: 1.8", "altitude_m: $height");
    desk.file(
        "a.yaml",
        &format!("{text}let: {{height: 1}}\nsweep: {{grid: {{let.height: [2, {{uniform: [3, 4]}}]}}}}\n"),
    );
    let plan = plan(&desk, &["a.yaml"]);
    let height = |job: usize| plan["jobs"][job]["trajectory"]["orbit"]["altitude_m"].as_f64().expect("a number");
    assert!(height(0) == 2.0 && (3.0..4.0).contains(&height(3)));
}

#[test]
fn a_recipe_over_another_and_settings_are_told_in_the_manifest() {
    let desk = Desk::new();
    let base = desk.file("parts/base.yaml", &small_recipe(1));
    let top = "include: parts/base.yaml   # the rest\nensonify: 1\nframes: 2\nsonar: {beams: 64}\n";
    desk.file("a.yaml", top);
    let output = desk.run(&["run", "a.yaml", "-o", "out", "--set", "seed=9", "--set", "water.ph=7"]);
    assert!(output.status.success(), "{}", messages(&output));
    let read = |name: &str| std::fs::read_to_string(desk.path().join("out").join(name)).expect(name);
    assert_eq!(read("recipe.yaml"), top, "exactly as given");
    let manifest: Value = serde_json::from_str(&read("manifest.json")).expect("JSON");
    let plan: Value = serde_json::from_str(&read("plan.json")).expect("JSON");
    for told in [&manifest, &plan] {
        assert_eq!(told["sets"], serde_json::json!(["seed=9", "water.ph=7"]));
    }
    assert_eq!(manifest["includes"][0]["name"], "parts/base.yaml");
    assert_eq!(manifest["includes"][0]["sha256"].as_str().map(str::len), Some(64));
    assert_eq!((&plan["seed"], &plan["frames_per_scene"]), (&Value::from(9), &Value::from(2)));
    assert_eq!(plan["jobs"][0]["sonar"]["beams"], 64);
    assert_eq!(plan["jobs"][0]["sonar"]["azimuth_deg"], 90.0, "from the file under it");
    // A fault is told in the file that it stands in.
    std::fs::write(base, small_recipe(1).replace("wavelength_m", "wavelenth_m")).expect("written");
    assert!(refusal(&desk, &["a.yaml"]).starts_with("error: parts/base.yaml:8:"), "{}", refusal(&desk, &["a.yaml"]));
}

#[test]
fn a_file_outside_is_read_only_when_allowed() {
    let desk = Desk::new();
    desk.file("base.yaml", &small_recipe(1));
    desk.file("below/a.yaml", "ensonify: 1\ninclude: ../base.yaml\n");
    let message = refusal(&desk, &["below/a.yaml"]);
    assert!(message.contains("below/a.yaml:2:") && message.contains("--allow-outside"), "{message}");
    assert!(desk.run(&["check", "below/a.yaml", "--allow-outside"]).status.success());
}
