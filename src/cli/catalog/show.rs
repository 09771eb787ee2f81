//! `ensonify catalog show`: what is known of a model, and a picture of it.

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use clap::Args;
use serde::Serialize;

use super::{Opened, Which, metres};
use crate::catalog::priors::SizeFrom;
use crate::catalog::{Asset, Licence, Model, solidity};
use crate::cli::Code;
use crate::view::portrait::{Portrait, portrait};

/// Tells what is known of a model, and draws it from three sides
#[derive(Debug, Args)]
pub struct Show {
    /// Its uid; `CATALOG/UID` where several catalogs have it
    uid: String,
    #[command(flatten)]
    which: Which,
    /// Draws the model at true scale from the front, the side and above
    #[arg(short, long, value_name = "PNG")]
    output: Option<PathBuf>,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Facts {
    catalog: String,
    uid: String,
    name: String,
    label: String,
    tags: Vec<String>,
    path: String,
    on_disk: bool,
    size_m: Option<f64>,
    size_from: SizeFrom,
    /// Right, back and up.
    dimensions_m: Option<[f64; 3]>,
    up: &'static str,
    material: String,
    surfaces: Vec<Surface>,
    triangles: Option<u64>,
    watertight: Option<bool>,
    licence: String,
    licence_url: String,
    attribution: String,
    source: String,
    about: String,
    problems: String,
}

#[derive(Debug, Serialize)]
struct Surface {
    name: String,
    material: String,
    /// Part of the whole area.
    share: f64,
}

impl Show {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let (opened, asset) = self.find()?;
        let model = if asset.path.is_file() { Some(asset.scaled_model()?) } else { None };
        let facts = facts(&opened, &asset, model.as_ref())?;
        if self.json {
            say!("{}", serde_json::to_string_pretty(&facts)?);
        } else {
            tell(&facts);
        }
        if let Some(output) = &self.output {
            let Some(model) = &model else {
                bail!("{} is not on this disk: there is nothing to draw", asset.path.display())
            };
            let title = format!("{}  {}  {}", asset.uid, asset.label, metres(facts.size_m.unwrap_or_default()));
            let picture = portrait(&Portrait {
                model,
                title: &title,
                material_of: &|surface| asset.material_of(surface).to_owned(),
            });
            picture.save(output).with_context(|| format!("cannot write {}", output.display()))?;
            eprintln!("picture: {}", output.display());
        }
        Ok(Code::Done)
    }

    fn find(&self) -> anyhow::Result<(Opened, Asset)> {
        let mut holding = Vec::new();
        let mut known = Vec::new();
        for opened in self.which.open()? {
            let own = self.uid.strip_prefix(opened.name.as_str()).and_then(|rest| rest.strip_prefix('/'));
            let found = match own.map(|uid| opened.catalog.get(uid)).transpose()?.flatten() {
                Some(asset) => Some(asset),
                None => opened.catalog.get(&self.uid)?,
            };
            match found {
                Some(asset) => holding.push((opened, asset)),
                None => known.push(opened),
            }
        }
        match holding.len() {
            1 => Ok(holding.remove(0)),
            0 => {
                let uids = known.iter().flat_map(|opened| opened.catalog.assets.iter().map(|asset| asset.uid.as_str()));
                let near = crate::catalog::error::did_you_mean(&self.uid, uids);
                bail!("no catalog has the uid `{}`{near}; `ensonify catalog search` finds models by words", self.uid)
            }
            _ => {
                let names: Vec<String> =
                    holding.iter().map(|(opened, asset)| format!("{}/{}", opened.name, asset.uid)).collect();
                bail!("several catalogs have the uid `{}`: say {}", self.uid, names.join(" or "))
            }
        }
    }
}

fn facts(opened: &Opened, asset: &Asset, model: Option<&Model>) -> anyhow::Result<Facts> {
    let solid = model.map(solidity::solidity);
    let extent = solid.as_ref().map(|solid| solid.extent);
    let licence = Licence::read(&asset.licence);
    let file_units = match (asset.size_m, model) {
        (None, Some(_)) => Some(asset.file_units()?),
        _ => None,
    };
    let sized = file_units.map(|units| asset.size(units));
    let about = match opened.catalog.disk() {
        Some(disk) => disk.number(&asset.uid)?.map(|number| disk.record(number)).transpose()?.map(|r| r.about),
        None => None,
    };
    let whole: f64 = solid.iter().flat_map(|solid| solid.areas.values()).sum();
    let surfaces = solid.iter().flat_map(|solid| &solid.areas).map(|(name, area)| Surface {
        name: crate::catalog::text::clean(name),
        material: asset.material_of(name).to_owned(),
        share: area / whole.max(f64::MIN_POSITIVE),
    });
    Ok(Facts {
        catalog: opened.name.clone(),
        size_m: extent.map(|e| f64::from(e.max_element())).or(asset.size_m),
        size_from: sized.map_or(asset.size_from, |sized| sized.from),
        dimensions_m: extent.map(|e| [e.x, e.z, e.y].map(f64::from)),
        up: asset.up.name(),
        surfaces: surfaces.collect(),
        triangles: solid.as_ref().map(|solid| solid.triangles).or(asset.triangles),
        watertight: solid.as_ref().map(|solid| solid.watertight).or(asset.watertight),
        on_disk: model.is_some(),
        path: asset.path.display().to_string(),
        licence_url: licence.url(),
        licence: licence.id,
        about: about.unwrap_or_default(),
        uid: asset.uid.clone(),
        name: asset.name.clone(),
        label: asset.label.clone(),
        tags: asset.tags.clone(),
        material: asset.material.clone(),
        attribution: asset.attribution.clone(),
        source: asset.source.clone(),
        problems: asset.problems.clone(),
    })
}

fn tell(facts: &Facts) {
    say!("{}/{}", facts.catalog, facts.uid);
    let known_by = match facts.size_from {
        SizeFrom::Given => "given",
        SizeFrom::File => "by its file, which agrees with its label",
        SizeFrom::Prior => "usual for its label",
        SizeFrom::Guessed => "guessed",
    };
    let size = facts.size_m.map(|size| format!("{} ({known_by})", metres(size))).unwrap_or_default();
    let sides =
        facts.dimensions_m.map(|[x, y, z]| format!("{} wide, {} deep, {} high", metres(x), metres(y), metres(z)));
    let triangles = facts.triangles.map(|count| count.to_string()).unwrap_or_default();
    let closed = facts.watertight.map_or("", |closed| if closed { ", closed" } else { ", not closed" });
    let file = if facts.on_disk { facts.path.clone() } else { format!("{} (not on this disk)", facts.path) };
    let lines = [
        ("name", facts.name.clone()),
        ("label", facts.label.clone()),
        ("tags", facts.tags.join(", ")),
        ("size", size),
        ("sides", sides.unwrap_or_default()),
        ("up", facts.up.to_owned()),
        ("material", facts.material.clone()),
        ("triangles", triangles + closed),
        ("licence", format!("{} {}", facts.licence, facts.licence_url)),
        ("credit", facts.attribution.clone()),
        ("source", facts.source.clone()),
        ("about", facts.about.clone()),
        ("problems", facts.problems.clone()),
        ("file", file),
    ];
    lines
        .iter()
        .filter(|(_, text)| !text.trim().is_empty())
        .for_each(|(key, text)| say!("  {key:<10} {}", text.trim()));
    for Surface { name, material, share } in &facts.surfaces {
        let name = if name.is_empty() { "(unnamed)" } else { name };
        say!("  {:<10} {name}: {material}, {:.0} %", "surface", 100.0 * share);
    }
}
