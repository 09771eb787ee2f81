//! What the journal says of a finished frame.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::label::{View, ViewLabels};
use crate::scene::Body;

/// A finished frame: where it comes from, what is seen in it, which files it has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrameRecord {
    /// Number of the job, from 0.
    pub id: u64,
    /// Name in paths, see [`frame_name`](super::layout::frame_name).
    pub name: String,
    /// Variant of the recipe; none without a sweep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Number of the scene in its variant.
    pub scene: u64,
    /// Number of the frame in its scene.
    pub frame: u64,
    /// `train`, `val` ….
    pub split: String,
    /// The sonar in the world: x, y, z in metres, then yaw, pitch, roll in degrees.
    pub pose: [f64; 6],
    /// When it was taken: since the scene's first frame, or as a file of poses has it, seconds.
    pub time_s: f64,
    /// How far the vehicle was moved to keep clear of bottom, objects and structures, metres.
    pub moved_m: f64,
    /// Drawn values by their path in the recipe.
    pub values: BTreeMap<String, serde_json::Value>,
    /// Names of the looks that each view was imaged with; empty where there is but one, without a name.
    pub looks: Vec<String>,
    /// What is seen in each view that was written; the same in every look.
    pub views: BTreeMap<View, ViewRecord>,
    /// The frame's files; [`Store::commit`](super::Store::commit) fills this in.
    pub files: Vec<FileRecord>,
}

/// What is seen in one view of a frame.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ViewRecord {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// By body number.
    pub annotations: Vec<AnnotationRecord>,
}

/// One body in one view.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AnnotationRecord {
    /// Body number, from 1: the value in the mask.
    pub body: u16,
    /// Category.
    pub label: String,
    /// Catalog and uid of the model.
    pub asset: String,
    /// Left, top, width, height in pixels.
    pub bbox: [u32; 4],
    /// Number of visible pixels.
    pub area: u32,
    /// COCO's compressed run lengths of the visible pixels.
    pub rle: String,
}

/// One file of a dataset.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileRecord {
    /// Relative to the dataset folder, with forward slashes.
    pub path: String,
    /// Length.
    pub bytes: u64,
    /// SHA-256, 64 hexadecimal digits.
    pub sha256: String,
}

impl ViewRecord {
    /// The record of a view's labels; `bodies` are the scene's, body number = index + 1.
    ///
    /// # Panics
    /// If `labels` are of another scene and name a body that `bodies` lacks.
    #[must_use]
    pub fn new(labels: &ViewLabels, bodies: &[Body]) -> Self {
        let annotations = labels.annotations.iter().map(|annotation| {
            let body = &bodies[usize::from(annotation.body) - 1];
            AnnotationRecord {
                body: annotation.body,
                label: body.label.clone(),
                asset: body.asset.clone(),
                bbox: annotation.bbox,
                area: annotation.area,
                rle: annotation.rle.encode(),
            }
        });
        Self { width: labels.width, height: labels.height, annotations: annotations.collect() }
    }
}

impl FrameRecord {
    /// The looks to go through: their names, or the one without a name.
    pub fn each_look(&self) -> impl Iterator<Item = Option<&str>> + '_ {
        let unnamed = self.looks.is_empty().then_some(None);
        unnamed.into_iter().chain(self.looks.iter().map(|name| Some(name.as_str())))
    }

    /// The frame's file at a path, if it has one.
    #[must_use]
    pub fn file(&self, path: &str) -> Option<&FileRecord> {
        self.files.iter().find(|file| file.path == path)
    }
}
