//! Edits inside of brackets and braces.

use super::lines::{comment_behind, end};
use super::settle::Entry;
use super::{Splice, Spot, Written, emit};
use crate::recipe::Node;
use crate::recipe::places::{Form, Place};

/// Another value at a spot.
pub(super) fn replace(written: &Written<'_>, spot: &Spot<'_>, value: &Node) -> Splice {
    value_in(written, spot, &emit::flow(value))
}

/// Another text for a value on its line; a comment behind it stays in its column.
pub(super) fn value_in(written: &Written<'_>, spot: &Spot<'_>, value: &str) -> Splice {
    let Place { form, range, .. } = spot.place;
    let before = match form {
        Form::Empty if written.text[..range.start].ends_with([':', '-']) => " ",
        Form::Empty => ": ",
        _ => "",
    };
    aligned(written.text, Splice { range: range.clone(), with: format!("{before}{value}") })
}

/// A key or an item more.
pub(super) fn add(text: &str, place: &Place, index: usize, entry: &Entry) -> Splice {
    let value = emit::flow(&entry.value);
    let new = entry.key.as_ref().map_or_else(|| value.clone(), |key| format!("{}: {value}", emit::key(key)));
    let at = |at: usize, with: String| aligned(text, Splice { range: at..at, with });
    match (place.parts.get(index), index.checked_sub(1).and_then(|before| place.parts.get(before))) {
        (_, Some(before)) => at(before.place.range.end, format!(", {new}")),
        (Some(after), None) => at(after.start(), format!("{new}, ")),
        (None, None) => at(place.range.start + 1, new),
    }
}

/// A key or an item less.
pub(super) fn drop_part(text: &str, spot: &Spot<'_>) -> Splice {
    let parts = &spot.around.parts;
    let own = spot.part.start()..spot.place.range.end;
    let range = match (parts.get(spot.index + 1), spot.index.checked_sub(1)) {
        (Some(after), _) => own.start..after.start(),
        (None, Some(before)) => parts[before].place.range.end..own.end,
        (None, None) => spot.around.range.start + 1..spot.around.range.end - 1,
    };
    aligned(text, Splice { range, with: String::new() })
}

/// The splice with as many blanks before the comment at the end of its line that the comment stays where it is.
pub(super) fn aligned(text: &str, splice: Splice) -> Splice {
    let Splice { range, with } = splice;
    let one_line = !with.contains('\n') && !text[range.clone()].contains(['\n', '\r']);
    let Some(blanks) = comment_behind(text, range.end).filter(|_| one_line) else { return Splice { range, with } };
    let rest = &text[blanks..end(text, blanks)];
    let wide = rest.len() - rest.trim_start().len();
    if wide < 2 {
        return Splice { range, with };
    }
    let target = wide + text[range.clone()].chars().count();
    let wide = target.saturating_sub(with.chars().count()).max(1);
    let between = &text[range.end..blanks];
    let with = format!("{with}{between}{}", " ".repeat(wide));
    Splice { range: range.start..blanks + rest.len() - rest.trim_start().len(), with }
}
