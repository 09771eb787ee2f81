//! Reading the index of a large collection: the terms are held, everything else is read by its place.

use std::fs::File;
use std::io::{Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::{FILE, HEADER, MAGIC, MARK, Record, take_number};
use crate::catalog::asset::Asset;
use crate::catalog::error::CatalogError;
use crate::catalog::search::{Posting, Terms};

/// An index on disk.
#[derive(Debug)]
pub struct DiskIndex {
    path: PathBuf,
    root: PathBuf,
    file: Mutex<File>,
    models: u32,
    /// Places of records, places, postings, terms, marks and the end.
    sections: [u64; 6],
    terms: Vec<u8>,
    marks: Vec<Mark>,
}

/// A term's place among the terms, and that of its postings.
#[derive(Clone, Copy, Debug)]
struct Mark {
    term: usize,
    postings: u64,
}

/// A term while the terms are gone through.
struct Entry<'a> {
    text: &'a str,
    count: u64,
    postings: u64,
    bytes: u64,
}

impl DiskIndex {
    /// Whether a folder has one.
    #[must_use]
    pub fn is_in(dir: &Path) -> bool {
        dir.join(FILE).is_file()
    }

    /// Opens the index of a folder whose models are below `root`.
    ///
    /// # Errors
    /// If it is missing, broken or of another version of the program.
    pub fn open(dir: &Path, root: &Path) -> Result<Self, CatalogError> {
        let path = dir.join(FILE);
        let fault = |problem: &str| CatalogError::File {
            path: path.clone(),
            problem: format!("{problem}; make it again with `ensonify catalog index`"),
        };
        let mut file = File::open(&path).map_err(|e| fault(&format!("cannot be read: {e}")))?;
        let length = file.metadata().map_err(|e| fault(&e.to_string()))?.len();
        let mut header = [0; HEADER];
        file.read_exact(&mut header).map_err(|_| fault("is cut off"))?;
        if !header.starts_with(MAGIC) {
            return Err(fault("is no index of this version"));
        }
        let number = |at: usize| u64::from_le_bytes(std::array::from_fn(|k| header[at + k]));
        let models = u32::from_le_bytes(std::array::from_fn(|k| header[8 + k]));
        let sections: [u64; 6] = std::array::from_fn(|k| number(16 + 8 * k));
        let sound = sections.is_sorted() && sections[5] == length && sections[0] == HEADER as u64;
        if !sound || sections[2] - sections[1] != 8 * (u64::from(models) + 1) {
            return Err(fault("is broken"));
        }
        let mut index = Self {
            root: root.to_path_buf(),
            file: Mutex::new(file),
            models,
            sections,
            terms: Vec::new(),
            marks: Vec::new(),
            path: path.clone(),
        };
        index.terms = index.bytes(sections[3], sections[4] - sections[3])?;
        let marks = index.bytes(sections[4], sections[5] - sections[4])?;
        let word = |bytes: &[u8]| u64::from_le_bytes(std::array::from_fn(|k| bytes[k]));
        index.marks = marks
            .chunks_exact(16)
            .map(|mark| Mark { term: word(&mark[..8]) as usize, postings: word(&mark[8..]) })
            .collect();
        Ok(index)
    }

