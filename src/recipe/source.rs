//! Where a value stands: the text it was read from, its line and its column.

use std::fmt;
use std::sync::Arc;

/// Who wrote a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The user: a recipe, a device file, a `--set`.
    Given,
    /// The program: the defaults that are built in.
    BuiltIn,
}

/// A text that values were read from.
#[derive(PartialEq, Eq)]
pub struct Source {
    /// Its name as the user knows it: a path as given, `defaults` or `--set`.
    pub name: String,
    /// Who wrote it.
    pub origin: Origin,
    text: String,
}

impl Source {
    /// A text with its name.
    #[must_use]
    pub fn new(name: &str, text: &str, origin: Origin) -> Arc<Self> {
        Arc::new(Self { name: name.to_owned(), origin, text: text.to_owned() })
    }

    /// The line of that number (1-based) without its break.
    #[must_use]
    pub fn line(&self, number: u32) -> Option<&str> {
        let mut rest = self.text.strip_prefix('\u{feff}').unwrap_or(&self.text);
        for _ in 1..number {
            let end = rest.find(['\n', '\r'])?;
            let width = if rest[end..].starts_with("\r\n") { 2 } else { 1 };
            rest = &rest[end + width..];
        }
        (number > 0).then(|| rest.split(['\n', '\r']).next().unwrap_or(rest))
    }
}

/// A place in a text.
#[derive(Clone)]
pub struct Span {
    /// The text.
    pub source: Arc<Source>,
    /// 1-based; 0 when the whole text is meant.
    pub line: u32,
    /// 1-based, in characters; 0 when the whole text is meant.
    pub column: u32,
}

impl Span {
    /// The text as a whole.
    #[must_use]
    pub fn whole(source: &Arc<Source>) -> Self {
        Self { source: Arc::clone(source), line: 0, column: 0 }
    }

    /// Whether the program wrote what stands here.
    #[must_use]
    pub fn is_built_in(&self) -> bool {
        self.source.origin == Origin::BuiltIn
    }
}

impl PartialEq for Span {
    fn eq(&self, other: &Self) -> bool {
        (self.line, self.column) == (other.line, other.column)
            && (Arc::ptr_eq(&self.source, &other.source) || self.source == other.source)
    }
}

impl Eq for Span {}

/// `recipes/a.yaml:14:5`, or the name alone where the whole text is meant.
impl fmt::Display for Span {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(out, "{}", self.source.name),
            line => write!(out, "{}:{line}:{}", self.source.name, self.column),
        }
    }
}

impl fmt::Debug for Span {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, out)
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_as_yaml_says() {
        let source = Source::new("a", "\u{feff}one\r\ntwo\rthree\n\nfive", Origin::Given);
        let lines: Vec<Option<&str>> = (0..7).map(|n| source.line(n)).collect();
        assert_eq!(lines, [None, Some("one"), Some("two"), Some("three"), Some(""), Some("five"), None]);
    }
}
