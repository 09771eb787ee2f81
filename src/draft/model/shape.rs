//! The form of an answer: the few kinds of JSON that one needs, bounded, as a JSON Schema and as a sketch for the model to read.
//!
//! Fields keep their order: servers write answers in it, and a small model answers better where the plain things come first.

use std::fmt::Write as _;

use serde::ser::{Serialize, SerializeMap as _, Serializer};

/// A form of JSON.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A map of these fields and no others.
    Record(Vec<Field>),
    /// A list of at most so many.
    List(Box<Shape>, u32),
    /// A text of at most so many letters.
    Text(u32),
    /// One of these words.
    Word(Vec<String>),
    /// A whole number, both ends included.
    Whole(i64, i64),
    /// A number, both ends included.
    Number(f64, f64),
    /// This, or `null`.
    OrNull(Box<Shape>),
}

/// A field of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its key.
    pub name: &'static str,
    /// Its value.
    pub shape: Shape,
    /// Whether an answer must have it.
    pub needed: Needed,
}

/// Whether an answer must have a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needed {
    /// It must.
    Always,
    /// It may.
    WhereSaid,
}

impl Shape {
    /// One of these words.
    pub fn word<T: AsRef<str>>(words: impl IntoIterator<Item = T>) -> Self {
        Self::Word(words.into_iter().map(|word| word.as_ref().to_owned()).collect())
    }

    /// A list of at most so many of these.
    #[must_use]
    pub fn list(self, most: u32) -> Self {
        Self::List(Box::new(self), most)
    }

    /// This, or `null`.
    #[must_use]
    pub fn or_null(self) -> Self {
        Self::OrNull(Box::new(self))
    }

    /// A field that every answer has.
    #[must_use]
    pub fn always(self, name: &'static str) -> Field {
        Field { name, shape: self, needed: Needed::Always }
    }

    /// A field that an answer may leave out.
    #[must_use]
    pub fn where_said(self, name: &'static str) -> Field {
        Field { name, shape: self, needed: Needed::WhereSaid }
    }

    /// The form as a model reads it: JSON with kinds for values.
    #[must_use]
    pub fn sketch(&self) -> String {
        let mut out = String::new();
        self.sketch_into(&mut out);
        out
    }

    fn sketch_into(&self, out: &mut String) {
        match self {
            Self::Record(fields) => {
                out.push('{');
                for (number, field) in fields.iter().enumerate() {
                    let comma = if number == 0 { "" } else { ", " };
                    let _ = write!(out, "{comma}\"{}\": ", field.name);
                    field.shape.sketch_into(out);
                }
                out.push('}');
            }
            Self::List(of, _) => {
                out.push('[');
                of.sketch_into(out);
                out.push_str(", …]");
            }
            Self::Text(_) => out.push_str("text"),
            Self::Word(words) => out.push_str(&words.join("|")),
            Self::Whole(..) => out.push_str("whole number"),
            Self::Number(..) => out.push_str("number"),
            Self::OrNull(shape) => {
                shape.sketch_into(out);
                out.push_str(" or null");
            }
        }
    }
}

/// As JSON Schema, in the order of the fields.
impl Serialize for Shape {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Record(fields) => {
                let needed = fields.iter().filter(|field| field.needed == Needed::Always);
                let needed: Vec<&str> = needed.map(|field| field.name).collect();
                let mut map = to.serialize_map(Some(4))?;
                map.serialize_entry("type", "object")?;
                map.serialize_entry("properties", &Properties(fields))?;
                map.serialize_entry("required", &needed)?;
                map.serialize_entry("additionalProperties", &false)?;
                map.end()
            }
            Self::List(of, most) => {
                let mut map = to.serialize_map(Some(3))?;
                map.serialize_entry("type", "array")?;
                map.serialize_entry("items", of)?;
                map.serialize_entry("maxItems", most)?;
                map.end()
            }
            Self::Text(most) => {
                let mut map = to.serialize_map(Some(2))?;
                map.serialize_entry("type", "string")?;
                map.serialize_entry("maxLength", most)?;
                map.end()
            }
            Self::Word(words) => {
                let mut map = to.serialize_map(Some(2))?;
                map.serialize_entry("type", "string")?;
                map.serialize_entry("enum", words)?;
                map.end()
            }
            Self::Whole(least, most) => bounded(to, "integer", least, most),
            Self::Number(least, most) => bounded(to, "number", least, most),
            Self::OrNull(shape) => {
                let mut map = to.serialize_map(Some(1))?;
                map.serialize_entry("anyOf", &(shape, Null))?;
                map.end()
            }
        }
    }
}

fn bounded<S: Serializer, T: Serialize>(to: S, kind: &str, least: &T, most: &T) -> Result<S::Ok, S::Error> {
    let mut map = to.serialize_map(Some(3))?;
    map.serialize_entry("type", kind)?;
    map.serialize_entry("minimum", least)?;
    map.serialize_entry("maximum", most)?;
    map.end()
}

struct Properties<'a>(&'a [Field]);

impl Serialize for Properties<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|field| (field.name, &field.shape)))
    }
}

struct Null;

impl Serialize for Null {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map([("type", "null")])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_form_as_a_schema_and_as_a_sketch() {
        let thing = Shape::Record(vec![Shape::Text(40).always("name"), Shape::Whole(1, 9).where_said("count")]);
        let shape = Shape::Record(vec![
            thing.list(3).always("objects"),
            Shape::word(["mud", "sand"]).or_null().always("bottom"),
            Shape::Number(0.0, 0.5).where_said("a"),
        ]);
        assert_eq!(
            shape.sketch(),
            r#"{"objects": [{"name": text, "count": whole number}, …], "bottom": mud|sand or null, "a": number}"#
        );
        let schema = serde_json::to_string(&shape).expect("JSON");
        assert_eq!(
            schema,
            r#"{"type":"object","properties":{"objects":{"type":"array","items":{"type":"object","properties":{"name":{"type":"string","maxLength":40},"count":{"type":"integer","minimum":1,"maximum":9}},"required":["name"],"additionalProperties":false},"maxItems":3},"bottom":{"anyOf":[{"type":"string","enum":["mud","sand"]},{"type":"null"}]},"a":{"type":"number","minimum":0.0,"maximum":0.5}},"required":["objects","bottom"],"additionalProperties":false}"#
        );
    }
}
