//! Catalogs as users meet them: indexing, searching, checking, licences, and a cache of Objaverse where it lies.

mod support;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use ensonify::catalog::Catalog;
use ensonify::catalog::build::{Indexed, Report, index};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Value, json};

use support::cli::{Desk, messages};
use support::shared;

fn starter() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter")
}

fn folder_report(indexed: Indexed) -> Report {
    match indexed {
        Indexed::Folder(report) => report,
        Indexed::Collection(_) => panic!("a folder"),
    }
}

fn results(output: &Output) -> String {
    assert!(output.status.success(), "{}", messages(output));
    String::from_utf8(output.stdout.clone()).expect("text")
}

/// A desk with a few models of the starter catalog in `models`.
fn desk_of(models: &[&str]) -> Desk {
    let desk = Desk::new();
    fs::create_dir(desk.path().join("models")).expect("a folder");
    for model in models {
        copy(model, &desk, &format!("models/{model}.glb"));
    }
    desk
}

fn copy(model: &str, desk: &Desk, to: &str) {
    fs::copy(starter().join(format!("{model}.glb")), desk.path().join(to)).expect("copied");
}

#[test]
fn a_folder_is_indexed_once_and_then_only_where_it_changed() {
    let desk = desk_of(&["anchor", "tire", "bottle"]);
    let models = desk.path().join("models");
    let first = folder_report(index(&models, None).expect("indexed"));
    assert_eq!((first.models, first.read, first.new.len()), (3, 3, 3));
    let again = folder_report(index(&models, None).expect("indexed"));
    assert_eq!((again.models, again.read, again.changed.len()), (3, 0, 0));

    copy("oil-drum", &desk, "models/bottle.glb");
    copy("chain", &desk, "models/chain.glb");
    fs::remove_file(models.join("tire.glb")).expect("removed");
    fs::rename(models.join("anchor.glb"), models.join("Anker-alt.glb")).expect("renamed");
    let changed = folder_report(index(&models, None).expect("indexed"));
    assert_eq!((changed.models, changed.read), (3, 3));
    assert_eq!((changed.new, changed.changed), (vec!["chain.glb".to_owned()], vec!["bottle.glb".to_owned()]));
    assert_eq!(changed.missing, ["tire"]);
    assert_eq!(changed.moved, [("anchor.glb".to_owned(), "Anker-alt.glb".to_owned())]);
    let catalog = Catalog::open(&models).expect("sound");
    catalog.check().expect("all there");
    assert!(catalog.get("anchor").expect("readable").expect("its uid stays").path.ends_with("Anker-alt.glb"));
}

#[test]
fn what_a_person_writes_stays() {
    let desk = desk_of(&["anchor", "tire"]);
    let models = desk.path().join("models");
    index(&models, None).expect("indexed");
    let table = fs::read_to_string(models.join("catalog.csv")).expect("readable");
    let (name, size) = ("anchor,anchor,anchor", ",anchor.glb,1.8405,y,iron,unknown,");
    assert!(table.contains(name) && table.contains(size), "{table}");
    let edited =
        table.replace(name, "anchor,Grandfather's anchor,anchor").replace(size, ",anchor.glb,2.5,y,iron,CC0-1.0,");
    fs::write(models.join("catalog.csv"), edited).expect("written");
    desk.file("models/catalog.overrides.yaml", "tire: {size_m: 1.1, material: steel, label: wheel}\n");
    fs::remove_file(models.join(".catalog.state.json")).expect("removed");
    for _ in 0..2 {
        index(&models, None).expect("indexed");
        let catalog = Catalog::open(&models).expect("sound");
        let anchor = catalog.get("anchor").expect("readable").expect("there");
        assert_eq!(
            (anchor.name.as_str(), anchor.size_m, anchor.licence.as_str()),
            ("Grandfather's anchor", Some(2.5), "CC0-1.0")
        );
        assert_eq!(anchor.size_from.name(), "given");
        let tire = catalog.get("tire").expect("readable").expect("there");
        assert_eq!((tire.size_m, tire.label.as_str(), tire.material.as_str()), (Some(1.1), "wheel", "steel"));
    }
    assert!(desk.path().join("models/catalog.overrides.yaml").is_file());
}

