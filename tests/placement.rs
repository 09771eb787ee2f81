//! Bodies find places: none passes through another, what rests touches the ground, what is buried is as deep as asked, and
//! what finds no place is told.

mod support;

use std::time::{Duration, Instant};

use ensonify::math::real::{asin, atan2, radians};
use ensonify::recipe::{DEFAULTS, Origin, Outside, parse};
use ensonify::run::{Given, Project, World};
use ensonify::scene::{Bvh, Instance, PoseSpec};
use ensonify::sonar::{Keep, Tracer};
use glam::DVec3;
use rayon::prelude::*;
use support::cli::{Desk, messages};

/// A recipe with these scenes and sections; one frame, looking down on the middle.
fn recipe(scenes: u32, sections: &str) -> String {
    format!(
        "ensonify: 1
name: placement
seed: 11
scenes: {scenes}
frames: 1
sonar: {{beams: 64, azimuth_deg: 90, elevation_deg: 30, elevations: 200, range_m: [0.5, 16], range_bins: 256, frequency_khz: 900, mount: {{pitch_deg: -20}}}}
trajectory: {{hover: {{position_m: [-5, -5, 3], yaw_deg: 45}}}}
{sections}
"
    )
}

fn project(desk: &Desk, scenes: u32, sections: &str) -> Project {
    let path = desk.file("placement.yaml", &recipe(scenes, sections));
    Project::load(&Given { path: &path, sets: &[], outside: Outside::Refused })
        .unwrap_or_else(|error| panic!("{sections}: {error}"))
}

fn worlds(project: &Project) -> Vec<World> {
    let build = |number| World::build(&project.plan, number, &project.assets).unwrap_or_else(|error| panic!("{error}"));
    (0..project.plan.scenes.len()).into_par_iter().map(build).collect()
}

/// Instances of labelled bodies with their labels.
fn bodies(world: &World) -> Vec<(&str, &Instance)> {
    let scene = world.scene();
    let labelled = scene.instances.iter().filter(|instance| instance.body > 0);
    labelled.map(|instance| (&*scene.bodies[usize::from(instance.body) - 1].label, instance)).collect()
}

fn triangles(instance: &Instance) -> Vec<[DVec3; 3]> {
    let place = |p: glam::Vec3| instance.world_from_mesh.transform_point3(p.as_dvec3());
    instance.mesh.triangles().map(|corners| corners.map(place)).collect()
}

/// Corners, middles of sides and middles of triangles.
fn points(instance: &Instance) -> Vec<DVec3> {
    let all = triangles(instance).into_iter();
    all.flat_map(|[a, b, c]| [a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0]).collect()
}

fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)))
}

fn longest(instance: &Instance) -> f64 {
    f64::from((instance.mesh.high - instance.mesh.low).max_element())
}

/// Where a ray meets a surface, from its start to `reach`.
fn crossings(surface: &Bvh, from: DVec3, direction: DVec3, reach: f64) -> Vec<f64> {
    let (mut met, mut start) = (Vec::new(), 0.0);
    while let Some(hit) = surface.closest(from + direction * start, direction, reach - start) {
        met.push(start + hit.distance);
        start += hit.distance.max(0.0) + 1e-6;
        if start >= reach || met.len() > 200 {
            break;
        }
    }
    met
}

