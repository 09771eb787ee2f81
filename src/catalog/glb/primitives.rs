//! Primitives as parts: positions, morphed and placed, and the triangles between them.

use glam::{DAffine3, DVec3, Vec3};

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
/// How far from the file's zero a model keeps its own origin, metres: single precision there still tells millimetres.
const FAR: f64 = 8192.0;
/// Largest coordinate: squares of it are still far from overflow.
const FURTHEST: f32 = 1e15;
/// Most primitives of one model, counted alike, instances of one node once.
const MAX_PARTS: u64 = 500_000;

/// Collects the parts of all shown nodes.
pub(super) struct Reader<'a, 'f> {
    file: &'a File<'f>,
    nodes: &'a Nodes,
    skins: Skins,
    /// Those with triangles that have an area.
    pub parts: Vec<Part>,
    /// Where the first vertex stands, z up, if that is far away; the parts' zero is there.
    pub origin: Option<DVec3>,
    /// Triangles so far, those without area too.
    pub triangles: u64,
    vertices: u64,
    primitives: u64,
}

impl<'a, 'f> Reader<'a, 'f> {
    pub fn new(file: &'a File<'f>, nodes: &'a Nodes) -> Self {
        let (skins, parts) = (Skins::default(), Vec::new());
        Self { file, nodes, skins, parts, origin: None, triangles: 0, vertices: 0, primitives: 0 }
    }

    /// Adds everything that the file shows: its scene, or all meshes where there are neither scenes nor nodes.
    pub fn all(&mut self) -> Result<(), ModelFault> {
        let (nodes, root) = (self.nodes, &self.file.root);
        if root.nodes.is_empty() && root.scenes.is_empty() {
            return (0..root.meshes.len() as u32)
                .try_for_each(|mesh| self.mesh(mesh, &Hanger::nowhere(mesh), "meshes"));
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
        self.vertices = self.vertices.saturating_add(source.vertex_count()?.saturating_mul(copies));
        self.triangles = self.triangles.saturating_add(source.triangle_count(mode)?.saturating_mul(copies));
        self.limit(hung)?;

        // Without different positions there is no surface, though triangles were announced.
        let moved = hung.hanger.skin.is_some() || hung.primitive.targets.iter().any(|target| target.position.is_some());
        if source.is_one_point() && !moved {
            return Ok(None);
        }
        let Some(mut local) = source.positions()? else { return Ok(None) };
        self.morph(hung, &mut local)?;
        let triangles = source.triangles(mode)?;
        if let Some(index) = triangles.iter().flatten().find(|&&index| index as usize >= local.len()) {
            return Err(hung.broken(format!("index {index} of {} vertices", local.len())));
        }
        let material = self.material(hung)?;
        let mut placed = match self.joints(hung, &source, local.len())? {
            Some(joints) => skinned(local, &joints, &mut self.origin),
            None if triangles.is_empty() => return Ok(None),
            None => instanced(local, hung.hanger, &mut self.origin),
        };
        let bounded = |position: &Vec3| position.abs().max_element() <= FURTHEST && !position.is_nan();
        if let Some(vertex) = placed.positions.iter().position(|position| !bounded(position)) {
            return Err(hung.broken(format!("vertex {vertex} is not finite, or further away than {FURTHEST:e}")));
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

    fn limit(&self, hung: &Hung) -> Result<(), ModelFault> {
        for (what, count, limit) in [
            ("primitives", self.primitives, MAX_PARTS),
            ("vertices", self.vertices, MAX_VERTICES),
            ("triangles", self.triangles, MAX_TRIANGLES),
        ] {
            if count > limit {
                let what = format!("{what} (up to {})", hung.place);
                return Err(ModelFault::TooLarge { what, count, limit });
            }
        }
        Ok(())
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
            if self.file.count(accessor)? != positions.len() as u64 {
                return Err(hung.broken("a morph target of another length than the mesh"));
            }
            if self.file.is_zero(accessor) {
                continue;
            }
            let moves = self.file.floats::<3>(accessor)?;
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
            let numbers = source.integers::<4>(numbers, vertices as u64)?;
            let weights = source.floats::<4>(weights, vertices as u64)?;
            sets.push(JointSet { numbers, weights });
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
fn skinned(mut positions: Vec<Vec3>, joints: &Joints, origin: &mut Option<DVec3>) -> Placed {
    let mirrored = vec![!positions.is_empty() && joints.blend(0).matrix3.determinant() < 0.0];
    for (vertex, position) in positions.iter_mut().enumerate() {
        *position = ours(joints.blend(vertex).transform_point3(position.as_dvec3()), origin);
    }
    Placed { positions, mirrored }
}

/// A copy of the positions for each world that the mesh hangs in.
fn instanced(mut positions: Vec<Vec3>, hanger: &Hanger, origin: &mut Option<DVec3>) -> Placed {
    let mirrored = hanger.worlds.iter().map(|world| world.matrix3.determinant() < 0.0).collect();
    let mut placed = |world: &DAffine3, position: Vec3| ours(world.transform_point3(position.as_dvec3()), origin);
    if let [world] = &hanger.worlds[..] {
        positions.iter_mut().for_each(|position| *position = placed(world, *position));
        return Placed { positions, mirrored };
    }
    let mut copies = Vec::with_capacity(positions.len() * hanger.worlds.len());
    for world in &hanger.worlds {
        copies.extend(positions.iter().map(|position| placed(world, *position)));
    }
    Placed { positions: copies, mirrored }
}

/// A position of the file's frame in ours: y up to z up, a right-hand turn about x, so that the winding stays; from the
/// origin, which the first position of a file decides on.
fn ours(p: DVec3, origin: &mut Option<DVec3>) -> Vec3 {
    let turned = DVec3::new(p.x, -p.z, p.y);
    let far = || {
        let furthest = turned.abs().max_element();
        if furthest > FAR && furthest < f64::from(FURTHEST) { turned.floor() } else { DVec3::ZERO }
    };
    (turned - *origin.get_or_insert_with(far)).as_vec3()
}
