//! Whole datasets from sample frames.

use std::fs;
use std::path::Path;

use super::*;
use crate::store::sample::{FRAMES, IDENTITY, frame};
use crate::store::{Shard, Status, Store};

fn input() -> FinishInput {
    FinishInput {
        description: "Tires and anchors.".to_owned(),
        seed: 7,
        views: vec![View::Polar, View::Fan],
        splits: ["train", "val", "test"].map(str::to_owned).to_vec(),
        categories: ["tire", "anchor", "crab pot"].map(str::to_owned).to_vec(),
        facts: vec![("Sonar".to_owned(), "512 beams".to_owned())],
        objects: 6,
        attributions: vec![Attribution {
            uid: "starter/tire".to_owned(),
            name: "Tire".to_owned(),
            attribution: "none needed".to_owned(),
            licence: "CC0-1.0".to_owned(),
            source: "made for this project".to_owned(),
        }],
    }
}

/// All of a store's frames finished.
fn finish(store: &Store, input: &FinishInput) -> Result<Summary, FinishError> {
    super::finish(&store.dataset(), input, Extent::Whole)
}

fn dataset(root: &Path, order: &[u64]) -> Store {
    let store = Store::open(root, &IDENTITY, Shard::WHOLE).unwrap();
    for &id in order {
        let (record, files) = frame(id);
        store.commit(record, &files).unwrap();
    }
    store
}

/// All files but journals and locks, by their path.
fn contents(root: &Path, folder: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let path = entry.path();
        let is_of_the_run = path.extension().is_some_and(|kind| kind == "jsonl" || kind == "lock");
        if path.is_dir() {
            contents(root, &path, files);
        } else if !is_of_the_run {
            let name = path.strip_prefix(root).unwrap().to_str().unwrap().to_owned();
            files.insert(name, fs::read(path).unwrap());
        }
    }
}

fn all(root: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    contents(root, root, &mut files);
    files
}

#[test]
fn order_resume_and_repetition_change_no_byte() {
    let [a, b] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let summary = finish(&dataset(a.path(), &[0, 1, 2, 3, 4, 5]), &input()).unwrap();
    let first = all(a.path());
    drop(dataset(b.path(), &[5, 2]));
    let store = dataset(b.path(), &[4, 0, 3, 2, 1]);
    assert_eq!(finish(&store, &input()).unwrap(), summary);
    assert_eq!(all(b.path()), first);
    assert_eq!(finish(&store, &input()).unwrap(), summary);
    assert_eq!(all(b.path()), first);
    drop(store);
    assert_eq!(finish(&dataset(b.path(), &[]), &input()).unwrap(), summary);
    assert_eq!(all(b.path()), first);
    let status = Status::read(b.path()).unwrap();
    assert_eq!((status.finished, status.dataset_hash), (true, Some(summary.dataset_hash)));
    assert_eq!((summary.frames, summary.annotations), (FRAMES, 12));
    assert_eq!(summary.files + 1, first.len() as u64, "all but SHA256SUMS itself");
}

#[test]
fn the_dataset_hash_covers_pixels_but_not_words() {
    let [a, b, c] = [(); 3].map(|()| tempfile::tempdir().unwrap());
    let all = [0, 1, 2, 3, 4, 5];
    let hash = finish(&dataset(a.path(), &all), &input()).unwrap().dataset_hash;
    let words = FinishInput { facts: vec![], ..input() };
    assert_eq!(finish(&dataset(b.path(), &all), &words).unwrap().dataset_hash, hash);
    let store = dataset(c.path(), &all[1..]);
    let (record, mut files) = frame(0);
    files[0].bytes = crate::store::png::grey8(8, 6, &[9; 48]);
    store.commit(record, &files).unwrap();
    assert_ne!(finish(&store, &input()).unwrap().dataset_hash, hash);
}

#[test]
fn sha256sum_accepts_the_dataset() {
    let folder = tempfile::tempdir().unwrap();
    finish(&dataset(folder.path(), &[0, 1, 2, 3, 4, 5]), &input()).unwrap();
    let sums = fs::read_to_string(folder.path().join(layout::SUMS)).unwrap();
    let paths: Vec<&str> = sums.lines().map(|line| line.split_once("  ").unwrap().1).collect();
    assert!(paths.is_sorted());
    let files = all(folder.path());
    assert_eq!(paths, files.keys().map(String::as_str).filter(|&p| p != layout::SUMS).collect::<Vec<_>>());
    let check = std::process::Command::new("sha256sum")
        .args(["--check", "--strict", "--quiet", layout::SUMS])
        .current_dir(folder.path())
        .output();
    match check {
        Ok(output) => assert!(output.status.success(), "{output:?}"),
        Err(error) => println!("skipped: sha256sum does not run here: {error}"),
    }
}

#[test]
fn an_incomplete_dataset_names_its_missing_frames() {
    let folder = tempfile::tempdir().unwrap();
    let error = finish(&dataset(folder.path(), &[0, 2, 3, 5]), &input()).unwrap_err();
    assert!(matches!(&error, FinishError::Store(StoreError::Unfinished { missing, .. }) if missing == &[1, 4]));
    assert!(error.to_string().contains("2 frames (1, 4)"), "{error}");
    assert!(!folder.path().join("annotations").exists());
}

