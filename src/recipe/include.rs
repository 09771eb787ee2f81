//! Recipes over recipes: `include: base.yaml` lays a recipe over another file.
//!
//! Paths begin at the including file and stay in the folder of the recipe that was asked for, so that a recipe from
//! elsewhere cannot read what lies around it. Every value keeps the file that it stands in.

use std::path::{Path, PathBuf};

use super::error::{Error, quoted};
use super::node::Node;
use super::source::{Origin, Source, Span};
use super::{Recipe, defaults, parse};

/// The key that names the file under a recipe.
const INCLUDE: &str = "include";
/// Most files over each other.
const MAX_FILES: usize = 16;

/// Whether files outside of the recipe's folder may be included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outside {
    /// They are refused.
    #[default]
    Refused,
    /// They may.
    Allowed,
}

/// A file that lies under a recipe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Included {
    /// As the including file names it.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
}

impl Recipe {
    /// Reads a recipe file, laid over those that it includes; and what these are, the nearest first.
    ///
    /// # Errors
    /// As [`Recipe::read`] for each file; a circle of files, too many, or one outside of the folder.
    pub fn read_whole(path: &Path, outside: Outside) -> Result<(Self, Vec<Included>), Error> {
        Self::read(path)?.laid_over(path, outside)
    }

    /// As [`Recipe::read_whole`], of a text that is to stand in the file at `path`; where it includes others, that file must be there.
    ///
    /// # Errors
    /// As [`Recipe::read_whole`].
    pub fn parse_whole(path: &Path, text: &str, outside: Outside) -> Result<(Self, Vec<Included>), Error> {
        Self::parse(&path.display().to_string(), text)?.laid_over(path, outside)
    }

