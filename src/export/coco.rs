//! COCO annotation files: one for each view and split, masks as compressed run lengths.
//!
//! Beyond the format's own keys, images name their `variant`, `scene`, `frame` and `look`, and annotations their `instance` (the value in the
//! mask image), `asset` and the `license` of that; `assets` tells whose each is. No dates, so that equal datasets have equal files.
//! Source: COCO data format, <https://cocodataset.org/#format-data>.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::Serialize;

use super::Attribution;
use crate::catalog::Licence;
use crate::label::View;
use crate::store::{Dataset, ViewRecord, layout};

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
    /// All frames; those of other splits are left out here.
    pub dataset: &'a Dataset,
}

/// Writes the file, frame by frame: it is never in memory as a whole.
///
/// # Errors
/// If `out` cannot be written or a record not be read.
pub(crate) fn write(out: &mut dyn Write, coco: &Coco<'_>) -> io::Result<()> {
    let info = Info { description: coco.description, version: coco.version };
    out.write_all(b"{\"info\":")?;
    serde_json::to_writer(&mut *out, &info)?;
    let licences = licences(coco.attributions);
    let listed = licences.iter().map(|(name, id)| License { id: *id, name, url: Licence::read(name).url() });
    out.write_all(b",\"licenses\":")?;
    serde_json::to_writer(&mut *out, &listed.collect::<Vec<_>>())?;
    let assets = coco.attributions.iter().map(|model| Asset::of(model, &licences));
    out.write_all(b",\"assets\":")?;
    serde_json::to_writer(&mut *out, &assets.collect::<Vec<_>>())?;
    out.write_all(b",\"categories\":")?;
    serde_json::to_writer(&mut *out, &categories(coco.categories).collect::<Vec<_>>())?;
    let mut images = List::begin(out, "images")?;
    coco.each_image(&mut |image, _| images.item(&image))?;
    let mut annotations = List::begin(images.end()?, "annotations")?;
    let ids: BTreeMap<&str, u64> = coco.categories.iter().zip(1..).map(|(name, id)| (name.as_str(), id)).collect();
    let of_asset: BTreeMap<&str, u64> =
        coco.attributions.iter().map(|model| (model.uid.as_str(), licences[model.licence.as_str()])).collect();
    let mut id = 0;
    // Looks of a frame have the same annotations.
    coco.each_image(&mut |image, record| {
        record.annotations.iter().try_for_each(|annotation| {
            id += 1;
            annotations.item(&Annotation {
                id,
                image_id: image.id,
                category_id: *ids
                    .get(annotation.label.as_str())
                    .expect("labels are checked before anything is exported"),
                bbox: annotation.bbox,
                area: annotation.area,
                segmentation: Segmentation { size: [record.height, record.width], counts: &annotation.rle },
                iscrowd: 0,
                instance: annotation.body,
                asset: &annotation.asset,
                license: of_asset.get(annotation.asset.as_str()).copied(),
            })
        })
    })?;
    annotations.end()?.write_all(b"}\n")
}

/// A function that is called with each image and what is seen in it.
type Each<'a> = &'a mut dyn FnMut(Image<'_>, &ViewRecord) -> io::Result<()>;

impl Coco<'_> {
    /// Calls `each` with every image of this view in this split: one for each look.
    fn each_image(&self, each: Each<'_>) -> io::Result<()> {
        for frame in self.dataset.records() {
            let frame = frame.map_err(io::Error::other)?;
            let Some(record) = frame.views.get(&self.view).filter(|_| frame.split == self.split) else { continue };
            let looks = frame.looks.len().max(1) as u64;
            for (look, number) in frame.each_look().zip(0..) {
                let image = Image {
                    id: frame.id * looks + number + 1,
                    file_name: layout::image(self.view, &frame.name, look),
                    width: record.width,
                    height: record.height,
                    variant: frame.variant.as_deref(),
                    scene: frame.scene,
                    frame: frame.frame,
                    look,
                };
                each(image, record)?;
            }
        }
        Ok(())
    }
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

/// A list of a JSON object, written item by item.
struct List<'a> {
    out: &'a mut dyn Write,
    is_first: bool,
}

impl<'a> List<'a> {
    fn begin(out: &'a mut dyn Write, name: &str) -> io::Result<Self> {
        write!(out, ",\"{name}\":[")?;
        Ok(Self { out, is_first: true })
    }

    fn item(&mut self, item: &impl Serialize) -> io::Result<()> {
        if !std::mem::take(&mut self.is_first) {
            self.out.write_all(b",")?;
        }
        Ok(serde_json::to_writer(&mut *self.out, item)?)
    }

    fn end(self) -> io::Result<&'a mut dyn Write> {
        self.out.write_all(b"]")?;
        Ok(self.out)
    }
}

fn categories(labels: &[String]) -> impl Iterator<Item = Category<'_>> {
    labels.iter().zip(1..).map(|(name, id)| Category { id, name, supercategory: "object" })
}
