//! `catalog.csv` and the catalog's README.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use anyhow::Result;
use sha2::{Digest as _, Sha256};

use super::object::Object;

/// The index of the catalog, one line an object.
///
/// # Errors
/// If the table cannot be written, which no object of this catalog causes.
pub fn catalog_csv(objects: &[Object]) -> Result<Vec<u8>> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let header = "uid,name,label,tags,path,size_m,up,material,licence,attribution,source";
    table.write_record(header.split(','))?;
    for object in objects {
        table.write_record([
            object.uid,
            object.name,
            object.label,
            &format!("{};{}", object.label, object.tags),
            &object.file_name(),
            &format!("{:.4}", object.size()),
            "y",
            object.parts[0].material.name(),
            "CC0-1.0",
            "ensonify contributors",
            "examples/starter_catalog",
        ])?;
    }
    Ok(table.into_inner()?)
}

/// Hashes of the models, as `ensonify catalog verify` and `sha256sum -c` read them.
#[must_use]
pub fn lock(files: &BTreeMap<String, Vec<u8>>) -> String {
    let models = files.iter().filter(|(name, _)| name.ends_with(".glb"));
    let hash = |bytes: &[u8]| Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    models.map(|(name, bytes)| format!("{}  {name}\n", hash(bytes))).collect()
}

/// What stands in the folder, how it is made and on what terms.
#[must_use]
pub fn readme(objects: &[Object]) -> String {
    let mut text = String::from(HEAD);
    for object in objects {
        let triangles: usize = object.meshes().iter().map(|mesh| mesh.triangles.len()).sum();
        let material = object.parts[0].material.name();
        writeln!(text, "| `{}` | {} | {:.2} | {material} | {triangles} |", object.uid, object.label, object.size())
            .expect("writing to a string cannot fail");
    }
    text.push_str(TAIL);
    text
}

const HEAD: &str = "\
# Starter catalog

Objects that people look for under water, as closed surfaces in true size, so that a first dataset needs no downloads.
Use it in a recipe with `pick: {catalog: starter, tags: [tire]}`.

| uid | label | longest side, m | main material | triangles |
|---|---|---|---|---|
";

const TAIL: &str = "
- `catalog.csv` holds names, labels, tags, sizes, materials and licences, `catalog.lock` the hash of each model.
- Models are glTF 2.0 binary: metres, y up, z front, lowest point at y = 0, in the pose in which the object lies on
  the bottom; divers, vehicles and animals that swim do so level, along x.
  Each part is a closed surface of its own (parts may overlap) whose glTF material bears the name of an acoustic material.

The files are generated, byte for byte the same everywhere, and `tests/starter_catalog.rs` compares them with the generator:

```sh
cargo run --release --example starter_catalog -- catalogs/starter
```

Licence: [CC0-1.0](https://creativecommons.org/publicdomain/zero/1.0/), no rights reserved.
";
