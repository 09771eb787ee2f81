//! The shape of a type, asked of the type itself: its `Deserialize` tells what it wants to read.
//!
//! Each pass answers with the first kind of an enum that was not seen yet, or not wholly, until all were.

use std::cell::Cell;

use serde::de::value::{Error, StrDeserializer};
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer as _, MapAccess, SeqAccess,
    VariantAccess, Visitor,
};

/// What a type reads.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    /// Not asked yet.
    Unseen,
    /// Nothing: a kind without parameters.
    Nothing,
    /// True or false.
    Bool,
    /// A whole number.
    Whole,
    /// A number.
    Number,
    /// A text.
    Text,
    /// One of several forms, told apart by the reader.
    Any,
    /// May be left out by `null`.
    Optional(Box<Self>),
    /// Any number of values of a shape.
    List(Box<Self>),
    /// So many values of a shape.
    Tuple(usize, Box<Self>),
    /// Keys with their shapes.
    Map(Vec<(&'static str, Self)>),
    /// One of several kinds, with the shapes of their parameters.
    Kinds(Vec<(&'static str, Self)>),
}

impl Shape {
    /// Whether nothing of it is left to ask for.
    pub(super) fn is_seen(&self) -> bool {
        match self {
            Self::Unseen => false,
            Self::Optional(inner) | Self::List(inner) | Self::Tuple(_, inner) => inner.is_seen(),
            Self::Map(entries) | Self::Kinds(entries) => entries.iter().all(|(_, shape)| shape.is_seen()),
            Self::Nothing | Self::Bool | Self::Whole | Self::Number | Self::Text | Self::Any => true,
        }
    }
}

/// More kinds than any section of a recipe has.
const MOST_PASSES: usize = 256;

/// The shape of a type.
pub(super) fn shape_of<T: DeserializeOwned>() -> Shape {
    let mut shape = Shape::Unseen;
    for _ in 0..MOST_PASSES {
        let more = Cell::new(false);
        // What comes out is of no interest, only what was asked for.
        let _ = T::deserialize(Probe { slot: &mut shape, more: &more });
        if !more.get() {
            break;
        }
    }
    shape
}

/// A place to be filled in.
struct Probe<'a> {
    slot: &'a mut Shape,
    /// Set where another pass sees more.
    more: &'a Cell<bool>,
}

impl<'a> Probe<'a> {
    fn is(&mut self, shape: Shape) {
        if *self.slot == Shape::Unseen {
            *self.slot = shape;
        }
    }

    fn fields<'de, V: Visitor<'de>>(mut self, names: &'static [&'static str], visitor: V) -> Result<V::Value, Error> {
        self.is(Shape::Map(names.iter().map(|name| (*name, Shape::Unseen)).collect()));
        let Shape::Map(entries) = self.slot else { return visitor.visit_unit() };
        visitor.visit_map(Fields { left: entries.iter_mut(), next: None, more: self.more })
    }

    fn repeated<'de, V: Visitor<'de>>(self, count: usize, visitor: V) -> Result<V::Value, Error> {
        match self.slot {
            Shape::List(item) | Shape::Tuple(_, item) => {
                visitor.visit_seq(Repeated { item, left: count, more: self.more })
            }
            _ => visitor.visit_unit(),
        }
    }
}

macro_rules! answer {
    ($($method:ident $shape:ident $visit:ident($($value:expr)?);)*) => {$(
        fn $method<V: Visitor<'de>>(mut self, visitor: V) -> Result<V::Value, Error> {
            self.is(Shape::$shape);
            visitor.$visit($($value)?)
        }
    )*};
}

