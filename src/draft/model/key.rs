//! The key of a server: from the environment only, and nowhere else ever after.
//!
//! It is not printed, not written, and taken out of whatever a server sends back before anyone sees it.

use std::fmt;

use super::{Fault, ModelError};

/// Variables that a key may stand in; the first that is set counts.
const VARIABLES: [&str; 2] = ["ENSONIFY_LLM_KEY", "OPENAI_API_KEY"];

/// What stands in a text where the key stood.
const HIDDEN: &str = "[key]";

/// A secret that only the header of a request shows.
#[derive(Clone, PartialEq, Eq)]
pub struct Key(String);

impl Key {
    /// The key of this process's environment, if there is one.
    ///
    /// # Errors
    /// A key that no header can carry; the message names the variable.
    pub fn of_environment() -> Result<Option<Self>, ModelError> {
        for variable in VARIABLES {
            let Some(value) = std::env::var_os(variable) else { continue };
            let Some(text) = value.to_str() else { return Err(unusable(variable)) };
            if text.trim().is_empty() {
                continue;
            }
            return Self::new(text).map(Some).ok_or_else(|| unusable(variable));
        }
        Ok(None)
    }

    /// A key, or none where the text is not one: letters, digits and signs of ASCII.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let text = text.trim();
        (!text.is_empty() && text.bytes().all(|byte| byte.is_ascii_graphic())).then(|| Self(text.to_owned()))
    }

    /// The value of the header `Authorization`.
    pub(super) fn header(&self) -> String {
        format!("Bearer {}", self.0)
    }

    /// A text without the key.
    #[must_use]
    pub fn hidden_in(&self, text: &str) -> String {
        text.replace(&self.0, HIDDEN)
    }
}

fn unusable(variable: &'static str) -> ModelError {
    ModelError { host: variable.to_owned(), fault: Fault::Key }
}

impl fmt::Debug for Key {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(HIDDEN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_shows_itself_to_the_server_only() {
        let key = Key::new(" sk-secret ").expect("a key");
        assert_eq!(format!("{key:?}"), "[key]");
        assert_eq!(key.header(), "Bearer sk-secret");
        assert_eq!(key.hidden_in("Incorrect API key: sk-secret."), "Incorrect API key: [key].");
    }

    #[test]
    fn no_key_ends_a_header() {
        assert_eq!(Key::new("a\r\nHost: elsewhere"), None);
        assert_eq!(Key::new("schlüssel"), None);
        assert_eq!(Key::new("  "), None);
    }
}
