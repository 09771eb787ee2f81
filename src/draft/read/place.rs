//! Places of the world in numbers: `(0, 0, 3)`, `x=2, y=-1, z=-6`.

use std::ops::Range;

use super::number::number_at;
use super::text::Text;

/// A place: x east, y north, z up, metres, as far as they were said.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::draft) struct Place {
    /// x, y, z.
    pub at: [Option<f64>; 3],
    /// Its tokens.
    pub tokens: Range<usize>,
}

impl Place {
    /// x and y, where both were said.
    pub(in crate::draft) fn flat(&self) -> Option<[f64; 2]> {
        Some([self.at[0]?, self.at[1]?])
    }
}

/// The place that begins at a token.
pub(in crate::draft) fn place_at(text: &Text<'_>, at: usize) -> Option<Place> {
    in_brackets(text, at).or_else(|| by_letters(text, at))
}

fn in_brackets(text: &Text<'_>, at: usize) -> Option<Place> {
    let opened = text.is_mark(at, '(') || text.is_mark(at, '[');
    if !opened {
        return None;
    }
    let mut place = [None; 3];
    let mut next = at + 1;
    for (axis, slot) in place.iter_mut().enumerate() {
        let number = number_at(text, next)?;
        *slot = Some(number.value);
        next += number.tokens;
        next += usize::from(text.form(next) == "m");
        if text.is_mark(next, ')') || text.is_mark(next, ']') {
            return (axis > 0).then_some(Place { at: place, tokens: at..next + 1 });
        }
        let parted = text.is_mark(next, ',') || text.is_mark(next, ';');
        if !parted {
            return None;
        }
        next += 1;
    }
    None
}

fn by_letters(text: &Text<'_>, at: usize) -> Option<Place> {
    let mut place = [None; 3];
    let mut next = at;
    let mut end = at;
    while let Some(axis) = ["x", "y", "z"].iter().position(|letter| *letter == text.form(next)) {
        next += 1;
        next += usize::from(text.is_mark(next, '=') || text.is_mark(next, ':'));
        let Some(number) = number_at(text, next).filter(|_| place[axis].is_none()) else { break };
        place[axis] = Some(number.value);
        next += number.tokens;
        next += usize::from(text.form(next) == "m");
        end = next;
        while text.is_mark(next, ',') || text.is_mark(next, ';') || text.form(next) == "and" {
            next += 1;
        }
    }
    // `x3` alone is a count.
    (place.iter().flatten().count() > 1 || (end > at + 2 && text.is_mark(at + 1, '=')))
        .then_some(Place { at: place, tokens: at..end })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_read_in_both_forms() {
        let read = |words: &str| place_at(&Text::of(words), 0).map(|place| place.at);
        assert_eq!(read("(0,0) and (10,10)"), Some([Some(0.0), Some(0.0), None]));
        assert_eq!(read("(10, -5.5, 3)"), Some([Some(10.0), Some(-5.5), Some(3.0)]));
        assert_eq!(read("x=2, y=-1, z=−6 and north"), Some([Some(2.0), Some(-1.0), Some(-6.0)]));
        assert_eq!(read("z=-6"), Some([None, None, Some(-6.0)]));
        assert_eq!(read("[3 m; 4 m]"), Some([Some(3.0), Some(4.0), None]));
        for words in ["x3", "(at least three)", "(15 of them)", "(3)", "(1, 2", "(1,2,3,4)"] {
            assert_eq!(read(words), None, "{words}");
        }
    }
}
