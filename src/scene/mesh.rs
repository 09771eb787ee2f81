//! Triangles in clusters: what the sonar scans and instances share.
//!
//! A cluster is at most [`Cluster::MAX_TRIANGLES`] triangles of one material that lie close together: it is culled as a
//! whole, its vertices are turned into the sonar's frame once, and its indices fit 16 bits.

use glam::Vec3;

/// At most 512 neighbouring triangles of one material, in the mesh's own frame.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// Vertex coordinates, metres, one array an axis so that transforms run over whole arrays.
    pub x: Vec<f32>,
    /// As `x`.
    pub y: Vec<f32>,
    /// As `x`.
    pub z: Vec<f32>,
    /// Vertex numbers within the cluster.
    pub triangles: Vec<[u16; 3]>,
    /// Number in the mesh of this cluster's first triangle: triangles are numbered in cluster order.
    pub first_triangle: u32,
    /// Material slot of the mesh.
    pub material: u16,
    /// Centre of the bounding sphere.
    pub centre: Vec3,
    /// Radius of the bounding sphere, metres.
    pub radius: f32,
}

impl Cluster {
    /// Most triangles in one cluster.
    pub const MAX_TRIANGLES: usize = 512;
}

/// A surface in its own frame, shared by every instance of it.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// In triangle order.
    pub clusters: Vec<Cluster>,
    /// Names of the material slots.
    pub materials: Vec<String>,
    /// Lowest corner of the bounding box.
    pub low: Vec3,
    /// Highest corner of the bounding box.
    pub high: Vec3,
    /// How many triangles the clusters hold.
    pub triangle_count: u32,
}
