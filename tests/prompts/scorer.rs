//! The scorer itself, on recipes written by hand: what they have is seen, and what they have not is missed.

use std::collections::BTreeSet;

use crate::checked;
use crate::expected::{Case, Set, cases, vocabulary};
use crate::score::{Mark, Outcome, score};

/// A recipe for the first of the prompts, and how it scores.
const TIRES: &str = "
ensonify: 1
scenes: 30
frames: 10
sonar: {device: oculus-m1200d-lf, range_m: [0.5, 10]}
water: {depth_m: 12, turbidity: turbid}
seabed: {shape: flat, sediment: {choice: [fine-sand, medium-sand]}}
objects:
  - {pick: {catalog: starter, label: tire}, count: 2}
  - {pick: {catalog: starter, label: anchor}, pose: {rest: {burial: 0.3}}}
trajectory: {orbit: {radius_m: 4, altitude_m: 2}}
";

/// Expectations, as a YAML map on one line.
fn case(fields: &str) -> Case {
    let inside = fields.strip_prefix('{').and_then(|fields| fields.strip_suffix('}')).unwrap_or(fields);
    serde_yaml::from_str(&format!("{{prompt: a, kind: complete, {inside}}}")).expect(fields)
}

/// Holds a recipe against expectations.
fn held(recipe: &str, expected: &str) -> Vec<Mark> {
    score(&case(expected), &checked(recipe), &vocabulary())
}

/// Asserts that every field is right, or that every field is wrong.
fn each(recipe: &str, fields: &[&str], right: bool) {
    for expected in fields {
        for Mark { field, right: was, found, .. } in held(recipe, expected) {
            assert_eq!(was, right, "{field}: {expected}, found {found}");
        }
    }
}

#[test]
fn what_a_recipe_has_is_seen() {
    let right = [
        "{images: 300, versions: 1, scenes: 30, seed: 0, name: drafted}",
        "objects: {tire: 2, anchor: 1, anything: 3, debris: some}",
        "without: [mine, barrel]",
        "{sediment: sand, shape: flat, depth_m: 12, turbidity: [turbid, coastal], salinity_ppt: 35}",
        "{sonar: oculus-m1200d, frequency_khz: 1200, beams: 512, fov_deg: 130, range_m: 10, near_m: 0.5, pitch_deg: -15}",
        "{trajectory: {orbit: {radius_m: 4, arc_deg: 360}}, altitude_m: 2}",
        "{burial: {anchor: 0.3}, lying: [tire], pose: {tire: [settle, rest], anchor: {rest: {burial: [0.2, 0.4]}}}}",
        "{splits: {train: 0.8, by: scene}, output: {raw: none, views: [polar, fan]}}",
    ];
    each(TIRES, &right, true);
}

#[test]
fn what_a_recipe_has_not_is_missed() {
    let wrong = [
        "{images: 299, versions: 2, scenes: {from: 1, to: 20}, seed: 7, name: other}",
        "objects: {tire: 3, barrel: some, anchor: 0, anything: 2}",
        "without: [tire]",
        "{sediment: mud, shape: reef, depth_m: 12.5, turbidity: clear, salinity_ppt: 7, environment: pier}",
        "sediment: fine-sand",
        "{sonar: oculus-m750d, frequency_khz: 750, beams: 256, fov_deg: 90, range_m: 12, near_m: 1, pitch_deg: 0}",
        "{trajectory: {lawnmower: {lines: 4}}, altitude_m: 3, multipath: surface, motion: {roll_deg: 2}}",
        "{burial: {tire: 0.3}, floating: {anchor: some}, tipped: {tire: 90}, pose: {tire: cluster}}",
        "{splits: {train: 0.7, by: asset}, output: {raw: exr, views: [fan]}}",
        "depth_m: {from: 10, to: 14}",
    ];
    each(TIRES, &wrong, false);
}

