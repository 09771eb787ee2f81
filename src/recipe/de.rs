//! A drawn tree to plain structs: a serde deserializer whose errors name the place.
//!
//! An enum is written `{ripples: {…}}`, or as the bare word `ripples`, which means `{ripples: {}}`.

use serde::de::{DeserializeOwned, Deserializer, Visitor};

use super::de_enum::Variant;
use super::de_items::{Entries, Items};
use super::distribution;
use super::error::{Error, quoted};
use super::fault::Fault;
use super::nearest::{did_you_mean, listed, nearest};
use super::node::{Key, Kind, Node};
use super::source::Span;

impl Node {
    /// The value as a plain type; `path` is where this node stands in the recipe, for messages.
    ///
    /// # Errors
    /// Unknown and missing keys, unknown kinds, values of another type: with the place of the innermost value at fault.
    pub fn to<T: DeserializeOwned>(&self, path: &str) -> Result<T, Error> {
        T::deserialize(Typed::of(self, path.to_owned())).map_err(|fault| fault.locate(&self.span, path))
    }
}

/// A value on its way to a type.
#[derive(Clone, Debug)]
pub(super) struct Typed<'a> {
    pub(super) content: Content<'a>,
    pub(super) path: String,
}

/// What there is to read.
#[derive(Clone, Copy, Debug)]
pub(super) enum Content<'a> {
    /// A value.
    Node(&'a Node),
    /// The parameters of a kind that stands there as a bare word.
    Bare { kind: &'a str, span: &'a Span },
}

impl<'a> Typed<'a> {
    pub(super) fn of(node: &'a Node, path: String) -> Self {
        Self { content: Content::Node(node), path }
    }

    pub(super) fn span(&self) -> &'a Span {
        match self.content {
            Content::Node(node) => &node.span,
            Content::Bare { span, .. } => span,
        }
    }

    fn kind(&self) -> Option<&'a Kind> {
        if let Content::Node(node) = self.content { Some(&node.kind) } else { None }
    }

    pub(super) fn fault(&self, message: impl Into<String>, help: impl Into<String>) -> Fault {
        Fault::Located(Error::new(self.span(), &self.path, message, help))
    }

    /// The fault of a value of another type than `wanted` ("a number").
    pub(super) fn expected(&self, wanted: &str, help: &str) -> Fault {
        let node = match self.content {
            Content::Bare { kind, .. } => {
                return self.fault(format!("{} needs {wanted}", quoted(kind)), format!("write {{{kind}: …}}"));
            }
            Content::Node(node) => node,
        };
        if let Some(word) = distribution::word(node) {
            return self.fault(format!("the distribution `{word}` is not drawn here"), format!("write {wanted}"));
        }
        let suspect =
            |(key, _): &&(Key, Node)| node.entries().len() == 1 || nearest(&key.text, &distribution::WORDS).is_some();
        match node.entries().iter().find(suspect) {
            Some((key, _)) => {
                let message = format!("expected {wanted}, found the unknown distribution {}", quoted(&key.text));
                let help = did_you_mean(&key.text, &distribution::WORDS);
                Fault::Located(Error::new(&key.span, &self.path, message, help))
            }
            None => self.fault(format!("expected {wanted}, found {}", node.describe()), help),
        }
    }

    /// The whole number, if it fits the type with these bounds.
    fn whole<T: TryFrom<i128>>(&self, low: i128, high: i128) -> Result<T, Fault> {
        let wanted = "a whole number";
        match self.kind() {
            Some(Kind::Int(value)) => T::try_from(*value).map_err(|_| {
                self.fault(
                    format!("{value} is not a whole number from {low} to {high}"),
                    "choose a number in that range",
                )
            }),
            Some(Kind::Float(_)) => Err(self.expected(wanted, "round it; drawn whole numbers are {int: [low, high]}")),
            _ => Err(self.expected(wanted, "write digits without quotes")),
        }
    }

    fn float(&self) -> Result<f64, Fault> {
        match self.kind() {
            Some(Kind::Int(value)) => Ok(*value as f64),
            Some(Kind::Float(value)) => Ok(*value),
            _ => Err(self.expected("a number", "write digits without quotes and unit; the unit stands in the key")),
        }
    }

    fn string(&self) -> Result<&'a str, Fault> {
        match self.kind() {
            Some(Kind::Text(text)) => Ok(text),
            Some(Kind::Bool(_) | Kind::Int(_) | Kind::Float(_)) => Err(self.expected("a text", "put it in quotes")),
            _ => Err(self.expected("a text", "")),
        }
    }

    fn list<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.kind() {
            Some(Kind::Seq(items)) => visitor.visit_seq(Items::of(items, &self.path)),
            _ => Err(self.expected("a list", "write [a, b, …]")),
        }
    }

    /// The map; a bare kind has an empty one.
    fn map<V: Visitor<'a>>(self, fields: &[&str], visitor: V) -> Result<V::Value, Fault> {
        let entries: &'a [(Key, Node)] = match self.content {
            Content::Bare { .. } => &[],
            Content::Node(node) => match &node.kind {
                Kind::Map(entries) => {
                    self.refuse_distribution(node, fields)?;
                    entries
                }
                _ => return Err(self.not_a_map(node, fields)),
            },
        };
        visitor.visit_map(Entries::of(entries, &self.path))
    }

    /// A struct is not read from a distribution; a map of free keys (no `fields`) may have any words.
    fn refuse_distribution(&self, node: &Node, fields: &[&str]) -> Result<(), Fault> {
        match distribution::word(node) {
            Some(word) if !fields.is_empty() && !fields.contains(&word) => {
                let help = format!("write the keys out: {}", listed(fields));
                Err(self.fault(format!("the distribution `{word}` is not drawn here"), help))
            }
            _ => Ok(()),
        }
    }

    fn not_a_map(&self, node: &Node, fields: &[&str]) -> Fault {
        let keys = if fields.is_empty() {
            "write `key: value` lines".to_owned()
        } else {
            format!("its keys are {}", listed(fields))
        };
        let help = match node.kind {
            Kind::Null => format!("remove the key to take the defaults, or write a map; {keys}"),
            _ => keys,
        };
        self.fault(format!("expected a map, found {}", node.describe()), help)
    }
}