#[test]
fn the_shared_models_are_known_by_label_size_and_material() {
    let Some(models) = shared("models") else { return };
    let desk = Desk::new();
    let into = desk.path().join("catalogs/models");
    let report = folder_report(index(&models, Some(&into)).expect("indexed"));
    assert_eq!((report.models, report.unusable.len(), report.notes.len()), (51, 0, 0), "{report:?}");
    let catalog = Catalog::open(&into).expect("sound");
    catalog.check().expect("all there");
    for (uid, label, low, high, material) in [
        ("k_car_tire", "tire", 0.5, 0.8, "rubber"),
        ("q_shark", "shark", 1.0, 6.0, "flesh"),
        ("s_biplane", "aircraft", 5.0, 15.0, "aluminium"),
        ("q_crate", "crate", 0.4, 1.5, "wood"),
        ("d_cinder_block", "cinder-block", 0.35, 0.6, "concrete"),
        ("s_shipping_container", "shipping-container", 6.0, 6.1, "steel"),
        ("q_puffer", "pufferfish", 0.15, 0.6, "flesh"),
        ("q_chest", "chest", 0.6, 1.3, "wood"),
        ("k_bottle", "bottle", 0.2, 0.4, "glass"),
        ("q_water_bottle", "water-bottle", 0.2, 0.35, "plastic"),
        ("l_starfish", "starfish", 0.1, 0.5, "flesh"),
        ("d_torpedo_mk48", "torpedo", 5.0, 6.5, "steel"),
        ("q_sail_ship", "ship", 15.0, 60.0, "wood"),
    ] {
        let asset = catalog.get(uid).expect("readable").expect(uid);
        let size = asset.size_m.expect("known");
        assert_eq!((asset.label.as_str(), asset.material.as_str()), (label, material), "{uid}");
        assert!((low..=high).contains(&size), "{uid}: {size} m");
        assert!(asset.licence != "unknown" && !asset.attribution.is_empty(), "{uid}");
    }
    // Whether surfaces are closed is known of each from elsewhere.
    let mut table = csv::Reader::from_path(models.join("models.csv")).expect("the table");
    let mut agree = 0;
    for row in table.records().map(Result::unwrap) {
        let asset = catalog.get(row[0].trim_end_matches(".glb")).expect("readable").expect("there");
        agree += usize::from(asset.watertight == Some(&row[8] == "True"));
    }
    assert!(agree >= 47, "{agree} of 51");
}

