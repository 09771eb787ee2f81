//! YAML text to a located tree.
//!
//! Takes what recipes need of YAML 1.2 and refuses the rest by name: anchors, aliases, merge keys, tags, several documents.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;
use std::sync::Arc;

use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span as Marks, StrInput};

use super::error::{Error, quoted};
use super::node::{Key, Kind, Node, Style};
use super::scalar::resolve;
use super::source::{Origin, Source, Span};

/// Largest text, bytes.
pub const MAX_BYTES: usize = 4 << 20;
/// Deepest nesting of maps and lists.
pub const MAX_DEPTH: usize = 64;
/// Most values in a text.
pub const MAX_NODES: usize = 200_000;

/// Reads a YAML file of the user.
///
/// # Errors
/// A file that cannot be read, is too large or is not UTF-8; otherwise as [`parse`].
pub fn read(path: &Path) -> Result<Node, Error> {
    let name = path.display().to_string();
    let whole = |message: String, help: &str| {
        Error::new(&Span::whole(&Source::new(&name, "", Origin::Given)), "", message, help)
    };
    let unreadable = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => whole("there is no such file".to_owned(), "check the name and the folder"),
        _ => whole(format!("cannot be read: {error}"), "check the file and its permissions"),
    };
    let file = File::open(path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.is_dir() {
        return Err(whole("is a folder, not a file".to_owned(), "give the YAML file in it"));
    }
    let mut bytes = Vec::new();
    file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() > MAX_BYTES {
        return Err(whole(
            format!("is larger than {} MiB", MAX_BYTES >> 20),
            "a recipe is a few kilobytes; is this the right file?",
        ));
    }
    match String::from_utf8(bytes) {
        Ok(text) => parse(&name, &text, Origin::Given),
        Err(error) => {
            let good = String::from_utf8_lossy(&error.as_bytes()[..error.utf8_error().valid_up_to()]).into_owned();
            let span = end_of(&Source::new(&name, &good, Origin::Given), &good);
            Err(Error::new(&span, "", "the text is not UTF-8", "save the file as UTF-8"))
        }
    }
}

/// Reads YAML text; `name` stands in messages.
///
/// # Errors
/// Text that is empty, too large, not YAML or more of YAML than recipes take; a key that stands twice.
pub fn parse(name: &str, text: &str, origin: Origin) -> Result<Node, Error> {
    parse_part(&Source::new(name, text, origin), text, 0)
}

/// Reads `text`, which stands in the first line of `source` behind `shift` characters.
pub(crate) fn parse_part(source: &Arc<Source>, text: &str, shift: u32) -> Result<Node, Error> {
    if text.len() > MAX_BYTES {
        let message = format!("is larger than {} MiB", MAX_BYTES >> 20);
        return Err(Error::new(
            &Span::whole(source),
            "",
            message,
            "a recipe is a few kilobytes; is this the right file?",
        ));
    }
    if let Some(at) = text.find(|c: char| c.is_control() && !matches!(c, '\t' | '\n' | '\r' | '\u{85}')) {
        let mut span = end_of(source, &text[..at]);
        span.column += if span.line == 1 { shift } else { 0 };
        let help = "remove it; in a quoted text it can be written as an escape such as \"\\0\"";
        return Err(Error::new(&span, "", "a control character is not allowed in YAML", help));
    }
    Reader { parser: Parser::new_from_str(text), source: Arc::clone(source), shift, nodes: 0 }.document()
}

/// The place behind the last character of `text`, which begins `source`.
fn end_of(source: &Arc<Source>, text: &str) -> Span {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text).replace("\r\n", "\n");
    let line = 1 + text.matches(['\n', '\r']).count();
    let column = 1 + text.rsplit(['\n', '\r']).next().unwrap_or("").chars().count();
    Span { source: Arc::clone(source), line: line as u32, column: column as u32 }
}

struct Reader<'a> {
    parser: Parser<'a, StrInput<'a>>,
    source: Arc<Source>,
    shift: u32,
    nodes: usize,
}

impl<'a> Reader<'a> {
    fn document(mut self) -> Result<Node, Error> {
        let mut root = None;
        loop {
            let (event, span) = self.next()?;
            match event {
                Event::StreamEnd => break,
                Event::DocumentStart(_) if root.is_some() => {
                    return Err(Error::new(&span, "", "a second document begins here", "keep one document in a file"));
                }
                Event::StreamStart | Event::Nothing | Event::DocumentStart(_) | Event::DocumentEnd => {}
                value => root = Some(self.node(value, span, 0)?),
            }
        }
        // An empty plain scalar is what the parser makes of a text of comments alone.
        root.filter(|node| node.kind != Kind::Null || node.span.line != 0).ok_or_else(|| {
            Error::new(&Span::whole(&self.source), "", "is empty", "write a value; a recipe begins with `ensonify: 1`")
        })
    }

    fn next(&mut self) -> Result<(Event<'a>, Span), Error> {
        match self.parser.next_event() {
            Some(Ok((event, marks))) => {
                let span = self.span(&marks);
                Ok((event, span))
            }
            Some(Err(error)) => Err(self.not_yaml(&error)),
            None => Err(Error::new(&Span::whole(&self.source), "", "ends too early", "complete the file")),
        }
    }

