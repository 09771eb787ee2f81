//! Where the parts of a YAML text stand, in bytes, and in which style they are written.
//!
//! For changes of a text that leave everything else as it is; a [`Node`](super::Node) has the values, in the same order.
//! Knows nothing of what they mean.

use std::ops::Range;

use saphyr_parser::{Event, Marker, Parser, ScalarStyle, ScanError, Span as Marks, StrInput};

use super::path::Step;

/// How a value is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Not at all: `key:` alone.
    Empty,
    /// `word`, `"word"` or a block of text.
    Scalar,
    /// `[a, b]`
    FlowList,
    /// `{a: 1}`
    FlowMap,
    /// Lines that begin with a dash.
    BlockList,
    /// Lines of `key: value`.
    BlockMap,
}

/// A value in its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// How it is written.
    pub form: Form,
    /// From its first byte behind its last; of a block, from its first key or dash to the end of its last value.
    pub range: Range<usize>,
    /// What is in it, in order.
    pub parts: Vec<Part>,
}

/// An entry of a map, or an item of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// Key and its bytes, quotes included; none of an item.
    pub key: Option<(String, Range<usize>)>,
    /// Its value.
    pub place: Place,
}

impl Part {
    /// First byte of key or item.
    pub fn start(&self) -> usize {
        self.key.as_ref().map_or(self.place.range.start, |(_, range)| range.start)
    }

    /// Whether this is what a step leads to.
    fn is(&self, index: usize, step: &Step) -> bool {
        match step {
            Step::Key(key) => self.key.as_ref().is_some_and(|(text, _)| text == key),
            Step::Index(number) => self.key.is_none() && *number == index,
        }
    }
}

impl Place {
    /// The places of a text that [`parse`](super::parse) reads; none of any other text.
    pub fn of(text: &str) -> Option<Self> {
        let bytes = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
        let mut walker = Walker { parser: Parser::new_from_str(text), text, bytes };
        loop {
            match walker.next().ok()?? {
                (Event::StreamStart | Event::Nothing | Event::DocumentStart(_), _) => {}
                (Event::StreamEnd | Event::DocumentEnd, _) => return None,
                (event, marks) => return walker.place(event, &marks).ok()?,
            }
        }
    }

    /// The value that some steps lead to.
    pub fn at(&self, steps: &[Step]) -> Option<&Self> {
        steps.iter().try_fold(self, |place, step| place.part(step).map(|(_, part)| &part.place))
    }

    /// Number and part that a step leads to.
    pub fn part(&self, step: &Step) -> Option<(usize, &Part)> {
        self.parts.iter().enumerate().find(|(index, part)| part.is(*index, step))
    }
}

struct Walker<'a> {
    parser: Parser<'a, StrInput<'a>>,
    text: &'a str,
    /// Byte of each character, and the length.
    bytes: Vec<usize>,
}

type Found<T> = Result<Option<T>, ScanError>;

impl<'a> Walker<'a> {
    fn next(&mut self) -> Found<(Event<'a>, Marks)> {
        self.parser.next_event().transpose()
    }

    fn byte(&self, mark: &Marker) -> usize {
        self.bytes.get(mark.index()).copied().unwrap_or(self.text.len())
    }

    fn range(&self, marks: &Marks) -> Range<usize> {
        let start = self.byte(&marks.start);
        // The mark of a quoted word reaches over a comment behind it.
        let end = self.quote_end(start).unwrap_or(self.byte(&marks.end).max(start));
        start..start + self.text[start..end].trim_end().len()
    }

    /// Behind the quote that ends what a quote at a byte begins.
    fn quote_end(&self, start: usize) -> Option<usize> {
        let rest = &self.text[start..];
        let quote = rest.chars().next().filter(|first| matches!(first, '"' | '\''))?;
        let mut letters = rest.char_indices().skip(1).peekable();
        while let Some((at, letter)) = letters.next() {
            match (quote, letter) {
                ('"', '\\') => drop(letters.next()),
                ('\'', '\'') if letters.peek().is_some_and(|(_, next)| *next == '\'') => drop(letters.next()),
                (quote, letter) if quote == letter => return Some(start + at + 1),
                _ => {}
            }
        }
        None
    }

    fn place(&mut self, event: Event<'a>, marks: &Marks) -> Found<Place> {
        let range = self.range(marks);
        let first = self.text[range.start..].chars().next();
        match event {
            Event::Scalar(text, style, ..) => {
                let empty = style == ScalarStyle::Plain && text.is_empty();
                let form = if empty { Form::Empty } else { Form::Scalar };
                let is_block = matches!(style, ScalarStyle::Literal | ScalarStyle::Folded);
                // The mark of a block of text is that of its first line, below its `|`.
                let sign = self.text[..range.start].rfind(['|', '>']).filter(|_| is_block);
                Ok(Some(Place { form, range: sign.unwrap_or(range.start)..range.end, parts: Vec::new() }))
            }
            Event::SequenceStart(..) => {
                let form = if first == Some('[') { Form::FlowList } else { Form::BlockList };
                let start = if matches!(first, Some('[' | '-')) { range.start } else { self.dash(range.start) };
                self.list(form, start)
            }
            Event::MappingStart(..) => {
                let form = if first == Some('{') { Form::FlowMap } else { Form::BlockMap };
                self.map(form, range.start)
            }
            _ => Ok(None),
        }
    }

