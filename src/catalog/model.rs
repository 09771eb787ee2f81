//! A model as geometry: triangles in parts, each part one material.

use glam::{DVec3, Vec3};

/// One material's triangles of a model. Frame: x right, y back, z up (glTF's y-up turned), metres after scaling.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// Name of the node that the part belongs to (empty if it has none): of itself and its ancestors, the nearest
    /// with a category of its own, else the nearest with a name.
    pub node: String,
    /// Number of that node in the file: parts of one thing share it, parts of equally named things do not.
    pub node_number: u32,
    /// `extras.categoryID` of that node (empty if it has none).
    pub category: String,
    /// Name of the glTF material (empty if it has none).
    pub material: String,
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// Three vertex numbers a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// A model: its parts, every node transform applied.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// In file order.
    pub parts: Vec<Part>,
    /// Where the positions' zero lies in the frame of the file, metres: a model far from the file's zero keeps its shape
    /// although positions are single precision. 0 for others.
    pub origin: DVec3,
}

impl Model {
    /// Lowest and highest corner, from `origin`, of all vertices that a triangle uses; `None` without triangles.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let used =
            self.parts.iter().flat_map(|part| part.triangles.iter().flatten().map(|&v| part.positions[v as usize]));
        used.fold(None, |bounds, p| Some(bounds.map_or((p, p), |(low, high): (Vec3, Vec3)| (low.min(p), high.max(p)))))
    }

    /// Moves the origin to the file's zero. Far from it, what is smaller than the precision there is lost.
    pub fn move_to_file_frame(&mut self) {
        let origin = std::mem::take(&mut self.origin);
        if origin != DVec3::ZERO {
            self.map(|p| (origin + p.as_dvec3()).as_vec3());
        }
    }

    /// Moves every vertex.
    pub fn map(&mut self, turn: impl Fn(Vec3) -> Vec3) {
        self.parts.iter_mut().flat_map(|part| &mut part.positions).for_each(|p| *p = turn(*p));
    }

    /// Scales so that the longest side is `size` metres and moves the middle of the base to the origin, the lowest
    /// point to z = 0. A model without extent stays as it is.
    pub fn rest_at_origin(&mut self, size: f64) {
        self.origin = DVec3::ZERO;
        let Some((low, high)) = self.bounds() else { return };
        let longest = f64::from((high - low).max_element());
        if longest > 0.0 {
            let base = Vec3::new(low.x * 0.5 + high.x * 0.5, low.y * 0.5 + high.y * 0.5, low.z);
            let scale = (size / longest) as f32;
            self.map(|p| (p - base) * scale);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_origin_is_part_of_where_a_model_is() {
        let part =
            Part { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]], ..Part::default() };
        let far = Model { parts: vec![part], origin: DVec3::new(1000.0, -8.0, 0.5) };
        let mut moved = far.clone();
        moved.move_to_file_frame();
        assert_eq!(moved.bounds(), Some((Vec3::new(1000.0, -8.0, 0.5), Vec3::new(1001.0, -7.0, 0.5))));
        assert_eq!(moved.origin, DVec3::ZERO);
        let mut resting = far;
        resting.rest_at_origin(2.0);
        assert_eq!(resting.bounds(), Some((Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0))));
        assert_eq!(resting.origin, DVec3::ZERO);
    }
}