#[test]
fn people_find_what_they_mean() {
    let Some(models) = shared("models") else { return };
    let desk = Desk::new();
    let into = desk.path().join("models");
    index(&models, Some(&into)).expect("indexed");
    let catalogs =
        [("starter", Catalog::open(&starter()).expect("sound")), ("models", Catalog::open(&into).expect("sound"))];
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/search/queries.csv");
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(table).expect("the queries");
    let (mut first, mut five, mut all, mut wrong) = (0, 0, 0, Vec::new());
    for row in table.records().map(Result::unwrap) {
        let mut found: Vec<(f32, String)> = Vec::new();
        for (name, catalog) in &catalogs {
            for hit in catalog.find(&row[0], 5).expect("readable") {
                found.push((hit.score, format!("{name}/{}", catalog.asset(hit.model).expect("readable").uid)));
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let found: Vec<String> = found.into_iter().map(|(_, uid)| uid).take(5).collect();
        let best: BTreeSet<&str> = row[1].split('|').collect();
        let any: BTreeSet<&str> = best.iter().copied().chain(row[2].split('|')).collect();
        all += 1;
        let right = found.first().is_some_and(|uid| best.contains(uid.as_str()));
        first += usize::from(right);
        five += usize::from(found.iter().any(|uid| any.contains(uid.as_str())));
        if !right {
            wrong.push(format!("{}: {found:?}", &row[0]));
        }
    }
    println!("{first} right at once, {five} among five, of {all}; {wrong:#?}");
    assert!(all >= 60);
    assert!(first * 100 >= all * 90 && five * 100 >= all * 98, "{first} and {five} of {all}: {wrong:#?}");
}

/// A cache of Objaverse with these records, each with the model of the starter catalog that stands for it.
fn cache(desk: &Desk, records: &[(&str, Value, &str)], paths: Value) -> PathBuf {
    let home = desk.path().join("cache/hf-objaverse-v1");
    fs::create_dir_all(home.join("metadata")).expect("a folder");
    fs::create_dir_all(home.join("glbs/000-000")).expect("a folder");
    let mut metadata = serde_json::Map::new();
    for (uid, record, model) in records {
        metadata.insert((*uid).to_owned(), record.clone());
        if !model.is_empty() {
            copy(model, desk, &format!("cache/hf-objaverse-v1/glbs/000-000/{uid}.glb"));
        }
    }
    fs::write(home.join("object-paths.json.gz"), gzip(&paths)).expect("written");
    fs::write(home.join("metadata/000-000.json.gz"), gzip(&Value::Object(metadata))).expect("written");
    fs::write(home.join("lvis-annotations.json.gz"), gzip(&json!({"car_(automobile)": ["cccc"]}))).expect("written");
    desk.path().join("cache")
}

fn gzip(value: &Value) -> Vec<u8> {
    use std::io::Write as _;
    let mut out = GzEncoder::new(Vec::new(), Compression::fast());
    out.write_all(value.to_string().as_bytes()).expect("in memory");
    out.finish().expect("in memory")
}

fn record(name: &str, license: Value) -> Value {
    json!({"name": name, "viewerUrl": "https://example.org/x", "license": license, "tags": [{"name": "old"}],
        "user": {"displayName": "A. | Person\n"}, "description": "<b>x</b>", "faceCount": 10, "staffpickedAt": null})
}

#[test]
fn a_cache_of_objaverse_is_searched_and_rendered_in_place() {
    let desk = Desk::new();
    let records = [
        ("aaaa", record("Rusty Anchor", json!("by")), "anchor"),
        ("bbbb", record("Old Tyre", json!("by-nc")), "tire"),
        ("cccc", record("Blue thing", Value::Null), ""),
    ];
    let paths =
        json!({"aaaa": "glbs/000-000/aaaa.glb", "bbbb": "glbs/000-000/bbbb.glb", "dddd": "glbs/000-001/dddd.glb"});
    let source = cache(&desk, &records, paths);
    let before = all_files(&source);
    let refused = desk.run(&["catalog", "index", "cache"]);
    assert!(!refused.status.success() && messages(&refused).contains("--into"), "{}", messages(&refused));
    let told = results(&desk.run(&["catalog", "index", "cache", "--into", "catalogs/objaverse"]));
    assert!(told.contains("4 models, 2 of them on disk"), "{told}");
    assert_eq!(all_files(&source), before, "the cache is left as it is");
    let again = results(&desk.run(&["catalog", "index", "cache", "--into", "catalogs/objaverse"]));
    assert!(again.contains("nothing has changed"), "{again}");

    let found: Value =
        serde_json::from_str(&results(&desk.run(&["catalog", "search", "ancre", "-c", "objaverse", "--json"])))
            .expect("JSON");
    assert_eq!(
        (&found[0]["uid"], &found[0]["licence"], &found[0]["on_disk"]),
        (&json!("aaaa"), &json!("CC-BY-4.0"), &json!(true))
    );
    let shown: Value =
        serde_json::from_str(&results(&desk.run(&["catalog", "show", "objaverse/bbbb", "--json", "-o", "b.png"])))
            .expect("JSON");
    assert_eq!((&shown["label"], &shown["licence"]), (&json!("tire"), &json!("CC-BY-NC-4.0")));
    assert!((shown["size_m"].as_f64().expect("a number") - 0.63).abs() < 0.01, "{shown}");
    assert!(desk.path().join("b.png").is_file());

    let recipe = |pick: &str, more: &str| {
        let text = support::cli::small_recipe(1).replace("{catalog: starter, tags: [debris]}", pick) + more;
        desk.file("r.yaml", &text);
        desk.run(&["run", "r.yaml", "-o", "out"])
    };
    let output = recipe("{catalog: objaverse, search: rusty anchor}", "");
    results(&output);
    let credits = fs::read_to_string(desk.path().join("out/ATTRIBUTION.md")).expect("readable");
    assert!(credits.contains("\"Rusty Anchor\" by A. \\| Person (https://example.org/x), CC-BY-4.0"), "{credits}");
    let coco = fs::read(desk.path().join("out/annotations/polar_train.json")).expect("readable");
    let coco: Value = serde_json::from_slice(&coco).expect("JSON");
    assert_eq!(
        coco["licenses"],
        json!([{"id": 1, "name": "CC-BY-4.0", "url": "https://creativecommons.org/licenses/by/4.0/"}])
    );
    assert_eq!((&coco["assets"][0]["asset"], &coco["assets"][0]["license"]), (&json!("objaverse/aaaa"), &json!(1)));
    for annotation in coco["annotations"].as_array().expect("a list") {
        assert_eq!((&annotation["asset"], &annotation["license"]), (&json!("objaverse/aaaa"), &json!(1)));
    }

    for (pick, more, told) in [
        ("{catalog: objaverse, label: tire}", "licences: {allow: [CC0-1.0, CC-BY-4.0]}\n", "CC-BY-NC-4.0"),
        ("{catalog: objaverse, uid: cccc}", "", "none is downloaded"),
        ("{catalog: objaverse}", "", "add `label`"),
        ("{catalog: objaverse, search: whale}", "", "catalog search"),
        ("{catalog: objaverse, tags: [old]}", "licences: {allow: [MIT], others: leave-out}\n", "none of the 2 models"),
        ("{catalog: objaverse, uid: aaaa}", "licences: {alow: [MIT]}\n", "allow"),
    ] {
        let output = recipe(pick, more);
        assert_eq!(output.status.code(), Some(2), "{pick}");
        assert!(messages(&output).contains(told), "{pick}: {}", messages(&output));
    }
    fs::remove_dir_all(desk.path().join("out")).expect("removed");
    results(&recipe("{catalog: objaverse, tags: [old]}", "licences: {allow: [CC-BY-4.0], others: leave-out}\n"));
}

fn all_files(folder: &Path) -> BTreeSet<PathBuf> {
    let mut files = BTreeSet::new();
    for entry in folder.read_dir().expect("readable").map(Result::unwrap) {
        if entry.path().is_dir() {
            files.extend(all_files(&entry.path()));
        } else {
            files.insert(entry.path());
        }
    }
    files
}

#[test]
fn broken_downloads_are_told_of_and_hostile_paths_refused() {
    let desk = Desk::new();
    let records: Vec<(String, Value)> =
        (0..200).map(|i| (format!("{i:04}"), record(&format!("Tire number {i}"), json!("cc0")))).collect();
    let records: Vec<(&str, Value, &str)> = records.iter().map(|(uid, r)| (uid.as_str(), r.clone(), "")).collect();
    let source = cache(&desk, &records, json!({}));
    let shard = source.join("hf-objaverse-v1/metadata/000-000.json.gz");
    let whole = fs::read(&shard).expect("readable");
    fs::write(&shard, &whole[..whole.len() / 2]).expect("written");
    let output = desk.run(&["catalog", "index", "cache", "--into", "c"]);
    assert!(messages(&output).contains("000-000.json.gz: is cut off"), "{}", messages(&output));
    let count: Value =
        serde_json::from_str(&results(&desk.run(&["catalog", "index", "cache", "--into", "c", "--json"])))
            .expect("JSON");
    assert!((10..200).contains(&count["models"].as_u64().expect("a number")), "{count}");

    for path in ["../../etc/passwd", "file:///etc/passwd", "http://example.org/a.glb", "/etc/passwd"] {
        cache(&desk, &[("aaaa", record("a", json!("by")), "anchor")], json!({"aaaa": path}));
        let output = desk.run(&["catalog", "index", "cache", "--into", "hostile"]);
        assert_eq!(output.status.code(), Some(2), "{path}");
        let told = messages(&output);
        assert!(told.contains("object-paths.json.gz") && told.contains("aaaa") && told.contains(path), "{told}");
        assert!(!told.contains("root:"), "{told}");
    }
}

#[cfg(unix)]
#[test]
fn rows_and_links_that_leave_a_catalog_are_refused() {
    let desk = desk_of(&["anchor"]);
    let header = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source\n";
    for path in ["../../etc/passwd", "file:///etc/passwd", "http://example.org/a.glb", "/etc/passwd"] {
        desk.file("bad/catalog.csv", &format!("{header}a,A,anchor,,{path},1,y,,CC0-1.0,x,y\n"));
        let output = desk.run(&["catalog", "list", "-c", "bad"]);
        assert_eq!(output.status.code(), Some(2), "{path}");
        assert!(
            messages(&output).contains("catalog.csv:2") && messages(&output).contains(path),
            "{}",
            messages(&output)
        );
    }
    let outside = desk.path().join("outside.glb");
    fs::rename(desk.path().join("models/anchor.glb"), &outside).expect("moved");
    std::os::unix::fs::symlink(&outside, desk.path().join("models/anchor.glb")).expect("linked");
    desk.file("models/catalog.csv", &format!("{header}a,A,anchor,,anchor.glb,1,y,,CC0-1.0,x,y\n"));
    let recipe =
        support::cli::small_recipe(1).replace("{catalog: starter, tags: [debris]}", "{catalog: models, uid: a}");
    desk.file("r.yaml", &recipe);
    for arguments in [&["check", "r.yaml"][..], &["catalog", "show", "a", "-c", "models"]] {
        let output = desk.run(arguments);
        assert_eq!(output.status.code(), Some(2));
        assert!(
            messages(&output).contains("is a link to") && messages(&output).contains("outside"),
            "{}",
            messages(&output)
        );
    }
    fs::remove_file(desk.path().join("models/catalog.csv")).expect("removed");
    let report = folder_report(index(&desk.path().join("models"), None).expect("indexed"));
    assert!(report.models == 0 && report.notes[0].contains("is a link to"), "{report:?}");
}

#[test]
fn verify_finds_what_changed_and_licences_what_is_not_stated() {
    let desk = desk_of(&["anchor", "tire"]);
    results(&desk.run(&["catalog", "index", "models"]));
    assert!(results(&desk.run(&["catalog", "verify", "-c", "models"])).contains("2 as indexed"));
    copy("chain", &desk, "models/tire.glb");
    let output = desk.run(&["catalog", "verify", "-c", "models"]);
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&output.stdout).contains("changed: tire.glb"));
    let starter = results(&desk.run(&["catalog", "verify", "-c", "starter"]));
    assert!(starter.contains(" 0 changed, 0 missing, 0 not in the lock"), "{starter}");

    let licences =
        results(&desk.run(&["catalog", "licences", "-c", "models", "-c", "starter", "--allow", "CC0-1.0", "--json"]));
    let licences: Value = serde_json::from_str(&licences).expect("JSON");
    assert_eq!((&licences[0]["licence"], &licences[0]["allowed"]), (&json!("unknown"), &json!(false)));
    assert_eq!((&licences[1]["licence"], &licences[1]["allowed"]), (&json!("CC0-1.0"), &json!(true)));
    let recipe =
        support::cli::small_recipe(1).replace("{catalog: starter, tags: [debris]}", "{catalog: models, uid: anchor}");
    desk.file("r.yaml", &recipe);
    let output = desk.run(&["check", "r.yaml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        messages(&output).contains("not stated") && messages(&output).contains("objects[0].pick"),
        "{}",
        messages(&output)
    );
    desk.file("r.yaml", &(recipe + "licences: {allow: [unknown]}\n"));
    results(&desk.run(&["check", "r.yaml"]));
}

#[test]
fn what_is_written_in_a_catalog_moves_no_cursor() {
    let desk = desk_of(&["anchor"]);
    let name = "An | anchor\u{1b}[2J\u{202e} <b>bold</b>";
    desk.file(
        "models/about.csv",
        &format!("file,name,licence,author\nanchor.glb,\"{name}\nsecond line\",by,\"x\u{7}\"\n"),
    );
    results(&desk.run(&["catalog", "index", "models"]));
    let catalog = Catalog::open(&desk.path().join("models")).expect("sound");
    assert_eq!(catalog.assets[0].name, "An | anchor [2J <b>bold</b> second line");
    for arguments in [
        &["catalog", "list", "-c", "models"][..],
        &["catalog", "show", "anchor", "-c", "models"],
        &["catalog", "search", "anchor", "-c", "models"],
    ] {
        let told = results(&desk.run(arguments));
        assert!(told.chars().all(|c| c == '\n' || !c.is_control()), "{told:?}");
    }
}
