//! What each amount is of, by the words around it.
//!
//! Knows nothing of what is made of it: see [`super::measures`].

use std::ops::Range;

use super::quantity::{Measure, Quantity};
use super::reading::Reading;
use super::vocabulary::{Cue, Word, vocabulary};
use crate::catalog::concepts::concepts;

/// An amount and what it is of.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Told {
    /// What it is of.
    pub cue: Cue,
    /// Tokens of the amount and of the words that tell.
    pub tokens: Range<usize>,
    /// Whether only a little word says so, such as "from".
    pub is_weak: bool,
}

/// What stands before an amount and may be what it is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    /// A thing that is in the water rather than on the bottom, or said to be.
    Afloat,
    /// Another thing.
    Thing,
    /// The vehicle or the sonar.
    Vehicle,
    /// Who looks, or the way that is gone.
    View,
    /// The lines of a survey.
    Lines,
    /// Nothing.
    Nothing,
}

/// What an amount is of, if words before it or behind it tell.
pub(super) fn cue_of(reading: &Reading<'_>, quantity: &Quantity) -> Option<Told> {
    let before = before(reading, quantity);
    let behind = behind(reading, quantity);
    match (before, behind) {
        (Some(before), Some(behind)) if before.is_weak => Some(behind),
        // `viewed from 5 m above the bottom`.
        (Some(before), Some(behind))
            if before.cue == Cue::ObjectRange
                && matches!(behind.cue, Cue::Altitude | Cue::BelowSurface | Cue::Depth) =>
        {
            Some(behind)
        }
        // `lines 5 m apart`: both words are of the same amount.
        (Some(before), Some(behind)) if is_same_kind(before.cue, behind.cue) => {
            // `pitch 5 degrees up`.
            let cue = if behind.cue == Cue::TiltUp { Cue::TiltUp } else { before.cue };
            Some(Told { cue, tokens: before.tokens.start..behind.tokens.end, ..before })
        }
        (Some(before), _) => Some(before),
        (None, behind) => behind,
    }
}

fn is_same_kind(one: Cue, other: Cue) -> bool {
    let kind = |cue| match cue {
        Cue::Spacing | Cue::Apart => 1,
        Cue::Depth | Cue::BelowSurface | Cue::DiveTo => 2,
        Cue::TiltDown | Cue::TiltUp => 3,
        Cue::MostRange | Cue::LeastRange | Cue::ObjectRange => 4,
        _ => 0,
    };
    one == other || (kind(one) != 0 && kind(one) == kind(other))
}

/// Whether an amount can be of this: lengths of angles are errors.
fn fits(cue: Cue, quantity: &Quantity, is_before: bool) -> bool {
    let measure = quantity.measure;
    let number = measure == Measure::Number && is_before;
    match cue {
        Cue::Depth
        | Cue::Altitude
        | Cue::ObjectRange
        | Cue::MostRange
        | Cue::LeastRange
        | Cue::RangeWindow
        | Cue::SonarDepth => measure == Measure::Length || number,
        Cue::BelowSurface
        | Cue::Visibility
        | Cue::AboveSurface
        | Cue::Apart
        | Cue::Spacing
        | Cue::Size
        | Cue::Wavelength
        | Cue::Relief
        | Cue::PathLength
        | Cue::Radius
        | Cue::DiveTo
        | Cue::Front
        | Cue::Behind
        | Cue::Left
        | Cue::Right
        | Cue::FromThing => measure == Measure::Length,
        Cue::Temperature => matches!(measure, Measure::Temperature | Measure::Angle) || number,
        Cue::Salinity => matches!(measure, Measure::Salinity | Measure::Share) || number,
        Cue::Ph | Cue::Seed => measure == Measure::Number && quantity.amount.ends()[0] >= 0.0,
        Cue::Frequency => measure == Measure::Frequency,
        Cue::Beams | Cue::Lines | Cue::Sides => measure == Measure::Number,
        Cue::Fov | Cue::TiltDown | Cue::TiltUp | Cue::Yaw | Cue::Slope | Cue::Heading | Cue::Arc => {
            measure == Measure::Angle || number
        }
        Cue::Motion => matches!(measure, Measure::Angle | Measure::Length),
        Cue::Speed => measure == Measure::Speed,
        Cue::Burial => measure == Measure::Share,
    }
}

