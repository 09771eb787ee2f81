//! The container: GLB chunks, or plain JSON.
//!
//! Knows nothing of what the JSON says; counts its parts, so that a small file cannot ask for much memory.
//!
//! Source: Khronos Group (2021), glTF 2.0 specification, section 4 (GLB file format).

use crate::catalog::error::ModelFault;

/// Most objects in the JSON of one file.
const MAX_OBJECTS: u64 = 1_500_000;
/// Most values in the JSON of one file.
const MAX_VALUES: u64 = 32_000_000;

const JSON: &[u8] = b"JSON";
const BIN: &[u8] = b"BIN\0";

/// The two halves of a file.
#[derive(Debug)]
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    /// The binary chunk of a GLB.
    pub bin: Option<&'a [u8]>,
}

impl<'a> Container<'a> {
    pub fn of(bytes: &'a [u8]) -> Result<Self, ModelFault> {
        let mut container = if bytes.starts_with(b"glTF") { glb(bytes)? } else { Self { json: bytes, bin: None } };
        // Not allowed, but some exporters write a byte order mark and nobody is harmed.
        container.json = container.json.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(container.json);
        match container.json.trim_ascii_start().first() {
            Some(b'{') => {}
            _ if bytes.is_empty() => return Err(fault("it is empty")),
            _ if bytes.starts_with(b"version https://git-lfs") => {
                return Err(fault("it is a Git LFS pointer, not the model (`git lfs pull` fetches it)"));
            }
            _ => return Err(fault("it holds no JSON object")),
        }
        limit_parts(container.json)?;
        Ok(container)
    }
}

fn fault(problem: impl Into<String>) -> ModelFault {
    ModelFault::NotGltf(problem.into())
}

fn glb(bytes: &[u8]) -> Result<Container<'_>, ModelFault> {
    let (Some(version), Some(length)) = (word(bytes, 4), word(bytes, 8)) else {
        return Err(fault("its header is cut off"));
    };
    if version != 2 {
        return Err(fault(format!("its GLB version is {version}")));
    }
    // Bytes after the announced end are no part of it.
    let Some(bytes) = bytes.get(..length as usize) else {
        return Err(fault(format!("{} bytes are there, {length} are announced", bytes.len())));
    };
    let (kind, json, mut at) = chunk(bytes, 12)?;
    if kind != JSON {
        return Err(fault("its first chunk is not JSON"));
    }
    while at < bytes.len() {
        let (kind, data, next) = chunk(bytes, at)?;
        if kind == BIN {
            return Ok(Container { json, bin: Some(data) });
        }
        at = next;
    }
    Ok(Container { json, bin: None })
}

/// Kind and data of the chunk at a place, and where the next begins.
fn chunk(bytes: &[u8], at: usize) -> Result<(&[u8], &[u8], usize), ModelFault> {
    let (Some(length), Some(kind)) = (word(bytes, at), bytes.get(at.saturating_add(4)..at.saturating_add(8))) else {
        return Err(fault(format!("the chunk at byte {at} is cut off")));
    };
    let end = (at + 8).saturating_add(length as usize);
    match bytes.get(at + 8..end) {
        Some(data) => Ok((kind, data, end)),
        None => Err(fault(format!("the chunk at byte {at} announces {length} bytes, more than there are"))),
    }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
}

/// Counts objects and values before anything is made of them.
fn limit_parts(json: &[u8]) -> Result<(), ModelFault> {
    let (mut objects, mut values, mut at) = (0, 0, 0);
    while let Some(&byte) = json.get(at) {
        at += 1;
        match byte {
            b'{' => objects += 1,
            b',' => values += 1,
            b'"' => at += quoted(&json[at..]),
            _ => {}
        }
    }
    ModelFault::limit("JSON objects", objects, MAX_OBJECTS)?;
    ModelFault::limit("JSON values", values, MAX_VALUES)
}

/// Length of a text up to and with its closing quote.
fn quoted(text: &[u8]) -> usize {
    let mut at = 0;
    while let Some(&byte) = text.get(at) {
        at += 1;
        match byte {
            b'"' => return at,
            b'\\' => at += 1,
            _ => {}
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb_of(version: u32, chunks: &[(&[u8], &[u8])]) -> Vec<u8> {
        let mut out = b"glTF".to_vec();
        out.extend(version.to_le_bytes());
        out.extend([0; 4]);
        for (kind, data) in chunks {
            out.extend((data.len() as u32).to_le_bytes());
            out.extend(*kind);
            out.extend(*data);
        }
        let length = out.len() as u32;
        out[8..12].copy_from_slice(&length.to_le_bytes());
        out
    }

    #[test]
    fn chunks_are_found_and_unknown_ones_passed_over() {
        let bytes = glb_of(2, &[(JSON, b"{}  "), (b"ODD\0", b"1234"), (BIN, b"data")]);
        let container = Container::of(&bytes).expect("a container");
        assert_eq!((container.json, container.bin), (&b"{}  "[..], Some(&b"data"[..])));
        let longer = [bytes.as_slice(), b"more"].concat();
        assert_eq!(Container::of(&longer).expect("a container").bin, Some(&b"data"[..]));
        let plain = Container::of(b"\xEF\xBB\xBF {}").expect("JSON");
        assert_eq!((plain.json, plain.bin), (&b" {}"[..], None));
    }

    #[test]
    fn what_is_cut_off_or_something_else_says_so() {
        let whole = glb_of(2, &[(JSON, b"{}  "), (BIN, b"data")]);
        for length in 0..whole.len() {
            assert!(Container::of(&whole[..length]).is_err(), "cut at {length}");
        }
        let mut long = whole.clone();
        long[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
        let cases: [(&[u8], &str); 6] = [
            (b"", "empty"),
            (b"<html>", "no JSON"),
            (b"version https://git-lfs.github.com/spec/v1", "LFS"),
            (&glb_of(1, &[(JSON, b"{}  ")]), "version is 1"),
            (&glb_of(2, &[(BIN, b"{}  ")]), "first chunk"),
            (&long, "announces 4294967295 bytes"),
        ];
        for (bytes, expected) in cases {
            let error = Container::of(bytes).expect_err(expected).to_string();
            assert!(error.contains(expected), "{error}");
        }
    }

    #[test]
    fn parts_are_counted_outside_of_texts() {
        limit_parts(br#"{"a\"{{{,,,": "{,\\"}"#).expect("few");
        let many = [b"[".as_slice(), &b"{},".repeat(MAX_OBJECTS as usize + 1)].concat();
        assert!(limit_parts(&many).expect_err("many").to_string().contains("JSON objects"));
    }
}
