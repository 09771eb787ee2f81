//! Changes to model files: bytes, the JSON's numbers and structure, header and chunks.

use std::fs;
use std::path::Path;

use ensonify::catalog::read_model;
use ensonify::math::rng::Stream;
use serde_json::{Map, Value, json};

/// A file to make mutants of.
#[derive(Debug)]
pub struct Seed {
    /// File name.
    pub name: String,
    bytes: Vec<u8>,
    content: Content,
    /// The JSON, if it is some.
    json: Option<Value>,
    /// The binary chunk, if it is a GLB with one.
    bin: Option<Vec<u8>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    Geometry,
    Compressed,
    Other,
}

impl Seed {
    /// Reads a file; `None` for the few that hold nothing to change.
    pub fn open(path: &Path) -> Option<Self> {
        let bytes = fs::read(path).ok().filter(|bytes| bytes.len() > 20)?;
        let name = path.file_name()?.to_str()?.to_owned();
        let is_glb = bytes.starts_with(b"glTF");
        let length = |at: usize| Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?) as usize);
        let text = if is_glb { bytes.get(20..20 + length(12)?) } else { Some(&bytes[..]) };
        let bin = text.filter(|_| is_glb).and_then(|text| Some(bytes.get(28 + text.len()..)?.to_vec()));
        let json = text.and_then(|text| serde_json::from_slice(text).ok());
        let holds = |word: &str| bytes.windows(word.len()).any(|window| window == word.as_bytes());
        let content = match read_model(path, None) {
            Err(_) => Content::Other,
            Ok(_) if holds("draco") || holds("meshopt") => Content::Compressed,
            Ok(_) => Content::Geometry,
        };
        Some(Self { name, json, bin, content, bytes })
    }
}

/// A mutant by its number, and what it was made of: all seeds, those with geometry and those with compressed geometry
/// each have their share.
pub fn mutant(seeds: &[Seed], number: u64) -> (Vec<u8>, &Seed) {
    let mut draw = Stream::at(1, "mutants", number, "change");
    let share = draw.below(4);
    let eligible = |seed: &&Seed| match share {
        0 => true,
        1 | 2 => seed.content != Content::Other,
        _ => seed.content == Content::Compressed,
    };
    let some: Vec<&Seed> = seeds.iter().filter(eligible).collect();
    let seed = match any(some.len(), &mut draw) {
        Some(at) => some[at],
        None => &seeds[draw.below(seeds.len() as u64) as usize],
    };
    let bytes = match (draw.below(8), &seed.json) {
        (0..=4, Some(json)) => structured(seed, json.clone(), &mut draw),
        (5, _) => header(seed.bytes.clone(), &mut draw),
        (6, Some(json)) if seed.bin.is_some() => glb(json, &flipped(seed.bin.clone().unwrap_or_default(), &mut draw)),
        _ => flipped(seed.bytes.clone(), &mut draw),
    };
    (bytes, seed)
}

/// A few bytes changed anywhere.
fn flipped(mut bytes: Vec<u8>, draw: &mut Stream) -> Vec<u8> {
    for _ in 0..=draw.below(6) {
        if let Some(at) = any(bytes.len(), draw) {
            bytes[at] = match draw.below(3) {
                0 => draw.bits() as u8,
                1 => bytes[at] ^ (1 << draw.below(8)),
                _ => [0, 1, 0x7F, 0x80, 0xFF][draw.below(5) as usize],
            };
        }
    }
    bytes
}

/// The first words changed, or the length of the file.
fn header(mut bytes: Vec<u8>, draw: &mut Stream) -> Vec<u8> {
    match draw.below(4) {
        0 => bytes.truncate(draw.below(bytes.len() as u64) as usize),
        1 => bytes.extend((0..draw.below(64)).map(|k| k as u8)),
        2 => {
            let (from, to) = (draw.below(bytes.len() as u64) as usize, draw.below(bytes.len() as u64) as usize);
            bytes.drain(from.min(to)..from.max(to));
        }
        _ => {
            let at = 4 * draw.below(6) as usize;
            let word = extreme_word(draw).to_le_bytes();
            bytes.iter_mut().skip(at).zip(word).for_each(|(byte, new)| *byte = new);
        }
    }
    bytes
}

fn extreme_word(draw: &mut Stream) -> u32 {
    match draw.below(4) {
        0 => u32::MAX - draw.below(16) as u32,
        1 => (1 << 31) - draw.below(2) as u32,
        2 => draw.below(64) as u32,
        _ => draw.bits() as u32,
    }
}

/// The JSON changed in a few places, the binary chunk in some.
fn structured(seed: &Seed, mut json: Value, draw: &mut Stream) -> Vec<u8> {
    for _ in 0..=draw.below(5) / 2 {
        let donor = pick(&mut json, draw).clone();
        change(pick(&mut json, draw), donor, draw);
    }
    match &seed.bin {
        None => json.to_string().into_bytes(),
        Some(bin) if draw.below(3) == 0 => glb(&json, &flipped(bin.clone(), draw)),
        Some(bin) => glb(&json, bin),
    }
}

