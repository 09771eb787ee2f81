//! `ensonify catalog`: models of one's own, the starter catalog, caches of Objaverse.

mod annotate;
mod index;
mod licences;
mod list;
mod search;
mod show;
mod verify;

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, Subcommand};

use super::Code;
use crate::catalog::find::catalogs_near;
use crate::catalog::{Asset, Catalog, find_catalog};

/// Models: indexes, searches, shows and checks catalogs
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  ensonify catalog search \"rusty anchor\"\n  ensonify catalog index path/to/models\n  \
                        ensonify catalog index ~/.objaverse --into catalogs/objaverse"
)]
pub struct CatalogVerb {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Index(index::Index),
    Search(search::Search),
    Show(show::Show),
    List(list::List),
    Licences(licences::Licences),
    Annotate(annotate::Annotate),
    Verify(verify::Verify),
}

impl CatalogVerb {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        match &self.verb {
            Verb::Index(verb) => verb.run(),
            Verb::Search(verb) => verb.run(),
            Verb::Show(verb) => verb.run(),
            Verb::List(verb) => verb.run(),
            Verb::Licences(verb) => verb.run(),
            Verb::Annotate(verb) => verb.run(),
            Verb::Verify(verb) => verb.run(),
        }
    }
}

/// Which catalogs a verb looks at.
#[derive(Debug, Args)]
struct Which {
    /// A catalog: a name under `catalogs/`, or a folder. May be given several times; without it, every catalog under
    /// `catalogs/`
    #[arg(short, long, value_name = "NAME|DIR")]
    catalog: Vec<String>,
}

/// An opened catalog with the name that it is called by.
struct Opened {
    name: String,
    catalog: Catalog,
}

impl Which {
    fn open(&self) -> anyhow::Result<Vec<Opened>> {
        let found: Vec<(String, PathBuf)> = if self.catalog.is_empty() {
            catalogs_near(Path::new("."))
        } else {
            let find = |name: &String| Ok((name.clone(), find_catalog(name, Path::new("."))?));
            self.catalog.iter().map(find).collect::<anyhow::Result<_>>()?
        };
        if found.is_empty() {
            bail!(
                "there is no catalog under `catalogs/`; name one with --catalog, or make one with `ensonify catalog index`"
            );
        }
        found.into_iter().map(|(name, dir)| Ok(Opened { name, catalog: Catalog::open(&dir)? })).collect()
    }
}

/// Metres for people.
fn metres(size: f64) -> String {
    match size {
        0.0..0.1 => format!("{size:.3} m"),
        0.1..10.0 => format!("{size:.2} m"),
        _ => format!("{size:.1} m"),
    }
}

/// Size of a model as an index knows it.
fn size_of(asset: &Asset) -> String {
    asset.size_m.map_or_else(|| "by its file".to_owned(), metres)
}