/// How deep one body is in another, metres, by three measures, whichever is worst: a point of it that an odd number of
/// crossings in each of three directions says is inside, by its distance to the surface along the nearest of 26 rays; a side of a
/// triangle that crosses the surface, by the length between the crossings or from the crossing to its nearer end.
fn depth(inner: &Instance, outer: &Bvh, outer_box: (DVec3, DVec3)) -> f64 {
    let (low, high) = (outer_box.0, outer_box.1);
    let reach = (high - low).length() + 1.0;
    let within = |p: &DVec3| p.cmpge(low).all() && p.cmple(high).all();
    let askew = [DVec3::new(0.31, 0.22, 0.92), DVec3::new(-0.83, 0.41, 0.38), DVec3::new(0.12, -0.95, -0.28)];
    let rays: Vec<DVec3> = (0..27)
        .map(|k| DVec3::new(f64::from(k % 3 - 1), f64::from(k / 3 % 3 - 1), f64::from(k / 9 - 1)))
        .filter_map(DVec3::try_normalize)
        .collect();
    let mut deepest = 0.0f64;
    for point in points(inner).iter().filter(|p| within(p)) {
        let odd = askew.iter().filter(|d| crossings(outer, *point, d.normalize(), reach).len() % 2 == 1).count();
        if odd == askew.len() {
            let nearest = rays.iter().filter_map(|ray| outer.closest(*point, *ray, reach)).map(|hit| hit.distance);
            deepest = deepest.max(nearest.fold(reach, f64::min));
        }
    }
    for [a, b, c] in triangles(inner) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let length = (to - from).length();
            let met = crossings(outer, from, (to - from) / length.max(1e-12), length);
            deepest = match met[..] {
                [] => deepest,
                [only] => deepest.max(only.min(length - only)),
                [first, .., last] => deepest.max(last - first),
            };
        }
    }
    deepest
}

/// The worst that two bodies of a scene are in each other, as a share of the smaller one's longest side.
fn worst_overlap(world: &World) -> f64 {
    let mut all = bodies(world);
    // Parts of a pier are built into each other.
    let is_model = |body: &Instance| world.scene().bodies[usize::from(body.body) - 1].asset.starts_with("starter/");
    all.retain(|(_, body)| is_model(body));
    let boxes: Vec<(DVec3, DVec3)> = all.iter().map(|(_, instance)| bounds(&points(instance))).collect();
    let surfaces: Vec<Bvh> = all.iter().map(|(_, body)| Bvh::of([(&*body.mesh, body.world_from_mesh)])).collect();
    let mut worst = 0.0f64;
    for (a, b) in (0..all.len()).flat_map(|a| (0..all.len()).map(move |b| (a, b))).filter(|(a, b)| a != b) {
        let meet = boxes[a].0.cmple(boxes[b].1).all() && boxes[b].0.cmple(boxes[a].1).all();
        if meet {
            let smaller = longest(all[a].1).min(longest(all[b].1));
            let share = depth(all[a].1, &surfaces[b], boxes[b]) / smaller;
            if share > 0.01 {
                println!("{} in {}: {share}", all[a].0, all[b].0);
            }
            worst = worst.max(share);
        }
    }
    worst
}

/// Least height of a body's surface above the ground, looked at every three centimetres: a face may lie on a crest.
fn lowest(world: &World, instance: &Instance) -> f64 {
    let ground = &world.built().ground;
    let above = |[a, b, c]: [DVec3; 3]| {
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        let steps = (longest / 0.03).ceil().clamp(1.0, 100.0) as u32;
        let share = |k: u32| f64::from(k) / f64::from(steps);
        let grid = (0..=steps).flat_map(move |i| (0..=steps - i).map(move |j| (i, j)));
        let points = grid.map(move |(i, j)| a + (b - a) * share(i) + (c - a) * share(j));
        points.map(|p| p.z - ground.height(p.x, p.y)).fold(f64::MAX, f64::min)
    };
    triangles(instance).into_iter().map(above).fold(f64::MAX, f64::min)
}

const SEABEDS: &str = "seabed: {extent_m: 14, cell_m: 0.12, sediment: silt, shape: {choice: [flat, {slope: {angle_deg: 6}}, \
    {ripples: {wavelength_m: 0.6, height_m: 0.06}}, {fractal: {rms_m: 0.08}}]}}";

