//! Numbers and words that are expected, and whether what was found is one of them.

use std::fmt;

use serde::Deserialize;

/// How far off a measured amount may be: conversions are rounded by whoever reads.
const TOLERANCE: f64 = 0.02;

/// From so many worlds on, a range must show in what is drawn.
const ENOUGH_WORLDS: usize = 8;

/// A number that is expected.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Number {
    Exactly(f64),
    Between([f64; 2]),
    Range {
        from: f64,
        to: f64,
    },
    OneOf {
        #[serde(rename = "one-of")]
        one_of: Vec<f64>,
    },
    Some(SomeWord),
}

/// The word `some`.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SomeWord {
    Some,
}

/// Whether a number counts or measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grain {
    Counted,
    Measured,
}

impl Number {
    /// Whether all of these values are what is expected; no values never are.
    pub fn takes(&self, values: &[f64], grain: Grain) -> bool {
        let all = |right: &dyn Fn(f64) -> bool| !values.is_empty() && values.iter().all(|&value| right(value));
        match self {
            Self::Exactly(expected) => all(&|value| is(value, *expected, grain)),
            Self::Between([low, high]) => all(&|value| within(value, [*low, *high], grain)),
            Self::Range { from, to } => {
                all(&|value| within(value, [*from, *to], grain)) && varies(values, [*from, *to], grain)
            }
            Self::OneOf { one_of } => one_of.iter().any(|&expected| all(&|value| is(value, expected, grain))),
            Self::Some(SomeWord::Some) => values.iter().sum::<f64>() > 0.0,
        }
    }

    /// Whether these numbers of one thing in each world are what is expected.
    pub fn counts(&self, in_each: &[f64]) -> bool {
        let asks_for_one = match self {
            Self::Between([_, high]) => *high >= 1.0,
            _ => false,
        };
        self.takes(in_each, Grain::Counted) && (!asks_for_one || in_each.iter().any(|&count| count >= 1.0))
    }
}

fn is(value: f64, expected: f64, grain: Grain) -> bool {
    match grain {
        Grain::Counted => value == expected,
        Grain::Measured => (value - expected).abs() <= TOLERANCE * expected.abs().max(1.0),
    }
}

fn within(value: f64, [low, high]: [f64; 2], grain: Grain) -> bool {
    (low..=high).contains(&value) || is(value, low, grain) || is(value, high, grain)
}

/// Whether values were drawn from a range, as far as so few can tell.
fn varies(values: &[f64], [from, to]: [f64; 2], grain: Grain) -> bool {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if values.len() >= ENOUGH_WORLDS {
        return most - least >= 0.3 * (to - from);
    }
    grain == Grain::Counted || most > least
}

impl fmt::Display for Number {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exactly(value) => write!(out, "{value}"),
            Self::Between([low, high]) => write!(out, "[{low}, {high}]"),
            Self::Range { from, to } => write!(out, "from {from} to {to}"),
            Self::OneOf { one_of } => write!(out, "one of {one_of:?}"),
            Self::Some(SomeWord::Some) => write!(out, "some"),
        }
    }
}

/// A word, or several of which each is right.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Words {
    One(String),
    Any(Vec<String>),
}

impl Words {
    pub fn all(&self) -> &[String] {
        match self {
            Self::One(word) => std::slice::from_ref(word),
            Self::Any(words) => words,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(yaml: &str) -> Number {
        serde_yaml::from_str(yaml).expect(yaml)
    }

    #[test]
    fn amounts_are_rounded_and_counts_are_not() {
        assert!(number("12.19").takes(&[12.192, 12.2], Grain::Measured));
        assert!(!number("12.19").takes(&[12.192, 13.0], Grain::Measured), "one of two");
        assert!(!number("300").takes(&[301.0], Grain::Counted));
        assert!(!number("300").takes(&[], Grain::Counted), "nothing was found");
        assert!(number("{one-of: [10, 11]}").takes(&[11.0], Grain::Counted));
        assert!(!number("{one-of: [10, 11]}").takes(&[10.0, 11.0], Grain::Counted));
    }

    #[test]
    fn a_range_that_was_asked_for_is_drawn_from() {
        let range = number("{from: 10, to: 25}");
        assert!(range.takes(&[11.0, 24.0], Grain::Measured));
        assert!(!range.takes(&[17.0, 17.0], Grain::Measured), "always the same");
        assert!(!range.takes(&[9.0, 24.0], Grain::Measured), "outside");
        assert!(!range.takes(&[17.0, 17.1, 17.2, 17.0, 17.0, 17.0, 17.0, 17.0], Grain::Measured), "hardly a range");
        assert!(number("[10, 25]").takes(&[17.0, 17.0], Grain::Measured));
    }

    #[test]
    fn things_are_counted_in_each_world() {
        assert!(number("some").counts(&[0.0, 1.0]));
        assert!(!number("some").counts(&[0.0, 0.0]));
        assert!(!number("[0, 5]").counts(&[0.0, 0.0]), "up to five are not none at all");
        assert!(number("0").counts(&[0.0, 0.0]));
        assert!(!number("2").counts(&[2.0, 1.0]));
    }
}
