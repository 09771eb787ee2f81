//! From finished frames to a dataset that is ready to use: annotations, tables, card, hashes.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::card::{self, CardFacts};
use super::coco::{self, Coco};
use super::frames::Table;
use crate::label::View;
use crate::store::{
    Counts, Dataset, Fate, FileRecord, FrameRecord, Misplaced, ObjectCounts, Sealing, StoreError, Summary, VERSION,
    layout,
};

/// What the frames' records do not tell.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FinishInput {
    /// What the dataset is, a sentence or more.
    pub description: String,
    /// Seed of the recipe.
    pub seed: u64,
    /// The views that frames have.
    pub views: Vec<View>,
    /// All splits, in order; one may be without frames.
    pub splits: Vec<String>,
    /// All labels, each once, in the order of their category ids; one may never be seen.
    pub categories: Vec<String>,
    /// More rows for the card's table of how the images were made: sonar, ranges …
    pub facts: Vec<(String, String)>,
    /// Objects that the plan asks for in all scenes.
    pub objects: u64,
    /// The models in the scenes, each once.
    pub attributions: Vec<Attribution>,
}

/// Whose a model is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Attribution {
    /// Catalog and uid, as annotations call it.
    pub uid: String,
    /// Name of the model.
    pub name: String,
    /// The line that its licence asks for.
    pub attribution: String,
    /// Its licence.
    pub licence: String,
    /// Where it comes from.
    pub source: String,
}

/// A dataset cannot be finished.
#[derive(Debug, Error)]
pub enum FinishError {
    /// The folder, or frames that are missing.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A frame has what the dataset does not know of.
    #[error(
        "frame {frame} has the {kind} `{found}`, which is none of {known}; the journal does not fit the recipe, run it again in another folder"
    )]
    Unknown {
        /// Name of the frame.
        frame: String,
        /// "split", "view" or "label".
        kind: &'static str,
        /// What the frame has.
        found: String,
        /// What there may be.
        known: String,
    },
}

/// Whether a dataset may lack frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Every frame of the plan must be there.
    Whole,
    /// What is there is finished; more frames may come, and finishing again takes them in.
    Partial,
}

/// Writes annotations, `frames.csv`, the card, attributions, `SHA256SUMS` and the manifest with the dataset hash, reading
/// the frames' records one by one. Done again, it writes the same bytes.
///
/// # Errors
/// [`StoreError::Unfinished`] with the missing frames unless they may be missing, or another [`FinishError`]; nothing is
/// written if the frames are not all known.
pub fn finish(dataset: &Dataset, input: &FinishInput, extent: Extent) -> Result<Summary, FinishError> {
    let missing = dataset.missing();
    if !missing.is_empty() && extent == Extent::Whole {
        return Err(StoreError::Unfinished { path: dataset.root().to_path_buf(), missing }.into());
    }
    let survey = survey(dataset, input)?;
    let sealing = Sealing::begin(dataset)?;
    let mut derived = annotations(&sealing, dataset, input)?;
    derived.push(sealing.write_with(layout::FRAMES, |out| survey.table.write(out, dataset, &input.views))?);
    let (name, plan_hash, counts) = (dataset.name(), dataset.plan_hash(), &survey.counts);
    let facts = CardFacts { name, plan_hash, version: VERSION, counts, misplaced: &survey.misplaced };
    let card = card::readme(&facts, input);
    derived.push(sealing.write_with(layout::CARD, |out| out.write_all(card.as_bytes()))?);
    let attribution = card::attribution(name, &input.attributions);
    derived.push(sealing.write_with(layout::ATTRIBUTION, |out| out.write_all(attribution.as_bytes()))?);
    Ok(sealing.seal(derived, survey.counts)?)
}

/// What one reading of all records tells.
struct Survey {
    counts: Counts,
    table: Table,
    /// Objects that are not in their scenes, or pass through others, each with how often it came.
    misplaced: BTreeMap<Misplaced, u64>,
}

fn survey(dataset: &Dataset, input: &FinishInput) -> Result<Survey, FinishError> {
    let none: BTreeMap<String, u64> = input.categories.iter().map(|label| (label.clone(), 0)).collect();
    // Zeros for what there might have been.
    let mut counts = Counts {
        frames: input.splits.iter().map(|split| (split.clone(), 0)).collect(),
        annotations: input.views.iter().map(|&view| (view, none.clone())).collect(),
        objects: ObjectCounts { asked: input.objects, placed: input.objects, overlapping: 0 },
    };
    let (mut table, mut misplaced) = (Table::default(), BTreeMap::new());
    for frame in dataset.records() {
        let frame = frame?;
        check(&frame, input)?;
        count(&frame, &mut counts);
        table.columns_of(&frame);
        frame.misplaced.into_iter().for_each(|object| *misplaced.entry(object).or_default() += 1);
    }
    Ok(Survey { counts, table, misplaced })
}

/// One file for each view and split.
fn annotations(sealing: &Sealing<'_>, dataset: &Dataset, input: &FinishInput) -> Result<Vec<FileRecord>, StoreError> {
    let mut files = Vec::new();
    for &view in &input.views {
        for split in &input.splits {
            let (categories, description) = (&input.categories, &input.description);
            let attributions = &input.attributions;
            let coco = Coco { view, split, categories, description, version: VERSION, attributions, dataset };
            files.push(sealing.write_with(&layout::annotations(view, split), |out| coco::write(out, &coco))?);
        }
    }
    Ok(files)
}

/// Refuses a frame whose split, views or labels would be lost in the files.
fn check(frame: &FrameRecord, input: &FinishInput) -> Result<(), FinishError> {
    let refuse = |kind, found: &str, known: String| {
        Err(FinishError::Unknown { frame: frame.name.clone(), kind, found: found.to_owned(), known })
    };
    if !input.splits.contains(&frame.split) {
        return refuse("split", &frame.split, input.splits.join(", "));
    }
    for (view, record) in &frame.views {
        if !input.views.contains(view) {
            return refuse(
                "view",
                view.name(),
                input.views.iter().map(|view| view.name()).collect::<Vec<_>>().join(", "),
            );
        }
        if let Some(unknown) = record.annotations.iter().find(|a| !input.categories.contains(&a.label)) {
            return refuse("label", &unknown.label, input.categories.join(", "));
        }
    }
    Ok(())
}

fn count(frame: &FrameRecord, counts: &mut Counts) {
    *counts.frames.entry(frame.split.clone()).or_default() += 1;
    for (&view, record) in &frame.views {
        let labels = counts.annotations.entry(view).or_default();
        for annotation in &record.annotations {
            *labels.entry(annotation.label.clone()).or_default() += 1;
        }
    }
    let objects = &mut counts.objects;
    for misplaced in &frame.misplaced {
        match misplaced.fate {
            Fate::LeftOut => objects.placed = objects.placed.saturating_sub(1),
            Fate::Overlaps => objects.overlapping += 1,
        }
    }
}

#[cfg(test)]
mod tests;