#[test]
fn settled_bodies_keep_out_of_each_other_and_touch_the_bottom() {
    let desk = Desk::new();
    let (mut worst, mut gap, mut placed, mut spent) = (0.0f64, 0.0f64, 0, Duration::ZERO);
    // In most scenes bodies keep 5 cm clear; in the others they may lie on each other, heaped into a small place.
    for (scenes, clear, within) in [(420, "0.05", 1.8), (80, "0", 0.6)] {
        let items = format!(
            "objects: [{{pick: {{catalog: starter}}, count: 3, clear_m: {clear}, pose: {{settle: {{within_m: {within}}}}}}}]"
        );
        let project = project(&desk, scenes, &format!("{SEABEDS}\n{items}"));
        let start = Instant::now();
        let worlds = worlds(&project);
        spent += start.elapsed();
        assert!(worlds.iter().all(|world| bodies(world).len() + world.built().dropped.len() == 3));
        placed += worlds.iter().map(|world| bodies(world).len()).sum::<usize>();
        worst = worlds.par_iter().map(worst_overlap).collect::<Vec<_>>().into_iter().fold(worst, f64::max);
        for (world, (label, body)) in worlds.iter().flat_map(|world| bodies(world).into_iter().map(move |b| (world, b)))
        {
            let low = lowest(world, body);
            assert!(low > -0.01 * longest(body) - 0.002, "{label}: {low} m below the ground");
            // Those of a heap may lie on others instead.
            if clear != "0" {
                assert!(low < 0.01 * longest(body) + 0.002, "{label}: {low} m above the ground");
                gap = gap.max(low.abs());
            }
        }
    }
    println!("{placed} of 1500 placed in 500 scenes in {spent:?}; worst overlap {worst:.5}, worst gap {gap:.5} m");
    assert!(worst < 0.01, "two bodies pass through each other by {worst} of the smaller one's size");
    assert!(placed >= 1380, "{placed} of 1500");
}

/// Share of a body's height that lies below the plane that fits the ground under it best, along the plane's normal.
fn buried(world: &World, instance: &Instance) -> f64 {
    const N: i32 = 14;
    let points = points(instance);
    let (low, high) = bounds(&points);
    let share = |k: i32| (f64::from(k) + 0.5) / f64::from(N);
    let cells = (0..N).flat_map(|i| (0..N).map(move |j| (i, j)));
    let ground: Vec<DVec3> = cells
        .map(|(i, j)| {
            let (x, y) = (low.x + (high.x - low.x) * share(i), low.y + (high.y - low.y) * share(j));
            DVec3::new(x, y, world.built().ground.height(x, y))
        })
        .collect();
    let mean = ground.iter().sum::<DVec3>() / ground.len() as f64;
    let slope = |axis: usize| {
        let (mut above, mut below) = (0.0, 0.0);
        for p in &ground {
            above += (p[axis] - mean[axis]) * p.z;
            below += (p[axis] - mean[axis]).powi(2);
        }
        above / below
    };
    let normal = DVec3::new(-slope(0), -slope(1), 1.0).normalize();
    let heights = points.iter().map(|p| normal.dot(*p - mean));
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), d| (low.min(d), high.max(d)));
    -low / (high - low)
}

#[test]
fn buried_bodies_are_as_deep_as_asked() {
    let desk = Desk::new();
    let mut worst = 0.0f64;
    for shape in
        ["{flat: {}}", "{slope: {angle_deg: 12, rms_m: 0}}", "{ripples: {wavelength_m: 0.4, height_m: 0.04, rms_m: 0}}"]
    {
        for pose in ["rest", "settle"] {
            let item = |uid: &str, burial: f64| {
                format!(
                    "  - {{pick: {{catalog: starter, uid: {uid}}}, count: 2, pose: {{{pose}: {{burial: {burial}, within_m: 4}}}}}}\n"
                )
            };
            let models = [("oil-drum", 0.15), ("crate", 0.3), ("bottom-mine", 0.5), ("rock-3", 0.8)];
            let objects: String = models.iter().map(|(uid, burial)| item(uid, *burial)).collect();
            let seabed = format!("seabed: {{extent_m: 16, cell_m: 0.1, shape: {shape}}}");
            let project = project(&desk, 3, &format!("{seabed}\nobjects:\n{objects}"));
            for world in worlds(&project) {
                for (_, instance) in bodies(&world) {
                    let asset = &world.scene().bodies[usize::from(instance.body) - 1].asset;
                    let asked = models.iter().find(|(uid, _)| asset.ends_with(uid)).expect("one of them").1;
                    let is = buried(&world, instance);
                    worst = worst.max((is - asked).abs());
                    assert!((is - asked).abs() < 0.05, "{asset}, {pose} on {shape}: {is:.3} instead of {asked}");
                }
            }
        }
    }
    println!("buried shares are {worst:.4} off at worst");
}

