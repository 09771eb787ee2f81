//! The recipe as a located tree: read, completed with defaults, drawn, and typed.
//!
//! ```text
//! text ─ Recipe::read ─► Recipe ─ completed ─► Tree ─ draw ─► Node without distributions ─ to::<T> ─► a plain struct
//!                          ▲ set
//! ```
//! Every value knows file, line and column, so every error does. Knows nothing of what the values mean: other modules define
//! plain serde structs, check ranges, and report through [`Tree::reject`].

mod amend;
mod corner;
mod de;
mod de_enum;
mod de_items;
mod defaults;
mod distribution;
mod draw;
mod error;
mod fault;
mod include;
mod lets;
mod merge;
mod nearest;
mod node;
mod parse;
pub(crate) mod path;
pub(crate) mod places;
mod scalar;
mod set;
mod source;
mod sweep;

pub use corner::Corner;
pub use defaults::DEFAULTS;
pub use draw::{Address, Draws, Level};
pub use error::Error;
pub(crate) use error::printable;
pub use include::{Included, Outside};
pub use lets::{Lets, Shared};
pub use nearest::{did_you_mean, nearest};
pub use node::{Key, Kind, Node, Style};
pub use parse::{MAX_BYTES, MAX_DEPTH, MAX_NODES, parse, read};
pub use source::{Origin, Source, Span};
pub use sweep::{MAX_VARIANTS, Variant};

use std::path::Path;

use serde::de::DeserializeOwned;

/// The format version that this program reads: the value of the key `ensonify`.
pub const VERSION: u32 = 1;

/// A recipe as the user wrote it, before defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe(Node);

impl Recipe {
    /// Reads a recipe file.
    ///
    /// # Errors
    /// A file that cannot be read or is not the YAML that recipes take; a root that is not a map.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::of(read(path)?)
    }

    /// Reads a recipe text; `name` stands in messages.
    ///
    /// # Errors
    /// As [`Recipe::read`].
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        Self::of(parse(name, text, Origin::Given)?)
    }

    fn of(node: Node) -> Result<Self, Error> {
        match node.kind {
            Kind::Map(_) => Ok(Self(node)),
            _ => {
                let message = format!("a recipe is a map of sections, found {}", node.describe());
                Err(Error::new(&node.span, "", message, "begin with `ensonify: 1`"))
            }
        }
    }

    /// Puts the YAML text `value` at `path`, as `--set path=value` asks.
    ///
    /// # Errors
    /// A path that leads nowhere, or a value that is not YAML; located as `--set:1:column`.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), Error> {
        self.0.set(path, value)
    }

    /// Puts a value at `path`, which was written at `place`, as a sweep does.
    ///
    /// # Errors
    /// A path that leads nowhere; located at `place`.
    pub fn put(&mut self, path: &str, value: Node, place: &Span) -> Result<(), Error> {
        self.0.put(path, value, place)
    }

    /// The recipe without one of its top-level keys.
    #[must_use]
    pub fn without(&self, section: &str) -> Self {
        let entries = self.0.entries().iter().filter(|(key, _)| key.text != section).cloned().collect();
        Self(Node { kind: Kind::Map(entries), span: self.0.span.clone() })
    }

    /// The tree as written.
    #[must_use]
    pub fn node(&self) -> &Node {
        &self.0
    }

    /// The recipe with `over` laid over one of its top-level sections; a kind in it replaces another kind whole.
    #[must_use]
    pub fn with_section_over(&self, section: &str, over: &Node) -> Self {
        let laid = match self.0.get(section) {
            Some(under) => defaults::lay_over(over, under, section),
            None => over.clone(),
        };
        let mut root = self.0.clone();
        if let Kind::Map(entries) = &mut root.kind {
            match entries.iter_mut().find(|(key, _)| key.text == section) {
                Some((_, value)) => *value = laid,
                None => {
                    let key = Key { text: section.to_owned(), style: Style::Plain, span: over.span.clone() };
                    entries.push((key, laid));
                }
            }
        }
        Self(root)
    }

    /// The recipe laid over the built-in defaults.
    #[must_use]
    pub fn completed(&self) -> Tree {
        Tree(defaults::complete(&self.0))
    }
}

/// A recipe with its defaults, before drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree(Node);

impl Tree {
    /// The root.
    #[must_use]
    pub fn node(&self) -> &Node {
        &self.0
    }

    /// The value at a path, such as `objects[0].pose`.
    #[must_use]
    pub fn at(&self, path: &str) -> Option<&Node> {
        self.0.at(path)
    }

    /// A section as a plain type; `None` when neither the user nor the defaults have it.
    ///
    /// # Errors
    /// As [`Node::to`]; distributions are refused here, so sections that may have them are drawn first.
    pub fn section<T: DeserializeOwned>(&self, path: &str) -> Result<Option<T>, Error> {
        self.0.at(path).map(|node| node.to(path)).transpose()
    }

    /// The fault of a value that is of the right type but cannot be.
    ///
    /// Points at the value; where nobody wrote it, at the nearest value above it that the user wrote.
    #[must_use]
    pub fn reject(&self, path: &str, message: &str, help: &str) -> Error {
        self.0.error(path, message, help)
    }

    /// Checks the format version, the key `ensonify`.
    ///
    /// # Errors
    /// A version that is missing or that this program does not read.
    pub fn version(&self) -> Result<u32, Error> {
        let Some(node) = self.0.get("ensonify") else {
            let help = format!("write `ensonify: {VERSION}` as the first line: the version of the format");
            return Err(Error::new(&self.0.span, "", "the key `ensonify` is missing", help));
        };
        match node.kind {
            Kind::Int(version) if version == i128::from(VERSION) => Ok(VERSION),
            Kind::Int(version) if version > i128::from(VERSION) => {
                let message = format!("format version {version} is newer than this program, which reads {VERSION}");
                Err(Error::new(&node.span, "ensonify", message, "use a newer ensonify"))
            }
            _ => {
                let message = format!("the format version cannot be {}", node.describe());
                let plan = if node.text().is_some() { "; a plan is given with `--plan FILE`" } else { "" };
                Err(Error::new(&node.span, "ensonify", message, format!("write `ensonify: {VERSION}`{plan}")))
            }
        }
    }
}

#[cfg(test)]
mod tests;
