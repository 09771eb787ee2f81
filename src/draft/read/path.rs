//! How the vehicle moves: "from three sides", "lawnmower pattern", "follow the pipeline for 50 m".

use std::ops::Range;

use super::quantity::Quantity;
use super::reading::Reading;
use super::vocabulary::{Cue, Word};
use crate::draft::wish::{Route, Said};

/// Amounts that belong to a route, waiting for its words.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Parts {
    spacing_m: Option<(f64, Range<usize>)>,
    length_m: Option<(f64, Range<usize>)>,
    lines: Option<(f64, Range<usize>)>,
    sides: Option<(f64, Range<usize>)>,
    arc_deg: Option<(f64, Range<usize>)>,
    dive_m: Option<(f64, Range<usize>)>,
}

/// Keeps an amount of a route.
pub(super) fn measure(reading: &mut Reading<'_>, quantity: &Quantity, cue: Cue, tokens: Range<usize>) {
    let [low, high] = quantity.amount.ends();
    if cue == Cue::Motion {
        return sway(reading, quantity, tokens);
    }
    let parts = &mut reading.route;
    let (slot, value) = match cue {
        Cue::Spacing => (&mut parts.spacing_m, low),
        Cue::PathLength => (&mut parts.length_m, high),
        Cue::DiveTo => (&mut parts.dive_m, high),
        Cue::Lines => (&mut parts.lines, high),
        Cue::Sides => (&mut parts.sides, high),
        Cue::Arc => (&mut parts.arc_deg, high),
        _ => return,
    };
    if slot.is_none() && value > 0.0 {
        *slot = Some((value, tokens));
    }
}

/// `rolling by 3 degrees`, `drifting by 20 cm and 2 degrees`.
fn sway(reading: &mut Reading<'_>, quantity: &Quantity, tokens: Range<usize>) {
    let value = quantity.amount.ends()[1].abs();
    let is_said = |stem: &str| tokens.clone().any(|at| reading.text.form(at).starts_with(stem));
    let is_length = quantity.measure == super::quantity::Measure::Length;
    let known = reading.wish.path.sway.clone();
    let mut sway = known.as_ref().map(|said| said.value).unwrap_or_default();
    let slot = match (is_length, is_said("heav")) {
        (true, true) => &mut sway.heave_m,
        (true, false) => &mut sway.drift_m,
        (false, _) if is_said("roll") || is_said("balanc") || is_said("roulis") || is_said("横") => &mut sway.roll_deg,
        (false, _) if is_said("pitch") || is_said("nick") || is_said("tangage") => &mut sway.pitch_deg,
        (false, _) => &mut sway.yaw_deg,
    };
    // A bare "and" goes on what was said of drift.
    if tokens.len() > quantity.tokens.len() && reading.text.form(tokens.start) == "and" && known.is_none() {
        return;
    }
    *slot = Some(value);
    reading.wish.path.sway = Some(reading.said(tokens, sway));
}

/// Finds the route.
pub(super) fn spot(reading: &mut Reading<'_>) {
    heading(reading);
    places(reading);
    let route = dive(reading)
        .or_else(|| lawnmower(reading))
        .or_else(|| approach(reading))
        .or_else(|| views(reading))
        .or_else(|| orbit(reading))
        .or_else(|| hover(reading))
        .or_else(|| follow(reading));
    if let Some((words, route)) = route {
        for tokens in &words {
            reading.take(tokens.clone());
        }
        let said = reading.said_by(&words, route);
        if reading.wish.path.route.is_none() {
            reading.wish.path.route = Some(said);
        }
    }
}

type Found = Option<(Vec<Range<usize>>, Route)>;

fn dive(reading: &Reading<'_>) -> Found {
    let (depth_m, tokens) = reading.route.dive_m.clone()?;
    let mut words = vec![tokens];
    let back = reading.find(Word::ComeBack).map(|tokens| {
        let behind = tokens.end;
        words.push(tokens);
        // `come back after 30 frames`.
        (behind..(behind + 4).min(reading.len())).find_map(|at| {
            let number = reading.number_at(at)?;
            reading.word(number.tokens.end, Word::Images)?;
            words.push(number.tokens.clone());
            Some(number.amount.ends()[1] as u64)
        })
    });
    Some((words, Route::Dive { depth_m, back }))
}

