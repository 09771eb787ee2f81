//! Amounts with their units: ranges, choices and steps of them, in SI.
//!
//! Knows nothing of what is measured: whether `12 m` is a depth or a length, others tell from the words around it.

use std::ops::Range;

use super::number::{Spoken, number_at};
use super::text::Text;
use super::token::Kind;
pub(in crate::draft) use super::unit::{Measure, Unit};
use super::vocabulary::{Bound, RangeWord, vocabulary};
use crate::draft::wish::Amount;

/// An amount in a prompt.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::draft) struct Quantity {
    /// Its tokens.
    pub tokens: Range<usize>,
    /// In the unit of its measure; the lower end first, but for steps. With a bound it is the open range: `up to 5 m` is
    /// 0 to 5, `at least 5 m` 5 to 10.
    pub amount: Amount,
    /// What it is of.
    pub measure: Measure,
    /// What it is bounded by.
    pub bound: Option<Bound>,
    /// Whether its ends were said the larger first: "five to three".
    pub falls: bool,
}

/// One end of a range.
#[derive(Clone, Copy, Debug)]
struct End {
    number: Spoken,
    unit: Option<Unit>,
    tokens: usize,
}

/// The amount that begins at a token: `12 m`, `10-25 m`, `between two and five`, `up to 40 feet`, `from 2 m to 15 m in
/// equal steps`, `5, 10 or 15 m`, `half a metre`, `-12 m`, `30 %`, `half`, `120`.
pub(in crate::draft) fn quantity_at(text: &Text<'_>, at: usize) -> Option<Quantity> {
    let mut next = at;
    let from = range_word(text, next, RangeWord::From);
    let bound = match from {
        Some(tokens) => {
            next += tokens;
            None
        }
        None => vocabulary().bounds.at(text, next).filter(|(tokens, _)| is_bound(text, next, *tokens)).map(
            |(tokens, bound)| {
                next += tokens;
                *bound
            },
        ),
    };
    let first = end_at(text, next)?;
    next += first.tokens;
    let mut ends = vec![first];
    let mut is_choice = false;
    if let Some((tokens, last)) = other_end(text, next, from.is_some()) {
        ends.push(last);
        next += tokens;
    } else if let Some((tokens, more)) = choice(text, next, first) {
        ends.extend(more);
        next += tokens;
        is_choice = true;
    }
    // `from` alone is a word of its own, and so is `de` in `de trois pneus`.
    if from.is_some() && ends.len() == 1 {
        return None;
    }
    let last_unit = ends.iter().rev().find_map(|end| end.unit);
    let (measure, factor, offset) = match last_unit {
        Some(unit) => unit.convert(),
        None if ends.iter().all(|end| end.number.is_share) => (Measure::Share, 1.0, 0.0),
        None => (Measure::Number, 1.0, 0.0),
    };
    let value = |end: &End| match end.unit.or(last_unit) {
        Some(unit) => end.number.value * unit.convert().1 + unit.convert().2,
        None => end.number.value * factor + offset,
    };
    let values: Vec<f64> = ends.iter().map(value).collect();
    let (first, last) = (values[0], values[values.len() - 1]);
    let steps = if values.len() == 2 && !is_choice { steps_at(text, next) } else { None };
    let trailing = vocabulary().bounds.at(text, next).filter(|(tokens, _)| is_trailing(text, next, *tokens));
    let bound = bound.or(trailing.map(|(_, bound)| *bound));
    next += trailing.map_or(0, |(tokens, _)| tokens);
    let amount = match (steps, bound) {
        (Some((tokens, count)), _) => {
            next += tokens;
            Amount::Steps(first, last, count)
        }
        _ if is_choice => Amount::OneOf(values),
        _ if ends.len() == 2 => Amount::Between(first.min(last), first.max(last)),
        (None, Some(Bound::AtMost)) if first > 0.0 => Amount::Between(0.0, first),
        (None, Some(Bound::AtLeast)) if first > 0.0 => Amount::Between(first, 2.0 * first),
        _ => Amount::Exactly(first),
    };
    Some(Quantity { tokens: at..next, amount, measure, bound, falls: ends.len() == 2 && !is_choice && last < first })
}