/// Names of the kinds of pose, as the defaults list them.
fn kinds() -> Vec<String> {
    let tree = parse("defaults", DEFAULTS, Origin::BuiltIn).expect("YAML");
    let kinds = tree.get("kinds").and_then(|kinds| kinds.get("objects[].pose")).expect("kinds of poses");
    kinds.entries().iter().map(|(key, _)| key.text.clone()).collect()
}

/// The item of a recipe that shows a kind. Before it come a boulder at a given pose and, in the scene, a pier.
fn item(kind: &str) -> String {
    let (uid, count, pose) = match kind {
        "at" => ("crate", 1, "{position_m: [2, -1, 0.5], yaw_deg: 30}"),
        "near" => ("crate", 2, "{of: rock, distance_m: 0.3}"),
        "on" => ("scuba-tank", 1, "{of: rock}"),
        "leaning" => ("ladder", 1, "{against: rock, lean_deg: 20}"),
        "attach" => ("bucket", 6, "{to: pile, height_m: {uniform: [0.5, 2]}}"),
        "float" => ("bottom-mine", 2, "{altitude_m: 1.5, within_m: 3}"),
        "line" => ("lobster-pot", 3, "{spacing_m: 2.2, within_m: 5}"),
        "cluster" => ("tire", 3, "{radius_m: 1.5, within_m: 2}"),
        _ => ("oil-drum", 3, "{within_m: 3}"),
    };
    format!("{{label: shown, pick: {{catalog: starter, uid: {uid}}}, count: {count}, pose: {{{kind}: {pose}}}}}")
}

/// Distance from a body to the nearest other with a label, along rays from its points: not less than it is.
fn gap(world: &World, body: &Instance, label: &str) -> f64 {
    let all = bodies(world);
    let others =
        all.iter().filter(|(other, _)| *other == label).map(|(_, other)| (&*other.mesh, other.world_from_mesh));
    let surface = Bvh::of(others);
    let rays: Vec<DVec3> = (0..27)
        .map(|k| DVec3::new(f64::from(k % 3 - 1), f64::from(k / 3 % 3 - 1), f64::from(k / 9 - 1)))
        .filter_map(DVec3::try_normalize)
        .collect();
    let hits = points(body)
        .into_iter()
        .flat_map(|p| rays.iter().filter_map(|ray| surface.closest(p, *ray, 30.0)).collect::<Vec<_>>());
    hits.map(|hit| hit.distance).fold(30.0, f64::min)
}

/// What must be true of a body in its pose.
fn holds(pose: &PoseSpec, world: &World, body: &Instance) {
    let (low, size) = (lowest(world, body), longest(body));
    let on_ground = low.abs() < 0.01 * size + 0.002;
    let ropes = world.scene().instances.iter().filter(|instance| instance.mesh.materials == ["rope"]).count();
    match pose {
        PoseSpec::Rest(_) | PoseSpec::Settle(_) | PoseSpec::Cluster(_) => assert!(on_ground, "{low} m"),
        PoseSpec::Line(_) => assert!(on_ground && ropes == 2, "{low} m, {ropes} ropes"),
        PoseSpec::Float(_) => assert!((low - 1.5).abs() < 0.1 && ropes == 2, "{low} m, {ropes} ropes"),
        PoseSpec::At(at) => assert_eq!(body.world_from_mesh.translation.to_array(), at.position_m),
        PoseSpec::Near(near) => {
            let gap = gap(world, body, "rock");
            assert!(on_ground && gap > near.distance_m - 1e-4 && gap < near.distance_m + 0.15, "{low} m, {gap} m");
        }
        PoseSpec::On(_) => {
            let gap = gap(world, body, "rock");
            assert!(low > 0.1 && gap < 0.05 * size, "{low} m above the ground, {gap} m off the rock");
        }
        PoseSpec::Leaning(_) => {
            let gap = gap(world, body, "rock");
            assert!(on_ground && gap < 0.05 * size, "{low} m above the ground, {gap} m off the rock");
        }
        PoseSpec::Attach(_) => {
            let gap = gap(world, body, "pile");
            assert!(low > 0.1 && gap < 0.1 * size, "{low} m above the ground, {gap} m off the pile");
        }
    }
}

