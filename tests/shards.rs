//! A dataset divided among processes, killed, damaged and put together: always the same bytes.
#![cfg(unix)]

mod support;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use support::cli::{Desk, messages, small_recipe};

/// SIGKILLs of the chaos test; more with ENSONIFY_CHAOS=200.
const KILLS: u32 = 24;

fn hash(folder: &Path) -> String {
    let manifest = fs::read_to_string(folder.join("manifest.json")).expect("a manifest");
    let manifest: Value = serde_json::from_str(&manifest).expect("JSON");
    manifest["dataset_hash"].as_str().unwrap_or("unfinished").to_owned()
}

/// Runs to its end; the code and what it said.
fn ensonify(desk: &Desk, arguments: &[&str]) -> (i32, String) {
    let output = desk.run(arguments);
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), messages(&output));
    (output.status.code().unwrap_or(-1), said)
}

/// The hash of an undisturbed run.
fn alone(desk: &Desk) -> String {
    let (code, said) = ensonify(desk, &["run", "a.yaml", "-o", "alone", "--jobs", "1"]);
    assert_eq!(code, 0, "{said}");
    hash(&desk.path().join("alone"))
}

#[test]
fn the_hash_is_the_same_for_any_number_of_shards() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(10));
    let alone = alone(&desk);
    for shards in [2, 7] {
        let folder = format!("in-{shards}");
        for index in (0..shards).rev() {
            let early = ensonify(&desk, &["finish", &folder]);
            assert_eq!(early.0, 2, "{}", early.1);
            let shard = format!("{index}/{shards}");
            let (code, said) = ensonify(&desk, &["run", "a.yaml", "-o", &folder, "--shard", &shard, "--jobs", "2"]);
            assert_eq!(code, 0, "{said}");
        }
        for _ in 0..2 {
            let (code, said) = ensonify(&desk, &["finish", &folder]);
            assert_eq!((code, hash(&desk.path().join(&folder))), (0, alone.clone()), "{said}");
        }
        assert_eq!(ensonify(&desk, &["verify", &folder, "--rerender", "3"]).0, 0);
        assert_eq!(ensonify(&desk, &["diff", "alone", &folder]).0, 0);
    }
}

#[test]
fn part_of_a_dataset_can_be_finished_and_the_rest_added() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(4));
    let alone = alone(&desk);
    assert_eq!(ensonify(&desk, &["run", "a.yaml", "-o", "out", "--shard", "1/2"]).0, 0);
    let (code, said) = ensonify(&desk, &["finish", "out"]);
    assert!(code == 2 && said.contains("6 frames (0, 1, 2, 3, 4, 5)"), "{said}");
    let (code, said) = ensonify(&desk, &["finish", "out", "--partial"]);
    assert_eq!(code, 3, "{said}");
    assert!(said.contains("6 of 12 frames are missing"), "{said}");
    let mut sums = Command::new("sha256sum");
    sums.args(["--quiet", "-c", "SHA256SUMS"]).current_dir(desk.path().join("out"));
    assert!(sums.status().is_ok_and(|status| status.success()));
    let (code, said) = ensonify(&desk, &["run", "a.yaml", "-o", "out"]);
    assert_eq!((code, hash(&desk.path().join("out"))), (0, alone), "{said}");
}

#[test]
fn the_environment_of_an_array_job_names_the_shard() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(4));
    let task = |variables: &[(&str, &str)]| {
        let mut command = desk.command(&["run", "a.yaml", "-o", "out"]);
        command.envs(variables.iter().copied());
        command.output().expect("started")
    };
    let output = task(&[("SLURM_ARRAY_TASK_ID", "2"), ("SLURM_ARRAY_TASK_MIN", "1"), ("SLURM_ARRAY_TASK_COUNT", "2")]);
    assert!(messages(&output).contains("shard 1/2: SLURM_ARRAY_TASK_ID=2"), "{}", messages(&output));
    assert!(desk.path().join("out/shards/00001-of-00002.jsonl").is_file());
    let output = task(&[("JOB_COMPLETION_INDEX", "1")]);
    assert_eq!(output.status.code(), Some(2));
    assert!(messages(&output).contains("--shards N"), "{}", messages(&output));
}

#[test]
fn a_second_process_on_a_shard_is_told_and_another_plan_with_what_differs() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(40));
    let mut first = start(&desk, "0/2");
    let journal = desk.path().join("out/shards/00000-of-00002.jsonl");
    await_lines(&journal, 1, &mut first);
    let (code, said) = ensonify(&desk, &["run", "a.yaml", "-o", "out", "--shard", "0/2"]);
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("another ensonify process") && said.contains("00000-of-00002.lock"), "{said}");
    first.kill().expect("killed");
    first.wait().expect("gone");
    let (code, said) = ensonify(&desk, &["run", "a.yaml", "-o", "out", "--set", "seed=6"]);
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("seed: 5 → 6"), "{said}");
}

#[test]
fn every_warning_signal_ends_in_order() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(60));
    let journal = desk.path().join("out/shards/00000-of-00001.jsonl");
    for signal in ["INT", "TERM", "USR1", "USR2"] {
        // Lines of its own: those before it say nothing of whether it listens yet.
        let there = fs::read_to_string(&journal).unwrap_or_default().lines().count();
        let mut run = start(&desk, "0/1");
        await_lines(&journal, there + 1, &mut run);
        Command::new("kill").args([&format!("-{signal}"), &run.id().to_string()]).status().expect("kill");
        let asked = Instant::now();
        assert_eq!(run.wait().expect("ended").code(), Some(75), "{signal}");
        assert!(asked.elapsed() < Duration::from_secs(20), "{signal}");
    }
}

