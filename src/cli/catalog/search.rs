//! `ensonify catalog search`: models by what people call them.

use clap::Args;
use serde::Serialize;

use super::{Opened, Which, size_of};
use crate::catalog::Licence;
use crate::cli::{Code, table};

/// Finds models by words: names, tags and categories, synonyms, several languages, typing errors
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  ensonify catalog search \"rusty anchor\"\n\nIn a recipe: pick: {catalog: starter, search: rusty anchor}"
)]
pub struct Search {
    /// What to look for, in English, German, Spanish, French or Chinese
    query: String,
    #[command(flatten)]
    which: Which,
    /// Most answers
    #[arg(short = 'n', long, default_value_t = 10)]
    limit: usize,
    /// Only models whose files are on this disk
    #[arg(long)]
    on_disk: bool,
    /// The same as JSON, with stable names
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Answer {
    catalog: String,
    uid: String,
    score: f32,
    name: String,
    label: String,
    tags: Vec<String>,
    size_m: Option<f64>,
    licence: String,
    source: String,
    on_disk: bool,
}

impl Search {
    pub(super) fn run(&self) -> anyhow::Result<Code> {
        let mut answers = Vec::new();
        let mut rows = Vec::new();
        for opened in self.which.open()? {
            self.ask(&opened, &mut answers, &mut rows)?;
        }
        let mut order: Vec<usize> = (0..answers.len()).collect();
        order.sort_by(|&a, &b| answers[b].score.total_cmp(&answers[a].score).then(a.cmp(&b)));
        order.truncate(self.limit);
        if self.json {
            let answers: Vec<&Answer> = order.iter().map(|&at| &answers[at]).collect();
            say!("{}", serde_json::to_string_pretty(&answers)?);
        } else if order.is_empty() {
            eprintln!("nothing fits `{}`; try another word for it, or its label alone", self.query);
        } else {
            let rows: Vec<Vec<String>> = order.iter().map(|&at| rows[at].clone()).collect();
            table::print(&["catalog", "uid", "label", "name", "size", "licence", "file"], &rows);
        }
        Ok(Code::Done)
    }

    fn ask(&self, opened: &Opened, answers: &mut Vec<Answer>, rows: &mut Vec<Vec<String>>) -> anyhow::Result<()> {
        let Opened { name, catalog } = opened;
        let most = if self.on_disk { 50 * self.limit } else { self.limit };
        let mut taken = 0;
        for found in catalog.find(&self.query, most)? {
            let asset = catalog.asset(found.model)?;
            let on_disk = asset.path.is_file();
            if taken == self.limit || (self.on_disk && !on_disk) {
                continue;
            }
            taken += 1;
            let licence = Licence::read(&asset.licence).id;
            let cells = [name, &asset.uid, &asset.label, &asset.name].map(String::clone);
            let there = if on_disk { "here" } else { "not here" };
            rows.push(cells.into_iter().chain([size_of(&asset), licence.clone(), there.into()]).collect());
            answers.push(Answer {
                catalog: name.clone(),
                score: found.score,
                on_disk,
                licence,
                uid: asset.uid,
                name: asset.name,
                label: asset.label,
                tags: asset.tags,
                size_m: asset.size_m,
                source: asset.source,
            });
        }
        Ok(())
    }
}
