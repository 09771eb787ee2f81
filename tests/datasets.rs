//! Whole datasets through the program: the same bytes whatever happens on the way.
#![cfg(unix)]

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;
use support::cli::{Desk, files, messages, small_recipe};

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("readable")).expect("JSON")
}

fn dataset_hash(folder: &Path) -> String {
    json(&folder.join("manifest.json"))["dataset_hash"].as_str().expect("a finished dataset").to_owned()
}

#[test]
fn threads_and_kills_change_nothing() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(12));
    for (folder, jobs) in [("one", "1"), ("two", "2")] {
        let output = desk.run(&["run", "a.yaml", "-o", folder, "--jobs", jobs]);
        assert!(output.status.success(), "{}", messages(&output));
    }
    // Killed half-way, several times, then left alone.
    let killed = desk.path().join("killed");
    for share in [3, 2] {
        let mut child = desk.command(&["run", "a.yaml", "-o", "killed", "--jobs", "2"]).spawn().expect("started");
        let enough = 36 / share;
        let deadline = Instant::now() + Duration::from_secs(60);
        while lines(&killed) < enough && child.try_wait().expect("asked").is_none() && Instant::now() < deadline {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().expect("killed");
        child.wait().expect("gone");
        assert!(lines(&killed) >= enough);
    }
    let done = lines(&killed);
    let output = desk.run(&["run", "a.yaml", "-o", "killed", "--jobs", "2"]);
    assert!(output.status.success(), "{}", messages(&output));
    if done < 36 {
        assert!(messages(&output).contains("going on"), "{}", messages(&output));
    }

    let [one, two] = ["one", "two"].map(|name| files(&desk.path().join(name)));
    assert!(one == two, "--jobs 1 and --jobs 2 write the same files");
    assert!(one == files(&killed), "a killed run writes the same files");
    assert_eq!(dataset_hash(&desk.path().join("one")), dataset_hash(&killed));

    let sums = Command::new("sha256sum").args(["--quiet", "-c", "SHA256SUMS"]).current_dir(&killed).status();
    if let Ok(status) = sums {
        assert!(status.success(), "sha256sum -c SHA256SUMS");
    }
    // Once more changes nothing.
    assert!(desk.run(&["run", "a.yaml", "-o", "killed"]).status.success());
    assert!(one == files(&killed));
}

fn lines(dataset: &Path) -> usize {
    let journal = fs::read_to_string(dataset.join("shards/00000-of-00001.jsonl")).unwrap_or_default();
    journal.lines().count()
}

#[test]
fn an_interrupt_ends_in_order_and_the_run_goes_on() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(60));
    let mut child = desk.command(&["run", "a.yaml", "-o", "out", "--jobs", "1"]).spawn().expect("started");
    while lines(&desk.path().join("out")) < 2 {
        std::thread::sleep(Duration::from_millis(1));
    }
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert_eq!(child.wait().expect("ended").code(), Some(75));
    let status = desk.run(&["status", "out", "--json"]);
    let status: Value = serde_json::from_slice(&status.stdout).expect("JSON");
    assert_eq!(status["finished"], false);
    assert!(status["frames_done"].as_u64().expect("a number") >= 2);
}

#[test]
fn another_plan_is_refused_and_a_limit_goes_on() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(2));
    let output = desk.run(&["run", "a.yaml", "-o", "out", "--limit", "2"]);
    assert!(output.status.success() && lines(&desk.path().join("out")) == 2, "{}", messages(&output));
    let other = desk.run(&["run", "a.yaml", "-o", "out", "--set", "seed=6"]);
    assert_eq!(other.status.code(), Some(2));
    assert!(messages(&other).contains("another plan"), "{}", messages(&other));
    assert!(desk.run(&["run", "a.yaml", "-o", "out"]).status.success());
    assert_eq!(lines(&desk.path().join("out")), 6);
}

