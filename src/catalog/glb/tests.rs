//! GLBs built in memory, and the shared broken ones.

use std::fs;
use std::path::{Path, PathBuf};

use glam::Vec3;
use serde_json::{Value, json};

use super::*;
use crate::catalog::model::Part;

/// A cube of side 1 about the origin: 8 positions, 12 outward triangles.
pub(crate) fn cube() -> (Vec<[f32; 3]>, Vec<u32>) {
    let positions = (0..8).map(|k| [k & 1, (k >> 1) & 1, k >> 2].map(|bit| bit as f32 - 0.5)).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let indices = faces.iter().flat_map(|f| [f[0], f[1], f[2], f[0], f[2], f[3]]).collect();
    (positions, indices)
}

/// A tire lying flat (axis z up in our frame, y up in the file): a torus of the given outer diameter and tube radius.
pub(crate) fn tire(diameter: f32, tube: f32) -> (Vec<[f32; 3]>, Vec<u32>) {
    let (around, across) = (24u32, 12u32);
    let ring = diameter / 2.0 - tube;
    let turn = |k: u32, n: u32| std::f32::consts::TAU * k as f32 / n as f32;
    let mut positions = Vec::new();
    for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let (u, w) = (turn(i, around), turn(j, across));
        let radius = ring + tube * libm::cosf(w);
        positions.push([radius * libm::cosf(u), tube * libm::sinf(w), radius * libm::sinf(u)]);
    }
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    let quads = (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
    let indices = quads
        .flat_map(|(i, j)| [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i + 1, j)])
        .collect();
    (positions, indices)
}

/// A GLB of one mesh (accessors 0 positions, 1 indices) hung on the given nodes; `edit` may change the JSON.
pub(crate) fn glb(
    (positions, indices): &(Vec<[f32; 3]>, Vec<u32>),
    nodes: Value,
    edit: impl Fn(&mut Value),
) -> Vec<u8> {
    let mut bin: Vec<u8> = positions.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
    let split = bin.len();
    bin.extend(indices.iter().flat_map(|v| v.to_le_bytes()));
    let roots: Vec<usize> = {
        let children: Vec<u64> = nodes
            .as_array()
            .into_iter()
            .flatten()
            .flat_map(|n| n["children"].as_array().cloned().unwrap_or_default())
            .filter_map(|c| c.as_u64())
            .collect();
        (0..nodes.as_array().map_or(0, Vec::len)).filter(|k| !children.contains(&(*k as u64))).collect()
    };
    let mut root = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": roots}], "nodes": nodes,
        "materials": [{"name": "rubber"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": positions.len(), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": indices.len(), "type": "SCALAR"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": split},
            {"buffer": 0, "byteOffset": split, "byteLength": bin.len() - split}],
        "buffers": [{"byteLength": bin.len()}]
    });
    edit(&mut root);
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut out = b"glTF".to_vec();
    out.extend(2u32.to_le_bytes());
    out.extend((28 + text.len() as u32 + bin.len() as u32).to_le_bytes());
    out.extend((text.len() as u32).to_le_bytes());
    out.extend(b"JSON");
    out.extend(text);
    out.extend((bin.len() as u32).to_le_bytes());
    out.extend(b"BIN\0");
    out.extend(bin);
    out
}

/// The shared test material, if this checkout has it.
pub(crate) fn shared(folder: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(folder);
    if !path.is_dir() {
        println!("skipped: no {} here", path.display());
        return None;
    }
    Some(path)
}

fn load(bytes: &[u8]) -> Result<Model, CatalogError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.glb");
    fs::write(&path, bytes).expect("write");
    load_model(&path)
}

/// Six times the enclosed volume: positive when triangles face outwards.
fn volume(model: &Model) -> f64 {
    let corner = |part: &Part, v: u32| part.positions[v as usize].as_dvec3();
    let triangles = model.parts.iter().flat_map(|part| part.triangles.iter().map(move |t| t.map(|v| corner(part, v))));
    triangles.map(|[a, b, c]| a.dot(b.cross(c))).sum::<f64>() / 6.0
}

