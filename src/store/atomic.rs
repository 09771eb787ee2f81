//! Files that are there whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use sha2::{Digest as _, Sha256};

use super::layout::TEMPORARY;
use super::{FileRecord, StoreError};

/// Writes a whole file at `path` under `root`; makes its folder if need be.
pub(crate) fn write(root: &Path, path: &str, bytes: &[u8]) -> Result<FileRecord, StoreError> {
    write_with(root, path, |out| out.write_all(bytes))
}

/// As [`write`], with the contents written by `fill` piece by piece: under a temporary name in the same folder, hashed on
/// the way, synced, then renamed. After a failure the temporary file stays, and the next attempt overwrites it.
pub(crate) fn write_with(
    root: &Path,
    path: &str,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<FileRecord, StoreError> {
    let target = root.join(path);
    let temporary = root.join(format!("{path}.{TEMPORARY}"));
    let file = create(&temporary)?;
    let mut out = BufWriter::new(Hashing { file, hash: Sha256::new(), bytes: 0 });
    fill(&mut out).and_then(|()| out.flush()).map_err(StoreError::io("write", &temporary))?;
    let Hashing { file, hash, bytes } = out.into_parts().0;
    file.sync_all().map_err(StoreError::io("sync", &temporary))?;
    drop(file);
    fs::rename(&temporary, &target).map_err(StoreError::io("rename to", &target))?;
    Ok(FileRecord { path: path.to_owned(), bytes, sha256: hex(&hash.finalize()) })
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

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_appears_whole_with_its_hash() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a/b/c.txt");
        let record = write_with(folder.path(), "a/b/c.txt", |out| {
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
        write(folder.path(), "f", b"old").unwrap();
        let failed = write_with(folder.path(), "f", |out| {
            out.write_all(b"half of the n")?;
            Err(io::Error::other("power cut"))
        });
        let message = failed.unwrap_err().to_string();
        assert!(message.contains("f.tmp") && message.contains("power cut"), "{message}");
        assert_eq!(fs::read(folder.path().join("f")).unwrap(), b"old");
        write(folder.path(), "f", b"new").unwrap();
        assert_eq!(fs::read(folder.path().join("f")).unwrap(), b"new");
    }
}
