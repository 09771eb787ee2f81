//! What is wrong gets one message with place and remedy, exit code 2, and nothing is written.

mod support;

use std::fs;

use support::cli::{Desk, messages, small_recipe};

/// Runs a recipe made from the small one by one change; checks the code, the message and that nothing is written.
fn refused(change: (&str, &str), place: &str, words: &[&str]) {
    let desk = Desk::new();
    let text = small_recipe(1).replacen(change.0, change.1, 1);
    assert_ne!(text, small_recipe(1), "the change `{}` is made", change.0);
    desk.file("a.yaml", &text);
    for verb in ["run", "check", "plan", "preview"] {
        let output = desk.run(&[verb, "a.yaml"]);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{verb}: {message}");
        assert!(message.starts_with(&format!("error: a.yaml:{place}")), "{verb}: {message}");
        for word in words {
            assert!(message.contains(word), "{verb}: `{word}` is not in: {message}");
        }
        assert_eq!(message.matches("error:").count(), 1, "one message: {message}");
        assert_eq!(desk.names(), ["a.yaml"], "{verb} wrote nothing");
    }
}

#[test]
fn a_misspelt_key() {
    refused(("wavelength_m", "wavelenth_m"), "8:", &["wavelenth_m", "did you mean `wavelength_m`"]);
    refused(("water:", "watre:"), "7:1", &["watre", "did you mean `water`"]);
    refused(("elevations: 150", "elevation: 150"), "6:", &["elevation", "elevations"]);
}

#[test]
fn a_wrong_type() {
    refused(("beams: 96", "beams: many"), "6:", &["beams"]);
    refused(("frames: 3", "frames: 2.5"), "5:", &["frames"]);
    refused(("range_m: [0.5, 9]", "range_m: 9"), "6:", &["range_m"]);
}

#[test]
fn an_unknown_distribution() {
    refused(("{uniform: [4, 22]}", "{unifrom: [4, 22]}"), "7:", &["unifrom", "uniform"]);
}

#[test]
fn a_range_upside_down() {
    refused(("uniform: [4, 22]", "uniform: [22, 4]"), "7:", &["22", "4"]);
    refused(("range_m: [0.5, 9]", "range_m: [9, 0.5]"), "6:", &["range_m", "near < far"]);
    refused(("{int: [1, 3]}", "{int: [3, 1]}"), "11:", &["3", "1"]);
}

#[test]
fn figures_that_cannot_be() {
    refused(("{uniform: [4, 22]}", "400"), "7:", &["400", "temperature_c"]);
    refused(("azimuth_deg: 90", "azimuth_deg: 360"), "6:", &["azimuth_deg", "360"]);
    refused(("radius_m: {uniform: [4, 5]}", "radius_m: -4"), "13:", &["-4"]);
    refused(("{choice: [silt, gravel]}", "sitl"), "8:", &["sitl", "did you mean `silt`"]);
    refused(("cell_m: 0.2", "cell_m: 0.001"), "8:", &["triangles"]);
    refused(("within_m: 2", "within_m: 2, burial: 3"), "12:", &["burial"]);
    refused(("beams: 96,", "device: oculus-m1200d,"), "6:", &["oculus-m1200d", "did you mean"]);
}

#[test]
fn a_missing_catalog_or_model() {
    refused(("catalog: starter", "catalog: no-such"), "10:", &["no-such", "catalog.csv"]);
    refused(("tags: [debris]", "tags: [debirs]"), "10:", &["debirs", "did you mean `debris`"]);
    refused(("tags: [debris]", "uid: tyre"), "10:", &["tyre", "tire"]);
    refused(("seabed: {extent_m", "environment: {glb: no.glb}\nseabed: {extent_m"), "8:", &["no.glb"]);
}

#[test]
fn looks_that_cannot_be() {
    refused(("seed: 5", "seed: 5\nlooks: []"), "4:8", &["looks"]);
    refused(("seed: 5", "seed: 5\nlooks: [{name: a}, {name: a}]"), "4:", &["two looks `a`"]);
    refused(("seed: 5", "seed: 5\nlooks: [{name: a/b}]"), "4:", &["a/b"]);
    refused(("seed: 5", "seed: 5\nlooks: [{name: a, watr: {}}]"), "4:", &["watr", "water"]);
    refused(("seed: 5", "seed: 5\nlooks: [{name: a, water: {ph: 20}}]"), "4:", &["20"]);
}

#[test]
fn sweeps_and_splits_that_cannot_be() {
    refused(("seed: 5", "seed: 5\nsweep: {grid: {watr.ph: [7]}}"), "4:16", &["watr", "did you mean `water`"]);
    refused(("seed: 5", "seed: 5\nsweep: {grid: {water.ph: [7, 20]}}"), "4:30", &["20 is outside"]);
    refused(("seed: 5", "seed: 5\nsweep: {grid: {water.hp: [7]}}"), "4:16", &["unknown key `hp`"]);
    refused(("seed: 5", "seed: 5\nsweep: {grid: {scenes: [7]}}"), "4:16", &["`scenes` cannot be swept"]);
    refused(("seed: 5", "seed: 5\nsplits: {by: variant}"), "4:", &["no variants", "sweep"]);
}

