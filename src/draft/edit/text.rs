//! Changes of a recipe's text that leave everything else as it is: comments, order, blank lines, quotes, line ends.
//!
//! An act becomes edits of single values, keys and items; each is made in the text as it then stands, and the text is read
//! again: what it says must be what the act makes of the tree. Knows nothing of what values mean.

mod block;
mod emit;
mod flow;
mod lines;
mod order;
mod settle;

use std::ops::Range;

use super::act::Act;
use crate::recipe::path::{Step, steps};
use crate::recipe::places::{Form, Part, Place};
use crate::recipe::{Error, Node, Origin, parse};
use settle::{Edit, edits};

/// Makes one change in a text; `name` stands in messages.
///
/// # Errors
/// A text that is no recipe; a path that leads nowhere; a place whose form of writing cannot be changed.
pub fn apply(name: &str, text: &str, act: &Act) -> Result<String, Error> {
    let before = parse(name, text, Origin::Given)?;
    let mut wanted = before.clone();
    act.on(&mut wanted)?;
    let mut text = text.to_owned();
    for edit in edits(&before, &wanted) {
        text = made(&text, &edit).ok_or_else(|| cannot(&before, act))?;
    }
    match parse(name, &text, Origin::Given) {
        Ok(after) if after.json() == wanted.json() => Ok(text),
        _ => Err(cannot(&before, act)),
    }
}

/// A value on one line, as it stands in a text.
#[must_use]
pub fn in_line(value: &Node) -> String {
    emit::flow(value)
}

fn cannot(tree: &Node, act: &Act) -> Error {
    let help = "write it as `key: value` lines or in braces, without explicit keys (`?`), and ask again";
    tree.error(act.path(), "this is written in a way that cannot be changed here", help)
}

/// Bytes of a text, and what comes in their stead.
struct Splice {
    range: Range<usize>,
    with: String,
}

/// A text and its places.
struct Written<'a> {
    text: &'a str,
    root: Place,
}

/// A value in its text, and what is around it.
struct Spot<'a> {
    place: &'a Place,
    around: &'a Place,
    index: usize,
    part: &'a Part,
    /// Whether something around it is in brackets or braces.
    in_flow: bool,
}

fn made(text: &str, edit: &Edit) -> Option<String> {
    let written = Written { text, root: Place::of(text)? };
    let splice = match edit {
        Edit::Replace(path, value) => {
            let spot = written.spot(path)?;
            if spot.in_flow { flow::replace(&written, &spot, value) } else { block::replace(&written, &spot, value) }
        }
        Edit::Add { path, entry, index } => {
            let (place, in_flow) = written.place(path)?;
            match place.form {
                Form::FlowMap | Form::FlowList => flow::add(text, place, *index, entry),
                Form::BlockMap | Form::BlockList if !in_flow => block::add(&written, place, *index, entry),
                _ => return None,
            }
        }
        Edit::Drop(path) => {
            let spot = written.spot(path)?;
            match spot.around.form {
                Form::FlowMap | Form::FlowList => flow::drop_part(text, &spot),
                _ => block::drop_part(&written, &spot)?,
            }
        }
    };
    Some(splice.into(text))
}

impl Splice {
    fn into(self, text: &str) -> String {
        [&text[..self.range.start], &self.with, &text[self.range.end..]].concat()
    }
}

impl Written<'_> {
    /// The value at a path, and whether it is in brackets or braces, its own included.
    fn place(&self, path: &str) -> Option<(&Place, bool)> {
        let steps = steps(path).ok()?;
        let place = self.root.at(&steps)?;
        Some((place, self.in_flow(&steps)))
    }

    fn spot(&self, path: &str) -> Option<Spot<'_>> {
        let steps = steps(path).ok()?;
        let (last, way) = steps.split_last()?;
        let around = self.root.at(way)?;
        let (index, part) = around.part(last)?;
        Some(Spot { place: &part.place, around, index, part, in_flow: self.in_flow(way) })
    }

    /// Whether a value on the way is in brackets or braces.
    fn in_flow(&self, way: &[Step]) -> bool {
        let is_flow = |place: &Place| matches!(place.form, Form::FlowList | Form::FlowMap);
        (0..=way.len()).filter_map(|length| self.root.at(&way[..length])).any(is_flow)
    }
}

#[cfg(test)]
mod tests;