    fn laid_over(self, path: &Path, outside: Outside) -> Result<(Self, Vec<Included>), Error> {
        if self.0.get(INCLUDE).is_none() {
            return Ok((self, Vec::new()));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let here = |path: &Path| {
            path.canonicalize().map_err(|error| {
                let span = Span::whole(&Source::new(&path.display().to_string(), "", Origin::Given));
                Error::new(&span, "", format!("cannot be found again: {error}"), "check the folder and its permissions")
            })
        };
        let mut reader = Reader { outside, root: here(folder)?, seen: vec![here(path)?], files: Vec::new() };
        let tree = reader.over(self.0, path)?;
        Ok((Self(tree), reader.files))
    }
}

struct Reader {
    outside: Outside,
    /// Folder of the recipe that was asked for.
    root: PathBuf,
    /// Files so far, each including the next.
    seen: Vec<PathBuf>,
    files: Vec<Included>,
}

impl Reader {
    /// The tree of the file at `path` over those that it includes.
    fn over(&mut self, tree: Node, path: &Path) -> Result<Node, Error> {
        let Some(include) = tree.get(INCLUDE) else { return Ok(tree) };
        let fault = |message: String, help: &str| Error::new(&include.span, INCLUDE, message, help);
        let Some(name) = include.text().filter(|name| !name.is_empty()) else {
            let message = format!("a file is included by its name, found {}", include.describe());
            return Err(fault(message, "write for example `include: base.yaml`"));
        };
        let below = path.parent().unwrap_or(Path::new("")).join(name);
        let real = below.canonicalize().map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => {
                fault(format!("there is no file {}", quoted(&below.display().to_string())), "paths begin at this file")
            }
            _ => fault(format!("{} cannot be read: {error}", quoted(name)), "check the file and its permissions"),
        })?;
        if self.outside == Outside::Refused && !real.starts_with(&self.root) {
            let message = format!("{} lies outside of the recipe's folder", quoted(name));
            return Err(fault(message, "copy it there; --allow-outside reads it where it is"));
        }
        if self.seen.contains(&real) {
            return Err(fault(format!("{} includes itself in the end", quoted(name)), "take one `include` out"));
        }
        if self.seen.len() >= MAX_FILES {
            return Err(fault(format!("more than {MAX_FILES} files lie over each other"), "merge some of them"));
        }
        if !real.is_file() {
            return Err(fault(format!("{} is no file", quoted(name)), "name a YAML file"));
        }
        self.seen.push(real);
        self.files.push(Included { name: name.to_owned(), path: below.clone() });
        let under = self.over(Self::map(parse::read(&below)?)?, &below)?;
        let plain = Recipe(tree).without(INCLUDE).0;
        Ok(defaults::lay_over(&plain, &under, ""))
    }

    fn map(node: Node) -> Result<Node, Error> {
        Recipe::of(node).map(|recipe| recipe.0)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Reads `a.yaml` in a folder of such files.
    fn read(files: &[(&str, &str)], outside: Outside) -> Result<(Recipe, Vec<Included>), Error> {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join("in").join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        Recipe::read_whole(&folder.path().join("in/a.yaml"), outside)
    }

    #[test]
    fn a_recipe_lies_over_the_files_that_it_includes() {
        let (recipe, files) = read(
            &[
                ("a.yaml", "include: parts/b.yaml\nseed: 1\nseabed: {shape: flat}\n"),
                ("parts/b.yaml", "include: ../c.yaml\nseed: 2\nwater: {ph: 7}\nobjects: [{label: b}]\n"),
                ("c.yaml", "seed: 3\nwater: {ph: 8, depth_m: 4}\nseabed: {shape: {ripples: {height_m: 1}}, cell_m: 2}\nobjects: []\n"),
            ],
            Outside::Refused,
        )
        .unwrap();
        let expected =
            r#"{"objects":[{"label":"b"}],"seabed":{"cell_m":2,"shape":"flat"},"seed":1,"water":{"depth_m":4,"ph":7}}"#;
        assert_eq!(recipe.node().json().to_string(), expected);
        assert_eq!(files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>(), ["parts/b.yaml", "../c.yaml"]);
        let error = recipe.node().error("water.depth_m", "bad", "");
        assert!(error.file().ends_with("c.yaml") && error.line() == Some(2), "{error}");
    }

    #[test]
    fn files_that_cannot_be_included_are_refused() {
        for (files, message) in [
            (&[("a.yaml", "include: b.yaml")][..], "there is no file"),
            (&[("a.yaml", "include: 3")], "a file is included by its name, found the number 3"),
            (&[("a.yaml", "include: a.yaml")], "`a.yaml` includes itself in the end"),
            (
                &[("a.yaml", "include: b.yaml"), ("b.yaml", "include: ./a.yaml")],
                "`./a.yaml` includes itself in the end",
            ),
            (&[("a.yaml", "include: ../out.yaml"), ("../out.yaml", "x: 1")], "`../out.yaml` lies outside"),
            (&[("a.yaml", "include: b"), ("b/c", "")], "`b` is no file"),
            (&[("a.yaml", "include: b.yaml"), ("b.yaml", "[1]")], "a recipe is a map of sections"),
            (&[("a.yaml", "include: b.yaml"), ("b.yaml", "x: [")], "not valid YAML"),
        ] {
            let error = read(files, Outside::Refused).unwrap_err();
            assert!(error.message.starts_with(message), "{error}");
            assert!(!error.help.is_empty(), "{error}");
        }
        assert!(read(&[("a.yaml", "include: ../out.yaml"), ("../out.yaml", "x: 1")], Outside::Allowed).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_does_not_lead_outside() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("in")).unwrap();
        fs::write(folder.path().join("secret.yaml"), "x: 1").unwrap();
        std::os::unix::fs::symlink(folder.path().join("secret.yaml"), folder.path().join("in/b.yaml")).unwrap();
        fs::write(folder.path().join("in/a.yaml"), "include: b.yaml").unwrap();
        let error = Recipe::read_whole(&folder.path().join("in/a.yaml"), Outside::Refused).unwrap_err();
        assert!(error.message.contains("outside"), "{error}");
    }

    #[test]
    fn a_long_chain_ends() {
        let files: Vec<(String, String)> = (0..40)
            .map(|i| (if i == 0 { "a.yaml".into() } else { format!("{i}.yaml") }, format!("include: {}.yaml", i + 1)))
            .collect();
        let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        assert!(read(&files, Outside::Refused).unwrap_err().message.contains("more than 16 files"));
    }
}
