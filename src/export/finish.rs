//! From finished frames to a dataset that is ready to use: annotations, tables, card, hashes.

use std::collections::BTreeMap;

use thiserror::Error;

use super::card::{self, CardFacts};
use super::coco::{self, Coco};
use super::frames;
use crate::label::View;
use crate::store::{Counts, FileRecord, FrameRecord, Store, StoreError, Summary, VERSION, layout};

/// What the frames' records do not tell.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FinishInput {
    /// What the dataset is, a sentence or more.
    pub description: String,
    /// Seed of the recipe.
    pub seed: u64,
    /// The views that frames have.
    pub views: Vec<View>,
    /// All splits, in order; one may be without frames.
    pub splits: Vec<String>,
    /// All labels, each once, in the order of their category ids; one may never be seen.
    pub categories: Vec<String>,
    /// More rows for the card's table of how the images were made: sonar, ranges …
    pub facts: Vec<(String, String)>,
    /// The models in the scenes, each once.
    pub attributions: Vec<Attribution>,
}

/// Whose a model is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Attribution {
    /// Catalog and uid, as annotations call it.
    pub uid: String,
    /// Name of the model.
    pub name: String,
    /// The line that its licence asks for.
    pub attribution: String,
    /// Its licence.
    pub licence: String,
    /// Where it comes from.
    pub source: String,
}

/// A dataset cannot be finished.
#[derive(Debug, Error)]
pub enum FinishError {
    /// The folder, or frames that are missing.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A frame has what the dataset does not know of.
    #[error(
        "frame {frame} has the {kind} `{found}`, which is none of {known}; the journal does not fit the recipe, run it again in another folder"
    )]
    Unknown {
        /// Name of the frame.
        frame: String,
        /// "split", "view" or "label".
        kind: &'static str,
        /// What the frame has.
        found: String,
        /// What there may be.
        known: String,
    },
}

/// Writes annotations, `frames.csv`, the card, attributions, `SHA256SUMS` and the manifest with the dataset hash. Done
/// again, it writes the same bytes.
///
/// # Errors
/// [`StoreError::Unfinished`] with the missing frames, or another [`FinishError`]; nothing is written if the frames are
/// not all there and known.
pub fn finish(store: &Store, input: &FinishInput) -> Result<Summary, FinishError> {
    let missing = store.missing();
    if !missing.is_empty() {
        return Err(StoreError::Unfinished { path: store.root().to_path_buf(), missing }.into());
    }
    let frames = store.finished();
    frames.values().try_for_each(|frame| check(frame, input))?;
    let counts = count(&frames, input);
    let mut derived = annotations(store, input, &frames)?;
    derived.push(store.write_with(layout::FRAMES, |out| frames::write(out, &frames, &input.views))?);
    let (name, plan_hash) = (store.name(), store.plan_hash());
    let card = card::readme(&CardFacts { name, plan_hash, version: VERSION, counts: &counts }, input);
    derived.push(store.write_with(layout::CARD, |out| out.write_all(card.as_bytes()))?);
    let attribution = card::attribution(name, &input.attributions);
    derived.push(store.write_with(layout::ATTRIBUTION, |out| out.write_all(attribution.as_bytes()))?);
    Ok(store.seal(frames.values(), &derived, counts)?)
}

/// One file for each view and split.
fn annotations(
    store: &Store,
    input: &FinishInput,
    frames: &BTreeMap<u64, FrameRecord>,
) -> Result<Vec<FileRecord>, StoreError> {
    let mut files = Vec::new();
    for &view in &input.views {
        for split in &input.splits {
            let (categories, description) = (&input.categories, &input.description);
            let attributions = &input.attributions;
            let coco = Coco { view, split, categories, description, version: VERSION, attributions, frames };
            files.push(store.write_with(&layout::annotations(view, split), |out| coco::write(out, &coco))?);
        }
    }
    Ok(files)
}

/// Refuses a frame whose split, views or labels would be lost in the files.
fn check(frame: &FrameRecord, input: &FinishInput) -> Result<(), FinishError> {
    let refuse = |kind, found: &str, known: String| {
        Err(FinishError::Unknown { frame: frame.name.clone(), kind, found: found.to_owned(), known })
    };
    if !input.splits.contains(&frame.split) {
        return refuse("split", &frame.split, input.splits.join(", "));
    }
    for (view, record) in &frame.views {
        if !input.views.contains(view) {
            return refuse(
                "view",
                view.name(),
                input.views.iter().map(|view| view.name()).collect::<Vec<_>>().join(", "),
            );
        }
        if let Some(unknown) = record.annotations.iter().find(|a| !input.categories.contains(&a.label)) {
            return refuse("label", &unknown.label, input.categories.join(", "));
        }
    }
    Ok(())
}

/// Counts with zeros for what there might have been.
fn count(frames: &BTreeMap<u64, FrameRecord>, input: &FinishInput) -> Counts {
    let none: BTreeMap<String, u64> = input.categories.iter().map(|label| (label.clone(), 0)).collect();
    let mut counts = Counts {
        frames: input.splits.iter().map(|split| (split.clone(), 0)).collect(),
        annotations: input.views.iter().map(|&view| (view, none.clone())).collect(),
    };
    for frame in frames.values() {
        *counts.frames.entry(frame.split.clone()).or_default() += 1;
        for (&view, record) in &frame.views {
            let labels = counts.annotations.entry(view).or_default();
            for annotation in &record.annotations {
                *labels.entry(annotation.label.clone()).or_default() += 1;
            }
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;
    use crate::store::Status;
    use crate::store::sample::{FRAMES, IDENTITY, frame};

    fn input() -> FinishInput {
        FinishInput {
            description: "Tires and anchors.".to_owned(),
            seed: 7,
            views: vec![View::Polar, View::Fan],
            splits: ["train", "val", "test"].map(str::to_owned).to_vec(),
            categories: ["tire", "anchor", "crab pot"].map(str::to_owned).to_vec(),
            facts: vec![("Sonar".to_owned(), "512 beams".to_owned())],
            attributions: vec![Attribution {
                uid: "starter/tire".to_owned(),
                name: "Tire".to_owned(),
                attribution: "none needed".to_owned(),
                licence: "CC0-1.0".to_owned(),
                source: "made for this project".to_owned(),
            }],
        }
    }

    fn dataset(root: &Path, order: &[u64]) -> Store {
        let store = Store::open(root, &IDENTITY).unwrap();
        for &id in order {
            let (record, files) = frame(id);
            store.commit(record, &files).unwrap();
        }
        store
    }

    /// All files but the journal, by their path.
    fn contents(root: &Path, folder: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let path = entry.path();
            if path.is_dir() && !path.ends_with("shards") {
                contents(root, &path, files);
            } else if path.is_file() {
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
        assert_eq!(&header[10..14], ["roll_deg", "seabed.sediment", "water.temperature_c", "annotations_polar"]);
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        assert_eq!(rows.len() as u64, FRAMES);
        for (row, frame) in rows.iter().zip(store.finished().values()) {
            assert_eq!(&row[1], frame.name);
            assert_eq!(row[5].parse(), Ok(frame.pose[0]), "numbers read back the same");
            assert_eq!(&row[11], "fine, \"sand\"");
            assert_eq!(row[13], frame.views[&View::Polar].annotations.len().to_string());
            assert_eq!(row[16], frame.file(&format!("images/fan/{}.png", frame.name)).unwrap().sha256);
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
}
