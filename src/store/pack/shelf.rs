//! Where blocks lie now: in the parts that the journals tell, or in tar files, whose headers are read.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};

use super::super::atomic::sha256;
use super::super::{Place, StoreError, layout};
use super::Block;
use super::block::{PIECE, member, padded};

/// Where a block lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Spot {
    /// Number of the part; none for the tar itself.
    pub part: Option<u32>,
    pub offset: u64,
    pub length: u64,
}

/// What was seen of the tar files and parts of a dataset.
#[derive(Debug)]
pub(crate) struct Shelf {
    root: PathBuf,
    tars: BTreeMap<String, Tar>,
}

#[derive(Debug)]
struct Tar {
    /// Frame, offset and length of each block, sorted.
    blocks: Vec<(u64, u64, u64)>,
    /// Lengths of the parts that were asked for.
    parts: BTreeMap<u32, u64>,
}

impl Spot {
    /// The file, relative to the dataset folder.
    pub fn path(&self, tar: &str) -> String {
        self.part.map_or_else(|| tar.to_owned(), |number| layout::part(tar, number))
    }

    /// Reads the block.
    pub fn read(&self, root: &Path, tar: &str) -> io::Result<Vec<u8>> {
        Place { path: root.join(self.path(tar)), stretch: Some((self.offset, self.length)) }.read()
    }
}

impl Shelf {
    /// Nothing seen yet.
    pub fn new(root: &Path) -> Self {
        Self { root: root.to_path_buf(), tars: BTreeMap::new() }
    }

    /// Where the block of a frame is; none if it is gone, cut off or its first or last header is harmed. A tar that cannot be
    /// read is an error.
    pub fn find(&mut self, id: u64, block: &Block) -> Result<Option<Spot>, StoreError> {
        if !self.tars.contains_key(&block.tar) {
            let path = self.root.join(&block.tar);
            let blocks = match blocks(&path) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
                result => result.map_err(StoreError::io("read", &path))?,
            };
            self.tars.insert(block.tar.clone(), Tar { blocks, parts: BTreeMap::new() });
        }
        let tar = self.tars.get_mut(&block.tar).expect("just looked at");
        let length = tar.parts.entry(block.part).or_insert_with(|| {
            fs::metadata(self.root.join(layout::part(&block.tar, block.part))).map_or(0, |data| data.len())
        });
        if block.offset + block.length <= *length {
            return Ok(Some(Spot { part: Some(block.part), offset: block.offset, length: block.length }));
        }
        let place = tar.blocks.binary_search_by_key(&id, |&(id, _, _)| id).ok();
        let there = place.map(|place| tar.blocks[place]).filter(|&(_, _, length)| length == block.length);
        Ok(there.map(|(_, offset, length)| Spot { part: None, offset, length }))
    }

    /// Whether a block has the bytes that it should have.
    pub fn is_right(&self, spot: Spot, block: &Block) -> bool {
        spot.read(&self.root, &block.tar).is_ok_and(|bytes| sha256(&bytes) == block.sha256)
    }
}

/// Blocks of a tar file. A harmed header is passed over piece by piece, so that it hides no other frame than its own.
fn blocks(path: &Path) -> io::Result<Vec<(u64, u64, u64)>> {
    let mut file = File::open(path)?;
    let end = file.metadata()?.len();
    let (mut blocks, mut at) = (Vec::<(u64, u64, u64)>::new(), 0);
    let mut piece = [0; PIECE];
    while at + PIECE as u64 <= end {
        file.seek(SeekFrom::Start(at))?;
        file.read_exact(&mut piece)?;
        let next = at + PIECE as u64;
        let Some((id, length)) = member(&piece) else {
            at = next;
            continue;
        };
        let next = next + padded(length);
        if next > end {
            break;
        }
        match blocks.last_mut() {
            Some((last, offset, length)) if *last == id => *length = next - *offset,
            _ => blocks.push((id, at, next - at)),
        }
        at = next;
    }
    blocks.sort_unstable();
    Ok(blocks)
}

#[cfg(test)]
mod tests {
    use super::super::super::sample::frame;
    use super::super::block::{END, build};
    use super::*;

    #[test]
    fn harm_to_a_tar_hides_only_its_own_frame() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tar");
        let (mut bytes, mut expected) = (Vec::new(), Vec::new());
        for id in [0, 1, 4] {
            let (record, files) = frame(id);
            let block = build(&record, &files).unwrap();
            expected.push((id, bytes.len() as u64, block.len() as u64));
            bytes.extend(block);
        }
        bytes.extend(END);
        fs::write(&path, &bytes).unwrap();
        assert_eq!(blocks(&path).unwrap(), expected);
        for at in (0..bytes.len()).step_by(97) {
            let mut changed = bytes.clone();
            changed[at] ^= 1;
            fs::write(&path, &changed).unwrap();
            let found = blocks(&path).unwrap();
            let others =
                expected.iter().filter(|(_, offset, length)| !(*offset..offset + length).contains(&(at as u64)));
            others.for_each(|block| assert!(found.contains(block), "byte {at}: {found:?}"));
        }
        fs::write(&path, &bytes[..expected[2].1 as usize + 600]).unwrap();
        assert_eq!(blocks(&path).unwrap()[..2], expected[..2]);
        assert!(blocks(&path).unwrap().get(2).is_none_or(|cut| cut.2 < expected[2].2));
    }
}
