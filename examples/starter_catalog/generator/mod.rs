//! The starter catalog, drawn by parameters: the same bytes on every machine.
//!
//! One module a family of objects; `shape`, `prism`, `curve` and `noise` draw surfaces, `glb` and `listing` write files.

mod anchors;
mod animals;
mod body;
mod building;
mod cargo;
mod containers;
mod craft;
mod curve;
mod gear;
mod glb;
mod household;
mod lines;
mod listing;
mod more_containers;
mod munitions;
mod noise;
mod object;
mod ordnance;
mod people;
mod prism;
mod reef;
mod robots;
mod rocks;
mod shape;
mod shells;
mod solid;
mod targets;
mod timber;
mod vessels;
mod wheels;
mod wrecks;

use std::collections::BTreeMap;

use anyhow::Result;

/// Every file of the catalog by its name.
///
/// # Errors
/// If a model cannot be serialised.
pub fn files() -> Result<BTreeMap<String, Vec<u8>>> {
    let mut objects = [
        anchors::all(),
        animals::all(),
        building::all(),
        cargo::all(),
        containers::all(),
        craft::all(),
        gear::all(),
        household::all(),
        lines::all(),
        more_containers::all(),
        munitions::all(),
        ordnance::all(),
        people::all(),
        reef::all(),
        robots::all(),
        rocks::all(),
        shells::all(),
        targets::all(),
        timber::all(),
        vessels::all(),
        wheels::all(),
        wrecks::all(),
    ]
    .concat();
    objects.sort_by_key(|object| object.uid);
    let mut files = BTreeMap::new();
    for object in &objects {
        files.insert(object.file_name(), glb::bytes(object)?);
    }
    files.insert("catalog.csv".into(), listing::catalog_csv(&objects)?);
    files.insert("catalog.lock".into(), listing::lock(&files).into_bytes());
    files.insert("README.md".into(), listing::readme(&objects).into_bytes());
    Ok(files)
}
