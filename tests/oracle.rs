//! Beam-plane visibility against an independent oracle: rays through a bounding volume hierarchy.

mod support;

use ensonify::catalog::Part;
use ensonify::math::Pose;
use ensonify::math::rng::Stream;
use ensonify::scene::bvh::Bvh;
use ensonify::scene::{AssetCache, EnvironmentSpec, Labels, Scene, SceneSpec, build};
use ensonify::sonar::{Bearing, Sonar, Tracer};
use glam::{DMat3, DVec3, Vec3};
use support::{Builder, cuboid, floor, looking, part, sonar, sphere};

/// How two ways of finding what is visible differ.
#[derive(Default)]
struct Difference {
    samples: usize,
    hits: usize,
    /// One hits where the other misses, or ranges differ by more than a millimetre.
    apart: usize,
    /// Those that rays a hair's breadth beside do not explain.
    unexplained: usize,
    worst_m: f64,
}

/// Scans a ping both ways and compares every sample.
fn compare(scene: &Scene, sonar: &Sonar, pose: &Pose) -> Difference {
    let mut tracer = Tracer::new(sonar);
    tracer.visibility.scan(scene, pose);
    let planes = &tracer.visibility.planes;
    // What lies beyond the last bin is not looked for.
    let oracle = Oracle { bvh: Bvh::of_scene(scene), pose, far: sonar.range_m[1] };
    let mut found = Difference::default();
    for plane in 0..planes.count() {
        for sample in 0..planes.samples() {
            let hit = tracer.visibility.hit(plane, sample).map(|hit| f64::from(hit.range_m));
            let ours = hit.filter(|range| *range <= oracle.far);
            let theirs = oracle.range(planes.azimuth_rad(plane), f64::from(planes.t[sample]));
            found.samples += 1;
            found.hits += usize::from(ours.is_some());
            if agree(ours, theirs) {
                if let (Some(a), Some(b)) = (ours, theirs) {
                    found.worst_m = found.worst_m.max((a - b).abs());
                }
                continue;
            }
            found.apart += 1;
            // At an edge both answers are right: a ray some microradians beside gives the other one.
            let beside = [-1.0, 0.0, 1.0].into_iter().flat_map(|a| [-1.0, 0.0, 1.0].map(|t| (a * 2e-6, t * 2e-6)));
            let explained = beside.into_iter().any(|(azimuth, t)| {
                agree(ours, oracle.range(planes.azimuth_rad(plane) + azimuth, f64::from(planes.t[sample]) + t))
            });
            found.unexplained += usize::from(!explained);
        }
    }
    found
}

fn agree(ours: Option<f64>, theirs: Option<f64>) -> bool {
    match (ours, theirs) {
        (None, None) => true,
        (Some(a), Some(b)) => (a - b).abs() <= 1e-3,
        _ => false,
    }
}

struct Oracle<'a> {
    bvh: Bvh,
    pose: &'a Pose,
    far: f64,
}

impl Oracle<'_> {
    /// Slant range of the first surface along a ray of the sonar's frame.
    fn range(&self, azimuth: f64, t: f64) -> Option<f64> {
        let direction = DVec3::new(azimuth.cos(), azimuth.sin(), t).normalize();
        self.bvh.closest(self.pose.position, self.pose.rotation * direction, self.far).map(|hit| hit.distance)
    }
}

#[test]
fn the_reference_scene_is_seen_as_rays_see_it() {
    let Some(path) = support::reference_scene() else { return };
    let environment = EnvironmentSpec {
        glb: Some(path.file_name().expect("a file").to_string_lossy().into_owned()),
        kind: None,
        labels: Labels::ByNode,
        sediment: "medium-sand".into(),
    };
    let spec = SceneSpec { environment: Some(environment), ..SceneSpec::default() };
    let assets = AssetCache::new(path.parent().expect("a folder"));
    let scene = build(&spec, &assets, 1, 0).expect("the reference scene is built").scene;
    assert_eq!(scene.bodies.len(), 20);
    let sonar = Sonar { elevation_deg: 20.0, elevations: 667, ..sonar(512, 130.0, [0.5, 30.0], 1024) };
    let found = compare(&scene, &sonar, &looking([-28.0, 0.0, 3.1146], 0.0, -15.0));
    println!(
        "{} samples, {} hits, {} apart, {} unexplained, worst {:.6} m",
        found.samples, found.hits, found.apart, found.unexplained, found.worst_m
    );
    assert!(found.hits > 200_000, "the scene is in view");
    assert!((found.apart as f64) < 1e-4 * found.samples as f64, "{} of {} differ", found.apart, found.samples);
    assert_eq!(found.unexplained, 0);
}

