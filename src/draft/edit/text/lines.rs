//! Lines of a text: where they begin and end, how far they are indented, which are comments.

/// The line break that a text uses.
pub(super) fn line_break(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

/// First byte of the line that a byte is in.
pub(super) fn start(text: &str, at: usize) -> usize {
    let start = text[..at].rfind(['\n', '\r']).map_or(0, |end| end + 1);
    if start == 0 && text.starts_with('\u{feff}') { '\u{feff}'.len_utf8().min(at) } else { start }
}

/// Behind the last byte of the line that a byte is in, without its break.
pub(super) fn end(text: &str, at: usize) -> usize {
    text[at..].find(['\n', '\r']).map_or(text.len(), |length| at + length)
}

/// First byte of the next line; the end of the text if there is none.
pub(super) fn next(text: &str, at: usize) -> usize {
    let end = end(text, at);
    let width = if text[end..].starts_with("\r\n") { 2 } else { 1 };
    (end + width).min(text.len())
}

/// First byte of the line before, if there is one.
pub(super) fn previous(text: &str, at: usize) -> Option<usize> {
    let here = start(text, at);
    let before = text[..here].strip_suffix("\r\n").or_else(|| text[..here].strip_suffix(['\n', '\r']))?;
    Some(start(text, before.len()))
}

/// The line that begins at a byte.
pub(super) fn line(text: &str, start: usize) -> &str {
    &text[start..end(text, start)]
}

/// Columns before a byte in its line.
pub(super) fn column(text: &str, at: usize) -> usize {
    text[start(text, at)..at].chars().count()
}

/// Whether a line has nothing in it.
pub(super) fn is_blank(line: &str) -> bool {
    line.trim().is_empty()
}

/// Columns before the `#` of a line that is a comment.
pub(super) fn comment_column(line: &str) -> Option<usize> {
    line.trim_start().starts_with('#').then(|| line.chars().take_while(|c| c.is_whitespace()).count())
}

/// The first of the comment lines right above a line that begin in its column; the line itself where there are none.
pub(super) fn own_comments(text: &str, at: usize, column: usize) -> usize {
    let mut first = start(text, at);
    while let Some(above) = previous(text, first)
        && comment_column(line(text, above)) == Some(column)
    {
        first = above;
    }
    first
}

/// Behind the last line of an entry that ends at a byte and begins in a column: with its break's line, and with the comment
/// lines right below that stand further in. Without the break.
pub(super) fn entry_end(text: &str, at: usize, column: usize) -> usize {
    let mut last = end(text, at);
    loop {
        let below = next(text, last);
        let is_below = below > last && below < text.len();
        if !is_below || comment_column(line(text, below)).is_none_or(|found| found <= column) {
            return last;
        }
        last = end(text, below);
    }
}

/// First byte of the comment behind the value at the end of a line, its blanks included; `from` is a byte of the line outside
/// of quotes.
pub(super) fn comment_behind(text: &str, from: usize) -> Option<usize> {
    let rest = &text[from..end(text, from)];
    let mut quote = None;
    let mut before = ' ';
    for (at, letter) in rest.char_indices() {
        match (quote, letter) {
            (None, '#') if before.is_whitespace() => return Some(from + rest[..at].trim_end().len()),
            (None, '"' | '\'') if !before.is_alphanumeric() => quote = Some(letter),
            (Some(open), _) if open == letter && before != '\\' => quote = None,
            _ => {}
        }
        before = letter;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_all_breaks() {
        for end_of_line in ["\n", "\r\n"] {
            let text =
                ["\u{feff}a:", "  # of b", "  # too", "  b: 1   # 'c'", "    # deeper", "  c: 2"].join(end_of_line);
            let b = text.find("b: 1").unwrap();
            assert_eq!(line(&text, start(&text, b)), "  b: 1   # 'c'");
            assert_eq!(line(&text, next(&text, b)), "    # deeper");
            assert_eq!(line(&text, own_comments(&text, b, 2)), "  # of b");
            assert_eq!(&text[entry_end(&text, b, 2)..], format!("{end_of_line}  c: 2"));
            assert_eq!((column(&text, b), line(&text, 3), start(&text, 4)), (2, "a:", 3));
            assert_eq!(&text[comment_behind(&text, b).unwrap()..][..8], "   # 'c'");
            assert_eq!(previous(&text, 3), None);
            assert_eq!(next(&text, text.len()), text.len());
        }
        assert_eq!(comment_behind("a: \"x # y\"", 3), None);
    }
}
