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
