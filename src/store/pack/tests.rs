//! Packed datasets that are interrupted, damaged, shared out and put together: always the same tar files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::super::sample::{FRAMES, IDENTITY, frame};
use super::super::{Identity, Shard, Store, Summary, Verification, atomic, layout, verify};
use super::packer::names;
use super::*;
use crate::export::{Extent, FinishInput, finish};
use crate::label::View;

/// Two frames a tar file.
const PACKED: Identity<'static> = Identity { pack: Some(Pack { tar_frames: 2 }), ..IDENTITY };

fn open(root: &Path, shard: Shard) -> Store {
    Store::open(root, &PACKED, shard).unwrap()
}

fn commit(store: &Store, ids: &[u64]) {
    for &id in ids {
        let (record, files) = frame(id);
        store.commit(record, &files).unwrap();
    }
}

fn input() -> FinishInput {
    FinishInput {
        views: vec![View::Polar, View::Fan],
        splits: ["train", "val", "test"].map(str::to_owned).to_vec(),
        categories: ["tire", "anchor"].map(str::to_owned).to_vec(),
        ..FinishInput::default()
    }
}

fn finished(store: &Store) -> Summary {
    finish(&store.dataset(), &input(), Extent::Whole).unwrap()
}

/// Renders what is missing and finishes; which frames were missing.
fn run(root: &Path) -> (Vec<u64>, Summary) {
    let store = open(root, Shard::WHOLE);
    let missing = store.missing();
    commit(&store, &missing);
    store.pack().unwrap();
    (missing, finished(&store))
}

/// All that lies among the tar files.
fn tars(root: &Path) -> BTreeMap<String, Vec<u8>> {
    names(root).unwrap().into_iter().map(|name| (name.clone(), fs::read(root.join(name)).unwrap())).collect()
}

fn is_sound(found: &Verification) -> bool {
    found.changed.is_empty() && found.missing.is_empty() && found.extra.is_empty()
}

/// The tar files of an undisturbed run.
fn undisturbed() -> BTreeMap<String, Vec<u8>> {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path());
    tars(folder.path())
}

#[test]
fn packed_and_loose_datasets_have_the_same_hash_and_sums_of_what_is_there() {
    let [loose, packed] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let store = Store::open(loose.path(), &IDENTITY, Shard::WHOLE).unwrap();
    commit(&store, &[0, 1, 2, 3, 4, 5]);
    let (_, summary) = run(packed.path());
    assert_eq!(summary.dataset_hash, finished(&store).dataset_hash);
    let same = |path: &str| assert_eq!(fs::read(loose.path().join(path)).ok(), fs::read(packed.path().join(path)).ok());
    [layout::FRAMES, "annotations/fan_train.json", "annotations/polar_val.json"].iter().for_each(|path| same(path));
    let names: Vec<String> = tars(packed.path()).into_keys().collect();
    assert_eq!(names, [0, 1, 2].map(|number| layout::tar(Shard::WHOLE, number)));
    let sums = fs::read_to_string(packed.path().join(layout::SUMS)).unwrap();
    assert!(names.iter().all(|name| sums.contains(name)) && !sums.contains("images/"), "{sums}");
    for line in sums.lines() {
        let (sha256, path) = line.split_once("  ").unwrap();
        assert_eq!(atomic::hash_file(&packed.path().join(path)).unwrap().1, sha256, "{path}");
    }
    assert_eq!(summary.files, sums.lines().count() as u64);
    assert!(!packed.path().join("images").exists());
    assert!(is_sound(&verify(packed.path()).unwrap()));
}

#[test]
fn the_order_of_frames_changes_no_byte() {
    let expected = undisturbed();
    let folder = tempfile::tempdir().unwrap();
    let store = open(folder.path(), Shard::WHOLE);
    std::thread::scope(|threads| {
        for ids in [[5, 0], [2, 4], [3, 1]] {
            let store = &store;
            threads.spawn(move || commit(store, &ids));
        }
    });
    assert!(tars(folder.path()) == expected, "tar files are there as soon as their frames are");
    for (id, path) in [(4, "images/fan/000004.png"), (1, "masks/polar/000001.png")] {
        let dataset = store.dataset();
        let record = dataset.records().nth(id).unwrap().unwrap();
        let bytes = dataset.place(&record, path).read().unwrap();
        assert_eq!(atomic::sha256(&bytes), record.file(path).unwrap().sha256);
    }
}

#[test]
fn an_interrupted_run_goes_on_in_the_middle_of_a_tar() {
    let expected = undisturbed();
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join(layout::part(&layout::tar(Shard::WHOLE, 1), 0));
    commit(&open(folder.path(), Shard::WHOLE), &[0, 1, 3]);
    assert_eq!(tars(folder.path()).len(), 2, "a tar and a part");
    // Half a block that no line of the journal tells of.
    let mut bytes = fs::read(&part).unwrap();
    bytes.extend([7; 700]);
    fs::write(&part, bytes).unwrap();
    assert!(is_sound(&verify(folder.path()).unwrap()));
    let store = open(folder.path(), Shard::WHOLE);
    assert_eq!(store.missing(), [2, 4, 5]);
    commit(&store, &[2]);
    let kept = fs::read(folder.path().join(layout::tar(Shard::WHOLE, 1))).unwrap();
    assert!(kept == expected[&layout::tar(Shard::WHOLE, 1)] && !part.exists());
    commit(&store, &[4]);
    drop(store);
    // A part that is cut off has lost its frame.
    let part = folder.path().join(layout::part(&layout::tar(Shard::WHOLE, 2), 0));
    let bytes = fs::read(&part).unwrap();
    fs::write(&part, &bytes[..bytes.len() - 1]).unwrap();
    assert_eq!(run(folder.path()).0, [4, 5]);
    assert!(tars(folder.path()) == expected);
}

