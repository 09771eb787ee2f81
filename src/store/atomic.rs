//! Files that are there whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};

use super::layout::TEMPORARY;
use super::{FileRecord, StoreError};

/// A file in the making: written under a temporary name in its folder and hashed on the way.
///
/// Dropped without [`Self::commit`], it leaves the temporary file, which the next attempt overwrites.
pub(crate) struct AtomicFile {
    out: BufWriter<File>,
    hash: Sha256,
    bytes: u64,
    path: String,
    temporary: PathBuf,
    target: PathBuf,
}

/// Writes a whole file at `path` under `root`.
pub(crate) fn write(root: &Path, path: &str, bytes: &[u8]) -> Result<FileRecord, StoreError> {
    let mut file = AtomicFile::create(root, path)?;
    file.write_all(bytes).map_err(StoreError::io("write", &file.temporary))?;
    file.commit()
}

impl AtomicFile {
    /// Begins the file at `path` under `root`; makes its folder if need be.
    pub fn create(root: &Path, path: &str) -> Result<Self, StoreError> {
        let target = root.join(path);
        let mut temporary = target.clone().into_os_string();
        temporary.push(".");
        temporary.push(TEMPORARY);
        let temporary = PathBuf::from(temporary);
        let file = match File::create(&temporary) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let folder = target.parent().unwrap_or(root);
                fs::create_dir_all(folder).map_err(StoreError::io("create", folder))?;
                File::create(&temporary)
            }
            result => result,
        };
        let out = BufWriter::new(file.map_err(StoreError::io("create", &temporary))?);
        Ok(Self { out, hash: Sha256::new(), bytes: 0, path: path.to_owned(), temporary, target })
    }

    /// Syncs the file and gives it its name.
    pub fn commit(self) -> Result<FileRecord, StoreError> {
        let file = self.out.into_inner().map_err(|error| error.into_error());
        let file = file.map_err(StoreError::io("write", &self.temporary))?;
        file.sync_all().map_err(StoreError::io("sync", &self.temporary))?;
        drop(file);
        fs::rename(&self.temporary, &self.target).map_err(StoreError::io("rename to", &self.target))?;
        Ok(FileRecord { path: self.path, bytes: self.bytes, sha256: hex(&self.hash.finalize()) })
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// SHA-256 as 64 hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_appears_whole_with_its_hash() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = AtomicFile::create(folder.path(), "a/b/c.txt").unwrap();
        file.write_all(b"ab").unwrap();
        assert!(!folder.path().join("a/b/c.txt").exists());
        file.write_all(b"c").unwrap();
        let record = file.commit().unwrap();
        // FIPS 180-2, appendix B.1.
        assert_eq!(record.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!((record.path.as_str(), record.bytes), ("a/b/c.txt", 3));
        assert_eq!(fs::read(folder.path().join("a/b/c.txt")).unwrap(), b"abc");
        assert_eq!(fs::read_dir(folder.path().join("a/b")).unwrap().count(), 1, "no temporary file stays");
    }
}
