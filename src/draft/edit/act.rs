//! The smallest changes of a recipe: put a value, put an item, take something out.

use crate::recipe::{Error, Key, Kind, Node, Origin, Source, Span, Style};

/// One small change of a recipe's tree.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// Puts a value at a path; maps on the way are made.
    Set {
        /// Where.
        path: String,
        /// What.
        value: Node,
    },
    /// Puts an item into a list, before the one of that number; a list that is not there is made.
    Insert {
        /// The list.
        list: String,
        /// Its number there.
        index: usize,
        /// What.
        value: Node,
    },
    /// Takes a value out, with its key.
    Remove {
        /// Where.
        path: String,
    },
}

impl Act {
    /// Puts a value at a path.
    pub fn set(path: impl Into<String>, value: Node) -> Self {
        Self::Set { path: path.into(), value }
    }

    /// Where it acts.
    #[must_use]
    pub fn path(&self) -> &str {
        match self {
            Self::Set { path, .. } | Self::Remove { path } => path,
            Self::Insert { list, .. } => list,
        }
    }

    /// Makes the change in a tree.
    ///
    /// # Errors
    /// A path that leads nowhere.
    pub fn on(&self, tree: &mut Node) -> Result<(), Error> {
        let span = tree.span.clone();
        match self {
            Self::Set { path, value } => tree.put(path, value.clone(), &span),
            Self::Insert { list, index, value } => tree.insert(list, *index, value.clone(), &span),
            Self::Remove { path } => tree.remove(path, &span).map(drop),
        }
    }
}

/// A value that this program made; its place says so.
fn made(kind: Kind) -> Node {
    Node { kind, span: Span::whole(&Source::new("change", "", Origin::Given)) }
}

/// A number; whole where it is.
#[must_use]
pub fn number(value: f64) -> Node {
    let whole = value == value.floor() && value.abs() < 1e15;
    made(if whole { Kind::Int(value as i128) } else { Kind::Float(value) })
}

/// A word.
#[must_use]
pub fn word(text: &str) -> Node {
    made(Kind::Text(text.to_owned()))
}

/// A list.
#[must_use]
pub fn list(items: Vec<Node>) -> Node {
    made(Kind::Seq(items))
}

/// A map.
#[must_use]
pub fn map<'a>(entries: impl IntoIterator<Item = (&'a str, Node)>) -> Node {
    let entry = |(text, value): (&str, Node)| {
        let key = Key { text: text.to_owned(), style: Style::Plain, span: value.span.clone() };
        (key, value)
    };
    made(Kind::Map(entries.into_iter().map(entry).collect()))
}