fn before(reading: &Reading<'_>, quantity: &Quantity) -> Option<Told> {
    let start = quantity.tokens.start;
    for skipped in 0..=3.min(start) {
        let end = start - skipped;
        if skipped > 0 && !reading.is_link(end) {
            return None;
        }
        let found = (1..=7.min(end)).rev().find_map(|count| {
            let begin = end - count;
            let mut all = vocabulary().cues_before.all_at(&reading.text, begin);
            all.find(|(tokens, cue)| *tokens == count && fits(**cue, quantity, true)).map(|(_, cue)| (begin, *cue))
        });
        // Words such as "lines of" tell of two amounts.
        let shared = |cue: Cue| matches!(cue, Cue::PathLength | Cue::Spacing);
        // A single letter only with a sign: `T = 12 °C`.
        let lone = |begin: usize| {
            reading.text.form(begin).len() == 1
                && end - begin == 1
                && !(skipped > 0 && (reading.text.is_mark(end, '=') || reading.text.is_mark(end, ':')))
        };
        // A bare "and" goes on what was told of swaying.
        let and = |begin: usize| reading.text.form(begin) == "and" && (skipped > 0 || reading.wish.path.sway.is_none());
        let found = found.filter(|(begin, cue)| {
            (shared(*cue) || (*begin..end).all(|at| reading.is_free(at))) && !lone(*begin) && !and(*begin)
        });
        if let Some((begin, cue)) = found {
            let word = reading.text.form(begin);
            let single = end - begin == 1;
            let is_weak = single
                && matches!(
                    word,
                    "from"
                        | "for"
                        | "along"
                        | "and"
                        | "maximum"
                        | "max"
                        | "minimum"
                        | "de"
                        | "depuis"
                        | "sur"
                        | "por"
                        | "durante"
                        | "aus"
                        | "von"
                        | "desde"
                        | "every"
                        | "within"
                        | "alle"
                        | "cada"
                        | "range"
                        | "deep"
                        | "water"
                        | "高"
                        | "长"
                        | "s"
                        | "in"
                        | "buried"
                        | "sunk"
                )
                && !(word == "range" || word == "deep");
            return Some(Told { cue, tokens: begin..quantity.tokens.end, is_weak });
        }
    }
    None
}

fn behind(reading: &Reading<'_>, quantity: &Quantity) -> Option<Told> {
    let end = quantity.tokens.end;
    for skipped in 0..=1 {
        let begin = end + skipped;
        if skipped > 0 && !matches!(reading.text.form(end), "in" | "of" | "的" | "de" | "d" | "im" | "x") {
            return None;
        }
        let found = vocabulary()
            .cues_behind
            .all_at(&reading.text, begin)
            .find(|(_, cue)| fits(**cue, quantity, false))
            .map(|(tokens, cue)| (begin + tokens, *cue));
        if let Some((stop, cue)) = found.filter(|(stop, _)| (begin..*stop).all(|at| reading.is_free(at))) {
            // `8 m range 30 m`: the word is of what follows it.
            let mut next = stop;
            while reading.is_link(next) && next < stop + 3 || matches!(reading.text.form(next), ":" | "=") {
                next += 1;
            }
            let is_of_next = next < stop + 4
                && reading.quantity_at(next).is_some_and(|other| other.measure == quantity.measure)
                && vocabulary()
                    .cues_before
                    .all_at(&reading.text, begin)
                    .any(|(tokens, other)| begin + tokens == stop && is_same_kind(*other, cue));
            return (!is_of_next).then_some(Told { cue, tokens: quantity.tokens.start..stop, is_weak: false });
        }
    }
    None
}

