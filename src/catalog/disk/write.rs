//! Writing the index of a large collection from batches that were made side by side.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use rayon::slice::ParallelSliceMut as _;

use super::{FILE, HEADER, MAGIC, MARK, Record, push_number};
use crate::catalog::error::CatalogError;
use crate::catalog::search::terms::{Described, TAG, label_term, terms_of, terms_of_tag};

/// Records with their terms, numbered among themselves.
#[derive(Debug, Default)]
pub struct Batch {
    records: Vec<u8>,
    /// Where each record ends, and the length of the uid that it begins with.
    ends: Vec<(usize, u16)>,
    numbers: HashMap<String, u32>,
    postings: Vec<Packed>,
    /// Terms of the tags that came before: many models share them.
    tags: HashMap<String, Vec<u32>>,
}

impl Batch {
    /// Adds a record and what it is found by.
    pub fn add(&mut self, record: &Record, described: &Described<'_>) {
        let model = self.ends.len() as u32;
        self.records.extend(record.encoded());
        self.ends.push((self.records.len(), record.uid.len() as u16));
        let first = self.postings.len();
        let label = number(&mut self.numbers, label_term(&record.label));
        self.postings.push(Packed::of(label, model, 1));
        for (term, weight) in terms_of(&Described { tags: &[], ..*described }) {
            let number = number(&mut self.numbers, term);
            self.postings.push(Packed::of(number, model, weight));
        }
        for tag in described.tags {
            if !self.tags.contains_key(tag) {
                let terms = terms_of_tag(tag).into_iter().map(|term| number(&mut self.numbers, term)).collect();
                self.tags.insert(tag.clone(), terms);
            }
            let terms = self.tags.get(tag).into_iter().flatten();
            self.postings.extend(terms.map(|&term| Packed::of(term, model, TAG)));
        }
        // Of a term that stands in several fields the greatest weight is kept.
        let own = &mut self.postings[first..];
        own.sort_unstable_by(|a, b| b.cmp(a));
        let mut kept = first;
        for at in first..self.postings.len() {
            if at == first || self.postings[at].term() != self.postings[kept - 1].term() {
                self.postings[kept] = self.postings[at];
                kept += 1;
            }
        }
        self.postings.truncate(kept);
    }

    /// Lets go of what only adding needs.
    pub fn close(&mut self) {
        self.tags = HashMap::new();
        self.records.shrink_to_fit();
        self.postings.shrink_to_fit();
    }

    /// How many records it has.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    fn record(&self, model: usize) -> &[u8] {
        let start = model.checked_sub(1).map_or(0, |before| self.ends[before].0);
        &self.records[start..self.ends[model].0]
    }

    fn uid(&self, model: usize) -> &[u8] {
        &self.record(model)[..usize::from(self.ends[model].1)]
    }
}

fn number(numbers: &mut HashMap<String, u32>, term: String) -> u32 {
    let next = numbers.len() as u32;
    *numbers.entry(term).or_insert(next)
}

/// Term, model and weight in one number that sorts in this order: 28, 28 and 8 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Packed(u64);

impl Packed {
    fn of(term: u32, model: u32, weight: u8) -> Self {
        Self(u64::from(term) << 36 | u64::from(model) << 8 | u64::from(weight))
    }

    fn term(self) -> u32 {
        (self.0 >> 36) as u32
    }

    fn model(self) -> u32 {
        (self.0 >> 8) as u32 & 0x0FFF_FFFF
    }

    fn weight(self) -> u8 {
        self.0 as u8
    }
}

/// A model that is in the index already.
const TWICE: u32 = u32::MAX;

/// Writes the index of a folder; of records with one uid the first is kept. Gives their number.
pub(crate) fn write(dir: &Path, batches: Vec<Batch>) -> Result<u32, CatalogError> {
    let path = dir.join(FILE);
    let fault =
        |e: std::io::Error| CatalogError::File { path: path.clone(), problem: format!("cannot be written: {e}") };
    let temporary = dir.join(format!("{FILE}.tmp"));
    let mut out = Sink { out: BufWriter::with_capacity(1 << 20, File::create(&temporary).map_err(fault)?), at: 0 };
    let count = write_to(&mut out, batches).map_err(fault)?;
    // Not synced: an index that a crash cut off is told of and made again.
    out.out.into_inner().map_err(|e| fault(e.into_error()))?;
    std::fs::rename(&temporary, &path).map_err(fault)?;
    Ok(count)
}