#[test]
fn yaml_that_is_none() {
    refused(("seed: 5", "seed: 5\nseed: 6"), "4:1", &["seed"]);
    refused(("scenes: 1", "scenes: [1"), "", &[]);
    refused(("ensonify: 1\n", ""), "", &["ensonify: 1"]);
}

#[test]
fn a_missing_or_broken_model_file() {
    let header = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n";
    let row = "thing,a thing,thing,thing,thing.glb,1,y,steel,CC0-1.0,nobody,nowhere\n";
    for (bytes, word) in [(None, "cannot be read"), (Some(&b"no glTF at all"[..]), "glTF")] {
        let desk = Desk::new();
        desk.file("models/catalog.csv", &format!("{header}{row}"));
        if let Some(bytes) = bytes {
            fs::write(desk.path().join("models/thing.glb"), bytes).expect("written");
        }
        desk.file("a.yaml", &small_recipe(1).replace("catalog: starter, tags: [debris]", "catalog: models"));
        let output = desk.run(&["run", "a.yaml"]);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("a.yaml:10:") && message.contains("thing.glb") && message.contains(word), "{message}");
        assert_eq!(desk.names(), ["a.yaml", "models"]);
    }
}

/// A `.gltf` of one triangle; `buffer` is the URI of its data, `nodes` and `count` are as given.
fn triangle(buffer: &str, nodes: &str, count: u64) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": {nodes},
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": {count}, "type": "VEC3"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"byteLength": 36, "uri": "{buffer}"}}]}}"#
    )
}

#[test]
fn a_model_that_lies_or_leaves_its_catalog() {
    let row = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n\
        thing,a thing,thing,thing,thing.gltf,1,y,steel,CC0-1.0,nobody,nowhere\n";
    let (plain, cycle) = (r#"[{"mesh": 0}]"#, r#"[{"mesh": 0, "children": [1]}, {"children": [0]}]"#);
    for (model, words) in [
        (triangle("../../etc/passwd", plain, 3), ["buffers[0]", "leads out of the catalog's folder"]),
        (triangle("file:///etc/passwd", plain, 3), ["file:///etc/passwd", "an address outside"]),
        (triangle("http://127.0.0.1:9/x.bin", plain, 3), ["http://127.0.0.1:9/x.bin", "nothing is fetched"]),
        (triangle("link.bin", plain, 3), ["link.bin", "a link that leads out"]),
        (triangle("none.bin", plain, 3), ["none.bin", "put that file beside the model"]),
        (triangle("data:;base64,AAAA", plain, 3), ["buffers[0]", "3 bytes are there, 36 are announced"]),
        (triangle("data:,x", plain, 4_294_967_295), ["accessors[0]", "4294967295"]),
        (triangle("data:,x", cycle, 3), ["nodes[0]", "its own ancestor"]),
    ] {
        let desk = Desk::new();
        desk.file("models/catalog.csv", row);
        desk.file("models/thing.gltf", &model);
        desk.file("secret.bin", "beside the catalog, longer than thirty-six bytes");
        #[cfg(unix)]
        std::os::unix::fs::symlink("../secret.bin", desk.path().join("models/link.bin")).expect("linked");
        #[cfg(not(unix))]
        if words[0] == "link.bin" {
            continue;
        }
        desk.file("a.yaml", &small_recipe(1).replace("catalog: starter, tags: [debris]", "catalog: models"));
        let output = desk.run(&["run", "a.yaml"]);
        let message = messages(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        for word in ["a.yaml:10:", "thing.gltf"].into_iter().chain(words) {
            assert!(message.contains(word), "`{word}` is not in: {message}");
        }
        assert_eq!(desk.names(), ["a.yaml", "models", "secret.bin"], "nothing is written");
    }
}

#[test]
fn a_recipe_that_is_not_there_and_a_folder_that_cannot_be_written() {
    let desk = Desk::new();
    let output = desk.run(&["run", "none.yaml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(messages(&output).contains("none.yaml"), "{}", messages(&output));

    desk.file("a.yaml", &small_recipe(1));
    desk.file("taken", "a file");
    for folder in ["taken", "taken/below", "/proc/ensonify"] {
        let output = desk.run(&["run", "a.yaml", "-o", folder]);
        assert_eq!(output.status.code(), Some(2), "{folder}: {}", messages(&output));
        assert!(messages(&output).contains("-o"), "{folder}: {}", messages(&output));
    }
    assert_eq!(desk.names(), ["a.yaml", "taken"]);

    desk.file("other/file.txt", "not a dataset");
    let output = desk.run(&["run", "a.yaml", "-o", "other"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_dir(desk.path().join("other")).expect("readable").count(), 1);
}

#[test]
fn wrong_arguments() {
    let desk = Desk::new();
    for arguments in [&["runn"][..], &["run"], &["run", "a.yaml", "--jobs", "0"], &["run", "a.yaml", "--set", "frames"]]
    {
        desk.file("a.yaml", &small_recipe(1));
        let output = desk.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", messages(&output));
    }
}
