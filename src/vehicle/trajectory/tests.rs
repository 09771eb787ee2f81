//! Every kind over a made-up world.

use super::*;
use crate::math::real::{cos, degrees, radians, sin};
use crate::vehicle::AttitudeNoise;

fn read(text: &str) -> Trajectory {
    serde_json::from_value(serde_yaml::from_str(text).expect("YAML")).expect(text)
}

const KINDS: [&str; 8] = [
    "{orbit: {radius_m: 4, altitude_m: 2, look_at: objects, centre: objects, start_deg: 10, arc_deg: 360, speed_m_s: 1}}",
    "{lawnmower: {length_m: 20, spacing_m: 5, lines: 4, altitude_m: 3, heading_deg: 30, centre_m: [1, 2], speed_m_s: 1}}",
    "{waypoints: {points_m: [[0, 0, 2], [5, 0, 3], [5, 5, 2.5], [0, 9, 3]], speed_m_s: 1, turn_deg_s: 30, least_speed_m_s: 0}}",
    "{views: {range_m: 5, altitude_m: 1.5, off_axis_deg: 20}}",
    "{hover: {position_m: [1, 2, -40], yaw_deg: 30, pitch_deg: -5, roll_deg: 2, \
      drift: {horizontal_m: 0, vertical_m: 0, yaw_deg: 0, period_s: 60}}}",
    "{approach: {of: objects, from_m: 10, to_m: 2, altitude_m: 1.5, course_deg: 40, speed_m_s: 0.5}}",
    "{terrain: {altitude_m: 2, length_m: 20, heading_deg: 20, centre_m: [0, 0], smooth_m: 3, most_pitch_deg: 20, \
      speed_m_s: 1, turn_deg_s: 30}}",
    "{poses: {file: track.csv, take: evenly}}",
];

/// Hills, two targets that have no surface, and balls that have.
struct Hilly {
    ground: fn(f64, f64) -> f64,
    sees: fn(DVec3, DVec3) -> bool,
    targets: Vec<Target>,
    balls: Vec<(DVec3, f64)>,
}

impl Surroundings for Hilly {
    fn ground(&self, x: f64, y: f64) -> f64 {
        (self.ground)(x, y)
    }
    fn targets(&self) -> &[Target] {
        &self.targets
    }
    fn sees(&self, from: DVec3, to: DVec3) -> bool {
        (self.sees)(from, to)
    }
    fn floor(&self, point: DVec3) -> f64 {
        (self.ground)(point.x, point.y)
    }
    fn gap(&self, point: DVec3, within: f64) -> f64 {
        let to = |(centre, radius): &(DVec3, f64)| ((point - *centre).length() - radius).max(0.0);
        self.balls.iter().map(to).fold(within, f64::min)
    }
}

fn hilly() -> Hilly {
    Hilly {
        ground: |x, y| 0.3 * sin(0.5 * x) + 0.05 * y,
        sees: |_, _| true,
        targets: vec![
            Target { centre: DVec3::new(2.0, 1.0, 0.3), radius_m: 0.4 },
            Target { centre: DVec3::new(-1.0, 3.0, 0.2), radius_m: 0.3 },
        ],
        balls: Vec::new(),
    }
}

fn level() -> Hilly {
    Hilly { ground: |_, _| 0.0, ..hilly() }
}

/// A run over a world: by default a sonar pitched 15° down, half a metre ahead, on a calm vehicle.
struct Run<'a> {
    around: &'a Hilly,
    vehicle: Vehicle,
    mount: Pose,
    count: u64,
}

impl<'a> Run<'a> {
    fn over(around: &'a Hilly, count: u64) -> Self {
        let mount = Pose::from_angles(DVec3::new(0.5, 0.0, -0.1), 0.0, radians(-15.0), 0.0);
        Self { around, vehicle: Vehicle::CALM, mount, count }
    }

    fn station(&self, trajectory: &Trajectory, index: u64) -> Station {
        let track = Track::parse(TRACK).expect("a table");
        let voyage = Voyage {
            frame: FrameOfRun { index, count: self.count },
            vehicle: &self.vehicle,
            mount: &self.mount,
            around: self.around,
            scene_stream: &|purpose| Stream::at(1, "scene", 3, purpose),
            track: trajectory.file().map(|_| &track),
        };
        trajectory.station(&voyage, &mut Stream::at(1, "frame", index, "trajectory"))
    }

