//! The scene that benchmarks look at: the reference scene where it has been made (CONTRIBUTING.md), else a fractal seabed
//! of a million triangles.
#![allow(dead_code, reason = "each benchmark uses its own part")]

use std::path::Path;

use ensonify::math::Pose;
use ensonify::math::real::radians;
use ensonify::scene::{AssetCache, EnvironmentSpec, Labels, Scene, SceneSpec, SeabedSpec, build};
use ensonify::sonar::{Bearing, Mount, Sonar};
use glam::DVec3;

/// The scene, and world_from_sonar.
pub fn scene() -> (Scene, Pose) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let glb = "out/reference/s1m/scene.glb";
    let spec = if root.join(glb).exists() {
        let environment = EnvironmentSpec {
            glb: Some(glb.into()),
            kind: None,
            labels: Labels::ByNode,
            sediment: "medium-sand".into(),
        };
        SceneSpec { environment: Some(environment), ..SceneSpec::default() }
    } else {
        eprintln!("no {glb}: measured on a fractal seabed instead");
        let shape = serde_json::json!({"fractal": {"rms_m": 0.2, "longest_m": 15.0, "shortest_m": 0.2, "hurst": 0.8}});
        let shape = serde_json::from_value(shape).expect("a fractal");
        let seabed = SeabedSpec {
            shape,
            sediment: "medium-sand".into(),
            extent_m: 60.0,
            cell_m: 0.085,
            fine_m: None,
            patches: Vec::new(),
        };
        SceneSpec { seabed: Some(seabed), ..SceneSpec::default() }
    };
    let built = build(&spec, &AssetCache::new(root), 1, 0).expect("the scene can be built");
    let pose = Pose::from_angles(DVec3::new(-28.0, 0.0, 3.1146), 0.0, radians(-15.0), 0.0);
    (built.scene, pose)
}

/// 512 beams over 130°, 667 elevations over 20°, 0.5–30 m in 1024 bins.
pub fn sonar(bearing: Bearing) -> Sonar {
    Sonar {
        device: None,
        source: None,
        beams: 512,
        azimuth_deg: 130.0,
        beam_width_deg: 0.6,
        elevation_deg: 20.0,
        vertical_beam_deg: Some(20.0),
        elevations: 667,
        range_m: [0.5, 30.0],
        range_bins: 1024,
        bearing,
        frequency_khz: 900.0,
        bandwidth_khz: 100.0,
        source_level_db: 210.0,
        directivity_db: 30.0,
        yaw_rate_deg_s: 0.0,
        mount: Mount { position_m: [0.0; 3], yaw_deg: 0.0, pitch_deg: 0.0, roll_deg: 0.0 },
    }
}
