//! The recipes that come with the program are those that users start from: each passes `check` and renders.

mod support;

use std::fs;
use std::path::{Path, PathBuf};

use support::cli::{Desk, messages};

/// Less of all that takes time: what a frame shows is not looked at here.
const SMALL: [&str; 8] =
    ["--set", "scenes=1", "--set", "sonar.beams=64", "--set", "sonar.range_bins=128", "--set", "sonar.elevations=96"];

fn recipes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes");
    let entries = fs::read_dir(folder).expect("the folder of recipes");
    let mut found: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    found.retain(|path| path.extension().is_some_and(|extension| extension == "yaml"));
    found.sort();
    found
}

/// A recipe's path as an argument, and its name.
fn told(path: &Path) -> (&str, &str) {
    (path.to_str().expect("UTF-8"), path.file_stem().and_then(|stem| stem.to_str()).expect("UTF-8"))
}

#[test]
fn every_recipe_passes_check_and_has_its_files_name_and_a_schema() {
    let desk = Desk::new();
    for path in recipes() {
        let (path, name) = told(&path);
        let text = fs::read_to_string(path).expect("readable");
        assert!(text.starts_with("# yaml-language-server: $schema=../templates/recipe.schema.json\n"), "{name}");
        assert!(text.lines().any(|line| line == format!("name: {name}")), "{name} is named after its file");
        let output = desk.run(&["check", path, "--quick"]);
        assert!(output.status.success(), "{name}: {}", messages(&output));
    }
}

#[test]
fn the_six_that_a_team_starts_from_are_there() {
    let paths = recipes();
    for name in ["dam-wall", "fish-farm", "harbour-debris", "mine-like-objects", "pipeline-inspection", "wreck-survey"]
    {
        assert!(paths.iter().any(|path| told(path).1 == name), "{name}");
    }
}

#[test]
fn every_recipe_renders_a_frame() {
    let desk = Desk::new();
    for path in recipes() {
        let (path, name) = told(&path);
        let output = desk.run(&[&["run", path, "-o", name, "--limit", "1"], SMALL.as_slice()].concat());
        assert!(output.status.success(), "{name}: {}", messages(&output));
        let images = desk.path().join(name).join("images/fan");
        assert!(
            fs::read_dir(&images).is_ok_and(|mut entries| entries.next().is_some()),
            "{name}: {}",
            messages(&output)
        );
    }
}
