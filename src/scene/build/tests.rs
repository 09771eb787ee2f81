//! Whole scenes from a small catalog.

use std::fs;
use std::time::Instant;

use glam::DVec3;
use serde_json::json;
use tempfile::TempDir;

use super::*;
use crate::catalog::glb::tests::{cube, glb, shared, tire};
use crate::scene::Instance;
use crate::scene::environment::Labels;
use crate::scene::placement::PoseSpec;

/// A recipe folder with the catalog `things`: a tire of 0.6 m and a crate of 0.8 m.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let things = folder.path().join("things");
    fs::create_dir(&things).expect("a folder");
    fs::write(things.join("tire.glb"), glb(&tire(0.6, 0.1), json!([{"mesh": 0}]), |_| ())).expect("write");
    fs::write(things.join("crate.glb"), glb(&cube(), json!([{"mesh": 0, "scale": [2.0, 1.0, 1.0]}]), |_| ()))
        .expect("write");
    let rows = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n\
                tire,Tire,tire,,tire.glb,0.6,y,rubber,CC0,n,s\ncrate,Crate,crate,,crate.glb,0.8,y,wood,CC0,n,s\n";
    fs::write(things.join("catalog.csv"), rows).expect("write");
    folder
}

fn read(text: &str) -> SceneSpec {
    serde_json::from_value(serde_yaml::from_str(text).expect("YAML")).expect(text)
}

/// Bodies at rest within a disc, every second one tipped onto its side.
fn crowd(count: usize, within: f64, burial: f64) -> SceneSpec {
    let mut spec = read(
        "{seabed: {shape: {fractal: {rms_m: 0.08, longest_m: 6, shortest_m: 0.3, hurst: 0.8}}, sediment: silt, \
          extent_m: 20, cell_m: 0.1}, bodies: []}",
    );
    for k in 0..count {
        let uid = ["tire", "crate"][k % 2];
        spec.bodies.push(BodySpec {
            label: uid.into(),
            catalog: "things".into(),
            uid: uid.into(),
            pose: PoseSpec::Rest(crate::scene::Rest {
                yaw_deg: 37.0 * k as f64,
                tip_deg: if k % 4 < 2 { 0.0 } else { 90.0 },
                burial,
                within_m: within,
                centre_m: [0.0; 2],
            }),
            clear_m: 0.05,
            tries: 200,
            on_failure: OnFailure::Drop,
            in_view: None,
            item: k as u32,
            instance: 0,
        });
    }
    spec
}

fn vertices(instance: &Instance) -> Vec<DVec3> {
    instance.mesh.vertices().map(|v| instance.world_from_mesh.transform_point3(v.as_dvec3())).collect()
}

fn lowest_clearance(built: &Built, instance: &Instance) -> f64 {
    vertices(instance).iter().map(|v| v.z - built.ground.height(v.x, v.y)).fold(f64::INFINITY, f64::min)
}

#[test]
fn bodies_touch_the_ground_and_never_each_other() {
    let folder = folder();
    let assets = AssetCache::new(folder.path());
    let spec = crowd(12, 3.0, 0.0);
    let (mut dropped, mut placed) = (0, 0);
    for scene_index in 0..50 {
        let built = build(&spec, &assets, 7, scene_index).expect("a scene");
        assert_eq!(built.scene.bodies.len() + built.dropped.len(), 12);
        (dropped, placed) = (dropped + built.dropped.len(), placed + built.scene.bodies.len());
        let bodies: Vec<&Instance> = built.scene.instances.iter().filter(|instance| instance.body > 0).collect();
        for (k, instance) in bodies.iter().enumerate() {
            let clearance = lowest_clearance(&built, instance);
            // A face may lie on a crest between its corners.
            assert!((-1e-3..0.05).contains(&clearance), "scene {scene_index}, body {k}: {clearance}");
            let body = &built.scene.bodies[usize::from(instance.body) - 1];
            assert!((body.centre.truncate()).length() < 3.0 + body.radius);
            for other in &bodies[..k] {
                assert!(gap(&vertices(instance), &vertices(other)) > 0.0, "scene {scene_index}: {k} touches another");
            }
        }
    }
    assert!(placed > 550, "{placed} placed, {dropped} dropped");
}

/// Widest gap in plan between two point sets over 180 directions: a separating line's width.
fn gap(a: &[DVec3], b: &[DVec3]) -> f64 {
    let range = |points: &[DVec3], direction: DVec3| {
        points.iter().map(|p| p.dot(direction)).fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)))
    };
    (0..180)
        .map(|degree| {
            let angle = crate::math::real::radians(f64::from(degree));
            let direction = DVec3::new(crate::math::real::cos(angle), crate::math::real::sin(angle), 0.0);
            let ((a0, a1), (b0, b1)) = (range(a, direction), range(b, direction));
            (b0 - a1).max(a0 - b1)
        })
        .fold(f64::MIN, f64::max)
}