/// Lengths of the sides of something, metres, and their tokens: `20 by 20 m`, `10 m x 6 m`, `40x40`.
pub(in crate::draft) fn sides_at(text: &Text<'_>, at: usize) -> Option<(Vec<f64>, Range<usize>)> {
    let mut next = at;
    let mut ends = Vec::new();
    loop {
        let end = end_at(text, next).filter(|end| end.number.value > 0.0)?;
        next += end.tokens;
        ends.push(end);
        match range_word(text, next, RangeWord::By) {
            Some(tokens) if ends.len() < 3 && end_at(text, next + tokens).is_some() => next += tokens,
            _ => break,
        }
    }
    let unit = ends.iter().rev().find_map(|end| end.unit);
    if ends.len() < 2 || unit.is_some_and(|unit| unit.convert().0 != Measure::Length) {
        return None;
    }
    let metres = |end: &End| end.number.value * end.unit.or(unit).map_or(1.0, |unit| unit.convert().1);
    Some((ends.iter().map(metres).collect(), at..next))
}

fn range_word(text: &Text<'_>, at: usize, wanted: RangeWord) -> Option<usize> {
    vocabulary().ranges.all_at(text, at).find(|(_, word)| **word == wanted).map(|(tokens, _)| tokens)
}

/// A number with its unit, or a unit with an article: `a metre`.
fn end_at(text: &Text<'_>, at: usize) -> Option<End> {
    let article = |at: usize| {
        usize::from(matches!(text.form(at), "a" | "an" | "ein" | "eine" | "einen" | "einem" | "un" | "une"))
    };
    let Some(mut number) = number_at(text, at) else {
        let skipped = article(at);
        let (tokens, unit) = unit_at(text, at + skipped).filter(|_| skipped == 1 && text.form(at + 1).len() > 2)?;
        let one = Spoken { value: 1.0, tokens: skipped, is_share: false };
        return Some(half_more(text, at, End { number: one, unit: Some(unit), tokens: skipped + tokens }));
    };
    let mut tokens = number.tokens;
    // `two and a half metres`.
    if let Some((more, half)) = and_a_half(text, at + tokens).filter(|_| !number.is_share) {
        number.value += half;
        tokens += more;
    }
    let skipped = if number.is_share { article(at + tokens) } else { 0 };
    match unit_at(text, at + tokens + skipped) {
        Some((more, unit)) => {
            Some(half_more(text, at, End { number, unit: Some(unit), tokens: tokens + skipped + more }))
        }
        None => Some(End { number, unit: None, tokens }),
    }
}

/// `a metre and a half`.
fn half_more(text: &Text<'_>, at: usize, mut end: End) -> End {
    if let Some((more, half)) = and_a_half(text, at + end.tokens) {
        end.number.value += half;
        end.tokens += more;
    }
    end
}

fn and_a_half(text: &Text<'_>, at: usize) -> Option<(usize, f64)> {
    let and = range_word(text, at, RangeWord::And)?;
    let article = usize::from(matches!(text.form(at + and), "a" | "un" | "une"));
    let (tokens, share) = vocabulary().shares.at(text, at + and + article)?;
    let is_half = (*share - 0.5).abs() < 1e-9;
    // `half of them … and half lying`.
    let goes_on = article == 1 || matches!(text.form(at + and), "medio" | "media" | "demi" | "demie");
    (is_half && goes_on).then_some((and + article + tokens, 0.5))
}

fn unit_at(text: &Text<'_>, at: usize) -> Option<(usize, Unit)> {
    let token = text.tokens.get(at)?;
    let (tokens, unit) = vocabulary().units.at(text, at)?;
    let written = text.words(at..at + 1);
    // Marks and letters that mean much else.
    let fits = match token.form.as_str() {
        "'" | "\"" => token.glued,
        "c" | "f" | "k" => written.chars().all(char::is_uppercase),
        "s" => token.glued,
        _ => true,
    };
    fits.then_some((tokens, *unit))
}

