//! Enums of a drawn tree: `{ripples: {…}}` or the bare word `ripples`.

use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Deserializer as _, EnumAccess, IntoDeserializer as _, VariantAccess, Visitor};

use super::de::{Content, Typed};
use super::distribution;
use super::error::{Error, quoted};
use super::fault::Fault;
use super::nearest::listed;
use super::node::{Kind, Node};
use super::path;
use super::source::Span;

/// The kind that was written and its parameters.
pub(super) struct Variant<'a> {
    kind: &'a str,
    span: &'a Span,
    /// Path of the enum itself.
    path: String,
    parameters: Typed<'a>,
}

impl<'a> Variant<'a> {
    /// The kind in `typed`, which must be one of `kinds`: serde checks the word, this the form.
    pub(super) fn of(typed: Typed<'a>, kinds: &[&str]) -> Result<Self, Fault> {
        let Content::Node(node) = typed.content else {
            return Err(typed.expected(&format!("one of {}", listed(kinds)), ""));
        };
        let entries = match &node.kind {
            Kind::Text(word) => return Ok(Self::bare(word, &node.span, typed.path)),
            Kind::Map(entries) => entries,
            _ => {
                let message = format!("expected a kind, found {}", node.describe());
                return Err(typed.fault(message, format!("write one of {}", listed(kinds))));
            }
        };
        if let Some(word) = distribution::word(node).filter(|word| !kinds.contains(word)) {
            let help = format!("write one of {}", listed(kinds));
            return Err(typed.fault(format!("the distribution `{word}` is not drawn here"), help));
        }
        match entries.as_slice() {
            [(key, Node { kind: Kind::Null, .. })] => Ok(Self::bare(&key.text, &key.span, typed.path)),
            [(key, value)] => {
                let parameters = Typed::of(value, path::under(&typed.path, &key.text));
                Ok(Self { kind: &key.text, span: &key.span, path: typed.path, parameters })
            }
            [] => Err(typed.fault("expected a kind, found an empty map", format!("write one of {}", listed(kinds)))),
            [_, (second, _), ..] => {
                let words: Vec<&str> = entries.iter().map(|(key, _)| key.text.as_str()).collect();
                let message = format!("expected one kind, found {}: {}", words.len(), listed(&words));
                let help = format!("keep one of them; the kinds are {}", listed(kinds));
                Err(Fault::Located(Error::new(&second.span, &typed.path, message, help)))
            }
        }
    }

    fn bare(kind: &'a str, span: &'a Span, path: String) -> Self {
        let parameters = Typed { content: Content::Bare { kind, span }, path: path::under(&path, kind) };
        Self { kind, span, path, parameters }
    }
}

impl<'de> EnumAccess<'de> for Variant<'de> {
    type Error = Fault;
    type Variant = Typed<'de>;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Typed<'de>), Fault> {
        let word: StrDeserializer<'_, Fault> = self.kind.into_deserializer();
        match seed.deserialize(word) {
            Ok(value) => Ok((value, self.parameters)),
            Err(fault) => Err(Fault::Located(fault.locate(self.span, &self.path))),
        }
    }
}

/// The parameters of a kind. Faults without a place are theirs.
impl<'de> VariantAccess<'de> for Typed<'de> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        match self.content {
            Content::Bare { .. } => Ok(()),
            Content::Node(node) if matches!(&node.kind, Kind::Map(entries) if entries.is_empty()) => Ok(()),
            Content::Node(node) => match node.entries().first() {
                Some((key, _)) => {
                    let message = format!("unknown key {}", quoted(&key.text));
                    let help = "remove it: this kind has no keys";
                    Err(Fault::Located(Error::new(&key.span, &self.path, message, help)))
                }
                None => Err(self.fault(format!("expected no value, found {}", node.describe()), "remove it")),
            },
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        let (span, path) = (self.span(), self.path.clone());
        seed.deserialize(self).map_err(|fault| Fault::Located(fault.locate(span, &path)))
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        let (span, path) = (self.span(), self.path.clone());
        self.deserialize_tuple(length, visitor).map_err(|fault| Fault::Located(fault.locate(span, &path)))
    }

    fn struct_variant<V: Visitor<'de>>(self, fields: &'static [&'static str], visitor: V) -> Result<V::Value, Fault> {
        let (span, path) = (self.span(), self.path.clone());
        self.deserialize_struct("", fields, visitor).map_err(|fault| Fault::Located(fault.locate(span, &path)))
    }
}