    fn list(&mut self, form: Form, start: usize) -> Found<Place> {
        let mut parts = Vec::new();
        loop {
            let Some((event, marks)) = self.next()? else { return Ok(None) };
            if event == Event::SequenceEnd {
                return Ok(Some(self.whole(form, start, &marks, parts)));
            }
            let Some(mut place) = self.place(event, &marks)? else { return Ok(None) };
            if place.form == Form::Empty {
                let end = self.text[..place.range.start].trim_end().len();
                place.range = end..end;
            }
            parts.push(Part { key: None, place });
        }
    }

    fn map(&mut self, form: Form, start: usize) -> Found<Place> {
        let mut parts = Vec::new();
        loop {
            let Some((event, marks)) = self.next()? else { return Ok(None) };
            let key = match event {
                Event::MappingEnd => return Ok(Some(self.whole(form, start, &marks, parts))),
                Event::Scalar(text, ..) => (text.into_owned(), self.range(&marks)),
                _ => return Ok(None),
            };
            let Some((event, marks)) = self.next()? else { return Ok(None) };
            let Some(mut place) = self.place(event, &marks)? else { return Ok(None) };
            if place.form == Form::Empty {
                let end = self.behind_colon(key.1.end);
                place.range = end..end;
            }
            parts.push(Part { key: Some(key), place });
        }
    }

    fn whole(&self, form: Form, start: usize, end: &Marks, parts: Vec<Part>) -> Place {
        let end = match (form, parts.last()) {
            (Form::FlowList | Form::FlowMap, _) => self.behind_bracket(self.byte(&end.start)),
            (_, last) => last.map_or(start, |last| last.place.range.end),
        };
        Place { form, range: start..end.max(start), parts }
    }

    /// Behind the bracket that closes: the end's mark may be that of a comma before it, and reaches over a comment behind it.
    fn behind_bracket(&self, mark: usize) -> usize {
        let mut at = mark;
        loop {
            let rest = &self.text[at..];
            at += match rest.chars().next() {
                Some(']' | '}') => return at + 1,
                Some('#') => rest.find(['\n', '\r']).unwrap_or(rest.len()),
                Some(other) => other.len_utf8(),
                None => return at,
            };
        }
    }

    /// The dash that begins a list below its key without indentation: the mark of such a list is that of its first item.
    fn dash(&self, item: usize) -> usize {
        let mut end = item;
        loop {
            let start = self.text[..end].rfind(['\n', '\r']).map_or(0, |at| at + 1);
            let line = &self.text[start..item];
            let code = line.trim_start();
            if code.starts_with('-') || start == 0 {
                return start + line.len() - code.len();
            }
            end = start - 1;
        }
    }

    fn behind_colon(&self, end: usize) -> usize {
        let rest = &self.text[end..];
        let colon = rest.trim_start_matches([' ', '\t']);
        if colon.starts_with(':') { end + rest.len() - colon.len() + 1 } else { end }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::{Kind, Node, Origin, parse, path::steps};

    /// Every scalar's bytes are the scalar, and every part has its key.
    fn agree(text: &str, node: &Node, place: &Place) {
        let bytes = &text[place.range.clone()];
        match &node.kind {
            Kind::Seq(items) => {
                assert_eq!(items.len(), place.parts.len(), "{bytes}");
                items.iter().zip(&place.parts).for_each(|(item, part)| agree(text, item, &part.place));
            }
            Kind::Map(entries) => {
                assert_eq!(entries.len(), place.parts.len(), "{bytes}");
                for ((key, value), part) in entries.iter().zip(&place.parts) {
                    let (name, range) = part.key.as_ref().unwrap();
                    assert_eq!((&key.text, key.text.as_str()), (name, text[range.clone()].trim_matches('"')));
                    agree(text, value, &part.place);
                }
            }
            Kind::Null if place.form == Form::Empty => assert_eq!(bytes, ""),
            _ => assert_eq!(parse("part", bytes, Origin::Given).unwrap().json(), node.json(), "{bytes}"),
        }
    }

    #[test]
    fn places_of_all_recipes() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes");
        for file in std::fs::read_dir(folder).unwrap() {
            let text = std::fs::read_to_string(file.unwrap().path()).unwrap();
            for text in [text.clone(), text.replace('\n', "\r\n"), format!("\u{feff}{text}")] {
                agree(&text, &parse("a", &text, Origin::Given).unwrap(), &Place::of(&text).unwrap());
            }
        }
    }

    #[test]
    fn forms_and_ends() {
        let text =
            "é: [1, {a: b c }, ]  # c\nlist:\n- x: 1\n  y:   # none\n-\n- |\n  two\n  lines\n\nlast: 'q' # end\n";
        let root = Place::of(text).unwrap();
        let found = |path: &str| root.at(&steps(path).unwrap()).unwrap();
        for (path, form, bytes) in [
            ("é", Form::FlowList, "[1, {a: b c }, ]"),
            ("é[1]", Form::FlowMap, "{a: b c }"),
            ("é[1].a", Form::Scalar, "b c"),
            ("list", Form::BlockList, "- x: 1\n  y:   # none\n-\n- |\n  two\n  lines"),
            ("list[0]", Form::BlockMap, "x: 1\n  y:"),
            ("list[0].y", Form::Empty, ""),
            ("list[1]", Form::Empty, ""),
            ("list[2]", Form::Scalar, "|\n  two\n  lines"),
            ("last", Form::Scalar, "'q'"),
        ] {
            let place = found(path);
            assert_eq!((place.form, &text[place.range.clone()]), (form, bytes), "{path}");
        }
        assert_eq!(root.range.end, text.len() - " # end\n".len());
        assert!(root.at(&steps("list[3]").unwrap()).is_none() && Place::of("# nothing").is_none());
    }
}
