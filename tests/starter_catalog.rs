//! The committed starter catalog is what its generator draws, and every model in it is sound.

#[path = "../examples/starter_catalog/generator/mod.rs"]
mod generator;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use glam::DVec3;

/// Models are exact to one millimetre in `catalog.csv`.
const MILLIMETRE: f64 = 0.001;

const MATERIALS: [&str; 13] = [
    "steel",
    "aluminium",
    "iron",
    "concrete",
    "rock",
    "wood",
    "rubber",
    "glass",
    "ceramic",
    "plastic",
    "rope",
    "flesh",
    "plant",
];

/// One part as a reader of the file sees it, turned upright: x right, y back, z up.
struct Part {
    material: String,
    positions: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
}

type Row = BTreeMap<String, String>;

fn rows() -> Vec<Row> {
    let files = generator::files().unwrap();
    let mut table = csv::Reader::from_reader(&files["catalog.csv"][..]);
    table.deserialize().map(Result::unwrap).collect()
}

/// Every line of the index with the parts of its model.
fn models() -> Vec<(Row, Vec<Part>)> {
    let files = generator::files().unwrap();
    rows().into_iter().map(|row| (row.clone(), parts(&files[&row["path"]]))).collect()
}

fn parts(glb: &[u8]) -> Vec<Part> {
    let file = gltf::Gltf::from_slice(glb).unwrap();
    let blob = file.blob.as_deref();
    let mut parts = Vec::new();
    for node in file.default_scene().unwrap().nodes() {
        let (shift, _, scale) = node.transform().decomposed();
        assert_eq!((shift, scale), ([0.0; 3], [1.0; 3]), "positions are final");
        for primitive in node.mesh().unwrap().primitives() {
            let reader = primitive.reader(|_| blob);
            let upright = |[x, y, z]: [f32; 3]| DVec3::new(x.into(), -f64::from(z), y.into());
            let indices: Vec<usize> = reader.read_indices().unwrap().into_u32().map(|v| v as usize).collect();
            parts.push(Part {
                material: primitive.material().name().unwrap().into(),
                positions: reader.read_positions().unwrap().map(upright).collect(),
                triangles: indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
            });
        }
    }
    parts
}

#[test]
fn the_committed_files_are_what_the_generator_draws() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
    let drawn = generator::files().unwrap();
    let committed: BTreeSet<String> =
        folder.read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(committed, drawn.keys().cloned().collect(), "files in {}", folder.display());
    for (name, bytes) in &drawn {
        let same = std::fs::read(folder.join(name)).unwrap() == *bytes;
        assert!(same, "{name} differs: run `cargo run --release --example starter_catalog -- catalogs/starter`");
        assert!(bytes.len() < 150_000, "{name} has {} bytes", bytes.len());
    }
    assert!(drawn.values().map(Vec::len).sum::<usize>() < 4_200_000);
}

#[test]
fn the_index_names_what_people_look_for() {
    let rows = rows();
    let header = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source";
    let files = generator::files().unwrap();
    assert_eq!(std::str::from_utf8(&files["catalog.csv"]).unwrap().lines().next(), Some(header));
    let labels: BTreeSet<&str> = rows.iter().map(|row| row["label"].as_str()).collect();
    for label in "tire oil-drum anchor cinder-block pipe crate bottle amphora moored-mine bottom-mine propeller ladder \
                  traffic-cone chain tree-trunk rock diver shipping-container oyster auv rov cylinder sphere cube cone car \
                  shark fish turtle shipwreck barrel sailboat coral sponge starfish crab suitcase chest submarine missile \
                  grenade depth-charge net rope cable"
        .split_whitespace()
    {
        assert!(labels.contains(label), "no {label}");
    }
    let uids: BTreeSet<&str> = rows.iter().map(|row| row["uid"].as_str()).collect();
    assert_eq!(uids.len(), rows.len());
    let tagged = |tag: &str| -> Vec<&str> {
        let found = rows.iter().filter(|row| row["tags"].split(';').any(|t| t == tag));
        found.map(|row| row["label"].as_str()).collect()
    };
    assert_eq!(BTreeSet::from_iter(tagged("mine-like")), BTreeSet::from(["bottom-mine", "moored-mine"]));
    assert_eq!(tagged("rock").len(), 4);
    for row in &rows {
        let tags: Vec<&str> = row["tags"].split(';').collect();
        assert_eq!(tags.iter().collect::<BTreeSet<_>>().len(), tags.len(), "{} has a tag twice", row["uid"]);
        let kebab = |word: &str| word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
        assert!(kebab(&row["uid"]) && kebab(&row["label"]), "{row:?}");
        assert_eq!((row["up"].as_str(), row["licence"].as_str()), ("y", "CC0-1.0"));
    }
}

