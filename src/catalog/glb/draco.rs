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

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::catalog::error::CatalogError;
    use crate::catalog::glb::tests::{cube, glb, load, volume};
    use crate::catalog::model::Model;

    /// A cube of side 1, positions in 8 bits, as draco-core 2.3.3 writes it: edgebreaker.
    const EDGEBREAKER: &str = "445241434f02020101000000080c000b0000035f4b1501011001ff000001000903000002010101000303\
        012001200300b0429c2002050800000000ff000000000000bf000000bf000000bf0000803f08";
    /// The same, sequential.
    const SEQUENTIAL: &str = "445241434f0202010000000c080100020300030104050704070600010500050402060702070300040600\
        0602010307010705010100090300000200010100030301280118030048b188112d460000000000ff000000000000bf000000bf000000bf\
        0000803f08";

    fn bytes(hex: &str) -> Vec<u8> {
        (0..hex.len() / 2).map(|k| u8::from_str_radix(&hex[2 * k..2 * k + 2], 16).expect("hex")).collect()
    }

    /// A file of one compressed cube on two nodes; its accessors have no data of their own.
    fn compressed(stream: &[u8], edit: impl Fn(&mut Value)) -> Result<Model, CatalogError> {
        let mut padded: Vec<u8> = stream.to_vec();
        padded.resize(padded.len().next_multiple_of(12), 0);
        let floats: Vec<f32> = padded.chunks(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        let words = floats.chunks(3).map(|b| [b[0], b[1], b[2]]).collect();
        let nodes = json!([{"mesh": 0}, {"mesh": 0, "translation": [2.0, 0.0, 0.0]}]);
        load(&glb(&(words, cube().1), nodes, |root| {
            root["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
            root["bufferViews"][0]["byteLength"] = json!(stream.len());
            root["accessors"] = json!([{"componentType": 5126, "count": 8, "type": "VEC3"},
                {"componentType": 5125, "count": 36, "type": "SCALAR"}]);
            root["meshes"][0]["primitives"][0]["extensions"] =
                json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}});
            edit(root);
        }))
    }

    #[test]
    fn both_ways_of_compression_give_the_cube() {
        for stream in [EDGEBREAKER, SEQUENTIAL] {
            let model = compressed(&bytes(stream), |_| ()).expect("a sound file");
            assert_eq!(model.parts.iter().map(|part| part.triangles.len()).sum::<usize>(), 24);
            assert!((volume(&model) - 2.0).abs() < 1e-2, "{}", volume(&model));
            let (low, high) = model.bounds().expect("triangles");
            assert!((low.x + 0.5).abs() < 1e-2 && (high.x - 2.5).abs() < 1e-2, "{low} {high}");
        }
    }

    #[test]
    fn broken_streams_say_where() {
        let whole = bytes(EDGEBREAKER);
        for length in 0..whole.len() {
            let error = compressed(&whole[..length], |_| ()).expect_err("cut off").to_string();
            assert!(error.contains("bufferViews[0]: its Draco data"), "{error}");
        }
        let other = |root: &mut Value| {
            root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] =
                json!(4);
        };
        assert!(compressed(&whole, other).expect_err("none such").to_string().contains("no attribute 4"));
        // A sequential stream that announces a thousand million triangles.
        let mut many = bytes(SEQUENTIAL);
        many.splice(11..12, [0x80, 0x94, 0xEB, 0xDC, 0x03]);
        let error = compressed(&many, |_| ()).expect_err("too many").to_string();
        assert!(error.contains("its Draco data"), "{error}");
    }
}
