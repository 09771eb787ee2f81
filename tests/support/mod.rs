//! What the integration tests share: the reference material where it is at hand, simple solids, simple sonars.
#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod cli;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ensonify::catalog::Part;
use ensonify::math::Pose;
use ensonify::scene::{Body, Instance, Material, Mesh, Scene};
use ensonify::sonar::{Bearing, Mount, Sonar};
use glam::{DAffine3, DVec3, Vec3};

/// A file of the reference material that lies beside the repository, or `None` with a message that the test is skipped.
pub fn shared(relative: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(relative);
    if !path.exists() {
        println!("skipped: the reference material `{relative}` is not beside this checkout");
        return None;
    }
    Some(path)
}

/// All rows of the published reference values, or `None` (skipped).
pub fn reference_table() -> Option<Vec<serde_json::Value>> {
    let text = std::fs::read_to_string(shared("physics/reference.json")?).expect("readable");
    let mut all: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let serde_json::Value::Array(rows) = all["rows"].take() else { panic!("rows") };
    assert!(!rows.is_empty(), "no rows");
    Some(rows)
}

/// The rows of one group of the published reference values, or `None` (skipped).
pub fn reference_rows(group: &str) -> Option<Vec<serde_json::Value>> {
    let rows: Vec<_> = reference_table()?.into_iter().filter(|row| row["group"] == group).collect();
    assert!(!rows.is_empty(), "no rows of group {group}");
    Some(rows)
}

/// The reference scene of 1.4 million triangles, or `None` with a message that says how to make it.
pub fn reference_scene() -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("out/reference/s1m/scene.glb");
    if !path.exists() {
        println!("skipped: no reference scene; make it with `python3 ../shared/bench/scene.py --out out/reference`");
        return None;
    }
    Some(path)
}

/// An ideal sonar: even vertical pattern, level mount.
pub fn sonar(beams: u32, azimuth_deg: f64, range_m: [f64; 2], range_bins: u32) -> Sonar {
    Sonar {
        device: None,
        source: None,
        beams,
        azimuth_deg,
        beam_width_deg: 0.5,
        elevation_deg: 40.0,
        vertical_beam_deg: None,
        elevations: 801,
        range_m,
        range_bins,
        bearing: Bearing::Azimuth,
        frequency_khz: 900.0,
        bandwidth_khz: 75.0,
        source_level_db: 210.0,
        directivity_db: 30.0,
        yaw_rate_deg_s: 0.0,
        mount: Mount { position_m: [0.0; 3], yaw_deg: 0.0, pitch_deg: 0.0, roll_deg: 0.0 },
    }
}

/// A scene under construction; Lambert coefficient 1 everywhere, so that energies are those of the tables.
#[derive(Default)]
pub struct Builder(Scene);

impl Builder {
    pub fn new() -> Self {
        let materials = vec![Material::lambert("unit", 1.0)];
        Self(Scene { materials, ..Scene::default() })
    }

    /// Adds a labelled body.
    pub fn body(self, part: Part) -> Self {
        let number = self.0.bodies.len() as u16 + 1;
        let mut this = self.add(part, number);
        let body = Body { label: format!("body-{number}"), asset: String::new(), centre: DVec3::ZERO, radius: 1.0 };
        this.0.bodies.push(body);
        this
    }

    /// Adds unlabelled background.
    pub fn background(self, part: Part) -> Self {
        self.add(part, 0)
    }

    fn add(mut self, part: Part, body: u16) -> Self {
        self.0.instances.push(Instance {
            mesh: Arc::new(Mesh::from_parts(&[part])),
            world_from_mesh: DAffine3::IDENTITY,
            body,
            materials: vec![0],
        });
        self
    }

    pub fn scene(self) -> Scene {
        self.0
    }
}

/// A part from loose vertices and triangles.
pub fn part(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Part {
    Part { positions, triangles, ..Part::default() }
}

/// A sphere of `rings` × 2 `rings` quads.
pub fn sphere(centre: Vec3, radius: f32, rings: u32) -> Part {
    let segments = 2 * rings;
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for ring in 0..=rings {
        let polar = std::f32::consts::PI * ring as f32 / rings as f32;
        for segment in 0..segments {
            let around = std::f32::consts::TAU * segment as f32 / segments as f32;
            let direction = Vec3::new(polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos());
            positions.push(centre + radius * direction);
        }
    }
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let [a, b] = [ring * segments + segment, ring * segments + next];
            let [c, d] = [a + segments, b + segments];
            triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    part(positions, triangles)
}

/// An axis-aligned box.
pub fn cuboid(low: Vec3, high: Vec3) -> Part {
    let corner = |i: u32| {
        let pick = |bit: u32, axis: usize| if i & bit == 0 { low[axis] } else { high[axis] };
        Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    part((0..8).map(corner).collect(), triangles)
}

/// A level square of side `2 · half` at height `z`, two triangles.
pub fn floor(half: f32, z: f32) -> Part {
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    part(corners.map(|[x, y]| Vec3::new(x, y, z)).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

/// A pose without roll; degrees, pitch up positive.
pub fn looking(position: [f64; 3], yaw_deg: f64, pitch_deg: f64) -> Pose {
    Pose::from_angles(DVec3::from_array(position), yaw_deg.to_radians(), pitch_deg.to_radians(), 0.0)
}
