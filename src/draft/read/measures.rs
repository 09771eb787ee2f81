//! What the amounts of a prompt make of a wish.

use std::ops::Range;

use super::cue::{Subject, cue_of, subject_before};
use super::height::above_or_below;
use super::quantity::{Measure, Quantity};
use super::reading::Reading;
use super::vocabulary::{Bound, Cue, Word, vocabulary};
use crate::draft::wish::{Amount, Route, Said};

/// Something about where a thing is, waiting for the thing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StandCue {
    /// Its tokens.
    pub tokens: Range<usize>,
    /// What is said.
    pub cue: Cue,
    /// How much.
    pub amount: Amount,
}

/// Gives every amount its place in the wish; what is of things comes back.
pub(super) fn spot(reading: &mut Reading<'_>) -> Vec<StandCue> {
    let mut stands = Vec::new();
    // What words tell comes before what is only likely.
    for is_told in [Some(()), None] {
        for quantity in reading.quantities.clone() {
            if !quantity.tokens.clone().all(|at| reading.is_free(at)) {
                continue;
            }
            let told = cue_of(reading, &quantity);
            let (cue, tokens) = match (told, is_told) {
                (Some(told), Some(())) => (resolved(reading, &quantity, told.cue, &told.tokens), told.tokens),
                (None, None) => match uncued(reading, &quantity) {
                    Some(cue) => (cue, quantity.tokens.clone()),
                    None => continue,
                },
                _ => continue,
            };
            if is_of_things(cue) {
                stands.push(StandCue { tokens: tokens.clone(), cue, amount: quantity.amount.clone() });
                reading.take(tokens);
                continue;
            }
            apply(reading, &quantity, cue, tokens);
        }
    }
    stands.append(&mut reading.pending);
    stands.sort_by_key(|stand| stand.tokens.start);
    stands
}

fn is_of_things(cue: Cue) -> bool {
    matches!(
        cue,
        Cue::Apart
            | Cue::Size
            | Cue::Radius
            | Cue::Front
            | Cue::Behind
            | Cue::Left
            | Cue::Right
            | Cue::FromThing
            | Cue::Burial
    )
}

/// What words like "above the bottom" mean of what stands before them.
fn resolved(reading: &Reading<'_>, quantity: &Quantity, cue: Cue, tokens: &Range<usize>) -> Cue {
    let from = if matches!(cue, Cue::Spacing | Cue::Apart) { quantity.tokens.start } else { tokens.start };
    let (subject, comma) = subject_before(reading, from);
    let of_lines = tokens.clone().any(|at| matches!(reading.text.form(at), "line" | "lane" | "track" | "swath"));
    match (cue, subject) {
        (Cue::Spacing, _) if of_lines => Cue::Spacing,
        (Cue::Size, Subject::Lines) => Cue::PathLength,
        (Cue::Spacing | Cue::Apart, Subject::Lines) => Cue::Spacing,
        (Cue::Spacing | Cue::Apart, Subject::Thing | Subject::Afloat) => Cue::Apart,
        (Cue::Depth, Subject::Vehicle)
            if !comma && is_cued_behind(quantity, tokens) && !is_of_water(reading, tokens) =>
        {
            Cue::SonarDepth
        }
        // `a circle of 8 m radius`.
        (Cue::Radius, _)
            if reading
                .find(Word::Orbit)
                .is_some_and(|orbit| orbit.end <= tokens.start && orbit.end + 5 > tokens.start) =>
        {
            Cue::ObjectRange
        }
        (Cue::MostRange, _) if is_at(reading, quantity.tokens.start) && quantity.tokens.start == tokens.start => {
            Cue::ObjectRange
        }
        _ => cue,
    }
}

fn is_of_water(reading: &Reading<'_>, tokens: &Range<usize>) -> bool {
    tokens.clone().any(|at| matches!(reading.text.form(at), "water" | "wasser" | "agua" | "eau" | "水" | "wassertiefe"))
}

fn is_cued_behind(quantity: &Quantity, tokens: &Range<usize>) -> bool {
    quantity.tokens.start == tokens.start
}

fn is_at(reading: &Reading<'_>, start: usize) -> bool {
    start > 0
        && matches!(
            reading.text.form(start - 1),
            "at" | "auf" | "im" | "in" | "a" | "à" | "from" | "aus" | "bei" | "在"
        )
}

