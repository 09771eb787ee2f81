use super::*;
use crate::recipe::{Origin, parse};

fn tree(text: &str) -> Node {
    parse("a", text, Origin::Given).unwrap()
}

fn address(scene: u64, level: Level) -> Address {
    Address { seed: 7, scene, level }
}

/// The numbers that `x` takes over many scenes.
fn numbers(distribution: &str, count: u64) -> Vec<f64> {
    let tree = tree(&format!("x: {distribution}"));
    let draw = |scene| tree.draw("", &address(scene, Level::Scene)).unwrap().get("x").unwrap().number().unwrap();
    (0..count).map(draw).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn laws_have_their_moments_and_bounds() {
    let uniform = numbers("{uniform: [4, 22]}", 4_000);
    assert!(uniform.iter().all(|x| (4.0..22.0).contains(x)) && (mean(&uniform) - 13.0).abs() < 0.3);
    let log: Vec<f64> = numbers("{log_uniform: [0.1, 10]}", 4_000);
    assert!(log.iter().all(|x| (0.1..=10.0).contains(x)));
    let below = log.iter().filter(|x| **x < 1.0).count();
    assert!((1_850..2_150).contains(&below), "{below}");
    let normal = numbers("{normal: [10, 2]}", 4_000);
    let spread: Vec<f64> = normal.iter().map(|x| (x - 10.0) * (x - 10.0)).collect();
    assert!((mean(&normal) - 10.0).abs() < 0.15 && (mean(&spread) - 4.0).abs() < 0.4);
    let truncated = numbers("{normal: [0, 1], min: 0.5, max: 1}", 500);
    assert!(truncated.iter().all(|x| (0.5..=1.0).contains(x)));
    assert!(truncated.iter().filter(|x| **x == 0.5 || **x == 1.0).count() == 0, "redrawn, not clamped");
    assert_eq!(numbers("{normal: [0, 1], min: 50}", 3), [50.0; 3]);
    assert_eq!(numbers("{normal: [3, 0]}", 1), [3.0]);
    let int = numbers("{int: [-1, 1]}", 3_000);
    for value in [-1.0, 0.0, 1.0] {
        let count = int.iter().filter(|x| **x == value).count();
        assert!((880..1_120).contains(&count), "{value}: {count}");
    }
    assert_eq!(numbers("{int: [-9007199254740992, 9007199254740992]}", 50).len(), 50);
    assert_eq!(numbers("{uniform: [2, 2]}", 2), [2.0; 2]);
}

#[test]
fn choices_follow_their_weights() {
    for text in ["{choice: {1: 0.7, 2: 0, 3: 0.3}}", "{choice: [1, 2, 3], weights: [7, 0, 3]}"] {
        let drawn = numbers(text, 3_000);
        let count = |value: f64| drawn.iter().filter(|x| **x == value).count();
        assert!((2_000..2_200).contains(&count(1.0)) && count(2.0) == 0, "{text}: {}", count(1.0));
    }
    let drawn = numbers("{choice: [1, 2, 3, 4]}", 4_000);
    assert!((1..=4).all(|v| (900..1_100).contains(&drawn.iter().filter(|x| **x == f64::from(v)).count())));
}

#[test]
fn a_choice_and_what_is_in_it_are_independent() {
    let drawn = numbers("{choice: [{uniform: [0, 1]}, {uniform: [10, 11]}]}", 2_000);
    let low: Vec<f64> = drawn.iter().copied().filter(|x| *x < 5.0).collect();
    let high: Vec<f64> = drawn.iter().copied().filter(|x| *x > 5.0).map(|x| x - 10.0).collect();
    assert!((900..1_100).contains(&low.len()));
    assert!((mean(&low) - 0.5).abs() < 0.05 && (mean(&high) - 0.5).abs() < 0.05);
}

const WORLD: &str = "
water: {temperature_c: {uniform: [4, 22]}, depth_m: {int: [1, 1000000]}}
seabed: {shape: {choice: [{ripples: {height_m: {uniform: [0, 1]}}}, {fractal: {rms_m: {uniform: [0, 1]}}}]}}
objects: [{count: {int: [1, 1000000]}}]
";

#[test]
fn other_keys_and_another_order_move_no_draw() {
    let changed = "
new: {uniform: [0, 1]}
objects: [{label: tire, extra: {normal: [0, 1]}, count: {int: [1, 1000000]}}, {count: {int: [1, 1000000]}}]
seabed: {shape: {choice: [{ripples: {new: {uniform: [0, 1]}, height_m: {uniform: [0, 1]}}}, {fractal: {rms_m: {uniform: [0, 1]}}}]}}
water: {depth_m: {int: [1, 1000000]}, new: {choice: [1, 2]}, temperature_c: {uniform: [4, 22]}}
";
    for scene in 0..20 {
        let (_, before) = tree(WORLD).draw_recorded("", &address(scene, Level::Scene)).unwrap();
        let (_, after) = tree(changed).draw_recorded("", &address(scene, Level::Scene)).unwrap();
        assert!(before.len() == 5 && after.len() >= 9, "{before:?} {after:?}");
        for (path, value) in before.iter().filter(|(path, _)| *path != "seabed.shape") {
            assert_eq!(after.get(path), Some(value), "{path}");
        }
    }
}

/// Drawn values are part of every dataset hash: these may never change.
#[test]
fn draws_are_pinned() {
    let (drawn, draws) = tree(WORLD).draw_recorded("", &address(3, Level::Scene)).unwrap();
    assert_eq!(serde_json::to_string(&draws).unwrap(), PINNED);
    assert_eq!(drawn.at("water.depth_m").unwrap().json(), draws["water.depth_m"]);
    assert_eq!(drawn.at("seabed.shape").unwrap().json(), draws["seabed.shape"]);
    assert_eq!(drawn.at("water.depth_m").unwrap().span, tree(WORLD).at("water.depth_m").unwrap().span);
}
const PINNED: &str = r#"{"objects[0].count":337292,"seabed.shape":{"fractal":{"rms_m":0.4968322235406293}},"seabed.shape.fractal.rms_m":0.4968322235406293,"water.depth_m":268355,"water.temperature_c":14.157738169278904}"#;

#[test]
fn a_section_drawn_alone_is_as_in_the_whole() {
    let whole = tree(WORLD).draw("", &address(5, Level::Scene)).unwrap();
    let part = tree(WORLD).get("water").unwrap().draw("water", &address(5, Level::Scene)).unwrap();
    assert_eq!(whole.get("water"), Some(&part));
}

#[test]
fn per_says_how_often() {
    let tree = tree("{d: {uniform: [0, 1], per: dataset}, s: {uniform: [0, 1], per: scene}, n: {uniform: [0, 1]}}");
    let draw =
        |scene, level, key: &str| tree.get(key).unwrap().draw(key, &address(scene, level)).unwrap().number().unwrap();
    let (first, second) = (Level::Instance(0), Level::Instance(1));
    assert_eq!(draw(0, Level::Scene, "d"), draw(1, second, "d"));
    assert_eq!(draw(0, Level::Dataset, "n"), draw(1, Level::Dataset, "n"));
    assert_eq!(draw(1, Level::Scene, "s"), draw(1, second, "s"));
    assert_eq!(draw(1, Level::Scene, "n"), draw(1, Level::Frame(4), "n"));
    assert_ne!(draw(0, Level::Scene, "s"), draw(1, Level::Scene, "s"));
    assert_ne!(draw(0, first, "n"), draw(0, second, "n"));
    assert_ne!(draw(0, first, "n"), draw(1, first, "n"));
    assert_eq!(draw(0, first, "s"), draw(0, second, "s"));
    let frame = self::tree("{uniform: [0, 1], per: frame}");
    let draw = |scene, k| frame.draw("f", &address(scene, Level::Frame(k))).unwrap().number().unwrap();
    assert_eq!(draw(1, 2), draw(1, 2));
    assert!(draw(1, 2) != draw(1, 3) && draw(1, 2) != draw(2, 2));
    let other_seed = Address { seed: 8, ..address(1, Level::Frame(2)) };
    assert_ne!(frame.draw("f", &other_seed).unwrap().number().unwrap(), draw(1, 2));
}

#[test]
fn per_that_cannot_be_is_refused() {
    for (per, level, often) in [
        ("frame", Level::Scene, "a scene"),
        ("frame", Level::Instance(0), "an instance"),
        ("frame", Level::Dataset, "for the dataset"),
        ("scene", Level::Dataset, "for the dataset"),
    ] {
        let node = tree(&format!("{{uniform: [0, 1], per: {per}}}"));
        let error = node.draw("water.ph", &address(0, level)).unwrap_err();
        assert_eq!(error.message, format!("`per: {per}` is not possible here: this part is drawn once {often}"));
        assert_eq!((error.path.as_str(), error.column()), ("water.ph", Some(24)));
        assert_eq!(node.check_distributions("water.ph", level).unwrap_err(), error);
    }
}

#[test]
fn a_fault_of_a_drawn_value_is_located() {
    let drawn = tree("{count: {uniform: [1.1, 1.2]}}").draw("", &address(0, Level::Scene)).unwrap();
    let error = drawn.get("count").unwrap().to::<u32>("count").unwrap_err();
    assert_eq!((error.column(), error.path.as_str()), (Some(9), "count"));
    assert!(error.help.contains("{int: [low, high]}"));
}