#[test]
fn nested_transforms_and_the_up_axis() {
    let nodes = json!([
        {"translation": [0.0, 5.0, 0.0], "children": [1], "name": "tire_01", "extras": {"categoryID": "tire"}},
        // A quarter turn about y (z → x), then twice as long along x.
        {"rotation": [0.0, 0.5f32.sqrt(), 0.0, 0.5f32.sqrt()], "scale": [1.0, 1.0, 4.0], "children": [2]},
        {"mesh": 0, "translation": [0.0, 0.0, 1.0], "name": "mesh"}
    ]);
    let model = load(&glb(&cube(), nodes, |_| ())).expect("a sound file");
    let (low, high) = model.bounds().expect("triangles");
    // File: x 2…6, y 4.5…5.5, z −0.5…0.5; ours: x the same, y = −z, z = y.
    assert!((low - Vec3::new(2.0, -0.5, 4.5)).length() < 1e-5 && (high - Vec3::new(6.0, 0.5, 5.5)).length() < 1e-5);
    assert!((volume(&model) - 4.0).abs() < 1e-5);
    assert_eq!((model.parts[0].node.as_str(), model.parts[0].category.as_str()), ("tire_01", "tire"));
    assert_eq!((model.parts[0].node_number, model.parts[0].material.as_str()), (0, "rubber"));
}

#[test]
fn mirrored_nodes_keep_their_outside_out() {
    for scale in [[-1.0, 1.0, 1.0], [1.0, -2.0, 1.0], [-1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]] {
        let model = load(&glb(&cube(), json!([{"mesh": 0, "scale": scale}]), |_| ())).expect("a sound file");
        let expected: f64 = scale.iter().product::<f64>().abs();
        assert!((volume(&model) - expected).abs() < 1e-5, "{scale:?}: {}", volume(&model));
    }
}

#[test]
fn strips_and_fans_keep_their_winding() {
    let square = (vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]], vec![0, 1, 2, 3]);
    let fan = (square.0.clone(), vec![0, 1, 3, 2]);
    for (mesh, mode) in [(square, 5), (fan, 6)] {
        let edit = |root: &mut Value| root["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        let model = load(&glb(&mesh, json!([{"mesh": 0}]), edit)).expect("a sound file");
        let part = &model.parts[0];
        assert_eq!(part.triangles.len(), 2);
        for [a, b, c] in part.triangles.iter().map(|t| t.map(|v| part.positions[v as usize])) {
            // +z of the file is −y of ours.
            assert!((b - a).cross(c - a).y < 0.0, "mode {mode}");
        }
    }
}

