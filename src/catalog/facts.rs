//! What an index says of a model's mesh: how large, how fine, closed or open, of which materials.
//!
//! Knows nothing of files; lengths are those of the model, whatever its unit.

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};

use super::model::Model;

/// Corners closer than this part of the longest side are one.
const WELD: f64 = 1e-6;

/// A mesh in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFacts {
    /// Triangles that have an area.
    pub triangles: u64,
    /// Different corners, those of neighbouring triangles welded.
    pub corners: u64,
    /// Edges that do not lie between exactly two triangles; 0 for a watertight mesh.
    pub open_edges: u64,
    /// Lowest corner of the bounding box, from the model's origin; z is up.
    pub low: Vec3,
    /// Highest corner of the bounding box.
    pub high: Vec3,
    /// Longest edge.
    pub longest_edge: f64,
    /// Edge length that half of the edges exceed.
    pub median_edge: f64,
    /// Surface, in squares of the unit.
    pub area: f64,
    /// Volume that the triangles enclose, in cubes of the unit: meaningful if watertight, negative if inside out.
    pub volume: f64,
    /// Names of the materials, sorted; parts without one do not count.
    pub materials: Vec<String>,
}

impl MeshFacts {
    /// Measures a model; `None` for one without triangles.
    #[must_use]
    pub fn of(model: &Model) -> Option<Self> {
        let (low, high) = model.bounds()?;
        let corners = Corners::of(model, low, f64::from((high - low).max_element()) * WELD);
        let edges = corners.edges();
        let mut lengths: Vec<f64> = edges.iter().map(|(edge, _)| corners.length(*edge)).collect();
        lengths.sort_unstable_by(f64::total_cmp);
        let materials: BTreeSet<&str> = model.parts.iter().map(|part| part.material.as_str()).collect();
        Some(Self {
            triangles: corners.triangles.len() as u64,
            corners: corners.positions.len() as u64,
            open_edges: edges.iter().filter(|(_, faces)| *faces != 2).count() as u64,
            low,
            high,
            longest_edge: lengths.last().copied().unwrap_or(0.0),
            median_edge: lengths.get(lengths.len() / 2).copied().unwrap_or(0.0),
            area: corners.sum(|[a, b, c]| (b - a).cross(c - a).length() / 2.0),
            volume: corners.sum(|[a, b, c]| a.dot(b.cross(c)) / 6.0),
            materials: materials.into_iter().filter(|name| !name.is_empty()).map(String::from).collect(),
        })
    }

    /// Whether every edge lies between exactly two triangles.
    #[must_use]
    pub fn is_watertight(&self) -> bool {
        self.open_edges == 0
    }

    /// Sides of the bounding box along x, y and z (up).
    #[must_use]
    pub fn extents(&self) -> Vec3 {
        self.high - self.low
    }
}

