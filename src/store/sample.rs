//! A small dataset for tests.

use std::collections::BTreeMap;

use serde_json::json;

use super::{FrameRecord, Identity, NewFile, ViewRecord, layout, png};
use crate::label::{Annotation, Rle, View, ViewLabels};
use crate::scene::Body;

/// Frames in the plan.
pub(crate) const FRAMES: u64 = 6;

/// The dataset's identity.
pub(crate) const IDENTITY: Identity<'static> = Identity {
    name: "sample",
    plan_hash: "0123abcd",
    frames: FRAMES,
    frames_a_scene: 2,
    recipe_text: Some("name: sample\n"),
    pack: None,
    sets: &[],
    includes: &[],
    plan_json: b"{\"jobs\":[]}\n",
    facts: b"{}",
};

/// A frame of 8×6 pixels in two views; every third has a tire and an anchor that overlap, others a tire or nothing.
pub(crate) fn frame(id: u64) -> (FrameRecord, Vec<NewFile>) {
    let name = layout::frame_name(id, None);
    let labels = labels(id);
    let bodies = ["tire", "anchor"].map(|label| Body {
        label: label.to_owned(),
        asset: format!("starter/{label}"),
        centre: glam::DVec3::ZERO,
        radius: 1.0,
    });
    let record = FrameRecord {
        id,
        name: name.clone(),
        variant: None,
        scene: id / 2,
        frame: id % 2,
        split: if id < 4 { "train" } else { "val" }.to_owned(),
        pose: [id as f64 / 7.0, -1.0, 2.5, 1.0 / 3.0, 0.0, -0.0],
        time_s: 0.5 * (id % 2) as f64,
        moved_m: 0.0,
        values: BTreeMap::from([
            ("water.temperature_c".to_owned(), json!(4.0 + id as f64 / 3.0)),
            ("seabed.sediment".to_owned(), json!("fine, \"sand\"")),
        ]),
        looks: Vec::new(),
        misplaced: Vec::new(),
        views: BTreeMap::from([View::Polar, View::Fan].map(|view| (view, ViewRecord::new(&labels, &bodies)))),
        files: Vec::new(),
    };
    let pixels: Vec<u8> = (0..48).map(|pixel| (pixel * 5 + id) as u8).collect();
    let files = [View::Polar, View::Fan].into_iter().flat_map(|view| {
        let image = NewFile { path: layout::image(view, &name, None), bytes: png::grey8(8, 6, &pixels) };
        [image, NewFile { path: layout::mask(view, &name), bytes: png::grey16(8, 6, &labels.mask) }]
    });
    (record, files.collect())
}

/// Two blocks of 2×4 pixels, side by side with a column in common.
fn labels(id: u64) -> ViewLabels {
    let bodies: &[u16] = [&[1, 2][..], &[1], &[]][id as usize % 3];
    let mut mask = vec![0; 48];
    let annotations = bodies.iter().map(|&body| {
        let left = u32::from(body) + 1;
        let runs = [(left * 6 + 1, 4), (left * 6 + 7, 4)];
        for pixel in runs.iter().flat_map(|&(start, length)| start..start + length) {
            mask[(pixel % 6 * 8 + pixel / 6) as usize] = body;
        }
        Annotation { body, bbox: [left, 1, 2, 4], area: 8, rle: Rle::from_runs(48, &runs) }
    });
    let annotations = annotations.collect();
    ViewLabels { width: 8, height: 6, mask, annotations }
}

/// Writes many frames at once, journalled but not synced: records as long as those of real frames, files of a few bytes.
pub(crate) fn write_many(root: &std::path::Path, frames: u64) {
    use std::fs::{self, File, create_dir_all, hard_link};
    use std::io::{BufWriter, Write as _};

    let mut journal = BufWriter::new(File::create(root.join(layout::journal(super::Shard::WHOLE))).unwrap());
    let rle = "01O1N2O0".repeat(130);
    for id in 0..frames {
        let (mut record, files) = frame(id);
        for view in record.views.values_mut() {
            let seen = view.annotations.first().cloned().unwrap_or(super::AnnotationRecord {
                body: 1,
                label: "tire".to_owned(),
                asset: "starter/tire".to_owned(),
                bbox: [2, 1, 2, 4],
                area: 8,
                rle: String::new(),
            });
            view.annotations = vec![super::AnnotationRecord { rle: rle.clone(), ..seen }; 2];
        }
        // File systems limit the links of a file.
        let source = |number: usize| root.join(format!("shards/source-{number}-{}", id / 10_000));
        for (number, file) in files.iter().enumerate() {
            if id % 10_000 == 0 {
                fs::write(source(number), &file.bytes).unwrap();
                create_dir_all(root.join(&file.path).parent().unwrap()).unwrap();
            }
            hard_link(source(number), root.join(&file.path)).unwrap();
            let bytes = fs::metadata(source(number)).unwrap().len();
            let (path, sha256) = (file.path.clone(), super::atomic::sha256(&file.bytes));
            record.files.push(super::FileRecord { path, bytes, sha256 });
        }
        journal.write_all(super::line::done(&record, None).unwrap().0.as_bytes()).unwrap();
    }
    journal.flush().unwrap();
}
