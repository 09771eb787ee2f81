//! One line of a journal: JSON with a checksum of itself, a short head for quick reading, then a frame's record or its
//! failure.
//!
//! `{"check":"<16 hex digits>","head":{…},"frame":{…}}` or `{"check":"…","head":{…},"failed":"reason"}`, where `check`
//! begins the SHA-256 of everything after it. A line that does not fulfil this (torn by a crash, damaged) counts as never
//! written. The head tells the time, so that progress can be told; no output is made from it.

use std::collections::BTreeMap;
use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use super::FrameRecord;
use super::atomic::sha256;
use super::pack::Block;
use crate::label::View;

const START: &str = r#"{"check":""#;
const HEAD: &str = r#"","head":"#;
const FRAME: &str = r#","frame":"#;
const FAILED: &str = r#","failed":"#;
const END: &str = "}\n";

/// What a line tells at a glance.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Head {
    /// Number of the job.
    pub id: u64,
    /// When it was written, seconds since 1970.
    pub at: u64,
    /// Length of the frame's files; 0 for a failure.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub bytes: u64,
    /// Split; empty for a failure.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub split: String,
    /// Annotations of each view and label.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub annotations: BTreeMap<View, BTreeMap<String, u64>>,
    /// Where the frame's files were put if they are packed; here and not in the record, which is the same for both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block: Option<Block>,
}

/// How a frame ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outcome<'a> {
    /// Its record, as JSON.
    Done(&'a str),
    /// Why there is none.
    Failed(String),
}

/// The line of a record, and the record as a later reading of the line gives it.
///
/// Everything derived from a record must come from the second, so that a run that was interrupted writes the same digits
/// as one that was not, whatever rounding reading numbers does.
pub(crate) fn done(record: &FrameRecord, block: Option<Block>) -> Result<(String, FrameRecord), serde_json::Error> {
    let frame = serde_json::to_string(record)?;
    let read_back = serde_json::from_str(&frame)?;
    let mut annotations: BTreeMap<View, BTreeMap<String, u64>> = BTreeMap::new();
    for (&view, seen) in &record.views {
        let labels = annotations.entry(view).or_default();
        seen.annotations.iter().for_each(|a| *labels.entry(a.label.clone()).or_default() += 1);
    }
    let bytes = record.files.iter().map(|file| file.bytes).sum();
    let head = Head { id: record.id, at: now(), bytes, split: record.split.clone(), annotations, block };
    Ok((line(&serde_json::to_string(&head)?, FRAME, &frame), read_back))
}

/// The line of a frame that cannot be rendered.
pub(crate) fn failed(id: u64, reason: &str) -> String {
    let head = Head { id, at: now(), bytes: 0, split: String::new(), annotations: BTreeMap::new(), block: None };
    let text = |value: Result<String, serde_json::Error>| value.expect("strings and numbers always serialise");
    line(&text(serde_json::to_string(&head)), FAILED, &text(serde_json::to_string(reason)))
}

fn line(head: &str, kind: &str, rest: &str) -> String {
    let checked = format!("{HEAD}{head}{kind}{rest}{END}");
    format!("{START}{}{checked}", check(&checked))
}

/// Head of a line without a look at its checksum; `None` if it is none.
pub(crate) fn head(line: &str) -> Option<(Head, Outcome<'_>)> {
    let (_, rest) = line.strip_prefix(START)?.split_once(HEAD)?;
    let rest = rest.strip_suffix(END)?;
    let mut reader = serde_json::Deserializer::from_str(rest).into_iter::<Head>();
    let head = reader.next()?.ok()?;
    let rest = &rest[reader.byte_offset()..];
    match rest.strip_prefix(FRAME) {
        Some(frame) => Some((head, Outcome::Done(frame))),
        None => Some((head, Outcome::Failed(serde_json::from_str(rest.strip_prefix(FAILED)?).ok()?))),
    }
}

/// A whole line; `None` if a byte of it is missing or another.
pub(crate) fn parse(line: &str) -> Option<(Head, Outcome<'_>)> {
    let (digits, _) = line.strip_prefix(START)?.split_once(HEAD)?;
    let checked = line.get(START.len() + digits.len()..)?;
    (digits == check(checked)).then(|| head(line))?
}

fn check(text: &str) -> String {
    let mut digits = sha256(text.as_bytes());
    digits.truncate(16);
    digits
}

fn now() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_zero(number: &u64) -> bool {
    *number == 0
}

#[cfg(test)]
mod tests {
    use super::super::layout;
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
            time_s: 1.0 / 3.0,
            moved_m: 0.0,
            misplaced: Vec::new(),
            values: BTreeMap::from([("a \"b\" } , ü".to_owned(), serde_json::json!(["x", 1.0 / 49.0, 7, null]))]),
            looks: Vec::new(),
            views: BTreeMap::new(),
            files: Vec::new(),
        }
    }

    fn read(line: &str) -> Option<FrameRecord> {
        match parse(line)? {
            (_, Outcome::Done(frame)) => serde_json::from_str(frame).ok(),
            (_, Outcome::Failed(_)) => None,
        }
    }

    #[test]
    fn a_line_is_json_and_reads_back_the_same_every_time() {
        let (text, once) = done(&record(3), None).unwrap();
        assert_eq!(read(&text), Some(once.clone()));
        let (again, twice) = done(&once, None).unwrap();
        assert_eq!(read(&again), Some(twice));
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!((&value["frame"]["id"], &value["head"]["id"]), (&3.into(), &3.into()));
    }

    #[test]
    fn numbers_that_json_cannot_hold_are_refused() {
        let mut bad = record(0);
        bad.pose[0] = f64::NAN;
        assert!(done(&bad, None).is_err());
    }

    #[test]
    fn a_failure_keeps_its_reason() {
        let text = failed(7, "no \"room\"\nleft");
        let (head, outcome) = parse(&text).unwrap();
        assert_eq!((head.id, outcome), (7, Outcome::Failed("no \"room\"\nleft".to_owned())));
        assert_eq!(text.lines().count(), 1);
    }

    #[test]
    fn any_changed_or_missing_byte_drops_the_line() {
        let (text, _) = done(&record(1), None).unwrap();
        for at in (0..text.len()).filter(|&at| text.is_char_boundary(at)) {
            assert_eq!(parse(&text[..at]), None, "cut at {at}");
        }
        for at in (0..text.len()).filter(|&at| text.as_bytes()[at].is_ascii_digit()) {
            let other = if text.as_bytes()[at] == b'7' { "8" } else { "7" };
            assert_eq!(parse(&format!("{}{other}{}", &text[..at], &text[at + 1..])), None, "changed at {at}");
        }
    }
}