macro_rules! whole_numbers {
    ($($method:ident, $visit:ident, $type:ty;)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
            let value = self.whole(i128::from(<$type>::MIN), i128::from(<$type>::MAX))?;
            visitor.$visit::<Fault>(value).map_err(|fault| Fault::Located(fault.locate(self.span(), &self.path)))
        }
    )*};
}

impl<'de> Deserializer<'de> for Typed<'de> {
    type Error = Fault;

    whole_numbers! {
        deserialize_i8, visit_i8, i8;
        deserialize_i16, visit_i16, i16;
        deserialize_i32, visit_i32, i32;
        deserialize_i64, visit_i64, i64;
        deserialize_u8, visit_u8, u8;
        deserialize_u16, visit_u16, u16;
        deserialize_u32, visit_u32, u32;
        deserialize_u64, visit_u64, u64;
    }

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.kind() {
            None => self.map(&[], visitor),
            Some(Kind::Null) => visitor.visit_unit(),
            Some(Kind::Bool(value)) => visitor.visit_bool(*value),
            Some(Kind::Int(value)) => match (u64::try_from(*value), i64::try_from(*value)) {
                (Ok(value), _) => visitor.visit_u64(value),
                (_, Ok(value)) => visitor.visit_i64(value),
                _ => Err(self.fault(format!("{value} is too large"), "choose a smaller number")),
            },
            Some(Kind::Float(value)) => visitor.visit_f64(*value),
            Some(Kind::Text(text)) => visitor.visit_str(text),
            Some(Kind::Seq(_)) => self.list(visitor),
            Some(Kind::Map(_)) => self.map(&[], visitor),
        }
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.kind() {
            Some(Kind::Bool(value)) => visitor.visit_bool(*value),
            _ => Err(self.expected("true or false", "write true or false without quotes")),
        }
    }

    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let value = self.float()?;
        if value.abs() > f64::from(f32::MAX) {
            return Err(self.fault(format!("the number {value:?} is too large"), "choose a smaller number"));
        }
        visitor.visit_f64(value)
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_f64(self.float()?)
    }

    fn deserialize_char<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_str(self.string()?)
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_str(self.string()?)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_str(self.string()?)
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_str(self.string()?)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.kind() {
            Some(Kind::Null) => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.kind() {
            None | Some(Kind::Null) => visitor.visit_unit(),
            _ => Err(self.expected("nothing", "remove the value")),
        }
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_unit(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.list(visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        match self.kind() {
            Some(Kind::Seq(items)) if items.len() != length => {
                Err(self
                    .fault(format!("expected {length} values, found {}", items.len()), "complete or shorten the list"))
            }
            Some(Kind::Seq(_)) => self.list(visitor),
            _ => Err(self.expected(&format!("a list of {length} values"), "write [a, b, …]")),
        }
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_tuple(length, visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.map(&[], visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.map(fields, visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        kinds: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_enum(Variant::of(self, kinds)?)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }

    serde::forward_to_deserialize_any! { bytes byte_buf }
}

#[cfg(test)]
mod tests;
