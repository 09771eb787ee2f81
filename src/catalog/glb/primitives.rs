//! Primitives as parts: indices and modes to triangles, morph targets and skins to positions.

use glam::{DAffine3, DMat3, DVec3, Vec3};
use gltf::json::mesh::{Mesh, Mode, Primitive, Semantic};
use gltf::json::scene::Node;
use gltf::json::validation::Checked;

use super::file::File;
use super::nodes::{Nodes, category};
use crate::catalog::error::ModelFault;
use crate::catalog::model::Part;

/// Most triangles of one model.
const MAX_TRIANGLES: u64 = 20_000_000;
/// Most vertices of one model, nodes that share a mesh counted each.
const MAX_VERTICES: u64 = 60_000_000;

/// Collects the parts of all shown nodes.
pub(super) struct Reader<'a> {
    pub file: &'a File,
    pub nodes: &'a Nodes,
    pub parts: Vec<Part>,
    vertices: u64,
    triangles: u64,
}

impl<'a> Reader<'a> {
    pub fn new(file: &'a File, nodes: &'a Nodes) -> Self {
        Self { file, nodes, parts: Vec::new(), vertices: 0, triangles: 0 }
    }

    /// Adds what hangs on one node.
    pub fn node(&mut self, number: usize) -> Result<(), ModelFault> {
        let root = &self.file.root;
        let node = &root.nodes[number];
        let Some(mesh_number) = node.mesh.map(|mesh| mesh.value()) else { return Ok(()) };
        let mesh = root.meshes.get(mesh_number).ok_or_else(|| {
            ModelFault::broken(format!("nodes[{number}]"), format!("its mesh {mesh_number} does not exist"))
        })?;
        for (k, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{mesh_number}].primitives[{k}]");
            let hung = Hung { number, node, mesh, primitive, place };
            if let Some(part) = self.part(&hung)? {
                self.parts.push(part);
            }
        }
        Ok(())
    }

    fn part(&mut self, hung: &Hung) -> Result<Option<Part>, ModelFault> {
        let (Checked::Valid(mode), Some(positions)) = (hung.primitive.mode, hung.attribute(&Semantic::Positions))
        else {
            return Ok(None);
        };
        if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
            return Ok(None);
        }
        self.vertices += self.file.count(positions)?;
        limit("vertices", self.vertices, MAX_VERTICES)?;
        let indices = hung.primitive.indices.map(|indices| indices.value());
        self.triangles += match mode {
            Mode::Triangles => self.file.count(indices.unwrap_or(positions))? / 3,
            _ => self.file.count(indices.unwrap_or(positions))?,
        };
        limit("triangles", self.triangles, MAX_TRIANGLES)?;

        let mut local = self.file.floats::<3>(positions)?;
        self.morph(hung, &mut local)?;
        let placed = self.placed(hung, &local)?;
        let corners = match indices {
            Some(indices) => self.file.integers::<1>(indices)?.into_iter().map(|[index]| index).collect(),
            None => (0..local.len() as u32).collect::<Vec<u32>>(),
        };
        if let Some(index) = corners.iter().find(|&&index| index as usize >= local.len()) {
            return Err(ModelFault::broken(&hung.place, format!("index {index} of {} vertices", local.len())));
        }
        let mut triangles = triangles(&corners, mode);
        if placed.mirrored {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        triangles.retain(|triangle| has_area(triangle.map(|vertex| placed.positions[vertex as usize])));
        let owner = &self.file.root.nodes[self.nodes.owner[hung.number]];
        Ok(Some(Part {
            node: owner.name.clone().unwrap_or_default(),
            node_number: self.nodes.owner[hung.number] as u32,
            category: category(owner).unwrap_or_default(),
            material: self.material(hung)?,
            positions: placed.positions,
            triangles,
        }))
    }

    fn material(&self, hung: &Hung) -> Result<String, ModelFault> {
        let Some(number) = hung.primitive.material.map(|material| material.value()) else { return Ok(String::new()) };
        let material = self.file.root.materials.get(number);
        let material =
            material.ok_or_else(|| ModelFault::broken(&hung.place, format!("its material {number} does not exist")))?;
        Ok(material.name.clone().unwrap_or_default())
    }

    /// Adds the morph targets at the weights of the rest pose: the node's, else the mesh's, else none.
    fn morph(&self, hung: &Hung, positions: &mut [[f32; 3]]) -> Result<(), ModelFault> {
        let weights = hung.node.weights.as_ref().or(hung.mesh.weights.as_ref());
        let targets = hung.primitive.targets.iter().flatten();
        for (target, &weight) in targets.zip(weights.into_iter().flatten()) {
            let Some(accessor) = target.positions.filter(|_| weight != 0.0) else { continue };
            let moves = self.file.floats::<3>(accessor.value())?;
            if moves.len() != positions.len() {
                return Err(ModelFault::broken(&hung.place, "a morph target of another length than the mesh"));
            }
            for (position, by) in positions.iter_mut().zip(moves) {
                (0..3).for_each(|k| position[k] += weight * by[k]);
            }
        }
        Ok(())
    }

    /// Positions in our frame (z up) after node or joints.
    fn placed(&self, hung: &Hung, local: &[[f32; 3]]) -> Result<Placed, ModelFault> {
        let joints = self.joints(hung)?;
        let world = self.nodes.world[hung.number];
        let mut positions = Vec::with_capacity(local.len());
        for (vertex, position) in local.iter().enumerate() {
            let position = DVec3::from_array(position.map(f64::from));
            let there = match &joints {
                Some(joints) => joints.blend(vertex).transform_point3(position),
                None => world.transform_point3(position),
            };
            // y up to z up: a right-hand turn about x, so that the winding stays.
            let turned = Vec3::new(there.x as f32, -there.z as f32, there.y as f32);
            if !turned.is_finite() {
                return Err(ModelFault::broken(&hung.place, format!("vertex {vertex} is not finite")));
            }
            positions.push(turned);
        }
        let linear = joints.filter(|_| !local.is_empty()).map_or(world.matrix3, |joints| joints.blend(0).matrix3);
        Ok(Placed { positions, mirrored: linear.determinant() < 0.0 })
    }

    /// The joints of a skinned mesh in the rest pose of its nodes; glTF then ignores the mesh's own node.
    /// A skin without weights in the mesh leaves the mesh rigid on its node.
    fn joints(&self, hung: &Hung) -> Result<Option<Joints>, ModelFault> {
        let Some(number) = hung.node.skin.map(|skin| skin.value()) else { return Ok(None) };
        let (Some(numbers), Some(weights)) =
            (hung.attribute(&Semantic::Joints(0)), hung.attribute(&Semantic::Weights(0)))
        else {
            return Ok(None);
        };
        let place = format!("skins[{number}]");
        let skin = self.file.root.skins.get(number);
        let skin = skin.ok_or_else(|| ModelFault::broken(&place, "it does not exist"))?;
        let bind = match skin.inverse_bind_matrices {
            Some(accessor) => self.file.floats::<16>(accessor.value())?.into_iter().map(affine).collect(),
            None => vec![DAffine3::IDENTITY; skin.joints.len()],
        };
        if bind.len() < skin.joints.len() || skin.joints.is_empty() {
            return Err(ModelFault::broken(
                &place,
                format!("{} matrices for {} joints", bind.len(), skin.joints.len()),
            ));
        }
        let mut matrices = Vec::with_capacity(bind.len());
        for (joint, bind) in skin.joints.iter().zip(bind) {
            let world = self.nodes.world.get(joint.value());
            matrices.push(*world.ok_or_else(|| ModelFault::broken(&place, format!("no nodes[{joint}]")))? * bind);
        }
        let (numbers, weights) = (self.file.integers::<4>(numbers)?, self.file.floats::<4>(weights)?);
        let vertices = hung.attribute(&Semantic::Positions).map_or(Ok(0), |positions| self.file.count(positions))?;
        if (numbers.len() as u64) < vertices || (weights.len() as u64) < vertices {
            return Err(ModelFault::broken(&hung.place, "fewer joints or weights than vertices"));
        }
        if let Some(joint) = numbers.iter().flatten().find(|&&joint| joint as usize >= matrices.len()) {
            return Err(ModelFault::broken(&hung.place, format!("joint {joint} of {}", matrices.len())));
        }
        Ok(Some(Joints { matrices, numbers, weights }))
    }
}