    fn stations(&self, kind: &str) -> Vec<Station> {
        let trajectory = read(kind);
        (0..self.count).map(|index| self.station(&trajectory, index)).collect()
    }

    fn poses(&self, kind: &str) -> Vec<Pose> {
        self.stations(kind).iter().map(|station| station.pose).collect()
    }
}

const TRACK: &str = "time_s,x,y,z,yaw_deg,pitch_deg,roll_deg\n100,0,0,3,0,0,0\n110,8,0,4,40,-10,5\n130,8,9,3,120,0,0\n";

fn yaw(pose: &Pose) -> f64 {
    atan2(pose.rotation.x_axis.y, pose.rotation.x_axis.x)
}

fn turned(a: f64, b: f64) -> f64 {
    let turn = b - a;
    turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round()
}

#[test]
fn every_kind_keeps_above_the_ground_and_has_its_times() {
    let around = hilly();
    for kind in KINDS {
        let trajectory = read(kind);
        trajectory.check().expect(kind);
        assert!(kind.starts_with(&format!("{{{}:", trajectory.kind())), "{kind}");
        let run = Run::over(&around, 40);
        let stations = run.stations(kind);
        // Any frame can be asked for first.
        let backwards: Vec<Station> = (0..40).rev().map(|index| run.station(&trajectory, index)).collect();
        assert!(stations.iter().eq(backwards.iter().rev()), "{kind}");
        for Station { pose, .. } in &stations {
            for point in [pose.position, pose.apply(run.mount.position)] {
                let altitude = point.z - (around.ground)(point.x, point.y);
                assert!(altitude >= 0.3 - 1e-6, "{kind}: {altitude}");
            }
            assert!((pose.rotation.determinant() - 1.0).abs() < 1e-9);
        }
        let begin = if trajectory.file().is_some() { 100.0 } else { 0.0 };
        assert_eq!(stations[0].time_s, begin, "{kind}");
        let steps: Vec<f64> = stations.windows(2).map(|pair| pair[1].time_s - pair[0].time_s).collect();
        assert!(steps.iter().all(|step| *step > 0.0 && (step - steps[0]).abs() < 1e-9), "{kind}: {steps:?}");
    }
    let orbit = Run::over(&around, 40).stations(KINDS[0]);
    assert!((orbit[39].time_s - 4.0 * std::f64::consts::TAU * 39.0 / 40.0).abs() < 1e-9);
    assert!((Run::over(&around, 40).stations(KINDS[5])[39].time_s - 16.0).abs() < 1e-9);
    assert!((Run::over(&around, 40).stations(KINDS[4])[39].time_s - 19.5).abs() < 1e-9);
}

#[test]
fn along_paths_nothing_moves_faster_than_it_may() {
    let around = hilly();
    for (kind, speed) in [(KINDS[0], 1.0), (KINDS[1], 1.0), (KINDS[2], 1.0), (KINDS[5], 0.5), (KINDS[6], 1.0)] {
        for pair in Run::over(&around, 3000).stations(kind).windows(2) {
            let step = (pair[1].pose.position - pair[0].pose.position).truncate().length();
            let allowed = speed * (pair[1].time_s - pair[0].time_s);
            // The vehicle of an approach swings about its sonar as it pitches.
            let swing = if kind.contains("approach") { 0.01 } else { 0.0 };
            assert!(step < 1.01 * allowed + swing, "{kind}: {step} m in {allowed} m");
        }
    }
}

#[test]
fn an_orbit_looks_at_its_centre() {
    let around = hilly();
    let run = |count| Run {
        mount: Pose { position: DVec3::ZERO, ..Run::over(&around, 1).mount },
        ..Run::over(&around, count)
    };
    let centre = (around.targets[0].centre + around.targets[1].centre) / 2.0;
    let poses = run(12).poses(KINDS[0]);
    for pose in &poses {
        let towards = (centre - pose.position).truncate();
        assert!((towards.length() - 4.0).abs() < 1e-9);
        assert!((pose.rotation.x_axis.truncate().dot(towards) - 4.0).abs() < 1e-9);
        assert!((pose.rotation.z_axis - DVec3::Z).length() < 1e-12);
        assert!((pose.position.z - (around.ground)(pose.position.x, pose.position.y) - 2.0).abs() < 1e-9);
    }
    assert!((poses[0].position - poses[11].position).length() > 1.0, "the round does not end where it began");
    let half = run(5).poses(&KINDS[0].replace("arc_deg: 360", "arc_deg: 180"));
    assert!(((half[0].position + half[4].position) / 2.0 - centre).truncate().length() < 1e-9);
    // Without an arc there is no way: time goes on from ping to ping.
    let still = run(5).stations(&KINDS[0].replace("arc_deg: 360", "arc_deg: 0"));
    assert_eq!(still[0].pose, still[4].pose);
    assert_eq!(still[4].time_s, 2.0);
}

