use std::collections::BTreeMap;

use serde::Deserialize;

use crate::recipe::{Error, Origin, parse};

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Water {
    depth_m: f64,
    #[serde(default)]
    layers: u8,
    name: Option<String>,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ripples {
    #[serde(default)]
    wavelength_m: f64,
    #[serde(default)]
    height_m: f64,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Nothing {}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum Shape {
    Flat,
    Plane(Nothing),
    Ripples(Ripples),
    Poses(String),
    Pair(f64, f64),
    Slope { slope_deg: f64 },
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(try_from = "f64")]
struct Share(f64);

impl TryFrom<f64> for Share {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        if (0.0..=1.0).contains(&value) { Ok(Self(value)) } else { Err(format!("{value} is not a share from 0 to 1")) }
    }
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct All {
    #[serde(default)]
    water: Option<Water>,
    #[serde(default)]
    shape: Option<Shape>,
    #[serde(default)]
    on: bool,
    #[serde(default)]
    range_m: [f32; 2],
    #[serde(default)]
    tags: Vec<String>,
    #[serde(default)]
    shares: BTreeMap<String, Share>,
    #[serde(default)]
    seed: u64,
}

fn typed(text: &str) -> Result<All, Error> {
    parse("a", text, Origin::Given).unwrap().to("")
}

fn shape(text: &str) -> Shape {
    typed(&format!("shape: {text}")).unwrap_or_else(|error| panic!("{error}")).shape.unwrap()
}

#[test]
fn plain_values_are_typed() {
    let all = typed(
        "water: {depth_m: 5, layers: 0xff, name: ~}\non: true\nrange_m: [1, 2.5]\ntags: [a, \"1\"]\nshares: {x: 1}\nseed: 18446744073709551615",
    )
    .unwrap();
    assert_eq!(all.water, Some(Water { depth_m: 5.0, layers: 255, name: None }));
    assert_eq!((all.on, all.range_m, all.seed), (true, [1.0, 2.5], u64::MAX));
    assert_eq!(all.tags, ["a", "1"]);
    assert_eq!(all.shares["x"], Share(1.0));
    assert_eq!(typed("water: null").unwrap().water, None);
}

#[test]
fn kinds_are_words_or_maps() {
    for text in ["flat", "{flat: {}}", "{flat: }", "{flat: null}"] {
        assert_eq!(shape(text), Shape::Flat, "{text}");
    }
    assert_eq!(shape("plane"), Shape::Plane(Nothing {}));
    assert_eq!(shape("{plane: }"), Shape::Plane(Nothing {}));
    assert_eq!(shape("ripples"), Shape::Ripples(Ripples { wavelength_m: 0.0, height_m: 0.0 }));
    assert_eq!(shape("{ripples: {height_m: 1}}"), Shape::Ripples(Ripples { wavelength_m: 0.0, height_m: 1.0 }));
    assert_eq!(shape("{poses: a.csv}"), Shape::Poses("a.csv".into()));
    assert_eq!(shape("{pair: [1, 2]}"), Shape::Pair(1.0, 2.0));
    assert_eq!(shape("{slope: {slope_deg: 3}}"), Shape::Slope { slope_deg: 3.0 });
}

#[test]
fn each_fault_is_named_and_located() {
    for (text, expected, help) in [
        ("watr: 1", "1:1 unknown key `watr`", "did you mean `water`?"),
        ("water:\n  depth_m: 1\n  dpth_m: 2", "3:3 unknown key `dpth_m` in water", "did you mean `depth_m`?"),
        ("water: {}", "1:8 the key `depth_m` is missing in water", "add `depth_m:`"),
        ("water:\n  layers: 1", "1:1 the key `depth_m` is missing in water", "add `depth_m:`"),
        ("water: {depth_m: deep}", "1:18 expected a number, found the text `deep` in water.depth_m", "write digits"),
        ("water: {depth_m: \"5\"}", "1:18 expected a number, found the text `5` in water.depth_m", "without quotes"),
        ("water: {depth_m: }", "1:9 expected a number, found nothing in water.depth_m", "write digits"),
        ("water: {depth_m: [1]}", "1:18 expected a number, found a list in water.depth_m", "write digits"),
        ("water: 3", "1:8 expected a map, found the number 3 in water", "its keys are depth_m, layers, name"),
        ("water: {depth_m: 1, name: 5}", "1:27 expected a text, found the number 5 in water.name", "put it in quotes"),
        (
            "water: {depth_m: 1, layers: 1.0}",
            "1:29 expected a whole number, found the number 1.0 in water.layers",
            "round it",
        ),
        ("water: {depth_m: 1, layers: 256}", "1:29 256 is not a whole number from 0 to 255 in water.layers", "range"),
        ("seed: -1", "1:7 -1 is not a whole number from 0 to 18446744073709551615 in seed", "range"),
        ("on: yes", "1:5 expected true or false, found the text `yes` in on", "write true or false"),
        ("range_m: [1]", "1:10 expected 2 values, found 1 in range_m", "complete"),
        ("range_m: 5", "1:10 expected a list of 2 values, found the number 5 in range_m", "write [a, b"),
        ("range_m: [1, 1e39]", "1:14 the number 1e39 is too large in range_m[1]", "smaller"),
        ("range_m: [1, b]", "1:14 expected a number, found the text `b` in range_m[1]", "write digits"),
        ("tags: a", "1:7 expected a list, found the text `a` in tags", "write [a, b"),
        ("tags: [a, true]", "1:11 expected a text, found `true` in tags[1]", "put it in quotes"),
        ("shares: {\"a.b\": 2}", "1:17 2 is not a share from 0 to 1 in shares[\"a.b\"]", ""),
        ("shares: [1]", "1:9 expected a map, found a list in shares", "key: value"),
        ("shape: rippels", "1:8 unknown kind `rippels` in shape", "did you mean `ripples`?"),
        ("shape: {rippels: {}}", "1:9 unknown kind `rippels` in shape", "did you mean `ripples`?"),
        ("shape: {choise: [a]}", "1:9 unknown kind `choise` in shape", "did you mean the distribution `choice`?"),
        (
            "shape: {flat: {}, ripples: {}}",
            "1:19 expected one kind, found 2: flat, ripples in shape",
            "the kinds are flat, plane",
        ),
        ("shape: {}", "1:8 expected a kind, found an empty map in shape", "write one of flat"),
        ("shape: 3", "1:8 expected a kind, found the number 3 in shape", "write one of flat"),
        ("shape: {flat: {a: 1}}", "1:16 unknown key `a` in shape.flat", "no keys"),
        ("shape: {flat: 1}", "1:15 expected no value, found the number 1 in shape.flat", "remove it"),
        ("shape: {plane: {a: 1}}", "1:17 unknown key `a` in shape.plane", "nothing is valid"),
        (
            "shape: {ripples: {wavelenth_m: 1}}",
            "1:19 unknown key `wavelenth_m` in shape.ripples",
            "did you mean `wavelength_m`?",
        ),
        (
            "shape: {ripples: 5}",
            "1:18 expected a map, found the number 5 in shape.ripples",
            "its keys are wavelength_m",
        ),
        ("shape: slope", "1:8 the key `slope_deg` is missing in shape.slope", "add `slope_deg:`"),
        ("shape: poses", "1:8 `poses` needs a text in shape.poses", "write {poses: …}"),
        ("shape: pair", "1:8 `pair` needs a list of 2 values in shape.pair", "write {pair: …}"),
        (
            "water: {depth_m: {uniformm: [1, 2]}}",
            "1:19 expected a number, found the unknown distribution `uniformm` in water.depth_m",
            "did you mean `uniform`?",
        ),
        (
            "water: {depth_m: {nromal: [1, 2], min: 0}}",
            "1:19 expected a number, found the unknown distribution `nromal` in water.depth_m",
            "did you mean `normal`?",
        ),
        (
            "water: {depth_m: {gamma: 3}}",
            "1:19 expected a number, found the unknown distribution `gamma` in water.depth_m",
            "valid: uniform, log_uniform",
        ),
        ("water: {depth_m: {a: 1, b: 2}}", "1:18 expected a number, found a map in water.depth_m", "write digits"),
        (
            "on: {coice: [true]}",
            "1:6 expected true or false, found the unknown distribution `coice` in on",
            "did you mean `choice`?",
        ),
        ("seed: {int: [1, 2]}", "1:7 the distribution `int` is not drawn here in seed", "write a whole number"),
        (
            "water: {choice: [{depth_m: 1}]}",
            "1:8 the distribution `choice` is not drawn here in water",
            "write the keys out",
        ),
        ("shape: {choice: [flat]}", "1:8 the distribution `choice` is not drawn here in shape", "write one of flat"),
    ] {
        let error = typed(text).expect_err(text);
        let place = format!("{}:{} ", error.span.line, error.span.column);
        let path = if error.path.is_empty() { String::new() } else { format!(" in {}", error.path) };
        assert_eq!(place + &error.message + &path, expected, "{text}");
        assert!(error.help.contains(help), "{text}: {}", error.help);
    }
}

#[test]
fn the_whole_block_reads_well() {
    let text = "seabed:\n  shape:\n    ripples:\n      wavelenth_m: 0.2\n";
    let tree = parse("recipes/a.yaml", text, Origin::Given).unwrap();
    let error = tree.at("seabed.shape").unwrap().to::<Shape>("seabed.shape").unwrap_err();
    let block = "recipes/a.yaml:4:7: unknown key `wavelenth_m` in seabed.shape.ripples
  4 |       wavelenth_m: 0.2
    |       ^
help: did you mean `wavelength_m`? (valid: wavelength_m, height_m)";
    assert_eq!(error.to_string(), block);
}

#[test]
fn untyped_and_untagged_values_are_read() {
    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(untagged)]
    enum One {
        Number(f64),
        Many(Vec<f64>),
    }
    let tree = parse("a", "[1, [2.5, 3], -4, x]", Origin::Given).unwrap();
    let read = |i: usize| tree.items()[i].to::<One>(&format!("[{i}]"));
    assert_eq!(read(0).unwrap(), One::Number(1.0));
    assert_eq!(read(1).unwrap(), One::Many(vec![2.5, 3.0]));
    assert_eq!(read(2).unwrap(), One::Number(-4.0));
    assert_eq!(read(3).unwrap_err().span.to_string(), "a:1:19");
    assert_eq!(tree.to::<serde_json::Value>("").unwrap(), tree.json());
}
