//! A YAML recipe becomes a labelled sonar dataset: thousands of forward-looking sonar images with masks, boxes and COCO
//! annotations, byte for byte the same on every machine.
//!
//! ```text
//! recipe ──► plan ──► scene ──► sonar ──► image ──► label ──► store ──► export / view
//!  YAML      jobs     meshes    echoes    pixels    masks     files      COCO, sheets
//! ```
//!
//! A stage takes its left neighbour's output and its own parameters, and never sees the recipe or the job. Labels are made
//! from noise-free echoes, so noise cannot reach them. Most users want the program; the library serves those who want one
//! stage of it:
//!
//! ```
//! use std::sync::Arc;
//!
//! use ensonify::catalog::Part;
//! use ensonify::math::Pose;
//! use ensonify::recipe::{Origin, parse};
//! use ensonify::scene::{Body, Instance, Material, Mesh, Scene};
//! use ensonify::sonar::{Sonar, trace};
//! use glam::{DAffine3, DVec3, Vec3};
//!
//! // A plate of half a metre, five metres ahead of the sonar.
//! let corners = [[-0.25, -0.25], [0.25, -0.25], [0.25, 0.25], [-0.25, 0.25]];
//! let positions = corners.map(|[y, z]| Vec3::new(5.0, y, z)).to_vec();
//! let plate = Mesh::from_parts(&[Part { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Part::default() }]);
//! let scene = Scene {
//!     instances: vec![Instance {
//!         mesh: Arc::new(plate),
//!         world_from_mesh: DAffine3::IDENTITY,
//!         body: 1,
//!         materials: vec![0],
//!     }],
//!     materials: vec![Material::lambert("steel", 0.2)],
//!     bodies: vec![Body { label: "plate".into(), asset: "plate".into(), centre: DVec3::X * 5.0, radius: 0.36 }],
//!     ..Scene::default()
//! };
//! let text = "{beams: 64, azimuth_deg: 60, elevation_deg: 20, vertical_beam_deg: 20, elevations: 200, range_m: [1, 10],
//!   range_bins: 450, bearing: cone, beam_width_deg: 1, frequency_khz: 900, bandwidth_khz: 100, source_level_db: 210,
//!   directivity_db: 30, yaw_rate_deg_s: 0, mount: {position_m: [0, 0, 0], yaw_deg: 0, pitch_deg: 0, roll_deg: 0}}";
//! let sonar: Sonar = parse("sonar", text, Origin::Given)?.to("sonar")?;
//! let echoes = trace(&scene, &sonar, &Pose::IDENTITY);
//! let nearest = echoes.bodies.iter().map(|echo| echo.cell % 450).min();
//! assert_eq!(nearest, Some(200)); // (5 m − 1 m) in bins of 2 cm
//! # Ok::<(), ensonify::recipe::Error>(())
//! ```
//!
//! The floors, from the ground up; a module imports only from floors below its own: `math` · `physics`, `recipe` ·
//! `catalog`, `vehicle` · `scene` · `sonar` · `image`, `label` · `store`, `plan` · `export`, `view`, `realism`,
//! `run` · `draft` · `cli`.

pub mod recipe;

pub mod plan;

pub mod catalog;
pub mod scene;
pub mod vehicle;

pub mod sonar;

pub mod image;

pub mod label;

pub mod store;

pub mod draft;
pub mod export;
pub mod realism;
pub mod run;
pub mod view;

pub mod cli;

pub mod math;
pub mod physics;
