//! Edits of lines: values, keys and items that are not in brackets or braces.

use super::flow::value_in;
use super::lines::{column, end, entry_end, is_blank, line, line_break, next, own_comments, previous, start};
use super::settle::Entry;
use super::{Splice, Spot, Written, emit};
use crate::recipe::places::{Form, Place};
use crate::recipe::{Key, Node, Style};

/// Sections whose values stand in lines below their key.
const OPEN: [&str; 9] =
    ["sonar", "water", "seabed", "environment", "multipath", "objects", "trajectory", "vehicle", "image"];
/// Sections that are a word or a number, at the head of a recipe.
const HEAD: [&str; 6] = ["ensonify", "include", "name", "seed", "scenes", "frames"];

/// Another value at a spot.
pub(super) fn replace(written: &Written<'_>, spot: &Spot<'_>, value: &Node) -> Splice {
    let indent = column(written.text, spot.around.range.start);
    let was_block = matches!(spot.place.form, Form::BlockList | Form::BlockMap);
    let is_list_of_maps = value.items().iter().any(|item| !item.entries().is_empty());
    match &spot.part.key {
        None => item_in(written, spot, &emit::item(value, indent, was_block), indent),
        Some((name, key)) => {
            let name = Key { text: name.clone(), style: Style::Plain, span: value.span.clone() };
            let line = emit::flow(value);
            let fits = emit::fits(&line, key.len() + indent + 2);
            let open = emit::is_long(value) && (!fits || is_list_of_maps || (was_block && !value.is_distribution()));
            let lines = if open { emit::opened(&name, value, indent) } else { Vec::new() };
            match (open, was_block) {
                (false, false) => value_in(written, spot, &line),
                (false, true) => closed(written, spot, key.end, &line),
                (true, _) => opened(written, spot, key.end, &indented(&lines[1..], indent, line_break(written.text))),
            }
        }
    }
}

/// A block's lines go; its value stands behind its key.
fn closed(written: &Written<'_>, spot: &Spot<'_>, key_end: usize, value: &str) -> Splice {
    let text = written.text;
    let colon = behind_colon(text, key_end);
    let comment = &text[colon..end(text, colon)];
    Splice { range: colon..end(text, spot.place.range.end), with: format!(" {value}{comment}") }
}

/// A value goes, or a block's lines do; lines come below the key.
fn opened(written: &Written<'_>, spot: &Spot<'_>, key_end: usize, lines: &str) -> Splice {
    let text = written.text;
    let colon = behind_colon(text, key_end);
    let last = end(text, spot.place.range.end);
    let comment = match spot.place.form {
        Form::BlockList | Form::BlockMap => &text[colon..end(text, colon)],
        _ => &text[spot.place.range.end..last],
    };
    let comment = comment.trim_end();
    Splice { range: colon..last, with: format!("{comment}{}{lines}", line_break(text)) }
}

/// Another item of a list of lines.
fn item_in(written: &Written<'_>, spot: &Spot<'_>, lines: &[String], indent: usize) -> Splice {
    let text = written.text;
    let is_one = lines.len() == 1 && !matches!(spot.place.form, Form::BlockList | Form::BlockMap);
    let first = lines[0].strip_prefix("- ").unwrap_or(&lines[0]);
    if is_one {
        return value_in(written, spot, first);
    }
    let is_empty = spot.place.form == Form::Empty;
    let inner = if is_empty { indent + 2 } else { column(text, spot.place.range.start) };
    let rest = lines[1..].iter().map(|line| format!("{}{}{}", line_break(text), " ".repeat(inner), &line[2..]));
    let before = if is_empty { " " } else { "" };
    Splice { range: spot.place.range.clone(), with: format!("{before}{first}{}", rest.collect::<String>()) }
}

/// A key or an item more.
pub(super) fn add(written: &Written<'_>, place: &Place, index: usize, entry: &Entry) -> Splice {
    let text = written.text;
    let indent = column(text, place.range.start);
    let lines = match &entry.key {
        None => {
            let open = place.parts.iter().any(|part| part.place.form == Form::BlockMap);
            emit::item(&entry.value, indent, open)
        }
        Some(key) if entry.is_section && OPEN.contains(&key.text.as_str()) && emit::is_long(&entry.value) => {
            emit::opened(key, &entry.value, indent)
        }
        Some(key) => emit::entry(key, &entry.value, indent),
    };
    let breaks = line_break(text);
    let lines = indented(&lines, indent, breaks);
    if index == 0 {
        // Before the first key of a list's item stands the dash.
        let behind_dash = !is_blank(&text[start(text, place.range.start)..place.range.start]);
        let at = if behind_dash { place.range.start } else { own_comments(text, place.range.start, indent) };
        let (before, after) =
            if behind_dash { (&lines[indent..], " ".repeat(indent)) } else { (&lines[..], String::new()) };
        return Splice { range: at..at, with: format!("{before}{breaks}{after}") };
    }
    let before = &place.parts[index - 1];
    let at = entry_end(text, before.place.range.end, indent);
    let gap = if is_apart(text, place, index, entry) { breaks } else { "" };
    Splice { range: at..at, with: format!("{breaks}{gap}{lines}") }
}

