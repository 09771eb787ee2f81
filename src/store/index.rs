//! Where every finished frame's record lies in the journals: what is kept in memory of a dataset, however large.

use std::collections::{BTreeMap, BTreeSet, btree_map};
use std::fs::{self, File};
use std::io::{BufReader, Read as _};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::line::{self, Head, Outcome};
use super::pack::{Block, Shelf, Spot};
use super::{FileRecord, StoreError, damage, journal, layout};

/// The finished frames of a dataset.
#[derive(Clone, Debug, Default)]
pub(crate) struct Index {
    /// The journals, sorted by name.
    journals: Vec<PathBuf>,
    places: BTreeMap<u64, Place>,
    /// Of packed frames: number of the tar file, and where there.
    packed: BTreeMap<u64, (u32, Spot)>,
    tars: Tars,
    /// Frames that could not be rendered, and are still not there.
    failed: BTreeMap<u64, String>,
}

/// Where a line is.
#[derive(Clone, Copy, Debug)]
struct Place {
    journal: u32,
    offset: u64,
    length: u32,
}

/// Tar files that the journals tell of, numbered as they come.
#[derive(Clone, Debug, Default)]
struct Tars {
    numbers: BTreeMap<String, u32>,
    names: Vec<String>,
    /// The newest part of each.
    newest: Vec<u32>,
}

/// The part of a record that tells whether the frame is there.
#[derive(Deserialize)]
pub(crate) struct Files {
    pub name: String,
    pub files: Vec<FileRecord>,
}

impl Index {
    /// Reads all journals under `root`, the journal `ours` among them even if it is not there yet. Frames outside the
    /// plan, frames whose files are gone or cut off, and frames known to be damaged are left out; of several records of a
    /// frame the last counts. Changes nothing.
    pub fn read(root: &Path, frames: u64, ours: Option<&str>) -> Result<Self, StoreError> {
        let mut index = Self { journals: journals(root, ours)?, ..Self::default() };
        let mut unreadable = None;
        let mut reader = Reader { root, damaged: damage::frames(root)?, shelf: Shelf::new(root) };
        for number in 0..index.journals.len() {
            let path = index.journals[number].clone();
            journal::each_line(&path, |text, offset| {
                let Some((head, outcome)) = line::parse(text).filter(|(head, _)| head.id < frames) else { return };
                match outcome {
                    Outcome::Done(frame) => {
                        let tar = head.block.as_ref().map(|block| index.tars.number(block));
                        let there = reader.is_there(&head, frame).unwrap_or_else(|error| {
                            unreadable.get_or_insert(error);
                            None
                        });
                        if let Some(spot) = there {
                            // Lines are shorter than 4 GB: a record is held in memory when it is written.
                            let (journal, length) = (number as u32, text.len() as u32);
                            index.put(head.id, Place { journal, offset, length }, tar.zip(spot));
                        }
                    }
                    Outcome::Failed(reason) => {
                        index.failed.insert(head.id, reason);
                    }
                }
            })?;
        }
        // A disk that fails for a moment must not make frames count as lost: their tars would be rewritten without them.
        if let Some(error) = unreadable {
            return Err(error);
        }
        index.failed.retain(|id, _| !index.places.contains_key(id));
        Ok(index)
    }

    /// Takes a new record in, whose files are in a block or loose.
    pub fn add(&mut self, journal: &Path, id: u64, (offset, length): (u64, usize), block: Option<&Block>) {
        let journal = self.journals.iter().position(|path| path == journal).expect("the shard's own journal is listed");
        let packed = block.map(|block| {
            let spot = Spot { part: Some(block.part), offset: block.offset, length: block.length };
            (self.tars.number(block), spot)
        });
        self.put(id, Place { journal: journal as u32, offset, length: length as u32 }, packed);
        self.failed.remove(&id);
    }

    fn put(&mut self, id: u64, place: Place, packed: Option<(u32, Spot)>) {
        self.places.insert(id, place);
        match packed {
            Some(packed) => self.packed.insert(id, packed),
            None => self.packed.remove(&id),
        };
    }

    /// Takes a failure in.
    pub fn fail(&mut self, id: u64, reason: &str) {
        self.failed.insert(id, reason.to_owned());
    }

    pub fn has(&self, id: u64) -> bool {
        self.places.contains_key(&id)
    }

    /// Tar file of a frame and where it is there; none of a frame whose files are loose.
    pub fn packed(&self, id: u64) -> Option<(&str, Spot)> {
        let &(tar, spot) = self.packed.get(&id)?;
        Some((&self.tars.names[tar as usize], spot))
    }

    /// Tar files with their frames, sorted.
    pub fn tars(&self) -> BTreeMap<String, Vec<(u64, Spot)>> {
        let mut tars: BTreeMap<u32, Vec<(u64, Spot)>> = BTreeMap::new();
        for (&id, &(tar, spot)) in &self.packed {
            tars.entry(tar).or_default().push((id, spot));
        }
        tars.into_iter().map(|(tar, frames)| (self.tars.names[tar as usize].clone(), frames)).collect()
    }

