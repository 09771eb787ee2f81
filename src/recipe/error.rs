//! What is wrong, where it stands and what to do about it, as one compact block of text.

use std::fmt;

use super::source::Span;

/// A fault in a recipe.
///
/// `Display` gives the block that a person reads:
/// ```text
/// recipes/a.yaml:14:5: unknown key `wavelenth_m` in seabed.shape.ripples
///   14 |     wavelenth_m: 0.2
///      |     ^
/// help: did you mean `wavelength_m`? (valid: wavelength_m, height_m)
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// Where it stands.
    pub span: Span,
    /// Path of the value at fault, such as `objects[0].pose.rest.burial`; empty at the root.
    pub path: String,
    /// What is wrong.
    pub message: String,
    /// What to do; empty when there is nothing to say.
    pub help: String,
}

/// Widest piece of a source line that is shown, in characters.
const SHOWN: usize = 110;

impl Error {
    /// A fault at a place.
    #[must_use]
    pub fn new(span: &Span, path: &str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { span: span.clone(), path: path.to_owned(), message: message.into(), help: help.into() }
    }

    /// Name of the text at fault, such as `recipes/a.yaml`.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.span.source.name
    }

    /// 1-based line, if the fault is not of the whole text.
    #[must_use]
    pub fn line(&self) -> Option<u32> {
        (self.span.line > 0).then_some(self.span.line)
    }

    /// 1-based column in characters, if the fault is not of the whole text.
    #[must_use]
    pub fn column(&self) -> Option<u32> {
        (self.span.line > 0).then_some(self.span.column)
    }

    /// The line of text at fault, if it is known.
    #[must_use]
    pub fn source_line(&self) -> Option<&str> {
        self.span.source.line(self.span.line)
    }
}

impl std::error::Error for Error {}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}: {}", printable(&self.span.to_string()), printable(&self.message))?;
        if !self.path.is_empty() {
            write!(out, " in {}", printable(&self.path))?;
        }
        if let Some(line) = self.source_line().filter(|line| !line.trim().is_empty()) {
            let column = (self.span.column as usize).saturating_sub(1);
            let start = (column + 20).saturating_sub(SHOWN);
            let shown: String = line.chars().skip(start).take(SHOWN).map(visible).collect();
            let number = self.span.line.to_string();
            let gutter = " ".repeat(number.len());
            write!(
                out,
                "\n  {number} | {}\n  {gutter} | {}^",
                shown.trim_end(),
                " ".repeat(column - start.min(column))
            )?;
        }
        if !self.help.is_empty() {
            write!(out, "\nhelp: {}", printable(&self.help))?;
        }
        Ok(())
    }
}

/// A word or text in a message: in backticks, cut when long.
pub(crate) fn quoted(text: &str) -> String {
    match text.char_indices().nth(48) {
        Some((end, _)) => format!("`{}…`", &text[..end]),
        None => format!("`{text}`"),
    }
}

/// Control characters of a quoted text must not reach a terminal.
pub(crate) fn printable(text: &str) -> String {
    let escape = |c: char| if c.is_control() { c.escape_default().collect() } else { String::from(c) };
    text.chars().map(escape).collect()
}

/// One column for one character, so that the caret stands under its place.
fn visible(c: char) -> char {
    if c == '\t' {
        ' '
    } else if c.is_control() {
        '·'
    } else {
        c
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::source::{Origin, Source};

    fn at(text: &str, line: u32, column: u32) -> Span {
        Span { source: Source::new("a.yaml", text, Origin::Given), line, column }
    }

    #[test]
    fn the_block_shows_place_line_and_remedy() {
        let span = at("water:\n\tdepth: 3\n", 2, 2);
        let error = Error::new(&span, "water", "unknown key `depth`", "did you mean `depth_m`?");
        let block =
            "a.yaml:2:2: unknown key `depth` in water\n  2 |  depth: 3\n    |  ^\nhelp: did you mean `depth_m`?";
        assert_eq!(error.to_string(), block);
        assert_eq!((error.file(), error.line(), error.column()), ("a.yaml", Some(2), Some(2)));
    }

    #[test]
    fn a_whole_file_has_no_line() {
        let error = Error::new(&at("x", 0, 0), "", "is empty", "");
        assert_eq!(error.to_string(), "a.yaml: is empty");
        assert_eq!((error.line(), error.column()), (None, None));
    }

    #[test]
    fn long_lines_are_cut_around_the_column_and_escapes_shown() {
        let long = format!("{}here{}", "x".repeat(5_000), "y".repeat(5_000));
        let text = Error::new(&at(&long, 1, 5_001), "", "bad \u{1b}[31m", "").to_string();
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].ends_with(r"bad \u{1b}[31m"));
        assert!(lines[1].chars().count() < 130);
        let caret = lines[2].find('^').unwrap();
        assert!(lines[1][caret..].starts_with("here"));
    }
}
