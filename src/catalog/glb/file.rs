//! A glTF file as JSON and the bytes of its buffers and views.
//!
//! Buffers are read when geometry asks for them: those of textures are never touched. Knows nothing of accessors or nodes.

use std::borrow::Cow;
use std::cell::{Cell, OnceCell};
use std::collections::BTreeMap;

use super::container::Container;
use super::draco::Streams;
use super::folder::{Folder, MAX_BYTES};
use super::schema::{Buffer, BufferView, Root};
use super::{meshopt, uri};
use crate::catalog::error::{ModelFault, short};

/// Most numbers that are read from one file, those of shared accessors counted each time.
const MAX_NUMBERS: u64 = 250_000_000;

/// Required extensions whose geometry is read.
const GEOMETRY: [&str; 6] = [
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",
    "KHR_node_visibility",
];

/// Beginnings of extensions that may be required although nothing here reads them: no surface depends on them.
const NO_GEOMETRY: [&str; 24] = [
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_xmp",
    "KHR_techniques_webgl",
    "KHR_animation_pointer",
    "KHR_node_selectability",
    "KHR_node_hoverability",
    "KHR_interactivity",
    "KHR_audio",
    "EXT_texture_",
    "EXT_lights_",
    "EXT_materials_",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_instance_features",
    "EXT_structural_metadata",
    "MSFT_texture_",
    "MSFT_packing_",
    "MSFT_lod",
    "ADOBE_materials_",
    "AGI_",
    "CESIUM_primitive_outline",
    "FB_geometry_metadata",
];

/// A parsed file.
pub(super) struct File<'a> {
    pub root: Root<'a>,
    bin: Option<&'a [u8]>,
    folder: &'a Folder,
    buffers: Vec<OnceCell<Cow<'a, [u8]>>>,
    /// Decompressed views, by number.
    views: BTreeMap<usize, OnceCell<Vec<u8>>>,
    pub streams: Streams,
    /// Bytes read or decompressed.
    bytes: Cell<u64>,
    numbers: Cell<u64>,
}

/// The bytes of a buffer view.
pub(super) struct View<'a> {
    pub bytes: &'a [u8],
    pub stride: Option<u64>,
}

impl<'a> File<'a> {
    /// Parses the bytes of a `.glb` or `.gltf`; `folder` is where its buffers may lie.
    pub fn parse(bytes: &'a [u8], folder: &'a Folder) -> Result<Self, ModelFault> {
        let Container { json, bin } = Container::of(bytes)?;
        let root = parse_json(json)?;
        check_version(&root)?;
        check_extensions(&root)?;
        let compressed = |view: &BufferView| view.extensions.as_ref().is_some_and(|e| e.meshopt().is_some());
        let views = root.buffer_views.iter().enumerate().filter(|(_, view)| compressed(view));
        Ok(Self {
            bin,
            folder,
            buffers: root.buffers.iter().map(|_| OnceCell::new()).collect(),
            views: views.map(|(number, _)| (number, OnceCell::new())).collect(),
            streams: Streams::default(),
            bytes: Cell::new(bytes.len() as u64),
            numbers: Cell::new(0),
            root,
        })
    }