impl<'de> Deserializer<'de> for Probe<'_> {
    type Error = Error;

    answer! {
        deserialize_bool Bool visit_bool(false);
        deserialize_i8 Whole visit_i64(1);
        deserialize_i16 Whole visit_i64(1);
        deserialize_i32 Whole visit_i64(1);
        deserialize_i64 Whole visit_i64(1);
        deserialize_u8 Whole visit_u64(1);
        deserialize_u16 Whole visit_u64(1);
        deserialize_u32 Whole visit_u64(1);
        deserialize_u64 Whole visit_u64(1);
        deserialize_f32 Number visit_f64(1.0);
        deserialize_f64 Number visit_f64(1.0);
        deserialize_char Text visit_char('x');
        deserialize_str Text visit_str("x");
        deserialize_string Text visit_str("x");
        deserialize_identifier Text visit_str("x");
        deserialize_unit Nothing visit_unit();
        deserialize_ignored_any Any visit_unit();
        // Every enum without a tag reads this word: places have it as a name, others take any.
        deserialize_any Any visit_str("objects");
        deserialize_bytes Any visit_unit();
        deserialize_byte_buf Any visit_unit();
        deserialize_map Any visit_unit();
    }

    fn deserialize_option<V: Visitor<'de>>(mut self, visitor: V) -> Result<V::Value, Error> {
        self.is(Shape::Optional(Box::new(Shape::Unseen)));
        match self.slot {
            Shape::Optional(slot) => visitor.visit_some(Probe { slot, more: self.more }),
            _ => visitor.visit_none(),
        }
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_unit(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(mut self, visitor: V) -> Result<V::Value, Error> {
        self.is(Shape::List(Box::new(Shape::Unseen)));
        self.repeated(1, visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(mut self, length: usize, visitor: V) -> Result<V::Value, Error> {
        self.is(Shape::Tuple(length, Box::new(Shape::Unseen)));
        self.repeated(length, visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.deserialize_tuple(length, visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        names: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.fields(names, visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        mut self,
        _: &'static str,
        kinds: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        self.is(Shape::Kinds(kinds.iter().map(|kind| (*kind, Shape::Unseen)).collect()));
        let Shape::Kinds(kinds) = self.slot else { return visitor.visit_unit() };
        // A kind with kinds within takes several passes; those within ask for theirs.
        let unseen: Vec<usize> = (0..kinds.len()).filter(|&index| !kinds[index].1.is_seen()).collect();
        if unseen.len() > 1 {
            self.more.set(true);
        }
        let index = unseen.first().copied().unwrap_or(0);
        let (kind, slot) = &mut kinds[index];
        visitor.visit_enum(Kind { kind, probe: Probe { slot, more: self.more } })
    }
}

struct Fields<'a> {
    left: std::slice::IterMut<'a, (&'static str, Shape)>,
    next: Option<&'a mut Shape>,
    more: &'a Cell<bool>,
}

impl<'de> MapAccess<'de> for Fields<'_> {
    type Error = Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Error> {
        let Some((name, slot)) = self.left.next() else { return Ok(None) };
        self.next = Some(slot);
        let name: StrDeserializer<'_, Error> = (*name).into_deserializer();
        seed.deserialize(name).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Error> {
        let slot = self.next.take().expect("a value is asked for after its key");
        seed.deserialize(Probe { slot, more: self.more })
    }
}

struct Repeated<'a> {
    item: &'a mut Shape,
    left: usize,
    more: &'a Cell<bool>,
}

impl<'de> SeqAccess<'de> for Repeated<'_> {
    type Error = Error;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Error> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        seed.deserialize(Probe { slot: self.item, more: self.more }).map(Some)
    }
}

struct Kind<'a> {
    kind: &'static str,
    probe: Probe<'a>,
}

impl<'de, 'a> EnumAccess<'de> for Kind<'a> {
    type Error = Error;
    type Variant = Probe<'a>;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Probe<'a>), Error> {
        let kind: StrDeserializer<'_, Error> = self.kind.into_deserializer();
        Ok((seed.deserialize(kind)?, self.probe))
    }
}

impl<'de> VariantAccess<'de> for Probe<'_> {
    type Error = Error;

    fn unit_variant(mut self) -> Result<(), Error> {
        self.is(Shape::Nothing);
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Error> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Error> {
        self.deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(self, names: &'static [&'static str], visitor: V) -> Result<V::Value, Error> {
        self.fields(names, visitor)
    }
}
