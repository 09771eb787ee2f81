//! The members of one frame, as they stand in a tar file.

use serde::{Deserialize, Serialize};
use tar::{EntryType, Header};

use super::super::atomic::sha256;
use super::super::{FileRecord, FrameRecord, NewFile, layout};

/// Tar files are made of pieces of this length.
pub(super) const PIECE: usize = 512;
/// What ends a tar file: two pieces of zeros.
pub(super) const END: [u8; 2 * PIECE] = [0; 2 * PIECE];
/// The time of every member: 1980, since some programs doubt 1970.
const TIME: u64 = 315_532_800;

/// Where a frame's members were first written, and what they are.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Block {
    /// The tar file that they belong to.
    pub tar: String,
    /// The part of it that they were written to.
    pub part: u32,
    /// Where they begin there.
    pub offset: u64,
    /// Their length, headers included.
    pub length: u64,
    /// SHA-256 of all this.
    pub sha256: String,
}

/// The bytes of a frame's block: its files in their order, then its record as JSON. A name that is too long is an error.
pub(super) fn build(record: &FrameRecord, files: &[NewFile]) -> Result<Vec<u8>, String> {
    let mut block = Vec::new();
    for file in files {
        put(&mut block, &layout::member(&record.name, &file.path), &file.bytes)?;
    }
    put(&mut block, &layout::record_member(&record.name), &sample(record)?)?;
    Ok(block)
}

/// What a training pipeline wants of a record: all but the files, which lie beside it.
fn sample(record: &FrameRecord) -> Result<Vec<u8>, String> {
    let mut value = serde_json::to_value(record).map_err(|error| error.to_string())?;
    if let Some(fields) = value.as_object_mut() {
        fields.remove("files");
    }
    let mut text = serde_json::to_vec(&value).map_err(|error| error.to_string())?;
    text.push(b'\n');
    Ok(text)
}

fn put(block: &mut Vec<u8>, name: &str, bytes: &[u8]) -> Result<(), String> {
    block.extend_from_slice(header(name, bytes.len() as u64)?.as_bytes());
    block.extend_from_slice(bytes);
    block.resize(block.len().next_multiple_of(PIECE), 0);
    Ok(())
}

fn header(name: &str, length: u64) -> Result<Header, String> {
    let mut header = Header::new_ustar();
    header.set_path(name).map_err(|error| format!("{name} cannot stand in a tar file: {error}"))?;
    header.set_entry_type(EntryType::Regular);
    header.set_size(length);
    header.set_mode(0o644);
    header.set_uid(0);
    header.set_gid(0);
    header.set_mtime(TIME);
    header.set_cksum();
    Ok(header)
}

/// Frame and length of a member, if a piece is its header and unharmed.
pub(super) fn member(piece: &[u8; PIECE]) -> Option<(u64, u64)> {
    let header = Header::from_byte_slice(piece);
    header.as_ustar()?;
    let mut again = header.clone();
    again.set_cksum();
    if again.as_bytes() != header.as_bytes() {
        return None;
    }
    let name = header.path_bytes();
    let digits = name.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let id = std::str::from_utf8(&name[..digits]).ok()?.parse().ok()?;
    Some((id, header.entry_size().ok()?))
}

/// Length of a member's contents with the zeros after them.
pub(super) fn padded(length: u64) -> u64 {
    length.next_multiple_of(PIECE as u64)
}

/// Each file of a frame with the offset of its contents in the block.
pub(crate) fn members(files: &[FileRecord]) -> impl Iterator<Item = (&FileRecord, u64)> {
    files.iter().scan(0, |end, file| {
        let offset = *end + PIECE as u64;
        *end = offset + padded(file.bytes);
        Some((file, offset))
    })
}

/// Names of a frame's members.
pub(crate) fn member_names(frame: &str, files: &[FileRecord]) -> Vec<String> {
    let files = files.iter().map(|file| layout::member(frame, &file.path));
    files.chain([layout::record_member(frame)]).collect()
}

