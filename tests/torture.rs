//! Odd and broken glTF files, each with what it must give.

mod memory;
mod support;

use std::path::Path;
use std::time::{Duration, Instant};

use ensonify::catalog::{CatalogError, Model, ModelFault, Reading, read_model};

/// What the table of files expects.
const LOADS: &str = "load";
const NO_TRIANGLES: &str = "no triangles";
const NAMED_EXTENSION: &str = "clean error naming the extension";
const ERROR_OR_TOLERANT: &str = "clean error or tolerant load; never panic, hang or over-allocate";

/// Files with meshes that several nodes share: the table counts each mesh once, a scene each time.
const SHARED_MESHES: [(&str, u64); 3] = [
    ("assimp/draco/2CylinderEngine.gltf", 110_336),
    ("assimp/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 121_496),
    ("gltf-transform/ShapeCollection/ShapeCollection.glb", 3_542),
];

/// Longest that one file may take, and most bytes.
const LONGEST: Duration = Duration::from_secs(2);
const MOST_BYTES: usize = 1 << 30;

#[test]
fn every_file_gives_what_is_listed() {
    let Some(folder) = support::shared("gltf-torture") else { return };
    let mut table = csv::Reader::from_path(folder.join("torture.csv")).expect("the table");
    let (mut files, mut wrong) = (0, Vec::new());
    let (mut longest, mut most) = ((Duration::ZERO, String::new()), (0, String::new()));
    for row in table.records() {
        let row = row.expect("a row");
        let (file, expect, triangles) = (&row[0], &row[2], row[4].parse::<u64>().unwrap_or(0));
        let triangles = SHARED_MESHES.iter().find(|(name, _)| *name == file).map_or(triangles, |(_, shown)| *shown);
        let begun = Instant::now();
        let (result, bytes) = memory::most_allocated(|| read_model(&folder.join(file), Some(&folder)));
        let took = begun.elapsed();
        if let Err(problem) = judge(&folder.join(file), expect, triangles, &result) {
            wrong.push(format!("{file} ({}): {problem}", &row[1]));
        }
        assert!(took < LONGEST && bytes < MOST_BYTES, "{file}: {took:?}, {bytes} bytes");
        most = most.max((bytes, file.to_owned()));
        longest = longest.max((took, file.to_owned()));
        files += 1;
    }
    println!("longest: {longest:?}; most bytes: {most:?}");
    assert_eq!(files, 215);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn judge(file: &Path, expect: &str, triangles: u64, result: &Result<Reading, CatalogError>) -> Result<(), String> {
    let sound = |reading: &Reading| match reading.model.bounds() {
        Some((low, high)) if !(low.is_finite() && high.is_finite()) => Err(format!("from {low} to {high}")),
        _ => Ok(()),
    };
    let clean = |error: &CatalogError| {
        let text = error.to_string();
        let named = text.starts_with(&file.display().to_string());
        let crashed = matches!(error, CatalogError::Model { fault: ModelFault::Crash, .. });
        if named && !crashed { Ok(()) } else { Err(text) }
    };
    match (expect, result) {
        (LOADS, Ok(reading)) if reading.triangles == triangles => sound(reading),
        (LOADS, Ok(reading)) => Err(format!("{} triangles, not {triangles}", reading.triangles)),
        (NO_TRIANGLES, Err(CatalogError::Model { fault: ModelFault::NoTriangles, .. })) => Ok(()),
        (NAMED_EXTENSION, Err(error)) if error.to_string().contains("VENDOR_unknown") => clean(error),
        (ERROR_OR_TOLERANT, Ok(reading)) => sound(reading),
        (ERROR_OR_TOLERANT, Err(error)) => clean(error),
        (_, Ok(reading)) => Err(format!("loads {} triangles", reading.triangles)),
        (_, Err(error)) => Err(error.to_string()),
    }
}

#[test]
fn one_shape_is_the_same_in_every_encoding() {
    let (Some(torture), Some(models)) = (support::shared("gltf-torture"), support::shared("models")) else { return };
    let generated = torture.join("generated");
    let plain_engine = torture.join("assimp/2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
    for (plain, others) in [
        (generated.join("anchor_draco.glb"), &["anchor_meshopt.glb", "anchor_gltfpack_cc.glb"][..]),
        (models.join("q_shark.glb"), &["shark_sparse.glb", "shark_skinned_quantized.glb"]),
        (models.join("k_ship_wreck.glb"), &["../kenney-draco/ship-wreck.gltf"]),
        (plain_engine, &["../assimp/draco/2CylinderEngine.gltf"]),
    ] {
        let expected = shape(&plain);
        for other in others {
            let found = shape(&generated.join(other));
            let alike = expected.iter().zip(found).all(|(a, b)| (a - b).abs() < 0.01 * a);
            assert!(alike, "{other}: {found:?}, plain {expected:?}");
        }
    }
}

/// Sides of the bounding box relative to the longest, and surface area relative to its square.
fn shape(file: &Path) -> [f64; 4] {
    let model = read_model(file, None).expect("a sound file").model;
    let (low, high) = model.bounds().expect("triangles");
    let sides = (high - low).as_dvec3();
    let longest = sides.max_element();
    [sides.x / longest, sides.y / longest, sides.z / longest, area(&model) / (longest * longest)]
}

fn area(model: &Model) -> f64 {
    let corners = model.parts.iter().flat_map(|part| {
        part.triangles.iter().map(|triangle| triangle.map(|vertex| part.positions[vertex as usize].as_dvec3()))
    });
    corners.map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
}

/// Volume that the triangles enclose: negative where they face inwards.
fn volume(model: &Model) -> f64 {
    let corners = model.parts.iter().flat_map(|part| {
        part.triangles.iter().map(|triangle| triangle.map(|vertex| part.positions[vertex as usize].as_dvec3()))
    });
    corners.map(|[a, b, c]| a.dot(b.cross(c))).sum::<f64>() / 6.0
}

#[test]
fn features_keep_size_and_outside() {
    let Some(folder) = support::shared("gltf-torture/generated") else { return };
    let load = |file: &str| read_model(&folder.join(file), None).expect(file).model;
    let extent = |file: &str| {
        let (low, high) = load(file).bounds().expect(file);
        (high - low).to_array()
    };
    assert!(volume(&load("cube_negative_scale.glb")) > 0.0, "the winding flips with the mirror");
    assert_eq!(extent("cube_default_scene_1.glb"), [9.0; 3], "the second scene is the default");
    assert_eq!(extent("cube_u16_indices.glb"), extent("cube_sparse_no_base.glb"));
    assert_eq!(extent("cube_u16_indices.glb"), extent("cube_interleaved.glb"));
    assert_eq!(extent("cube_u16_indices.glb"), extent("wrong_minmax.glb"), "extents come from the data");
    assert_eq!(load("degenerate_triangles.glb").parts[0].triangles.len(), 12);
    let strip = load("tri_strip.glb");
    let normals = strip.parts[0].triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| strip.parts[0].positions[vertex as usize]);
        (b - a).cross(c - a).normalize()
    });
    let normals: Vec<_> = normals.collect();
    assert!(normals.windows(2).all(|pair| pair[0].dot(pair[1]) > 0.99), "{normals:?}");
}
