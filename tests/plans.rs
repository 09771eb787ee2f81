//! Plans as files: what was written is rendered again to the byte, with nothing but the plan; what cannot be is refused.
#![cfg(unix)]

mod support;

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use support::cli::{Desk, files, messages, small_recipe};

fn plan_json(desk: &Desk, arguments: &[&str]) -> Vec<u8> {
    let output = desk.run(arguments);
    assert!(output.status.success(), "{}", messages(&output));
    output.stdout
}

/// A desk with the small recipe's plan in `p.json`, changed.
fn edited(change: impl Fn(&mut Value)) -> Desk {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(2));
    let mut plan: Value = serde_json::from_slice(&plan_json(&desk, &["plan", "a.yaml", "--json"])).expect("JSON");
    change(&mut plan);
    desk.file("p.json", &plan.to_string());
    desk
}

/// The message that refuses the small recipe's plan after a change; nothing is written.
fn refusal(change: impl Fn(&mut Value)) -> String {
    let desk = edited(change);
    for verb in ["run", "check", "preview", "plan"] {
        let output = desk.run(&[verb, "--plan", "p.json"]);
        assert_eq!(output.status.code(), Some(2), "{verb}: {}", messages(&output));
    }
    assert_eq!(desk.names(), ["a.yaml", "p.json"]);
    messages(&desk.run(&["run", "--plan", "p.json"]))
}

#[test]
fn a_plan_renders_what_its_recipe_does() {
    let sweep = "sweep: {grid: {water.ph: [7.5, 8]}}\nlooks: [{name: a}, {name: b, image: {tvg_db_per_decade: 20}}]\n";
    let desk = Desk::new();
    desk.file("a.yaml", &(small_recipe(2) + sweep));
    assert!(desk.run(&["run", "a.yaml", "-o", "one", "--set", "frames=2"]).status.success());
    // As the dataset keeps it, and as the verb prints it.
    let printed = plan_json(&desk, &["plan", "a.yaml", "--json", "--set", "frames=2"]);
    assert!(printed == fs::read(desk.path().join("one/plan.json")).expect("readable"));
    let output = desk.run(&["run", "--plan", "one/plan.json", "-o", "two"]);
    assert!(output.status.success(), "{}", messages(&output));
    let one = files(&desk.path().join("one"));
    let two = files(&desk.path().join("two"));
    let of_recipe = ["recipe.yaml", "manifest.json", "SHA256SUMS"];
    for (path, bytes) in &one {
        assert!(of_recipe.contains(&path.as_str()) || two.get(path) == Some(bytes), "{path} differs");
    }
    assert_eq!(one.len(), two.len() + 1, "but for the recipe");
    let manifest = |files: &std::collections::BTreeMap<String, Vec<u8>>| -> Value {
        serde_json::from_slice(&files["manifest.json"]).expect("JSON")
    };
    for key in ["plan_hash", "dataset_hash", "sets", "counts"] {
        assert_eq!(manifest(&one)[key], manifest(&two)[key], "{key}");
    }
    assert!(manifest(&two)["recipe_sha256"].is_null());
    // In the recipe's own folder a plan changes nothing, and the recipe goes on with what a plan began.
    assert!(desk.run(&["run", "--plan", "one/plan.json", "-o", "one"]).status.success());
    assert!(files(&desk.path().join("one")) == one);
    assert!(desk.run(&["run", "a.yaml", "-o", "two", "--set", "frames=2"]).status.success());
    assert!(files(&desk.path().join("two")) == one);
}

#[test]
fn every_recipe_comes_back_from_its_plan() {
    let desk = Desk::new();
    let recipes = Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes");
    for entry in fs::read_dir(&recipes).expect("readable") {
        let path = entry.expect("an entry").path();
        let name = path.to_str().expect("text");
        let text = plan_json(&desk, &["plan", name, "--json", "--set", "scenes=2"]);
        desk.file("p.json", &String::from_utf8(text.clone()).expect("text"));
        let folder = recipes.to_str().expect("text");
        let again = plan_json(&desk, &["plan", "--plan", "p.json", "--base", folder, "--json"]);
        assert!(text == again, "{name}");
    }
}

