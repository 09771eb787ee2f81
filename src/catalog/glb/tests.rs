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

/// What a file of those bytes gives.
pub(crate) fn load(bytes: &[u8]) -> Result<Model, CatalogError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.glb");
    fs::write(&path, bytes).expect("write");
    load_model(&path)
}

/// The enclosed volume: positive when triangles face outwards.
pub(crate) fn volume(model: &Model) -> f64 {
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

fn sparse(count: u64) -> Value {
    json!({"count": count, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})
}

fn draco() -> Value {
    json!({"KHR_draco_mesh_compression": {"bufferView": 1, "attributes": {"POSITION": 0}}})
}

fn meshopt(mode: &str, stride: u64) -> Value {
    json!({"EXT_meshopt_compression":
        {"buffer": 0, "byteLength": 96, "byteStride": stride, "count": 8, "mode": mode}})
}

#[test]
fn broken_files_are_errors_that_say_where() {
    type Edit = fn(&mut Value);
    let cases: [(Edit, &str); 28] = [
        (|r| r["accessors"][0]["count"] = json!(9), "accessors[0]: it ends beyond bufferViews[0]"),
        (|r| r["accessors"][1]["count"] = json!(u64::MAX), "elements in accessors[1], more than the"),
        (|r| r["accessors"][1]["byteOffset"] = json!(u64::MAX), "accessors[1]"),
        (|r| r["bufferViews"][1]["byteOffset"] = json!(u64::MAX), "bufferViews[1]: it ends beyond buffers[0]"),
        (|r| r["buffers"][0]["byteLength"] = json!(1_000_000), "buffers[0]"),
        (|r| r["accessors"][0]["count"] = json!(7), "index 7 of 7"),
        (|r| r["accessors"][0]["type"] = json!("VEC2"), "accessors[0]"),
        (|r| r["nodes"] = json!([{"mesh": 7}]), "mesh 7"),
        (|r| r["nodes"] = json!([{"mesh": 0, "children": [0]}]), "nodes[0]: it is its own ancestor"),
        (|r| r["nodes"] = json!([{"mesh": 0, "children": [4]}]), "child 4"),
        (|r| r["scene"] = json!(3), "scenes[3]"),
        (|r| r["meshes"][0]["primitives"][0]["mode"] = json!(0), "no triangles"),
        (|r| r["extensionsRequired"] = json!(["KHR_materials_ior", "A_a", "B_b"]), "extension A_a, B_b,"),
        (|r| r["asset"]["version"] = json!("1.0"), "version"),
        (|r| r["asset"]["minVersion"] = json!("2.1"), "needs version \"2.1\""),
        (|r| r["nodes"] = json!([{"mesh": -1}]), "nodes[0].mesh: invalid value"),
        (|r| r["nodes"] = json!([{"mesh": 0, "translation": [0, 3e38, 0]}, {"mesh": 0}]), "not finite"),
        (|r| r["nodes"] = json!([{"mesh": 0, "matrix": [1, 0]}]), "nodes[0].matrix: invalid length"),
        (|r| r["bufferViews"][0]["byteStride"] = json!(8), "longer than the stride"),
        (|r| r["accessors"][0]["componentType"] = json!(5130), "component type 5130"),
        (|r| r["accessors"][0]["sparse"] = sparse(9), "9 sparse values for 8"),
        (|r| r["accessors"][0]["sparse"] = sparse(8), "sparse index 3204448256 of 8"),
        (|r| r["meshes"][0]["primitives"][0]["mode"] = json!(7), "mode 7"),
        (|r| r["meshes"][0]["primitives"][0]["material"] = json!(7), "material 7"),
        (|r| r["meshes"][0]["primitives"][0]["extensions"] = draco(), "bufferViews[1]: its Draco data"),
        (|r| r["bufferViews"][0]["extensions"] = meshopt("ATTRIBUTES", 12), "bufferViews[0]: Invalid glTF"),
        (|r| r["bufferViews"][0]["extensions"] = meshopt("ATTRIBUTES", 13), "8 elements of 13 bytes"),
        (|r| r["bufferViews"][0]["extensions"] = meshopt("ODD", 12), "mode ODD"),
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
fn instances_stand_where_they_are_put() {
    // Two places, (0, 0, 2) and (0, 0, 4), and two scales, the second mirroring; on a node at (10, 0, 0).
    let extensions = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2, "SCALE": 3, "_ID": 9}}});
    let nodes = json!([{"mesh": 0, "translation": [10.0, 0.0, 0.0], "extensions": extensions}]);
    let mut mesh = cube();
    mesh.0.extend([[0.0, 0.0, 2.0], [0.0, 0.0, 4.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 2.0]]);
    let bytes = glb(&mesh, nodes, |root| {
        root["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
        let of = |count: u32, offset: u32| {
            json!({"bufferView": 0, "byteOffset": offset, "componentType": 5126,
            "count": count, "type": "VEC3"})
        };
        let accessors = root["accessors"].as_array_mut().expect("accessors");
        accessors[0] = of(8, 0);
        accessors.extend([of(2, 96), of(2, 120)]);
    });
    let model = load(&bytes).expect("a sound file");
    assert_eq!((model.parts.len(), model.parts[0].triangles.len(), model.parts[0].positions.len()), (1, 24, 16));
    assert!((volume(&model) - 3.0).abs() < 1e-5, "outside stays out: {}", volume(&model));
    let (low, high) = model.bounds().expect("triangles");
    assert_eq!((low, high), (Vec3::new(9.5, -5.0, -0.5), Vec3::new(10.5, -1.5, 0.5)));
}