/// Triangles between welded corners.
struct Corners {
    /// From the lowest corner of the bounding box, so that sums stay small.
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Corners {
    fn of(model: &Model, low: Vec3, cell: f64) -> Self {
        let low = low.as_dvec3();
        let key = |p: DVec3| if cell > 0.0 { (p / cell).to_array().map(|v| v.round() as i64) } else { [0; 3] };
        // Vertices of all parts are numbered through; those that no triangle uses do not count.
        let mut keyed = Vec::new();
        let mut count = 0;
        for part in &model.parts {
            let mut used = vec![false; part.positions.len()];
            part.triangles.iter().flatten().for_each(|&vertex| used[vertex as usize] = true);
            let vertices = part.positions.iter().zip(used).zip(count..);
            keyed.extend(
                vertices.filter(|((_, used), _)| *used).map(|((p, _), number)| (key(p.as_dvec3() - low), number, *p)),
            );
            count += part.positions.len() as u32;
        }
        keyed.sort_unstable_by_key(|(key, number, _)| (*key, *number));
        let mut corner_of = vec![0; count as usize];
        let mut positions = Vec::new();
        for same in keyed.chunk_by(|a, b| a.0 == b.0) {
            same.iter().for_each(|(_, number, _)| corner_of[*number as usize] = positions.len() as u32);
            positions.push(same[0].2.as_dvec3() - low);
        }
        let mut triangles = Vec::new();
        let mut first = 0;
        for part in &model.parts {
            triangles.extend(part.triangles.iter().map(|t| t.map(|vertex| corner_of[first + vertex as usize])));
            first += part.positions.len();
        }
        Self { positions, triangles }
    }

    /// Every edge once, with the number of triangles that have it.
    fn edges(&self) -> Vec<([u32; 2], usize)> {
        let ends = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
        let edges = self.triangles.iter().flat_map(|&triangle| ends(triangle)).filter(|[a, b]| a != b);
        // Both ends in one number, which sorts faster.
        let mut edges: Vec<u64> = edges.map(|[a, b]| u64::from(a.min(b)) << 32 | u64::from(a.max(b))).collect();
        edges.sort_unstable();
        edges.chunk_by(|a, b| a == b).map(|same| ([(same[0] >> 32) as u32, same[0] as u32], same.len())).collect()
    }

    fn length(&self, [a, b]: [u32; 2]) -> f64 {
        (self.positions[a as usize] - self.positions[b as usize]).length()
    }

    fn sum(&self, of: impl Fn([glam::DVec3; 3]) -> f64) -> f64 {
        self.triangles.iter().map(|triangle| of(triangle.map(|corner| self.positions[corner as usize]))).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::glb::tests::{cube, tire};
    use crate::catalog::model::Part;

    fn model((positions, indices): (Vec<[f32; 3]>, Vec<u32>)) -> Model {
        let part = Part {
            positions: positions.into_iter().map(Vec3::from_array).collect(),
            triangles: indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
            material: "steel".into(),
            ..Part::default()
        };
        Model { parts: vec![part], ..Model::default() }
    }

    #[test]
    fn a_cube_is_closed_and_measured() {
        let facts = MeshFacts::of(&model(cube())).expect("triangles");
        assert_eq!((facts.triangles, facts.corners, facts.is_watertight()), (12, 8, true));
        assert_eq!((facts.low, facts.extents()), (Vec3::splat(-0.5), Vec3::ONE));
        // 12 sides of length 1 and 6 diagonals.
        assert!((facts.longest_edge - 2f64.sqrt()).abs() < 1e-12 && (facts.median_edge - 1.0).abs() < 1e-12);
        assert!((facts.area - 6.0).abs() < 1e-12 && (facts.volume - 1.0).abs() < 1e-12);
        assert_eq!(facts.materials, ["steel"]);
    }

    #[test]
    fn corners_of_separate_faces_are_welded() {
        let (positions, indices) = cube();
        let loose: Vec<[f32; 3]> = indices.iter().map(|&index| positions[index as usize]).collect();
        let numbers = (0..loose.len() as u32).collect();
        let facts = MeshFacts::of(&model((loose, numbers))).expect("triangles");
        assert_eq!((facts.corners, facts.open_edges), (8, 0));
        let part_of =
            |range: std::ops::Range<usize>| model((positions.clone(), indices[range].to_vec())).parts.remove(0);
        let halves = Model { parts: vec![part_of(0..18), part_of(18..36)], ..Model::default() };
        assert!(MeshFacts::of(&halves).expect("triangles").is_watertight(), "parts are welded too");
    }

    #[test]
    fn holes_and_thirds_are_open() {
        let (positions, mut indices) = cube();
        indices.truncate(33);
        let facts = MeshFacts::of(&model((positions.clone(), indices.clone()))).expect("triangles");
        assert_eq!((facts.open_edges, facts.is_watertight()), (3, false));
        // A fin on a closed cube: one edge with three triangles, two with one.
        let (mut positions, mut indices) = cube();
        positions.push([-2.0, 0.0, 0.0]);
        indices.extend([0, 1, 8]);
        assert_eq!(MeshFacts::of(&model((positions, indices))).expect("triangles").open_edges, 3);
        let torus = MeshFacts::of(&model(tire(0.6, 0.1))).expect("triangles");
        assert!(torus.is_watertight() && torus.corners == 288);
        assert_eq!(MeshFacts::of(&Model::default()), None);
    }
}