#[test]
fn models_have_the_size_and_material_of_the_index_and_stand_on_the_ground() {
    for (row, parts) in models() {
        let uid = &row["uid"];
        let points = || parts.iter().flat_map(|part| &part.positions).copied();
        assert!(points().all(DVec3::is_finite), "{uid}");
        let (low, high) = (points().reduce(DVec3::min).unwrap(), points().reduce(DVec3::max).unwrap());
        let size: f64 = row["size_m"].parse().unwrap();
        assert!(((high - low).max_element() - size).abs() < MILLIMETRE, "{uid}: {} m", high - low);
        assert_eq!(low.z, 0.0, "{uid}");
        assert!((low + high).truncate().length() < MILLIMETRE, "{uid} is off the middle");
        assert_eq!(parts[0].material, row["material"], "{uid}");
        assert!(parts.iter().all(|part| MATERIALS.contains(&part.material.as_str())), "{uid}");
    }
}

#[test]
fn every_part_is_closed_and_faces_outwards() {
    for (row, parts) in models() {
        let uid = &row["uid"];
        for part in &parts {
            let mut edges = BTreeSet::new();
            for [a, b, c] in part.triangles.iter().copied() {
                for edge in [(a, b), (b, c), (c, a)] {
                    assert!(edges.insert(edge), "{uid}: two triangles run along {edge:?} the same way");
                }
            }
            assert!(edges.iter().all(|&(a, b)| edges.contains(&(b, a))), "{uid} has an open edge");
            for (solid, volume) in volumes(part) {
                assert!(volume > 0.0, "{uid}: the solid at vertex {solid} encloses {volume} m³");
            }
        }
    }
}

#[test]
fn triangles_are_enough_but_not_too_many_and_none_is_a_line() {
    for (row, parts) in models() {
        let uid = &row["uid"];
        let count: usize = parts.iter().map(|part| part.triangles.len()).sum();
        assert!((200..=6_500).contains(&count), "{uid} has {count} triangles");
        for part in &parts {
            for corners in part.triangles.iter().map(|t| t.map(|v| part.positions[v])) {
                let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length() / 2.0;
                assert!(area > 1e-9, "{uid}: a triangle of {area} m² at {}", corners[0]);
            }
        }
    }
}

/// Volume of each connected solid of a part, by its lowest vertex number.
fn volumes(part: &Part) -> BTreeMap<usize, f64> {
    let mut root: Vec<usize> = (0..part.positions.len()).collect();
    fn find(root: &mut [usize], mut v: usize) -> usize {
        while root[v] != v {
            root[v] = root[root[v]];
            v = root[v];
        }
        v
    }
    for [a, b, c] in part.triangles.iter().copied() {
        for other in [b, c] {
            let (p, q) = (find(&mut root, a), find(&mut root, other));
            root[p.max(q)] = p.min(q);
        }
    }
    let mut volumes = BTreeMap::new();
    for t in &part.triangles {
        // About the solid's own first vertex: far from the origin the sum would cancel.
        let solid = find(&mut root, t[0]);
        let [a, b, c] = t.map(|v| part.positions[v] - part.positions[solid]);
        *volumes.entry(solid).or_insert(0.0) += a.dot(b.cross(c)) / 6.0;
    }
    volumes
}
