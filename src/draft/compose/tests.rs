//! Wishes of many kinds become recipes that can be run, and say what was asked for.

use std::path::Path;

use super::compose;
use crate::draft::check::checked;
use crate::draft::wish::*;
use crate::draft::{Known, Models, Options, Prompt, Refusal, Wish};
use crate::plan::{Plan, Split};
use crate::vehicle::Trajectory;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn known() -> Known {
    Known::open(root(), &["starter".to_owned()]).expect("the starter catalog")
}

fn said<T>(value: T) -> Said<T> {
    Said::by(0..6, value)
}

fn m(value: f64) -> Option<Said<Amount>> {
    Some(said(Amount::Exactly(value)))
}

/// Things of a label of the starter catalog.
fn thing(label: &str, count: u32, stands: Vec<Stand>) -> Thing {
    let known = known();
    let (name, catalog) = &known.catalogs[0];
    let all = (0..catalog.count() as u32).map(|number| catalog.asset(number).expect("an asset"));
    let models: Vec<_> = all.filter(|asset| asset.label == label).collect();
    assert!(!models.is_empty(), "{label}");
    let sizes = || models.iter().filter_map(|asset| asset.size_m);
    Thing {
        called: said(label.to_owned()),
        label: label.to_owned(),
        models: Models {
            catalog: name.clone(),
            uids: models.iter().map(|asset| asset.uid.clone()).collect(),
            label: Some(label.to_owned()),
            is_whole_label: true,
            size_m: [sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max)],
            material: models[0].material.clone(),
        },
        count: Some(said(Count::Exactly(count))),
        size_m: None,
        stands: stands.into_iter().map(said).collect(),
    }
}

fn text_of(wish: &Wish) -> Result<String, Refusal> {
    let prompt = Prompt::new("tires! and what else\nthere is: {of} the # prompt's", Options::default());
    compose(wish, &prompt, &known(), "built-in drafter")
}