    /// Number of the newest part of a tar file that a journal tells of.
    pub fn newest_part(&self, tar: &str) -> Option<u32> {
        Some(self.tars.newest[*self.tars.numbers.get(tar)? as usize])
    }

    /// Takes in where frames lie now.
    pub fn moved(&mut self, frames: &[(u64, Spot)]) {
        for &(id, spot) in frames {
            if let Some((_, there)) = self.packed.get_mut(&id) {
                *there = spot;
            }
        }
    }

    /// How many frames are finished.
    pub fn len(&self) -> u64 {
        self.places.len() as u64
    }

    /// Frames that could not be rendered, with the reason.
    pub fn failed(&self) -> &BTreeMap<u64, String> {
        &self.failed
    }

    /// Reads the records, or a part of each, one after the other in the order of their ids.
    pub fn records<T>(&self) -> Records<'_, T> {
        Records { index: self, ids: self.places.iter(), open: BTreeMap::new(), part: PhantomData }
    }
}

/// Records of finished frames, one in memory at a time.
///
/// `T` is [`FrameRecord`](super::FrameRecord), or a type with some of its fields.
pub struct Records<'a, T> {
    index: &'a Index,
    ids: btree_map::Iter<'a, u64, Place>,
    open: BTreeMap<u32, (BufReader<File>, u64)>,
    part: PhantomData<T>,
}

impl<T> Records<'_, T> {
    fn text(&mut self, place: Place) -> Result<String, StoreError> {
        let path = &self.index.journals[place.journal as usize];
        let (reader, at) = match self.open.entry(place.journal) {
            btree_map::Entry::Occupied(entry) => entry.into_mut(),
            btree_map::Entry::Vacant(entry) => {
                let file = File::open(path).map_err(StoreError::io("read", path))?;
                entry.insert((BufReader::with_capacity(1 << 18, file), 0))
            }
        };
        let mut bytes = vec![0; place.length as usize];
        // A step of the reader keeps what it has read ahead; a frame's neighbours are mostly beside it.
        let step = place.offset as i64 - *at as i64;
        let read = reader.seek_relative(step).and_then(|()| reader.read_exact(&mut bytes));
        read.map_err(StoreError::io("read", path))?;
        *at = place.offset + u64::from(place.length);
        String::from_utf8(bytes).map_err(|_| StoreError::Changed { path: path.clone() })
    }
}

impl<T: DeserializeOwned> Iterator for Records<'_, T> {
    type Item = Result<T, StoreError>;

    fn next(&mut self) -> Option<Self::Item> {
        let (_, &place) = self.ids.next()?;
        let text = match self.text(place) {
            Ok(text) => text,
            Err(error) => return Some(Err(error)),
        };
        let record = match line::head(&text) {
            Some((_, Outcome::Done(frame))) => serde_json::from_str(frame).ok(),
            _ => None,
        };
        let changed = || StoreError::Changed { path: self.index.journals[place.journal as usize].clone() };
        Some(record.ok_or_else(changed))
    }
}

impl Tars {
    fn number(&mut self, block: &Block) -> u32 {
        let number = match self.numbers.get(&block.tar) {
            Some(&number) => number,
            None => {
                let number = self.names.len() as u32;
                self.numbers.insert(block.tar.clone(), number);
                self.names.push(block.tar.clone());
                self.newest.push(block.part);
                number
            }
        };
        let newest = &mut self.newest[number as usize];
        *newest = block.part.max(*newest);
        number
    }
}

/// Tells whether frames are there.
struct Reader<'a> {
    root: &'a Path,
    damaged: BTreeSet<u64>,
    shelf: Shelf,
}

impl Reader<'_> {
    /// Whether a frame is there, and where if it is packed.
    fn is_there(&mut self, head: &Head, frame: &str) -> Result<Option<Option<Spot>>, StoreError> {
        let is_damaged = self.damaged.contains(&head.id);
        let Some(block) = &head.block else {
            return Ok((is_whole(self.root, frame) && !is_damaged).then_some(None));
        };
        let spot = self.shelf.find(head.id, block)?;
        Ok(spot.filter(|&spot| !is_damaged || self.shelf.is_right(spot, block)).map(Some))
    }
}

/// Whether a frame's files are all there with their lengths.
fn is_whole(root: &Path, frame: &str) -> bool {
    let Ok(Files { files, .. }) = serde_json::from_str(frame) else { return false };
    files
        .iter()
        .all(|file| fs::metadata(root.join(&file.path)).is_ok_and(|data| data.is_file() && data.len() == file.bytes))
}

/// The journals under `root`, sorted by name.
pub(crate) fn journals(root: &Path, ours: Option<&str>) -> Result<Vec<PathBuf>, StoreError> {
    let folder = root.join(layout::SHARDS);
    let mut paths: Vec<PathBuf> = ours.map(|name| root.join(name)).into_iter().collect();
    let entries = match fs::read_dir(&folder) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(paths),
        result => result.map_err(StoreError::io("read", &folder))?,
    };
    for entry in entries {
        let path = entry.map_err(StoreError::io("read", &folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if layout::is_journal(&name) && !paths.contains(&path) {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}
