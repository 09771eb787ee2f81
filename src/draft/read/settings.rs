//! Bottom, structure and water in words: "muddy", "sand waves", "a harbour", "murky", "in a lake".

use std::ops::Range;

use super::phrases::Phrases;
use super::reading::Reading;
use super::token::Kind;
use super::vocabulary::{Word, vocabulary};
use crate::draft::wish::Amount;

/// Words that tell a shape of the bottom only beside a word for the bottom.
const WEAK: [&str; 16] = [
    "even",
    "smooth",
    "rough",
    "rolling",
    "irregular",
    "lumpy",
    "hill",
    "slanted",
    "inclined",
    "uni",
    "unregelmassig",
    "glatt",
    "glatte",
    "平",
    "fixe",
    "incline",
];

/// Finds the structure that a scene is in.
pub(super) fn environment(reading: &mut Reading<'_>) {
    let mut found = all(reading, &vocabulary().environments);
    // `pipeline trench` is a shape.
    found.retain(|(tokens, _)| {
        vocabulary().shapes.at(&reading.text, tokens.start).is_none_or(|(longer, _)| longer <= tokens.len())
    });
    // `the pier of a harbour`: the first is what it is about; a dock in a harbour is part of it.
    let chosen = found
        .iter()
        .find(|(_, kind)| kind == "harbour" && found.iter().all(|(_, other)| other == "pier" || other == "harbour"));
    let Some((tokens, kind)) = chosen.or_else(|| found.first()).cloned() else { return };
    let words: Vec<Range<usize>> =
        found.iter().filter(|(_, other)| *other == kind).map(|(tokens, _)| tokens.clone()).collect();
    let _ = tokens;
    for (tokens, _) in &found {
        reading.take(tokens.clone());
    }
    reading.wish.environment = Some(reading.said_by(&words[..1], kind));
    reading.environment_at = Some(words[0].clone());
}

/// Gives the structure the lengths that stand beside it: "a 10 m pool", "a tank 10 m by 6 m".
pub(super) fn environment_sizes(reading: &mut Reading<'_>, stands: &mut Vec<super::measures::StandCue>) {
    let Some(place) = reading.environment_at.clone() else { return };
    let beside = |tokens: &Range<usize>| tokens.start <= place.end + 2 && place.start <= tokens.end + 1;
    let mut lengths: Vec<f64> = Vec::new();
    let mut words: Vec<Range<usize>> = Vec::new();
    reading.sides.retain(|(sides, tokens)| {
        if beside(tokens) {
            lengths.extend(sides);
            words.push(tokens.clone());
        }
        !beside(tokens)
    });
    let mut last = place.end;
    stands.retain(|stand| {
        let own = stand.cue == super::vocabulary::Cue::Size
            && (stand.tokens.end == place.start || (stand.tokens.start >= place.end && stand.tokens.start <= last + 2));
        if own {
            last = stand.tokens.end.max(last);
            lengths.push(stand.amount.ends()[1]);
            words.push(stand.tokens.clone());
        }
        !own
    });
    if !lengths.is_empty() {
        for tokens in &words {
            reading.take(tokens.clone());
        }
        reading.wish.environment_m = Some(reading.said_by(&words, lengths));
    }
}

/// Finds what the bottom is of and how it is shaped.
pub(super) fn seabed(reading: &mut Reading<'_>) {
    let mut shapes = all(reading, &vocabulary().shapes);
    shapes.retain(|(tokens, _)| !reading.is_negated(tokens.start));
    if let Some((tokens, shape)) = shapes.first().cloned() {
        for (tokens, _) in &shapes {
            reading.take(tokens.clone());
        }
        // `a reef with sand ripples`: a flat bottom is what is said of the bottom without saying more.
        let best = shapes.iter().find(|(_, shape)| shape != "flat").cloned().unwrap_or((tokens, shape));
        if reading.wish.seabed.shape.is_none() {
            reading.wish.seabed.shape = Some(reading.said(best.0, best.1));
        }
    }
    let mut words = Vec::new();
    let mut kinds: Vec<String> = Vec::new();
    let mut at_clay = None;
    for (tokens, sediments) in all(reading, &vocabulary().sediments) {
        let is_off = reading.is_negated(tokens.start);
        reading.take(tokens.clone());
        if is_off {
            continue;
        }
        if matches!(
            reading.text.form(tokens.start),
            "clay" | "clayey" | "ton" | "lehm" | "arcilla" | "argile" | "粘" | "黏"
        ) {
            at_clay = Some(reading.text.words(tokens.clone()).to_owned());
        }
        words.push(tokens);
        for sediment in sediments {
            if !kinds.contains(&sediment) {
                kinds.push(sediment);
            }
        }
    }
    if let Some(clay) = at_clay {
        reading.wish.notes.push(format!("{clay}: the nearest sediments of recipes are mud and silt"));
    }
    if !kinds.is_empty() {
        reading.wish.seabed.sediments = Some(reading.said_by(&words, kinds));
    }
    // Words for the bottom itself say nothing more.
    for tokens in reading.find_all(Word::Bottom) {
        // `bottom mine`.
        let of_thing = reading.any_thing_at(tokens.start).is_some_and(|count| count > tokens.len());
        if !of_thing {
            reading.take(tokens);
        }
    }
}

