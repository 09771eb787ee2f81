//! Whatever stands in a recipe, it is accepted or refused with a place and a message: soon, and without a panic.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use ensonify::math::rng::Stream;
use ensonify::plan::{Plan, PlanError, compile, corners, schema};
use ensonify::recipe::{self, Recipe};
use ensonify::scene::AssetCache;
use serde_json::{Map, Value, json};

/// Longest that any recipe may take.
const SOON: Duration = Duration::from_secs(2);

fn recipes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes")
}

/// Reads and compiles a text, whatever it asks for made small; `Ok` when it is accepted.
fn compiled(text: &str, assets: &AssetCache) -> Result<(Recipe, Plan), recipe::Error> {
    let mut recipe = Recipe::parse("any.yaml", text)?;
    for (key, few) in [("scenes", "1"), ("frames", "2")] {
        if recipe.node().get(key).and_then(recipe::Node::number).is_some_and(|number| number > 3.0) {
            recipe.set(key, few)?;
        }
    }
    match compile(&recipe, "any", &recipes(), assets) {
        Ok(plan) => {
            assert!(!plan.json().is_empty());
            Ok((recipe, plan))
        }
        Err(PlanError::Recipe(error)) => Err(error),
        Err(error @ (PlanError::Catalog(_) | PlanError::Plan(_))) => panic!("a fault without a place: {error}"),
    }
}

/// Holds a text to the promise; tells whether it was accepted.
fn judge(text: &str, assets: &AssetCache) -> bool {
    let begun = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| compiled(text, assets).map(|_| ())));
    let taken = begun.elapsed();
    let Ok(outcome) = outcome else { panic!("this recipe makes the program panic:\n{text}") };
    assert!(taken < SOON, "{taken:?} for\n{text}");
    if let Err(error) = &outcome {
        assert!(!error.message.is_empty() && !error.file().is_empty(), "{error}\nfor\n{text}");
        // Only an empty text has no line at all.
        assert!(error.line().is_some() || error.message == "is empty", "no place: {error}\nfor\n{text}");
    }
    outcome.is_ok()
}

/// Tries the corners of a recipe that is accepted: they hold, or a fault has its place.
fn try_corners(text: &str, assets: &AssetCache) {
    let (recipe, plan) = compiled(text, assets).expect("accepted before");
    match corners(&recipe, &plan, &recipes(), assets) {
        Ok(_) => {}
        Err(PlanError::Recipe(error)) => assert!(error.line().is_some(), "no place: {error}\nfor\n{text}"),
        Err(error) => panic!("a fault without a place: {error}\nfor\n{text}"),
    }
}

/// Values made from a schema.
struct Maker<'a> {
    schema: &'a Value,
    stream: Stream,
}