#[test]
fn a_label_or_split_that_no_file_would_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let store = dataset(folder.path(), &[0, 1, 2, 3, 4, 5]);
    for (input, wanted) in [
        (FinishInput { categories: vec!["tire".to_owned()], ..input() }, "label `anchor`"),
        (FinishInput { splits: vec!["train".to_owned()], ..input() }, "split `val`"),
        (FinishInput { views: vec![View::Fan], ..input() }, "view `polar`"),
    ] {
        let message = finish(&store, &input).unwrap_err().to_string();
        assert!(message.contains(wanted), "{message}");
    }
    assert!(!folder.path().join("annotations").exists());
}

#[test]
fn annotation_files_hold_the_frames_of_their_split_and_view() {
    let folder = tempfile::tempdir().unwrap();
    finish(&dataset(folder.path(), &[5, 4, 3, 2, 1, 0]), &input()).unwrap();
    let read = |name: &str| -> serde_json::Value {
        serde_json::from_slice(&fs::read(folder.path().join("annotations").join(name)).unwrap()).unwrap()
    };
    let train = read("fan_train.json");
    let ids = |list: &str, key: &str| -> Vec<u64> {
        train[list].as_array().unwrap().iter().map(|item| item[key].as_u64().unwrap()).collect()
    };
    assert_eq!(ids("images", "id"), [1, 2, 3, 4], "an image without objects is listed");
    assert_eq!(ids("annotations", "id"), [1, 2, 3, 4, 5]);
    assert_eq!(ids("annotations", "image_id"), [1, 1, 2, 4, 4]);
    assert_eq!(ids("annotations", "category_id"), [1, 2, 1, 1, 2]);
    assert_eq!(ids("categories", "id"), [1, 2, 3]);
    assert_eq!(train["images"][3]["file_name"], "images/fan/000003.png");
    assert_eq!(train["annotations"][1]["segmentation"]["size"], serde_json::json!([6, 8]));
    let test = read("polar_test.json");
    assert_eq!(test["images"], serde_json::json!([]));
    assert_eq!(test["categories"], train["categories"]);
}

#[test]
fn the_table_has_a_row_a_frame_in_job_order() {
    let folder = tempfile::tempdir().unwrap();
    let store = dataset(folder.path(), &[5, 4, 3, 2, 1, 0]);
    finish(&store, &input()).unwrap();
    let mut table = csv::Reader::from_path(folder.path().join(layout::FRAMES)).unwrap();
    let header: Vec<String> = table.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(&header[10..14], ["roll_deg", "time_s", "moved_m", "seabed.sediment"]);
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    assert_eq!(rows.len() as u64, FRAMES);
    for (row, frame) in rows.iter().zip(store.dataset().records().map(Result::unwrap)) {
        assert_eq!(&row[1], frame.name);
        assert_eq!(row[5].parse(), Ok(frame.pose[0]), "numbers read back the same");
        assert_eq!(row[11].parse(), Ok(frame.time_s));
        assert_eq!(&row[13], "fine, \"sand\"");
        assert_eq!(row[15], frame.views[&View::Polar].annotations.len().to_string());
        assert_eq!(row[18], frame.file(&format!("images/fan/{}.png", frame.name)).unwrap().sha256);
    }
}

#[test]
fn the_card_tells_counts_and_licences() {
    let folder = tempfile::tempdir().unwrap();
    finish(&dataset(folder.path(), &[0, 1, 2, 3, 4, 5]), &input()).unwrap();
    let card = fs::read_to_string(folder.path().join(layout::CARD)).unwrap();
    for line in [
        "# sample",
        "| train | 4 |",
        "| test | 0 |",
        "| tire | 4 | 4 |",
        "| crab pot | 0 | 0 |",
        "| Sonar | 512 beams |",
    ] {
        assert!(card.lines().any(|l| l == line), "{line} is missing in\n{card}");
    }
    assert!(card.contains("CC0-1.0"));
}

/// Prints what it took: `cargo test --release --lib -- --ignored --nocapture a_hundred_thousand`.
#[test]
#[ignore = "writes 400,000 files and a journal of 700 MB"]
fn a_hundred_thousand_frames_finish_in_a_minute() {
    const MANY: u64 = 100_000;
    let folder = tempfile::tempdir().unwrap();
    let identity = crate::store::Identity { frames: MANY, frames_a_scene: 100, ..IDENTITY };
    let _store = Store::open(folder.path(), &identity, Shard::WHOLE).unwrap();
    crate::store::sample::write_many(folder.path(), MANY);
    let input = FinishInput { categories: ["tire", "anchor"].map(str::to_owned).to_vec(), ..input() };
    let began = std::time::Instant::now();
    let status = Status::read(folder.path()).unwrap();
    println!("status {:.2} s", began.elapsed().as_secs_f64());
    assert_eq!(status.frames_done, MANY);
    let began = std::time::Instant::now();
    let dataset = crate::store::Dataset::open(folder.path()).unwrap();
    println!("open {:.2} s", began.elapsed().as_secs_f64());
    let summary = super::finish(&dataset, &input, Extent::Whole).unwrap();
    println!("finish, with opening {:.2} s", began.elapsed().as_secs_f64());
    let memory = fs::read_to_string("/proc/self/status").unwrap_or_default();
    println!("{}", memory.lines().find(|line| line.starts_with("VmHWM")).unwrap_or_default());
    assert_eq!(summary.frames, MANY);
}