/// Kills, torn lines, cut and lost files, over runs of one to four shards: the last start mends everything.
#[test]
fn chaos_changes_no_byte() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(6));
    let alone = alone(&desk);
    let kills: u32 = std::env::var("ENSONIFY_CHAOS").ok().and_then(|n| n.parse().ok()).unwrap_or(KILLS);
    let mut random = Random(0x5eed);
    let (mut killed, mut rounds) = (0, 0);
    while killed < kills {
        let _ = fs::remove_dir_all(desk.path().join("out"));
        let shards = 1 + random.below(4);
        for _ in 0..2 + random.below(4) {
            let mut all: Vec<Child> = (0..shards).map(|index| start(&desk, &format!("{index}/{shards}"))).collect();
            std::thread::sleep(Duration::from_millis(u64::from(random.below(250))));
            for child in &mut all {
                killed += u32::from(child.try_wait().expect("asked").is_none());
                child.kill().expect("killed");
                child.wait().expect("gone");
            }
            damage(&desk.path().join("out"), &mut random);
        }
        // What verification finds changed is rendered again; lengths alone do not tell of a flipped bit.
        if desk.path().join("out/manifest.json").is_file() {
            let (code, said) = ensonify(&desk, &["verify", "out"]);
            assert!(code == 0 || code == 4, "{said}");
        }
        let (code, said) = ensonify(&desk, &["run", "a.yaml", "-o", "out"]);
        assert_eq!((code, hash(&desk.path().join("out"))), (0, alone.clone()), "round {rounds}: {said}");
        rounds += 1;
    }
    println!("{killed} kills in {rounds} rounds");
}

#[test]
fn a_full_disk_stops_with_a_message_and_the_run_goes_on_elsewhere() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(10));
    let small = desk.path().join("small");
    fs::create_dir(&small).expect("a folder");
    let mount = Command::new("mount").args(["-t", "tmpfs", "-o", "size=600k", "tmpfs"]).arg(&small).output();
    if !mount.is_ok_and(|output| output.status.success()) {
        println!("skipped: no small disk can be mounted here");
        return;
    }
    let mounted = Mounted(small.clone());
    let (code, said) = ensonify(&desk, &["run", "a.yaml", "-o", "small/out"]);
    assert_eq!(code, 75, "{said}");
    assert!(said.contains("No space left") && said.contains("frames are safe"), "{said}");
    let copied = Command::new("cp").args(["-r", "small/out", "out"]).current_dir(desk.path()).status();
    assert!(copied.expect("cp").success());
    drop(mounted);
    let alone = alone(&desk);
    let (code, said) = ensonify(&desk, &["run", "a.yaml", "-o", "out"]);
    assert_eq!((code, hash(&desk.path().join("out"))), (0, alone), "{said}");
    assert!(said.contains("going on"), "{said}");
}

struct Mounted(PathBuf);

impl Drop for Mounted {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}

fn start(desk: &Desk, shard: &str) -> Child {
    let mut command = desk.command(&["run", "a.yaml", "-o", "out", "--jobs", "1", "--shard", shard]);
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("started")
}

fn await_lines(journal: &Path, lines: usize, child: &mut Child) {
    let deadline = Instant::now() + Duration::from_secs(120);
    let written = || fs::read_to_string(journal).unwrap_or_default().lines().count();
    while written() < lines && child.try_wait().expect("asked").is_none() {
        assert!(Instant::now() < deadline, "{lines} lines in time");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Tears a journal's last line, flips a bit, cuts or deletes a file: one of each, somewhere.
fn damage(root: &Path, random: &mut Random) {
    let files = |folder: &str| -> Vec<PathBuf> {
        let entries = fs::read_dir(root.join(folder)).into_iter().flatten();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
        paths.sort();
        paths
    };
    let journals: Vec<PathBuf> =
        files("shards").into_iter().filter(|path| path.extension().is_some_and(|kind| kind == "jsonl")).collect();
    if let Some(journal) = random.of(&journals) {
        let text = fs::read(journal).expect("readable");
        let keep = text.len().saturating_sub(random.below(300) as usize);
        fs::write(journal, &text[..keep]).expect("written");
    }
    let (images, masks) = (files("images/polar"), files("masks/fan"));
    if let Some(image) = random.of(&images) {
        let mut bytes = fs::read(image).expect("readable");
        match (random.below(2), bytes.len()) {
            (0, _) => bytes.truncate(bytes.len() / 2),
            (_, 0) => {}
            (_, length) => bytes[length / 2] ^= 4,
        }
        fs::write(image, bytes).expect("written");
    }
    if let Some(mask) = random.of(&masks) {
        fs::remove_file(mask).expect("deleted");
    }
}

/// A small generator: what is disturbed need not be random, only various.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(bound)) as u32
    }

    fn of<'a, T>(&mut self, things: &'a [T]) -> Option<&'a T> {
        let place = self.below(things.len().max(1) as u32) as usize;
        things.get(place)
    }
}