#[test]
fn annotations_list_every_frame_and_count_right() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(8));
    assert!(desk.run(&["run", "a.yaml", "-o", "out", "--set", "objects[0].count={int: [0, 2]}"]).status.success());
    let out = desk.path().join("out");
    let mut frames = 0;
    for split in ["train", "val", "test"] {
        for view in ["polar", "fan"] {
            let coco = json(&out.join(format!("annotations/{view}_{split}.json")));
            let images = coco["images"].as_array().expect("images");
            frames += images.len();
            for (i, annotation) in coco["annotations"].as_array().expect("annotations").iter().enumerate() {
                assert_eq!(annotation["id"].as_u64(), Some(i as u64 + 1), "ids from 1");
                assert!(annotation["area"].as_u64().expect("an area") >= 20);
            }
        }
    }
    assert_eq!(frames, 2 * 24, "every frame stands in one split of each view");
    let rows = fs::read_to_string(out.join("frames.csv")).expect("readable").lines().count();
    assert_eq!(rows, 1 + 24);
}

#[test]
fn a_new_key_moves_no_other_draw_and_order_does_not_matter() {
    let desk = Desk::new();
    let drawn = |text: &str| {
        desk.file("a.yaml", text);
        let output = desk.run(&["plan", "a.yaml", "--json"]);
        assert!(output.status.success(), "{}", messages(&output));
        let plan: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let drawn = |list: &str| {
            let all = plan[list].as_array().expect("a list").iter().map(|item| item["drawn"].clone());
            all.collect::<Vec<_>>()
        };
        let mut drawn = [drawn("scenes"), drawn("jobs")].concat();
        // The new key's own draw.
        drawn.iter_mut().filter_map(Value::as_object_mut).for_each(|draws| {
            draws.remove("sonar.frequency_khz");
        });
        drawn
    };
    let before = drawn(&small_recipe(4));
    let with_more = small_recipe(4).replace("frequency_khz: 900", "frequency_khz: {uniform: [700, 900]}");
    assert_eq!(before, drawn(&with_more));
    let mut lines: Vec<String> = small_recipe(4).lines().map(str::to_owned).collect();
    lines.swap(6, 7);
    assert_eq!(before, drawn(&lines.join("\n")));
}

#[test]
fn raw_echoes_are_written_when_asked_for() {
    let desk = Desk::new();
    desk.file("a.yaml", &small_recipe(1));
    assert!(desk.run(&["run", "a.yaml", "-o", "out", "--set", "output.raw=exr"]).status.success());
    let raw = fs::read(desk.path().join("out/raw/000000.exr")).expect("written");
    assert_eq!(raw[..4], [0x76, 0x2f, 0x31, 0x01], "an OpenEXR file");
}

#[test]
fn looks_show_the_same_echoes_under_other_conditions() {
    let desk = Desk::new();
    let looks = "looks:\n  - {name: plain}\n  - {name: warm, water: {temperature_c: 30}}\n  - {name: flat, image: {tvg_db_per_decade: 20}}\n";
    desk.file("plain.yaml", &small_recipe(2));
    desk.file("looks.yaml", &(small_recipe(2) + looks));
    for recipe in ["plain", "looks"] {
        let output = desk.run(&["run", &format!("{recipe}.yaml"), "-o", recipe]);
        assert!(output.status.success(), "{}", messages(&output));
    }
    let (plain, looks) = (files(&desk.path().join("plain")), files(&desk.path().join("looks")));
    for view in ["polar", "fan"] {
        let image = |look: &str| &looks[&format!("images/{view}/000004_{look}.png")];
        assert!(*image("plain") == plain[&format!("images/{view}/000004.png")], "a look that changes nothing");
        assert!(image("plain") != image("warm") && image("plain") != image("flat"));
        let mask = format!("masks/{view}/000004.png");
        assert!(looks[&mask] == plain[&mask], "labels are of the echoes");
    }
    let mut images = 0;
    for split in ["train", "val", "test"] {
        let coco = json(&desk.path().join(format!("looks/annotations/fan_{split}.json")));
        let ids: Vec<u64> =
            coco["images"].as_array().expect("images").iter().map(|i| i["id"].as_u64().expect("an id")).collect();
        assert!(ids.windows(2).all(|pair| pair[0] < pair[1]), "ids are unique");
        images += ids.len();
    }
    assert_eq!(images, 3 * 6);
}
