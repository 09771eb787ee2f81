//! The journal that a shard writes: one line a frame (see [`line`](super::line)), synced line by line.

use std::fs::{self, File, OpenOptions};
use std::io::{BufRead as _, BufReader, BufWriter, ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::atomic::{self, Writer};
use super::{Shard, StoreError, layout, line};

/// A journal, open for writing.
#[derive(Debug)]
pub(crate) struct Journal {
    file: Arc<File>,
    path: PathBuf,
    /// Bytes of whole lines.
    length: u64,
}

impl Journal {
    /// Opens the journal of a shard; takes damaged lines out.
    pub fn open(writer: &Writer, shard: Shard) -> Result<Self, StoreError> {
        let name = layout::journal(shard);
        let path = writer.root().join(&name);
        repair(writer, &name)?;
        let file = OpenOptions::new().append(true).create(true).open(&path).map_err(StoreError::io("open", &path))?;
        let length = file.metadata().map_err(StoreError::io("read", &path))?.len();
        atomic::sync_folder_of(&path)?;
        Ok(Self { file: Arc::new(file), path, length })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a line in one write; returns where it begins, and the file to sync: without the lock that guards the journal,
    /// so that threads that sync at once share one wait.
    pub fn append(&mut self, line: &str) -> Result<(u64, Arc<File>), StoreError> {
        if let Err(source) = (&*self.file).write_all(line.as_bytes()) {
            // A half line must not spoil the next; if even this fails, the next line's checksum tells.
            let _ = self.file.set_len(self.length);
            return Err(StoreError::Io { doing: "write", path: self.path.clone(), source });
        }
        let began = self.length;
        self.length += line.len() as u64;
        Ok((began, self.file.clone()))
    }
}

/// Calls `each` with every line of a journal and the byte at which it begins; lines that are no text are empty ones.
pub(crate) fn each_line(path: &Path, mut each: impl FnMut(&str, u64)) -> Result<(), StoreError> {
    let file = match File::open(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        result => result.map_err(StoreError::io("read", path))?,
    };
    let (mut reader, mut bytes, mut began) = (BufReader::with_capacity(1 << 20, file), Vec::new(), 0);
    loop {
        bytes.clear();
        let length = reader.read_until(b'\n', &mut bytes).map_err(StoreError::io("read", path))?;
        if length == 0 {
            return Ok(());
        }
        each(std::str::from_utf8(&bytes).unwrap_or_default(), began);
        began += length as u64;
    }
}

/// Rewrites a journal without the lines that are not whole, if it has any.
fn repair(writer: &Writer, name: &str) -> Result<(), StoreError> {
    let path = writer.root().join(name);
    let mut good = 0;
    each_line(&path, |text, _| good += line::parse(text).map_or(0, |_| text.len() as u64))?;
    if fs::metadata(&path).map_or(0, |data| data.len()) == good {
        return Ok(());
    }
    writer
        .write_with(name, |out| {
            let mut out = BufWriter::new(out);
            let mut written = Ok(());
            each_line(&path, |text, _| {
                if written.is_ok() && line::parse(text).is_some() {
                    written = out.write_all(text.as_bytes());
                }
            })
            .map_err(std::io::Error::other)?;
            written.and_then(|()| out.flush())
        })
        .map(|_| ())
}
