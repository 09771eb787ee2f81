//! Shares of training, validation and test: "70/20/10", "80 % training and 20 % validation", "split by object".

use std::ops::Range;

use super::quantity::{Measure, quantity_at};
use super::reading::Reading;
use super::vocabulary::Word;
use crate::draft::wish::Splits;

/// Finds how frames are to be split.
pub(super) fn spot(reading: &mut Reading<'_>) {
    let by = [(Word::ByAsset, "asset"), (Word::ByScene, "scene"), (Word::ByVariant, "variant")]
        .into_iter()
        .find_map(|(word, by)| reading.find(word).map(|tokens| (tokens, by.to_owned())));
    if let Some((tokens, _)) = &by {
        reading.take(tokens.clone());
    }
    let shares = row_of_numbers(reading).or_else(|| named_shares(reading)).or_else(|| two_only(reading));
    let mut words: Vec<Range<usize>> = by.iter().map(|(tokens, _)| tokens.clone()).collect();
    let mut value = [0.8, 0.1, 0.1];
    if let Some((tokens, shares)) = &shares {
        words.extend(tokens.iter().cloned());
        value = *shares;
    }
    if by.is_some() || shares.is_some() {
        for tokens in &words {
            reading.take(tokens.clone());
        }
        for word in [Word::Train, Word::Validation, Word::Test, Word::Split] {
            for tokens in near(reading, word, &words) {
                reading.take(tokens);
            }
        }
        let by = by.map(|(_, by)| by);
        reading.wish.splits = Some(reading.said_by(&words, Splits { shares: value, by }));
    }
}

/// Places of a word that stand beside words that were read: at most six tokens off.
fn near(reading: &Reading<'_>, word: Word, words: &[Range<usize>]) -> Vec<Range<usize>> {
    let beside = |tokens: &Range<usize>| {
        words.iter().any(|known| tokens.start <= known.end + 6 && known.start <= tokens.end + 6)
    };
    reading.find_all(word).into_iter().filter(beside).collect()
}

/// `70/20/10`, `80-10-10`, `80:20`, `0.8, 0.1, 0.1` where splits are spoken of.
fn row_of_numbers(reading: &Reading<'_>) -> Option<(Vec<Range<usize>>, [f64; 3])> {
    let text = &reading.text;
    for at in 0..reading.len() {
        let mut numbers = Vec::new();
        let mut next = at;
        while let Some(value) = text.tokens.get(next).and_then(|token| token.number()).filter(|_| reading.is_free(next))
        {
            numbers.push(value);
            next += 1;
            next += usize::from(text.is_mark(next, '%'));
            let parts =
                ['/', '-', ':', ','].into_iter().any(|mark| text.is_mark(next, mark)) || text.form(next) == "and";
            let goes_on = parts && text.tokens.get(next + 1).is_some_and(|token| token.number().is_some());
            if !goes_on {
                break;
            }
            next += 1;
        }
        if !(2..=3).contains(&numbers.len()) {
            continue;
        }
        let sum: f64 = numbers.iter().sum();
        let spoken = [Word::Split, Word::Train]
            .into_iter()
            .any(|word| !near(reading, word, std::slice::from_ref(&(at..next))).is_empty());
        let slashes = (at..next).any(|at| text.is_mark(at, '/'));
        if numbers.len() == 3 && spoken && slashes && (sum - 100.0).abs() > 1.5 && (sum - 1.0).abs() > 0.015 {
            // What is wrong with them is told of the wish.
            let words = at..next;
            return Some((vec![words], [numbers[0] / 100.0, numbers[1] / 100.0, numbers[2] / 100.0]));
        }
        let whole = if (sum - 100.0).abs() < 1.5 { 100.0 } else { 1.0 };
        let is_spoken_of = [Word::Split, Word::Train, Word::Validation, Word::Test]
            .into_iter()
            .any(|word| !near(reading, word, std::slice::from_ref(&(at..next))).is_empty());
        let slashes = (at..next).any(|at| text.is_mark(at, '/') || text.is_mark(at, ':'));
        if (sum - whole).abs() > 0.015 * whole || !(is_spoken_of || (slashes && numbers.len() == 3)) {
            continue;
        }
        let share = |place: usize| numbers.get(place).copied().unwrap_or(0.0) / sum;
        // Two shares are those of training and of what is named second.
        let around = std::slice::from_ref(&(at..next)).to_vec();
        let only_test =
            !near(reading, Word::Test, &around).is_empty() && near(reading, Word::Validation, &around).is_empty();
        let shares = match numbers.len() {
            2 if only_test => [share(0), 0.0, share(1)],
            _ => [share(0), share(1), share(2)],
        };
        let words = at..next;
        return Some((vec![words], shares));
    }
    None
}