/// The far end of a range, and the tokens up to it.
fn other_end(text: &Text<'_>, at: usize, after_from: bool) -> Option<(usize, End)> {
    let to = range_word(text, at, RangeWord::To);
    let and = range_word(text, at, RangeWord::And).filter(|_| after_from);
    let link = to.or(and)?;
    let end = end_at(text, at + link)?;
    // `1 - 2 tires` is a range, `12 m a 3 …` is none: only words that a language has for it are in the table.
    Some((link + end.tokens, end))
}

/// More values behind the first: `, 10 or 15 m`, `and 10 m`.
fn choice(text: &Text<'_>, at: usize, first: End) -> Option<(usize, Vec<End>)> {
    let mut next = at;
    let mut more = Vec::new();
    loop {
        let comma = text.is_mark(next, ',');
        let behind = next + usize::from(comma);
        let or = range_word(text, behind, RangeWord::Or);
        let and = range_word(text, behind, RangeWord::And);
        let link = usize::from(comma) + or.or(and).unwrap_or(0);
        if link == 0 {
            return None;
        }
        let end = end_at(text, next + link)?;
        next += link + end.tokens;
        more.push(end);
        if or.is_some() || and.is_some() {
            // Numbers of different things are joined by `and`, too: only what has one unit belongs together.
            let measured = |end: &End| end.unit.map(|unit| unit.convert().0);
            let same = match (measured(&first), end.unit) {
                (Some(of_first), Some(unit)) => of_first == unit.convert().0,
                (None, Some(_)) => true,
                (_, None) => or.is_some() && first.unit.is_none(),
            };
            let whole = !first.number.is_share && more.iter().all(|end| !end.number.is_share);
            return (same && whole).then_some((next - at, more));
        }
        if more.len() > 12 {
            return None;
        }
    }
}

/// `in equal steps`, `in five steps`: the tokens, and how many steps where that is said.
fn steps_at(text: &Text<'_>, at: usize) -> Option<(usize, Option<u32>)> {
    if let Some(tokens) = range_word(text, at, RangeWord::Steps) {
        return Some((tokens, None));
    }
    let comma = usize::from(text.is_mark(at, ','));
    let within = range_word(text, at + comma, RangeWord::In)?;
    let number = number_at(text, at + comma + within).filter(|number| number.value >= 2.0 && number.value < 1e6)?;
    let behind = at + comma + within + number.tokens;
    let equal = usize::from(matches!(text.form(behind), "equal" | "even" | "gleichen" | "egaux" | "egale" | "equally"));
    let step = range_word(text, behind + equal, RangeWord::Step)?;
    Some((comma + within + number.tokens + equal + step, Some(number.value as u32)))
}

/// Whether a bound is one here: signs such as `>` stand before digits only.
fn is_bound(text: &Text<'_>, at: usize, tokens: usize) -> bool {
    let is_sign = text.tokens.get(at).is_some_and(|token| matches!(token.kind, Kind::Mark(_)));
    !is_sign || text.tokens.get(at + tokens).is_some_and(|next| next.number().is_some())
}

