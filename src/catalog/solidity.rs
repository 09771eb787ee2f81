//! What a mesh is like before it is used: how many triangles, closed or not, how much of it has which material.
//!
//! Knows nothing of files or labels.

use std::collections::BTreeMap;

use glam::Vec3;

use super::facts::MeshFacts;
use super::model::Model;

/// Facts of a model in its file's units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solidity {
    /// Triangles.
    pub triangles: u64,
    /// Whether every edge belongs to two triangles, vertices at one place being one.
    pub watertight: bool,
    /// Sides of the bounding box in the file's axes: y up.
    pub extent: Vec3,
    /// Area by name of the glTF material.
    pub areas: BTreeMap<String, f64>,
}

/// Looks at a model as it was loaded, unscaled.
#[must_use]
pub fn solidity(model: &Model) -> Solidity {
    let mut facts = Solidity::default();
    for part in &model.parts {
        let area = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|v| part.positions[v as usize]);
            0.5 * f64::from((b - a).cross(c - a).length())
        };
        *facts.areas.entry(part.material.clone()).or_default() += part.triangles.iter().map(area).sum::<f64>();
    }
    if let Some(mesh) = MeshFacts::of(model) {
        let size = mesh.extents();
        facts.extent = Vec3::new(size.x, size.z, size.y);
        (facts.triangles, facts.watertight) = (mesh.triangles, mesh.is_watertight());
    }
    facts
}

/// Turns of a surface that stand for a curve: less is flat, more is an edge of the thing itself, degrees.
const CURVED_DEG: [f64; 2] = [4.0, 50.0];

/// How far the flat facets of a model depart from the round shape that they stand for: a tenth of its surface departs by
/// more than this, in the model's units. None of what is meant to be flat or edged counts.
///
/// Two facets of width w that meet at an angle θ are chords of a circle: its arc stands off them by about w·θ/8.
#[must_use]
pub fn facet_error(triangles: impl Iterator<Item = [Vec3; 3]>) -> f64 {
    let mut vertices = Vertices::default();
    let mut edges: BTreeMap<(u32, u32), Vec<(Vec3, f64)>> = BTreeMap::new();
    for corners in triangles {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let twice = f64::from(normal.length());
        let numbers = corners.map(|p| vertices.number(p));
        for k in 0..3 {
            let (p, q) = (numbers[k], numbers[(k + 1) % 3]);
            let length = f64::from((corners[(k + 1) % 3] - corners[k]).length()).max(1e-12);
            edges.entry((p.min(q), p.max(q))).or_default().push((normal.normalize_or_zero(), twice / length));
        }
    }
    let mut departures: Vec<(f64, f64)> = Vec::new();
    for sides in edges.values() {
        let [(one, width), (other, breadth)] = sides[..] else { continue };
        let turn = crate::math::real::acos(f64::from(one.dot(other)).abs().min(1.0));
        let degrees = crate::math::real::degrees(turn);
        let wide = 0.5 * (width + breadth);
        let departs = if (CURVED_DEG[0]..CURVED_DEG[1]).contains(&degrees) { wide * turn / 8.0 } else { 0.0 };
        departures.push((departs, wide));
    }
    departures.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = departures.iter().map(|(_, weight)| weight).sum();
    let mut held = 0.0;
    let reached = departures.iter().find(|(_, weight)| {
        held += weight;
        held >= 0.9 * whole
    });
    reached.map_or(0.0, |(departs, _)| *departs)
}

/// Numbers of places.
#[derive(Default)]
struct Vertices(BTreeMap<[u32; 3], u32>);

impl Vertices {
    fn number(&mut self, place: Vec3) -> u32 {
        let next = self.0.len() as u32;
        // Adding zero turns −0 into +0, which is the same place.
        *self.0.entry((place + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::model::Part;

    #[test]
    fn coarse_cylinders_depart_from_round_ones_and_boxes_from_nothing() {
        let tube = |sides: usize| {
            let at = move |k: usize, z: f32| {
                let angle = std::f64::consts::TAU * k as f64 / sides as f64;
                Vec3::new(crate::math::real::cos(angle) as f32, crate::math::real::sin(angle) as f32, z)
            };
            (0..sides).flat_map(move |k| {
                [[at(k, 0.0), at(k + 1, 0.0), at(k + 1, 2.0)], [at(k, 0.0), at(k + 1, 2.0), at(k, 2.0)]]
            })
        };
        // Of a regular polygon in a circle of 1 m: 1 − cos(π/n).
        let error = facet_error(tube(12).collect::<Vec<_>>().into_iter());
        assert!((error / 0.0341 - 1.0).abs() < 0.2, "{error}");
        assert!(facet_error(tube(48).collect::<Vec<_>>().into_iter()) < 0.003);
        assert_eq!(facet_error(tube(4).collect::<Vec<_>>().into_iter()), 0.0, "a box");
    }

    #[test]
    fn a_tetrahedron_is_closed_until_a_face_is_gone() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z * 2.0];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let part = Part { positions, triangles, material: "steel".into(), ..Part::default() };
        let mut model = Model { parts: vec![part], ..Model::default() };
        let facts = solidity(&model);
        assert_eq!((facts.triangles, facts.watertight, facts.extent), (4, true, Vec3::new(1.0, 2.0, 1.0)));
        assert!((facts.areas["steel"] - (0.5 + 1.0 + 1.0 + 1.5)).abs() < 1e-6);
        model.parts[0].triangles.pop();
        assert!(!solidity(&model).watertight);
    }
}