/// Whether a blank line stands before a new part: sections have one, other parts where their neighbours do.
fn is_apart(text: &str, place: &Place, index: usize, entry: &Entry) -> bool {
    let blank_before = |part: &crate::recipe::places::Part| {
        let first = own_comments(text, part.start(), column(text, place.range.start));
        previous(text, first).is_some_and(|above| is_blank(line(text, above)))
    };
    let is_head = |key: Option<&str>| key.is_some_and(|key| HEAD.contains(&key));
    let before = &place.parts[index - 1];
    let neighbours = match place.parts.get(index) {
        Some(after) => blank_before(after),
        None => index > 1 && blank_before(before),
    };
    if !entry.is_section {
        return neighbours;
    }
    let name = |key: &Option<(String, std::ops::Range<usize>)>| key.as_ref().map(|(name, _)| name.clone());
    let both_head = is_head(entry.key.as_ref().map(|key| key.text.as_str())) && is_head(name(&before.key).as_deref());
    let is_last = place.parts.get(index).is_none();
    !both_head && (neighbours || is_last)
}

/// A key or an item less, with its own comments.
pub(super) fn drop_part(written: &Written<'_>, spot: &Spot<'_>) -> Option<Splice> {
    let text = written.text;
    let parts = &spot.around.parts;
    let indent = column(text, spot.around.range.start);
    if parts.len() == 1 {
        return emptied(written, spot, indent);
    }
    let begin = part_start(text, spot.around, spot.index, indent)?;
    let line_of = start(text, begin);
    if is_blank(&text[line_of..begin]) {
        return Some(without_lines(text, own_comments(text, begin, indent), spot.place.range.end, indent));
    }
    // The first key of a list's item: the next one comes behind the dash.
    let after = part_start(text, spot.around, spot.index + 1, indent)?;
    let last = entry_end(text, spot.place.range.end, indent);
    if previous(text, after) == Some(start(text, last)) {
        return Some(Splice { range: begin..after, with: String::new() });
    }
    Some(Splice { range: text[..begin].trim_end().len()..last, with: String::new() })
}

/// Whole lines less, and one of two blank lines that would meet.
fn without_lines(text: &str, first: usize, until: usize, indent: usize) -> Splice {
    let last = entry_end(text, until, indent);
    let mut range = first..next(text, last);
    let above = previous(text, first);
    let blank_above = above.is_none_or(|above| is_blank(line(text, above)));
    if range.end >= text.len() {
        // The last lines of the text: the break before them goes in their stead, and so does a blank line.
        let ends_with_break = last < text.len();
        while let Some(above) = previous(text, range.start)
            && is_blank(line(text, above))
        {
            range.start = above;
        }
        if !ends_with_break && let Some(above) = previous(text, range.start) {
            range.start = end(text, above);
        }
    } else if blank_above && is_blank(line(text, range.end)) {
        range.end = next(text, range.end);
    }
    Splice { range, with: String::new() }
}

/// The only part of a block goes: braces or brackets without anything stay.
fn emptied(written: &Written<'_>, spot: &Spot<'_>, indent: usize) -> Option<Splice> {
    let text = written.text;
    let nothing = if spot.around.form == Form::BlockList { "[]" } else { "{}" };
    let last = entry_end(text, spot.place.range.end, indent);
    let before = &text[..spot.around.range.start];
    // Behind a dash of a list around it, the place of the first key is that of the braces.
    if !is_blank(&text[start(text, spot.around.range.start)..spot.around.range.start]) {
        return Some(Splice { range: spot.around.range.start..last, with: nothing.to_owned() });
    }
    let key_line = code_before(text, before.len())?;
    let colon = key_colon(text, key_line)?;
    let comment = &text[colon..end(text, colon)];
    Some(Splice { range: colon..last, with: format!(" {nothing}{comment}") })
}

/// First byte of the nearest line above that is neither blank nor a comment.
fn code_before(text: &str, at: usize) -> Option<usize> {
    let mut line_of = previous(text, at)?;
    while is_blank(line(text, line_of)) || super::lines::comment_column(line(text, line_of)).is_some() {
        line_of = previous(text, line_of)?;
    }
    Some(line_of)
}

/// Behind the colon that ends a line's key: the last one before its comment.
fn key_colon(text: &str, line_of: usize) -> Option<usize> {
    let comment = super::lines::comment_behind(text, line_of).unwrap_or(end(text, line_of));
    let code = text[line_of..comment].trim_end();
    code.ends_with(':').then_some(line_of + code.len())
}

/// First byte of a part: of its key, or of its dash.
fn part_start(text: &str, around: &Place, index: usize, indent: usize) -> Option<usize> {
    let part = around.parts.get(index)?;
    if part.key.is_some() {
        return Some(part.start());
    }
    if index == 0 {
        return Some(around.range.start);
    }
    let mut line_of = start(text, part.start());
    loop {
        let line = line(text, line_of);
        let dash = line_of + line.len() - line.trim_start().len();
        if text[dash..].starts_with('-') && column(text, dash) == indent {
            return Some(dash);
        }
        line_of = previous(text, line_of)?;
    }
}

fn behind_colon(text: &str, key_end: usize) -> usize {
    key_end + text[key_end..].find(':').map_or(0, |at| at + 1)
}

fn indented(lines: &[String], indent: usize, breaks: &str) -> String {
    lines.iter().map(|line| format!("{}{line}", " ".repeat(indent))).collect::<Vec<_>>().join(breaks)
}
