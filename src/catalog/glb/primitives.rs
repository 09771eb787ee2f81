//! Primitives as parts: positions, morphed and placed, and the triangles between them.

use glam::{DVec3, Vec3};

use super::file::File;
use super::hanger::{Hanger, plain};
use super::nodes::Nodes;
use super::schema::{Mesh, Primitive};
use super::skin::{JointSet, Joints, Skins};
use super::source::Source;
use super::triangles::{Mode, has_area};
use crate::catalog::error::ModelFault;
use crate::catalog::model::Part;

/// Most triangles of one model, nodes and instances that share a mesh counted each.
const MAX_TRIANGLES: u64 = 20_000_000;
/// Most vertices of one model, counted alike.
const MAX_VERTICES: u64 = 40_000_000;
/// Most primitives of one model, counted alike, instances of one node once.
const MAX_PARTS: u64 = 500_000;

/// Collects the parts of all shown nodes.
pub(super) struct Reader<'a, 'f> {
    file: &'a File<'f>,
    nodes: &'a Nodes,
    skins: Skins,
    /// Those with triangles that have an area.
    pub parts: Vec<Part>,
    /// Triangles so far, those without area too.
    pub triangles: u64,
    vertices: u64,
    primitives: u64,
}

impl<'a, 'f> Reader<'a, 'f> {
    pub fn new(file: &'a File<'f>, nodes: &'a Nodes) -> Self {
        Self { file, nodes, skins: Skins::default(), parts: Vec::new(), triangles: 0, vertices: 0, primitives: 0 }
    }

    /// Adds everything that the file shows: its scene, or all meshes where there are neither scenes nor nodes.
    pub fn all(&mut self) -> Result<(), ModelFault> {
        let (nodes, root) = (self.nodes, &self.file.root);
        if root.nodes.is_empty() && root.scenes.is_empty() {
            return (0..root.meshes.len() as u32).try_for_each(|mesh| self.mesh(mesh, &Hanger::nowhere(mesh), "meshes"));
        }
        for &number in &nodes.shown {
            if let Some(mesh) = root.nodes[number].mesh {
                let hanger = Hanger::of(self.file, nodes, number)?;
                self.mesh(mesh, &hanger, &format!("nodes[{number}]"))?;
            }
        }
        Ok(())
    }

    fn mesh(&mut self, number: u32, hanger: &Hanger, place: &str) -> Result<(), ModelFault> {
        let mesh = self.file.root.meshes.get(number as usize);
        let mesh = mesh.ok_or_else(|| ModelFault::broken(place, format!("its mesh {number} does not exist")))?;
        for (k, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{number}].primitives[{k}]");
            if let Some(part) = self.part(&Hung { hanger, mesh, primitive, place })? {
                self.parts.push(part);
            }
        }
        Ok(())
    }

    fn part(&mut self, hung: &Hung) -> Result<Option<Part>, ModelFault> {
        let mode = match hung.primitive.mode {
            // Points and lines are no surface.
            Some(0..=3) => return Ok(None),
            None | Some(4) => Mode::Triangles,
            Some(5) => Mode::Strip,
            Some(6) => Mode::Fan,
            Some(other) => return Err(hung.broken(format!("its mode {other} is none"))),
        };
        let source = Source::of(self.file, hung.primitive)?;
        let copies = hung.hanger.worlds.len() as u64;
        self.primitives += 1;
        ModelFault::limit("primitives", self.primitives, MAX_PARTS)?;
        self.vertices = self.vertices.saturating_add(source.vertex_count()?.saturating_mul(copies));
        ModelFault::limit("vertices", self.vertices, MAX_VERTICES)?;
        self.triangles = self.triangles.saturating_add(source.triangle_count(mode)?.saturating_mul(copies));
        ModelFault::limit("triangles", self.triangles, MAX_TRIANGLES)?;

        let Some(mut local) = source.positions()? else {
            // Without positions there is no surface, but the triangles were announced.
            return Ok(None);
        };
        self.morph(hung, &mut local)?;
        let triangles = source.triangles(mode)?;
        if let Some(index) = triangles.iter().flatten().find(|&&index| index as usize >= local.len()) {
            return Err(hung.broken(format!("index {index} of {} vertices", local.len())));
        }
        let material = self.material(hung)?;
        let joints = self.joints(hung, &source, local.len())?;
        let mut placed = match joints {
            Some(joints) => skinned(local, &joints),
            None => instanced(local, triangles.len(), hung.hanger),
        };
        if let Some(vertex) = placed.positions.iter().position(|position| !position.is_finite()) {
            return Err(hung.broken(format!("vertex {vertex} is not finite")));
        }
        let triangles = placed.copies_of(triangles);
        if triangles.is_empty() {
            return Ok(None);
        }
        Ok(Some(Part {
            node: hung.hanger.name.clone(),
            node_number: hung.hanger.number,
            category: hung.hanger.category.clone(),
            material,
            positions: placed.positions,
            triangles,
        }))
    }

    fn material(&self, hung: &Hung) -> Result<String, ModelFault> {
        let Some(number) = hung.primitive.material else { return Ok(String::new()) };
        let material = self.file.root.materials.get(number as usize);
        let material = material.ok_or_else(|| hung.broken(format!("its material {number} does not exist")))?;
        Ok(plain(material.name.as_ref()))
    }

    /// Adds the morph targets at the weights of the rest pose: the node's, else the mesh's, else none.
    fn morph(&self, hung: &Hung, positions: &mut [Vec3]) -> Result<(), ModelFault> {
        let weights = hung.hanger.weights.or(hung.mesh.weights.as_deref()).unwrap_or_default();
        for (target, &weight) in hung.primitive.targets.iter().zip(weights) {
            let Some(accessor) = target.position.filter(|_| weight != 0.0) else { continue };
            let moves = self.file.floats::<3>(accessor)?;
            if moves.len() != positions.len() {
                return Err(hung.broken("a morph target of another length than the mesh"));
            }
            for (position, by) in positions.iter_mut().zip(moves) {
                *position += weight * Vec3::from_array(by);
            }
        }
        Ok(())
    }

    /// The joints of a skinned mesh. A skin without weights in the mesh leaves the mesh rigid on its node.
    fn joints(&mut self, hung: &Hung, source: &Source, vertices: usize) -> Result<Option<Joints>, ModelFault> {
        let Some(number) = hung.hanger.skin else { return Ok(None) };
        let mut sets = Vec::new();
        for (numbers, weights) in source.joint_sets() {
            sets.push(JointSet { numbers: source.integers::<4>(numbers)?, weights: source.floats::<4>(weights)? });
        }
        if sets.is_empty() {
            return Ok(None);
        }
        let matrices = self.skins.matrices(self.file, self.nodes, number)?;
        Joints::new(matrices, sets, vertices).map(Some).map_err(|problem| hung.broken(problem))
    }
}