#[test]
fn an_edited_plan_is_another_plan() {
    let desk = edited(|plan| {
        plan["jobs"][1]["sonar"]["frequency_khz"] = json!(700);
        plan["scenes"][1]["spec"]["bodies"] = json!([]);
    });
    let original = plan_json(&desk, &["plan", "a.yaml", "--json"]);
    let read = plan_json(&desk, &["plan", "--plan", "p.json", "--json"]);
    assert_ne!(original, read);
    let read: Value = serde_json::from_slice(&read).expect("JSON");
    assert_eq!(read["jobs"][1]["sonar"]["frequency_khz"], 700.0);
    let output = desk.run(&["run", "--plan", "p.json", "-o", "out"]);
    assert!(output.status.success(), "{}", messages(&output));
    // Given through a pipe, relative paths begin in the current folder.
    let piped = desk
        .command(&["plan", "--plan", "-"])
        .stdin(fs::File::open(desk.path().join("p.json")).expect("readable"))
        .output()
        .expect("started");
    assert!(piped.status.success(), "{}", messages(&piped));
}

#[test]
fn what_a_recipe_may_not_say_a_plan_may_not_either() {
    type Change = fn(&mut Value);
    let cases: [(Change, &str, &str); 22] = [
        (|p| p["ensonify"] = json!("0.0.1"), "ensonify", "of version 0.0.1"),
        (|p| p["name"] = json!("../x"), "name", "cannot name a dataset"),
        (|p| p["frames_per_scene"] = json!(0), "frames_per_scene", "at least 1"),
        (|p| p["frames_per_scene"] = json!(u64::MAX), "scenes_per_variant", "more than"),
        (|p| p["scenes_per_variant"] = json!(3), "scenes", "there are 2 scenes"),
        (|p| p["jobs"].as_array_mut().unwrap().truncate(5), "jobs", "there are 5 jobs"),
        (|p| p["jobs"][1]["id"] = json!(4), "jobs[1].id", "4 stands where 1 belongs"),
        (|p| p["jobs"][1]["split"] = json!("val"), "jobs[1].split", "\"val\" stands where"),
        (|p| p["jobs"][1]["scene"] = json!(9), "jobs[1].scene", "belongs"),
        (|p| p["jobs"][1]["variant"] = json!("../../x"), "jobs[1].variant", "belongs"),
        (
            |p| p["variants"] = json!([{"id": "../x", "description": "", "set": {}, "repeat": null, "seed": 5}]),
            "variants[0].id",
            "v000",
        ),
        (|p| p["scenes"][0]["seed"] = json!(6), "scenes[0].seed", "6 stands where 5 belongs"),
        (|p| p["jobs"][2]["sonar"]["beams"] = json!(4_000_000), "jobs[2].sonar.beams", "outside"),
        (|p| p["jobs"][2]["sonar"]["beems"] = json!(4), "jobs[2].sonar.beems", "unknown field"),
        (
            |p| p["jobs"][2]["trajectory"]["orbit"]["radius_m"] = json!(-1),
            "jobs[2].trajectory.orbit.radius_m",
            "-1 is not above 0",
        ),
        (|p| p["jobs"][2]["looks"] = json!([]), "jobs[2].looks", "0 looks"),
        (|p| p["jobs"][0]["looks"][0]["name"] = json!("../x"), "jobs[0].looks[0].name", "cannot name"),
        (|p| p["jobs"][2]["looks"][0]["water"]["ph"] = json!(20), "jobs[2].looks[0].water.ph", "20 is outside"),
        (|p| p["scenes"][1]["spec"]["seabed"]["cell_m"] = json!(1e-5), "scenes[1].spec.seabed", "triangles"),
        (|p| p["scenes"][1]["spec"]["seabed"]["sediment"] = json!("sitl"), "scenes[1].spec.seabed", "`silt`"),
        (|p| p["scenes"][1]["spec"]["bodies"][0]["uid"] = json!("tyre"), "scenes[1].spec", "did you mean `tire`"),
        (|p| p["output"]["fan_height_px"] = json!(100_000), "output.fan_height_px", "100000 pixels"),
    ];
    for (change, place, words) in cases {
        let message = refusal(change);
        let found = message.starts_with("error: p.json") && message.contains(&format!(": {place}: "));
        assert!(found && message.contains(words), "{place}: {message}");
    }
}