#[test]
fn a_few_bytes_cannot_ask_for_much() {
    let huge = |root: &mut Value| {
        root["accessors"][0] = json!({"componentType": 5126, "count": 10_000_000, "type": "VEC3"});
        root["accessors"][1] = json!({"componentType": 5125, "count": 30_000_000, "type": "SCALAR"});
    };
    let nodes: Vec<Value> = (0..1000).map(|_| json!({"mesh": 0})).collect();
    let mut instanced = json!([{"mesh": 0}]);
    instanced[0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}});
    for (nodes, expected) in
        [(json!(nodes), "triangles (up to meshes[0].primitives[0])"), (instanced, "instances on nodes[0]")]
    {
        let error = load(&glb(&cube(), nodes, huge)).expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
    }
    // Morph targets are read again for each node: what they cost together is limited too.
    let many = |root: &mut Value| {
        huge(root);
        root["accessors"][1] = json!({"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"});
        root["accessors"][0]["sparse"] = sparse(0);
        root["meshes"][0]["primitives"][0]["targets"] = json!(vec![json!({"POSITION": 0}); 100]);
        root["meshes"][0]["weights"] = json!(vec![1; 100]);
    };
    let error = load(&glb(&cube(), json!([{"mesh": 0}]), many)).expect_err("much").to_string();
    assert!(error.contains("numbers in all places"), "{error}");
}

#[test]
fn hidden_nodes_and_meshes_without_nodes() {
    let hidden = json!({"KHR_node_visibility": {"visible": false}});
    let nodes = json!([{"mesh": 0}, {"children": [2], "extensions": hidden}, {"mesh": 0}]);
    assert_eq!(load(&glb(&cube(), nodes, |_| ())).expect("a sound file").parts.len(), 1);
    let bare = glb(&cube(), json!([]), |root| {
        for key in ["scene", "scenes", "nodes"] {
            root.as_object_mut().expect("an object").remove(key);
        }
    });
    assert_eq!(load(&bare).expect("a sound file").parts[0].triangles.len(), 12);
}

#[test]
fn a_model_far_away_keeps_its_shape() {
    let bytes = glb(&cube(), json!([{"mesh": 0, "translation": [500_000.0, 0.0, 4_000_000.0]}]), |_| ());
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.glb");
    fs::write(&path, bytes).expect("write");
    let model = load_model_in(folder.path(), &path).expect("a sound file");
    let (low, high) = model.bounds().expect("triangles");
    assert_eq!(high - low, Vec3::ONE);
    assert_eq!(low.as_dvec3() + model.origin, glam::DVec3::new(499_999.5, -4_000_000.5, -0.5));
    assert_eq!(load_model(&path).expect("a sound file").origin, glam::DVec3::ZERO);
}

#[test]
fn names_are_kept_short_and_plain() {
    let nodes = json!([{"mesh": 0, "name": format!("a\u{0}\n{}", "b".repeat(1000))}]);
    let name = load(&glb(&cube(), nodes, |_| ())).expect("a sound file").parts[0].node.clone();
    assert!(name.starts_with("abb") && name.len() == 200, "{name}");
}

#[test]
fn flat_models_are_read_but_not_used() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.glb");
    fs::write(&path, glb(&cube(), json!([{"mesh": 0, "scale": [0.0, 0.0, 0.0]}]), |_| ())).expect("write");
    assert_eq!(read_model(&path, None).expect("a sound file").triangles, 12);
    let error = load_model(&path).expect_err("no area").to_string();
    assert!(error.contains("12 triangles, none of which has an area"), "{error}");
}
