//! Two datasets side by side: which frames, which drawn values, which bytes differ.

use std::iter::Peekable;

use serde::Serialize;
use serde_json::Value;

use super::{Dataset, FrameRecord, Records, StoreError, difference};

/// How two datasets differ.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Comparison {
    /// Frames of both that are the same, to the last bit of every file.
    pub same: u64,
    /// Frames that differ, by id.
    pub different: Vec<FrameDifference>,
    /// Frames that only the first has.
    pub only_first: Vec<u64>,
    /// Frames that only the second has.
    pub only_second: Vec<u64>,
}

/// How a frame differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FrameDifference {
    /// The frame.
    pub id: u64,
    /// The first few drawn values and other facts that differ, `path: first → second`.
    pub values: Vec<String>,
    /// Files with other bytes, or that only one has.
    pub files: Vec<String>,
}

impl Comparison {
    /// Whether nothing differs.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.different.is_empty() && self.only_first.is_empty() && self.only_second.is_empty()
    }
}

/// Compares the frames of two datasets by their records.
///
/// # Errors
/// [`StoreError`] if a journal cannot be read.
pub fn compare(first: &Dataset, second: &Dataset) -> Result<Comparison, StoreError> {
    let (mut a, mut b) = (first.records().peekable(), second.records().peekable());
    let mut comparison = Comparison::default();
    loop {
        match (id_of(&mut a)?, id_of(&mut b)?) {
            (None, None) => return Ok(comparison),
            (Some(id), other) if other.is_none_or(|other| id < other) => {
                comparison.only_first.push(id);
                a.next();
            }
            (other, Some(id)) if other.is_none_or(|other| id < other) => {
                comparison.only_second.push(id);
                b.next();
            }
            _ => {
                let (Some(one), Some(two)) = (a.next().transpose()?, b.next().transpose()?) else { continue };
                match frame(&one, &two) {
                    Some(difference) => comparison.different.push(difference),
                    None => comparison.same += 1,
                }
            }
        }
    }
}

/// Id of the next record.
fn id_of(records: &mut Peekable<Records<'_, FrameRecord>>) -> Result<Option<u64>, StoreError> {
    match records.peek() {
        Some(Ok(record)) => Ok(Some(record.id)),
        Some(Err(_)) => records.next().transpose().map(|record| record.map(|record| record.id)),
        None => Ok(None),
    }
}

fn frame(one: &FrameRecord, two: &FrameRecord) -> Option<FrameDifference> {
    if one == two {
        return None;
    }
    let mut files: Vec<String> = Vec::new();
    for (these, those) in [(one, two), (two, one)] {
        let differs = |path: &str, sha256: &str| those.file(path).is_none_or(|file| file.sha256 != sha256);
        files.extend(these.files.iter().filter(|f| differs(&f.path, &f.sha256)).map(|file| file.path.clone()));
    }
    files.sort();
    files.dedup();
    let facts = |record: &FrameRecord| {
        let record = FrameRecord { files: Vec::new(), ..record.clone() };
        serde_json::to_value(record).unwrap_or(Value::Null)
    };
    Some(FrameDifference { id: one.id, values: difference::of_values(&facts(one), &facts(two)), files })
}

#[cfg(test)]
mod tests {
    use super::super::sample::{IDENTITY, frame};
    use super::super::{Shard, Store};
    use super::*;

    #[test]
    fn frames_values_and_bytes_are_told_apart() {
        let [a, b] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let [one, two] = [&a, &b].map(|folder| Store::open(folder.path(), &IDENTITY, Shard::WHOLE).unwrap());
        for id in [0, 1, 2, 3] {
            let (record, files) = frame(id);
            one.commit(record, &files).unwrap();
        }
        for id in [1, 2, 3, 5] {
            let (mut record, mut files) = frame(id);
            if id == 2 {
                files[1].bytes.push(0);
            }
            if id == 3 {
                record.values.insert("water.temperature_c".into(), serde_json::json!(9));
            }
            two.commit(record, &files).unwrap();
        }
        let comparison = compare(&one.dataset(), &two.dataset()).unwrap();
        assert_eq!((comparison.same, &comparison.only_first[..], &comparison.only_second[..]), (1, &[0][..], &[5][..]));
        let [bytes, value] = &comparison.different[..] else { panic!("{comparison:?}") };
        assert_eq!((bytes.id, &bytes.files[..]), (2, &["masks/polar/000002.png".to_owned()][..]));
        assert_eq!(value.values, ["values.water.temperature_c: 5.0 → 9"]);
        assert!(compare(&one.dataset(), &one.dataset()).unwrap().is_same());
    }
}
