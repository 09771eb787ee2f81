//! Where a model may read files: inside its catalog's folder, and nowhere else.
//!
//! Links are followed before that is checked. Nothing is ever fetched from a network.

use std::fs::{self, File};
use std::io::{Error, ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

use super::uri;
use crate::catalog::error::ModelFault;

/// Most bytes of a model and its buffers together.
pub(super) const MAX_BYTES: u64 = 512 << 20;

/// A model file that is known to lie in its root folder.
#[derive(Debug)]
pub(super) struct Folder {
    /// Links resolved, as the others.
    root: PathBuf,
    model: PathBuf,
}

impl Folder {
    /// The place of a model. Without a root, its own folder is the root.
    pub fn of(model: &Path, root: Option<&Path>) -> Result<Self, ModelFault> {
        let model = fs::canonicalize(model)?;
        let root = match root {
            Some(root) => fs::canonicalize(root)?,
            None => model.parent().unwrap_or(&model).to_path_buf(),
        };
        if model.starts_with(&root) { Ok(Self { root, model }) } else { Err(ModelFault::Elsewhere { root }) }
    }

    /// The bytes of the model itself.
    pub fn read_model(&self) -> Result<Vec<u8>, ModelFault> {
        read(&self.model, MAX_BYTES)?.map_err(ModelFault::Io)
    }

    /// The bytes that a relative URI names, at most `most`.
    pub fn read_uri(&self, text: &str, place: &str, most: u64) -> Result<Vec<u8>, ModelFault> {
        let shown = || text.chars().take(200).collect::<String>();
        let outside = |problem| ModelFault::Outside { place: place.into(), uri: shown(), problem };
        if uri::scheme(text).is_some() || text.starts_with("//") {
            return Err(outside("is an address outside of the catalog, and nothing is fetched"));
        }
        let relative = PathBuf::from(uri::percent_decoded(text));
        let file = self.inside(&relative).ok_or_else(|| outside("leads out of the catalog's folder"))?;
        let beside = |error| ModelFault::Beside { place: place.into(), uri: shown(), error };
        let file = fs::canonicalize(file).map_err(beside)?;
        if !file.starts_with(&self.root) {
            return Err(outside("is a link that leads out of the catalog's folder"));
        }
        read(&file, most)?.map_err(beside)
    }

    /// The path with `..` resolved by name, if it stays inside of the root.
    fn inside(&self, relative: &Path) -> Option<PathBuf> {
        let mut path = self.model.parent()?.to_path_buf();
        for part in relative.components() {
            match part {
                Component::Normal(name) => path.push(name),
                Component::CurDir => {}
                Component::ParentDir => {
                    path.pop();
                    if !path.starts_with(&self.root) {
                        return None;
                    }
                }
                Component::RootDir | Component::Prefix(_) => return None,
            }
        }
        Some(path)
    }
}

/// The bytes of a regular file (a pipe or a device might never end).
fn read(path: &Path, most: u64) -> Result<Result<Vec<u8>, Error>, ModelFault> {
    let opened = fs::metadata(path).and_then(|about| {
        if about.is_file() { File::open(path) } else { Err(Error::new(ErrorKind::InvalidInput, "it is no file")) }
    });
    let about = opened.and_then(|file| Ok((file.metadata()?.len(), file)));
    let (count, file) = match about {
        Ok(about) => about,
        Err(error) => return Ok(Err(error)),
    };
    ModelFault::limit("bytes", count, most)?;
    let mut bytes = Vec::with_capacity(count as usize);
    // The file may grow meanwhile.
    Ok(file.take(most).read_to_end(&mut bytes).map(|_| bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `root/models/a.gltf`, `root/shared.bin`, `root/models/data b.bin` and `secret.bin` beside the root.
    fn tree() -> (tempfile::TempDir, Folder) {
        let all = tempfile::tempdir().expect("a temporary folder");
        let root = all.path().join("root");
        fs::create_dir_all(root.join("models")).expect("folders");
        for file in ["models/a.gltf", "shared.bin", "models/data b.bin", "../secret.bin"] {
            fs::write(root.join(file), file).expect("written");
        }
        let folder = Folder::of(&root.join("models/a.gltf"), Some(&root)).expect("inside");
        (all, folder)
    }

    #[test]
    fn files_of_the_catalog_are_read() {
        let (_all, folder) = tree();
        assert_eq!(folder.read_model().expect("read"), b"models/a.gltf");
        for (uri, content) in [
            ("data%20b.bin", "models/data b.bin"),
            ("./data b.bin", "models/data b.bin"),
            ("../shared.bin", "shared.bin"),
        ] {
            assert_eq!(folder.read_uri(uri, "buffers[0]", 100).expect(uri), content.as_bytes());
        }
        assert!(matches!(folder.read_uri("../shared.bin", "", 9), Err(ModelFault::TooLarge { limit: 9, .. })));
        let error = folder.read_uri("none.bin", "buffers[0]", 100).expect_err("not there").to_string();
        assert!(error.contains("\"none.bin\" (buffers[0])") && error.contains("beside the model"), "{error}");
        assert!(folder.read_uri("../models", "", 100).expect_err("a folder").to_string().contains("no file"));
    }

    #[test]
    fn everything_else_is_refused() {
        let (all, folder) = tree();
        let secret = all.path().join("secret.bin");
        let absolute = secret.to_str().expect("UTF-8").to_owned();
        for uri in [
            "../../secret.bin",
            "%2e%2e/%2E%2E/secret.bin",
            "..%2F../secret.bin",
            "../models/../../secret.bin",
            "no/such/../../../../secret.bin",
            &absolute,
            &format!("file://{absolute}"),
            &format!("FILE:{absolute}"),
            "http://127.0.0.1:9/x.bin",
            "https://host/x.bin",
            "//host/x.bin",
            "C:\\x.bin",
            "smb:x",
        ] {
            let error = folder.read_uri(uri, "buffers[3]", 100).expect_err(uri);
            assert!(matches!(error, ModelFault::Outside { .. }), "{uri}: {error}");
            assert!(error.to_string().contains("buffers[3]") && error.to_string().contains("put the data"), "{error}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_first() {
        use std::os::unix::fs::symlink;
        let (all, folder) = tree();
        let root = all.path().join("root");
        symlink("../shared.bin", root.join("models/in.bin")).expect("linked");
        symlink(all.path().join("secret.bin"), root.join("models/out.bin")).expect("linked");
        symlink(all.path().join("secret.bin"), root.join("out.glb")).expect("linked");
        symlink("/dev/zero", all.path().join("zero.glb")).expect("linked");
        assert_eq!(folder.read_uri("in.bin", "", 100).expect("inside"), b"shared.bin");
        let error = folder.read_uri("out.bin", "buffers[0]", 100).expect_err("outside").to_string();
        assert!(error.contains("link"), "{error}");
        let error = Folder::of(&root.join("out.glb"), Some(&root)).expect_err("outside").to_string();
        assert!(error.contains("leads out of") && error.contains("copy"), "{error}");
        let endless = Folder::of(&all.path().join("zero.glb"), None).expect("its own folder");
        assert!(endless.read_model().expect_err("a device").to_string().contains("no file"));
    }
}
