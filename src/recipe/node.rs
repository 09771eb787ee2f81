//! The located tree: every value knows where it was written.
//!
//! Knows nothing of what the values mean.

use super::error::{Error, quoted};
use super::nearest::did_you_mean;
use super::path::{Step, steps};
use super::source::Span;

/// A value and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The value.
    pub kind: Kind,
    /// Where it stands: its first character, or its key where it begins on a later line than its key.
    pub span: Span,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// `null`, `~` or nothing.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A whole number that fits `i64` or `u64`.
    Int(i128),
    /// Any other number; finite.
    Float(f64),
    /// A word or a quoted text.
    Text(String),
    /// A list.
    Seq(Vec<Node>),
    /// Keys and values in the order of the file; no key stands twice.
    Map(Vec<(Key, Node)>),
}

/// A key of a map and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// The key.
    pub text: String,
    /// How it was written.
    pub style: Style,
    /// Where it stands.
    pub span: Span,
}

/// How a scalar was written: `12` plain is a number, quoted it is a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Without quotes.
    Plain,
    /// In quotes or as a block.
    Quoted,
}

impl Node {
    /// The value under a key of a map.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Self> {
        self.entries().iter().find(|(k, _)| k.text == key).map(|(_, value)| value)
    }

    /// The value at a path below this one, such as `objects[0].pose`; the empty path is this value.
    #[must_use]
    pub fn at(&self, path: &str) -> Option<&Self> {
        steps(path).ok()?.iter().try_fold(self, |node, step| node.step(step))
    }

    /// The entries of a map; nothing for other values.
    #[must_use]
    pub fn entries(&self) -> &[(Key, Self)] {
        if let Kind::Map(entries) = &self.kind { entries } else { &[] }
    }

    /// The items of a list; nothing for other values.
    #[must_use]
    pub fn items(&self) -> &[Self] {
        if let Kind::Seq(items) = &self.kind { items } else { &[] }
    }

    /// The word or text.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        if let Kind::Text(text) = &self.kind { Some(text) } else { None }
    }

    /// The number, whole or not.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self.kind {
            Kind::Int(value) => Some(value as f64),
            Kind::Float(value) => Some(value),
            _ => None,
        }
    }

    /// How many values there are in it, itself included.
    #[must_use]
    pub fn size(&self) -> usize {
        1 + self.entries().iter().map(|(_, value)| value).chain(self.items()).map(Self::size).sum::<usize>()
    }

    /// The value without its places, keys in alphabetical order.
    #[must_use]
    pub fn json(&self) -> serde_json::Value {
        use serde_json::Value;
        match &self.kind {
            Kind::Null => Value::Null,
            Kind::Bool(value) => Value::from(*value),
            Kind::Int(value) => serde_json::Number::from_i128(*value).map_or(Value::Null, Value::Number),
            Kind::Float(value) => Value::from(*value),
            Kind::Text(text) => Value::from(text.as_str()),
            Kind::Seq(items) => items.iter().map(Self::json).collect(),
            Kind::Map(entries) => entries.iter().map(|(key, value)| (key.text.clone(), value.json())).collect(),
        }
    }

    /// A fault of the value at a path below this one, found by someone who knows what it means.
    ///
    /// Points at the value; where nobody wrote it, at the nearest value above it that the user wrote.
    #[must_use]
    pub fn error(&self, path: &str, message: &str, help: &str) -> Error {
        let mut node = self;
        let mut best = self;
        for step in steps(path).unwrap_or_default() {
            let Some(next) = node.step(&step) else { break };
            node = next;
            if !node.span.is_built_in() || best.span.is_built_in() {
                best = node;
            }
        }
        let note = match (node.span.is_built_in(), help.is_empty()) {
            (false, _) => String::new(),
            (true, true) => "the value comes from the defaults".to_owned(),
            (true, false) => " (the value comes from the defaults)".to_owned(),
        };
        Error::new(&best.span, path, message, format!("{help}{note}"))
    }

    /// Refuses keys other than `valid` in the map at this node; `path` is its own path, for the message.
    ///
    /// # Errors
    /// The first key that is not valid, with the nearest valid one.
    pub fn allow_keys(&self, path: &str, valid: &[&str]) -> Result<(), Error> {
        match self.entries().iter().find(|(key, _)| !valid.contains(&key.text.as_str())) {
            Some((key, _)) => Err(unknown_key(key, path, valid)),
            None => Ok(()),
        }
    }

    /// What it is, for messages: "the number 5", "a list".
    pub(crate) fn describe(&self) -> String {
        match &self.kind {
            Kind::Null => "nothing".to_owned(),
            Kind::Bool(value) => format!("`{value}`"),
            Kind::Int(value) => format!("the number {value}"),
            Kind::Float(value) => format!("the number {value:?}"),
            Kind::Text(text) => format!("the text {}", quoted(text)),
            Kind::Seq(_) => "a list".to_owned(),
            Kind::Map(_) => "a map".to_owned(),
        }
    }

    pub(super) fn step(&self, step: &Step) -> Option<&Self> {
        match step {
            Step::Key(key) => self.get(key),
            Step::Index(index) => self.items().get(*index),
        }
    }
}