#[test]
fn a_crowd_is_thinned_out_loud() {
    let folder = folder();
    let assets = AssetCache::new(folder.path());
    let built = build(&crowd(30, 1.0, 0.0), &assets, 1, 0).expect("a scene");
    assert!(built.dropped.len() >= 15, "{}", built.dropped.len());
    assert_eq!(built.dropped.len() + built.scene.bodies.len(), 30);
    assert!(built.dropped[0].asset.starts_with("things/") && built.dropped[0].reason.contains("200 tries"));
}

#[test]
fn burial_sinks_a_share_of_the_height() {
    let folder = folder();
    let assets = AssetCache::new(folder.path());
    let mut spec = crowd(1, 0.0, 0.25);
    spec.seabed.as_mut().expect("a seabed").shape = crate::scene::seabed::Shape::Flat(Default::default());
    let built = build(&spec, &assets, 1, 0).expect("a scene");
    let clearance = lowest_clearance(&built, &built.scene.instances[1]);
    // The tire lies flat and is 0.2 m high.
    assert!((clearance + 0.05).abs() < 1e-5, "{clearance}");
}

#[test]
fn the_same_seed_builds_the_same_scene() {
    let folder = folder();
    let spec = crowd(6, 4.0, 0.1);
    let transforms = |seed: u64, index: u64| {
        let built = build(&spec, &AssetCache::new(folder.path()), seed, index).expect("a scene");
        built.scene.instances.iter().map(|i| i.world_from_mesh.to_cols_array().map(f64::to_bits)).collect::<Vec<_>>()
    };
    assert_eq!(transforms(3, 1), transforms(3, 1));
    assert_ne!(transforms(3, 1), transforms(3, 2));
    assert_ne!(transforms(3, 1), transforms(4, 1));
}

#[test]
fn given_poses_hold_and_materials_follow() {
    let folder = folder();
    let spec = read(
        "{bodies: [{label: tyre, catalog: things, uid: tire, \
          pose: {at: {position_m: [1, 2, 0.5], yaw_deg: 90, pitch_deg: 0, roll_deg: 0}}, clear_m: 0, tries: 1, \
          on_failure: drop, item: 0, instance: 0}]}",
    );
    let built = build(&spec, &AssetCache::new(folder.path()), 1, 0).expect("a scene");
    let body = &built.scene.bodies[0];
    assert_eq!((body.label.as_str(), body.asset.as_str()), ("tyre", "things/tire"));
    assert!((body.centre - DVec3::new(1.0, 2.0, 0.6)).length() < 1e-5, "{}", body.centre);
    assert_eq!(built.scene.materials[0].name, "rubber");
    assert_eq!(built.ground.height(3.0, 4.0), 0.0);
}

#[test]
fn what_cannot_be_built_says_what_and_where() {
    let folder = folder();
    let assets = AssetCache::new(folder.path());
    let error = |edit: &dyn Fn(&mut SceneSpec)| {
        let mut spec = crowd(2, 1.0, 0.0);
        edit(&mut spec);
        build(&spec, &assets, 1, 0).expect_err("wrong").to_string()
    };
    assert!(error(&|s| s.bodies[1].uid = "crte".into()).contains("did you mean `crate`"));
    assert!(error(&|s| s.bodies[1].catalog = "thongs".into()).contains("no catalog `thongs`"));
    assert!(error(&|s| s.seabed.as_mut().expect("a seabed").sediment = "sult".into()).contains("did you mean `silt`"));
    let sunk = error(&|s| s.bodies[1] = crowd(2, 1.0, 1.5).bodies[1].clone());
    assert!(sunk.contains("bodies[1] (crate): burial is 1.5"), "{sunk}");
}

#[test]
fn bodies_rest_on_an_environment() {
    let folder = folder();
    // A slab 20 m wide whose top lies at z = 1.
    let slab = json!([{"name": "seabed", "mesh": 0, "scale": [20.0, 2.0, 20.0]}, {"name": "mine_3", "mesh": 0, "translation": [8.0, 1.5, 0.0]}]);
    fs::write(folder.path().join("world.glb"), glb(&cube(), slab, |_| ())).expect("write");
    let mut spec = crowd(4, 4.0, 0.0);
    spec.seabed = None;
    let (glb, labels) = (Some("world.glb".into()), Labels::ByNode);
    spec.environment = Some(EnvironmentSpec { glb, kind: None, labels, sediment: "gravel".into() });
    let built = build(&spec, &AssetCache::new(folder.path()), 2, 0).expect("a scene");
    assert_eq!(built.scene.bodies.len(), 5);
    assert_eq!((built.scene.bodies[0].label.as_str(), built.scene.instances[0].body), ("mine", 0));
    assert_eq!(built.scene.materials[0].name, "gravel");
    for instance in built.scene.instances.iter().filter(|instance| instance.body > 1) {
        assert!((-1e-3..0.05).contains(&lowest_clearance(&built, instance)));
        assert!(vertices(instance).iter().all(|v| v.z > 0.999));
    }
    assert!((built.ground.height(0.3, 0.2) - 1.0).abs() < 1e-4);
    assert_eq!(built.ground.height(50.0, 0.0), 0.0);
}

