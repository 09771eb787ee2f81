//! `ensonify catalog list`: the models of catalogs, one a line.

use clap::Args;
use serde::Serialize;

use super::{Which, size_of};
use crate::catalog::priors::SizeFrom;
use crate::catalog::{Asset, Licence};
use crate::cli::{Code, table};

/// Lists the models of catalogs
#[derive(Debug, Args)]
pub struct List {
    #[command(flatten)]
    which: Which,
    /// Only models of this label
    #[arg(long)]
    label: Option<String>,
    /// Most models of a catalog; 0 for all
    #[arg(short = 'n', long, default_value_t = 200)]
    limit: u64,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Line {
    catalog: String,
    uid: String,
    name: String,
    label: String,
    size_m: Option<f64>,
    size_from: SizeFrom,
    up: &'static str,
    material: String,
    triangles: Option<u64>,
    watertight: Option<bool>,
    licence: String,
    problems: String,
}

impl List {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let mut lines = Vec::new();
        let mut rows = Vec::new();
        for opened in self.which.open()? {
            let count = opened.catalog.count();
            let most = if self.limit == 0 { count } else { self.limit };
            let mut taken = 0;
            for number in 0..count as u32 {
                let asset = opened.catalog.asset(number)?;
                if self.label.as_ref().is_some_and(|label| asset.label != *label) {
                    continue;
                }
                if taken == most {
                    eprintln!("note: {} has {count} models; --limit 0 lists them all", opened.name);
                    break;
                }
                taken += 1;
                rows.push(row(&opened.name, &asset));
                lines.push(line(&opened.name, asset));
            }
        }
        if self.json {
            say!("{}", serde_json::to_string_pretty(&lines)?);
        } else {
            let header =
                ["catalog", "uid", "label", "size", "known by", "up", "material", "triangles", "closed", "licence"];
            table::print(&header, &rows);
        }
        Ok(Code::Done)
    }
}

fn row(catalog: &str, asset: &Asset) -> Vec<String> {
    let closed = asset.watertight.map_or("", |closed| if closed { "yes" } else { "no" });
    let triangles = asset.triangles.map(|count| count.to_string()).unwrap_or_default();
    let cells = [
        catalog,
        &asset.uid,
        &asset.label,
        &size_of(asset),
        asset.size_from.name(),
        asset.up.name(),
        &asset.material,
        &triangles,
        closed,
        &Licence::read(&asset.licence).id,
    ];
    cells.map(String::from).to_vec()
}

fn line(catalog: &str, asset: Asset) -> Line {
    Line {
        catalog: catalog.to_owned(),
        licence: Licence::read(&asset.licence).id,
        up: asset.up.name(),
        uid: asset.uid,
        name: asset.name,
        label: asset.label,
        size_m: asset.size_m,
        size_from: asset.size_from,
        material: asset.material,
        triangles: asset.triangles,
        watertight: asset.watertight,
        problems: asset.problems,
    }
}