    /// The bytes of a view, decompressed.
    pub fn view(&self, number: u32) -> Result<View<'_>, ModelFault> {
        let place = || format!("bufferViews[{number}]");
        let view = self.root.buffer_views.get(number as usize);
        let view = view.ok_or_else(|| ModelFault::broken(place(), "it does not exist"))?;
        let (Some(decoded), Some(packed)) =
            (self.views.get(&(number as usize)), view.extensions.as_ref().and_then(|e| e.meshopt()))
        else {
            let bytes = self.range(view.buffer, view.byte_offset, view.byte_length).map_err(|e| e.at(place))?;
            return Ok(View { bytes, stride: view.byte_stride });
        };
        let bytes = once(decoded, || {
            let source = self.range(packed.buffer, packed.byte_offset, packed.byte_length).map_err(|e| e.at(place))?;
            self.spend_bytes(packed.count.saturating_mul(packed.byte_stride))?;
            meshopt::decode(source, packed).map_err(|problem| ModelFault::broken(place(), problem))
        })?;
        Ok(View { bytes, stride: Some(packed.byte_stride) })
    }

    fn range(&self, buffer: u32, start: u64, length: u64) -> Result<&[u8], RangeFault> {
        let bytes = self.buffer(buffer)?;
        let start = usize::try_from(start).ok();
        let range = start.zip(usize::try_from(length).ok()).and_then(|(start, length)| {
            let end = start.checked_add(length)?;
            bytes.get(start..end)
        });
        range.ok_or_else(|| RangeFault::Beyond(format!("it ends beyond buffers[{buffer}] ({} bytes)", bytes.len())))
    }

    fn buffer(&self, number: u32) -> Result<&[u8], RangeFault> {
        let about = self.root.buffers.get(number as usize).zip(self.buffers.get(number as usize));
        let (buffer, cell) = about.ok_or_else(|| RangeFault::Beyond(format!("there is no buffers[{number}]")))?;
        let bytes = once(cell, || self.load(number, buffer))?;
        Ok(bytes)
    }

    fn load(&self, number: u32, buffer: &Buffer) -> Result<Cow<'a, [u8]>, ModelFault> {
        let place = format!("buffers[{number}]");
        let data = match buffer.uri.as_ref().map(|uri| &*uri.0) {
            None => self.bin.filter(|_| number == 0).map(Cow::Borrowed).ok_or("it has no data"),
            Some(uri) => match uri::data(uri) {
                Some(data) => data.map(Cow::Owned),
                None => {
                    let left = MAX_BYTES - self.bytes.get().min(MAX_BYTES);
                    Ok(Cow::Owned(self.folder.read_uri(uri, &place, left)?))
                }
            },
        };
        let data = data.map_err(|problem| ModelFault::broken(&place, problem))?;
        if let Cow::Owned(data) = &data {
            self.spend_bytes(data.len() as u64)?;
        }
        if (data.len() as u64) < buffer.byte_length {
            let problem = format!("{} bytes are there, {} are announced", data.len(), buffer.byte_length);
            return Err(ModelFault::broken(place, problem));
        }
        Ok(data)
    }

    /// Counts bytes against what one model may take, before they are made.
    pub fn spend_bytes(&self, count: u64) -> Result<(), ModelFault> {
        self.bytes.set(self.bytes.get().saturating_add(count));
        ModelFault::limit("bytes with its buffers and decompressed", self.bytes.get(), MAX_BYTES)
    }

    /// Counts numbers against what may be read from one model, before they are read.
    pub fn spend_numbers(&self, count: u64) -> Result<(), ModelFault> {
        self.numbers.set(self.numbers.get().saturating_add(count));
        ModelFault::limit("numbers in all places where it uses them", self.numbers.get(), MAX_NUMBERS)
    }
}

/// What is wrong with a range of a buffer: with the range, or with the buffer itself.
enum RangeFault {
    Beyond(String),
    Buffer(ModelFault),
}

impl RangeFault {
    fn at(self, place: impl Fn() -> String) -> ModelFault {
        match self {
            Self::Beyond(problem) => ModelFault::broken(place(), problem),
            Self::Buffer(fault) => fault,
        }
    }
}

impl From<ModelFault> for RangeFault {
    fn from(fault: ModelFault) -> Self {
        Self::Buffer(fault)
    }
}

/// The value of a cell, made on first use; an error is not kept.
pub(super) fn once<T>(cell: &OnceCell<T>, make: impl FnOnce() -> Result<T, ModelFault>) -> Result<&T, ModelFault> {
    if cell.get().is_none() {
        let value = make()?;
        return Ok(cell.get_or_init(|| value));
    }
    Ok(cell.get().expect("it was just seen"))
}

fn parse_json(json: &[u8]) -> Result<Root<'_>, ModelFault> {
    serde_json::from_slice(json).map_err(|plain| {
        // Only now, as finding the place takes time.
        let mut reader = serde_json::Deserializer::from_slice(json);
        match serde_path_to_error::deserialize::<_, Root>(&mut reader) {
            Err(error) if !error.path().to_string().starts_with('.') => {
                ModelFault::broken(error.path().to_string(), error.inner().to_string())
            }
            _ => ModelFault::NotGltf(short(&plain.to_string())),
        }
    })
}

fn check_version(root: &Root) -> Result<(), ModelFault> {
    let version = &root.asset.version.0;
    if !version.starts_with("2.") {
        return Err(ModelFault::NotGltf(short(&format!("its version is {version:?}"))));
    }
    match &root.asset.min_version {
        Some(least) if least.0 != "2.0" => Err(ModelFault::NotGltf(short(&format!("it needs version {:?}", least.0)))),
        _ => Ok(()),
    }
}

fn check_extensions(root: &Root) -> Result<(), ModelFault> {
    let known = |name: &str| GEOMETRY.contains(&name) || NO_GEOMETRY.iter().any(|start| name.starts_with(start));
    let mut unknown = root.extensions_required.iter().map(|name| &*name.0).filter(|name| !known(name));
    match unknown.next() {
        None => Ok(()),
        Some(first) => {
            let others = unknown.take(5).map(|name| format!(", {}", short(name)));
            Err(ModelFault::Extension(std::iter::once(short(first)).chain(others).collect()))
        }
    }
}