#[test]
fn shared_models_rest_on_ripples() {
    let Some(models) = shared("models") else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut rows = String::from("uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n");
    let names = ["k_car_tire", "q_shark", "l_chain", "d_torpedo_mk46", "s_rock", "q_ladder", "l_scuba_tank"];
    for name in names {
        fs::copy(models.join(format!("{name}.glb")), folder.path().join(format!("{name}.glb"))).expect("copy");
        rows += &format!("{name},{name},{name},,{name}.glb,1.2,y,,l,a,s\n");
    }
    fs::write(folder.path().join("catalog.csv"), rows).expect("write");
    let mut spec = read(
        "{seabed: {shape: {ripples: {wavelength_m: 0.4, height_m: 0.05, direction_deg: 20, irregularity: 0.4, \
          rms_m: 0.02}}, sediment: medium-sand, extent_m: 40, cell_m: 0.08}, bodies: []}",
    );
    spec.bodies = names
        .map(|name| BodySpec { uid: name.into(), catalog: ".".into(), ..crowd(1, 8.0, 0.0).bodies[0].clone() })
        .to_vec();
    spec.bodies.iter_mut().zip(0..).for_each(|(body, item)| body.item = item);
    let assets = AssetCache::new(folder.path());
    spec.check(&assets).expect("sound");
    let start = Instant::now();
    let built = build(&spec, &assets, 5, 0).expect("a scene");
    println!("40 m of ripples at 0.08 m with 7 models: {:?}", start.elapsed());
    assert!(built.dropped.is_empty());
    assert_eq!(built.scene.instances[0].mesh.triangle_count, 500_000);
    for instance in built.scene.instances.iter().filter(|instance| instance.body > 0) {
        assert!((-1e-3..0.05).contains(&lowest_clearance(&built, instance)));
    }
}

#[test]
fn views_of_a_built_scene_see_their_target_first() {
    use crate::math::Pose;
    use crate::scene::Bvh;
    use crate::vehicle::{FrameOfRun, Surroundings, Target, Trajectory, Vehicle, Voyage};

    struct Around<'a>(&'a Built, &'a Bvh, &'a [Target]);
    impl Surroundings for Around<'_> {
        fn ground(&self, x: f64, y: f64) -> f64 {
            self.0.ground.height(x, y)
        }
        fn targets(&self) -> &[Target] {
            self.2
        }
        fn sees(&self, from: DVec3, to: DVec3) -> bool {
            self.1.is_clear(from, to)
        }
        fn floor(&self, point: DVec3) -> f64 {
            self.0.ground.floor(point)
        }
        fn gap(&self, point: DVec3, within: f64) -> f64 {
            self.1.gap(point, within)
        }
    }

    let folder = folder();
    let mut spec = crowd(8, 2.5, 0.0);
    // Crates only: their middles are solid.
    spec.bodies.retain(|body| body.uid == "crate");
    let built = build(&spec, &AssetCache::new(folder.path()), 11, 0).expect("a scene");
    let bvh = Bvh::of_scene(&built.scene);
    let bodies = built.scene.bodies.iter();
    let targets: Vec<Target> = bodies.map(|body| Target { centre: body.centre, radius_m: body.radius }).collect();
    let mount = Pose::from_angles(DVec3::new(0.3, 0.0, 0.1), 0.0, -0.3, 0.0);
    let around = Around(&built, &bvh, &targets);
    let scene_stream = |purpose: &str| Stream::at(1, "scene", 0, purpose);
    let views: Trajectory =
        serde_json::from_value(json!({"views": {"range_m": 4.0, "altitude_m": 1.2, "off_axis_deg": 0.0}}))
            .expect("views");
    for index in 0..60 {
        let mut stream = Stream::at(1, "frame", index, "trajectory");
        let frame = FrameOfRun { index, count: 60 };
        let (vehicle, scene_stream) = (&Vehicle::CALM, &scene_stream);
        let voyage = Voyage { frame, vehicle, mount: &mount, around: &around, scene_stream, track: None };
        let sonar = views.station(&voyage, &mut stream).pose.then_inner(&mount);
        let hit = bvh.closest(sonar.position, sonar.rotation.x_axis, 10.0).expect("something ahead");
        let body = built.scene.instances[hit.instance as usize].body;
        assert!(body > 0, "frame {index} looks at the ground");
        let target = &built.scene.bodies[usize::from(body) - 1];
        assert!(((target.centre - sonar.position).length() - 4.0).abs() < 0.05, "frame {index}");
    }
}
