//! An object as the bytes of a binary glTF 2.0 file: a node, a mesh and a material for each part.
//!
//! Positions and indices only. Knows nothing of what the object is.

use anyhow::Result;
use serde::Serialize;

use super::object::{Material, Mesh, Object};

/// The GLB file of one object. Fields stand in a fixed order, so equal objects are equal bytes.
///
/// # Errors
/// If the description cannot be written as JSON.
pub fn bytes(object: &Object) -> Result<Vec<u8>> {
    let mut document = Document::new(object);
    let mut blob = Vec::new();
    for (part, mesh) in object.parts.iter().zip(object.meshes()) {
        let material = document.material(part.material);
        let attributes = Attributes { position: document.positions(&mesh, &mut blob) };
        let indices = document.indices(&mesh, &mut blob);
        let number = document.meshes.len();
        document.scenes[0].nodes.push(number);
        document.nodes.push(Node { mesh: number, name: part.name });
        document.meshes.push(MeshEntry { name: part.name, primitives: [Primitive { attributes, indices, material }] });
    }
    document.buffers[0].byte_length = blob.len();

    let mut json = serde_json::to_vec(&document)?;
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut file = Vec::with_capacity(28 + json.len() + blob.len());
    let words = |file: &mut Vec<u8>, words: [u32; 2]| words.iter().for_each(|w| file.extend(w.to_le_bytes()));
    file.extend(b"glTF");
    words(&mut file, [2, (28 + json.len() + blob.len()) as u32]);
    words(&mut file, [json.len() as u32, u32::from_le_bytes(*b"JSON")]);
    file.extend(&json);
    words(&mut file, [blob.len() as u32, u32::from_le_bytes(*b"BIN\0")]);
    file.extend(&blob);
    Ok(file)
}

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Document {
    asset: Asset,
    scene: usize,
    scenes: [Scene; 1],
    nodes: Vec<Node>,
    meshes: Vec<MeshEntry>,
    materials: Vec<MaterialEntry>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<BufferView>,
    buffers: [Buffer; 1],
}

#[derive(Serialize)]
struct Asset {
    version: &'static str,
    generator: &'static str,
    copyright: &'static str,
}

#[derive(Serialize)]
struct Scene {
    name: &'static str,
    nodes: Vec<usize>,
}

#[derive(Serialize)]
struct Node {
    mesh: usize,
    name: &'static str,
}

#[derive(Serialize)]
struct MeshEntry {
    name: &'static str,
    primitives: [Primitive; 1],
}

#[derive(Serialize)]
struct Primitive {
    attributes: Attributes,
    indices: usize,
    material: usize,
}

#[derive(Serialize)]
struct Attributes {
    #[serde(rename = "POSITION")]
    position: usize,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct MaterialEntry {
    name: &'static str,
    pbr_metallic_roughness: Shading,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Shading {
    base_color_factor: [f32; 4],
    metallic_factor: f32,
    roughness_factor: f32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: usize,
    component_type: u32,
    count: usize,
    #[serde(rename = "type")]
    kind: &'static str,
    #[serde(flatten)]
    bounds: Option<Bounds>,
}

/// glTF asks for these on positions.
#[derive(Serialize)]
struct Bounds {
    min: [f32; 3],
    max: [f32; 3],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct BufferView {
    buffer: usize,
    byte_offset: usize,
    byte_length: usize,
    target: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Buffer {
    byte_length: usize,
}

impl Document {
    fn new(object: &Object) -> Self {
        Self {
            asset: Asset { version: "2.0", generator: "ensonify starter_catalog", copyright: "CC0-1.0" },
            scene: 0,
            scenes: [Scene { name: object.uid, nodes: Vec::new() }],
            nodes: Vec::new(),
            meshes: Vec::new(),
            materials: Vec::new(),
            accessors: Vec::new(),
            buffer_views: Vec::new(),
            buffers: [Buffer { byte_length: 0 }],
        }
    }

    /// Number of the material's entry, made when first asked for.
    fn material(&mut self, material: Material) -> usize {
        let known = self.materials.iter().position(|entry| entry.name == material.name());
        known.unwrap_or_else(|| {
            self.materials.push(MaterialEntry {
                name: material.name(),
                pbr_metallic_roughness: Shading {
                    base_color_factor: material.colour(),
                    metallic_factor: material.metallic(),
                    roughness_factor: 0.8,
                },
            });
            self.materials.len() - 1
        })
    }

    /// Number of the accessor to a mesh's positions.
    fn positions(&mut self, mesh: &Mesh, blob: &mut Vec<u8>) -> usize {
        let buffer_view = self.view(blob, ARRAY_BUFFER, |blob| {
            mesh.positions.iter().flat_map(|p| p.to_array()).for_each(|x| blob.extend(x.to_le_bytes()));
        });
        let low = mesh.positions.iter().copied().reduce(glam::Vec3::min).unwrap_or_default();
        let high = mesh.positions.iter().copied().reduce(glam::Vec3::max).unwrap_or_default();
        self.accessors.push(Accessor {
            buffer_view,
            component_type: FLOAT,
            count: mesh.positions.len(),
            kind: "VEC3",
            bounds: Some(Bounds { min: low.to_array(), max: high.to_array() }),
        });
        self.accessors.len() - 1
    }

    /// Number of the accessor to a mesh's indices: 16 bits wide where they fit (65535 is reserved).
    fn indices(&mut self, mesh: &Mesh, blob: &mut Vec<u8>) -> usize {
        let wide = mesh.positions.len() > usize::from(u16::MAX);
        let indices = || mesh.triangles.iter().flatten().copied();
        let buffer_view = self.view(blob, ELEMENT_ARRAY_BUFFER, |blob| match wide {
            true => indices().for_each(|v| blob.extend(v.to_le_bytes())),
            false => indices().for_each(|v| blob.extend((v as u16).to_le_bytes())),
        });
        self.accessors.push(Accessor {
            buffer_view,
            component_type: if wide { UNSIGNED_INT } else { UNSIGNED_SHORT },
            count: 3 * mesh.triangles.len(),
            kind: "SCALAR",
            bounds: None,
        });
        self.accessors.len() - 1
    }

    /// Number of the view of what `fill` appends to the blob; the next one starts on a multiple of four bytes.
    fn view(&mut self, blob: &mut Vec<u8>, target: u32, fill: impl FnOnce(&mut Vec<u8>)) -> usize {
        let byte_offset = blob.len();
        fill(blob);
        self.buffer_views.push(BufferView { buffer: 0, byte_offset, byte_length: blob.len() - byte_offset, target });
        blob.resize(blob.len().next_multiple_of(4), 0);
        self.buffer_views.len() - 1
    }
}
