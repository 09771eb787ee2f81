//! The error of deserialisation: loose while it travels, located by the first one who knows the place.

use std::fmt;

use serde::de::{Error as SerdeError, Expected, Unexpected};

use super::distribution;
use super::error::{Error, quoted};
use super::nearest::{did_you_mean, listed, nearest};
use super::source::Span;

/// A fault that serde hands up.
#[derive(Debug)]
pub(super) enum Fault {
    /// Its place is known.
    Located(Error),
    /// A key that the struct does not have.
    UnknownKey { key: String, valid: &'static [&'static str] },
    /// A kind that the enum does not have.
    UnknownKind { word: String, valid: &'static [&'static str] },
    /// A key that the struct needs.
    MissingKey(&'static str),
    /// Anything else.
    Other { message: String, help: String },
}

impl Fault {
    /// The error at a place; what is located already keeps its own, which is further in.
    pub(super) fn locate(self, span: &Span, path: &str) -> Error {
        let (message, help) = match self {
            Self::Located(error) => return error,
            Self::UnknownKey { key, valid } => (format!("unknown key {}", quoted(&key)), remedy(&key, valid)),
            Self::UnknownKind { word, valid } => (format!("unknown kind {}", quoted(&word)), remedy(&word, valid)),
            Self::MissingKey(key) => (format!("the key `{key}` is missing"), format!("add `{key}:` and its value")),
            Self::Other { message, help } => (message, help),
        };
        Error::new(span, path, message, help)
    }
}

/// The nearest valid word, or the distribution that was probably meant.
fn remedy(word: &str, valid: &[&str]) -> String {
    match (nearest(word, valid), nearest(word, &distribution::WORDS)) {
        (None, Some(near)) => {
            format!("did you mean the distribution {}? (valid here: {})", quoted(near), listed(valid))
        }
        _ => did_you_mean(word, valid),
    }
}

impl SerdeError for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::Other { message: message.to_string(), help: String::new() }
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::custom(format!("expected {expected}, found {found}"))
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::custom(format!("expected {expected}, found {found}"))
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::custom(format!("expected {expected}, found {length} value{}", if length == 1 { "" } else { "s" }))
    }

    fn unknown_variant(word: &str, valid: &'static [&'static str]) -> Self {
        Self::UnknownKind { word: word.to_owned(), valid }
    }

    fn unknown_field(key: &str, valid: &'static [&'static str]) -> Self {
        Self::UnknownKey { key: key.to_owned(), valid }
    }

    fn missing_field(key: &'static str) -> Self {
        Self::MissingKey(key)
    }
}

impl std::error::Error for Fault {}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Located(error) => fmt::Display::fmt(error, out),
            Self::UnknownKey { key, .. } => write!(out, "unknown key {}", quoted(key)),
            Self::UnknownKind { word, .. } => write!(out, "unknown kind {}", quoted(word)),
            Self::MissingKey(key) => write!(out, "the key `{key}` is missing"),
            Self::Other { message, .. } => out.write_str(message),
        }
    }
}