impl Maker<'_> {
    fn chance(&mut self, share: f64) -> bool {
        self.stream.unit() < share
    }

    fn one_of<'v>(&mut self, values: &'v [Value]) -> &'v Value {
        &values[self.stream.below(values.len() as u64) as usize]
    }

    fn value(&mut self, of: &Value, depth: u32) -> Value {
        // What a schema shows is mostly sound: with it whole recipes come through.
        if self.chance(0.45) {
            if let Some(examples) = of["examples"].as_array() {
                return self.one_of(examples).clone();
            }
            if !of["default"].is_null() {
                return of["default"].clone();
            }
        }
        if let Some(place) = of["$ref"].as_str() {
            let place = self.schema.pointer(place.trim_start_matches('#')).expect("a definition").clone();
            return self.value(&place, depth);
        }
        if let Some(forms) = of["anyOf"].as_array() {
            // The first form is the plain one.
            let form = if self.chance(0.7) { &forms[0] } else { self.one_of(forms) };
            return self.value(&form.clone(), depth);
        }
        if let Some(words) = of["enum"].as_array() {
            return self.one_of(words).clone();
        }
        if !of["const"].is_null() {
            return of["const"].clone();
        }
        match of["type"].as_str() {
            Some("number") => self.number(),
            Some("integer") => json!(self.stream.below(4)),
            Some("boolean") => json!(self.chance(0.5)),
            Some("string") if of["pattern"].is_string() => json!(["$a", "$b", "plain"][self.stream.below(3) as usize]),
            Some("string") => json!(["starter", "tire", "debris", "$a", "$$b", ""][self.stream.below(6) as usize]),
            Some("array") => {
                let low = of["minItems"].as_u64().unwrap_or(0);
                let count = low + if of["maxItems"].is_null() { self.stream.below(3) } else { 0 };
                (0..count).map(|_| self.value(&of["items"], depth + 1)).collect()
            }
            Some("object") => self.map(of, depth),
            _ => self.one_of(&[json!("objects"), json!(3), json!(null), json!([]), json!({})]).clone(),
        }
    }

    fn map(&mut self, of: &Value, depth: u32) -> Value {
        let mut entries = Map::new();
        let single = of["maxProperties"] == 1;
        let keys: Vec<(String, Value)> =
            of["properties"].as_object().map(|keys| keys.clone().into_iter().collect()).unwrap_or_default();
        let only = if keys.is_empty() { 0 } else { self.stream.below(keys.len() as u64) as usize };
        for (i, (key, value)) in keys.iter().enumerate() {
            if if single { i == only } else { depth < 12 && self.chance(0.35) } {
                entries.insert(key.clone(), self.value(value, depth + 1));
            }
        }
        Value::Object(entries)
    }

    fn number(&mut self) -> Value {
        match self.stream.below(8) {
            0 => json!(-1),
            1 => json!(0),
            2 => json!(1e9),
            3 => json!(self.stream.uniform(-100.0, 100.0)),
            _ => json!(self.stream.uniform(0.1, 10.0)),
        }
    }
}

#[test]
fn a_thousand_recipes_of_known_keys_are_accepted_or_refused_with_a_place() {
    let schema: Value = serde_json::from_str(&schema()).expect("JSON");
    let assets = AssetCache::new(&recipes());
    let mut accepted = 0;
    for number in 0..1000 {
        let mut maker = Maker { schema: &schema, stream: Stream::at(1, "any", number, "recipe") };
        let sound = json!({
            "sonar": {"device": "oculus-m1200d-lf", "range_m": [0.5, 10]},
            "seabed": {"shape": "flat", "sediment": "silt"},
            "trajectory": {"orbit": {"radius_m": 5, "altitude_m": 2}},
        });
        let mut made = Map::new();
        for (key, value) in schema["properties"].as_object().expect("keys") {
            let value = match sound.get(key) {
                Some(sound) if maker.chance(0.6) => sound.clone(),
                Some(_) => maker.value(value, 0),
                None if key == "let" => json!({"a": {"uniform": [1, 2]}, "b": 3}),
                None if maker.chance(0.2) => maker.value(value, 0),
                None => continue,
            };
            made.insert(key.clone(), value);
        }
        made.insert("ensonify".to_owned(), json!(1));
        made.remove("include");
        let text = Value::Object(made).to_string();
        if judge(&text, &assets) {
            accepted += 1;
            try_corners(&text, &assets);
        }
    }
    println!("{accepted} of 1000 are accepted");
    assert!((100..950).contains(&accepted), "{accepted} are accepted: the recipes are all good or all bad");
}