/// Whether a bound belongs to what stands before it: `three or more`, `12米左右`.
fn is_trailing(text: &Text<'_>, at: usize, tokens: usize) -> bool {
    matches!(text.form(at), "or" | "and" | "左" | "oder" | "ou" | "o" | "give")
        && number_at(text, at + tokens).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &str) -> Option<(Amount, Measure)> {
        let text = Text::of(words);
        (0..text.tokens.len()).find_map(|at| quantity_at(&text, at)).map(|found| (rounded(found.amount), found.measure))
    }

    fn rounded(amount: Amount) -> Amount {
        let round = |value: f64| (value * 1000.0).round() / 1000.0;
        match amount {
            Amount::Exactly(value) => Amount::Exactly(round(value)),
            Amount::Between(low, high) => Amount::Between(round(low), round(high)),
            Amount::OneOf(values) => Amount::OneOf(values.into_iter().map(round).collect()),
            Amount::Steps(first, last, count) => Amount::Steps(round(first), round(last), count),
        }
    }

    #[test]
    fn amounts_come_in_si() {
        use Amount::{Between, Exactly, OneOf, Steps};
        use Measure::{Angle, Frequency, Length, Number, Salinity, Share, Speed, Temperature};
        for (words, amount, measure) in [
            ("12m", Exactly(12.0), Length),
            ("at 40 feet", Exactly(12.192), Length),
            ("6' deep", Exactly(1.829), Length),
            ("Five fathoms", Exactly(9.144), Length),
            ("8–15m", Between(8.0, 15.0), Length),
            ("between 10 and 25 m", Between(10.0, 25.0), Length),
            ("from 2 m to 15 m in equal steps", Steps(2.0, 15.0, None), Length),
            ("from 15 m to 2 m in five steps", Steps(15.0, 2.0, Some(5)), Length),
            ("2, 4 or 8 m", OneOf(vec![2.0, 4.0, 8.0]), Length),
            ("at 5, 10 and 15 m", OneOf(vec![5.0, 10.0, 15.0]), Length),
            ("up to five tires", Between(0.0, 5.0), Number),
            ("at least three", Between(3.0, 6.0), Number),
            ("half a metre", Exactly(0.5), Length),
            ("a metre and a half", Exactly(1.5), Length),
            ("two and a half metres", Exactly(2.5), Length),
            ("one metre off", Exactly(1.0), Length),
            ("−12 m depth", Exactly(-12.0), Length),
            ("20 cm", Exactly(0.2), Length),
            ("half buried", Exactly(0.5), Share),
            ("30 % buried", Exactly(0.3), Share),
            ("0 to 60 percent", Between(0.0, 0.6), Share),
            ("2 knots", Exactly(1.029), Speed),
            ("1.5 m/s", Exactly(1.5), Speed),
            ("28 °C", Exactly(28.0), Temperature),
            ("50°F", Exactly(10.0), Temperature),
            ("10 degrees Celsius", Exactly(10.0), Temperature),
            ("2.1 MHz", Exactly(2100.0), Frequency),
            ("1.2MHz", Exactly(1200.0), Frequency),
            ("750 kHz", Exactly(750.0), Frequency),
            ("35 ppt", Exactly(35.0), Salinity),
            ("130 degree field", Exactly(130.0), Angle),
            ("−15°", Exactly(-15.0), Angle),
            ("zwischen 10 und 25 m Tiefe mit einem Anker", Between(10.0, 25.0), Length),
            ("von 2 bis 15 m, der Anker und die Reifen", Between(2.0, 15.0), Length),
            ("entre 20 et 30 m, une ancre et un canon", Between(20.0, 30.0), Length),
            ("de 5 a 10 metros, un ancla y el barril", Between(5.0, 10.0), Length),
            ("水深10到15米", Between(10.0, 15.0), Length),
            ("水深十二米", Exactly(12.0), Length),
        ] {
            assert_eq!(read(words), Some((amount, measure)), "{words}");
        }
        let five_to_three = quantity_at(&Text::of("five to three barrels"), 0).expect("a range");
        assert!(five_to_three.falls && five_to_three.amount == Between(3.0, 5.0));
    }

    #[test]
    fn sides_of_areas() {
        let read = |words: &str| sides_at(&Text::of(words), 0).map(|(sides, _)| sides);
        assert_eq!(read("20 by 20 m box"), Some(vec![20.0, 20.0]));
        assert_eq!(read("40x30"), Some(vec![40.0, 30.0]));
        assert_eq!(read("10 m by 6 m by 2 m"), Some(vec![10.0, 6.0, 2.0]));
        assert_eq!(read("20 m"), None);
        assert_eq!(read("2 tires"), None);
    }
}
