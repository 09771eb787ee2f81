//! Text of catalogs is data: nothing in a name may move a cursor, end a line or be taken for markup.

/// Longest text that is kept, letters.
const LONGEST: usize = 400;

/// A text on one line: control characters, marks of direction and runs of blanks become one blank; overlong ones are cut.
#[must_use]
pub fn clean(text: &str) -> String {
    let mut out = String::with_capacity(text.len().min(LONGEST));
    let (mut count, mut blank) = (0, false);
    for letter in text.chars() {
        if letter.is_whitespace() || is_unseen(letter) {
            blank = count > 0;
            continue;
        }
        if count >= LONGEST {
            out.push('…');
            break;
        }
        if blank {
            out.push(' ');
            blank = false;
        }
        out.push(letter);
        count += 1;
    }
    out
}

/// The text of a piece of HTML, on one line.
#[must_use]
pub fn without_html(html: &str) -> String {
    let mut out = String::with_capacity(html.len());
    let mut rest = html;
    while let Some(start) = rest.find('<') {
        out.push_str(&rest[..start]);
        let tail = &rest[start..];
        // A lone `<` is a sign, not a tag.
        let is_tag = tail[1..].starts_with(|c: char| c.is_ascii_alphabetic() || c == '/' || c == '!');
        match tail.find('>').filter(|_| is_tag) {
            Some(end) => {
                out.push(' ');
                rest = &tail[end + 1..];
            }
            None => {
                out.push('<');
                rest = &tail[1..];
            }
        }
    }
    out.push_str(rest);
    for (entity, letter) in
        [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&nbsp;", " "), ("&amp;", "&")]
    {
        if out.contains(entity) {
            out = out.replace(entity, letter);
        }
    }
    clean(&out)
}

/// What no one sees but a terminal or a renderer obeys.
pub(crate) fn is_unseen(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}' | '\u{FFF9}'..='\u{FFFB}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_unseen_is_left() {
        assert_eq!(clean("  a\u{1b}[31mred\r\n\tb\u{202e}c\u{0}  "), "a [31mred b c");
        assert_eq!(clean("锚 ü | x"), "锚 ü | x");
        assert_eq!(clean(&"x".repeat(1000)).chars().count(), LONGEST + 1);
        assert_eq!(without_html("<p>a &amp; b<br/>c</p><script>x"), "a & b c x");
        assert_eq!(without_html("3 < 4 > 2"), "3 < 4 > 2");
    }
}
