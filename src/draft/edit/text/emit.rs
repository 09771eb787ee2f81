//! Values as YAML text, as recipes write them: braces and brackets on a line, lines of their own where that gets too long.

use crate::recipe::{Key, Kind, Node, Style};

/// Longest line, in characters, where there is a choice.
const WIDTH: usize = 120;
/// Words that other readers of YAML take for `true` and `false`.
const ALMOST_BOOL: [&str; 6] = ["yes", "no", "on", "off", "y", "n"];

/// A value on one line.
pub(super) fn flow(node: &Node) -> String {
    match &node.kind {
        Kind::Null => "null".to_owned(),
        Kind::Bool(value) => value.to_string(),
        Kind::Int(value) => value.to_string(),
        Kind::Float(value) if value.floor() == *value && value.abs() < 1e15 => format!("{value:.1}"),
        Kind::Float(value) => value.to_string(),
        Kind::Text(text) => scalar(text),
        Kind::Seq(items) => format!("[{}]", items.iter().map(flow).collect::<Vec<_>>().join(", ")),
        Kind::Map(entries) => {
            let entry = |(name, value): &(Key, Node)| format!("{}: {}", key(name), flow(value));
            format!("{{{}}}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
    }
}

/// `key: value` in as few lines as there is width for, the first without its indentation of `indent` columns.
pub(super) fn entry(name: &Key, value: &Node, indent: usize) -> Vec<String> {
    let line = format!("{}: {}", key(name), flow(value));
    if fits(&line, indent) || !is_long(value) { vec![line] } else { opened(name, value, indent) }
}

/// `key:` and its value in lines below it.
pub(super) fn opened(name: &Key, value: &Node, indent: usize) -> Vec<String> {
    let below = block(value, indent + 2);
    std::iter::once(format!("{}:", key(name))).chain(below.into_iter().map(|line| format!("  {line}"))).collect()
}

/// Lines of a map or list, without their indentation of `indent` columns.
pub(super) fn block(node: &Node, indent: usize) -> Vec<String> {
    match &node.kind {
        Kind::Map(entries) if !entries.is_empty() => {
            entries.iter().flat_map(|(key, value)| entry(key, value, indent)).collect()
        }
        Kind::Seq(items) if !items.is_empty() => {
            items.iter().flat_map(|value| item(value, indent, is_object(value))).collect()
        }
        _ => vec![flow(node)],
    }
}

/// `- value`, opened or in as few lines as there is width for.
pub(super) fn item(value: &Node, indent: usize, open: bool) -> Vec<String> {
    let line = format!("- {}", flow(value));
    if !is_long(value) || (!open && fits(&line, indent)) {
        return vec![line];
    }
    let begin = |(index, line): (usize, String)| format!("{}{line}", if index == 0 { "- " } else { "  " });
    block(value, indent + 2).into_iter().enumerate().map(begin).collect()
}

/// Whether a value may be written in lines of its own.
pub(super) fn is_long(value: &Node) -> bool {
    !value.entries().is_empty() || !value.items().is_empty()
}

/// Whether a line is short enough.
pub(super) fn fits(line: &str, indent: usize) -> bool {
    indent + line.chars().count() <= WIDTH
}

/// Whether an item is written in lines of its own though it would fit on one: objects are.
fn is_object(value: &Node) -> bool {
    value.get("pick").is_some() && value.entries().len() > 1
}

/// A key as it is written.
pub(super) fn key(key: &Key) -> String {
    let is_number = |text: &str| text.bytes().next().is_some_and(|b| b.is_ascii_digit());
    match key.style {
        Style::Quoted => quoted(&key.text),
        Style::Plain if is_number(&key.text) && key.text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'.') => {
            key.text.clone()
        }
        Style::Plain => scalar(&key.text),
    }
}

fn scalar(text: &str) -> String {
    let is_inner = |c: char| c.is_alphanumeric() || "_-./$ +()%".contains(c);
    let begins = text.starts_with(|c: char| c.is_alphanumeric() || "_./$".contains(c));
    let is_word = begins && text.chars().all(is_inner) && text.trim() == text;
    let is_text =
        crate::recipe::parse("word", text, crate::recipe::Origin::Given).is_ok_and(|node| node.text() == Some(text));
    if is_word && is_text && !ALMOST_BOOL.contains(&text.to_lowercase().as_str()) {
        text.to_owned()
    } else {
        quoted(text)
    }
}

/// YAML takes the escapes of JSON.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::{Origin, parse};

    #[test]
    fn values_come_back() {
        for text in [
            "{a: 1, \"1\": 2.5, 2: 5.0, \"on\": [x, true, null, \"true\", \"5\", \"\", \" a\", \"a: b\", \"a # b\", é]}",
            "[1e-7, -3, 0.1, $depth, $$x, \"*a\", \"- b\", \"objects[0].count\", \"a\\nb\", \"{\", \"#\", \"--- x\"]",
            "{}",
            "[]",
            "{sonar.device: 1, ../a b.yaml: 2}",
        ] {
            let node = parse("a", text, Origin::Given).unwrap();
            assert_eq!(parse("b", &flow(&node), Origin::Given).unwrap().json(), node.json(), "{}", flow(&node));
            let lines = block(&node, 0).join("\n");
            assert_eq!(parse("b", &lines, Origin::Given).unwrap().json(), node.json(), "{lines}");
        }
    }

    #[test]
    fn long_values_get_lines() {
        let words = |n: usize| (0..n).map(|i| format!("word-{i}: {i}")).collect::<Vec<_>>().join(", ");
        let node = parse("a", &format!("{{pick: {{{}}}, pose: {{{}}}}}", words(3), words(20)), Origin::Given).unwrap();
        let lines = item(&node, 2, true);
        assert_eq!(lines[..3], ["- pick: {word-0: 0, word-1: 1, word-2: 2}", "  pose:", "    word-0: 0"]);
        assert_eq!(lines.len(), 22);
    }
}
