//! The index of a large collection: one file of records and search terms that is read where it is needed, not whole.
//!
//! Knows nothing of where the records come from. Layout, little endian, lengths and differences as LEB128:
//!
//! ```text
//! magic · counts of models and terms · places of the sections
//! records    fields of each model, 0x1F between them, sorted by uid
//! places     of each record and of the end, 8 bytes each
//! postings   of each term: step to the next model, weight
//! terms      sorted: length, text, number of postings, their bytes
//! marks      of each 256th term: its place among the terms and that of its postings, 8 bytes each
//! ```

mod read;
mod record;
mod write;

pub use read::DiskIndex;
pub use record::Record;
pub use write::Batch;
pub(crate) use write::write;

/// File name of the index.
pub(crate) const FILE: &str = "catalog.index";

const MAGIC: &[u8; 8] = b"ENSCAT01";

/// Terms between two marks.
const MARK: usize = 256;

/// Header: magic, counts, places of records, places, postings, terms, marks and the end.
const HEADER: usize = 8 + 8 + 6 * 8;

fn push_number(out: &mut Vec<u8>, mut number: u64) {
    while number >= 0x80 {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
}

/// A number at the start of the bytes, which move on behind it; none if they are cut off.
fn take_number(bytes: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for shift in (0..64).step_by(7) {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        number |= u64::from(byte & 0x7F) << shift;
        if byte < 0x80 {
            return Some(number);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::search::terms::Described;
    use crate::catalog::search::{Posting, Terms, find};

    #[test]
    fn numbers_come_back() {
        for number in [0, 1, 127, 128, 300, u64::from(u32::MAX), u64::MAX] {
            let mut bytes = Vec::new();
            push_number(&mut bytes, number);
            let mut rest = bytes.as_slice();
            assert_eq!((take_number(&mut rest), rest.len()), (Some(number), 0));
            assert_eq!(take_number(&mut &bytes[..bytes.len() - 1]), None);
        }
    }

    fn index(count: usize) -> (tempfile::TempDir, DiskIndex) {
        let folder = tempfile::tempdir().expect("a folder");
        let mut batches = vec![Batch::default(), Batch::default()];
        for number in 0..count {
            let uid = format!("{:08x}", (number * 2_654_435_761) as u32);
            let name = if number % 7 == 0 { format!("rusty anchor {number}") } else { format!("thing{number} chair") };
            let label = if number % 7 == 0 { "anchor" } else { "chair" };
            let record = Record {
                uid: uid.clone(),
                name: name.clone(),
                label: label.into(),
                path: format!("glbs/000-001/{uid}.glb"),
                source: format!("https://example.org/{uid}"),
                licence: "CC-BY-4.0".into(),
                author: "A. Person".into(),
                triangles: Some(number as u64),
                ..Record::default()
            };
            batches[number % 2].add(&record, &Described { name: &name, label, ..Described::default() });
        }
        write(folder.path(), batches).expect("written");
        let opened = DiskIndex::open(folder.path(), folder.path()).expect("sound");
        (folder, opened)
    }

    #[test]
    fn records_and_terms_come_back() {
        let (_folder, index) = index(3000);
        assert_eq!(index.count(), 3000);
        for number in [0, 1, 777, 2999] {
            let record = index.record(number).expect("readable");
            assert_eq!(index.number(&record.uid).expect("readable"), Some(number));
            assert_eq!(record.path, format!("glbs/000-001/{}.glb", record.uid));
            let made = record.triangles.expect("known");
            assert_eq!(record.uid, format!("{:08x}", (made as usize * 2_654_435_761) as u32));
        }
        assert_eq!(index.number("zz").expect("readable"), None);
        assert_eq!(index.postings("#anchor").expect("readable").len(), 3000_usize.div_ceil(7));
        assert!(index.postings("#chair").expect("readable").is_sorted());
        for number in [0, 41, 2999] {
            let term = if number % 7 == 0 { format!("{number}") } else { "thing".into() };
            assert!(!index.postings(&term).expect("readable").is_empty(), "{term}");
        }
        assert_eq!(index.postings("nothing of the kind").expect("readable"), Vec::<Posting>::new());
        assert!(index.beginning_with('r').contains(&"rusty"));
        assert_eq!(index.postings("=anchor").expect("readable").len(), 3000_usize.div_ceil(7));
        let found = find("rusty anker", &index, 5).expect("readable");
        assert_eq!(found.len(), 5);
        assert_eq!(index.record(found[0].model).expect("readable").label, "anchor");
    }

    #[test]
    fn a_broken_index_is_an_error_and_no_panic() {
        let (folder, index) = index(300);
        drop(index);
        let path = folder.path().join(FILE);
        let whole = std::fs::read(&path).expect("readable");
        let mut state = 7_u64;
        for _ in 0..300 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let mut broken = whole.clone();
            let place = (state >> 33) as usize % broken.len();
            if state & 1 == 0 {
                broken.truncate(place);
            } else {
                broken[place] ^= 0x55;
            }
            std::fs::write(&path, &broken).expect("written");
            if let Ok(index) = DiskIndex::open(folder.path(), folder.path()) {
                let _ = (index.record(3), index.number("00000000"), find("rusty anchor thing7", &index, 9));
                let _ = index.beginning_with('t');
            }
        }
    }
}
