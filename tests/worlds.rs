//! Every kind of seabed and environment by its defaults: a ping in it finds echoes, and a large seabed fits into memory.

mod support;

use ensonify::recipe::Outside;
use ensonify::recipe::{DEFAULTS, Origin, parse};
use ensonify::run::{Given, Project, World};
use ensonify::scene::Mesh;
use ensonify::sonar::{Echoes, Keep, Tracer};
use support::cli::{Desk, messages};

const FLAT: &str = "{shape: flat}";

/// Kinds of a place of the recipe, as the defaults list them.
fn kinds(place: &str) -> Vec<String> {
    let tree = parse("defaults", DEFAULTS, Origin::BuiltIn).expect("YAML");
    let kinds = tree.get("kinds").and_then(|kinds| kinds.get(place)).expect("a place of kinds");
    kinds.entries().iter().map(|(key, _)| key.text.clone()).collect()
}

/// A recipe of one frame, looking along x from 6 m before the world's origin.
fn recipe(sections: &str) -> String {
    format!(
        "ensonify: 1
name: world
seed: 4
sonar: {{beams: 64, azimuth_deg: 90, elevation_deg: 30, elevations: 200, range_m: [0.5, 22], range_bins: 256, frequency_khz: 900, mount: {{pitch_deg: -4}}}}
trajectory: {{hover: {{position_m: [-6, 0.3, 2.2]}}}}
frames: 1
{sections}
"
    )
}

fn world(desk: &Desk, sections: &str) -> (Project, World) {
    let path = desk.file("world.yaml", &recipe(sections));
    let project = Project::load(&Given { path: &path, sets: &[], outside: Outside::Refused })
        .unwrap_or_else(|error| panic!("{sections}: {error}"));
    let world =
        World::build(&project.plan.scenes[0], &project.assets).unwrap_or_else(|error| panic!("{sections}: {error}"));
    (project, world)
}

fn ping(project: &Project, world: &World) -> Echoes {
    let job = &project.plan.jobs[0];
    Tracer::new(&job.sonar).trace(
        world.scene(),
        &world.sonar_pose(&project.plan.header, job).expect("no file of poses"),
        Keep::ENERGY,
    )
}

/// Part of the cells that echo.
fn filled(echoes: &Echoes) -> f64 {
    let filled = echoes.energy.iter().filter(|&&energy| energy > 0.0).count();
    filled as f64 / echoes.energy.len() as f64
}

#[test]
fn a_ping_over_every_kind_of_seabed_finds_it() {
    let desk = Desk::new();
    desk.file("map.csv", "0,0.3,0\n0.2,0,0.4\n0,0.5,0\n");
    let kinds = kinds("seabed.shape");
    assert_eq!(kinds.len(), 11);
    for kind in kinds {
        let shape = if kind == "height-map" { "{height-map: {file: map.csv}}".to_owned() } else { kind.clone() };
        let patches = "[{sediment: mud, where: troughs, size_m: 2}, {sediment: gravel, share: 0.1}]";
        let seabed = format!("seabed: {{shape: {shape}, sediment: silt, extent_m: 40, patches: {patches}}}");
        let (project, world) = world(&desk, &seabed);
        let echoes = ping(&project, &world);
        assert!(filled(&echoes) > 0.15, "{kind}: {} of the cells", filled(&echoes));
        assert!(echoes.energy.iter().all(|energy| energy.is_finite()), "{kind}");
        let names: Vec<&str> = world.scene().materials.iter().map(|material| material.name.as_str()).collect();
        assert!(["silt", "mud", "gravel"].iter().all(|name| names.contains(name)), "{kind}: {names:?}");
        let stony = ["rock-field", "rubble", "reef"].contains(&kind.as_str());
        assert_eq!(names.len(), 3 + usize::from(stony), "{kind}: {names:?}");
        let locked = project.plan.assets.contains_key("seabed/map.csv");
        assert_eq!(locked, kind == "height-map", "{kind}");
    }
}

#[test]
fn a_ping_in_every_kind_of_environment_finds_its_parts() {
    let desk = Desk::new();
    let kinds = kinds("environment.kind");
    assert_eq!(kinds.len(), 6);
    for kind in kinds {
        let seabed = if kind == "tank" { String::new() } else { format!("seabed: {FLAT}\n") };
        let sections = |labels: &str| format!("{seabed}environment: {{kind: {kind}, labels: {labels}}}");
        let (project, labelled) = world(&desk, &sections("by-part"));
        let echoes = ping(&project, &labelled);
        assert!(filled(&echoes) > 0.1, "{kind}: {} of the cells", filled(&echoes));
        assert!(!echoes.bodies.is_empty(), "{kind}: no part of it is seen");
        let spec = project.plan.scenes[0].spec.environment.as_ref().expect("an environment");
        let parts = spec.part_labels(&project.assets);
        let bodies = &labelled.scene().bodies;
        assert!(bodies.iter().all(|body| parts.contains(&body.label)), "{kind}: every label is a category");
        let (project, plain) = world(&desk, &sections("none"));
        assert!(plain.scene().bodies.is_empty(), "{kind}");
        assert_eq!(ping(&project, &plain).energy, echoes.energy, "{kind}: labels change no echo");
    }
}