#[test]
fn a_lawnmower_covers_its_area_at_an_even_pace() {
    let (around, count) = (level(), 2000);
    let kind = KINDS[1].replace("heading_deg: 30, centre_m: [1, 2]", "heading_deg: 0, centre_m: [0, 0]");
    let poses = Run::over(&around, count).poses(&kind);
    let close = |a: DVec3, b: [f64; 3]| assert!((a - DVec3::from_array(b)).length() < 1e-9, "{a}");
    close(poses[0].position, [-10.0, -7.5, 3.0]);
    close(poses[1999].position, [-10.0, 7.5, 3.0]);
    for pair in poses.windows(2) {
        let step = pair[1].position - pair[0].position;
        assert!((step.length() - (80.0 + 7.5 * std::f64::consts::PI) / 1999.0).abs() < 1e-4);
        assert!(step.normalize().dot(pair[1].rotation.x_axis) > 0.999, "nose along the path");
        assert!(pair[1].position.y.abs() < 7.6 && pair[1].position.x.abs() < 12.6);
    }
}

#[test]
fn waypoints_are_passed_with_the_nose_along_the_path() {
    let around = hilly();
    let poses = Run::over(&around, 400).poses(KINDS[2]);
    for point in [[0.0, 0.0, 2.0], [5.0, 0.0, 3.0], [5.0, 5.0, 2.5], [0.0, 9.0, 3.0]] {
        let nearest = poses.iter().map(|p| (p.position - DVec3::from_array(point)).length()).fold(f64::MAX, f64::min);
        assert!(nearest < 0.03, "{point:?}: {nearest}");
    }
    // Nothing slows this path down where the vehicle turns fast.
    let brisk = Run::over(&around, 400).poses(&KINDS[2].replace("turn_deg_s: 30", "turn_deg_s: 300"));
    let steps: Vec<f64> = brisk.windows(2).map(|w| (w[1].position - w[0].position).length()).collect();
    let (least, most) = steps.iter().fold((f64::MAX, 0.0f64), |(a, b), &s| (a.min(s), b.max(s)));
    assert!(most < 1.02 * least, "{least} {most}");
    assert!(poses.windows(2).all(|w| (w[1].position - w[0].position).normalize().dot(w[1].rotation.x_axis) > 0.95));
}

#[test]
fn waypoints_turn_no_faster_than_the_vehicle_can() {
    let around = level();
    let zigzag = "[[0, 0, 2], [6, 0, 2], [1, 1, 2], [8, 1.5, 2], [8, 1.5, 4], [2, 1.5, 4]]";
    for limit in [5.0, 20.0, 90.0] {
        let kind =
            format!("{{waypoints: {{points_m: {zigzag}, speed_m_s: 1.5, turn_deg_s: {limit}, least_speed_m_s: 0}}}}");
        let stations = Run::over(&around, 4000).stations(&kind);
        let mut fastest = 0.0f64;
        for pair in stations.windows(2) {
            let taken = pair[1].time_s - pair[0].time_s;
            let rate = degrees(turned(yaw(&pair[0].pose), yaw(&pair[1].pose)).abs()) / taken;
            let speed = (pair[1].pose.position - pair[0].pose.position).length() / taken;
            assert!(rate < 1.01 * limit + 1e-6 && speed < 1.5 * 1.1, "{rate} of {limit} degrees a second, {speed} m/s");
            fastest = fastest.max(rate);
        }
        assert!(fastest > 0.9 * limit, "the limit is reached: {fastest} of {limit}");
        let least = kind.replace("least_speed_m_s: 0", "least_speed_m_s: 0.3");
        let refusal = read(&least).check().expect_err("it cannot turn on the spot").to_string();
        assert!(refusal.contains("points_m: near [") && refusal.contains("least_speed_m_s"), "{refusal}");
    }
}