#[test]
fn every_kind_of_pose_is_rendered_once() {
    let desk = Desk::new();
    let kinds = kinds();
    assert_eq!(kinds.len(), 10);
    for kind in kinds {
        let rock = "{pick: {catalog: starter, uid: rock-3}, pose: {at: {position_m: [0, 0, -0.05]}}}";
        let project = project(
            &desk,
            1,
            &format!(
                "seabed: {{extent_m: 30, shape: flat}}\nenvironment: {{kind: {{pier: {{length_m: 12, quay_m: 0}}}}, \
                 labels: by-part}}\nobjects: [{rock}, {}]",
                item(&kind)
            ),
        );
        let world = World::build(&project.plan, 0, &project.assets).expect("a scene");
        assert!(world.built().dropped.is_empty(), "{kind}: {:?}", world.built().dropped);
        let spec = &project.plan.scenes[0].spec.bodies;
        let shown: Vec<_> = bodies(&world).into_iter().filter(|(label, _)| *label == "shown").collect();
        assert_eq!(shown.len(), spec.len() - 1, "{kind}");
        for (body, (_, instance)) in spec[1..].iter().zip(&shown) {
            assert_eq!(body.pose.kind(), kind);
            holds(&body.pose, &world, instance);
        }
        assert!(worst_overlap(&world) < 0.01, "{kind}");
        let job = &project.plan.jobs[0];
        let pose = world.sonar_pose(&project.plan.header, job).expect("a pose");
        let echoes = Tracer::new(&job.sonar).trace(world.scene(), &pose, Keep::ENERGY);
        assert!(
            echoes.bodies.iter().any(|echo| shown.iter().any(|(_, body)| body.body == echo.body)),
            "{kind} is not seen"
        );
    }
}

/// Transforms of labelled bodies by label, to the last bit.
fn places(worlds: &[World], label: &str) -> Vec<[u64; 12]> {
    let all = worlds.iter().flat_map(|world| bodies(world).into_iter().filter(|(name, _)| *name == label));
    all.map(|(_, instance)| instance.world_from_mesh.to_cols_array().map(f64::to_bits)).collect()
}

const MIXED: &str = "  - {label: a, pick: {catalog: starter, uid: oil-drum}, count: 2, pose: {settle: {within_m: 12}}}
  - {label: b, pick: {catalog: starter, uid: rock-1}, count: 4, pose: {rest: {within_m: 12}}}
  - {label: c, pick: {catalog: starter, uid: bottle}, count: 3, pose: {float: {school: {}}}}
  - {label: d, pick: {catalog: starter, uid: lobster-pot}, count: 3, pose: line}
";

