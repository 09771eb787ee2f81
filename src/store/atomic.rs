//! Files that are there whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Read as _, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};

use super::layout::TEMPORARY;
use super::{FileRecord, NewFile, StoreError};

/// Writes files under a folder. Processes that write there at once have tags of their own, so that they may even write the
/// same file, with the same bytes.
#[derive(Clone, Debug)]
pub(crate) struct Writer {
    root: PathBuf,
    tag: String,
}

impl Writer {
    /// A writer under `root`.
    pub fn new(root: &Path, tag: &str) -> Self {
        Self { root: root.to_path_buf(), tag: tag.to_owned() }
    }

    /// The folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Writes a whole file at `path` under the folder; makes its own folder if need be.
    pub fn write(&self, path: &str, bytes: &[u8]) -> Result<FileRecord, StoreError> {
        self.write_with(path, |out| out.write_all(bytes))
    }

    /// Writes several whole files, and waits for their folders once each.
    pub fn write_all(&self, files: &[NewFile]) -> Result<Vec<FileRecord>, StoreError> {
        let write = |file: &NewFile| self.put(&file.path, |out| out.write_all(&file.bytes));
        let records = files.iter().map(write).collect::<Result<_, _>>()?;
        let mut folders: Vec<PathBuf> = files.iter().map(|file| self.root.join(&file.path)).collect();
        folders.sort();
        folders.dedup_by(|a, b| a.parent() == b.parent());
        folders.iter().try_for_each(|path| sync_folder_of(path))?;
        Ok(records)
    }

    /// As [`Self::write`], with the contents written by `fill` piece by piece: under a temporary name in the same folder,
    /// hashed on the way, synced, then renamed, and the folder synced. After a failure the temporary file stays, and the
    /// next attempt overwrites it.
    pub fn write_with(
        &self,
        path: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<FileRecord, StoreError> {
        let record = self.put(path, fill)?;
        sync_folder_of(&self.root.join(path))?;
        Ok(record)
    }

    /// As [`Self::write_with`], but for the folder.
    fn put(&self, path: &str, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<FileRecord, StoreError> {
        let target = self.root.join(path);
        let temporary = self.root.join(format!("{path}.{}.{TEMPORARY}", self.tag));
        let file = create(&temporary)?;
        let mut out = BufWriter::new(Hashing { file, hash: Sha256::new(), bytes: 0 });
        fill(&mut out).and_then(|()| out.flush()).map_err(StoreError::io("write", &temporary))?;
        let Hashing { file, hash, bytes } = out.into_parts().0;
        file.sync_all().map_err(StoreError::io("sync", &temporary))?;
        drop(file);
        fs::rename(&temporary, &target).map_err(StoreError::io("rename to", &target))?;
        Ok(FileRecord { path: path.to_owned(), bytes, sha256: hex(&hash.finalize()) })
    }

    /// Makes sure that a file has these bytes.
    pub fn keep(&self, path: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let there = fs::read(self.root.join(path)).is_ok_and(|there| there == bytes);
        if there { Ok(()) } else { self.write(path, bytes).map(|_| ()) }
    }
}

/// Makes the name of a file last: a rename is only on the disk when its folder is.
pub(crate) fn sync_folder_of(path: &Path) -> Result<(), StoreError> {
    // Other systems open no folders, and keep names without this.
    if cfg!(unix) {
        let folder = path.parent().unwrap_or(path);
        let synced = File::open(folder).and_then(|folder| folder.sync_all());
        // Some network file systems cannot sync a folder; there the file's own sync must do.
        if let Err(error) = synced
            && !matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::InvalidInput)
        {
            return Err(StoreError::Io { doing: "sync", path: folder.to_path_buf(), source: error });
        }
    }
    Ok(())
}

/// Length and SHA-256 of a file, read piece by piece.
pub(crate) fn hash_file(path: &Path) -> io::Result<(u64, String)> {
    let mut reader = File::open(path)?;
    let (mut hash, mut buffer, mut length) = (Sha256::new(), vec![0; 1 << 18], 0);
    loop {
        match reader.read(&mut buffer)? {
            0 => return Ok((length, hex(&hash.finalize()))),
            read => {
                hash.update(&buffer[..read]);
                length += read as u64;
            }
        }
    }
}

fn create(path: &Path) -> Result<File, StoreError> {
    let file = match File::create(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let folder = path.parent().unwrap_or(path);
            fs::create_dir_all(folder).map_err(StoreError::io("create", folder))?;
            File::create(path)
        }
        result => result,
    };
    file.map_err(StoreError::io("create", path))
}

/// A file that knows the hash and length of what was written to it.
struct Hashing {
    file: File,
    hash: Sha256,
    bytes: u64,
}

impl Write for Hashing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// SHA-256 as 64 hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_appears_whole_with_its_hash() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a/b/c.txt");
        let record = Writer::new(folder.path(), "test")
            .write_with("a/b/c.txt", |out| {
                out.write_all(b"ab")?;
                assert!(!target.exists());
                out.write_all(b"c")
            })
            .unwrap();
        // FIPS 180-2, appendix B.1.
        assert_eq!(record.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!((record.path.as_str(), record.bytes), ("a/b/c.txt", 3));
        assert_eq!(fs::read(&target).unwrap(), b"abc");
        assert_eq!(fs::read_dir(folder.path().join("a/b")).unwrap().count(), 1, "no temporary file stays");
    }

    #[test]
    fn a_file_that_fails_leaves_the_old_one() {
        let folder = tempfile::tempdir().unwrap();
        let writer = Writer::new(folder.path(), "test");
        writer.write("f", b"old").unwrap();
        let failed = writer.write_with("f", |out| {
            out.write_all(b"half of the n")?;
            Err(io::Error::other("power cut"))
        });
        let message = failed.unwrap_err().to_string();
        assert!(message.contains("f.test.tmp") && message.contains("power cut"), "{message}");
        assert_eq!(fs::read(folder.path().join("f")).unwrap(), b"old");
        writer.write("f", b"new").unwrap();
        assert_eq!(fs::read(folder.path().join("f")).unwrap(), b"new");
    }
}