#[test]
fn terrain_is_followed_as_far_as_it_is_smooth() {
    let calm = |around: &Hilly, kind: &str| {
        let run = Run { mount: Pose::IDENTITY, ..Run::over(around, 200) };
        run.poses(kind)
    };
    // A plane: the altitude and the pitch are exact, up to the limit of the pitch.
    let slope = Hilly { ground: |x, y| 0.2 * x + 0.1 * y, ..hilly() };
    let (dx, dy) = (cos(radians(20.0)), sin(radians(20.0)));
    let pitch = crate::math::real::atan2(0.2 * dx + 0.1 * dy, 1.0);
    for pose in calm(&slope, KINDS[6]) {
        let altitude = pose.position.z - (slope.ground)(pose.position.x, pose.position.y);
        assert!((altitude - 2.0).abs() < 1e-9 && (asin(pose.rotation.x_axis.z) - pitch).abs() < 1e-9, "{altitude}");
        assert!((yaw(&pose) - radians(20.0)).abs() < 1e-9);
    }
    for pose in calm(&slope, &KINDS[6].replace("most_pitch_deg: 20", "most_pitch_deg: 5")) {
        assert!((degrees(asin(pose.rotation.x_axis.z)) - 5.0).abs() < 1e-9);
    }
    // Long hills are followed within centimetres, ripples of a third of the length not at all.
    let hills = Hilly { ground: |x, _| sin(std::f64::consts::TAU * x / 30.0), ..hilly() };
    let ripples = Hilly { ground: |x, _| 0.2 * sin(std::f64::consts::TAU * x / 1.0), ..hilly() };
    let along_x = KINDS[6].replace("heading_deg: 20", "heading_deg: 0");
    for pose in calm(&hills, &along_x) {
        let altitude = pose.position.z - (hills.ground)(pose.position.x, pose.position.y);
        assert!((altitude - 2.0).abs() < 0.03, "{altitude}");
    }
    for pose in calm(&ripples, &along_x) {
        assert!((pose.position.z - 2.0).abs() < 0.01, "{}", pose.position.z);
        assert!(degrees(asin(pose.rotation.x_axis.z)).abs() < 3.0);
    }
    // Points make it a path in plan.
    let bent = KINDS[6].replace("altitude_m: 2", "altitude_m: 2, points_m: [[0, 0], [6, 0], [9, 5]]");
    let poses = calm(&slope, &bent);
    assert!((poses[199].position.truncate() - glam::DVec2::new(9.0, 5.0)).length() < 1e-9);
    assert!(
        poses
            .iter()
            .all(|pose| (pose.position.z - (slope.ground)(pose.position.x, pose.position.y) - 2.0).abs() < 0.02)
    );
}

#[test]
fn an_approach_comes_nearer_and_looks_at_its_place() {
    let around = hilly();
    let place = (around.targets[0].centre + around.targets[1].centre) / 2.0;
    let run = Run::over(&around, 9);
    for (k, pose) in run.poses(KINDS[5]).into_iter().enumerate() {
        let sonar = pose.then_inner(&run.mount);
        let away = (place - sonar.position).truncate();
        assert!((away.length() - (10.0 - k as f64)).abs() < 1e-9);
        assert!((away.normalize() - glam::DVec2::new(cos(radians(40.0)), sin(radians(40.0)))).length() < 1e-9);
        assert!((sonar.position.z - (around.ground)(sonar.position.x, sonar.position.y) - 1.5).abs() < 1e-9);
        let seen = sonar.inverse().apply(place).normalize();
        assert!((seen - DVec3::X).length() < 1e-9, "on the axis: {seen}");
    }
}

#[test]
fn a_hover_drifts_about_its_place() {
    let around = level();
    let kind = KINDS[4].replace("-40", "9").replace(
        "horizontal_m: 0, vertical_m: 0, yaw_deg: 0, period_s: 60",
        "horizontal_m: 0.4, vertical_m: 0.1, yaw_deg: 3, period_s: 20",
    );
    let run = Run { mount: Pose::IDENTITY, ..Run::over(&around, 4000) };
    let stations = run.stations(&kind);
    let (mut squares, mut yaws) = (DVec3::ZERO, 0.0);
    for Station { pose, .. } in &stations {
        let strayed = pose.position - DVec3::new(1.0, 2.0, 9.0);
        squares += strayed * strayed / 4000.0;
        yaws += degrees(turned(radians(30.0), yaw(pose))).powi(2) / 4000.0;
    }
    for (square, rms) in [(squares.x, 0.4), (squares.y, 0.4), (squares.z, 0.1), (yaws, 3.0)] {
        assert!((square.sqrt() - rms).abs() < 0.05 * rms, "{} of {rms}", square.sqrt());
    }
    let step = |pair: &[Station]| (pair[1].pose.position - pair[0].pose.position).length();
    assert!(stations.windows(2).map(step).fold(0.0, f64::max) < 0.3, "half a second of a drift of 20 s");
    // The drift is the scene's: another one drifts otherwise, another frame count does not change it.
    let shorter = Run { count: 7, ..Run { mount: Pose::IDENTITY, ..Run::over(&around, 7) } }.stations(&kind);
    assert_eq!(shorter[..], stations[..7]);
}

