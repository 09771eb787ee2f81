//! Plain bodies that sonars are tried on: cylinder, sphere, cube, cone.

use glam::DVec3;

use super::curve::{arc, rounded_rectangle};
use super::object::{Material, Object, Part};
use super::shape::{capped, icosphere, lathe, tube};
use super::solid::Axis;

pub fn all() -> Vec<Object> {
    vec![steel_cylinder(), sphere(), cube(), cone()]
}

/// A steel cylinder, 0.5 × 1.5 m, its edges bevelled, lying.
fn steel_cylinder() -> Object {
    let profile =
        [[0.0, 0.0], [0.235, 0.0], [0.25, 0.015], [0.25, 0.5], [0.25, 1.0], [0.25, 1.485], [0.235, 1.5], [0.0, 1.5]];
    Object {
        uid: "cylinder",
        name: "steel cylinder, 0.5 m × 1.5 m",
        label: "cylinder",
        tags: "target;calibration;test target;exercise target;shape",
        parts: vec![Part::new("cylinder", Material::Steel, [lathe(&profile, 56).turned(Axis::Y, 90.0)])],
    }
}

/// A steel sphere, 0.38 m across.
fn sphere() -> Object {
    Object {
        uid: "sphere",
        name: "steel sphere, 0.38 m",
        label: "sphere",
        tags: "calibration sphere;target;calibration;test target;ball;shape",
        parts: vec![Part::new("sphere", Material::Steel, [icosphere(12).mapped(|p| p * 0.19)])],
    }
}

/// A concrete cube, 0.5 m, with a lifting eye of reinforcing steel.
fn cube() -> Object {
    let level = |width: f64, z: f64| -> Vec<DVec3> {
        rounded_rectangle(width, width, 0.014, 2).into_iter().map(|[x, y]| DVec3::new(x, y, z)).collect()
    };
    let block =
        capped(&[level(0.48, 0.0), level(0.50, 0.010), level(0.50, 0.25), level(0.50, 0.49), level(0.48, 0.50)]);
    let mut eye = vec![DVec3::new(0.055, 0.0, 0.46)];
    eye.extend(arc([0.0, 0.53], 0.055, [0.0, 180.0], 12).into_iter().map(|[x, z]| DVec3::new(x, 0.0, z)));
    eye.push(DVec3::new(-0.055, 0.0, 0.46));
    Object {
        uid: "cube",
        name: "concrete cube, 0.5 m",
        label: "cube",
        tags: "target;calibration;test target;shape",
        parts: vec![
            Part::new("cube", Material::Concrete, [block]),
            Part::new("eye", Material::Steel, [tube(&eye, 0.008, 8)]),
        ],
    }
}

/// A steel cone, 0.5 m across and 0.6 m high, upright.
fn cone() -> Object {
    let profile = [[0.0, 0.0], [0.24, 0.0], [0.25, 0.010], [0.17, 0.205], [0.09, 0.40], [0.012, 0.592], [0.0, 0.6]];
    Object {
        uid: "cone",
        name: "steel cone, 0.5 m × 0.6 m",
        label: "cone",
        tags: "target;calibration;test target;shape",
        parts: vec![Part::new("cone", Material::Steel, [lathe(&profile, 56)])],
    }
}
