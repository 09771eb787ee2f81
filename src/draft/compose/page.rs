//! The text of a recipe: lines with comments beside them, as somebody would write it by hand.

use super::yaml::Yaml;

/// Widest line, letters.
const WIDE: usize = 118;
/// Farthest column that comments of a block stand at.
const FARTHEST: usize = 60;

/// Lines of a recipe.
#[derive(Default)]
pub(in crate::draft) struct Page {
    lines: Vec<Line>,
}

enum Line {
    Blank,
    /// A comment of its own.
    Note {
        indent: usize,
        text: String,
    },
    Set {
        indent: usize,
        text: String,
        comment: String,
    },
}

impl Page {
    pub fn blank(&mut self) {
        self.lines.push(Line::Blank);
    }

    /// What somebody said, set off from the comments about it.
    pub fn quote(&mut self, text: &str) {
        self.lines.push(Line::Note { indent: 0, text: format!("  {}", printable(text)) });
    }

    /// A comment on lines of its own.
    pub fn note(&mut self, indent: usize, text: &str) {
        self.lines.push(Line::Note { indent, text: printable(text) });
    }

    /// `key: value   # comment`.
    pub fn set(&mut self, indent: usize, key: &'static str, value: &Yaml, comment: &str) {
        self.line(indent, format!("{key}: {}", value.text()), comment);
    }

    /// `key:   # comment`, what it holds on the lines below.
    pub fn open(&mut self, indent: usize, key: &'static str, comment: &str) {
        self.line(indent, format!("{key}:"), comment);
    }

    /// An entry whose key is a name: `key: value   # comment`, without a value what it holds on the lines below.
    pub fn entry(&mut self, indent: usize, key: &Yaml, value: Option<&Yaml>, comment: &str) {
        let value = value.map_or(String::new(), |value| format!(" {}", value.text()));
        self.line(indent, format!("{}:{value}", key.text()), comment);
    }

    /// `- key: value   # comment`, the first line of an item.
    pub fn item(&mut self, indent: usize, key: &'static str, value: &Yaml, comment: &str) {
        self.line(indent, format!("- {key}: {}", value.text()), comment);
    }

    /// `- {…}   # comment`, an item on one line.
    pub fn flow_item(&mut self, indent: usize, value: &Yaml, comment: &str) {
        self.line(indent, format!("- {}", value.text()), comment);
    }

    fn line(&mut self, indent: usize, text: String, comment: &str) {
        self.lines.push(Line::Set { indent, text, comment: printable(comment) });
    }

    pub fn text(&self) -> String {
        let mut out = String::new();
        for block in self.lines.split_inclusive(|line| matches!(line, Line::Blank)) {
            let column = column(block);
            block.iter().for_each(|line| write(line, column, &mut out));
        }
        out
    }
}

/// Column at which the comments of a block stand.
fn column(block: &[Line]) -> usize {
    let wide = |line: &Line| match line {
        Line::Set { indent, text, comment } if !comment.is_empty() => Some(indent + text.chars().count() + 2),
        _ => None,
    };
    block.iter().filter_map(wide).filter(|column| *column <= FARTHEST).max().unwrap_or(0)
}

fn write(line: &Line, column: usize, out: &mut String) {
    match line {
        Line::Blank => out.push('\n'),
        Line::Note { indent, text } => note(*indent, text, out),
        Line::Set { indent, text, comment } => {
            let begin = format!("{}{text}", " ".repeat(*indent));
            let end = begin.chars().count();
            let at = column.max(end + 1);
            if comment.is_empty() {
                out.push_str(&begin);
            } else if at + 2 + comment.chars().count() <= WIDE {
                out.push_str(&format!("{begin}{}# {comment}", " ".repeat(at - end)));
            } else {
                note(*indent, comment, out);
                out.push_str(&begin);
            }
            out.push('\n');
        }
    }
}

/// A comment of its own, on as many lines as it takes.
fn note(indent: usize, text: &str, out: &mut String) {
    let begin = format!("{}#", " ".repeat(indent));
    let (text, mut line) = match text.strip_prefix("  ") {
        Some(quoted) => (quoted, begin.clone() + "  "),
        None => (text, begin.clone()),
    };
    for word in text.split(' ') {
        if line.len() > begin.len() && line.chars().count() + 1 + word.chars().count() > WIDE {
            out.push_str(&line);
            out.push('\n');
            line = begin.clone() + " ";
        }
        line.push(' ');
        line.push_str(word);
    }
    out.push_str(&line);
    out.push('\n');
}

/// A text that stays a comment: on one line, without anything that a terminal obeys or that turns its direction.
pub(in crate::draft) fn printable(text: &str) -> String {
    let seen = |word: &str| -> String {
        word.chars().filter(|c| !c.is_control() && !crate::catalog::text::is_unseen(*c)).collect()
    };
    text.split_whitespace().map(seen).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_stand_under_each_other_and_stay_comments() {
        let mut page = Page::default();
        page.note(0, "a\u{2028}b\nscenes: 9\u{202e}");
        page.set(0, "scenes", &Yaml::whole(30), "\"300\nimages: 4\"");
        page.set(0, "name", &Yaml::word("tires-and-anchor"), "");
        page.open(0, "sonar", "x");
        let text = page.text();
        assert_eq!(text, "# a b scenes: 9\nscenes: 30  # \"300 images: 4\"\nname: tires-and-anchor\nsonar:      # x\n");
        let mut page = Page::default();
        page.set(2, "device", &Yaml::word("x"), &"long ".repeat(60));
        assert!(page.text().lines().all(|line| line.chars().count() <= WIDE));
        assert_eq!(page.text().lines().last(), Some("  device: x"));
        assert!(page.text().lines().rev().skip(1).all(|line| line.starts_with("  #")));
    }
}