#[test]
fn a_skin_stands_where_its_joints_stand() {
    let nodes = json!([
        {"mesh": 0, "skin": 0, "translation": [100.0, 0.0, 0.0]},
        {"translation": [0.0, 3.0, 0.0]}
    ]);
    let bytes = glb(&cube(), nodes, |root| {
        root["skins"] = json!([{"joints": [1]}]);
        let primitive = &mut root["meshes"][0]["primitives"][0];
        primitive["attributes"]["JOINTS_0"] = json!(2);
        primitive["attributes"]["WEIGHTS_0"] = json!(3);
        let zeros = json!({"count": 8, "type": "VEC4", "componentType": 5121, "sparse": {"count": 0,
            "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}}});
        let mut weights = zeros.clone();
        weights["componentType"] = json!(5126);
        root["accessors"].as_array_mut().expect("accessors").extend([zeros, weights]);
    });
    let (low, high) = load(&bytes).expect("a sound file").bounds().expect("triangles");
    assert!((low + high - Vec3::new(0.0, 0.0, 6.0)).length() < 1e-5, "{low} {high}");
}

#[test]
fn broken_files_are_errors_that_say_where() {
    type Edit = fn(&mut Value);
    let cases: [(Edit, &str); 14] = [
        (|r| r["accessors"][0]["count"] = json!(9), "accessors[0]: it ends beyond bufferViews[0]"),
        (|r| r["accessors"][1]["count"] = json!(u64::MAX), "more than the"),
        (|r| r["accessors"][1]["byteOffset"] = json!(u64::MAX), "accessors[1]"),
        (|r| r["bufferViews"][1]["byteOffset"] = json!(u64::MAX), "bufferViews[1] ends beyond"),
        (|r| r["buffers"][0]["byteLength"] = json!(1_000_000), "buffers[0]"),
        (|r| r["accessors"][0]["count"] = json!(7), "index 7 of 7"),
        (|r| r["accessors"][0]["type"] = json!("VEC2"), "accessors[0]"),
        (|r| r["nodes"] = json!([{"mesh": 7}]), "mesh 7"),
        (|r| r["nodes"] = json!([{"mesh": 0, "children": [0]}]), "ancestors"),
        (|r| r["nodes"] = json!([{"mesh": 0, "children": [4]}]), "child 4"),
        (|r| r["scene"] = json!(3), "scenes[3]"),
        (|r| r["meshes"][0]["primitives"][0]["mode"] = json!(0), "no triangles"),
        (|r| r["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]), "KHR_draco_mesh_compression"),
        (|r| r["asset"]["version"] = json!("1.0"), "version"),
    ];
    for (edit, expected) in cases {
        let error = load(&glb(&cube(), json!([{"mesh": 0}]), edit)).expect_err(expected).to_string();
        assert!(error.contains(expected) && error.contains("model.glb"), "{error}");
    }
    let whole = glb(&cube(), json!([{"mesh": 0}]), |_| ());
    (0..whole.len()).step_by(7).for_each(|length| assert!(load(&whole[..length]).is_err(), "cut at {length}"));
    let mut nan = cube();
    nan.0[3][1] = f32::NAN;
    let error = load(&glb(&nan, json!([{"mesh": 0}]), |_| ())).expect_err("not a number").to_string();
    assert!(error.contains("vertex 3 is not finite"), "{error}");
}

#[test]
fn flipped_bytes_never_panic() {
    let whole = glb(&tire(0.6, 0.1), json!([{"mesh": 0, "children": [1]}, {"mesh": 0}]), |_| ());
    let mut stream = crate::math::rng::Stream::at(1, "test", 0, "flips");
    for _ in 0..400 {
        let mut bytes = whole.clone();
        for _ in 0..3 {
            // Mostly the JSON: the geometry behind it can only move vertices.
            let at = stream.below(1100) as usize;
            bytes[at] = stream.bits() as u8;
        }
        let _ = load(&bytes);
    }
}

#[test]
fn the_shared_odd_and_broken_files() {
    let Some(folder) = shared("gltf-torture") else { return };
    let mut table = csv::Reader::from_path(folder.join("torture.csv")).expect("the table");
    let mut wrong = Vec::new();
    for row in table.records() {
        let row = row.expect("a row");
        let (file, expect, meshes_triangles) = (&row[0], &row[2], row[4].parse::<usize>().unwrap_or(0));
        let result = load_model(&folder.join(file));
        let compressed =
            ["draco", "Draco", "meshopt", "gltfpack"].iter().any(|word| row[0].contains(word) || row[1].contains(word));
        // The validator's samples have accessors without data: all vertices in one place, or none.
        let flat = ["khronos-validator", "cube_zero_scale", "cube_far_away"].iter().any(|word| file.contains(word));
        let fine = match (expect, &result) {
            ("load", Ok(model)) => {
                let loaded: usize = model.parts.iter().map(|part| part.triangles.len()).sum();
                // Meshes that several nodes share come once for each; triangles without area do not come.
                loaded * 2 >= meshes_triangles && model.bounds().is_some_and(|(a, b)| a.is_finite() && b.is_finite())
            }
            ("load", Err(CatalogError::Model { fault: ModelFault::Extension(_), .. })) => compressed,
            ("load", Err(CatalogError::Model { fault: ModelFault::NoTriangles | ModelFault::Broken { .. }, .. })) => {
                flat
            }
            ("load", Err(_)) => false,
            ("no triangles", result) => result.is_err(),
            _ => true,
        };
        if !fine {
            wrong.push(format!("{file} ({}): {:?}", &row[1], result.map(|m| m.parts.len()).map_err(|e| e.to_string())));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_skinned_model_has_one_shape_in_every_encoding() {
    let (Some(models), Some(torture)) = (shared("models"), shared("gltf-torture")) else { return };
    let shape = |path: PathBuf| {
        let (low, high) = load_model(&path).expect("a sound file").bounds().expect("triangles");
        (high - low) / (high - low).max_element()
    };
    let plain = shape(models.join("q_shark.glb"));
    println!("shark: {plain}");
    for name in ["shark_sparse.glb", "shark_skinned_quantized.glb"] {
        let other = shape(torture.join("generated").join(name));
        assert!((plain - other).length() < 2e-3, "{name}: {plain} {other}");
    }
}
