//! The recipe that is to be changed: its text, and where its values come from.

use std::path::{Path, PathBuf};

use super::act::Act;
use super::text::apply;
use crate::recipe::path::under;
use crate::recipe::{Error, Node, Outside, Recipe, Tree};

/// A recipe under change.
#[derive(Clone, Debug)]
pub struct Subject {
    path: PathBuf,
    outside: Outside,
    text: String,
    /// What the file itself says.
    own: Recipe,
    /// With what it includes.
    whole: Recipe,
    /// With the defaults, too.
    completed: Tree,
}

/// Who says a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// The recipe's own text.
    Own,
    /// A file that it includes.
    Included,
    /// The built-in defaults.
    Default,
}

impl Subject {
    /// A recipe that stands, or is to stand, in the file at `path`.
    ///
    /// # Errors
    /// A text that is no recipe, or includes what cannot be read.
    pub fn new(path: &Path, text: &str, outside: Outside) -> Result<Self, Error> {
        let own = Recipe::parse(&path.display().to_string(), text)?;
        let whole = Recipe::parse_whole(path, text, outside)?.0;
        let completed = whole.completed();
        Ok(Self { path: path.to_owned(), outside, text: text.to_owned(), own, whole, completed })
    }

    /// Its text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The recipe with a change made.
    ///
    /// # Errors
    /// As [`apply`].
    pub fn with(&self, act: &Act) -> Result<Self, Error> {
        let text = apply(&self.path.display().to_string(), &self.text, act)?;
        Self::new(&self.path, &text, self.outside)
    }

    /// The tree of its own text.
    #[must_use]
    pub fn own(&self) -> &Node {
        self.own.node()
    }

    /// A value, without defaults, and whose it is.
    #[must_use]
    pub fn said(&self, path: &str) -> Option<(&Node, Whose)> {
        match (self.own.node().at(path), self.whole.node().at(path)) {
            (Some(own), _) => Some((own, Whose::Own)),
            (None, Some(below)) => Some((below, Whose::Included)),
            (None, None) => None,
        }
    }

    /// A value, and whose it is.
    #[must_use]
    pub fn value(&self, path: &str) -> Option<(&Node, Whose)> {
        self.said(path).or_else(|| self.completed.at(path).map(|node| (node, Whose::Default)))
    }

    /// A kind and every other that may be drawn in its stead: path of its parameters, and its name. A bare word is a kind.
    #[must_use]
    pub fn kinds(&self, path: &str) -> Vec<(String, String)> {
        let Some((node, _)) = self.said(path) else { return Vec::new() };
        let choices = node.get("choice");
        let mut kinds = Vec::new();
        let list = choices.map_or(&[][..], Node::items).iter().enumerate();
        for (index, item) in list {
            kinds.extend(kind_of(item).map(|kind| (under(&format!("{path}.choice[{index}]"), kind), kind.to_owned())));
        }
        for (key, _) in choices.map_or(&[][..], Node::entries) {
            kinds.push((under(&format!("{path}.choice"), &key.text), key.text.clone()));
        }
        if !node.is_distribution() {
            kinds.extend(kind_of(node).map(|kind| (under(path, kind), kind.to_owned())));
        }
        kinds
    }

    /// Paths at which a value of `water` or `image` stands in looks, and how many looks there are.
    #[must_use]
    pub fn in_looks(&self, path: &str) -> (Vec<String>, usize) {
        let looks = self.said("looks").map_or(&[][..], |(node, _)| node.items());
        let paths = (0..looks.len()).map(|index| format!("looks[{index}].{path}"));
        (paths.filter(|path| self.said(path).is_some()).collect(), looks.len())
    }

    /// Path of the list of values over which a path is swept, if it is.
    #[must_use]
    pub fn swept(&self, path: &str) -> Option<String> {
        let lists = ["sweep.grid", "sweep.zip"].map(|list| under(list, path));
        lists.into_iter().find(|list| self.said(list).is_some())
    }

    /// How many variants a sweep makes.
    #[must_use]
    pub fn variants(&self) -> usize {
        let count = |path: &str, of: fn(&Node) -> usize| self.said(path).map_or(1, |(node, _)| of(node).max(1));
        let product = |node: &Node| node.entries().iter().map(|(_, values)| values.items().len().max(1)).product();
        let longest = |node: &Node| node.entries().first().map_or(1, |(_, values)| values.items().len());
        let repeats = |node: &Node| node.number().map_or(1, |number| number as usize);
        count("sweep.grid", product) * count("sweep.zip", longest) * count("sweep.count", repeats)
    }

    /// How often a name of `let` stands in the recipe.
    #[must_use]
    pub fn uses_of(&self, name: &str) -> usize {
        fn count(node: &Node, wanted: &str) -> usize {
            let below: usize =
                node.entries().iter().map(|(_, value)| value).chain(node.items()).map(|n| count(n, wanted)).sum();
            below + usize::from(node.text() == Some(wanted))
        }
        count(self.whole.node(), &format!("${name}"))
    }
}

fn kind_of(node: &Node) -> Option<&str> {
    node.text().or_else(|| match node.entries() {
        [(key, _)] if !node.is_distribution() => Some(key.text.as_str()),
        _ => None,
    })
}
