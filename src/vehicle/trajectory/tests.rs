//! Every kind over a made-up world.

use super::*;
use crate::math::real::{degrees, radians, sin};

fn read(text: &str) -> Trajectory {
    serde_json::from_value(serde_yaml::from_str(text).expect("YAML")).expect(text)
}

fn hilly(x: f64, y: f64) -> f64 {
    0.3 * sin(0.5 * x) + 0.05 * y
}

const KINDS: [&str; 5] = [
    "{orbit: {radius_m: 4, altitude_m: 2, look_at: objects, centre: objects, start_deg: 10, arc_deg: 360}}",
    "{lawnmower: {length_m: 20, spacing_m: 5, lines: 4, altitude_m: 3, heading_deg: 30, centre_m: [1, 2]}}",
    "{waypoints: {points_m: [[0, 0, 2], [5, 0, 3], [5, 5, 2.5], [0, 9, 3]]}}",
    "{views: {range_m: 5, altitude_m: 1.5, off_axis_deg: 20}}",
    "{hover: {position_m: [1, 2, -40], yaw_deg: 30, pitch_deg: -5, roll_deg: 2}}",
];

fn targets() -> [Target; 2] {
    [
        Target { centre: DVec3::new(2.0, 1.0, 0.3), radius_m: 0.4 },
        Target { centre: DVec3::new(-1.0, 3.0, 0.2), radius_m: 0.3 },
    ]
}

/// Poses of a run of `count` frames with a sonar pitched 15° down, half a metre ahead.
fn run(trajectory: &Trajectory, count: u64, clear: &dyn Fn(DVec3, DVec3) -> bool) -> Vec<Pose> {
    let mount = mount();
    let around = Surroundings { ground: &hilly, targets: &targets(), clear, mount: &mount };
    (0..count)
        .map(|index| trajectory.pose(FrameOfRun { index, count }, &around, &mut Stream::at(1, "frame", index, "pose")))
        .collect()
}

fn mount() -> Pose {
    Pose::from_angles(DVec3::new(0.5, 0.0, -0.1), 0.0, radians(-15.0), 0.0)
}

