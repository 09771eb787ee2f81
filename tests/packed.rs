//! Packed datasets: the hash of a loose one, and tar files that no kill, thread or flipped bit changes.
#![cfg(unix)]

mod support;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::Value;
use support::cli::{Desk, messages, small_recipe};

/// Ten scenes of three frames, loose in `a.yaml` and packed in `p.yaml`.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(10));
    desk.file(
        "p.yaml",
        &small_recipe(10).replace("fan_height_px: 160", "fan_height_px: 160, pack: tar, tar_frames: 4"),
    );
    desk
}

fn ensonify(desk: &Desk, arguments: &[&str]) -> (i32, String) {
    let output = desk.run(arguments);
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), messages(&output));
    (output.status.code().unwrap_or(-1), said)
}

fn done(desk: &Desk, arguments: &[&str]) {
    let (code, said) = ensonify(desk, arguments);
    assert_eq!(code, 0, "{arguments:?}: {said}");
}

fn hash(folder: &Path) -> String {
    let manifest = fs::read_to_string(folder.join("manifest.json")).expect("a manifest");
    let manifest: Value = serde_json::from_str(&manifest).expect("JSON");
    manifest["dataset_hash"].as_str().unwrap_or("unfinished").to_owned()
}

fn tars(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder.join("tars")).expect("tar files").map(|entry| entry.expect("an entry"));
    let read = |path: &Path| fs::read(path).expect("readable");
    entries.map(|entry| (entry.file_name().to_string_lossy().into_owned(), read(&entry.path()))).collect()
}

fn sums_are_right(folder: &Path) -> bool {
    let mut sums = Command::new("sha256sum");
    sums.args(["--quiet", "-c", "SHA256SUMS"]).current_dir(folder);
    sums.status().is_ok_and(|status| status.success())
}

#[test]
fn packed_and_loose_datasets_are_one_in_any_number_of_shards_and_threads() {
    let desk = desk();
    let at = |folder: &str| desk.path().join(folder);
    done(&desk, &["run", "a.yaml", "-o", "loose"]);
    done(&desk, &["run", "p.yaml", "-o", "one", "--jobs", "1"]);
    done(&desk, &["run", "p.yaml", "-o", "two", "--jobs", "2"]);
    assert_eq!([hash(&at("one")), hash(&at("two"))], [hash(&at("loose")), hash(&at("loose"))]);
    assert!(tars(&at("one")) == tars(&at("two")), "threads change no byte");
    assert_eq!(tars(&at("one")).len(), 8, "30 frames by 4");
    for index in ["2/3", "0/3", "1/3"] {
        done(&desk, &["run", "p.yaml", "-o", "three", "--shard", index]);
    }
    done(&desk, &["finish", "three"]);
    assert_eq!(hash(&at("three")), hash(&at("loose")));
    for folder in ["one", "three"] {
        assert!(!at(folder).join("images").exists() && !at(folder).join("masks").exists());
        assert!(sums_are_right(&at(folder)));
        done(&desk, &["verify", folder, "--rerender", "2"]);
    }
    let (code, said) = ensonify(&desk, &["diff", "loose", "three"]);
    assert!(code == 0 && said.contains("30 frames are the same"), "{said}");
    let figures = |folder: &str| String::from_utf8(desk.run(&["realism", "--json", folder]).stdout).expect("text");
    assert!(figures("loose").len() > 100 && figures("loose").replace("loose", "three") == figures("three"));
}

#[test]
fn a_killed_run_ends_in_the_same_tars() {
    let desk = desk();
    done(&desk, &["run", "p.yaml", "-o", "alone"]);
    let mut kills = 0;
    for wait in [60, 150, 250, 90, 400, 700] {
        let mut command = desk.command(&["run", "p.yaml", "-o", "out", "--jobs", "2"]);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("started");
        std::thread::sleep(Duration::from_millis(wait));
        kills += u32::from(child.try_wait().expect("asked").is_none());
        child.kill().expect("killed");
        child.wait().expect("gone");
    }
    assert!(kills > 0, "some came before the end");
    done(&desk, &["run", "p.yaml", "-o", "out"]);
    assert!(tars(&desk.path().join("out")) == tars(&desk.path().join("alone")));
    assert_eq!(hash(&desk.path().join("out")), hash(&desk.path().join("alone")));
    done(&desk, &["verify", "out"]);
}

