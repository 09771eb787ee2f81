//! Transforms of nodes, joints and instances.
//!
//! Source: Khronos Group (2021), glTF 2.0 specification, section 3.5.3 (transformations).

use glam::{DAffine3, DMat3, DVec3};

use super::schema::Node;

/// Parent from node. A matrix is taken as it is; translation, rotation and scale otherwise.
pub(super) fn local_transform(node: &Node) -> DAffine3 {
    match &node.matrix {
        Some(matrix) => affine(**matrix),
        None => placed(
            node.translation.unwrap_or([0.0; 3]),
            node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
            node.scale.unwrap_or([1.0; 3]),
        ),
    }
}

/// Scaled, turned by a quaternion (x, y, z, w), moved.
pub(super) fn placed(translation: [f32; 3], rotation: [f32; 4], scale: [f32; 3]) -> DAffine3 {
    let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let scale = vector(scale);
    let rotation = rotation_matrix(rotation.map(f64::from));
    let linear = DMat3::from_cols(rotation.x_axis * scale.x, rotation.y_axis * scale.y, rotation.z_axis * scale.z);
    DAffine3 { matrix3: linear, translation: vector(translation) }
}

/// A matrix in columns, its last row taken for 0 0 0 1.
pub(super) fn affine(m: [f32; 16]) -> DAffine3 {
    let m = m.map(f64::from);
    let column = |k: usize| DVec3::new(m[4 * k], m[4 * k + 1], m[4 * k + 2]);
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) }
}

/// Rotation by a quaternion (x, y, z, w) of any length but 0, which turns nothing.
fn rotation_matrix([x, y, z, w]: [f64; 4]) -> DMat3 {
    let length_squared = x * x + y * y + z * z + w * w;
    if length_squared == 0.0 {
        return DMat3::IDENTITY;
    }
    let s = 2.0 / length_squared;
    DMat3::from_cols(
        DVec3::new(1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)),
        DVec3::new(s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)),
        DVec3::new(s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)),
    )
}