/// What an amount is that no words tell of.
fn uncued(reading: &Reading<'_>, quantity: &Quantity) -> Option<Cue> {
    let start = quantity.tokens.start;
    match quantity.measure {
        Measure::Temperature => Some(Cue::Temperature),
        Measure::Salinity => Some(Cue::Salinity),
        Measure::Frequency => Some(Cue::Frequency),
        Measure::Speed => Some(Cue::Speed),
        Measure::Angle => {
            let near_water = (start.saturating_sub(3)..(quantity.tokens.end + 2).min(reading.len()))
                .any(|at| matches!(reading.text.form(at), "water" | "wasser" | "agua" | "eau" | "水" | "温"));
            near_water.then_some(Cue::Temperature)
        }
        Measure::Length => {
            let first = reading.text.form(start);
            if quantity.bound == Some(Bound::AtMost) && matches!(first, "maximum" | "max") {
                return Some(Cue::MostRange);
            }
            if quantity.bound == Some(Bound::AtLeast) && matches!(first, "minimum" | "min") {
                return Some(Cue::LeastRange);
            }
            // `circle a block at 6 m`.
            let orbit = reading.find(Word::Orbit).is_some_and(|orbit| {
                orbit.end <= start
                    && (orbit.end..start).all(|at| !reading.text.is_mark(at, ',') && !reading.text.is_mark(at, '.'))
            });
            if orbit {
                return Some(Cue::ObjectRange);
            }
            // `from two to six metres`.
            if matches!(first, "from" | "von" | "de" | "desde" | "从")
                && quantity.amount.ends()[0] < quantity.amount.ends()[1]
                && !reading.text.is_mark(start.wrapping_sub(1), ',')
            {
                return Some(Cue::ObjectRange);
            }
            Some(if is_of_next_thing(reading, quantity) { Cue::Size } else { Cue::Depth })
        }
        Measure::Share => {
            let buried = (0..reading.len())
                .any(|at| matches!(reading.text.form(at), "bury" | "buried" | "sink" | "sunk" | "sunken"));
            (buried && !reading.text.tokens[start].is_mark('%') && quantity.amount.ends()[1] > 0.0)
                .then_some(Cue::Burial)
        }
        Measure::Number | Measure::Time => None,
    }
}

/// `a 40 m ship`, `a 10 m pool`: an article or number before and a thing or structure behind.
fn is_of_next_thing(reading: &Reading<'_>, quantity: &Quantity) -> bool {
    let (start, end) = (quantity.tokens.start, quantity.tokens.end);
    let is_structure = |at: usize| vocabulary().environments.at(&reading.text, at).is_some();
    if is_structure(end) {
        return true;
    }
    let article = start > 0
        && (matches!(
            reading.text.form(start - 1),
            "a" | "an" | "the" | "ein" | "eine" | "einen" | "un" | "une" | "inside"
        ) || reading.quantities.iter().any(|other| other.tokens.end == start && other.measure == Measure::Number));
    let named = (end..(end + 3).min(reading.len()))
        .take_while(|&at| reading.is_free(at) && !reading.is_link(at))
        .any(|at| reading.thing_at(at).is_some() || is_structure(at));
    article && named
}

/// Lower ends that make no sense at 0 are a tenth of the upper.
pub(super) fn open(quantity: &Quantity) -> Amount {
    match (&quantity.amount, quantity.bound) {
        (Amount::Between(_, high), Some(Bound::AtMost)) if quantity.amount.ends()[0] == 0.0 => {
            Amount::Between(high / 4.0, *high)
        }
        (amount, _) => amount.clone(),
    }
}