/// A text with something done to it.
fn mutated(text: &str, stream: &mut Stream) -> String {
    const WORDS: [&str; 28] = [
        "null",
        "true",
        "-1",
        "0",
        "1e308",
        ".nan",
        "9999999999999999999",
        "''",
        "[]",
        "{}",
        "[[]]",
        "{a: 1}",
        "$a",
        "$",
        "$$a",
        "{uniform: [2, 1]}",
        "{choice: []}",
        "{choice: {a: 0}}",
        "{int: [0, 1e9]}",
        "{uniform: [$a, 1]}",
        "&a x",
        "*a",
        "!!int 3",
        "\u{0}",
        "\u{feff}",
        "é\u{301}",
        "- ",
        "? ",
    ];
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=stream.below(3) {
        let mut lines: Vec<String> = String::from_utf8_lossy(&bytes).lines().map(str::to_owned).collect();
        if lines.is_empty() {
            return String::new();
        }
        let (at, other) = (stream.below(lines.len() as u64) as usize, stream.below(lines.len() as u64) as usize);
        match stream.below(9) {
            0 => drop(lines.remove(at)),
            1 => lines.swap(at, other),
            2 => lines.insert(at, lines[other].clone()),
            3 => lines[at].insert_str(0, ["  ", " ", "\t", "    "][stream.below(4) as usize]),
            4 => lines[at] = lines[at].trim_start().to_owned(),
            5 => {
                // Another value behind a key.
                let word = WORDS[stream.below(WORDS.len() as u64) as usize];
                if let Some((key, _)) = lines[at].clone().split_once(':') {
                    lines[at] = format!("{key}: {word}");
                }
            }
            6 => {
                let (deep, many) =
                    ([("[", "]"), ("{a: ", "}"), ("- ", "")][stream.below(3) as usize], stream.below(3000));
                let value = format!("{}1{}", deep.0.repeat(many as usize), deep.1.repeat(many as usize));
                let key = lines[at].split(':').next().unwrap_or_default().to_owned();
                lines[at] = format!("{key}: {value}");
            }
            _ => {
                let mut line = std::mem::take(&mut lines[at]).into_bytes();
                let place = stream.below(line.len() as u64 + 1) as usize;
                match stream.below(3) {
                    0 => line.insert(place, stream.below(256) as u8),
                    1 if place < line.len() => line[place] = stream.below(128) as u8,
                    _ => line.truncate(place),
                }
                lines[at] = String::from_utf8_lossy(&line).into_owned();
            }
        }
        bytes = lines.join("\n").into_bytes();
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Everything that the language has, in one recipe.
const ALL: &str = "ensonify: 1
name: all
let:
  a: {uniform: [2, 4]}
  b: {choice: [$a, {normal: [3, 1], min: $c}]}
  c: 1
scenes: 2
frames: $c
sonar: {device: {choice: [oculus-m1200d-lf, gemini-720is]}, range_m: [0.5, $b]}
water:
  temperature_c: {uniform: [4, 22], per: frame}
  depth_m: $a
seabed:
  shape: {choice: {flat: 1, ripples: 2}}
  sediment: {choice: [silt, mud], weights: [1, 2]}
objects:
  - pick: {catalog: starter, tags: [debris]}
    count: {int: [0, 2]}
    pose: {rest: {within_m: $b}}
  - label: anchor
    pick: {catalog: starter, uid: [anchor, tire]}
trajectory: {views: {range_m: {log_uniform: [2, 4], per: frame}}}
looks:
  - {name: clear}
  - name: warm
    water: {temperature_c: 25}
splits: {train: 0.5, val: 0, test: 0.5, by: variant}
sweep:
  grid: {water.ph: [7.5, 8], let.c: [1, 2]}
  zip:
    sonar.beams: [64, 96]
    sonar.range_bins: [100, 200]
";

#[test]
fn ten_thousand_broken_files_never_panic_and_never_take_long() {
    let mut texts = vec![ALL.to_owned()];
    for name in ["quickstart", "mine-like-objects", "wreck-survey"] {
        texts.push(fs::read_to_string(recipes().join(format!("{name}.yaml"))).expect("a recipe"));
    }
    let assets = AssetCache::new(&recipes());
    assert!(texts.iter().all(|text| judge(text, &assets)), "the whole ones are accepted");
    let mut accepted = 0;
    for number in 0..10_000 {
        let mut stream = Stream::at(2, "any", number, "mutation");
        let text = mutated(&texts[number as usize % texts.len()], &mut stream);
        accepted += u32::from(judge(&text, &assets));
    }
    println!("{accepted} of 10,000 are accepted");
    assert!((500..9_500).contains(&accepted), "{accepted}");
}