#[test]
fn a_word_means_some_models_and_no_others() {
    let recipe = "
ensonify: 1
sonar: {device: didson-hf, range_m: [0.5, 10]}
seabed: {}
objects:
  - {label: target, pick: {catalog: starter, uid: oil-drum}}
  - {pick: {catalog: starter, uid: bottom-mine}}
  - {pick: {catalog: starter, uid: truck-tire}, count: 2}
  - {pick: {catalog: starter, uid: anchor}}
trajectory: {views: {}}
";
    each(
        recipe,
        &["objects: {barrel: 1, oil-drum: 1, mine: 1, ordnance: 1, tire: 2, truck-tire: 2, debris: 3, ship: 0}"],
        true,
    );
}

#[test]
fn ranges_places_and_paths_are_those_of_the_built_world() {
    let recipe = "
ensonify: 1
frames: 5
sonar: {device: oculus-m750d-lf, range_m: [0.5, 10]}
water: {depth_m: 10}
seabed: {extent_m: 30, cell_m: 0.2}
objects:
  - {pick: {catalog: starter, uid: anchor}, pose: {at: {position_m: [3, -2, 0]}}}
  - {pick: {catalog: starter, uid: salmon}, pose: {at: {position_m: [8, 0, 3]}}}
trajectory: {waypoints: {points_m: [[0, -2, 3], [0, -8, 3]]}}
";
    let right = [
        "{path_m: 6, deepest_m: 7, area_m: {anchor: [[3, -2], [3, -2]]}, altitude_m: 3, floating: {fish: 3}}",
        "{objects: {anchor: 1}, object_range_m: [3.5, 3.9]}",
        "{objects: {anchor: 1}, object_range_m: {from: 4, to: 7}}",
    ];
    each(recipe, &right[..1], true);
    let wrong = ["{path_m: 7, deepest_m: 6, area_m: {anchor: [[0, 0], [1, 1]]}, altitude_m: 2, floating: {fish: 2}}"];
    each(recipe, &wrong, false);
    assert!(!held(recipe, right[1])[1].right, "it goes away from the anchor");
    assert!(held(recipe, right[2])[1].right, "as far as 7 m");
}

#[test]
fn refusals_are_held_against_their_words() {
    let message = "zero images: there must be at least one\nhelp: write `10 images`".to_owned();
    let refused = Outcome::Refused(message);
    let right = |expected: &str, outcome: &Outcome| {
        score(&case(expected), outcome, &vocabulary()).iter().map(|mark| mark.right).collect::<Vec<_>>()
    };
    assert_eq!(right("refused: [IMAGE, none|zero, tire]", &refused), [true, true, false]);
    assert_eq!(right("refused: [image, zero]", &checked(TIRES)), [false, false]);
    assert_eq!(right("{images: 2, sediment: sand, objects: {tire: 1}}", &refused), [false; 3]);
    assert_eq!(right("{images: 2, shape: flat, without: [tire]}", &checked("ensonify: 1")), [false; 3]);
}

#[test]
fn every_prompt_is_there_once_and_says_something() {
    let files = ["prompts.yaml", "prompts_more.yaml", "prompts_nonsense.yaml"].map(cases);
    assert_eq!(files.each_ref().map(Vec::len), [39, 145, 26]);
    let all: BTreeSet<String> = files.iter().flatten().map(|case| case.prompt.to_lowercase()).collect();
    // One of the nonsense stands among the 39 too, in other capitals.
    assert_eq!(all.len(), 39 + 145 + 26 - 1);
    for case in files.iter().flatten() {
        let fields = score(case, &Outcome::Invalid(String::new()), &vocabulary());
        assert!(!fields.is_empty() && fields.iter().all(|mark| !mark.right), "{}", case.prompt);
    }
    assert!(files[1].iter().all(|case| case.set.is_some()) && files[2].iter().all(|case| case.refused.is_some()));
    let held_out = files[1].iter().filter(|case| case.set == Some(Set::HeldOut)).count();
    assert_eq!(held_out, 72);
}