    /// How many models there are.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.models
    }

    /// The model of a number.
    ///
    /// # Errors
    /// If the index is broken or the model's path leaves the collection.
    pub fn asset(&self, number: u32) -> Result<Asset, CatalogError> {
        self.record(number)?.asset(&self.root, &self.path)
    }

    /// What is kept of the model of a number.
    ///
    /// # Errors
    /// If the index is broken.
    pub fn record(&self, number: u32) -> Result<Record, CatalogError> {
        if number >= self.models {
            return Err(self.broken());
        }
        let places = self.bytes(self.sections[1] + 8 * u64::from(number), 16)?;
        let place = |at: usize| u64::from_le_bytes(std::array::from_fn(|k| places[at + k]));
        let (start, end) = (place(0), place(8));
        if start < self.sections[0] || end < start || end > self.sections[1] {
            return Err(self.broken());
        }
        Record::decoded(&self.bytes(start, end - start)?).ok_or_else(|| self.broken())
    }

    /// The number of the model of that uid.
    ///
    /// # Errors
    /// If the index is broken.
    pub fn number(&self, uid: &str) -> Result<Option<u32>, CatalogError> {
        let (mut low, mut high) = (0, self.models);
        while low < high {
            let middle = low + (high - low) / 2;
            match self.record(middle)?.uid.as_str().cmp(uid) {
                std::cmp::Ordering::Equal => return Ok(Some(middle)),
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Greater => high = middle,
            }
        }
        Ok(None)
    }

    fn bytes(&self, at: u64, count: u64) -> Result<Vec<u8>, CatalogError> {
        // Whatever the file says, no more is taken than it has.
        if at.checked_add(count).is_none_or(|end| end > self.sections[5]) {
            return Err(self.broken());
        }
        let mut bytes = vec![0; count as usize];
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let read = file.seek(SeekFrom::Start(at)).and_then(|_| file.read_exact(&mut bytes));
        read.map(|()| bytes).map_err(|_| self.broken())
    }

    fn broken(&self) -> CatalogError {
        let problem = "is broken; make it again with `ensonify catalog index`".into();
        CatalogError::File { path: self.path.clone(), problem }
    }

    /// The terms from a mark on; they end where the file is broken.
    fn entries_at(&self, mark: usize) -> impl Iterator<Item = Entry<'_>> {
        let start = self.marks.get(mark).copied().unwrap_or(Mark { term: self.terms.len(), postings: 0 });
        let mut rest = self.terms.get(start.term..).unwrap_or_default();
        let mut postings = start.postings;
        std::iter::from_fn(move || {
            let length = take_number(&mut rest)? as usize;
            let text = std::str::from_utf8(rest.get(..length)?).ok()?;
            rest = &rest[length..];
            let (count, bytes) = (take_number(&mut rest)?, take_number(&mut rest)?);
            let entry = Entry { text, count, postings, bytes };
            postings = postings.checked_add(bytes)?;
            Some(entry)
        })
    }

    /// The last mark whose term does not come after this one.
    fn mark_before(&self, term: &str) -> usize {
        let after = |mark: usize| self.entries_at(mark).next().is_none_or(|entry| entry.text > term);
        let (mut low, mut high) = (0, self.marks.len());
        while low < high {
            let middle = low + (high - low) / 2;
            if after(middle) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        low.saturating_sub(1)
    }
}

impl Terms for DiskIndex {
    fn models(&self) -> u32 {
        self.models
    }

    fn postings(&self, term: &str) -> Result<Vec<Posting>, CatalogError> {
        let entries = self.entries_at(self.mark_before(term)).take(MARK + 1);
        let Some(entry) = entries.take_while(|entry| entry.text <= term).find(|entry| entry.text == term) else {
            return Ok(Vec::new());
        };
        let bytes = self.bytes(self.sections[2].saturating_add(entry.postings), entry.bytes)?;
        let mut rest = bytes.as_slice();
        let mut model = 0;
        let mut postings = Vec::with_capacity(entry.count.min(entry.bytes) as usize);
        for _ in 0..entry.count {
            let step = take_number(&mut rest).ok_or_else(|| self.broken())?;
            let (&weight, after) = rest.split_first().ok_or_else(|| self.broken())?;
            rest = after;
            model += step;
            if model >= u64::from(self.models) {
                return Err(self.broken());
            }
            postings.push(Posting { model: model as u32, weight });
        }
        Ok(postings)
    }

    fn beginning_with(&self, letter: char) -> Vec<&str> {
        let first = String::from(letter);
        let entries = self.entries_at(self.mark_before(&first)).map(|entry| entry.text);
        entries.skip_while(|text| *text < first.as_str()).take_while(|text| text.starts_with(letter)).collect()
    }
}
