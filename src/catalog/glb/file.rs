//! A glTF file as JSON and buffers: the container, relative `.bin` files and `data:` URIs.
//!
//! Knows nothing of accessors or nodes.

use std::fs;
use std::path::{Component, Path, PathBuf};

use gltf::json::Root;

use crate::catalog::error::ModelFault;

/// Largest file read, bytes.
const MAX_BYTES: u64 = 512 << 20;

/// Extensions that may be required although nothing here reads them: they touch appearance only.
const APPEARANCE: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "EXT_texture_avif",
    "EXT_texture_webp",
    "MSFT_texture_dds",
];

/// A parsed file with the bytes of its buffers.
pub(super) struct File {
    pub root: Root,
    pub buffers: Vec<Vec<u8>>,
}

impl File {
    /// Reads a `.glb` or `.gltf` and everything that its buffers point to.
    pub fn open(path: &Path) -> Result<Self, ModelFault> {
        let bytes = read_limited(path)?;
        let (root, blob) = parse(&bytes)?;
        if let Some(name) = root.extensions_required.iter().find(|name| !is_about_appearance(name)) {
            return Err(ModelFault::Extension(name.clone()));
        }
        let mut blob = blob;
        let mut buffers = Vec::with_capacity(root.buffers.len());
        for (number, buffer) in root.buffers.iter().enumerate() {
            let place = || format!("buffers[{number}]");
            let data = match &buffer.uri {
                Some(uri) => resolve(uri, path, &place())?,
                None if number == 0 => blob.take().ok_or_else(|| ModelFault::broken(place(), "it has no data"))?,
                None => return Err(ModelFault::broken(place(), "it has no data")),
            };
            if (data.len() as u64) < buffer.byte_length.0 {
                let problem = format!("{} bytes are there, {} are announced", data.len(), buffer.byte_length.0);
                return Err(ModelFault::broken(place(), problem));
            }
            buffers.push(data);
        }
        Ok(Self { root, buffers })
    }
}

fn is_about_appearance(extension: &str) -> bool {
    extension.starts_with("KHR_materials_") || APPEARANCE.contains(&extension)
}

fn read_limited(path: &Path) -> Result<Vec<u8>, ModelFault> {
    let count = fs::metadata(path)?.len();
    if count > MAX_BYTES {
        return Err(ModelFault::TooLarge { what: "bytes", count, limit: MAX_BYTES });
    }
    Ok(fs::read(path)?)
}

fn parse(bytes: &[u8]) -> Result<(Root, Option<Vec<u8>>), ModelFault> {
    if bytes.starts_with(b"glTF") {
        // The container reader subtracts the header from this length without looking.
        let announced = bytes.get(8..12).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        if announced.is_none_or(|length| length < 12) {
            return Err(ModelFault::NotGltf("its header is cut off".into()));
        }
        let glb = gltf::Glb::from_slice(bytes).map_err(|e| ModelFault::NotGltf(e.to_string()))?;
        Ok((parse_json(&glb.json)?, glb.bin.map(|bin| bin.into_owned())))
    } else {
        Ok((parse_json(bytes)?, None))
    }
}

fn parse_json(json: &[u8]) -> Result<Root, ModelFault> {
    let root: Root = gltf::json::deserialize::from_slice(json).map_err(|e| ModelFault::NotGltf(e.to_string()))?;
    if root.asset.version.starts_with("2.") {
        Ok(root)
    } else {
        Err(ModelFault::NotGltf(format!("its version is {:?}", root.asset.version)))
    }
}

fn resolve(uri: &str, model: &Path, place: &str) -> Result<Vec<u8>, ModelFault> {
    if let Some(data) = uri.strip_prefix("data:") {
        let text = data.split_once(";base64,").map(|(_, text)| text);
        let decoded = text.and_then(base64);
        return decoded.ok_or_else(|| ModelFault::broken(place, "its data: URI is not base64"));
    }
    let relative = PathBuf::from(percent_decoded(uri));
    if relative.components().any(|part| !matches!(part, Component::Normal(_) | Component::CurDir)) {
        return Err(ModelFault::broken(place, format!("{uri:?} leaves the model's folder")));
    }
    let file = model.parent().unwrap_or(Path::new("")).join(relative);
    read_limited(&file).map_err(|fault| ModelFault::broken(place, format!("{uri:?} {fault}")))
}

fn percent_decoded(uri: &str) -> String {
    let bytes = uri.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let escaped = (bytes[at] == b'%').then(|| uri.get(at + 1..at + 3)).flatten();
        match escaped.and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(byte) => {
                out.push(byte);
                at += 3;
            }
            None => {
                out.push(bytes[at]);
                at += 1;
            }
        }
    }
    String::from_utf8_lossy(&out).into_owned()
}

fn base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=');
    let mut out = Vec::with_capacity(text.len() / 4 * 3 + 2);
    let (mut bits, mut held) = (0u32, 0u32);
    for symbol in text.bytes() {
        let value = match symbol {
            b'A'..=b'Z' => symbol - b'A',
            b'a'..=b'z' => symbol - b'a' + 26,
            b'0'..=b'9' => symbol - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return None,
        };
        bits = (bits << 6) | u32::from(value);
        held += 6;
        if held >= 8 {
            held -= 8;
            out.push((bits >> held) as u8);
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_and_percent_signs_are_decoded() {
        assert_eq!(base64("c29uYXI=").as_deref(), Some(&b"sonar"[..]));
        assert_eq!(base64("+/8=").as_deref(), Some(&[0xFB, 0xFF][..]));
        assert_eq!(base64("a*"), None);
        assert_eq!(percent_decoded("a%20b%E2%9A%93%z"), "a b⚓%z");
    }
}