/// `70% training, 20% validation, rest test`; `train 0.7, val 0.2`.
fn named_shares(reading: &Reading<'_>) -> Option<(Vec<Range<usize>>, [f64; 3])> {
    const WORDS: [Word; 3] = [Word::Train, Word::Validation, Word::Test];
    let mut shares: [Option<f64>; 3] = [None; 3];
    let mut words = Vec::new();
    let mut at = 0;
    while at < reading.len() {
        let found = quantity_at(&reading.text, at).filter(|found| found.tokens.clone().all(|at| reading.is_free(at)));
        let Some(found) = found else {
            at += 1;
            continue;
        };
        at = found.tokens.end;
        let value = match found.measure {
            Measure::Share => found.amount.ends()[0],
            Measure::Number if found.amount.ends()[0] < 1.0 => found.amount.ends()[0],
            _ => continue,
        };
        let link = |at: usize| {
            matches!(
                reading.text.form(at),
                "for"
                    | "of"
                    | "to"
                    | "in"
                    | "the"
                    | "as"
                    | "für"
                    | "fur"
                    | "pour"
                    | "para"
                    | ":"
                    | "="
                    | "zum"
                    | "into"
            )
        };
        let mut behind = found.tokens.end;
        while link(behind) && behind < found.tokens.end + 3 {
            behind += 1;
        }
        let mut before = found.tokens.start;
        while before > 0 && link(before - 1) && before + 3 > found.tokens.start {
            before -= 1;
        }
        for (slot, word) in shares.iter_mut().zip(WORDS) {
            if slot.is_some() {
                continue;
            }
            if let Some(tokens) = reading.word(behind, word) {
                *slot = Some(value);
                words.push(found.tokens.start..behind + tokens);
                at = behind + tokens;
                break;
            }
            let ends_here = (1..=2.min(before)).find(|count| reading.word(before - count, word) == Some(*count));
            if let Some(count) = ends_here {
                *slot = Some(value);
                words.push(before - count..found.tokens.end);
                break;
            }
        }
    }
    let told: f64 = shares.iter().flatten().sum();
    let missing = shares.iter().filter(|share| share.is_none()).count();
    if missing == 3 || told > 1.01 {
        return None;
    }
    let no_test = reading.find(Word::Test).is_some_and(|tokens| reading.is_negated(tokens.start));
    let rest = (1.0 - told).max(0.0);
    // What was named without a share gets the rest, else what follows does.
    let gets: Vec<usize> = (0..3)
        .filter(|&place| shares[place].is_none() && !(place == 2 && no_test))
        .filter(|&place| missing == 1 || reading.find(WORDS[place]).is_some())
        .collect();
    let gets = if gets.is_empty() { (0..3).filter(|&place| shares[place].is_none()).take(1).collect() } else { gets };
    let mut all = [0.0; 3];
    for place in 0..3 {
        let of_rest = if gets.contains(&place) { rest / gets.len() as f64 } else { 0.0 };
        all[place] = shares[place].unwrap_or(of_rest);
    }
    Some((words, all))
}

/// `no test set`, `training and validation only`, `only training`.
fn two_only(reading: &Reading<'_>) -> Option<(Vec<Range<usize>>, [f64; 3])> {
    let test = reading.find(Word::Test).filter(|tokens| reading.is_negated(tokens.start));
    let validation = reading.find(Word::Validation).filter(|tokens| reading.is_negated(tokens.start));
    match (validation, test) {
        (Some(val), Some(test)) => Some((vec![val, test], [1.0, 0.0, 0.0])),
        (None, Some(test)) => Some((vec![test], [0.8, 0.2, 0.0])),
        (Some(val), None) => Some((vec![val], [0.8, 0.0, 0.2])),
        (None, None) => None,
    }
}