#[test]
fn a_crash_while_a_tar_is_assembled_is_made_good() {
    let expected = undisturbed();
    let folder = tempfile::tempdir().unwrap();
    let (tar, store) = (layout::tar(Shard::WHOLE, 0), open(folder.path(), Shard::WHOLE));
    commit(&store, &[1]);
    let part = folder.path().join(layout::part(&tar, 0));
    let kept = fs::read(&part).unwrap();
    commit(&store, &[0]);
    drop(store);
    // Before the part was deleted; and before the tar had its name.
    fs::write(&part, &kept).unwrap();
    let store = open(folder.path(), Shard::WHOLE);
    assert_eq!(store.missing(), [2, 3, 4, 5]);
    store.pack().unwrap();
    assert!(!part.exists());
    drop(store);
    let temporary = folder.path().join(format!("{tar}.00000-of-00001.tmp"));
    fs::rename(folder.path().join(&tar), &temporary).unwrap();
    fs::write(&part, &kept).unwrap();
    assert_eq!(run(folder.path()).0, [0, 2, 3, 4, 5], "frame 1 is in the part");
    assert!(tars(folder.path()) == expected);
}

#[test]
fn a_flipped_bit_in_a_tar_is_named_and_a_run_mends_it() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let (_, summary) = run(root);
    let (expected, sums) = (tars(root), fs::read(root.join(layout::SUMS)).unwrap());
    for (name, bytes) in &expected {
        for at in (0..bytes.len()).step_by(509) {
            let mut changed = bytes.clone();
            changed[at] ^= 1;
            fs::write(root.join(name), changed).unwrap();
            let found = verify(root).unwrap();
            assert!(found.changed.contains(name), "{name} byte {at}: {found:?}");
            let is_end = at + 1024 >= bytes.len();
            let inside = format!("{name}/");
            let named = found.changed.iter().chain(&found.missing).filter(|path| path.starts_with(&inside)).count();
            assert_eq!(
                (named, found.frames.len()),
                if is_end { (0, 0) } else { (1, 1) },
                "{name} byte {at}: {found:?}"
            );
            let (mended, again) = run(root);
            assert_eq!((&mended, &again), (&found.frames, &summary), "{name} byte {at}");
            assert!(tars(root) == expected, "{name} byte {at}");
            assert!(fs::read(root.join(layout::SUMS)).unwrap() == sums, "{name} byte {at}");
            assert!(is_sound(&verify(root).unwrap()), "{name} byte {at}");
        }
    }
    let mut text = sums.clone();
    let at = String::from_utf8_lossy(&sums).find(expected.keys().next().unwrap()).unwrap() - 10;
    text[at] = if text[at] == b'0' { b'1' } else { b'0' };
    fs::write(root.join(layout::SUMS), text).unwrap();
    assert_eq!(verify(root).unwrap().changed, [layout::SUMS]);
}

#[test]
fn a_lost_or_cut_tar_costs_its_own_frames() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    run(root);
    let expected = tars(root);
    let name = layout::tar(Shard::WHOLE, 1);
    fs::remove_file(root.join(&name)).unwrap();
    let found = verify(root).unwrap();
    assert_eq!((found.missing, found.frames), (vec![name.clone()], vec![2, 3]));
    assert_eq!(run(root).0, [2, 3]);
    fs::write(root.join(&name), &expected[&name][..expected[&name].len() - 2000]).unwrap();
    let found = verify(root).unwrap();
    assert!(found.missing.contains(&format!("{name}/000003.json")), "{found:?}");
    assert_eq!(run(root).0, [3]);
    assert!(tars(root) == expected);
}

#[test]
fn another_division_into_shards_mends_what_one_has_left() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let shards = [0, 1].map(|index| Shard { index, count: 2 });
    for shard in shards {
        let store = open(root, shard);
        commit(&store, &store.missing());
        store.pack().unwrap();
    }
    let name = layout::tar(shards[0], 0);
    let (hash, whole) = {
        let summary = finished(&open(root, Shard::WHOLE));
        (summary.dataset_hash, tars(root))
    };
    assert_eq!(whole.len(), 4, "three frames a shard");
    let mut bytes = whole[&name].clone();
    bytes[700] ^= 1;
    fs::write(root.join(&name), bytes).unwrap();
    assert_eq!(verify(root).unwrap().frames, [0]);
    let (mended, summary) = run(root);
    assert_eq!((mended, summary.dataset_hash), (vec![0], hash));
    let now = tars(root);
    assert!(now.contains_key(&layout::tar(Shard::WHOLE, 0)) && now[&name].len() < whole[&name].len());
    assert!(is_sound(&verify(root).unwrap()));
}

#[test]
fn finishing_puts_the_tars_of_killed_shards_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let shards = [0, 1].map(|index| Shard { index, count: 2 });
    commit(&open(folder.path(), shards[1]), &[3, 4, 5]);
    let store = open(folder.path(), shards[0]);
    commit(&store, &[0, 1, 2]);
    drop(store);
    let expected = tars(folder.path());
    // As if the first had been killed before it assembled.
    let (tar, part) = (layout::tar(shards[0], 1), layout::part(&layout::tar(shards[0], 1), 0));
    let block = &expected[&tar][..expected[&tar].len() - 1024];
    fs::write(folder.path().join(part), block).unwrap();
    fs::remove_file(folder.path().join(tar)).unwrap();
    let dataset = super::super::Dataset::open(folder.path()).unwrap();
    assert_eq!(dataset.done(), FRAMES);
    finish(&dataset, &input(), Extent::Whole).unwrap();
    assert!(tars(folder.path()) == expected);
}