/// Names of the members of a block that is not what it should be that are to blame.
pub(crate) fn damaged_members(block: &[u8], frame: &str, files: &[FileRecord]) -> Vec<String> {
    let is_right = |file: &FileRecord, offset: usize| {
        let end = offset + file.bytes as usize;
        let Some(member) = block.get(offset - PIECE..padded(end as u64) as usize) else { return false };
        let (head, rest) = member.split_at(PIECE);
        let (contents, zeros) = rest.split_at(file.bytes as usize);
        header(&layout::member(frame, &file.path), file.bytes).is_ok_and(|header| header.as_bytes()[..] == *head)
            && zeros.iter().all(|&byte| byte == 0)
            && sha256(contents) == file.sha256
    };
    let wrong = members(files).filter(|&(file, offset)| !is_right(file, offset as usize));
    let names: Vec<String> = wrong.map(|(file, _)| layout::member(frame, &file.path)).collect();
    // The record's own bytes are known by the block's hash only.
    if names.is_empty() { vec![layout::record_member(frame)] } else { names }
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use super::super::super::sample::frame;
    use super::*;

    fn records(files: &[NewFile]) -> Vec<FileRecord> {
        let record = |file: &NewFile| FileRecord {
            path: file.path.clone(),
            bytes: file.bytes.len() as u64,
            sha256: sha256(&file.bytes),
        };
        files.iter().map(record).collect()
    }

    #[test]
    fn a_block_is_a_tar_with_the_frame_s_files_and_its_record() {
        let (record, files) = frame(3);
        let block = build(&record, &files).unwrap();
        assert_eq!(block, build(&record, &files).unwrap());
        let mut archive = tar::Archive::new(&block[..]);
        let read: Vec<(String, Vec<u8>)> = archive
            .entries()
            .unwrap()
            .map(|entry| {
                let mut entry = entry.unwrap();
                assert_eq!((entry.header().mtime().unwrap(), entry.header().uid().unwrap()), (TIME, 0));
                let mut bytes = Vec::new();
                entry.read_to_end(&mut bytes).unwrap();
                (entry.path().unwrap().to_string_lossy().into_owned(), bytes)
            })
            .collect();
        assert_eq!(read.len(), 5);
        for (file, (name, bytes)) in files.iter().zip(&read) {
            assert_eq!((&layout::member("000003", &file.path), &file.bytes), (name, bytes));
        }
        assert_eq!(read[4].0, "000003.json");
        let sample: serde_json::Value = serde_json::from_slice(&read[4].1).unwrap();
        assert_eq!((&sample["split"], sample.get("files")), (&"train".into(), None));
        assert_eq!(sample["views"]["fan"]["annotations"][0]["bbox"], serde_json::json!([2, 1, 2, 4]));
        for (file, offset) in members(&records(&files)) {
            let contents = &block[offset as usize..][..file.bytes as usize];
            assert_eq!(sha256(contents), file.sha256, "{}", file.path);
        }
    }

    #[test]
    fn the_member_with_a_changed_byte_is_named() {
        let (record, files) = frame(0);
        let block = build(&record, &files).unwrap();
        let records = records(&files);
        let mut begun: Vec<usize> = members(&records).map(|(_, offset)| offset as usize - PIECE).collect();
        let last = records.last().unwrap();
        begun.push(begun[3] + PIECE + padded(last.bytes) as usize);
        let names = member_names("000000", &records);
        for at in (0..block.len()).step_by(37) {
            let mut changed = block.clone();
            changed[at] ^= 4;
            let member = begun.partition_point(|&begin| begin <= at) - 1;
            assert_eq!(damaged_members(&changed, "000000", &records), [names[member].clone()], "byte {at}");
        }
    }

    #[test]
    fn a_harmed_header_is_none() {
        let piece = *header("000123_v001.polar.png", 700).unwrap().as_bytes();
        assert_eq!(member(&piece), Some((123, 700)));
        for at in 0..PIECE {
            let mut changed = piece;
            changed[at] ^= 1;
            assert_eq!(member(&changed), None, "byte {at}");
        }
        assert_eq!(member(&[0; PIECE]), None);
    }
}