    fn not_yaml(&self, error: &ScanError) -> Error {
        let span = self.span(&Marks::empty(*error.marker()));
        let info = error.info();
        if info.contains("recursion limit") {
            too_deep(&span)
        } else if info.contains("unknown anchor") {
            Error::new(&span, "", NO_ALIASES, WRITE_OUT)
        } else {
            let help = "check indentation (spaces, no tabs), colons, quotes and brackets up to here";
            Error::new(&span, "", format!("not valid YAML: {info}"), help)
        }
    }

    fn span(&self, marks: &Marks) -> Span {
        let line = u32::try_from(marks.start.line()).unwrap_or(u32::MAX);
        let column = u32::try_from(marks.start.col()).unwrap_or(u32::MAX).saturating_add(1);
        let shift = if line <= 1 { self.shift } else { 0 };
        Span { source: Arc::clone(&self.source), line, column: column.saturating_add(shift) }
    }

    fn node(&mut self, event: Event<'a>, span: Span, depth: usize) -> Result<Node, Error> {
        self.count(&span, depth)?;
        self.refuse_extras(&event, &span)?;
        let kind = match event {
            Event::Scalar(text, style, ..) => return self.scalar(&text, style, span, depth),
            Event::SequenceStart(..) => {
                let mut items = Vec::new();
                loop {
                    match self.next()? {
                        (Event::SequenceEnd, _) => break Kind::Seq(items),
                        (event, span) => items.push(self.node(event, span, depth + 1)?),
                    }
                }
            }
            Event::MappingStart(..) => self.map(depth)?,
            _ => return Err(Error::new(&span, "", "not valid YAML: a value is missing", "write a value here")),
        };
        Ok(Node { kind, span })
    }

    fn map(&mut self, depth: usize) -> Result<Kind, Error> {
        let mut entries: Vec<(Key, Node)> = Vec::new();
        // Search by key must not be quadratic in a map of 100,000 keys.
        let mut seen = std::collections::BTreeMap::new();
        loop {
            let (event, span) = self.next()?;
            if event == Event::MappingEnd {
                return Ok(Kind::Map(entries));
            }
            let key = self.key(event, span)?;
            if let Some(first) = seen.insert(key.text.clone(), key.span.clone()) {
                let message = format!("the key {} stands twice", quoted(&key.text));
                let help = format!("it stands first at {first}; keep one of the two");
                return Err(Error::new(&key.span, "", message, help));
            }
            let (event, span) = self.next()?;
            let empty = matches!(&event, Event::Scalar(text, ScalarStyle::Plain, ..) if text.is_empty());
            let mut value = self.node(event, span, depth + 1)?;
            let is_list_or_map = matches!(value.kind, Kind::Seq(_) | Kind::Map(_));
            if empty || (is_list_or_map && value.span.line > key.span.line) {
                value.span = key.span.clone();
            }
            entries.push((key, value));
        }
    }

    fn key(&mut self, event: Event<'a>, span: Span) -> Result<Key, Error> {
        self.refuse_extras(&event, &span)?;
        let Event::Scalar(text, style, ..) = event else {
            return Err(Error::new(&span, "", "a list or map cannot be a key", "write a word and a colon"));
        };
        let style = if style == ScalarStyle::Plain { Style::Plain } else { Style::Quoted };
        match (&*text, style) {
            ("", Style::Plain) => Err(Error::new(&span, "", "a key is missing before the colon", "write a word")),
            ("<<", Style::Plain) => Err(Error::new(&span, "", "merge keys (`<<`) are not used in recipes", WRITE_OUT)),
            _ => Ok(Key { text: text.into_owned(), style, span }),
        }
    }

    fn scalar(&self, text: &str, style: ScalarStyle, mut span: Span, depth: usize) -> Result<Node, Error> {
        if style != ScalarStyle::Plain {
            return Ok(Node { kind: Kind::Text(text.to_owned()), span });
        }
        if text.is_empty() && depth == 0 {
            span.line = 0;
        }
        match resolve(text) {
            Ok(kind) => Ok(Node { kind, span }),
            Err(message) => Err(Error::new(&span, "", format!("{message}: {}", quoted(text)), "write a finite number")),
        }
    }

    fn count(&mut self, span: &Span, depth: usize) -> Result<(), Error> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            let message = format!("more than {MAX_NODES} values");
            return Err(Error::new(span, "", message, "a recipe has a few hundred; is this the right file?"));
        }
        if depth > MAX_DEPTH {
            return Err(too_deep(span));
        }
        Ok(())
    }

    fn refuse_extras(&self, event: &Event<'a>, span: &Span) -> Result<(), Error> {
        let (anchor, tag) = match event {
            Event::Alias(_) => return Err(Error::new(span, "", NO_ALIASES, WRITE_OUT)),
            Event::Scalar(_, _, anchor, tag) => (*anchor, tag),
            Event::SequenceStart(anchor, tag) | Event::MappingStart(anchor, tag) => (*anchor, tag),
            _ => return Ok(()),
        };
        if anchor != 0 {
            return Err(Error::new(span, "", "anchors (`&name`) are not used in recipes", WRITE_OUT));
        }
        if tag.is_some() {
            let help = "remove it; quotes make a text of a number";
            return Err(Error::new(span, "", "tags (`!name`) are not used in recipes", help));
        }
        Ok(())
    }
}

const NO_ALIASES: &str = "aliases (`*name`) are not used in recipes";
const WRITE_OUT: &str = "write the value out at each place";

fn too_deep(span: &Span) -> Error {
    let message = format!("nested deeper than {MAX_DEPTH} levels");
    Error::new(span, "", message, "close the brackets, or write it flatter")
}

#[cfg(test)]
mod tests;
