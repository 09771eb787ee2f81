//! `frames.csv`: one row a frame, in job order.

use std::collections::BTreeSet;
use std::io::{self, Write};

use serde_json::Value;

use crate::label::View;
use crate::store::{Dataset, FrameRecord, layout};

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

/// Columns of the table: the fixed ones, the drawn values that any frame has (sorted by path), then for each view the
/// number of annotations and the hash of the image, of each look's image where there are several.
#[derive(Debug, Default)]
pub(crate) struct Table {
    drawn: BTreeSet<String>,
    looks: BTreeSet<Option<String>>,
    is_varied: bool,
}

impl Table {
    /// Makes room for a frame's values.
    pub fn columns_of(&mut self, frame: &FrameRecord) {
        for path in frame.values.keys().filter(|&path| !self.drawn.contains(path)).collect::<Vec<_>>() {
            self.drawn.insert(path.clone());
        }
        self.looks.extend(frame.each_look().map(|look| look.map(str::to_owned)));
        self.is_varied |= frame.variant.is_some();
    }

    /// Writes the table; all frames' columns are known.
    ///
    /// # Errors
    /// If `out` cannot be written or a record not be read.
    pub fn write(&self, out: &mut dyn Write, dataset: &Dataset, views: &[View]) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        let mut header: Vec<String> = FIXED.iter().map(ToString::to_string).collect();
        header.extend(self.drawn.iter().cloned());
        if self.is_varied {
            header.insert(VARIANT_COLUMN, "variant".to_owned());
        }
        for view in views.iter().map(|view| view.name()) {
            header.push(format!("annotations_{view}"));
            header.extend(self.looks.iter().map(|look| match look {
                Some(look) => format!("image_{view}_{look}_sha256"),
                None => format!("image_{view}_sha256"),
            }));
        }
        table.write_record(&header)?;
        for frame in dataset.records() {
            let frame = frame.map_err(io::Error::other)?;
            let mut row = self.row(&frame, views);
            if self.is_varied {
                row.insert(VARIANT_COLUMN, frame.variant.unwrap_or_default());
            }
            table.write_record(row)?;
        }
        table.flush()
    }

    fn row(&self, frame: &FrameRecord, views: &[View]) -> Vec<String> {
        let mut row = vec![
            frame.id.to_string(),
            frame.name.clone(),
            frame.split.clone(),
            frame.scene.to_string(),
            frame.frame.to_string(),
        ];
        row.extend(frame.pose.iter().chain([&frame.time_s, &frame.moved_m]).map(|&number| cell(&Value::from(number))));
        row.extend(self.drawn.iter().map(|path| frame.values.get(path).map(cell).unwrap_or_default()));
        for &view in views {
            let annotations = frame.views.get(&view).map(|record| record.annotations.len().to_string());
            row.push(annotations.unwrap_or_default());
            row.extend(self.looks.iter().map(|look| {
                let image = frame.file(&layout::image(view, &frame.name, look.as_deref()));
                image.map(|file| file.sha256.clone()).unwrap_or_default()
            }));
        }
        row
    }
}

/// Text as it is, nothing for null, JSON for all else: numbers in the fewest digits that read back the same.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