#[test]
fn poses_of_a_file_come_evenly_or_row_by_row() {
    let around = level();
    let run = Run { mount: Pose::IDENTITY, ..Run::over(&around, 7) };
    let evenly = run.stations(KINDS[7]);
    assert_eq!(
        evenly.iter().map(|station| station.time_s).collect::<Vec<_>>(),
        [100.0, 105.0, 110.0, 115.0, 120.0, 125.0, 130.0]
    );
    assert!((evenly[1].pose.position - DVec3::new(4.0, 0.0, 3.5)).length() < 1e-12);
    assert!((evenly[4].pose.position - DVec3::new(8.0, 4.5, 3.5)).length() < 1e-12);
    let rows = Run { count: 3, ..run }.stations(&KINDS[7].replace("evenly", "rows"));
    for (row, k) in rows.iter().zip([0, 2, 6]) {
        assert_eq!(row.time_s, evenly[k].time_s);
        assert!((row.pose.position - evenly[k].pose.position).length() < 1e-12);
    }
}

#[test]
fn waves_shake_every_kind_about_its_pose() {
    let around = level();
    let waves = AttitudeNoise { roll_deg: 2.0, pitch_deg: 1.0, yaw_deg: 1.5, heave_m: 0.05, period_s: 4.0 };
    for kind in KINDS {
        let kind = kind.replace("-40", "9");
        let calm = Run::over(&around, 2000);
        let rough =
            Run { vehicle: Vehicle { attitude_noise: waves.clone(), ..Vehicle::CALM }, ..Run::over(&around, 2000) };
        let (mut squares, mut heave) = (DVec3::ZERO, 0.0);
        for (still, shaken) in calm.stations(&kind).iter().zip(rough.stations(&kind)) {
            assert_eq!(still.time_s, shaken.time_s);
            let difference = still.pose.rotation.transpose() * shaken.pose.rotation;
            let roll = atan2(difference.y_axis.z, difference.z_axis.z);
            let angles = DVec3::new(roll, asin(difference.x_axis.z), atan2(difference.x_axis.y, difference.x_axis.x));
            squares += angles * angles / 2000.0;
            let up = shaken.pose.position - still.pose.position;
            assert!(up.truncate().length() < 1e-12 || shaken.moved_m > 0.0, "{kind}: only heave moves it");
            heave += up.z * up.z / 2000.0;
        }
        // Kinds that are over within a few periods do not come to their mean.
        let off = if kind.contains("hover") || kind.contains("views") { 0.1 } else { 0.5 };
        for (square, rms) in
            [(squares.x, radians(2.0)), (squares.y, radians(1.0)), (squares.z, radians(1.5)), (heave, 0.05)]
        {
            assert!((square.sqrt() / rms - 1.0).abs() < off, "{kind}: {} of {rms}", square.sqrt());
        }
    }
}

#[test]
fn what_stands_in_the_way_is_risen_over_smoothly() {
    let mut around = level();
    around.balls = vec![(DVec3::new(0.3, 0.2, 0.0), 2.0), (DVec3::new(6.0, 0.0, 1.0), 0.7)];
    let line =
        "{waypoints: {points_m: [[-12, 0, 1.2], [12, 0, 1.2]], speed_m_s: 1, turn_deg_s: 30, least_speed_m_s: 0}}";
    let stations = Run::over(&around, 1200).stations(line);
    let mut highest = 0.0f64;
    for pair in stations.windows(2) {
        let steps = pair[1].pose.position - pair[0].pose.position;
        assert!(steps.z.abs() < 0.65 * (pair[1].time_s - pair[0].time_s) + 0.02, "a jump of {} m", steps.z);
        for point in [pair[1].pose.position, pair[1].pose.apply(Run::over(&around, 1).mount.position)] {
            assert!(around.gap(point, 0.3) >= 0.3 - 1e-6, "{point}");
        }
        assert!((pair[1].pose.position.z - 1.2 - pair[1].moved_m).abs() < 1e-9);
        highest = highest.max(pair[1].pose.position.z);
    }
    assert!((2.2..2.6).contains(&highest), "{highest}");
    assert_eq!((stations[0].moved_m, stations[1199].moved_m), (0.0, 0.0));
}

