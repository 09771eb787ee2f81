//! Triangles in clusters: what the sonar scans and instances share.
//!
//! A cluster is at most [`Cluster::MAX_TRIANGLES`] triangles of one material that lie close together: it is culled as a
//! whole, its vertices are turned into the sonar's frame once, and its indices fit 16 bits.

use glam::Vec3;

use crate::catalog::Part;

/// At most 512 neighbouring triangles of one material, in the mesh's own frame.
#[derive(Clone, Debug, Default)]
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

impl Mesh {
    /// Cuts parts into clusters. Parts of one material name share a slot; slots stand in order of first appearance.
    ///
    /// The same parts give the same mesh, bit for bit. Parts must be sound, as [`crate::catalog::load_model`] leaves
    /// them: vertex numbers within range, finite coordinates.
    #[must_use]
    pub fn from_parts(parts: &[Part]) -> Self {
        let mut materials: Vec<String> = Vec::new();
        let mut of_slot: Vec<Vec<usize>> = Vec::new();
        for (number, part) in parts.iter().enumerate() {
            match materials.iter().position(|name| *name == part.material) {
                Some(slot) => of_slot[slot].push(number),
                None => {
                    materials.push(part.material.clone());
                    of_slot.push(vec![number]);
                }
            }
        }
        let mut clusters = Vec::new();
        let mut pool = VertexPool::new();
        for (slot, numbers) in of_slot.iter().enumerate() {
            let mut keys: Vec<Key> = numbers.iter().flat_map(|&number| keys_of(parts, number)).collect();
            split(&mut keys, &mut |leaf| clusters.push(pool.gather(parts, leaf, slot as u16)));
        }
        Self::from_clusters(clusters, materials)
    }

    /// Numbers the clusters' triangles and takes the bounds of the whole.
    #[must_use]
    pub fn from_clusters(mut clusters: Vec<Cluster>, materials: Vec<String>) -> Self {
        clusters.retain(|cluster| !cluster.triangles.is_empty());
        let mut triangle_count = 0;
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for cluster in &mut clusters {
            cluster.first_triangle = triangle_count;
            triangle_count += cluster.triangles.len() as u32;
            let (cluster_low, cluster_high) = cluster.bounds();
            (low, high) = (low.min(cluster_low), high.max(cluster_high));
        }
        if clusters.is_empty() {
            (low, high) = (Vec3::ZERO, Vec3::ZERO);
        }
        Self { clusters, materials, low, high, triangle_count }
    }

    /// The corners of every triangle, in triangle order.
    pub fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        self.clusters.iter().flat_map(|cluster| {
            cluster.triangles.iter().map(|corners| corners.map(|vertex| cluster.vertex(usize::from(vertex))))
        })
    }

    /// Every vertex, cluster by cluster; one on a border between clusters comes once for each.
    pub fn vertices(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.clusters.iter().flat_map(|cluster| (0..cluster.x.len()).map(|vertex| cluster.vertex(vertex)))
    }
}

impl Cluster {
    /// Most triangles in one cluster.
    pub const MAX_TRIANGLES: usize = 512;

    /// A cluster with its bounding sphere; `first_triangle` is set by [`Mesh::from_clusters`].
    #[must_use]
    pub fn new(vertices: &[Vec3], triangles: Vec<[u16; 3]>, material: u16) -> Self {
        debug_assert!(triangles.len() <= Self::MAX_TRIANGLES, "{} triangles in one cluster", triangles.len());
        let mut cluster = Self {
            x: vertices.iter().map(|v| v.x).collect(),
            y: vertices.iter().map(|v| v.y).collect(),
            z: vertices.iter().map(|v| v.z).collect(),
            triangles,
            material,
            ..Self::default()
        };
        let (low, high) = cluster.bounds();
        cluster.centre = low * 0.5 + high * 0.5;
        let furthest = vertices.iter().map(|v| (*v - cluster.centre).length()).fold(0.0, f32::max);
        // Rounded outwards, so that the sphere holds its vertices in any arithmetic.
        cluster.radius = furthest * (1.0 + 4.0 * f32::EPSILON);
        cluster
    }

    /// Coordinates of a vertex of this cluster.
    #[must_use]
    pub fn vertex(&self, number: usize) -> Vec3 {
        Vec3::new(self.x[number], self.y[number], self.z[number])
    }

    fn bounds(&self) -> (Vec3, Vec3) {
        let range = |axis: &[f32]| {
            axis.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &v| (low.min(v), high.max(v)))
        };
        let ((x0, x1), (y0, y1), (z0, z1)) = (range(&self.x), range(&self.y), range(&self.z));
        (Vec3::new(x0, y0, z0), Vec3::new(x1, y1, z1))
    }
}

/// Where a triangle lies and which one it is.
#[derive(Clone, Copy)]
struct Key {
    centroid: [f32; 3],
    part: u32,
    triangle: u32,
}

fn keys_of(parts: &[Part], number: usize) -> impl Iterator<Item = Key> + '_ {
    let part = &parts[number];
    part.triangles.iter().enumerate().map(move |(triangle, corners)| {
        let [a, b, c] = corners.map(|vertex| part.positions[vertex as usize]);
        Key { centroid: ((a + b + c) / 3.0).to_array(), part: number as u32, triangle: triangle as u32 }
    })
}

