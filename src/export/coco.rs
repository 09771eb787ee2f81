//! COCO annotation files: one for each view and split, masks as compressed run lengths.
//!
//! Beyond the format's own keys, images name their `variant`, `scene`, `frame` and `look`, and annotations their `instance` (the value in the
//! mask image), `asset` and the `license` of that; `assets` tells whose each is. No dates, so that equal datasets have equal files.
//! Source: COCO data format, <https://cocodataset.org/#format-data>.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::{Serialize, Serializer};

use super::Attribution;
use crate::catalog::Licence;
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
    /// The models in the scenes.
    pub attributions: &'a [Attribution],
    /// All frames by job id; those of other splits are left out here.
    pub frames: &'a BTreeMap<u64, FrameRecord>,
}

/// Writes the file, frame by frame: it is never in memory as a whole.
///
/// # Errors
/// If `out` cannot be written.
pub(crate) fn write(out: &mut dyn Write, coco: &Coco<'_>) -> io::Result<()> {
    let ids = coco.categories.iter().zip(1..).map(|(name, id)| (name.as_str(), id)).collect();
    let licences = licences(coco.attributions);
    let file = File {
        info: Info { description: coco.description, version: coco.version },
        licenses: List(|| licences.iter().map(|(name, id)| License { id: *id, name, url: Licence::read(name).url() })),
        assets: List(|| coco.attributions.iter().map(|model| Asset::of(model, &licences))),
        categories: List(|| categories(coco.categories)),
        images: List(|| coco.images().map(|(image, _, _)| image)),
        annotations: List(|| coco.annotations(&ids, &licences)),
    };
    serde_json::to_writer(&mut *out, &file)?;
    out.write_all(b"\n")
}

impl<'a> Coco<'a> {
    /// Every image of this view in this split, with its frame: one for each look.
    fn images(&self) -> impl Iterator<Item = (Image<'a>, &'a FrameRecord, &'a ViewRecord)> + use<'a> {
        let (view, split) = (self.view, self.split);
        let frames = self.frames.values().filter(move |frame| frame.split == split);
        let seen = frames.filter_map(move |frame| Some((frame, frame.views.get(&view)?)));
        seen.flat_map(move |(frame, record)| {
            let looks = frame.looks.len().max(1) as u64;
            frame.each_look().zip(0..).map(move |(look, number)| {
                let image = Image {
                    id: frame.id * looks + number + 1,
                    file_name: layout::image(view, &frame.name, look),
                    width: record.width,
                    height: record.height,
                    variant: frame.variant.as_deref(),
                    scene: frame.scene,
                    frame: frame.frame,
                    look,
                };
                (image, frame, record)
            })
        })
    }

    /// The annotations of [`Self::images`], numbered from 1. Looks of a frame have the same ones.
    fn annotations(
        &self,
        ids: &BTreeMap<&str, u64>,
        licences: &BTreeMap<&str, u64>,
    ) -> impl Iterator<Item = Annotation<'a>> {
        let of_asset: BTreeMap<&str, u64> =
            self.attributions.iter().map(|model| (model.uid.as_str(), licences[model.licence.as_str()])).collect();
        let all =
            self.images().flat_map(|(image, _, record)| record.annotations.iter().map(move |a| (image.id, record, a)));
        all.zip(1..).map(move |((image_id, record, annotation), id)| Annotation {
            id,
            image_id,
            category_id: *ids.get(annotation.label.as_str()).expect("labels are checked before anything is exported"),
            bbox: annotation.bbox,
            area: annotation.area,
            segmentation: Segmentation { size: [record.height, record.width], counts: &annotation.rle },
            iscrowd: 0,
            instance: annotation.body,
            asset: &annotation.asset,
            license: of_asset.get(annotation.asset.as_str()).copied(),
        })
    }
}

#[derive(Serialize)]
struct File<'a, L: Serialize, M: Serialize, C: Serialize, I: Serialize, A: Serialize> {
    info: Info<'a>,
    licenses: L,
    assets: M,
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
struct License<'a> {
    id: u64,
    name: &'a str,
    url: String,
}

/// A model in the scenes: whose it is, and under which of the licences.
#[derive(Serialize)]
struct Asset<'a> {
    /// As annotations call it.
    asset: &'a str,
    name: &'a str,
    license: u64,
    attribution: &'a str,
    source: &'a str,
}

impl<'a> Asset<'a> {
    fn of(model: &'a Attribution, licences: &BTreeMap<&str, u64>) -> Self {
        let Attribution { uid, name, attribution, licence, source } = model;
        Self { asset: uid, name, license: licences[licence.as_str()], attribution, source }
    }
}

/// Numbers of all licences, from 1.
fn licences(attributions: &[Attribution]) -> BTreeMap<&str, u64> {
    let mut names: Vec<&str> = attributions.iter().map(|model| model.licence.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names.into_iter().zip(1..).collect()
}

#[derive(Serialize)]
struct Category<'a> {
    id: u64,
    name: &'a str,
    supercategory: &'a str,
}

#[derive(Serialize)]
struct Image<'a> {
    id: u64,
    file_name: String,
    width: u32,
    height: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    variant: Option<&'a str>,
    scene: u64,
    frame: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    look: Option<&'a str>,
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
    /// Licence of the asset; nothing for parts of an environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    license: Option<u64>,
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
