//! Every kind of trajectory in real scenes: rendered once, in any order of frames, clear of everything.

mod support;

use std::time::Instant;

use ensonify::plan::schema;
use ensonify::recipe::Outside;
use ensonify::run::render::Renderer;
use ensonify::run::{Given, Project, World};
use ensonify::vehicle::{Surroundings as _, Trajectory};
use support::cli::{Desk, messages};

/// One of every kind, as a recipe has it.
const EXAMPLES: [&str; 8] = [
    "{orbit: {radius_m: 4, altitude_m: 1.5}}",
    "{lawnmower: {length_m: 8, spacing_m: 3, lines: 2, altitude_m: 1.5}}",
    "{waypoints: {points_m: [[-6, -1, 1.5], [0, -2, 1], [5, 1, 1.5], [0, 4, 2]]}}",
    "{terrain: {altitude_m: 1.5, length_m: 9, heading_deg: 30}}",
    "{approach: {from_m: 6, to_m: 2, altitude_m: 1.2, course_deg: 70}}",
    "{views: {range_m: 3, altitude_m: 1.2}}",
    "{hover: {position_m: [-5, 0, 1.5], drift: {horizontal_m: 0.3, vertical_m: 0.1, yaw_deg: 5}}}",
    "{poses: {file: track.txt}}",
];

/// Where a kind has its example. Whoever adds a kind is asked for one here, by the compiler.
fn example_of(trajectory: &Trajectory) -> &'static str {
    EXAMPLES[match trajectory {
        Trajectory::Orbit(_) => 0,
        Trajectory::Lawnmower(_) => 1,
        Trajectory::Waypoints(_) => 2,
        Trajectory::Terrain(_) => 3,
        Trajectory::Approach(_) => 4,
        Trajectory::Views(_) => 5,
        Trajectory::Hover(_) => 6,
        Trajectory::Poses(_) => 7,
    }]
}

/// The kinds that recipes may name, as the type that reads them tells.
fn kinds() -> Vec<String> {
    let schema: serde_json::Value = serde_json::from_str(&schema()).expect("JSON");
    let words = &schema["properties"]["trajectory"]["anyOf"][0]["anyOf"][0]["enum"];
    serde_json::from_value(words.clone()).expect("words")
}

const TRACK: &str =
    "# timestamp tx ty tz qx qy qz qw\n10 -5 0 1.5 0 0 0 1\n12 -3 -2 1.2 0 0 0.2588190451 0.9659258263\n";

fn recipe(trajectory: &str, sections: &str) -> String {
    format!(
        "ensonify: 1
name: path
seed: 12
frames: 6
sonar: {{beams: 48, azimuth_deg: 90, elevation_deg: 30, elevations: 120, range_m: [0.5, 9], range_bins: 96, frequency_khz: 900, mount: {{position_m: [0.3, 0, -0.1], pitch_deg: -15}}}}
trajectory: {trajectory}
output: {{fan_height_px: 64}}
{sections}
"
    )
}

const SCENE: &str = "seabed: {extent_m: 24, cell_m: 0.2, shape: {fractal: {rms_m: 0.15, shortest_m: 0.6}}}
objects: [{pick: {catalog: starter, uid: [tire, oil-drum, anchor]}, count: 4, pose: {rest: {within_m: 3}}}]
vehicle: {attitude_noise: {roll_deg: 2, pitch_deg: 1, yaw_deg: 1, heave_m: 0.03, period_s: 3}}";