#[test]
fn the_same_recipe_places_the_same_bits_on_any_number_of_threads() {
    let desk = Desk::new();
    let seabed = SEABEDS.replace("extent_m: 14", "extent_m: 26");
    let project = project(&desk, 6, &format!("{seabed}\nobjects:\n{MIXED}"));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let worlds = pool.install(|| worlds(&project));
        ["a", "b", "c", "d"].map(|label| places(&worlds, label))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn another_object_moves_no_other() {
    let desk = Desk::new();
    let seabed = "seabed: {extent_m: 30, shape: flat}";
    let of = |objects: &str| worlds(&project(&desk, 3, &format!("{seabed}\nobjects:\n{objects}")));
    let plain = of(MIXED);
    let more = of(&format!("{MIXED}  - {{pick: {{catalog: starter, uid: tire}}, pose: settle}}\n"));
    let larger = of(&MIXED.replace("uid: oil-drum}, count: 2", "uid: oil-drum}, count: 3"));
    for label in ["a", "b", "c", "d"] {
        assert_eq!(places(&plain, label), places(&more, label), "{label}: an item after it");
    }
    // Draws of later items are their own; only what a third drum would stand on had to give way.
    for label in ["b", "c", "d"] {
        let (before, after) = (places(&plain, label), places(&larger, label));
        let same = before.iter().filter(|place| after.contains(place)).count();
        assert!(same * 10 >= before.len() * 8, "{label}: {same} of {} are where they were", before.len());
    }
}

fn crowd(on_failure: &str) -> String {
    format!(
        "seabed: {{extent_m: 12, shape: flat}}\nobjects: [{{pick: {{catalog: starter, uid: crate}}, count: 9, tries: 40, \
         on_failure: {on_failure}, pose: {{rest: {{within_m: 0.7}}}}}}]"
    )
}

#[test]
fn what_finds_no_place_is_told() {
    let desk = Desk::new();
    let project = project(&desk, 1, &crowd("drop"));
    let world = World::build(&project.plan, 0, &project.assets).expect("a scene");
    let dropped = &world.built().dropped;
    assert!(dropped.len() >= 3 && dropped.len() + world.scene().bodies.len() == 9, "{}", dropped.len());
    assert!(
        dropped[0].reason.contains("40 tries") && dropped[0].reason.contains("other bodies"),
        "{}",
        dropped[0].reason
    );
    desk.file("drop.yaml", &recipe(1, &crowd("drop")));
    let run = desk.run(&["run", "drop.yaml", "-o", "made"]);
    assert_eq!(run.status.code(), Some(0), "{}", messages(&run));
    assert_eq!(messages(&run).matches("is left out").count(), dropped.len());
    let (left, placed) = (dropped.len(), world.scene().bodies.len());
    let read = |name: &str| std::fs::read_to_string(desk.path().join("made").join(name)).expect(name);
    let card = read("README.md");
    assert!(card.contains(&format!("Placed {placed} of 9 objects: {left} left out")), "{card}");
    assert!(read("manifest.json").contains(&format!("\"placed\": {placed}")));
}

#[test]
fn a_place_can_be_sought_again_or_asked_for_in_any_case() {
    let desk = Desk::new();
    let again = project(&desk, 1, &crowd("resample"));
    let world = World::build(&again.plan, 0, &again.assets).expect("a scene");
    let reason = world.built().dropped.first().map(|object| object.reason.clone()).unwrap_or_default();
    assert!(reason.contains("6 rounds"), "{reason}");
    let must = project(&desk, 1, &crowd("fail"));
    let error = World::build(&must.plan, 0, &must.assets).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("starter/crate cannot be placed") && error.contains("40 tries"), "{error}");
    desk.file("fail.yaml", &recipe(1, &crowd("fail")));
    for (verb, code) in [("check", 2), ("run", 3)] {
        let output = desk.run(&[verb, "fail.yaml"]);
        assert_eq!(output.status.code(), Some(code), "{verb}: {}", messages(&output));
        assert!(messages(&output).contains("cannot be placed"), "{verb}: {}", messages(&output));
    }
}

#[test]
fn given_poses_that_overlap_are_kept_and_told() {
    let desk = Desk::new();
    let at = |x: f64| format!("{{pick: {{catalog: starter, uid: crate}}, pose: {{at: {{position_m: [{x}, 0, 0]}}}}}}");
    let project = project(
        &desk,
        1,
        &format!("seabed: {{extent_m: 12, shape: flat}}\nobjects: [{}, {}, {}]", at(0.0), at(0.3), at(3.0)),
    );
    let world = World::build(&project.plan, 0, &project.assets).expect("a scene");
    assert_eq!(world.scene().bodies.len(), 3);
    let overlaps: Vec<_> = world.built().overlaps.iter().map(|overlap| (overlap.body, &*overlap.with)).collect();
    assert_eq!(overlaps, [(1, "starter/crate")]);
    assert_eq!(world.built().notes().next().as_deref(), Some("starter/crate passes through starter/crate"));
}