#[test]
fn every_kind_keeps_above_the_ground_and_repeats_itself() {
    for kind in KINDS {
        let trajectory = read(kind);
        trajectory.check().expect(kind);
        let poses = run(&trajectory, 40, &|_, _| true);
        assert_eq!(poses, run(&trajectory, 40, &|_, _| true), "{kind}");
        for pose in poses {
            let altitude = pose.position.z - hilly(pose.position.x, pose.position.y);
            assert!(altitude >= LEAST_ALTITUDE_M - 1e-9, "{kind}: {altitude}");
            assert!((pose.rotation.determinant() - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn an_orbit_looks_at_its_centre() {
    let centre = (targets()[0].centre + targets()[1].centre) / 2.0;
    let poses = run(&read(KINDS[0]), 12, &|_, _| true);
    for pose in &poses {
        let towards = (centre - pose.position).truncate();
        assert!((towards.length() - 4.0).abs() < 1e-9);
        assert!((pose.rotation.x_axis.truncate().dot(towards) - 4.0).abs() < 1e-9);
        assert!((pose.rotation.z_axis - DVec3::Z).length() < 1e-12);
        assert!((pose.position.z - hilly(pose.position.x, pose.position.y) - 2.0).abs() < 1e-9);
    }
    assert!((poses[0].position - poses[11].position).length() > 1.0, "the round does not end where it began");
    let half = run(&read(&KINDS[0].replace("arc_deg: 360", "arc_deg: 180")), 5, &|_, _| true);
    assert!(((half[0].position + half[4].position) / 2.0 - centre).truncate().length() < 1e-9);
}

#[test]
fn a_lawnmower_covers_its_area_at_an_even_pace() {
    let level = |_: f64, _: f64| 0.0;
    let mount = Pose::IDENTITY;
    let around = Surroundings { ground: &level, targets: &[], clear: &|_, _| true, mount: &mount };
    let trajectory = read(&KINDS[1].replace("heading_deg: 30, centre_m: [1, 2]", "heading_deg: 0, centre_m: [0, 0]"));
    let count = 2000;
    let at = |index| trajectory.pose(FrameOfRun { index, count }, &around, &mut Stream::at(1, "frame", index, "pose"));
    let close = |a: DVec3, b: [f64; 3]| assert!((a - DVec3::from_array(b)).length() < 1e-9, "{a}");
    close(at(0).position, [-10.0, -7.5, 3.0]);
    close(at(count - 1).position, [-10.0, 7.5, 3.0]);
    for index in 1..count {
        let (before, now) = (at(index - 1), at(index));
        let step = now.position - before.position;
        assert!((step.length() - (80.0 + 7.5 * std::f64::consts::PI) / 1999.0).abs() < 1e-4);
        assert!(step.normalize().dot(now.rotation.x_axis) > 0.999, "nose along the path at {index}");
        assert!(now.position.y.abs() < 7.6 && now.position.x.abs() < 12.6);
    }
}

#[test]
fn waypoints_are_passed_with_the_nose_along_the_path() {
    let poses = run(&read(KINDS[2]), 400, &|_, _| true);
    for point in [[0.0, 0.0, 2.0], [5.0, 0.0, 3.0], [5.0, 5.0, 2.5], [0.0, 9.0, 3.0]] {
        let nearest = poses.iter().map(|p| (p.position - DVec3::from_array(point)).length()).fold(f64::MAX, f64::min);
        assert!(nearest < 0.03, "{point:?}: {nearest}");
    }
    let steps: Vec<f64> = poses.windows(2).map(|w| (w[1].position - w[0].position).length()).collect();
    let (least, most) = steps.iter().fold((f64::MAX, 0.0f64), |(a, b), &s| (a.min(s), b.max(s)));
    assert!(most < 1.02 * least, "{least} {most}");
    assert!(poses.windows(2).all(|w| (w[1].position - w[0].position).normalize().dot(w[1].rotation.x_axis) > 0.95));
}

#[test]
fn views_see_a_target_at_the_range_and_near_the_axis() {
    let (mount, targets) = (mount(), targets());
    let mut seen = [0; 2];
    for pose in run(&read(KINDS[3]), 60, &|_, _| true) {
        let sonar = pose.then_inner(&mount);
        let nearest = |k: usize| ((targets[k].centre - sonar.position).length() - 5.0).abs();
        let k = usize::from(nearest(1) < nearest(0));
        seen[k] += 1;
        assert!(nearest(k) < 0.1, "{}", nearest(k));
        let there = sonar.inverse().apply(targets[k].centre);
        let off_axis = degrees(crate::math::real::atan2(there.y, there.x));
        assert!(off_axis.abs() < 22.0, "{off_axis}");
        assert!((there.z / there.length()).abs() < 0.08, "{there}");
    }
    assert!(seen[0] > 10 && seen[1] > 10, "{seen:?}");
    // Only views from the east are clear, so all are from the east.
    let from_east = |from: DVec3, to: DVec3| from.x > to.x;
    for pose in run(&read(KINDS[3]), 40, &from_east) {
        assert!(pose.rotation.x_axis.x < 0.5, "{:?}", pose.rotation.x_axis);
    }
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let cases = [
        (KINDS[0].replace("radius_m: 4", "radius_m: 0"), "radius_m is 0, which is not above 0"),
        (KINDS[1].replace("lines: 4", "lines: 0"), "lines"),
        ("{waypoints: {points_m: [[0, 0, 0]]}}".into(), "number of points_m is 1"),
        (KINDS[3].replace("range_m: 5", "range_m: -1"), "range_m"),
    ];
    for (text, expected) in cases {
        let error = read(&text).check().expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
    }
    let unknown = serde_json::from_str::<Trajectory>(r#"{"hover": {"position_m": [0, 0, 0], "yaw": 1}}"#);
    assert!(unknown.is_err());
}