#[test]
fn a_changed_model_is_refused_by_name() {
    let change = |plan: &mut Value| {
        let uid = plan["scenes"][0]["spec"]["bodies"][0]["uid"].as_str().expect("a uid").to_owned();
        plan["assets"][format!("starter/{uid}")]["sha256"] = json!("00");
    };
    let message = refusal(change);
    assert!(message.contains("assets[\"starter/") && message.contains("has changed"), "{message}");
    let message = refusal(|plan| plan["scenes"][0]["spec"]["bodies"][0]["catalog"] = json!("gone"));
    assert!(message.contains("no catalog `gone`") && message.contains("--base"), "{message}");
    // A model that the plan has no hash of is taken as it is found.
    let desk = edited(|plan| plan["assets"] = json!({}));
    let original = plan_json(&desk, &["plan", "a.yaml", "--json"]);
    assert!(original == plan_json(&desk, &["plan", "--plan", "p.json", "--json"]));
}

#[test]
fn a_file_that_is_no_plan_is_refused() {
    let desk = edited(|_| ());
    let whole = fs::read(desk.path().join("p.json")).expect("readable");
    for share in [0, 1, 10, whole.len() / 2, whole.len() - 1] {
        fs::write(desk.path().join("p.json"), &whole[..share]).expect("written");
        let output = desk.run(&["run", "--plan", "p.json"]);
        assert_eq!(output.status.code(), Some(2), "{share}: {}", messages(&output));
        assert!(messages(&output).starts_with("error: p.json"), "{share}: {}", messages(&output));
    }
    for file in ["a.yaml", "none.json", ".", "/dev/zero"] {
        let output = desk.run(&["run", "--plan", file]);
        assert_eq!(output.status.code(), Some(2), "{file}");
        assert!(messages(&output).contains("cannot be read"), "{file}: {}", messages(&output));
    }
    fs::write(desk.path().join("p.json"), &whole).expect("written");
    let output = desk.run(&["run", "p.json"]);
    assert!(output.status.code() == Some(2) && messages(&output).contains("--plan"), "{}", messages(&output));
    let output = desk.run(&["run", "--plan", "p.json", "a.yaml"]);
    assert_eq!(output.status.code(), Some(2), "one or the other");
}

#[test]
fn damaged_plans_never_make_the_program_panic() {
    use ensonify::math::rng::Stream;
    use ensonify::plan::{compile, read};
    use ensonify::recipe::Recipe;
    use ensonify::scene::AssetCache;

    const DAMAGE: &[u8] = b"0123456789-.eE{}[]\"\\,:";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let assets = AssetCache::new(folder);
    let recipe = Recipe::parse("a.yaml", &small_recipe(1)).expect("sound");
    let whole = compile(&recipe, "a", folder, &assets).expect("sound").json();
    let mut stream = Stream::at(1, "test", 0, "damage");
    let mut refused = 0;
    for _ in 0..1500 {
        let mut bytes = whole.clone();
        for _ in 0..=stream.below(3) {
            let place = stream.below(bytes.len() as u64) as usize;
            match stream.below(3) {
                0 => bytes[place] = DAMAGE[stream.below(DAMAGE.len() as u64) as usize],
                1 => drop(bytes.remove(place)),
                _ => bytes.insert(place, b'0' + stream.below(10) as u8),
            }
        }
        refused += u32::from(read("p.json", &bytes, folder, &assets).is_err());
    }
    assert!(refused > 300, "most damage is found: {refused}");
}
