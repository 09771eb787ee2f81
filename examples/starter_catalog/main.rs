//! Writes the starter catalog: underwater objects as GLB models with their `catalog.csv`.
//!
//! `cargo run --release --example starter_catalog -- catalogs/starter`

mod generator;

use std::path::PathBuf;

use anyhow::{Context as _, Result};

fn main() -> Result<()> {
    let folder: PathBuf = std::env::args_os().nth(1).context("usage: starter_catalog FOLDER")?.into();
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for (name, bytes) in generator::files()? {
        let path = folder.join(&name);
        std::fs::write(&path, &bytes).with_context(|| format!("cannot write {}", path.display()))?;
        println!("{name}: {} bytes", bytes.len());
    }
    Ok(())
}