/// Finds how clear, salty and warm the water is.
pub(super) fn water(reading: &mut Reading<'_>) {
    let found: Vec<(Range<usize>, String)> = all(reading, &vocabulary().turbidities)
        .into_iter()
        .filter(|(tokens, _)| !is_order(reading, tokens.start))
        .collect();
    let mut words = Vec::new();
    let mut kinds: Vec<String> = Vec::new();
    for (tokens, kind) in found {
        reading.take(tokens.clone());
        if reading.is_negated(tokens.start) {
            continue;
        }
        words.push(tokens);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    if !kinds.is_empty() {
        reading.wish.water.turbidity = Some(reading.said_by(&words, kinds));
    }
    for (word, salinity) in [(Word::Fresh, 0.0), (Word::Brackish, 8.0), (Word::SaltWater, 35.0)] {
        if let Some(tokens) = reading.find(word) {
            reading.take(tokens.clone());
            if reading.wish.water.salinity_ppt.is_none() {
                reading.wish.water.salinity_ppt = Some(reading.said(tokens, Amount::Exactly(salinity)));
            }
        }
    }
    for (word, range) in [(Word::Shallow, (2.0, 6.0)), (Word::DeepWater, (50.0, 150.0))] {
        if let Some(tokens) = reading.find(word) {
            reading.take(tokens.clone());
            if reading.wish.water.depth_m.is_none() {
                reading.wish.water.depth_m = Some(reading.said(tokens, Amount::Between(range.0, range.1)));
            }
        }
    }
    for (word, range) in [(Word::Tropical, (24.0, 30.0)), (Word::Arctic, (-1.0, 4.0))] {
        if let Some(tokens) = reading.find(word) {
            reading.take(tokens.clone());
            if reading.wish.water.temperature_c.is_none() {
                reading.wish.water.temperature_c = Some(reading.said(tokens, Amount::Between(range.0, range.1)));
            }
        }
    }
}

/// `Clear the scene` is no water.
fn is_order(reading: &Reading<'_>, at: usize) -> bool {
    let next = reading.text.form(at + 1);
    matches!(reading.text.form(at), "clear" | "cloudy" | "clara" | "klar")
        && (matches!(
            next,
            "the" | "all" | "everything" | "it" | "away" | "up" | "out" | "view" | "image" | "shadow" | "picture"
        ))
}

/// How the sonar is held, in words: "level", "no tilt".
pub(super) fn sonar(reading: &mut Reading<'_>) {
    if let Some(tokens) = reading.find(Word::Level)
        && reading.wish.sonar.pitch_deg.is_none()
    {
        reading.take(tokens.clone());
        reading.wish.sonar.pitch_deg = Some(reading.said(tokens, Amount::Exactly(0.0)));
    }
}

/// Every free place of a table's phrases that is no part of the name of a thing.
fn all<T: Clone>(reading: &Reading<'_>, phrases: &Phrases<T>) -> Vec<(Range<usize>, T)> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < reading.len() {
        let phrase =
            phrases.at(&reading.text, at).filter(|(tokens, _)| (at..at + tokens).all(|at| reading.is_free(at)));
        match phrase {
            Some((tokens, means)) if !is_of_thing(reading, at, tokens) => {
                found.push((at..at + tokens, means.clone()));
                at += tokens;
            }
            _ => at += 1,
        }
    }
    found
}

/// Whether words that may tell of the surroundings belong to a thing: `scuba tank`, `three pebbles`, `a coral`, `clay pot`.
fn is_of_thing(reading: &Reading<'_>, at: usize, tokens: usize) -> bool {
    let covers =
        |from: usize| reading.thing_at(from).is_some_and(|count| from + count > at && (from < at || count > tokens));
    if (at.saturating_sub(3)..=at).any(covers) {
        return true;
    }
    let form = reading.text.form(at);
    // `lying flat`.
    if form == "flat"
        && matches!(reading.text.form(at.wrapping_sub(1)), "lying" | "laying" | "laid" | "lie" | "resting")
    {
        return true;
    }
    let is_bottom_word = |near: usize| {
        reading.word(near, Word::Bottom).is_some() || vocabulary().sediments.at(&reading.text, near).is_some()
    };
    if tokens == 1 && WEAK.contains(&form) {
        let around = (at.saturating_sub(3)..at).chain(at + 1..(at + 4).min(reading.len()));
        return !around.into_iter().any(is_bottom_word);
    }
    // A thing by its own name: only if it is counted or has an article, and no word for the bottom behind it.
    let is_thing = reading.thing_at(at) == Some(tokens);
    let counted = at > 0
        && (reading.number_at_end(at)
            || matches!(reading.text.form(at - 1), "a" | "an" | "ein" | "eine" | "un" | "une")
            || reading.ending_at(&vocabulary().vague, at).is_some());
    let ambiguous = matches!(
        form,
        "cobble"
            | "pebble"
            | "coral"
            | "reef"
            | "kiesel"
            | "galet"
            | "guijarro"
            | "koralle"
            | "felsbrocken"
            | "caillou"
    );
    is_thing && ambiguous && counted && !is_bottom_word(at + tokens)
        || form == "ton" && reading.text.tokens.get(at).is_some_and(|token| token.kind == Kind::Word) && counted
}