/// What an amount at a token may be of: the nearest before it in its sentence, and whether a comma parts them.
pub(super) fn subject_before(reading: &Reading<'_>, start: usize) -> (Subject, bool) {
    let mut comma = false;
    let mut at = start;
    // Who is spoken of stands not far off.
    while at > 0 && at + 60 > start {
        at -= 1;
        let text = &reading.text;
        if text.is_mark(at, '.') || text.is_mark(at, ';') {
            break;
        }
        if text.is_mark(at, ',') || text.is_mark(at, '(') {
            comma = true;
        }
        let ends_with = |words: &[Word]| {
            (0..5.min(at + 1)).any(|back| words.iter().any(|word| reading.word(at - back, *word) == Some(back + 1)))
        };
        let is_line = |at: usize| matches!(text.form(at), "line" | "track" | "lane" | "leg" | "transect");
        let lines = (at.saturating_sub(1)..at + 1).any(|at| is_line(at) && reading.is_plural(at));
        if lines {
            return (Subject::Lines, comma);
        }
        if ends_with(&[Word::Row, Word::Heap]) {
            return (Subject::Thing, comma);
        }
        if ends_with(&[Word::Lawnmower]) || text.form(at) == "line" {
            return (Subject::Lines, comma);
        }
        if ends_with(&[Word::Floating, Word::Moored]) {
            let by_vehicle = (at.saturating_sub(3)..at).any(|before| reading.word(before, Word::Vehicle).is_some());
            // `hover 3 m above the bottom`: nothing else is spoken of.
            let alone = !(0..at).any(|before| reading.any_thing_at(before).is_some());
            return (if by_vehicle || alone { Subject::Vehicle } else { Subject::Afloat }, comma);
        }
        if let Some(tokens) = thing_over(reading, at) {
            return (if floats(reading, tokens) { Subject::Afloat } else { Subject::Thing }, comma);
        }
        if ends_with(&[Word::Vehicle]) {
            return (Subject::Vehicle, comma);
        }
        if ends_with(&[Word::ViewFrom, Word::Hover, Word::Follow, Word::Orbit]) {
            return (Subject::View, comma);
        }
    }
    (Subject::Nothing, comma)
}

/// Whether what a word tells is of a thing right before it: `a diver hovering`.
pub(super) fn is_said_of_thing(reading: &Reading<'_>, at: usize) -> bool {
    at > 0 && thing_over(reading, at - 1).is_some()
}

/// Tokens of a thing whose name ends at a token; the vehicle itself is none.
fn thing_over(reading: &Reading<'_>, at: usize) -> Option<Range<usize>> {
    (0..4.min(at + 1)).find_map(|back| {
        let begin = at - back;
        reading.thing_at(begin).filter(|tokens| begin + tokens == at + 1)?;
        let article = reading.text.form(begin.wrapping_sub(1));
        let is_vehicle =
            reading.word(begin, Word::Vehicle).is_some() && !matches!(article, "a" | "an" | "lost" | "missing");
        let is_bottom = reading.word(begin, Word::Bottom).is_some();
        let doubtful = vocabulary().doubtful.contains(reading.text.form(begin)) && article != "a" && article != "an";
        (!is_vehicle && !is_bottom && !doubtful).then_some(begin..at + 1)
    })
}

/// Whether a thing is one that is met in the water.
pub(super) fn floats(reading: &Reading<'_>, tokens: Range<usize>) -> bool {
    const AFLOAT: [&str; 9] =
        ["animal", "diver", "buoy", "moored-mine", "underwater-vehicle", "mine", "drone", "fish", "person"];
    let table = concepts();
    let units = table.read(reading.text.words(tokens));
    units.iter().flat_map(|unit| &unit.concepts).any(|&concept| {
        let name = table.name(concept);
        name != "bottom-mine"
            && !matches!(name, "sea-shell" | "starfish" | "sea-urchin" | "crab" | "lobster")
            && (AFLOAT.contains(&name) || table.groups(concept).any(|group| AFLOAT.contains(&table.name(group))))
    })
}
