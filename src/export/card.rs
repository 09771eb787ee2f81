//! The texts that go with a dataset: its card and whose models are in it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{Attribution, FinishInput};
use crate::catalog::Licence;
use crate::catalog::text::clean;
use crate::label::View;
use crate::store::{Counts, Fate, Misplaced, layout};

/// What the card tells of besides [`FinishInput`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct CardFacts<'a> {
    /// Name of the dataset.
    pub name: &'a str,
    /// Hash of the plan.
    pub plan_hash: &'a str,
    /// Version of the program.
    pub version: &'a str,
    /// How much there is.
    pub counts: &'a Counts,
    /// Objects that are not in their scenes, or pass through others, each with how often it came.
    pub misplaced: &'a BTreeMap<Misplaced, u64>,
}

/// The dataset card, `README.md`.
pub(crate) fn readme(facts: &CardFacts<'_>, input: &FinishInput) -> String {
    let sections = [
        format!("# {}\n\n{}\n", facts.name, input.description.trim()),
        how_much(facts.counts, input),
        placed(facts),
        views(input),
        how_to_load(input),
        how_made(facts, input),
        licences(&input.attributions),
    ];
    sections.join("\n")
}

/// Whose models are in the dataset, `ATTRIBUTION.md`: each model once, by uid.
pub(crate) fn attribution(name: &str, attributions: &[Attribution]) -> String {
    let mut text = format!("# Models in {name}\n\n");
    if attributions.is_empty() {
        text.push_str("No catalog models are in this dataset.\n");
        return text;
    }
    let mut models: Vec<_> = attributions.iter().collect();
    models.sort();
    models.dedup();
    let rows = models.into_iter().map(|m| {
        vec![format!("`{}`", m.uid), m.name.clone(), m.attribution.clone(), m.licence.clone(), m.source.clone()]
    });
    text += &table(&["Model", "Name", "Attribution", "Licence", "Source"], rows);
    let mut licences: Vec<Licence> = attributions.iter().map(|m| Licence::read(&m.licence)).collect();
    licences.sort();
    licences.dedup();
    text += "\n## Licences\n\n";
    let rows = licences.iter().map(|licence| vec![licence.id.clone(), licence.url()]);
    text + &table(&["Licence", "Terms"], rows)
}

fn how_much(counts: &Counts, input: &FinishInput) -> String {
    let count = |view: &View, label: &String| counts.annotations.get(view).and_then(|l| l.get(label)).copied();
    let splits = input.splits.iter().map(|split| {
        let frames = counts.frames.get(split).copied().unwrap_or(0);
        vec![split.clone(), frames.to_string()]
    });
    let labels = input.categories.iter().map(|label| {
        let views = input.views.iter().map(|view| count(view, label).unwrap_or(0).to_string());
        std::iter::once(label.clone()).chain(views).collect()
    });
    let mut header = vec!["Category"];
    header.extend(input.views.iter().map(|view| view.name()));
    format!(
        "## What is in it\n\n{}\nAnnotations of each category and view:\n\n{}",
        table(&["Split", "Frames"], splits),
        table(&header, labels)
    )
}

/// How many of the objects asked for are in their scenes; each fate once, with how often it came.
fn placed(facts: &CardFacts<'_>) -> String {
    let objects = &facts.counts.objects;
    if objects.asked == 0 {
        return String::new();
    }
    let mut text = format!("## Objects\n\nPlaced {} of {} objects", objects.placed, objects.asked);
    if facts.misplaced.is_empty() {
        return text + ".\n";
    }
    let left_out = objects.asked - objects.placed;
    writeln!(text, ": {left_out} left out, {} pass through others.\n", objects.overlapping)
        .expect("a string takes all text");
    let rows = facts.misplaced.iter().map(|(misplaced, count)| {
        let fate = match misplaced.fate {
            Fate::LeftOut => "left out",
            Fate::Overlaps => "overlaps",
        };
        vec![misplaced.asset.clone(), count.to_string(), fate.to_owned(), misplaced.reason.clone()]
    });
    text + &table(&["Object", "Times", "", "Why"], rows)
}

