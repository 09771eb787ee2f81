//! A recipe's file and its former texts, in `RECIPE.edits.json` beside it.
//!
//! Both are there whole or not at all. The history is written first: whatever interrupts, no text is lost.

use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde::{Deserialize, Serialize};

/// Most former texts that are kept.
const MOST: usize = 200;

/// A recipe's file and what it said before.
#[derive(Debug)]
pub(in crate::cli) struct History {
    /// The recipe, links followed.
    path: PathBuf,
    texts: Texts,
}

/// What the history's file holds: texts and what was asked for.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Texts {
    /// The text as the last change left it.
    now: Option<String>,
    /// Former texts, the oldest first.
    undo: Vec<Former>,
    /// Texts that were taken back, the oldest first.
    redo: Vec<Former>,
}

/// A text and the request that changed it.
#[derive(Debug, Serialize, Deserialize)]
struct Former {
    text: String,
    asked: String,
}

impl History {
    /// The history of a recipe; an empty one where nothing was changed yet.
    pub fn of(recipe: &Path) -> anyhow::Result<Self> {
        let path = recipe.canonicalize().unwrap_or_else(|_| recipe.to_owned());
        let file = history_file(&path);
        let texts = match fs::read(&file) {
            Ok(bytes) => serde_json::from_slice(&bytes).with_context(|| {
                format!("{} is no history of a recipe\nhelp: move it away; the recipe itself is whole", file.display())
            })?,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Texts::default(),
            Err(error) => return Err(error).with_context(|| format!("cannot read {}", file.display())),
        };
        Ok(Self { path, texts })
    }

    /// The recipe's text.
    pub fn text(&self) -> anyhow::Result<String> {
        fs::read_to_string(&self.path).with_context(|| format!("cannot read {}", self.path.display()))
    }

    /// Writes a new text, for a request.
    pub fn change(&mut self, before: &str, after: &str, asked: &str) -> anyhow::Result<()> {
        self.texts.undo.push(Former { text: before.to_owned(), asked: asked.to_owned() });
        let many = self.texts.undo.len().saturating_sub(MOST);
        self.texts.undo.drain(..many);
        self.texts.redo.clear();
        self.write(after)
    }

    /// Takes the last change back.
    pub fn undo(&mut self, even_so: bool) -> anyhow::Result<String> {
        let now = self.unchanged(even_so)?;
        let Some(Former { text, asked }) = self.texts.undo.pop() else {
            bail!("there is no change of {} to take back", self.path.display());
        };
        self.texts.redo.push(Former { text: now, asked });
        self.write(&text)?;
        Ok(text)
    }

    /// Makes the change again that was taken back last.
    pub fn redo(&mut self, even_so: bool) -> anyhow::Result<String> {
        let now = self.unchanged(even_so)?;
        let Some(Former { text, asked }) = self.texts.redo.pop() else {
            bail!("no change of {} was taken back", self.path.display());
        };
        self.texts.undo.push(Former { text: now, asked });
        self.write(&text)?;
        Ok(text)
    }

    /// The text, unless somebody else changed it since.
    fn unchanged(&self, even_so: bool) -> anyhow::Result<String> {
        let now = self.text()?;
        if self.texts.now.as_ref().is_some_and(|left| *left != now) && !even_so {
            bail!(
                "{} was changed by hand since its last edit, and this would be lost\nhelp: --yes does it even so; --redo and \
                 --undo bring the text of now back",
                self.path.display()
            );
        }
        Ok(now)
    }

    fn write(&mut self, text: &str) -> anyhow::Result<()> {
        self.texts.now = Some(text.to_owned());
        let file = history_file(&self.path);
        let json = serde_json::to_string(&self.texts).context("a history is JSON")?;
        write_whole(&file, &json).with_context(|| format!("cannot write {}", file.display()))?;
        write_whole(&self.path, text).with_context(|| format!("cannot write {}", self.path.display()))
    }
}

/// Writes a file that is there whole or not at all; links are followed.
pub(in crate::cli) fn write_whole(path: &Path, text: &str) -> std::io::Result<()> {
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    let written = File::create(&temporary).and_then(|mut file| {
        file.write_all(text.as_bytes())?;
        if let Ok(there) = fs::metadata(path) {
            file.set_permissions(there.permissions())?;
        }
        file.sync_all()
    });
    written.and_then(|()| fs::rename(&temporary, path)).inspect_err(|_| drop(fs::remove_file(&temporary)))
}

fn history_file(recipe: &Path) -> PathBuf {
    let mut name = recipe.file_name().unwrap_or_default().to_owned();
    name.push(".edits.json");
    recipe.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_come_back_to_the_byte() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.yaml");
        let texts = ["\u{feff}a: 1\r\n", "a: 2 # é\n", "a: 3"];
        fs::write(&path, texts[0]).unwrap();
        for pair in texts.windows(2) {
            History::of(&path).unwrap().change(pair[0], pair[1], "x").unwrap();
        }
        let read = || fs::read_to_string(&path).unwrap();
        for expected in [texts[1], texts[0]] {
            assert_eq!(History::of(&path).unwrap().undo(false).unwrap(), expected);
            assert_eq!(read(), expected);
        }
        assert!(History::of(&path).unwrap().undo(false).is_err());
        assert_eq!(History::of(&path).unwrap().redo(false).unwrap(), texts[1]);
        fs::write(&path, "by hand").unwrap();
        assert!(History::of(&path).unwrap().undo(false).unwrap_err().to_string().contains("by hand"));
        assert_eq!(History::of(&path).unwrap().undo(true).unwrap(), texts[0]);
        assert_eq!(History::of(&path).unwrap().redo(false).unwrap(), "by hand");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "no temporary file stays");
    }

    #[test]
    fn a_broken_history_is_told_and_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.yaml");
        fs::write(&path, "a: 1").unwrap();
        fs::write(folder.path().join("a.yaml.edits.json"), "{").unwrap();
        assert!(History::of(&path).unwrap_err().to_string().contains("no history"));
    }
}