#[test]
fn what_must_be_in_view_is_seen_from_its_frames() {
    let desk = Desk::new();
    let item = |more: &str| {
        format!(
            "frames: 3\nseabed: {{extent_m: 30, shape: flat}}\nobjects: [{{pick: {{catalog: starter, uid: crate}}, count: 4, \
             pose: {{rest: {{within_m: 8}}}}, in_view: {{frames: {more}}}}}]"
        )
    };
    let looking = recipe(2, "")
        .replace("hover: {position_m: [-5, -5, 3], yaw_deg: 45}", "orbit: {radius_m: 7, altitude_m: 2, arc_deg: 60}");
    for (frames, wanted) in [("all", vec![0, 1, 2]), ("[1]", vec![1])] {
        let text = looking.replace("frames: 1\n", "") + &item(frames);
        let path = desk.file("view.yaml", &text);
        let given = Given { path: &path, sets: &[], outside: Outside::Refused };
        let project = Project::load(&given).unwrap_or_else(|error| panic!("{error}"));
        for (number, world) in worlds(&project).iter().enumerate() {
            assert!(world.scene().bodies.len() >= 3, "{:?}", world.built().dropped);
            for (job, body) in wanted.iter().flat_map(|&frame| {
                let job = &project.plan.jobs_of(number)[frame];
                world.scene().bodies.iter().map(move |body| (job, body))
            }) {
                let p = world.sonar_pose(&project.plan.header, job).expect("a pose").inverse().apply(body.centre);
                let (range, bearing) = (p.length(), atan2(p.y, p.x).abs());
                assert!((0.5..=16.0).contains(&range) && bearing <= radians(45.0), "{range} m, {bearing} rad");
                assert!(asin(p.z / range).abs() <= radians(15.0), "{p}");
            }
        }
    }
    // The sonar hangs over the middle: nothing on the bottom behind it can be in view.
    let blind = recipe(
        1,
        "seabed: {extent_m: 30, shape: flat}\nobjects: [{pick: {catalog: starter, uid: crate}, tries: 20, \
        pose: {at: {position_m: [-9, 0, 0]}}, in_view: {frames: all}}]",
    );
    let path = desk.file("blind.yaml", &blind);
    let project = Project::load(&Given { path: &path, sets: &[], outside: Outside::Refused }).expect("a recipe");
    let world = World::build(&project.plan, 0, &project.assets).expect("a scene");
    assert!(world.built().dropped[0].reason.contains("not in view"), "{}", world.built().dropped[0].reason);
}

#[test]
fn relations_that_cannot_be_are_refused_at_their_place() {
    let refused = |objects: &str, words: &[&str]| {
        let desk = Desk::new();
        desk.file("a.yaml", &recipe(1, &format!("seabed: {{shape: flat}}\nobjects:\n{objects}")));
        let output = desk.run(&["check", "a.yaml"]);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.starts_with("error: a.yaml:"), "{message}");
        words.iter().for_each(|word| assert!(message.contains(word), "`{word}` is not in: {message}"));
    };
    let crate_ = "pick: {catalog: starter, uid: crate}";
    let tire = "pick: {catalog: starter, uid: tire}";
    refused(
        &format!("  - {{{tire}}}\n  - {{{crate_}, pose: {{near: {{of: tyre}}}}}}"),
        &["no object has the label `tyre`", "did you mean `tire`"],
    );
    refused(&format!("  - {{{crate_}, pose: {{on: {{}}}}}}"), &["of"]);
    refused(
        &format!("  - {{{tire}, pose: {{near: {{of: crate}}}}}}\n  - {{{crate_}, pose: {{on: {{of: tire}}}}}}"),
        &["of: ", "circle"],
    );
    refused(&format!("  - {{{crate_}, on_failure: panic}}"), &["panic", "resample"]);
    refused(&format!("  - {{{crate_}, pose: attach}}"), &["environment"]);
    refused(&format!("  - {{{crate_}, clear_m: -1}}"), &["clear_m is -1"]);
    refused(&format!("  - {{{crate_}, pose: {{settle: {{drop_m: -1}}}}}}"), &["drop_m is -1"]);
    refused(&format!("  - {{{crate_}, pose: {{leaning: {{against: crate, lean_deg: 90}}}}}}"), &["lean_deg is 90"]);
    refused(&format!("  - {{{crate_}, in_view: {{frames: [3]}}}}"), &["no frame 3"]);
}