/// The fault of a key that does not belong into the map at `path`.
pub(crate) fn unknown_key(key: &Key, path: &str, valid: &[&str]) -> Error {
    Error::new(&key.span, path, format!("unknown key {}", quoted(&key.text)), did_you_mean(&key.text, valid))
}

#[cfg(test)]
mod tests {
    use crate::recipe::{Origin, parse};

    #[test]
    fn paths_find_values() {
        let tree = parse("a", "objects:\n  - {pose: {rest: {burial: 0.5}}}\n\"a.b\": 3\n", Origin::Given).unwrap();
        assert_eq!(tree.at("objects[0].pose.rest.burial").unwrap().number(), Some(0.5));
        assert_eq!(tree.at("[\"a.b\"]").unwrap().number(), Some(3.0));
        assert_eq!(tree.at(""), Some(&tree));
        for absent in ["objects[1]", "objects.pose", "nothing", "a.b", "objects[0"] {
            assert!(tree.at(absent).is_none(), "{absent}");
        }
        assert_eq!(tree.json().to_string(), r#"{"a.b":3,"objects":[{"pose":{"rest":{"burial":0.5}}}]}"#);
    }

    #[test]
    fn faults_point_at_what_the_user_wrote() {
        let tree = parse("a", "name: x\nsonar:\n  range_m: [5, 2]\n", Origin::Given).unwrap();
        let place = |path| tree.error(path, "bad", "").span.to_string();
        assert_eq!(place("sonar.range_m"), "a:3:12");
        assert_eq!(place("sonar.range_m[1]"), "a:3:16");
        assert_eq!(place("sonar.mount.yaw_deg"), "a:2:1");
        assert_eq!(place("water"), "a:1:1");
        let defaults = parse("defaults", "sonar: {beams: 5}", Origin::BuiltIn).unwrap();
        let error = tree.merged_over(&defaults).error("sonar.beams", "too few", "write more");
        assert_eq!((error.span.to_string().as_str(), error.path.as_str()), ("a:2:1", "sonar.beams"));
        assert_eq!(error.help, "write more (the value comes from the defaults)");
    }

    #[test]
    fn keys_can_be_limited() {
        let tree = parse("a", "name: x\nsonnar: 1\n", Origin::Given).unwrap();
        let error = tree.allow_keys("", &["name", "sonar"]).unwrap_err();
        assert_eq!((error.line(), error.column()), (Some(2), Some(1)));
        assert_eq!(error.help, "did you mean `sonar`? (valid: name, sonar)");
        assert!(tree.allow_keys("", &["name", "sonnar"]).is_ok());
    }
}
