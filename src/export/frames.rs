//! `frames.csv`: one row a frame, in job order.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};

use serde_json::Value;

use crate::label::View;
use crate::store::{FrameRecord, layout};

/// Columns that every dataset has.
const FIXED: [&str; 13] = [
    "id",
    "name",
    "split",
    "scene",
    "frame",
    "x_m",
    "y_m",
    "z_m",
    "yaw_deg",
    "pitch_deg",
    "roll_deg",
    "time_s",
    "moved_m",
];

/// Where the column `variant` goes in the tables of swept recipes: behind the split.
const VARIANT_COLUMN: usize = 3;

/// Writes the table: the fixed columns, the drawn values that any frame has (sorted by path), then for each view the
/// number of annotations and the hash of the image, of each look's image where there are several.
///
/// # Errors
/// If `out` cannot be written.
pub(crate) fn write(out: &mut dyn Write, frames: &BTreeMap<u64, FrameRecord>, views: &[View]) -> io::Result<()> {
    let drawn: BTreeSet<&str> = frames.values().flat_map(|frame| frame.values.keys().map(String::as_str)).collect();
    let varied = frames.values().any(|frame| frame.variant.is_some());
    let looks: BTreeSet<Option<&str>> = frames.values().flat_map(FrameRecord::each_look).collect();
    let mut table = csv::Writer::from_writer(out);
    let mut header: Vec<String> = FIXED.iter().chain(&drawn).map(ToString::to_string).collect();
    if varied {
        header.insert(VARIANT_COLUMN, "variant".to_owned());
    }
    for view in views.iter().map(|view| view.name()) {
        header.push(format!("annotations_{view}"));
        header.extend(looks.iter().map(|look| match look {
            Some(look) => format!("image_{view}_{look}_sha256"),
            None => format!("image_{view}_sha256"),
        }));
    }
    table.write_record(&header)?;
    for frame in frames.values() {
        let mut row = row(frame, &drawn, views, &looks);
        if varied {
            row.insert(VARIANT_COLUMN, frame.variant.clone().unwrap_or_default());
        }
        table.write_record(row)?;
    }
    table.flush()
}

fn row(frame: &FrameRecord, drawn: &BTreeSet<&str>, views: &[View], looks: &BTreeSet<Option<&str>>) -> Vec<String> {
    let mut row = vec![
        frame.id.to_string(),
        frame.name.clone(),
        frame.split.clone(),
        frame.scene.to_string(),
        frame.frame.to_string(),
    ];
    row.extend(frame.pose.iter().chain([&frame.time_s, &frame.moved_m]).map(|&number| cell(&Value::from(number))));
    row.extend(drawn.iter().map(|&path| frame.values.get(path).map(cell).unwrap_or_default()));
    for &view in views {
        let annotations = frame.views.get(&view).map(|record| record.annotations.len().to_string());
        row.push(annotations.unwrap_or_default());
        row.extend(looks.iter().map(|&look| {
            let image = frame.file(&layout::image(view, &frame.name, look));
            image.map(|file| file.sha256.clone()).unwrap_or_default()
        }));
    }
    row
}

/// Text as it is, nothing for null, JSON for all else: numbers in the fewest digits that read back the same.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
