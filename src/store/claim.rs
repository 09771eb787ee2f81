//! Whether a folder may be written, and by this process alone.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::path::Path;

use super::{StoreError, layout};

/// Refuses a path that is a file, and a folder with other things in it.
pub(super) fn refuse_foreign(root: &Path) -> Result<(), StoreError> {
    let entries = match fs::read_dir(root) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) if error.kind() == ErrorKind::NotADirectory && root.is_file() => {
            return Err(StoreError::NotAFolder { path: root.to_path_buf() });
        }
        result => result.map_err(StoreError::io("read", root))?,
    };
    if root.join(layout::MANIFEST).is_file() {
        return Ok(());
    }
    let mut names = Vec::new();
    for entry in entries {
        names.push(entry.map_err(StoreError::io("read", root))?.file_name().to_string_lossy().into_owned());
    }
    // What a run leaves that was killed before it wrote its manifest.
    let temporary = format!(".{}", layout::TEMPORARY);
    names.retain(|name| name != layout::SHARDS && !name.ends_with(&temporary));
    names.sort();
    match names.into_iter().next() {
        Some(found) => Err(StoreError::Foreign { path: root.to_path_buf(), found }),
        None => Ok(()),
    }
}

/// Makes the folder and sees whether files can be written there.
pub(super) fn probe(root: &Path, tag: &str) -> Result<(), StoreError> {
    fs::create_dir_all(root).map_err(StoreError::io("create", root))?;
    let path = root.join(format!("probe.{tag}.{}", layout::TEMPORARY));
    fs::write(&path, b"may be deleted").map_err(StoreError::io("write", &path))?;
    fs::remove_file(&path).map_err(StoreError::io("delete", &path))
}

/// Takes a shard (or the finishing) of the folder for this process. The system gives it back however the process ends.
pub(super) fn lock(root: &Path, name: &str) -> Result<File, StoreError> {
    let path = root.join(name);
    let folder = path.parent().unwrap_or(root);
    fs::create_dir_all(folder).map_err(StoreError::io("create", folder))?;
    let file = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
    let file = file.map_err(StoreError::io("create", &path))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StoreError::Locked { path: root.to_path_buf(), lock: name.to_owned() }),
        // Some network file systems know no locks; there the user must see to it.
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(file),
        Err(TryLockError::Error(source)) => Err(StoreError::Io { doing: "lock", path, source }),
    }
}
