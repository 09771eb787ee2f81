//! Frames that a verification found damaged: a list beside the journals, read by the next run, which renders them again.

use std::collections::BTreeSet;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use super::atomic::{self, Writer};
use super::{FileRecord, StoreError, layout};

/// Ids of the listed frames whose files still differ. Packed ones are all listed: where they lie now is for the caller to
/// find out.
pub(crate) fn frames(root: &Path) -> Result<BTreeSet<u64>, StoreError> {
    let listed = read(root)?;
    Ok(listed
        .into_iter()
        .filter(|(_, file)| layout::is_packed(&file.path) || !is_right(root, file))
        .map(|(id, _)| id)
        .collect())
}

/// Writes the list anew.
pub(crate) fn write(writer: &Writer, damaged: &[(u64, FileRecord)]) -> Result<(), StoreError> {
    if damaged.is_empty() {
        return clear(writer.root());
    }
    let text = serde_json::to_vec(damaged).expect("strings and numbers always serialise");
    writer.write(layout::DAMAGED, &text).map(|_| ())
}

/// Takes the list away.
pub(crate) fn clear(root: &Path) -> Result<(), StoreError> {
    let path = root.join(layout::DAMAGED);
    match fs::remove_file(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        result => result.map_err(StoreError::io("delete", &path)),
    }
}

fn read(root: &Path) -> Result<Vec<(u64, FileRecord)>, StoreError> {
    let path = root.join(layout::DAMAGED);
    match fs::read(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(Vec::new()),
        // A torn list is none: verifying again writes it again.
        result => Ok(serde_json::from_slice(&result.map_err(StoreError::io("read", &path))?).unwrap_or_default()),
    }
}

/// Whether a file has the bytes that its record says.
fn is_right(root: &Path, file: &FileRecord) -> bool {
    atomic::hash_file(&root.join(&file.path)).is_ok_and(|there| there == (file.bytes, file.sha256.clone()))
}