fn views(input: &FinishInput) -> String {
    let rows = input.views.iter().map(|&view| {
        let (folder, shape) = match view {
            View::Polar => ("polar", "one column a beam, one row a range bin; far ranges at the top, port on the left"),
            View::Fan => {
                ("fan", "true shape, square pixels; the sonar at the bottom centre, ahead is up, port on the left")
            }
        };
        vec![view.name().to_owned(), format!("`images/{folder}/`"), format!("`masks/{folder}/`"), shape.to_owned()]
    });
    format!(
        "## Views\n\n{}\nImages are 8-bit grey. Masks are 16-bit: the value of a pixel is the number of the body that dominates it, 0 where \
         none does, and `instance` in the annotations is the same number. Annotated masks hold all pixels where a body is \
         visible, so they may overlap (layover). `{}` has one row a frame: split, pose, drawn values, hashes.\n\n\
         World frame: x east, y north, z up, metres. Yaw is counter-clockwise from x, pitch nose up, roll port side up, degrees.\n",
        table(&["View", "Images", "Masks", "Shape"], rows),
        layout::FRAMES,
    )
}

fn how_to_load(input: &FinishInput) -> String {
    let (view, split) = (input.views.first(), input.splits.first());
    let Some((&view, split)) = view.zip(split) else { return String::new() };
    let path = layout::annotations(view, split);
    format!(
        "## How to load it\n\n```python\nfrom PIL import Image\nfrom pycocotools.coco import COCO\n\ncoco = COCO(\"{path}\")\n\
         for image in coco.loadImgs(coco.getImgIds()):\n    pixels = Image.open(image[\"file_name\"])\n    \
         for annotation in coco.loadAnns(coco.getAnnIds(image[\"id\"])):\n        mask = coco.annToMask(annotation)  \
         # height x width, 1 where the body is visible\n```\n"
    )
}

fn how_made(facts: &CardFacts<'_>, input: &FinishInput) -> String {
    let mut rows = vec![
        vec!["Program".to_owned(), format!("ensonify {}", facts.version)],
        vec!["Recipe".to_owned(), format!("[{0}]({0})", layout::RECIPE)],
        vec!["Seed".to_owned(), input.seed.to_string()],
        vec!["Plan hash".to_owned(), format!("`{}`", facts.plan_hash)],
    ];
    rows.extend(input.facts.iter().map(|(name, value)| vec![name.clone(), value.clone()]));
    format!(
        "## How it was made\n\nSynthetic: ray-traced sonar images of scenes drawn from a recipe. The same recipe and version \
         give the same bytes on every machine. `{}` holds every drawn value, `sha256sum -c {}` checks every file.\n\n{}",
        layout::PLAN,
        layout::SUMS,
        table(&["", ""], rows)
    )
}

fn licences(attributions: &[Attribution]) -> String {
    let mut text = String::from("## Licences\n\n");
    let mut licences: Vec<&str> = attributions.iter().map(|model| model.licence.as_str()).collect();
    licences.sort_unstable();
    licences.dedup();
    if licences.is_empty() {
        text.push_str("No catalog models are in this dataset.\n");
    } else {
        let names = licences.join(", ");
        writeln!(
            text,
            "The models in the scenes are under: {names}. [{0}]({0}) names each of them.",
            layout::ATTRIBUTION
        )
        .expect("a string takes all text");
    }
    text
}

/// A text that stays in its cell: on one line, no column of its own, no markup of a catalog's.
fn cell(text: &str) -> String {
    clean(text).replace('\\', "\\\\").replace('|', "\\|").replace('<', "&lt;")
}

/// A Markdown table.
fn table(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = format!("| {} |\n|{}\n", header.join(" | "), "---|".repeat(header.len()));
    for row in rows {
        let cells: Vec<String> = row.iter().map(|text| cell(text)).collect();
        writeln!(text, "| {} |", cells.join(" | ")).expect("a string takes all text");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_model_is_named_once_and_cannot_break_the_table() {
        let model = |uid: &str| Attribution {
            uid: uid.to_owned(),
            name: "Tire | worn <img src=x>\n\u{1b}[2J".to_owned(),
            attribution: "\"Tire\" by A. Person".to_owned(),
            licence: "CC-BY-4.0".to_owned(),
            source: "https://example.org".to_owned(),
        };
        let text = attribution("test", &[model("b"), model("a"), model("b")]);
        assert_eq!(text.lines().filter(|line| line.starts_with("| `")).count(), 2);
        assert!(text.find("`a`") < text.find("`b`"));
        assert!(text.contains("Tire \\| worn &lt;img src=x> [2J |"), "{text}");
        assert!(text.contains("| CC-BY-4.0 | https://creativecommons.org/licenses/by/4.0/ |"), "{text}");
    }
}
