//! Folders that are new, gone on with, damaged, locked or somebody else's.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::super::Status;
use super::super::sample::{FRAMES, IDENTITY, frame};
use super::*;

fn commit(store: &Store, id: u64) {
    let (record, files) = frame(id);
    store.commit(record, &files).unwrap();
}

fn records(store: &Store) -> Vec<FrameRecord> {
    store.dataset().records().collect::<Result<_, _>>().unwrap()
}

fn refusal(root: &Path, identity: &Identity<'_>) -> StoreError {
    Store::open(root, identity, Shard::WHOLE).expect_err("the folder is refused")
}

/// Every file under a folder with its contents.
fn everything(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(root).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_dir() {
            files.extend(everything(&entry.path()));
        } else {
            files.insert(entry.path(), fs::read(entry.path()).unwrap());
        }
    }
    files
}

#[test]
fn frames_from_several_threads_are_there_when_the_folder_is_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("new/sample");
    let store = Store::open(&root, &IDENTITY, Shard::WHOLE).unwrap();
    assert_eq!(store.missing(), [0, 1, 2, 3, 4, 5]);
    std::thread::scope(|threads| {
        for id in [4, 1, 3] {
            let store = &store;
            threads.spawn(move || commit(store, id));
        }
    });
    assert_eq!(store.missing(), [0, 2, 5]);
    let before = records(&store);
    assert_eq!(Status::read(&root).unwrap().frames_done, 3, "status reads while the store is open");
    drop(store);
    let store = Store::open(&root, &IDENTITY, Shard::WHOLE).unwrap();
    assert_eq!(records(&store), before);
    let status = Status::read(&root).unwrap();
    assert_eq!((status.frames_total, status.finished), (FRAMES, false));
    let labels = BTreeMap::from([("tire".to_owned(), 3), ("anchor".to_owned(), 1)]);
    assert_eq!(status.annotations[&crate::label::View::Fan], labels);
    assert_eq!(fs::read_to_string(root.join(layout::RECIPE)).ok().as_deref(), IDENTITY.recipe_text);
    assert_eq!(fs::read(root.join(layout::PLAN)).unwrap(), IDENTITY.plan_json);
}

#[test]
fn damaged_lines_are_dropped_and_their_frames_are_missing() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    (0..4).for_each(|id| commit(&store, id));
    drop(store);
    let path = folder.path().join(layout::journal(Shard::WHOLE));
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let damaged = lines[1].replace("\"scene\":0", "\"scene\":9");
    assert_ne!(damaged, lines[1]);
    let torn = &lines[3][..lines[3].len() / 2];
    fs::write(&path, [lines[0], &damaged, "\u{0}\u{0}\n", lines[2], torn].concat()).unwrap();
    assert_eq!(Dataset::open(folder.path()).unwrap().done(), 2);
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    assert_eq!(store.missing(), [1, 3, 4, 5]);
    assert_eq!(fs::read_to_string(&path).unwrap(), [lines[0], lines[2]].concat());
    commit(&store, 3);
    drop(store);
    assert_eq!(
        Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap().missing(),
        [1, 4, 5],
        "lines follow the good part"
    );
}

#[test]
fn a_kill_between_files_and_journal_costs_only_that_frame() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    commit(&store, 0);
    drop(store);
    let (_, files) = frame(1);
    Writer::new(folder.path(), "x").write(&files[0].path, &files[0].bytes).unwrap();
    fs::write(folder.path().join(format!("{}.00000-of-00001.tmp", files[1].path)), b"half").unwrap();
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    assert_eq!(store.missing(), [1, 2, 3, 4, 5]);
    commit(&store, 1);
    assert_eq!(store.missing(), [2, 3, 4, 5]);
    assert!(everything(folder.path()).keys().all(|path| path.extension().is_none_or(|e| e != "tmp")));
}

#[test]
fn a_frame_with_a_lost_or_cut_file_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    (0..3).for_each(|id| commit(&store, id));
    drop(store);
    fs::remove_file(folder.path().join("masks/fan/000000.png")).unwrap();
    fs::write(folder.path().join("images/polar/000002.png"), b"short").unwrap();
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    assert_eq!(store.missing(), [0, 2, 3, 4, 5]);
    (0..3).for_each(|id| commit(&store, id));
    drop(store);
    assert_eq!(Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap().missing(), [3, 4, 5]);
}

#[test]
fn a_second_writer_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    assert!(matches!(refusal(folder.path(), &IDENTITY), StoreError::Locked { .. }));
    drop(store);
    Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
}