fn glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut out = b"glTF\x02\0\0\0".to_vec();
    out.extend((28 + text.len() as u32 + bin.len() as u32).to_le_bytes());
    out.extend((text.len() as u32).to_le_bytes());
    out.extend(b"JSON");
    out.extend(text);
    out.extend((bin.len() as u32).to_le_bytes());
    out.extend(b"BIN\0");
    out.extend(bin);
    out
}

/// A value somewhere in the tree; deeper ones as likely as those above.
fn pick<'a>(value: &'a mut Value, draw: &mut Stream) -> &'a mut Value {
    let inner = match value {
        Value::Array(items) => items.len(),
        Value::Object(members) => members.len(),
        _ => 0,
    };
    if inner == 0 || draw.below(8) == 0 {
        return value;
    }
    let at = draw.below(inner as u64) as usize;
    match value {
        Value::Array(items) => pick(&mut items[at], draw),
        Value::Object(members) => pick(members.values_mut().nth(at).expect("counted"), draw),
        other => other,
    }
}

fn change(value: &mut Value, donor: Value, draw: &mut Stream) {
    match (draw.below(6), &mut *value) {
        (0, _) => *value = donor,
        (1, _) => *value = [json!(null), json!("x"), json!([]), json!({}), json!(true)][draw.below(5) as usize].clone(),
        (_, Value::Number(number)) => *value = number_near(number.as_f64().unwrap_or(0.0), draw),
        (_, Value::String(text)) => *value = Value::String(text_near(text, draw)),
        (_, Value::Array(items)) => change_items(items, draw),
        (_, Value::Object(members)) => change_members(members, donor, draw),
        (_, other) => *other = json!(draw.below(4)),
    }
}

fn number_near(old: f64, draw: &mut Stream) -> Value {
    const EXTREMES: [f64; 18] = [
        0.0,
        1.0,
        -1.0,
        0.5,
        2.0,
        3.0,
        4.0,
        127.0,
        255.0,
        65_535.0,
        65_536.0,
        16_777_216.0,
        4_294_967_295.0,
        4_294_967_296.0,
        1.8e19,
        1e38,
        -1e300,
        1e-40,
    ];
    let new = match draw.below(5) {
        0 => old + 1.0,
        1 => old - 1.0,
        2 => old * 2.0,
        3 => draw.below(16) as f64,
        _ => EXTREMES[draw.below(EXTREMES.len() as u64) as usize],
    };
    // Whole numbers as such: with a fraction they would all be refused alike.
    if new.fract() == 0.0 && (0.0..1.9e19).contains(&new) { json!(new as u64) } else { json!(new) }
}

/// Letters changed; those of a `data:` URI to others of base64, which changes the data.
fn text_near(text: &str, draw: &mut Stream) -> String {
    const LETTERS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let names = [
        "VEC3",
        "VEC4",
        "SCALAR",
        "MAT4",
        "TRIANGLES",
        "INDICES",
        "ATTRIBUTES",
        "EXPONENTIAL",
        "QUATERNION",
        "",
        "../x",
    ];
    let mut letters: Vec<char> = text.chars().collect();
    let from = text.find(',').filter(|_| text.starts_with("data:")).map_or(0, |comma| comma + 1);
    if from == 0 && draw.below(2) == 0 || letters.len() <= from {
        return names[draw.below(names.len() as u64) as usize].into();
    }
    for _ in 0..=draw.below(4) {
        let at = from + draw.below((letters.len() - from) as u64) as usize;
        letters[at] = char::from(LETTERS[draw.below(64) as usize]);
    }
    letters.into_iter().collect()
}

fn change_items(items: &mut Vec<Value>, draw: &mut Stream) {
    let Some(at) = any(items.len(), draw) else { return items.push(json!(0)) };
    match draw.below(4) {
        0 => drop(items.remove(at)),
        1 => items.push(items[at].clone()),
        2 => {
            let other = draw.below(items.len() as u64) as usize;
            items.swap(at, other);
        }
        _ => {
            let item = items[at].clone();
            items.extend(std::iter::repeat_n(item, 200));
        }
    }
}

fn change_members(members: &mut Map<String, Value>, donor: Value, draw: &mut Stream) {
    let keys: Vec<String> = members.keys().cloned().collect();
    let Some(at) = any(keys.len(), draw) else { return };
    match draw.below(4) {
        0 | 1 => drop(members.remove(&keys[at])),
        2 => {
            let new =
                ["mesh", "skin", "children", "sparse", "bufferView", "byteOffset", "byteStride", "targets", "weights"];
            members.insert(new[draw.below(new.len() as u64) as usize].into(), donor);
        }
        _ => {
            let other = keys[draw.below(keys.len() as u64) as usize].clone();
            let moved = members[&keys[at]].clone();
            members.insert(other, moved);
        }
    }
}

fn any(count: usize, draw: &mut Stream) -> Option<usize> {
    (count > 0).then(|| draw.below(count as u64) as usize)
}
