//! Lists and maps of a drawn tree, item by item: each item's faults get its place.

use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, IntoDeserializer as _, MapAccess, SeqAccess};

use super::de::Typed;
use super::fault::Fault;
use super::node::{Key, Node};
use super::path;

/// The items of a list, one after the other.
pub(super) struct Items<'a, 'p> {
    items: std::slice::Iter<'a, Node>,
    index: usize,
    path: &'p str,
}

impl<'a, 'p> Items<'a, 'p> {
    pub(super) fn of(items: &'a [Node], path: &'p str) -> Self {
        Self { items: items.iter(), index: 0, path }
    }
}

impl<'de> SeqAccess<'de> for Items<'de, '_> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        let Some(node) = self.items.next() else { return Ok(None) };
        let path = path::item(self.path, self.index);
        self.index += 1;
        seed_at(seed, node, path).map(Some)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

/// The entries of a map, one after the other.
pub(super) struct Entries<'a, 'p> {
    entries: std::slice::Iter<'a, (Key, Node)>,
    value: Option<&'a (Key, Node)>,
    path: &'p str,
}

impl<'a, 'p> Entries<'a, 'p> {
    pub(super) fn of(entries: &'a [(Key, Node)], path: &'p str) -> Self {
        Self { entries: entries.iter(), value: None, path }
    }
}

impl<'de> MapAccess<'de> for Entries<'de, '_> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        self.value = self.entries.next();
        let Some((key, _)) = self.value else { return Ok(None) };
        let word: StrDeserializer<'_, Fault> = key.text.as_str().into_deserializer();
        seed.deserialize(word).map(Some).map_err(|fault| Fault::Located(fault.locate(&key.span, self.path)))
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Fault> {
        let (key, node) = self.value.take().expect("serde asks for a value only behind its key");
        seed_at(seed, node, path::under(self.path, &key.text))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.entries.len())
    }
}

/// Deserialises a child; a fault without a place is the child's.
fn seed_at<'de, T: DeserializeSeed<'de>>(seed: T, node: &'de Node, path: String) -> Result<T::Value, Fault> {
    seed.deserialize(Typed::of(node, path.clone())).map_err(|fault| Fault::Located(fault.locate(&node.span, &path)))
}
