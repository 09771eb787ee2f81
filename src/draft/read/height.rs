//! Heights over the bottom and depths below the surface: of a thing, or of the vehicle.

use std::ops::Range;

use super::cue::{Subject, floats, subject_before};
use super::measures::{StandCue, open};
use super::quantity::Quantity;
use super::reading::Reading;
use super::vocabulary::{Cue, Word};
use crate::draft::Problem;

/// Heights over the bottom and depths below the surface are of a thing or of the vehicle.
pub(super) fn above_or_below(reading: &mut Reading<'_>, quantity: &Quantity, cue: Cue, tokens: Range<usize>) {
    let (subject, comma) = subject_before(reading, tokens.start);
    // `a diver beside the wreck, 3 m above the bottom`: the diver is, unless somebody looks from there.
    let looks = [Word::ViewFrom, Word::Vehicle].iter().any(|word| reading.find(*word).is_some());
    let elsewhere = subject == Subject::Thing && cue == Cue::Altitude && !looks && afloat_before(reading, tokens.start);
    let subject = if elsewhere { Subject::Afloat } else { subject };
    let of_thing = match subject {
        Subject::Afloat => !(comma && cue == Cue::Altitude && is_view(reading, &tokens)),
        // Things on the bottom are not afloat: whose height is told is the sonar.
        Subject::Thing => cue != Cue::Altitude,
        Subject::Vehicle | Subject::View | Subject::Lines | Subject::Nothing => false,
    };
    if cue == Cue::AboveSurface {
        let what = format!("{}: sonar sees nothing above the surface", reading.text.words(tokens.clone()));
        let help = "say how far it is above the bottom or below the surface, such as \"3 m above the bottom\"";
        reading.problems.push(Problem::of(reading.text.bytes(tokens.clone()), what, help));
    } else if of_thing {
        reading.pending.push(StandCue { tokens: tokens.clone(), cue, amount: open(quantity) });
    } else {
        let said = reading.said(tokens.clone(), open(quantity));
        let path = &mut reading.wish.path;
        let slot = if cue == Cue::Altitude { &mut path.altitude_m } else { &mut path.vehicle_depth_m };
        if slot.is_none() {
            *slot = Some(said);
        }
    }
    reading.take(tokens);
}

/// Whether something before an amount in its sentence is in the water.
fn afloat_before(reading: &Reading<'_>, start: usize) -> bool {
    let begin = (0..start)
        .rev()
        .find(|&at| reading.text.is_mark(at, '.') || reading.text.is_mark(at, ';'))
        .map_or(0, |at| at + 1);
    (begin.max(start.saturating_sub(40))..start)
        .any(|at| reading.any_thing_at(at).is_some_and(|count| floats(reading, at..at + count)))
}

/// Whether words just before an altitude are of a view or a path: `viewed from 5 m above`.
fn is_view(reading: &Reading<'_>, tokens: &Range<usize>) -> bool {
    let begin = tokens.start.saturating_sub(4);
    (begin..tokens.end).any(|at| {
        [Word::ViewFrom, Word::Vehicle, Word::Lawnmower].iter().any(|word| reading.word(at, *word).is_some())
            || matches!(reading.text.form(at), "altitude" | "altitud" | "高度")
    })
}