struct Sink {
    out: BufWriter<File>,
    at: u64,
}

impl Sink {
    fn put(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.at += bytes.len() as u64;
        self.out.write_all(bytes)
    }
}

fn write_to(out: &mut Sink, mut batches: Vec<Batch>) -> std::io::Result<u32> {
    out.put(&[0; HEADER])?;
    let records_at = out.at;
    // Records by uid, and where each comes to stand.
    let mut order: Vec<(u32, u32)> = (0..)
        .zip(&batches)
        .flat_map(|(batch, held)| (0..held.count() as u32).map(move |model| (batch, model)))
        .collect();
    let uid = |&(batch, model): &(u32, u32)| batches[batch as usize].uid(model as usize);
    order.par_sort_by(|a, b| uid(a).cmp(uid(b)).then(a.cmp(b)));
    order.dedup_by(|b, a| uid(a) == uid(b));
    let mut places = Vec::with_capacity(8 * (order.len() + 1));
    let mut ranks: Vec<Vec<u32>> = batches.iter().map(|batch| vec![TWICE; batch.count()]).collect();
    for (rank, &(batch, model)) in (0..).zip(&order) {
        ranks[batch as usize][model as usize] = rank;
        places.extend(out.at.to_le_bytes());
        out.put(batches[batch as usize].record(model as usize))?;
    }
    places.extend(out.at.to_le_bytes());
    let places_at = out.at;
    out.put(&places)?;
    drop(places);
    let count = order.len() as u32;
    drop(order);
    batches.iter_mut().for_each(|batch| batch.records = Vec::new());
    let (terms, postings) = gathered(batches, &ranks);
    drop(ranks);
    let postings_at = out.at;
    let (mut listed, mut marks) = (Vec::new(), Vec::new());
    let mut next = 0;
    for (number, term) in terms.iter().enumerate() {
        let own = postings[next..].iter().take_while(|p| p.term() as usize == number).count();
        if number % MARK == 0 {
            marks.extend((listed.len() as u64).to_le_bytes());
            marks.extend((out.at - postings_at).to_le_bytes());
        }
        let mut bytes = Vec::with_capacity(2 * own);
        let mut before = 0;
        for posting in &postings[next..next + own] {
            push_number(&mut bytes, u64::from(posting.model() - before));
            bytes.push(posting.weight());
            before = posting.model();
        }
        out.put(&bytes)?;
        push_number(&mut listed, term.len() as u64);
        listed.extend(term.as_bytes());
        push_number(&mut listed, own as u64);
        push_number(&mut listed, bytes.len() as u64);
        next += own;
    }
    let terms_at = out.at;
    out.put(&listed)?;
    let marks_at = out.at;
    out.put(&marks)?;
    let sections = [records_at, places_at, postings_at, terms_at, marks_at, out.at];
    let mut header = MAGIC.to_vec();
    header.extend(count.to_le_bytes());
    header.extend((terms.len() as u32).to_le_bytes());
    sections.iter().for_each(|place| header.extend(place.to_le_bytes()));
    std::io::Seek::rewind(&mut out.out)?;
    out.out.write_all(&header)?;
    Ok(count)
}

/// All terms in order, and all postings in order.
fn gathered(batches: Vec<Batch>, ranks: &[Vec<u32>]) -> (Vec<String>, Vec<Packed>) {
    let mut terms: Vec<&String> = batches.iter().flat_map(|batch| batch.numbers.keys()).collect();
    terms.par_sort_unstable();
    terms.dedup();
    let terms: Vec<String> = terms.into_iter().cloned().collect();
    let mut all = Vec::with_capacity(batches.iter().map(|batch| batch.postings.len()).sum());
    for (batch, ranks) in batches.into_iter().zip(ranks) {
        let mut numbers = vec![0; batch.numbers.len()];
        for (term, &number) in &batch.numbers {
            numbers[number as usize] = terms.binary_search(term).unwrap_or_default() as u32;
        }
        let kept = batch.postings.iter().map(|posting| (posting, ranks[posting.model() as usize]));
        let kept = kept.filter(|(_, rank)| *rank != TWICE);
        all.extend(kept.map(|(posting, rank)| Packed::of(numbers[posting.term() as usize], rank, posting.weight())));
    }
    all.par_sort_unstable();
    (terms, all)
}