fn lawnmower(reading: &mut Reading<'_>) -> Found {
    let word = reading.find_all(Word::Lawnmower).into_iter().find(|tokens| {
        let is_plain_survey =
            tokens.len() == 1 && matches!(reading.text.form(tokens.start), "survey" | "raster" | "bahnen");
        !is_plain_survey
            || tokens.start == 0
            || reading.text.is_mark(tokens.start - 1, '.')
            || !reading.sides.is_empty()
    });
    let parts = reading.route.clone();
    let lines = parts.lines.clone().filter(|(lines, _)| *lines >= 2.0);
    if word.is_none() && lines.is_none() && parts.spacing_m.is_none() {
        return None;
    }
    let mut words: Vec<Range<usize>> = word.into_iter().collect();
    let mut take = |part: &Option<(f64, Range<usize>)>| {
        part.as_ref().map(|(value, tokens)| {
            words.push(tokens.clone());
            *value
        })
    };
    let (spacing_m, lines, length_m) = (take(&parts.spacing_m), take(&lines), take(&parts.length_m));
    let area = reading.sides.first().cloned();
    if let Some((_, tokens)) = &area {
        let end = tokens.end + usize::from(is_area_word(reading.text.form(tokens.end)));
        // `a box of 60 m by 30 m`.
        let before = tokens.start.saturating_sub(2);
        let named = reading.text.form(before + 1) == "of" && is_area_word(reading.text.form(before));
        words.push(if named { before } else { tokens.start }..end);
    }
    let side = |place: usize| area.as_ref().and_then(|(sides, _)| sides.get(place).copied());
    let route = Route::Lawnmower {
        length_m: side(0).or(length_m),
        width_m: side(1),
        spacing_m,
        lines: lines.map(|lines| lines as u32),
    };
    Some((words, route))
}

fn is_area_word(form: &str) -> bool {
    matches!(
        form,
        "box"
            | "square"
            | "area"
            | "field"
            | "region"
            | "rectangle"
            | "zone"
            | "grid"
            | "patch"
            | "quadrat"
            | "feld"
            | "gebiet"
            | "flache"
            | "cuadro"
            | "cuadrado"
            | "carre"
            | "plot"
            | "site"
    )
}

fn approach(reading: &Reading<'_>) -> Found {
    let tokens = reading.find(Word::Approach)?;
    Some((vec![tokens], Route::Approach { from_m: None, to_m: None }))
}

fn views(reading: &Reading<'_>) -> Found {
    reading.find(Word::Views).map(|tokens| (vec![tokens], Route::Views))
}

fn orbit(reading: &Reading<'_>) -> Found {
    let parts = &reading.route;
    let word = reading.find(Word::Orbit);
    let different = reading.find(Word::DifferentSides);
    if word.is_none() && different.is_none() && parts.sides.is_none() && parts.arc_deg.is_none() {
        return None;
    }
    let mut words: Vec<Range<usize>> = word.into_iter().chain(different).collect();
    let mut take = |part: &Option<(f64, Range<usize>)>| {
        part.as_ref().map(|(value, tokens)| {
            words.push(tokens.clone());
            *value
        })
    };
    let (arc_deg, sides) = (take(&parts.arc_deg), take(&parts.sides));
    Some((words, Route::Orbit { arc_deg, sides: sides.map(|sides| sides as u32) }))
}

fn hover(reading: &Reading<'_>) -> Found {
    // `hovering` may be what a diver does: then a thing is what stands right before it.
    let tokens = reading
        .find_all(Word::Hover)
        .into_iter()
        .find(|tokens| !reading.is_negated(tokens.start) && !super::cue::is_said_of_thing(reading, tokens.start))?;
    Some((vec![tokens], Route::Hover))
}