/// A primitive where it hangs.
struct Hung<'a> {
    hanger: &'a Hanger<'a>,
    mesh: &'a Mesh,
    primitive: &'a Primitive,
    place: String,
}

impl Hung<'_> {
    fn broken(&self, problem: impl Into<String>) -> ModelFault {
        ModelFault::broken(&self.place, problem)
    }
}

/// Positions in our frame (z up), copy after copy.
struct Placed {
    positions: Vec<Vec3>,
    /// For each copy, whether its transform turns surfaces inside out.
    mirrored: Vec<bool>,
}

impl Placed {
    /// The triangles of every copy that have an area, wound so that fronts stay fronts.
    fn copies_of(&mut self, mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
        let positions = &self.positions;
        let wide = |triangle: &[u32; 3]| has_area(triangle.map(|vertex| positions[vertex as usize]));
        let turned = |mirrored: bool, [a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        if let [mirrored] = self.mirrored[..] {
            triangles.iter_mut().for_each(|triangle| *triangle = turned(mirrored, *triangle));
            triangles.retain(wide);
            return triangles;
        }
        let vertices = (positions.len() / self.mirrored.len().max(1)) as u32;
        let copies = self.mirrored.iter().zip(0..).flat_map(|(&mirrored, copy)| {
            let numbered = move |triangle: &[u32; 3]| turned(mirrored, triangle.map(|vertex| vertex + copy * vertices));
            triangles.iter().map(numbered)
        });
        copies.filter(wide).collect()
    }
}

/// Skinned positions; glTF then ignores the mesh's own node.
fn skinned(mut positions: Vec<Vec3>, joints: &Joints) -> Placed {
    let mirrored = vec![!positions.is_empty() && joints.blend(0).matrix3.determinant() < 0.0];
    for (vertex, position) in positions.iter_mut().enumerate() {
        *position = z_up(joints.blend(vertex).transform_point3(position.as_dvec3()));
    }
    Placed { positions, mirrored }
}

/// A copy of the positions for each world that the mesh hangs in; none where it has no triangles.
fn instanced(mut positions: Vec<Vec3>, triangles: usize, hanger: &Hanger) -> Placed {
    let mirrored = hanger.worlds.iter().map(|world| world.matrix3.determinant() < 0.0).collect();
    match &hanger.worlds[..] {
        [world] => {
            positions.iter_mut().for_each(|position| *position = z_up(world.transform_point3(position.as_dvec3())));
            Placed { positions, mirrored }
        }
        _ if triangles == 0 => Placed { positions: Vec::new(), mirrored },
        worlds => {
            let copies = worlds.iter().flat_map(|world| {
                positions.iter().map(|position| z_up(world.transform_point3(position.as_dvec3())))
            });
            Placed { positions: copies.collect(), mirrored }
        }
    }
}

/// y up to z up: a right-hand turn about x, so that the winding stays.
fn z_up(p: DVec3) -> Vec3 {
    Vec3::new(p.x as f32, -p.z as f32, p.y as f32)
}