fn apply(reading: &mut Reading<'_>, quantity: &Quantity, cue: Cue, tokens: Range<usize>) {
    let amount = open(quantity);
    let [low, high] = amount.ends();
    let said = reading.said(tokens.clone(), amount.clone());
    let put = |slot: &mut Option<Said<Amount>>| {
        if slot.is_none() {
            *slot = Some(said.clone());
        }
    };
    let positive = |amount: &Amount| map(amount, f64::abs);
    match cue {
        Cue::Depth => {
            let depth = Said { value: positive(&amount), ..said.clone() };
            if reading.wish.water.depth_m.is_none() {
                reading.wish.water.depth_m = Some(depth);
            }
        }
        Cue::SonarDepth => put(&mut reading.wish.path.vehicle_depth_m),
        Cue::BelowSurface | Cue::Altitude | Cue::AboveSurface => {
            return above_or_below(reading, quantity, cue, tokens);
        }
        Cue::ObjectRange if (reading.find(Word::Approach).is_some() || quantity.falls) && high > low => {
            let route = Route::Approach { from_m: Some(high), to_m: Some(low) };
            reading.wish.path.route = Some(reading.said(tokens.clone(), route));
        }
        Cue::ObjectRange if reading.find(Word::Approach).is_some() && reading.wish.path.range_m.is_some() => {
            // `from 10 m, stop at 2 m`.
            let from = reading.wish.path.range_m.take().map_or(high, |said| said.value.ends()[1]);
            let route = Route::Approach { from_m: Some(from.max(high)), to_m: Some(from.min(high)) };
            reading.wish.path.route = Some(reading.said(tokens.clone(), route));
        }
        Cue::ObjectRange => put(&mut reading.wish.path.range_m),
        Cue::MostRange | Cue::RangeWindow if high > low && quantity.bound.is_none() => {
            reading.wish.sonar.least_range_m = Some(reading.said(tokens.clone(), Amount::Exactly(low)));
            reading.wish.sonar.most_range_m = Some(reading.said(tokens.clone(), Amount::Exactly(high)));
        }
        Cue::MostRange | Cue::RangeWindow => {
            reading.wish.sonar.most_range_m = Some(reading.said(tokens.clone(), bounded(&amount, high)));
        }
        Cue::LeastRange => reading.wish.sonar.least_range_m = Some(reading.said(tokens.clone(), bounded(&amount, low))),
        Cue::Visibility => {
            let kinds = [(0.5, "very-turbid"), (2.0, "turbid"), (5.0, "coastal"), (f64::INFINITY, "clear")];
            let kind = kinds.iter().find(|(most, _)| high < *most).map_or("clear", |(_, kind)| kind);
            reading.wish.water.turbidity = Some(reading.said(tokens.clone(), vec![kind.to_owned()]));
        }
        Cue::Temperature => put(&mut reading.wish.water.temperature_c),
        Cue::Salinity => put(&mut reading.wish.water.salinity_ppt),
        Cue::Ph => put(&mut reading.wish.water.ph),
        Cue::Frequency => put(&mut reading.wish.sonar.frequency_khz),
        Cue::Beams => {
            if (0.0..1e6).contains(&high) {
                reading.wish.sonar.beams = Some(reading.said(tokens.clone(), high as u32));
            }
        }
        Cue::Fov => put(&mut reading.wish.sonar.fov_deg),
        Cue::TiltDown | Cue::TiltUp => {
            let sign = if cue == Cue::TiltUp { 1.0 } else { -1.0 };
            let pitch = sorted(&map(&amount, |value| if value < 0.0 { value } else { sign * value }));
            reading.wish.sonar.pitch_deg = Some(reading.said(tokens.clone(), pitch));
        }
        Cue::Yaw => put(&mut reading.wish.sonar.yaw_deg),
        Cue::Slope => {
            put(&mut reading.wish.seabed.slope_deg);
            reading.wish.seabed.shape = Some(reading.said(tokens.clone(), "slope".into()));
        }
        // A compass course: north is 0 and 90 degrees here.
        Cue::Heading => reading.wish.path.heading_deg = Some(reading.said(tokens.clone(), turned(90.0 - low))),
        Cue::Speed => put(&mut reading.wish.path.speed_m_s),
        Cue::Wavelength => put(&mut reading.wish.seabed.wavelength_m),
        Cue::Relief => {
            put(&mut reading.wish.seabed.height_m);
            // `0.1 m high ripples` tell the shape, too.
            reading.take(quantity.tokens.clone());
            return;
        }
        Cue::Seed => reading.wish.seed = Some(reading.said(tokens.clone(), low as u64)),
        // Others read these: they need the words.
        Cue::Spacing | Cue::PathLength | Cue::DiveTo | Cue::Lines | Cue::Sides | Cue::Arc | Cue::Motion => {
            super::path::measure(reading, quantity, cue, tokens.clone());
        }
        Cue::Apart
        | Cue::Size
        | Cue::Radius
        | Cue::Front
        | Cue::Behind
        | Cue::Left
        | Cue::Right
        | Cue::FromThing
        | Cue::Burial => {}
    }
    reading.take(tokens);
}

/// An open range that is one value all the same: the end that was said.
fn bounded(amount: &Amount, end: f64) -> Amount {
    match amount {
        Amount::Between(..) => Amount::Exactly(end),
        other => other.clone(),
    }
}

fn map(amount: &Amount, f: impl Fn(f64) -> f64) -> Amount {
    match amount {
        Amount::Exactly(value) => Amount::Exactly(f(*value)),
        Amount::Between(low, high) => sorted(&Amount::Between(f(*low), f(*high))),
        Amount::OneOf(values) => Amount::OneOf(values.iter().map(|value| f(*value)).collect()),
        Amount::Steps(first, last, count) => Amount::Steps(f(*first), f(*last), *count),
    }
}

fn sorted(amount: &Amount) -> Amount {
    match amount {
        Amount::Between(low, high) => Amount::Between(low.min(*high), low.max(*high)),
        other => other.clone(),
    }
}

/// An angle from 0 up to 360 degrees.
pub(super) fn turned(degrees: f64) -> f64 {
    degrees.rem_euclid(360.0)
}