fn follow(reading: &Reading<'_>) -> Found {
    let word = reading.find_all(Word::Follow).into_iter().find(|tokens| {
        let structure =
            reading.environment_at.as_ref().is_some_and(|place| (tokens.end..tokens.end + 4).contains(&place.start));
        let verb =
            !matches!(reading.text.form(tokens.start), "along" | "entlang" | "沿" | "inspect" | "check" | "inspection");
        structure || verb
    });
    let line = reading.find(Word::StraightLine).filter(|_| reading.route.length_m.is_some());
    let length = reading.route.length_m.clone();
    if word.is_none() && line.is_none() && length.is_none() {
        return None;
    }
    let what =
        reading.wish.environment.as_ref().map(|environment| environment.value.clone()).filter(|_| word.is_some());
    let mut words: Vec<Range<usize>> = word.into_iter().chain(line).collect();
    if let (Some(_), Some(place)) = (&what, &reading.environment_at) {
        words.push(place.clone());
    }
    let length_m = length.map(|(length, tokens)| {
        words.push(tokens);
        length
    });
    Some((words, Route::Follow { what, length_m }))
}

/// `facing north`, `heading south-east`.
fn heading(reading: &mut Reading<'_>) {
    const POINTS: [(Word, f64); 8] = [
        (Word::Northeast, 45.0),
        (Word::Northwest, 135.0),
        (Word::Southwest, 225.0),
        (Word::Southeast, 315.0),
        (Word::East, 0.0),
        (Word::North, 90.0),
        (Word::West, 180.0),
        (Word::South, 270.0),
    ];
    const BEFORE: [&str; 25] = [
        "facing", "heading", "north", "due", "towards", "toward", "going", "pointing", "look", "looking", "to",
        "course", "pointed", "nach", "richtung", "hacia", "al", "vers", "朝", "向", "point", "moving", "flying",
        "driving", "rumbo",
    ];
    for (word, degrees) in POINTS {
        for tokens in reading.find_all(word) {
            let before = tokens.start.checked_sub(1).map(|at| reading.text.form(at).to_owned()).unwrap_or_default();
            let alone = matches!(
                reading.text.form(tokens.start),
                "northward" | "eastward" | "southward" | "westward" | "due" | "朝" | "向" | "nach"
            );
            if BEFORE.contains(&before.as_str()) || alone {
                reading.take(tokens.clone());
                let from = if alone { tokens.start } else { tokens.start - 1 };
                reading.wish.path.heading_deg = Some(reading.said(from..tokens.end, degrees));
                return;
            }
        }
    }
}

/// Places of the vehicle: where it is, or the points of its way.
fn places(reading: &mut Reading<'_>) {
    let points: Vec<[f64; 3]> =
        reading.places.iter().filter_map(|place| Some([place.at[0]?, place.at[1]?, place.at[2]?])).collect();
    if points.len() >= 2 && points.len() == reading.places.len() {
        let words: Vec<Range<usize>> = reading.places.iter().map(|place| place.tokens.clone()).collect();
        reading.wish.path.points_m = Some(reading.said_by(&words, points));
        reading.places.clear();
        return;
    }
    let of_vehicle = reading.places.iter().position(|place| {
        let before = place.tokens.start.saturating_sub(4)..place.tokens.start;
        before.into_iter().any(|at| reading.word(at, Word::Vehicle).is_some())
    });
    if let Some(found) = of_vehicle {
        let place = reading.places.remove(found);
        if let [Some(x), Some(y), z] = place.at {
            let position: Said<[f64; 3]> = reading.said(place.tokens, [x, y, z.unwrap_or(2.0)]);
            reading.wish.path.position_m = Some(position);
        }
    }
}

/// Words of routes that say nothing of things.
pub(super) fn leftovers(reading: &mut Reading<'_>) {
    for word in [Word::Lawnmower, Word::ComeBack] {
        for tokens in reading.find_all(word) {
            reading.take(tokens);
        }
    }
}
