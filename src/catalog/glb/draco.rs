//! Primitives compressed by KHR_draco_mesh_compression.
//!
//! Several primitives and nodes may share one stream: each is decoded once. Knows nothing of accessors.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use draco_core::draco_types::DataType;
use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointAttribute};

use super::file::File;
use crate::catalog::error::ModelFault;

/// Most triangles of one stream, whatever its length.
const MAX_TRIANGLES: u64 = 20_000_000;
/// Triangles that the shortest stream may hold.
const FREE_TRIANGLES: u64 = 100_000;
/// Triangles that each byte of a stream may hold: even large flat grids need more bytes than that.
const TRIANGLES_PER_BYTE: u64 = 64;

/// Decoded streams by buffer view.
pub(super) type Streams = RefCell<BTreeMap<u32, Rc<Stream>>>;

/// A decoded stream.
#[derive(Debug)]
pub(super) struct Stream {
    mesh: Mesh,
    place: String,
}

impl File<'_> {
    /// The stream in a buffer view.
    pub fn draco(&self, view: u32) -> Result<Rc<Stream>, ModelFault> {
        if let Some(stream) = self.streams.borrow().get(&view) {
            return Ok(stream.clone());
        }
        let stream = Rc::new(Stream::decode(self.view(view)?.bytes, format!("bufferViews[{view}]"))?);
        self.spend_bytes(stream.size())?;
        self.streams.borrow_mut().insert(view, stream.clone());
        Ok(stream)
    }
}

impl Stream {
    fn decode(bytes: &[u8], place: String) -> Result<Self, ModelFault> {
        let most = MAX_TRIANGLES.min(FREE_TRIANGLES + TRIANGLES_PER_BYTE * bytes.len() as u64);
        let limits = DecodeLimits::default()
            .with_max_faces(most)
            .with_max_points(3 * most)
            .with_max_decoded_bytes(super::folder::MAX_BYTES.min(200 * most));
        let mut mesh = Mesh::new();
        let decoded = MeshDecoder::new().decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh);
        match decoded {
            Ok(()) => Ok(Self { mesh, place }),
            Err(error) => Err(ModelFault::broken(place, format!("its Draco data: {error}"))),
        }
    }

    /// Bytes that it takes.
    fn size(&self) -> u64 {
        let attributes = (0..self.mesh.num_attributes()).map(|k| self.mesh.attribute(k).buffer().data().len() as u64);
        attributes.sum::<u64>() + 12 * self.triangle_count()
    }

    pub fn vertex_count(&self) -> u64 {
        self.mesh.num_points() as u64
    }

    pub fn triangle_count(&self) -> u64 {
        self.mesh.num_faces() as u64
    }

    /// Vertex numbers, all of them in range.
    pub fn triangles(&self) -> Result<Vec<[u32; 3]>, ModelFault> {
        let triangles: Vec<[u32; 3]> = self.mesh.faces().iter().map(|face| face.map(|point| point.0)).collect();
        match triangles.iter().flatten().find(|&&vertex| u64::from(vertex) >= self.vertex_count()) {
            Some(vertex) => Err(self.broken(format!("vertex {vertex} of {}", self.vertex_count()))),
            None => Ok(triangles),
        }
    }

    /// An attribute of `N` components a vertex; `normalized` as the accessor says.
    pub fn floats<const N: usize>(&self, id: u32, normalized: Scale) -> Result<Vec<[f32; N]>, ModelFault> {
        let attribute = self.attribute::<N>(id)?;
        let full = match (normalized, attribute.data_type()) {
            (Scale::AsIs, _) => 1.0,
            (Scale::Normalized, DataType::Int8) => 127.0,
            (Scale::Normalized, DataType::Uint8) => 255.0,
            (Scale::Normalized, DataType::Int16) => 32_767.0,
            (Scale::Normalized, DataType::Uint16) => 65_535.0,
            (Scale::Normalized, _) => 1.0,
        };
        let values = attribute.read_f32s(self.mesh.num_points(), N);
        let pieces = values.chunks_exact(N);
        Ok(pieces.map(|piece| std::array::from_fn(|k| if full == 1.0 { piece[k] } else { piece[k] / full })).collect())
    }

    /// An attribute of `N` whole numbers a vertex.
    pub fn integers<const N: usize>(&self, id: u32) -> Result<Vec<[u32; N]>, ModelFault> {
        // Joint numbers are below 2^24, where floats are exact.
        Ok(self.floats::<N>(id, Scale::AsIs)?.into_iter().map(|piece| piece.map(|value| value as u32)).collect())
    }

    fn attribute<const N: usize>(&self, id: u32) -> Result<&PointAttribute, ModelFault> {
        let attribute = self.mesh.attribute_by_unique_id(id);
        let attribute = attribute.ok_or_else(|| self.broken(format!("it has no attribute {id}")))?;
        if usize::from(attribute.num_components()) != N {
            return Err(self.broken(format!("attribute {id} has {} components, not {N}", attribute.num_components())));
        }
        Ok(attribute)
    }

    fn broken(&self, problem: String) -> ModelFault {
        ModelFault::broken(&self.place, format!("its Draco data: {problem}"))
    }
}

/// What integers stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    AsIs,
    /// Fractions of the largest.
    Normalized,
}