/// Halves along the longest axis until a cluster's worth is left; every leaf but one is full.
fn split(keys: &mut [Key], leaf: &mut impl FnMut(&[Key])) {
    const FULL: usize = Cluster::MAX_TRIANGLES;
    if keys.is_empty() {
        return;
    }
    if keys.len() <= FULL {
        // The halving leaves an order that is the selection's own: only the set is fixed.
        keys.sort_unstable_by_key(|key| (key.part, key.triangle));
        return leaf(keys);
    }
    let axis = longest_axis(keys);
    let middle = (keys.len().div_ceil(FULL) / 2) * FULL;
    keys.select_nth_unstable_by(middle, |a, b| {
        a.centroid[axis].total_cmp(&b.centroid[axis]).then_with(|| (a.part, a.triangle).cmp(&(b.part, b.triangle)))
    });
    let (lower, upper) = keys.split_at_mut(middle);
    split(lower, leaf);
    split(upper, leaf);
}

fn longest_axis(keys: &[Key]) -> usize {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for key in keys {
        let centroid = Vec3::from_array(key.centroid);
        (low, high) = (low.min(centroid), high.max(centroid));
    }
    let size = high - low;
    if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    }
}

/// Merges a cluster's equal vertices by an open-addressed table that is reused from cluster to cluster.
struct VertexPool {
    /// Vertex number + 1; 0 is free. Four times the most vertices, so that probes stay short.
    table: Vec<u16>,
    vertices: Vec<Vec3>,
}

impl VertexPool {
    const BITS: u32 = 13;

    fn new() -> Self {
        Self { table: vec![0; 1 << Self::BITS], vertices: Vec::new() }
    }

    fn gather(&mut self, parts: &[Part], keys: &[Key], material: u16) -> Cluster {
        self.table.fill(0);
        self.vertices.clear();
        let triangles = keys
            .iter()
            .map(|key| {
                let part = &parts[key.part as usize];
                part.triangles[key.triangle as usize].map(|vertex| self.number(part.positions[vertex as usize]))
            })
            .collect();
        Cluster::new(&self.vertices, triangles, material)
    }

    fn number(&mut self, vertex: Vec3) -> u16 {
        // Adding zero turns −0 into +0, which is the same place.
        let vertex = vertex + Vec3::ZERO;
        let bits = vertex.to_array().map(f32::to_bits);
        let mixed = bits
            .iter()
            .fold(0u64, |hash, &b| (hash.rotate_left(23) ^ u64::from(b)).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let mut place = (mixed >> (64 - Self::BITS)) as usize;
        loop {
            match self.table[place] {
                0 => {
                    self.vertices.push(vertex);
                    self.table[place] = self.vertices.len() as u16;
                    return self.vertices.len() as u16 - 1;
                }
                taken if self.vertices[usize::from(taken) - 1].to_array().map(f32::to_bits) == bits => {
                    return taken - 1;
                }
                _ => place = (place + 1) & (self.table.len() - 1),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bumpy sheet of 2·n² triangles without shared vertices.
    fn sheet(n: usize, material: &str) -> Part {
        let at = |i: usize, j: usize| Vec3::new(i as f32 * 0.1, j as f32 * 0.1, ((i * 7 + j * 3) % 5) as f32 * 0.01);
        let mut part = Part { material: material.into(), ..Part::default() };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            for corners in [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]] {
                let first = part.positions.len() as u32;
                part.positions.extend(corners);
                part.triangles.push([first, first + 1, first + 2]);
            }
        }
        part
    }

    fn sorted(triangles: impl Iterator<Item = [Vec3; 3]>) -> Vec<[u32; 9]> {
        let mut all: Vec<[u32; 9]> =
            triangles.map(|corners| std::array::from_fn(|k| (corners[k / 3][k % 3] + 0.0).to_bits())).collect();
        all.sort_unstable();
        all
    }

    #[test]
    fn clusters_hold_every_triangle_once() {
        let parts = [sheet(40, "steel"), sheet(3, "wood"), sheet(9, "steel")];
        let mesh = Mesh::from_parts(&parts);
        let given = parts.iter().flat_map(|p| p.triangles.iter().map(|t| t.map(|v| p.positions[v as usize])));
        assert_eq!(sorted(mesh.triangles()), sorted(given));
        assert_eq!(mesh.materials, ["steel", "wood"]);
        assert_eq!(mesh.triangle_count, 2 * (1600 + 9 + 81));
        let mut next = 0;
        for cluster in &mesh.clusters {
            assert_eq!(cluster.first_triangle, next);
            next += cluster.triangles.len() as u32;
            assert!(cluster.triangles.len() <= Cluster::MAX_TRIANGLES);
            assert!((0..cluster.x.len()).all(|v| (cluster.vertex(v) - cluster.centre).length() <= cluster.radius));
        }
        assert_eq!(next, mesh.triangle_count);
        assert_eq!(mesh.clusters.iter().filter(|c| c.material == 1).count(), 1);
    }

    #[test]
    fn clusters_are_compact_and_share_vertices() {
        let mesh = Mesh::from_parts(&[sheet(64, "sand")]);
        assert_eq!(mesh.clusters.len(), 16);
        for cluster in &mesh.clusters {
            // 512 triangles of a sheet of 0.1 m cells are 16 × 16 cells when compact.
            assert!(cluster.radius < 1.3, "{}", cluster.radius);
            assert!(cluster.x.len() < 330, "{} vertices", cluster.x.len());
        }
    }

    #[test]
    fn no_parts_make_an_empty_mesh() {
        let mesh = Mesh::from_parts(&[]);
        assert_eq!((mesh.triangle_count, mesh.low), (0, Vec3::ZERO));
    }
}