#[test]
fn another_plan_or_version_is_refused_and_nothing_is_touched() {
    let folder = tempfile::tempdir().unwrap();
    commit(&Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap(), 0);
    let before = everything(folder.path());
    let message =
        refusal(folder.path(), &Identity { plan_hash: "ffff", plan_json: b"{\"jobs\":[1]}\n", ..IDENTITY }).to_string();
    assert!(message.contains("0123abcd") && message.contains("ffff") && message.contains("-o"), "{message}");
    assert!(message.contains("(jobs: a list of 0 → a list of 1)"), "{message}");
    assert_eq!(everything(folder.path()), before);
    let manifest = folder.path().join(layout::MANIFEST);
    let text = fs::read_to_string(&manifest).unwrap();
    let version = format!("\"ensonify\": \"{}\"", crate::store::VERSION);
    fs::write(&manifest, text.replace(&version, "\"ensonify\": \"0.0.9\"")).unwrap();
    assert!(matches!(refusal(folder.path(), &IDENTITY), StoreError::OtherVersion { .. }));
}

#[test]
fn a_damaged_manifest_beside_the_right_plan_is_written_again() {
    let folder = tempfile::tempdir().unwrap();
    commit(&Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap(), 0);
    let manifest = folder.path().join(layout::MANIFEST);
    let text = fs::read_to_string(&manifest).unwrap();
    for damaged in ["{}".to_owned(), text.replace("0123abcd", "1123abcd")] {
        fs::write(&manifest, damaged).unwrap();
        assert_eq!(Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap().missing().len(), 5);
        assert_eq!(fs::read_to_string(&manifest).unwrap(), text);
    }
    fs::write(folder.path().join(layout::PLAN), "{}").unwrap();
    fs::write(&manifest, "{}").unwrap();
    assert!(matches!(refusal(folder.path(), &IDENTITY), StoreError::Manifest { .. }));
}

#[test]
fn shards_write_journals_of_their_own_and_see_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two] = [0, 1].map(|index| Store::open(folder.path(), &IDENTITY, Shard { index, count: 2 }).unwrap());
    assert_eq!((one.missing(), two.missing()), (vec![0, 1, 2], vec![3, 4, 5]));
    (0..3).for_each(|id| commit(&one, id));
    commit(&two, 4);
    two.fail(5, "no room").unwrap();
    assert!(one.missing().is_empty());
    assert_eq!(two.missing(), [3, 5]);
    let names: Vec<_> = ["00000-of-00002", "00001-of-00002"].map(|tag| format!("shards/{tag}.jsonl")).into();
    assert!(names.iter().all(|name| folder.path().join(name).is_file()));
    drop((one, two));
    let whole = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    assert_eq!(whole.missing(), [3, 5], "another division finds what is there");
    assert_eq!(whole.dataset().failed().collect::<Vec<_>>(), [(5, "no room")]);
    commit(&whole, 5);
    assert_eq!(Dataset::open(folder.path()).unwrap().failed().count(), 0);
}

#[test]
fn a_recipe_with_other_comments_takes_the_place_of_the_old() {
    let folder = tempfile::tempdir().unwrap();
    commit(&Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap(), 0);
    let identity = Identity { recipe_text: Some("# better\nname: sample\n"), ..IDENTITY };
    assert_eq!(Store::open(folder.path(), &identity, Shard::WHOLE).unwrap().missing(), [1, 2, 3, 4, 5]);
    assert_eq!(fs::read_to_string(folder.path().join(layout::RECIPE)).ok().as_deref(), identity.recipe_text);
}

#[test]
fn folders_that_are_none_of_ours_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("thesis.pdf");
    fs::write(&file, "x").unwrap();
    let foreign = refusal(folder.path(), &IDENTITY);
    assert!(matches!(&foreign, StoreError::Foreign { found, .. } if found == "thesis.pdf"), "{foreign}");
    assert_eq!(everything(folder.path()).len(), 1);
    assert!(matches!(refusal(&file, &IDENTITY), StoreError::NotAFolder { .. }));
    let below = refusal(&file.join("out"), &IDENTITY).to_string();
    assert!(below.contains("thesis.pdf") && below.contains("-o"), "{below}");
    assert!(matches!(Status::read(folder.path()), Err(StoreError::NoDataset { .. })));
}

#[test]
fn a_run_killed_before_its_manifest_does_not_make_the_folder_foreign() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("shards")).unwrap();
    fs::write(folder.path().join(layout::lock(Shard::WHOLE)), "").unwrap();
    fs::write(folder.path().join("manifest.json.00000-of-00001.tmp"), "{").unwrap();
    assert_eq!(Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap().missing().len() as u64, FRAMES);
}

#[test]
fn a_frame_outside_the_plan_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap();
    let (record, files) = frame(FRAMES);
    assert!(matches!(store.commit(record, &files), Err(StoreError::Record { id: FRAMES, .. })));
    assert!(!folder.path().join("images").exists());
}

#[test]
fn a_plan_alone_leaves_the_recipe_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let alone = Identity { recipe_text: None, ..IDENTITY };
    commit(&Store::open(folder.path(), &alone, Shard::WHOLE).unwrap(), 0);
    assert!(!folder.path().join(layout::RECIPE).exists());
    for identity in [&IDENTITY, &alone] {
        let store = Store::open(folder.path(), identity, Shard::WHOLE).unwrap();
        assert!(folder.path().join(layout::RECIPE).is_file());
        assert_eq!(store.manifest.recipe_sha256, Manifest::begun(&IDENTITY).recipe_sha256);
    }
}