/// The recipe of a wish, which can be run.
fn made(wish: &Wish) -> (String, Plan) {
    let text = text_of(wish).unwrap_or_else(|refusal| panic!("{refusal}"));
    keep(&text);
    let checked = checked(&text, root()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert!(text.lines().all(|line| line.chars().count() <= 200), "{text}");
    (text, checked.plan)
}

/// For looking at them: `ENSONIFY_DRAFTS=out/drafts cargo test …`.
fn keep(text: &str) {
    let Ok(folder) = std::env::var("ENSONIFY_DRAFTS") else { return };
    let name = std::thread::current().name().unwrap_or("draft").rsplit("::").next().unwrap_or("draft").to_owned();
    let file = (0..).map(|k| Path::new(&folder).join(format!("{name}-{k}.yaml"))).find(|file| !file.exists());
    std::fs::write(file.expect("a free name"), text).expect("written");
}

fn images(count: u64) -> Option<Said<u64>> {
    Some(said(count))
}

#[test]
fn two_tires_and_an_anchor() {
    let mut wish = Wish {
        images: images(300),
        things: vec![thing("tire", 2, vec![]), thing("anchor", 1, vec![])],
        ..Wish::default()
    };
    wish.seabed.sediments = Some(said(vec!["medium-sand".into(), "coarse-sand".into()]));
    wish.water.depth_m = m(12.0);
    wish.water.turbidity = Some(said(vec!["turbid".into()]));
    let (text, plan) = made(&wish);
    assert_eq!((plan.jobs.len(), plan.header.scenes, plan.header.frames), (300, 30, 10));
    for line in ["scenes: 30 ", "  depth_m: 12 ", "  turbidity: turbid ", "name: tires-and-anchor ", "    count: 2 "] {
        assert!(text.lines().any(|found| found.starts_with(line)), "{line}\n{text}");
    }
    let labels: Vec<&str> = plan.scenes[0].spec.bodies.iter().map(|body| body.label.as_str()).collect();
    assert_eq!(labels, ["tire", "tire", "anchor"]);
    assert!(plan.scenes.iter().any(|scene| scene.split == Split::Test));
}

#[test]
fn things_of_all_sizes() {
    for (label, count) in [("can", 3), ("bottle", 4), ("shipwreck", 1), ("torpedo", 2), ("rock", 9)] {
        let (_, plan) =
            made(&Wish { images: images(12), things: vec![thing(label, count, vec![])], ..Wish::default() });
        assert_eq!(plan.jobs.len(), 12);
    }
}

#[test]
fn all_stands() {
    let amount = Amount::Exactly;
    let sets: Vec<Vec<Thing>> = vec![
        vec![thing("tire", 1, vec![Stand::Buried(amount(0.5))]), thing("oil-drum", 1, vec![Stand::OnSide])],
        vec![thing("crate", 5, vec![Stand::Heap]), thing("bicycle", 1, vec![Stand::Settled])],
        vec![thing("lobster-pot", 5, vec![Stand::Row(Some(amount(3.0)))])],
        vec![thing("fish", 20, vec![Stand::School, Stand::Floating(Some(amount(2.0)))])],
        vec![thing("buoy", 2, vec![Stand::Moored(None)]), thing("moored-mine", 1, vec![Stand::Moored(None)])],
        vec![thing("buoy", 1, vec![Stand::BelowSurface(amount(4.0))])],
        vec![
            thing("rock", 1, vec![]),
            thing("ladder", 1, vec![Stand::Leaning(Some("rock".into()))]),
            thing("bottle", 1, vec![Stand::On("rock".into())]),
            thing("tire", 1, vec![Stand::Near { of: "rock".into(), side: None, distance_m: Some(amount(0.5)) }]),
        ],
        vec![thing("tire", 3, vec![Stand::Apart(amount(2.0))]), thing("anchor", 1, vec![Stand::Around(amount(2.0))])],
        vec![thing("anchor", 1, vec![Stand::At([0.0, 0.0], Some(1.0))])],
    ];
    for things in sets {
        let (_, plan) = made(&Wish { images: images(6), things, ..Wish::default() });
        assert_eq!(plan.jobs.len(), 6);
    }
}

#[test]
fn all_structures() {
    for (kind, things) in [
        ("pier", vec![thing("tire", 3, vec![])]),
        ("harbour", vec![thing("bicycle", 2, vec![Stand::Leaning(None)]), thing("tire", 2, vec![])]),
        ("dam", vec![thing("tree-trunk", 2, vec![Stand::Leaning(Some("dam".into()))])]),
        ("tank", vec![thing("bottle", 3, vec![])]),
        (
            "pipeline",
            vec![thing("anchor", 1, vec![Stand::Near { of: "pipeline".into(), side: None, distance_m: None }])],
        ),
        ("net-pen", vec![thing("fish", 12, vec![Stand::School])]),
        ("harbour", vec![]),
        ("pier", vec![]),
        ("dam", vec![]),
    ] {
        let wish = Wish { images: images(8), environment: Some(said(kind.into())), things, ..Wish::default() };
        made(&wish);
    }
}

#[test]
fn all_seabeds() {
    let shapes = [
        "flat",
        "fractal",
        "ripples",
        "slope",
        "sand-waves",
        "rock-field",
        "rubble",
        "reef",
        "trench",
        "pipeline-trench",
    ];
    for shape in shapes {
        let mut wish = Wish { images: images(4), things: vec![thing("tire", 1, vec![])], ..Wish::default() };
        wish.seabed.shape = Some(said(shape.into()));
        made(&wish);
    }
    let mut wish = Wish { images: images(4), things: vec![thing("tire", 1, vec![])], ..Wish::default() };
    wish.seabed.slope_deg = m(20.0);
    assert!(made(&wish).0.contains("angle_deg: 20"));
}

#[test]
fn a_lawnmower_over_20_m_by_20_m_in_steps_of_2_m() {
    let mut wish = Wish { things: vec![thing("oil-drum", 4, vec![])], ..Wish::default() };
    let lines = Route::Lawnmower { length_m: Some(20.0), width_m: Some(20.0), spacing_m: Some(2.0), lines: None };
    wish.path.route = Some(said(lines));
    wish.path.altitude_m = m(3.0);
    let (_, plan) = made(&wish);
    let Trajectory::Lawnmower(lines) = &plan.jobs[0].trajectory else { panic!("lines were asked for") };
    assert_eq!((lines.lines, lines.length_m, lines.spacing_m, lines.altitude_m), (11, 20.0, 2.0, 3.0));
}

#[test]
fn a_thing_3_m_ahead_is_3_m_ahead() {
    let front = Stand::FromVehicle { side: Side::Front, distance_m: Some(Amount::Exactly(3.0)) };
    let (_, plan) = made(&Wish { images: images(4), things: vec![thing("tire", 1, vec![front])], ..Wish::default() });
    let Trajectory::Hover(hover) = &plan.jobs[0].trajectory else { panic!("the vehicle keeps its place") };
    let [x, y, z] = hover.position_m;
    // The tire lies at the origin; its middle is a hand above the ground.
    let slant = (x * x + y * y + (z - 0.15) * (z - 0.15)).sqrt();
    assert!((slant - 3.0).abs() < 0.1 && y == 0.0 && x < 0.0, "{:?}", hover.position_m);
}

#[test]
fn ways() {
    let routes = [
        Route::Orbit { arc_deg: Some(90.0), sides: None },
        Route::Approach { from_m: Some(15.0), to_m: Some(2.0) },
        Route::Views,
        Route::Hover,
        Route::Dive { depth_m: 6.0, back: Some(None) },
        Route::Follow { what: None, length_m: Some(40.0) },
        Route::Lawnmower { length_m: None, width_m: None, spacing_m: None, lines: None },
    ];
    for route in routes {
        let mut wish = Wish { images: images(12), things: vec![thing("oil-drum", 1, vec![])], ..Wish::default() };
        wish.path.route = Some(said(route));
        wish.water.depth_m = m(10.0);
        assert_eq!(made(&wish).1.jobs.len(), 12);
    }
}

#[test]
fn from_three_sides_are_three_frames_a_scene() {
    let sides = Route::Orbit { arc_deg: None, sides: Some(3) };
    let mut wish = Wish { images: images(30), things: vec![thing("anchor", 1, vec![])], ..Wish::default() };
    wish.path.route = Some(said(sides));
    let (_, plan) = made(&wish);
    assert_eq!((plan.header.scenes, plan.header.frames), (10, 3));
    wish.images = images(100);
    let refusal = text_of(&wish).expect_err("100 are no threes");
    assert_eq!(refusal.problems[0].help, "write 99 or 102 images");
}

#[test]
fn equal_steps_are_an_approach() {
    let mut wish = Wish { things: vec![thing("tire", 1, vec![])], ..Wish::default() };
    wish.path.range_m = Some(said(Amount::Steps(15.0, 2.0, Some(14))));
    let (_, plan) = made(&wish);
    let Trajectory::Approach(approach) = &plan.jobs[0].trajectory else { panic!("an approach") };
    assert_eq!((approach.from_m, approach.to_m, plan.jobs.len(), plan.header.scenes), (15.0, 2.0, 14, 1));
}

#[test]
fn sonars_and_looks() {
    let mut wish = Wish { images: images(4), things: vec![thing("tire", 1, vec![])], ..Wish::default() };
    wish.sonar.devices = Some(said(vec!["aris-3000-hf".into()]));
    let look = |name: &str, change| said(Look { name: name.into(), changes: vec![change] });
    wish.looks = vec![
        look("no-noise", LookChange::Speckle(0.0)),
        look("medium", LookChange::Speckle(0.5)),
        look("strong", LookChange::Speckle(1.0)),
    ];
    let (_, plan) = made(&wish);
    assert_eq!((plan.jobs.len(), plan.jobs[0].looks.len()), (4, 3));
    wish.looks = vec![
        look("quiet", LookChange::Noise(0.0)),
        look("loud", LookChange::Noise(10.0)),
        look("murky", LookChange::Turbidity("very-turbid".into())),
    ];
    made(&wish);
    wish.sonar = Sonar {
        frequency_khz: m(500.0),
        beams: Some(said(256)),
        fov_deg: m(90.0),
        most_range_m: m(20.0),
        ..Sonar::default()
    };
    let (text, plan) = made(&wish);
    assert_eq!((plan.jobs[0].sonar.frequency_khz, plan.jobs[0].sonar.beams), (500.0, 256), "{text}");
    assert_eq!(plan.jobs[0].sonar.range_m[1], 20.0);
}

#[test]
fn what_cannot_be_is_refused_with_a_remedy() {
    let tire = || vec![thing("tire", 1, vec![])];
    let refused = |wish: &Wish| {
        let problem = text_of(wish).expect_err("it cannot be").problems.remove(0);
        assert!(!problem.help.is_empty());
        problem.what
    };
    let mut high = Wish { things: tire(), ..Wish::default() };
    high.path.altitude_m = m(15.0);
    high.water.depth_m = m(10.0);
    assert_eq!(refused(&high), "15 m above the bottom is out of the water, which is 10 m deep");
    let mut near = Wish { things: tire(), ..Wish::default() };
    near.path.altitude_m = m(5.0);
    near.path.range_m = m(3.0);
    assert!(refused(&near).starts_with("things cannot be 3 m from a sonar"));
    let ship =
        Wish { things: vec![thing("shipwreck", 1, vec![])], environment: Some(said("tank".into())), ..Wish::default() };
    assert!(refused(&ship).contains("do not fit into a tank"));
    let none = Wish { things: vec![thing("tire", 1, vec![Stand::On("rock".into())])], ..Wish::default() };
    assert_eq!(refused(&none), "tire: there is no other rock in the scene");
    let shallow = Wish {
        things: vec![thing("shipwreck", 1, vec![])],
        water: Water { depth_m: m(2.0), ..Water::default() },
        ..Wish::default()
    };
    assert!(refused(&shallow).contains("2 m deep"));
}

#[test]
fn a_prompt_never_becomes_a_value() {
    let evil = "x: 1\nscenes: 9999 # !!python \u{202e} {include: /etc/passwd}";
    let prompt = Prompt::new(evil, Options { name: Some("../../etc".into()), ..Options::default() });
    let mut wish = Wish { images: images(2), things: vec![thing("tire", 1, vec![])], ..Wish::default() };
    wish.name = Some(said("../../etc/x: y".to_owned()));
    wish.things[0].called = Said::by(0..evil.len(), evil.to_owned());
    wish.notes = vec![evil.to_owned()];
    wish.ignored = vec![Said::assumed(evil.to_owned(), evil)];
    wish.unknown = vec![Unknown { called: evil.into(), words: None, near: vec![evil.into()] }];
    let text = compose(&wish, &prompt, &known(), evil).expect("a recipe");
    let plan = checked(&text, root()).expect("a recipe").plan;
    assert_eq!((plan.header.scenes * plan.header.frames, plan.header.name.as_str()), (2, "etc-x-y"));
    let values = text.lines().map(|line| line.split('#').next().unwrap_or_default());
    assert!(values.clone().all(|value| !value.contains("9999") && !value.contains("passwd")), "{text}");
}