#[test]
fn two_hundred_random_scenes_are_seen_as_rays_see_them() {
    let mut all = Difference::default();
    for number in 0..200 {
        let mut draw = Stream::at(11, "oracle", number, "scene");
        let (scene, sonar, pose) = random_scene(&mut draw);
        let found = compare(&scene, &sonar, &pose);
        assert_eq!(found.unexplained, 0, "scene {number}: {} apart", found.apart);
        all.samples += found.samples;
        all.hits += found.hits;
        all.apart += found.apart;
        all.worst_m = all.worst_m.max(found.worst_m);
    }
    println!("{} samples, {} hits, {} apart, worst {:.6} m", all.samples, all.hits, all.apart, all.worst_m);
    assert!(all.hits > all.samples / 10, "something is in view");
    assert!((all.apart as f64) < 1e-4 * all.samples as f64, "{} of {} differ", all.apart, all.samples);
}

/// Boxes, balls, loose triangles and a floor all around the sonar, behind it and above it too.
fn random_scene(draw: &mut Stream) -> (Scene, Sonar, Pose) {
    let mut builder = Builder::new();
    let mut point = |reach: f64| {
        Vec3::new(
            draw.uniform(-reach, reach) as f32,
            draw.uniform(-reach, reach) as f32,
            draw.uniform(-0.4 * reach, 0.4 * reach) as f32,
        )
    };
    for _ in 0..4 {
        let low = point(8.0);
        builder = builder.body(cuboid(low, low + (point(1.0).abs() + Vec3::splat(0.1))));
        builder = builder.body(sphere(point(8.0), 0.2 + point(0.6).x.abs(), 12));
    }
    let loose: Vec<Vec3> = (0..60).map(|_| point(9.0)).collect();
    builder = builder.background(part(loose, (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()));
    builder = builder.background(floor(50.0, -3.0));
    let sonar = Sonar {
        elevation_deg: draw.uniform(10.0, 70.0),
        elevations: 90,
        bearing: Bearing::Azimuth,
        ..sonar(48, draw.uniform(30.0, 165.0), [0.2, 40.0], 64)
    };
    let place = DVec3::new(draw.uniform(-3.0, 3.0), draw.uniform(-3.0, 3.0), draw.uniform(-2.0, 2.0));
    let pose = Pose::from_angles(place, draw.uniform(-3.1, 3.1), draw.uniform(-0.8, 0.8), draw.uniform(-0.5, 0.5));
    (builder.scene(), sonar, pose)
}

#[test]
fn an_instance_is_its_mesh_moved() {
    let pose = looking([0.0, 0.0, 0.0], 0.0, 0.0);
    let sonar = sonar(64, 60.0, [0.5, 20.0], 256);
    let ball = sphere(Vec3::ZERO, 0.5, 24);
    let moved = Part {
        positions: ball.positions.iter().map(|p| 2.0 * *p + Vec3::new(6.0, 1.0, 0.5)).collect(),
        ..ball.clone()
    };
    let mut scene = Builder::new().body(ball).scene();
    scene.instances[0].world_from_mesh =
        glam::DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(2.0)), translation: DVec3::new(6.0, 1.0, 0.5) };
    let by_instance = ensonify::sonar::trace(&scene, &sonar, &pose);
    let by_mesh = ensonify::sonar::trace(&Builder::new().body(moved).scene(), &sonar, &pose);
    let total: f32 = by_mesh.energy.iter().sum();
    let apart: f32 = by_mesh.energy.iter().zip(&by_instance.energy).map(|(a, b)| (a - b).abs()).sum();
    assert!(total > 0.0 && apart < 1e-3 * total, "{apart} of {total}");
}