#[test]
fn a_limited_run_leaves_tars_that_can_be_finished_and_filled_up() {
    let desk = desk();
    let out = desk.path().join("out");
    done(&desk, &["run", "p.yaml", "-o", "alone"]);
    done(&desk, &["run", "p.yaml", "-o", "out", "--limit", "7"]);
    assert_eq!(tars(&out).len(), 2, "no part stays");
    assert_eq!(ensonify(&desk, &["finish", "out", "--partial"]).0, 3);
    assert!(sums_are_right(&out));
    done(&desk, &["verify", "out"]);
    done(&desk, &["run", "p.yaml", "-o", "out"]);
    assert!(tars(&out) == tars(&desk.path().join("alone")));
}

#[test]
fn a_flipped_bit_names_its_member_and_costs_its_frame() {
    let desk = desk();
    let out = desk.path().join("out");
    done(&desk, &["run", "p.yaml", "-o", "out"]);
    let (whole, name) = (tars(&out), "00000-of-00001-000001.tar");
    let mut bytes = whole[name].clone();
    let header = bytes.windows(20).position(|name| name == b"000006.fan.mask.png\0").expect("a member");
    bytes[header + 512 + 30] ^= 16;
    fs::write(out.join("tars").join(name), bytes).expect("written");
    let (code, said) = ensonify(&desk, &["verify", "out"]);
    assert_eq!(code, 4, "{said}");
    assert!(said.contains("tars/00000-of-00001-000001.tar/000006.fan.mask.png"), "{said}");
    let found: Value = serde_json::from_slice(&desk.run(&["verify", "out", "--json"]).stdout).expect("JSON");
    assert_eq!(found["frames"], serde_json::json!([6]));
    let lines = || fs::read_to_string(out.join("shards/00000-of-00001.jsonl")).expect("a journal").lines().count();
    let before = lines();
    done(&desk, &["run", "p.yaml", "-o", "out"]);
    assert_eq!(lines(), before + 1, "one frame was rendered again");
    done(&desk, &["verify", "out"]);
    assert!(tars(&out) == whole);
}

#[test]
fn other_programs_read_the_tars() {
    let desk = desk();
    done(&desk, &["run", "p.yaml", "-o", "out", "--set", "scenes=1"]);
    let tar = desk.path().join("out/tars/00000-of-00001-000000.tar");
    let listed = |program: &str, arguments: &[&str]| match Command::new(program).args(arguments).arg(&tar).output() {
        Ok(output) => {
            assert!(output.status.success() && output.stderr.is_empty(), "{program}: {}", messages(&output));
            Some(String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect::<Vec<_>>())
        }
        Err(_) => {
            println!("skipped: there is no {program} here");
            None
        }
    };
    let mut expected = Vec::new();
    for frame in ["000000", "000001", "000002"] {
        let kinds = ["polar.png", "polar.mask.png", "fan.png", "fan.mask.png", "json"];
        expected.extend(kinds.map(|kind| format!("{frame}.{kind}")));
    }
    assert!(listed("tar", &["tf"]).is_none_or(|names| names == expected));
    let script = "import json, sys, tarfile
tar = tarfile.open(sys.argv[1])
for member in tar:
    contents = tar.extractfile(member).read()
    assert len(contents) == member.size and member.mtime > 0 and member.uid == 0
    assert not member.name.endswith('.png') or contents[:4] == b'\\x89PNG'
    assert not member.name.endswith('.json') or json.loads(contents)['views']['fan']['width'] > 0
    print(member.name)";
    assert!(listed("python3", &["-c", script]).is_none_or(|names| names == expected));
}
