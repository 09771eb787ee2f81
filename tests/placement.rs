//! Bodies find places: none passes through another, what rests touches the ground, what is buried is as deep as asked, and
//! what finds no place is told.

mod support;

use std::time::{Duration, Instant};

use ensonify::recipe::Outside;
use ensonify::run::{Given, Project, World};
use ensonify::scene::{Bvh, Instance};
use glam::DVec3;
use rayon::prelude::*;
use support::cli::Desk;

/// A recipe with these scenes and sections; one frame, looking down on the middle.
fn recipe(scenes: u32, sections: &str) -> String {
    format!(
        "ensonify: 1
name: placement
seed: 11
scenes: {scenes}
frames: 1
sonar: {{beams: 64, azimuth_deg: 90, elevation_deg: 30, elevations: 200, range_m: [0.5, 16], range_bins: 256, frequency_khz: 900, mount: {{pitch_deg: -20}}}}
trajectory: {{hover: {{position_m: [-7, 0, 3]}}}}
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
/// crossings in most of three directions says is inside, by its distance to the surface along the nearest of 26 rays; a side of a
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
        if odd >= 2 {
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
    let all = bodies(world);
    let boxes: Vec<(DVec3, DVec3)> = all.iter().map(|(_, instance)| bounds(&points(instance))).collect();
    let surfaces: Vec<Bvh> = all.iter().map(|(_, body)| Bvh::of([(&*body.mesh, body.world_from_mesh)])).collect();
    let mut worst = 0.0f64;
    for (a, b) in (0..all.len()).flat_map(|a| (0..all.len()).map(move |b| (a, b))).filter(|(a, b)| a != b) {
        let meet = boxes[a].0.cmple(boxes[b].1).all() && boxes[b].0.cmple(boxes[a].1).all();
        if meet {
            let smaller = longest(all[a].1).min(longest(all[b].1));
            worst = worst.max(depth(all[a].1, &surfaces[b], boxes[b]) / smaller);
        }
    }
    worst
}

/// Least height of a body's points above the ground.
fn lowest(world: &World, instance: &Instance) -> f64 {
    let ground = &world.built().ground;
    points(instance).iter().map(|p| p.z - ground.height(p.x, p.y)).fold(f64::MAX, f64::min)
}

const SEABEDS: &str = "seabed: {extent_m: 14, cell_m: 0.12, sediment: silt, shape: {choice: [flat, {slope: {angle_deg: 6}}, \
    {ripples: {wavelength_m: 0.6, height_m: 0.06}}, {fractal: {rms_m: 0.08}}]}}";

#[test]
fn settled_bodies_keep_out_of_each_other_and_touch_the_bottom() {
    let desk = Desk::new();
    // Half of the scenes keep 5 cm clear, in the others bodies may lie on each other, heaped into a small place.
    let items = |clear: &str, within: f64| {
        format!("objects: [{{pick: {{catalog: starter}}, count: 7, clear_m: {clear}, pose: {{settle: {{within_m: {within}}}}}}}]")
    };
    let (mut worst, mut gap, mut placed, mut asked, mut spent) = (0.0f64, 0.0f64, 0, 0, Duration::ZERO);
    for (clear, within) in [("0.05", 3.0), ("0", 1.4)] {
        let scenes = std::env::var("N").map_or(250, |n| n.parse().unwrap());
        let project = project(&desk, scenes, &format!("{SEABEDS}\n{}", items(clear, within)));
        let start = Instant::now();
        let worlds = worlds(&project);
        spent += start.elapsed();
        println!("{clear}: built {:?}", start.elapsed());
        for world in &worlds {
            asked += 7;
            placed += world.scene().bodies.len();
            assert_eq!(world.scene().bodies.len() + world.built().dropped.len(), 7);
        }
        let overlaps: Vec<f64> = worlds.par_iter().map(worst_overlap).collect();
        println!("measured {:?}", start.elapsed());
        worst = overlaps.into_iter().fold(worst, f64::max);
        if clear != "0" {
            for (world, (label, body)) in worlds.iter().flat_map(|world| bodies(world).into_iter().map(move |b| (world, b))) {
                let low = lowest(world, body);
                assert!(low.abs() < 0.01 * longest(body) + 0.002, "{label}: {low} m from the ground");
                gap = gap.max(low.abs());
            }
        }
    }
    println!("{placed} of {asked} placed in 500 scenes, {:?} a scene and thread; worst overlap {worst:.5}, worst gap {gap:.5} m", spent / 500);
    assert!(worst < 0.01, "two bodies pass through each other by {worst} of the smaller one's size");
    assert!(placed * 10 >= asked * 9, "{placed} of {asked}");
}
