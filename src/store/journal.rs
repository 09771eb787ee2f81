//! The journal of finished frames: one JSON line each, with a checksum of itself.
//!
//! `{"check":"<16 hex digits>","frame":{…}}`, where `check` begins the SHA-256 of the bytes of the frame's object. Lines
//! that do not fulfil it (torn by a crash, damaged) count as never written.

use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use super::atomic::{self, sha256};
use super::{FrameRecord, StoreError, layout};

/// What a journal holds.
pub(crate) struct Contents {
    /// Frames of all whole lines, in the order of writing.
    pub records: Vec<FrameRecord>,
    /// The whole lines' text, if something else was between or after them.
    pub repaired: Option<String>,
}

/// The journal of a dataset, open for writing.
#[derive(Debug)]
pub(crate) struct Journal {
    file: File,
    path: PathBuf,
    /// Bytes of whole lines.
    length: u64,
}

/// Reads the journal under `root`; changes nothing, so another process may be writing.
pub(crate) fn read(root: &Path) -> Result<Contents, StoreError> {
    let path = root.join(layout::JOURNAL);
    let bytes = match fs::read(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
        result => result.map_err(StoreError::io("read", &path))?,
    };
    let (mut records, mut good) = (Vec::new(), String::new());
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        if let Some((text, record)) = std::str::from_utf8(line).ok().and_then(|text| Some((text, parse(text)?))) {
            records.push(record);
            good.push_str(text);
        }
    }
    let repaired = (good.len() != bytes.len()).then_some(good);
    Ok(Contents { records, repaired })
}

/// The line of a record, and the record as a later reading of the line gives it.
///
/// Everything derived from a record must come from the second, so that a run that was interrupted writes the same digits
/// as one that was not, whatever rounding reading numbers does.
pub(crate) fn line(record: &FrameRecord) -> Result<(String, FrameRecord), serde_json::Error> {
    let frame = serde_json::to_string(record)?;
    let read_back = serde_json::from_str(&frame)?;
    Ok((format!("{}{}{MIDDLE}{frame}{END}", START, check(&frame)), read_back))
}

const START: &str = r#"{"check":""#;
const MIDDLE: &str = r#"","frame":"#;
const END: &str = "}\n";

fn check(frame: &str) -> String {
    let mut digits = sha256(frame.as_bytes());
    digits.truncate(16);
    digits
}

fn parse(line: &str) -> Option<FrameRecord> {
    let (digits, rest) = line.strip_prefix(START)?.split_once(MIDDLE)?;
    let frame = rest.strip_suffix(END)?;
    (digits == check(frame)).then(|| serde_json::from_str(frame).ok())?
}

impl Journal {
    /// Opens the journal under `root` after `contents` was read from it; takes damaged lines out.
    pub fn open(root: &Path, contents: &Contents) -> Result<Self, StoreError> {
        if let Some(good) = &contents.repaired {
            atomic::write(root, layout::JOURNAL, good.as_bytes())?;
        }
        let path = root.join(layout::JOURNAL);
        let file = OpenOptions::new().append(true).create(true).open(&path).map_err(StoreError::io("open", &path))?;
        let length = file.metadata().map_err(StoreError::io("read", &path))?.len();
        Ok(Self { file, path, length })
    }

    /// Adds a line in one write and syncs it.
    pub fn append(&mut self, line: &str) -> Result<(), StoreError> {
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.sync_data());
        if let Err(source) = written {
            // A half line must not spoil the next; if even this fails, the next line's checksum tells.
            let _ = self.file.set_len(self.length);
            return Err(StoreError::Io { doing: "write", path: self.path.clone(), source });
        }
        self.length += line.len() as u64;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn record(id: u64) -> FrameRecord {
        FrameRecord {
            id,
            name: layout::frame_name(id, None),
            variant: None,
            scene: 0,
            frame: id,
            split: "train".to_owned(),
            pose: [0.1 + 0.2, -1.0 / 3.0, 2.225_073_858_507_201e-308, 1e22 / 3.0, 179.999_999_999_999_97, -0.0],
            values: BTreeMap::from([("a \"b\" } , ü".to_owned(), serde_json::json!(["x", 1.0 / 49.0, 7, null]))]),
            looks: Vec::new(),
            misplaced: Vec::new(),
            views: BTreeMap::new(),
            files: Vec::new(),
        }
    }

    #[test]
    fn a_line_is_json_and_reads_back_the_same_every_time() {
        let (text, once) = line(&record(3)).unwrap();
        assert_eq!(parse(&text), Some(once.clone()));
        let (again, twice) = line(&once).unwrap();
        assert_eq!(parse(&again), Some(twice));
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["frame"]["id"], 3);
    }

    #[test]
    fn numbers_that_json_cannot_hold_are_refused() {
        let mut bad = record(0);
        bad.pose[0] = f64::NAN;
        assert!(line(&bad).is_err());
    }

    #[test]
    fn any_changed_or_missing_byte_drops_the_line() {
        let (text, _) = line(&record(1)).unwrap();
        for at in (0..text.len()).filter(|&at| text.is_char_boundary(at)) {
            assert_eq!(parse(&text[..at]), None, "cut at {at}");
        }
        for at in (0..text.len()).filter(|&at| text.as_bytes()[at].is_ascii_digit()) {
            let other = if text.as_bytes()[at] == b'7' { "8" } else { "7" };
            assert_eq!(parse(&format!("{}{other}{}", &text[..at], &text[at + 1..])), None, "changed at {at}");
        }
    }
}