#[test]
fn objects_rest_clear_of_a_pier() {
    let desk = Desk::new();
    let objects = "objects: [{pick: {catalog: starter, label: tire}, count: 12, pose: {rest: {within_m: 8}}}]";
    let (_, world) = world(&desk, &format!("seabed: {FLAT}\nenvironment: {{kind: pier}}\n{objects}"));
    let bodies = &world.scene().bodies;
    let of = |label: &str| bodies.iter().filter(|body| body.label == label).collect::<Vec<_>>();
    let (piles, tires) = (of("pile"), of("tire"));
    assert!(piles.len() == 21 && tires.len() > 8, "{} piles, {} tires", piles.len(), tires.len());
    for tire in tires {
        assert!(tire.centre.z < 1.0, "a tire on the bottom, not on the deck");
        for pile in &piles {
            let apart = (tire.centre - pile.centre).truncate().length();
            assert!(apart > 0.35, "a tire {apart} m from a pile's axis");
        }
    }
}

#[test]
fn piles_reach_into_the_ground_wherever_it_lies() {
    let desk = Desk::new();
    let seabed = "seabed: {shape: {slope: {angle_deg: 25, direction_deg: 70}}, cell_m: 0.2}";
    let (_, world) = world(&desk, &format!("{seabed}\nenvironment: {{kind: {{pier: {{broken: 0.4}}}}}}"));
    let scene = world.scene();
    for instance in scene.instances.iter().filter(|instance| instance.body > 0) {
        if scene.bodies[usize::from(instance.body) - 1].label == "pile" {
            let ends =
                instance.mesh.vertices().map(|v| f64::from(v.z) - world.built().ground.height(v.x.into(), v.y.into()));
            let (low, high) = ends.fold((f64::MAX, f64::MIN), |(low, high), end| (low.min(end), high.max(end)));
            assert!(low < -0.9 && high > 0.1, "a pile from {low} to {high} m above the ground");
        }
    }
}

/// Bytes that a mesh holds.
fn bytes(mesh: &Mesh) -> usize {
    mesh.clusters.iter().map(|cluster| 12 * cluster.x.len() + 6 * cluster.triangles.len() + 200).sum()
}

#[test]
fn a_survey_of_200_m_fits() {
    let desk = Desk::new();
    let seabed = |more: &str| format!("seabed: {{extent_m: 200, shape: {{trench: {{rms_m: 0}}}}{more}}}");
    let (project, even) = world(&desk, &seabed(""));
    let mesh = &even.scene().instances[0].mesh;
    assert_eq!(mesh.triangle_count, 2 * 2500 * 2500);
    assert!(bytes(mesh) < 220_000_000, "{} bytes", bytes(mesh));
    let (_, graded) = world(&desk, &seabed(", fine_m: 40"));
    let coarse = &graded.scene().instances[0].mesh;
    assert!(coarse.triangle_count * 8 < mesh.triangle_count, "{} triangles", coarse.triangle_count);
    // Within the fine square nothing has changed.
    assert_eq!(ping(&project, &even).energy, ping(&project, &graded).energy);
}

#[test]
fn what_cannot_be_built_is_refused_at_its_place() {
    let refused = |sections: &str, line: u32, words: &[&str]| {
        let desk = Desk::new();
        desk.file("colour.csv", "a,b\n1,2\n");
        desk.file("a.yaml", &recipe(sections));
        let output = desk.run(&["check", "a.yaml"]);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.starts_with(&format!("error: a.yaml:{line}:")), "{message}");
        words.iter().for_each(|word| assert!(message.contains(word), "`{word}` is not in: {message}"));
    };
    refused("seabed: {shape: {height-map: {file: no.png}}}", 7, &["no.png", "cannot be read"]);
    refused("seabed: {shape: {height-map: {file: colour.csv}}}", 7, &["colour.csv", "`a` in line 1, column 1"]);
    refused("seabed: {shape: height-map}", 7, &["file"]);
    refused("seabed: {shape: sand-wave}", 7, &["did you mean `sand-waves`"]);
    refused("seabed: {shape: {rubble: {size_m: [0.5, 0.2]}}}", 7, &["size_m", "0.2"]);
    refused("seabed: {shape: {reef: {sediment: rok}}}", 7, &["rok", "did you mean `rock`"]);
    refused("seabed: {patches: [{sediment: mood}]}", 7, &["mood", "did you mean `mud`"]);
    refused("seabed: {patches: [{sediment: mud, share: 2}]}", 7, &["share", "0 to 1"]);
    refused("seabed: {patches: [{sediment: mud, where: holes}]}", 7, &["holes", "troughs"]);
    refused("seabed: {patches: [{sediment: mud, size_m: 0.01}]}", 7, &["size_m", "cell_m"]);
    refused("seabed: {shape: {rock-field: {per_100_m2: 1e6}}}", 7, &["per_100_m2", "cover the ground twice"]);
    refused("environment: {kind: pier}", 7, &["seabed"]);
    refused("environment: {kind: tank, glb: a.glb}", 7, &["glb", "kind"]);
    refused("environment: {labels: none}", 7, &["glb", "kind"]);
    refused("environment: {kind: {tank: {depth_m: -1}}}", 7, &["depth_m is -1"]);
    refused("environment: {kind: {tank: {material: steal}}}", 7, &["steal", "did you mean `steel`"]);
    refused("environment: {kind: harbor}\nseabed: {shape: flat}", 7, &["did you mean `harbour`"]);
}
