//! Running the program as a user does.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// A folder of its own with recipes in it; gone when dropped.
pub struct Desk {
    folder: TempDir,
}

impl Desk {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file and gives its path.
    pub fn file(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path().join(name);
        fs::create_dir_all(path.parent().expect("below the desk")).expect("a folder");
        fs::write(&path, text).expect("written");
        path
    }

    /// The program with arguments, started in this folder.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ensonify"));
        command.args(arguments).current_dir(self.path());
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().expect("the program starts")
    }

    /// Names in this folder, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.path()).expect("readable");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

/// Every file of a dataset but the journal, whose lines stand in the order of completion.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).expect("readable") {
            let path = entry.expect("an entry").path();
            let name = path.strip_prefix(folder).expect("below").to_string_lossy().into_owned();
            if path.is_dir() {
                folders.push(path);
            } else if !name.starts_with("shards/") {
                found.insert(name, fs::read(path).expect("readable"));
            }
        }
    }
    found
}

/// What a process printed to standard error.
pub fn messages(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A small dataset of the starter catalog: `scenes` × 3 frames of a little sonar.
pub fn small_recipe(scenes: u32) -> String {
    format!(
        "ensonify: 1
name: small
seed: 5
scenes: {scenes}
frames: 3
sonar: {{beams: 96, azimuth_deg: 90, elevation_deg: 25, elevations: 150, range_m: [0.5, 9], range_bins: 192, frequency_khz: 900, mount: {{pitch_deg: -20}}}}
water: {{temperature_c: {{uniform: [4, 22]}}}}
seabed: {{extent_m: 20, cell_m: 0.2, shape: {{ripples: {{wavelength_m: 0.9}}}}, sediment: {{choice: [silt, gravel]}}}}
objects:
  - pick: {{catalog: starter, tags: [debris]}}
    count: {{int: [1, 3]}}
    pose: {{rest: {{within_m: 2}}}}
trajectory: {{orbit: {{radius_m: {{uniform: [4, 5]}}, altitude_m: 1.8}}}}
output: {{fan_height_px: 160}}
"
    )
}