fn load(desk: &Desk, text: &str) -> Project {
    desk.file("track.txt", TRACK);
    let path = desk.file("path.yaml", text);
    let given = Given { path: &path, sets: &[], outside: Outside::Refused };
    Project::load(&given).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn every_kind_is_rendered_and_its_frames_need_no_order() {
    let desk = Desk::new();
    let mut rendered = Vec::new();
    for example in EXAMPLES {
        let project = load(&desk, &recipe(example, SCENE));
        let (plan, header) = (&project.plan, &project.plan.header);
        let kind = plan.jobs[0].trajectory.kind();
        assert_eq!(example_of(&plan.jobs[0].trajectory), example);
        let render = |id: usize| {
            // A world and tools of its own for each frame: nothing is left over from the frames before.
            let world = World::build(&plan.scenes[0], &project.assets).expect("a world");
            Renderer::default().render(header, &plan.jobs[id], &world).expect("a frame")
        };
        let backwards: Vec<_> = (0..6).rev().map(render).collect();
        let world = World::build(&plan.scenes[0], &project.assets).expect("a world");
        let mut renderer = Renderer::default();
        let mut grey = 0;
        for (id, other) in backwards.iter().rev().enumerate() {
            let frame = renderer.render(header, &plan.jobs[id], &world).expect("a frame");
            assert_eq!(frame.world_from_sonar, other.world_from_sonar, "{kind} {id}");
            assert_eq!(frame.pictures[1].looks, other.pictures[1].looks, "{kind} {id}");
            let again = world.station(header, &plan.jobs[id]).expect("a pose");
            assert_eq!((again.time_s, again.moved_m), (frame.time_s, frame.moved_m));
            grey += frame.pictures[1].looks[0].iter().filter(|&&grey| grey > 20).count();
        }
        assert!(grey > 1000, "{kind}: {grey} pixels of echoes in six frames");
        assert!(backwards[0].time_s > backwards[5].time_s, "{kind}: time goes on");
        assert_eq!(plan.assets.contains_key("trajectory/track.txt"), kind == "poses");
        rendered.push(kind.to_owned());
    }
    assert_eq!(rendered, kinds(), "every kind is rendered");
}

#[test]
fn vehicle_and_sonar_keep_their_distance_in_random_scenes() {
    let desk = Desk::new();
    let crowded = "seabed: {extent_m: 24, cell_m: 0.2, shape: {fractal: {rms_m: 0.2, shortest_m: 0.6}}}
objects:
  - {pick: {catalog: starter, tags: [debris]}, count: 14, pose: {rest: {within_m: 5, tip_deg: {choice: [0, 90]}}}}
  - {pick: {catalog: starter, label: rock}, count: 4, pose: {rest: {within_m: 5}}}
scenes: 3";
    let pier = "seabed: {extent_m: 60, cell_m: 0.4, shape: flat}\nenvironment: {kind: pier}\nscenes: 2";
    let paths = [
        "{lawnmower: {length_m: 10, spacing_m: 2, lines: 5, altitude_m: 0.4, heading_deg: {uniform: [0, 90]}}}",
        "{waypoints: {points_m: [[-6, -4, 0.6], [-2, 3, 0.5], [2, -3, 0.6], [6, 4, 0.5]]}}",
        "{hover: {position_m: [{uniform: [-5, 5], per: frame}, {uniform: [-5, 5], per: frame}, 0.4]}}",
        "{views: {range_m: 1.5, altitude_m: 0.5}}",
    ];
    let (mut frames, mut moved, mut taken) = (0, 0, 0.0);
    for sections in [crowded, pier] {
        for path in paths {
            let text = recipe(path, sections).replace("frames: 6", "frames: 60");
            let project = load(&desk, &text);
            for (number, scene) in project.plan.scenes.iter().enumerate() {
                let world = World::build(scene, &project.assets).expect("a world");
                // What is built on the first question is no part of a frame's time.
                world.gap(glam::DVec3::ZERO, 0.3);
                for job in &project.plan.jobs[number * 60..][..60] {
                    let begun = Instant::now();
                    let station = world.station(&project.plan.header, job).expect("a pose");
                    taken += begun.elapsed().as_secs_f64();
                    let sonar = world.sonar_pose(&project.plan.header, job).expect("a pose");
                    for point in [station.pose.position, sonar.position] {
                        assert!(world.gap(point, 1.0) >= 0.3 - 1e-6, "{path}: {point} in scene {number}");
                        assert!(point.z - world.floor(point) >= 0.3 - 1e-6, "{path}: {point}");
                    }
                    (frames, moved) = (frames + 1, moved + u32::from(station.moved_m > 1e-6));
                }
            }
        }
    }
    println!("{moved} of {frames} frames are moved, {:.3} ms a frame", 1e3 * taken / f64::from(frames));
    assert!(moved * 10 > frames && moved < frames, "{moved} of {frames}");
}

#[test]
fn under_a_deck_it_stays_under_the_deck() {
    let desk = Desk::new();
    let pier =
        "seabed: {extent_m: 60, cell_m: 0.4, shape: flat}\nenvironment: {kind: {pier: {out_of_plumb_m: 0, broken: 0}}}";
    let project = load(&desk, &recipe("{hover: {position_m: [2, 1.2, 3]}}", pier));
    let world = World::build(&project.plan.scenes[0], &project.assets).expect("a world");
    let station = world.station(&project.plan.header, &project.plan.jobs[0]).expect("a pose");
    assert!(world.gap(glam::DVec3::new(2.0, 1.2, 7.7), 1.0) == 0.0, "there is a deck");
    assert_eq!((station.moved_m, station.pose.position.z), (0.0, 3.0));
}

#[test]
fn records_tell_time_and_what_was_moved_and_check_counts_it() {
    let desk = Desk::new();
    let objects = "seabed: {shape: flat, extent_m: 20, cell_m: 0.5}
objects: [{pick: {catalog: starter, uid: oil-drum}, pose: {at: {position_m: [0, 0, 0]}}}]";
    let line = "{waypoints: {points_m: [[-5, 0, 0.5], [5, 0, 0.5]], speed_m_s: 2}}";
    desk.file("path.yaml", &recipe(line, objects));
    let check = desk.run(&["check", "path.yaml"]);
    assert!(messages(&check).contains("frames are moved"), "{}", messages(&check));
    let run = desk.run(&["run", "path.yaml", "-o", "out"]);
    assert!(run.status.success(), "{}", messages(&run));
    let mut table = csv::Reader::from_path(desk.path().join("out/frames.csv")).expect("a table");
    let header = table.headers().expect("a header").clone();
    let column = |name: &str| header.iter().position(|column| column == name).expect(name);
    let (time, moved) = (column("time_s"), column("moved_m"));
    let rows: Vec<csv::StringRecord> = table.records().map(|row| row.expect("a row")).collect();
    let number = |row: &csv::StringRecord, column: usize| row[column].parse::<f64>().expect("a number");
    assert_eq!(rows.iter().map(|row| number(row, time)).collect::<Vec<_>>(), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert!(number(&rows[0], moved) == 0.0 && number(&rows[2], moved) > 0.2, "{rows:?}");
}

#[test]
fn files_of_poses_that_cannot_be_used_are_refused_at_their_place() {
    let refused = |file: &str, text: &str, trajectory: &str, words: &[&str]| {
        let desk = Desk::new();
        desk.file(file, text);
        desk.file("a.yaml", &recipe(trajectory, "seabed: {shape: flat, extent_m: 20}"));
        let output = desk.run(&["check", "a.yaml"]);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.starts_with("error: a.yaml:6:"), "{message}");
        words.iter().for_each(|word| assert!(message.contains(word), "`{word}` is not in: {message}"));
    };
    let poses = "{poses: {file: t.csv}}";
    refused("other.csv", "", poses, &["t.csv", "cannot be read"]);
    refused("t.csv", "time_s,x,y\n", poses, &["t.csv", "line 1", "yaw_deg"]);
    refused("t.csv", "0 0 0 1 0 0 0 1\n0 0 0 1 0 0 0 1\n", poses, &["line 2", "does not come after"]);
    refused("t.csv", "0 0 0 1 0 0 0 2\n1 0 0 1 0 0 0 1\n", poses, &["line 1", "length 2"]);
    refused("t.csv", "0 0 0 1 0 0 0 1\n", poses, &["too few rows, 1 of 2"]);
    refused("t.csv", TRACK, "{poses: {file: t.csv, take: rows}}", &["too few rows, 2 of 6"]);
    refused("t.csv", TRACK, "{poses: {file: t.csv, take: row}}", &["row", "rows"]);
    refused("t.csv", TRACK, "{poses: {}}", &["file"]);
    refused("t.csv", TRACK, "{hover: {position_m: [0, 0, 1], drift: {period_s: 0}}}", &["0 is not above 0"]);
    refused("t.csv", TRACK, "{terrain: {points_m: [[0, 0]]}}", &["at least 2 points"]);
}

#[test]
fn a_changed_file_of_poses_is_another_plan() {
    let desk = Desk::new();
    let text = recipe("{poses: {file: track.txt}}", "seabed: {shape: flat, extent_m: 20}");
    let first = load(&desk, &text).plan_hash;
    assert_eq!(first, load(&desk, &text).plan_hash);
    let path = desk.path().join("track.txt");
    std::fs::write(&path, TRACK.replace("12 -3", "12 -4")).expect("written");
    let given = Given { path: &desk.path().join("path.yaml"), sets: &[], outside: Outside::Refused };
    assert_ne!(first, Project::load(&given).expect("a recipe").plan_hash);
}
