//! Poses at given places: about a middle, and on a given side of another object.

mod support;

use ensonify::math::real::{atan2, degrees};
use ensonify::recipe::Outside;
use ensonify::run::{Given, Project, World};
use glam::DVec2;
use support::cli::Desk;

const AROUND: &str = "ensonify: 1
name: places
seed: 5
scenes: 3
frames: 1
sonar: {device: oculus-m1200d-lf, range_m: [0.5, 12]}
seabed: {extent_m: 60, cell_m: 0.3}
trajectory: {hover: {position_m: [-5, -5, 3], yaw_deg: 45}}
objects:
";

/// Middles in plan of all bodies with a label, scene by scene.
fn middles(objects: &str, label: &str) -> Vec<Vec<DVec2>> {
    let desk = Desk::new();
    let path = desk.file("places.yaml", &format!("{AROUND}{objects}"));
    let project = Project::load(&Given { path: &path, sets: &[], outside: Outside::Refused })
        .unwrap_or_else(|error| panic!("{objects}: {error}"));
    let of_scene = |number| {
        let world = World::build(&project.plan, number, &project.assets).expect("a scene");
        assert!(world.built().dropped.is_empty(), "{objects}: {:?}", world.built().dropped);
        let bodies = world.scene().bodies.iter().filter(|body| &*body.label == label);
        bodies.map(|body| body.centre.truncate()).collect()
    };
    (0..project.plan.scenes.len()).map(of_scene).collect()
}

#[test]
fn discs_lie_about_their_middle() {
    let kinds = [
        ("rest", "within_m: 2", 2.6),
        ("settle", "within_m: 2", 3.2),
        ("float", "within_m: 2", 2.6),
        ("cluster", "radius_m: 1, within_m: 1", 3.2),
        ("line", "spacing_m: 1, within_m: 1, stray_m: 0", 3.6),
    ];
    for (kind, numbers, far) in kinds {
        let item = format!(
            "  - {{pick: {{catalog: starter, uid: oil-drum}}, label: it, count: 3, pose: {{{kind}: {{{numbers}, centre_m: [9, -4]}}}}}}\n"
        );
        for middle in middles(&item, "it").concat() {
            let off = (middle - DVec2::new(9.0, -4.0)).length();
            assert!(off < far, "{kind}: {off} m from its middle");
        }
    }
}

#[test]
fn a_direction_says_on_which_side() {
    let boulder = "  - {pick: {catalog: starter, uid: rock-3}, pose: {rest: {within_m: 3}}}\n";
    for (direction, said) in [(180.0, "180"), (90.0, "90"), (-60.0, "{uniform: [-60, -60]}")] {
        let item = format!(
            "{boulder}  - {{pick: {{catalog: starter, uid: crate}}, count: 2, pose: {{near: {{of: rock, distance_m: 0.4, direction_deg: {said}}}}}}}\n"
        );
        let rocks = middles(&item, "rock");
        for (scene, crates) in middles(&item, "crate").iter().enumerate() {
            for place in crates {
                let away = *place - rocks[scene][0];
                let off = (degrees(atan2(away.y, away.x)) - direction + 540.0) % 360.0 - 180.0;
                assert!(off.abs() < 46.0, "{off}° aside of {direction}°");
                assert!((0.5..4.0).contains(&away.length()), "{} m away", away.length());
            }
        }
    }
}
