//! What a mesh is like before it is used: how many triangles, closed or not, how much of it has which material.
//!
//! Knows nothing of files or labels.

use std::collections::BTreeMap;

use glam::Vec3;

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
    let (low, high) = model.bounds().unwrap_or_default();
    let size = high - low;
    let mut facts = Solidity { extent: Vec3::new(size.x, size.z, size.y), ..Solidity::default() };
    let mut vertices = Vertices::default();
    let mut edges: Vec<(u32, u32)> = Vec::new();
    for part in &model.parts {
        let mut area = 0.0;
        for corners in &part.triangles {
            let [a, b, c] = corners.map(|v| part.positions[v as usize]);
            area += 0.5 * f64::from((b - a).cross(c - a).length());
            let [a, b, c] = [a, b, c].map(|p| vertices.number(p));
            edges.extend([(a, b), (b, c), (c, a)].map(|(p, q)| (p.min(q), p.max(q))));
        }
        facts.triangles += part.triangles.len() as u64;
        *facts.areas.entry(part.material.clone()).or_default() += area;
    }
    edges.sort_unstable();
    facts.watertight = !edges.is_empty() && edges.chunk_by(|a, b| a == b).all(|same| same.len() == 2);
    facts
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
    fn a_tetrahedron_is_closed_until_a_face_is_gone() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z * 2.0];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let part = Part { positions, triangles, material: "steel".into(), ..Part::default() };
        let mut model = Model { parts: vec![part] };
        let facts = solidity(&model);
        assert_eq!((facts.triangles, facts.watertight, facts.extent), (4, true, Vec3::new(1.0, 2.0, 1.0)));
        assert!((facts.areas["steel"] - (0.5 + 1.0 + 1.0 + 1.5)).abs() < 1e-6);
        model.parts[0].triangles.pop();
        assert!(!solidity(&model).watertight);
    }
}
