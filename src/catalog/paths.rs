//! Paths that stand in catalogs: they lead to files below the catalog's root and nowhere else.

use std::path::{Component, Path, PathBuf};

use super::error::CatalogError;

/// What addresses begin with, before the colon.
const ADDRESSES: [&str; 6] = ["data", "file", "ftp", "http", "https", "javascript"];

/// The file of a path that an index names.
///
/// # Errors
/// Why it cannot be a file of the catalog: it leaves its root, is absolute, or is an address.
pub fn inside(root: &Path, path: &str) -> Result<PathBuf, String> {
    let refuse =
        |why: &str| Err(format!("path `{}` {why}; models live inside the catalog's folder", super::text::clean(path)));
    if path.is_empty() {
        return refuse("is empty");
    }
    let scheme = path.split_once(':').map_or("", |(scheme, _)| scheme).to_ascii_lowercase();
    if path.contains("://") || ADDRESSES.contains(&scheme.as_str()) {
        return refuse("is an address, and nothing is fetched");
    }
    let drive = scheme.len() == 1 && scheme.starts_with(|c: char| c.is_ascii_alphabetic());
    if drive || path.contains('\\') || path.chars().any(char::is_control) {
        return refuse("is no relative path with `/` between its parts");
    }
    let relative = Path::new(path);
    if relative.components().any(|part| !matches!(part, Component::Normal(_) | Component::CurDir)) {
        return refuse("leaves the catalog's folder");
    }
    Ok(root.join(relative))
}

/// A file of a catalog, links followed.
///
/// # Errors
/// [`CatalogError::Outside`] if a link leads out of the root; [`CatalogError::Model`] if the file is not there.
pub fn real(root: &Path, file: &Path) -> Result<PathBuf, CatalogError> {
    let follow = |path: &Path| {
        path.canonicalize().map_err(|error| CatalogError::Model { path: path.to_path_buf(), fault: error.into() })
    };
    let (root, followed) = (follow(root)?, follow(file)?);
    if followed.starts_with(&root) {
        Ok(followed)
    } else {
        Err(CatalogError::Outside { path: file.to_path_buf(), target: followed, root })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_relative_paths_below_the_root_are_taken() {
        let root = Path::new("/models");
        assert_eq!(inside(root, "a/./b.glb").expect("inside"), Path::new("/models/a/b.glb"));
        assert!(inside(root, "colon: in name.glb").is_ok());
        for (path, why) in [
            ("../../etc/passwd", "leaves"),
            ("a/../../b.glb", "leaves"),
            ("/etc/passwd", "leaves"),
            ("file:///etc/passwd", "address"),
            ("http://example.org/a.glb", "address"),
            ("C:\\a.glb", "relative"),
            ("a\\..\\b.glb", "relative"),
            ("a\u{1b}[2J.glb", "relative"),
            ("", "empty"),
        ] {
            let fault = inside(root, path).expect_err(path);
            assert!(fault.contains(why) && !fault.contains('\u{1b}'), "{fault}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_root_is_refused_and_one_within_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path().join("models");
        std::fs::create_dir(&root).expect("a folder");
        std::fs::write(folder.path().join("secret.glb"), "s").expect("written");
        std::fs::write(root.join("a.glb"), "a").expect("written");
        let link = |from: &str, to: &str| std::os::unix::fs::symlink(from, root.join(to)).expect("linked");
        link("../secret.glb", "out.glb");
        link("a.glb", "in.glb");
        assert!(real(&root, &root.join("in.glb")).is_ok());
        let fault = real(&root, &root.join("out.glb")).expect_err("outside").to_string();
        assert!(fault.contains("out.glb") && fault.contains("secret.glb"), "{fault}");
        assert!(real(&root, &root.join("none.glb")).is_err());
    }
}
