//! `ensonify catalog licences`: under which terms the models of catalogs are.

use std::collections::BTreeMap;

use clap::Args;
use serde::Serialize;

use super::Which;
use crate::catalog::{Licence, LicencePolicy};
use crate::cli::{Code, table};

/// Counts the licences of catalogs, and says which a recipe may use
#[derive(Debug, Args)]
pub struct Licences {
    #[command(flatten)]
    which: Which,
    /// Allowed licences, as in a recipe's `licences: {allow: […]}`; without it all that are known
    #[arg(long, value_delimiter = ',', value_name = "LICENCE")]
    allow: Option<Vec<String>>,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Line {
    catalog: String,
    licence: String,
    models: u64,
    allowed: bool,
    known: bool,
    url: String,
    /// One of the models.
    example: String,
}

impl Licences {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let policy = LicencePolicy { allow: self.allow.clone(), ..LicencePolicy::default() };
        let mut lines = Vec::new();
        for opened in self.which.open()? {
            let mut counts: BTreeMap<Licence, (u64, String)> = BTreeMap::new();
            for number in 0..opened.catalog.count() as u32 {
                let asset = opened.catalog.asset(number)?;
                let entry = counts.entry(Licence::read(&asset.licence)).or_insert_with(|| (0, asset.uid));
                entry.0 += 1;
            }
            lines.extend(counts.into_iter().map(|(licence, (models, example))| Line {
                catalog: opened.name.clone(),
                models,
                allowed: policy.allows(&licence),
                known: licence.known,
                url: licence.url(),
                licence: licence.id,
                example,
            }));
        }
        if self.json {
            say!("{}", serde_json::to_string_pretty(&lines)?);
            return Ok(Code::Done);
        }
        let rows = lines.iter().map(|line| {
            let allowed = if line.allowed { "allowed" } else { "refused" };
            [&line.catalog, &line.licence, &line.models.to_string(), allowed, &line.example, &line.url]
                .map(String::from)
                .to_vec()
        });
        table::print(&["catalog", "licence", "models", "a recipe is", "such as", "terms"], &rows.collect::<Vec<_>>());
        Ok(Code::Done)
    }
}