#[test]
fn out_of_what_is_too_high_it_goes_aside() {
    let mut around = level();
    around.balls = vec![(DVec3::new(0.0, 0.0, 5.0), 12.0)];
    let hover = KINDS[4].replace("[1, 2, -40]", "[9, 1, 4]");
    let station = Run::over(&around, 1).stations(&hover)[0];
    assert!(around.gap(station.pose.position, 0.3) >= 0.3 - 1e-6);
    assert!((station.pose.position.z - 4.0).abs() < 1e-9 && station.moved_m < 6.0, "{station:?}");
    // Where there is no way out at its height, it goes up whatever it takes.
    around.balls = vec![(DVec3::new(9.0, 1.0, 5.0), 12.0)];
    let station = Run::over(&around, 1).stations(&hover)[0];
    assert!((17.3..17.6).contains(&station.pose.position.z), "{station:?}");
}

#[test]
fn views_see_a_target_at_the_range_and_near_the_axis() {
    let mut around = hilly();
    let mut seen = [0; 2];
    for pose in Run::over(&around, 60).poses(KINDS[3]) {
        let sonar = pose.then_inner(&Run::over(&around, 1).mount);
        let nearest = |k: usize| ((around.targets[k].centre - sonar.position).length() - 5.0).abs();
        let k = usize::from(nearest(1) < nearest(0));
        seen[k] += 1;
        assert!(nearest(k) < 0.1, "{}", nearest(k));
        let there = sonar.inverse().apply(around.targets[k].centre);
        let off_axis = degrees(atan2(there.y, there.x));
        assert!(off_axis.abs() < 22.0, "{off_axis}");
        assert!((there.z / there.length()).abs() < 0.08, "{there}");
    }
    assert!(seen[0] > 10 && seen[1] > 10, "{seen:?}");
    // Only views from the east are clear, so all are from the east.
    around.sees = |from, to| from.x > to.x;
    for pose in Run::over(&around, 40).poses(KINDS[3]) {
        assert!(pose.rotation.x_axis.x < 0.5, "{:?}", pose.rotation.x_axis);
    }
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let cases = [
        (KINDS[0].replace("radius_m: 4", "radius_m: 0"), "radius_m: 0 is not above 0"),
        (KINDS[0].replace("speed_m_s: 1", "speed_m_s: 0"), "speed_m_s: 0 is not above 0"),
        (KINDS[1].replace("lines: 4", "lines: 0"), "lines"),
        (KINDS[2].replace("turn_deg_s: 30", "turn_deg_s: -1"), "turn_deg_s: -1"),
        (KINDS[2].replace("[5, 0, 3]", "[5, 0, 1e9]"), "points_m: 1000000000 is not within 1000 km"),
        (
            "{waypoints: {points_m: [[0, 0, 0]], speed_m_s: 1, turn_deg_s: 1, least_speed_m_s: 0}}".into(),
            "1 points are no path",
        ),
        (KINDS[3].replace("range_m: 5", "range_m: -1"), "range_m"),
        (KINDS[4].replace("period_s: 60", "period_s: 0"), "drift.period_s"),
        (KINDS[5].replace("to_m: 2", "to_m: 0"), "to_m"),
        (KINDS[6].replace("smooth_m: 3", "smooth_m: 0"), "smooth_m"),
        (KINDS[6].replace("most_pitch_deg: 20", "most_pitch_deg: 95"), "most_pitch_deg"),
    ];
    for (text, expected) in cases {
        let error = read(&text).check().expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
    }
    let unknown = serde_json::from_str::<Trajectory>(r#"{"hover": {"position_m": [0, 0, 0], "yaw": 1}}"#);
    assert!(unknown.is_err());
    let endless = Vehicle { clear_m: f64::NAN, ..Vehicle::CALM };
    assert!(endless.validate().expect_err("no number").to_string().starts_with("clear_m"));
}
