//! Adding items to lists of a tree, and taking values out of it.

use super::error::{Error, quoted};
use super::node::{Kind, Node};
use super::path::{Step, steps};
use super::source::Span;

impl Node {
    /// Puts a value into the list at `path`, before the item of that number; a list that is not there yet is made.
    ///
    /// # Errors
    /// A path that leads to something else, or a number behind the end; located at `span`.
    pub fn insert(&mut self, path: &str, index: usize, value: Self, span: &Span) -> Result<(), Error> {
        if self.at(path).is_none_or(|node| node.kind == Kind::Null) {
            self.put(path, Self { kind: Kind::Seq(Vec::new()), span: span.clone() }, span)?;
        }
        match self.at_mut(path).map(|node| &mut node.kind) {
            Some(Kind::Seq(items)) if index <= items.len() => {
                items.insert(index, value);
                Ok(())
            }
            Some(Kind::Seq(items)) => {
                let message = format!("there are but {} items before which to put one", items.len());
                Err(Error::new(span, path, message, "put it at the end"))
            }
            _ => Err(Error::new(span, path, "no list stands here", "write a list")),
        }
    }

    /// Takes the value at `path` out, with its key.
    ///
    /// # Errors
    /// A path that leads nowhere; located at `span`.
    pub fn remove(&mut self, path: &str, span: &Span) -> Result<Self, Error> {
        let nothing = || Error::new(span, path, format!("there is nothing at {}", quoted(path)), "name what is there");
        let steps = steps(path).map_err(|_| nothing())?;
        let (last, way) = steps.split_last().ok_or_else(nothing)?;
        let around = way.iter().try_fold(self, |node, step| node.step_mut(step)).ok_or_else(nothing)?;
        match (&mut around.kind, last) {
            (Kind::Seq(items), Step::Index(index)) if *index < items.len() => Ok(items.remove(*index)),
            (Kind::Map(entries), Step::Key(key)) => {
                let index = entries.iter().position(|(k, _)| k.text == *key).ok_or_else(nothing)?;
                Ok(entries.remove(index).1)
            }
            _ => Err(nothing()),
        }
    }

    fn at_mut(&mut self, path: &str) -> Option<&mut Self> {
        steps(path).ok()?.iter().try_fold(self, |node, step| node.step_mut(step))
    }

    fn step_mut(&mut self, step: &Step) -> Option<&mut Self> {
        match (&mut self.kind, step) {
            (Kind::Map(entries), Step::Key(key)) => entries.iter_mut().find(|(k, _)| k.text == *key).map(|(_, v)| v),
            (Kind::Seq(items), Step::Index(index)) => items.get_mut(*index),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::recipe::{Origin, parse};

    #[test]
    fn items_come_and_values_go() {
        let mut tree = parse("a", "{a: [1, 3], b: {c: 1, d: 2}, e: }", Origin::Given).unwrap();
        let value = parse("b", "2", Origin::Given).unwrap();
        let span = value.span.clone();
        for (path, index) in [("a", 1), ("e", 0), ("b.f", 0)] {
            tree.insert(path, index, value.clone(), &span).unwrap();
        }
        assert_eq!(tree.remove("b.c", &span).unwrap().number(), Some(1.0));
        assert_eq!(tree.remove("a[0]", &span).unwrap().number(), Some(1.0));
        assert_eq!(tree.json().to_string(), r#"{"a":[2,3],"b":{"d":2,"f":[2]},"e":[2]}"#);
        for path in ["", "a[2]", "b.c", "b[0]", "a.x", "a["] {
            assert!(tree.remove(path, &span).is_err(), "{path}");
        }
        assert!(tree.insert("a", 3, value.clone(), &span).is_err() && tree.insert("b", 0, value, &span).is_err());
    }
}