/// A primitive where it hangs.
struct Hung<'a> {
    number: usize,
    node: &'a Node,
    mesh: &'a Mesh,
    primitive: &'a Primitive,
    place: String,
}

impl Hung<'_> {
    fn attribute(&self, semantic: &Semantic) -> Option<usize> {
        self.primitive.attributes.get(&Checked::Valid(semantic.clone())).map(|accessor| accessor.value())
    }
}

struct Placed {
    positions: Vec<Vec3>,
    /// Whether the transform turns surfaces inside out.
    mirrored: bool,
}

struct Joints {
    matrices: Vec<DAffine3>,
    numbers: Vec<[u32; 4]>,
    weights: Vec<[f32; 4]>,
}

impl Joints {
    /// `Σ w·(joint · inverse bind)` of a vertex, weights scaled to the sum 1.
    ///
    /// Source: glTF 2.0 specification, section 3.7.3.3 (skinned mesh attributes).
    fn blend(&self, vertex: usize) -> DAffine3 {
        let (numbers, weights) = (self.numbers[vertex], self.weights[vertex].map(f64::from));
        let total: f64 = weights.iter().sum();
        let joint = |k: usize| &self.matrices[numbers[k] as usize];
        if total.is_nan() || total <= 0.0 {
            return *joint(0);
        }
        let (mut linear, mut translation) = (DMat3::ZERO, DVec3::ZERO);
        for (k, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
            linear += joint(k).matrix3 * (weight / total);
            translation += joint(k).translation * (weight / total);
        }
        DAffine3 { matrix3: linear, translation }
    }
}

fn affine(m: [f32; 16]) -> DAffine3 {
    let column = |k: usize| DVec3::new(m[4 * k].into(), m[4 * k + 1].into(), m[4 * k + 2].into());
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) }
}

fn limit(what: &'static str, count: u64, limit: u64) -> Result<(), ModelFault> {
    if count > limit { Err(ModelFault::TooLarge { what, count, limit }) } else { Ok(()) }
}

fn triangles(corners: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::Triangles => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .map(|(k, c)| if k % 2 == 0 { [c[0], c[1], c[2]] } else { [c[1], c[0], c[2]] })
            .collect(),
        Mode::TriangleFan => corners.get(1..).unwrap_or(&[]).windows(2).map(|c| [corners[0], c[0], c[1]]).collect(),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Vec::new(),
    }
}

/// Whether a triangle is wider than 1e-9 of its longest side: a sliver below that is a line.
fn has_area(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    (b - a).cross(c - a).length() > 1e-9 * longest
}
