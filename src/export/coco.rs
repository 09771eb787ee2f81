//! COCO annotation files: one for each view and split, masks as compressed run lengths.
//!
//! Beyond the format's own keys, images name their `scene` and `frame`, and annotations their `instance` (the value in the
//! mask image) and `asset`. No dates, so that equal datasets have equal files.
//! Source: COCO data format, <https://cocodataset.org/#format-data>.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::{Serialize, Serializer};

use crate::label::View;
use crate::store::{FrameRecord, ViewRecord, layout};

/// One annotation file: a view of the frames of a split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coco<'a> {
    /// The view.
    pub view: View,
    /// The split.
    pub split: &'a str,
    /// Labels in the order of their ids, which count from 1; all labels of the frames are among them.
    pub categories: &'a [String],
    /// What the dataset is.
    pub description: &'a str,
    /// Version of the program that made it.
    pub version: &'a str,
    /// All frames by job id; those of other splits are left out here.
    pub frames: &'a BTreeMap<u64, FrameRecord>,
}

/// Writes the file, frame by frame: it is never in memory as a whole.
///
/// # Errors
/// If `out` cannot be written.
pub(crate) fn write(out: &mut dyn Write, coco: &Coco<'_>) -> io::Result<()> {
    let ids = coco.categories.iter().zip(1..).map(|(name, id)| (name.as_str(), id)).collect();
    let file = File {
        info: Info { description: coco.description, version: coco.version },
        licenses: [],
        categories: List(|| categories(coco.categories)),
        images: List(|| coco.frames().map(image)),
        annotations: List(|| coco.annotations(&ids)),
    };
    serde_json::to_writer(&mut *out, &file)?;
    out.write_all(b"\n")
}

impl<'a> Coco<'a> {
    /// The frames of this split that have this view.
    fn frames(&self) -> impl Iterator<Item = (View, &'a FrameRecord, &'a ViewRecord)> + use<'a> {
        let (view, split) = (self.view, self.split);
        let frames = self.frames.values().filter(move |frame| frame.split == split);
        frames.filter_map(move |frame| Some((view, frame, frame.views.get(&view)?)))
    }

    /// The annotations of [`Self::frames`], numbered from 1.
    fn annotations(&self, ids: &BTreeMap<&str, u64>) -> impl Iterator<Item = Annotation<'a>> {
        let all =
            self.frames().flat_map(|(_, frame, record)| record.annotations.iter().map(move |a| (frame, record, a)));
        all.zip(1..).map(|((frame, record, annotation), id)| Annotation {
            id,
            image_id: image_id(frame),
            category_id: *ids.get(annotation.label.as_str()).expect("labels are checked before anything is exported"),
            bbox: annotation.bbox,
            area: annotation.area,
            segmentation: Segmentation { size: [record.height, record.width], counts: &annotation.rle },
            iscrowd: 0,
            instance: annotation.body,
            asset: &annotation.asset,
        })
    }
}

#[derive(Serialize)]
struct File<'a, C: Serialize, I: Serialize, A: Serialize> {
    info: Info<'a>,
    licenses: [(); 0],
    categories: C,
    images: I,
    annotations: A,
}

#[derive(Serialize)]
struct Info<'a> {
    description: &'a str,
    version: &'a str,
}

#[derive(Serialize)]
struct Category<'a> {
    id: u64,
    name: &'a str,
    supercategory: &'a str,
}

#[derive(Serialize)]
struct Image {
    id: u64,
    file_name: String,
    width: u32,
    height: u32,
    scene: u64,
    frame: u64,
}

#[derive(Serialize)]
struct Annotation<'a> {
    id: u64,
    image_id: u64,
    category_id: u64,
    bbox: [u32; 4],
    area: u32,
    segmentation: Segmentation<'a>,
    iscrowd: u8,
    instance: u16,
    asset: &'a str,
}

#[derive(Serialize)]
struct Segmentation<'a> {
    size: [u32; 2],
    counts: &'a str,
}

/// A list that is serialised while it is made.
struct List<F>(F);

impl<T: Serialize, I: Iterator<Item = T>, F: Fn() -> I> Serialize for List<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0())
    }
}

fn categories(labels: &[String]) -> impl Iterator<Item = Category<'_>> {
    labels.iter().zip(1..).map(|(name, id)| Category { id, name, supercategory: "object" })
}

fn image((view, frame, record): (View, &FrameRecord, &ViewRecord)) -> Image {
    Image {
        id: image_id(frame),
        file_name: layout::image(view, &frame.name),
        width: record.width,
        height: record.height,
        scene: frame.scene,
        frame: frame.frame,
    }
}

/// Ids from 1, as some consumers take 0 for none.
fn image_id(frame: &FrameRecord) -> u64 {
    frame.id + 1
}
