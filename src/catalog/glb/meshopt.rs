//! Buffer views compressed by EXT_meshopt_compression or KHR_meshopt_compression.

use draco_gltf::meshopt::decode_buffer_view;
use draco_gltf::{MeshoptFilter, MeshoptMode};

use super::schema::{Meshopt, ViewExtensions};

impl ViewExtensions {
    pub fn meshopt(&self) -> Option<&Meshopt> {
        self.khr_meshopt.as_ref().or(self.ext_meshopt.as_ref())
    }
}

/// The bytes of a view; their number is known to be bearable.
pub(super) fn decode(source: &[u8], packed: &Meshopt) -> Result<Vec<u8>, String> {
    let (count, stride) = (packed.count as usize, packed.byte_stride as usize);
    let mode = MeshoptMode::from_name(&packed.mode).map_err(|e| e.to_string())?;
    let filter = MeshoptFilter::from_name(packed.filter.as_deref().unwrap_or("NONE")).map_err(|e| e.to_string())?;
    let fits = match mode {
        MeshoptMode::Attributes => (4..=256).contains(&stride) && stride.is_multiple_of(4),
        MeshoptMode::Triangles => matches!(stride, 2 | 4) && count.is_multiple_of(3),
        MeshoptMode::Indices => matches!(stride, 2 | 4),
    };
    if !fits {
        return Err(format!("{count} elements of {stride} bytes cannot be compressed as {}", packed.mode));
    }
    let mut bytes = vec![0; count * stride];
    decode_buffer_view(&mut bytes, source, mode, filter, count, stride).map_err(|e| e.to_string())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::catalog::glb::tests::{cube, glb, load, volume};

    /// The vertex codec without any saving: each byte's zigzag differences as literals.
    fn literal_attributes(elements: &[Vec<u8>]) -> Vec<u8> {
        assert!(elements.len() <= 16, "one group");
        let mut out = vec![0xA0];
        for k in 0..elements[0].len() {
            out.push(3);
            let mut last = elements[0][k];
            for slot in 0..16 {
                let now = elements.get(slot).map_or(last, |element| element[k]);
                let difference = now.wrapping_sub(last) as i8;
                out.push(((difference << 1) ^ (difference >> 7)) as u8);
                last = now;
            }
        }
        out.resize(out.len() + 32 - elements[0].len(), 0);
        out.extend(&elements[0]);
        out
    }

    /// The index sequence codec with one baseline.
    fn sequence(indices: &[u32]) -> Vec<u8> {
        let mut out = vec![0xD1];
        let mut last = 0;
        for &index in indices {
            let difference = index as i32 - last;
            let mut value = (((difference << 1) ^ (difference >> 31)) as u32) << 1;
            while value > 127 {
                out.push(value as u8 | 128);
                value >>= 7;
            }
            out.push(value as u8);
            last = index as i32;
        }
        out.extend([0; 4]);
        out
    }

    #[test]
    fn a_cube_comes_through_both_names_of_the_extension() {
        let (positions, indices) = cube();
        let elements: Vec<Vec<u8>> =
            positions.iter().map(|p| p.iter().flat_map(|v| v.to_le_bytes()).collect()).collect();
        let (vertices, faces) = (literal_attributes(&elements), sequence(&indices));
        let mut packed = [vertices.as_slice(), &faces].concat();
        packed.resize(packed.len().next_multiple_of(12), 0);
        let words: Vec<f32> = packed.chunks(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        let carrier = (words.chunks(3).map(|b| [b[0], b[1], b[2]]).collect(), Vec::new());
        for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
            let bytes = glb(&carrier, json!([{"mesh": 0}]), |root| {
                let compressed = |offset: usize, length: usize, about: Value| {
                    let mut about = about;
                    about["buffer"] = json!(0);
                    about["byteOffset"] = json!(offset);
                    about["byteLength"] = json!(length);
                    // The buffer that a reader without the extension would take is not there.
                    json!({"buffer": 1, "byteLength": 1000, "extensions": {name: about}})
                };
                root["extensionsRequired"] = json!([name]);
                root["buffers"].as_array_mut().expect("buffers").push(json!({"byteLength": 1000}));
                root["bufferViews"] = json!([
                    compressed(0, vertices.len(), json!({"byteStride": 12, "count": 8, "mode": "ATTRIBUTES"})),
                    compressed(vertices.len(), faces.len(), json!({"byteStride": 4, "count": 36, "mode": "INDICES"}))
                ]);
                root["accessors"] = json!([{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
                    {"bufferView": 1, "componentType": 5125, "count": 36, "type": "SCALAR"}]);
            });
            let model = load(&bytes).expect("a sound file");
            assert_eq!((model.parts[0].triangles.len(), volume(&model)), (12, 1.0));
        }
    }

    #[test]
    fn strides_that_no_codec_has_are_refused() {
        let packed = |mode: &str, byte_stride, count| Meshopt {
            buffer: 0,
            byte_offset: 0,
            byte_length: 0,
            byte_stride,
            count,
            mode: mode.into(),
            filter: None,
        };
        for (mode, stride, count) in
            [("ATTRIBUTES", 260, 1), ("ATTRIBUTES", 6, 1), ("INDICES", 8, 1), ("TRIANGLES", 4, 4), ("INDICES", 0, 3)]
        {
            let error = decode(&[0xA0; 64], &packed(mode, stride, count)).expect_err(mode);
            assert!(error.contains("cannot be compressed"), "{error}");
        }
    }
}
