//! Gzipped JSON maps that may be cut off: what is whole is read, the rest is told of.

use std::borrow::Cow;
use std::fmt;
use std::fs;
use std::io::{self, Read as _};
use std::marker::PhantomData;
use std::path::Path;

use flate2::read::MultiGzDecoder;
use serde::Deserialize;
use serde::de::{Deserializer as _, MapAccess, Visitor};

/// Largest file that is unpacked, bytes: a shard of 5000 records has 20 million.
const MOST: u64 = 1 << 30;

/// The text of a file, as far as it goes.
pub(super) struct Contents {
    pub bytes: Vec<u8>,
    /// Why it ends early, if it does.
    cut: Option<String>,
}

impl Contents {
    /// Unpacks a file.
    pub fn read(file: &Path) -> io::Result<Self> {
        let packed = fs::read(file)?;
        let mut bytes = Vec::with_capacity(packed.len() * 6);
        let mut cut = match MultiGzDecoder::new(packed.as_slice()).take(MOST + 1).read_to_end(&mut bytes) {
            Ok(_) => None,
            Err(error) => Some(error.to_string()),
        };
        if bytes.len() as u64 > MOST {
            cut = Some(format!("it unpacks to more than {MOST} bytes"));
        }
        Ok(Self { bytes, cut })
    }

    /// What is wrong with the file, if anything, after so many entries were read.
    pub fn problem(&self, parsed: Result<(), serde_json::Error>, entries: usize) -> Option<String> {
        let why = match (&self.cut, parsed) {
            (None, Ok(())) => return None,
            (Some(cut), _) => format!("is cut off or broken ({cut})"),
            (None, Err(error)) => format!("is no map of JSON objects ({error})"),
        };
        Some(format!("{why}; {entries} entries were read, delete it and download it again"))
    }
}

/// Hands out every entry of a JSON map until its end or its first fault.
pub(super) fn each_entry<'de, V: Deserialize<'de>>(
    json: &'de [u8],
    take: impl FnMut(Cow<'de, str>, V),
) -> Result<(), serde_json::Error> {
    struct Entries<V, F>(F, PhantomData<V>);
    impl<'de, V: Deserialize<'de>, F: FnMut(Cow<'de, str>, V)> Visitor<'de> for Entries<V, F> {
        type Value = ();

        fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
            out.write_str("a map")
        }

        fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<(), A::Error> {
            while let Some(Text(key)) = map.next_key()? {
                (self.0)(key, map.next_value()?);
            }
            Ok(())
        }
    }
    serde_json::Deserializer::from_slice(json).deserialize_map(Entries(take, PhantomData))
}

/// A text, borrowed where it has no escapes; `null` is an empty one, a number its digits.
#[derive(Clone, Debug, Default)]
pub(super) struct Text<'a>(pub Cow<'a, str>);

impl<'de: 'a, 'a> Deserialize<'de> for Text<'a> {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Cow<'de, str>;

            fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                out.write_str("a text")
            }

            fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Self::Value, E> {
                Ok(Cow::Borrowed(text))
            }

            fn visit_str<E>(self, text: &str) -> Result<Self::Value, E> {
                Ok(Cow::Owned(text.to_owned()))
            }

            fn visit_unit<E>(self) -> Result<Self::Value, E> {
                Ok(Cow::Borrowed(""))
            }

            fn visit_u64<E>(self, number: u64) -> Result<Self::Value, E> {
                Ok(Cow::Owned(number.to_string()))
            }

            fn visit_i64<E>(self, number: i64) -> Result<Self::Value, E> {
                Ok(Cow::Owned(number.to_string()))
            }

            fn visit_f64<E>(self, number: f64) -> Result<Self::Value, E> {
                Ok(Cow::Owned(number.to_string()))
            }
        }
        from.deserialize_any(Any).map(Text)
    }
}
