//! How many images and scenes, the seed and the name.

use std::ops::Range;

use super::reading::Reading;
use super::token::Kind;
use super::vocabulary::{Bound, Vague, Word, vocabulary};
use crate::draft::Problem;
use crate::draft::wish::Amount;

/// Most frames of a drafted recipe.
pub(super) const MOST_IMAGES: f64 = 100_000.0;

/// Finds the numbers of images and scenes, the seed and the name.
pub(super) fn spot(reading: &mut Reading<'_>) {
    name(reading);
    let images = counted(reading, Word::Images);
    let scenes = counted(reading, Word::Scenes);
    for (tokens, _, _) in images.iter().chain(&scenes) {
        reading.take(tokens.clone());
    }
    if let Some((tokens, value, _)) = scenes.first() {
        match whole(*value, "scenes") {
            Ok(value) => reading.wish.scenes = Some(reading.said(tokens.clone(), value)),
            Err((what, help)) => reading.problems.push(Problem::of(reading.text.bytes(tokens.clone()), what, help)),
        }
    } else if let Some(tokens) = reading.find(Word::SameScene) {
        reading.take(tokens.clone());
        reading.wish.scenes = Some(reading.said(tokens, 1));
    }
    let words: Vec<Range<usize>> = images.iter().map(|(tokens, _, _)| tokens.clone()).collect();
    let is_each = images.iter().any(|(_, _, per_scene)| *per_scene);
    let sum: f64 = images.iter().map(|(_, value, _)| *value).sum();
    let scenes = scenes.first().map_or(1.0, |(_, value, _)| *value);
    let total = if is_each && scenes > 1.0 { sum * scenes } else { sum };
    if words.is_empty() {
        return;
    }
    match whole(total, "images") {
        Ok(value) => reading.wish.images = Some(reading.said_by(&words, value)),
        Err((what, help)) => {
            let bytes = reading.text.bytes(words[0].clone());
            reading.problems.push(Problem::of(bytes, what, help));
        }
    }
}

/// Counts of images or scenes: their tokens, how many, and whether that is for each scene.
fn counted(reading: &Reading<'_>, wanted: Word) -> Vec<(Range<usize>, f64, bool)> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < reading.len() {
        let number = number_at(reading, at).filter(|(tokens, _)| reading.is_free(tokens.start));
        let Some((number, value)) = number else {
            at += 1;
            continue;
        };
        at = number.end;
        let noun = noun_behind(reading, number.end, wanted).or_else(|| noun_before(reading, number.start, wanted));
        let Some(noun) = noun else { continue };
        let tokens = number.start.min(noun.start)..number.end.max(noun.end);
        // `after 30 frames` is when, not how many; `frame 30` is which.
        let is_time =
            reading.ending_at(&vocabulary().words, number.start).is_some_and(|(_, word)| *word == Word::After)
                && matches!(reading.text.form(number.start - 1), "after" | "nach" | "apres" | "tras" | "后");
        if is_time {
            continue;
        }
        let behind = tokens.end;
        let per_scene = reading.word(behind, Word::PerScene).is_some()
            || (reading.word(behind, Word::Each).is_some() && wanted == Word::Images)
            || matches!(reading.text.form(number.start.wrapping_sub(1)), "each" | "with" | "of")
                && scene_just_before(reading, number.start);
        at = at.max(tokens.end);
        found.push((tokens, value, per_scene));
    }
    found
}

/// A number as counts of images are said: `300`, `a few hundred`, `an` before a single image.
fn number_at(reading: &Reading<'_>, at: usize) -> Option<(Range<usize>, f64)> {
    if let Some(quantity) = reading.number_at(at) {
        let [low, high] = quantity.amount.ends();
        let value = match (&quantity.amount, quantity.bound) {
            (Amount::Between(..), Some(Bound::AtLeast)) => low,
            _ => high,
        };
        return Some((quantity.tokens.clone(), value));
    }
    if let Some((tokens, vague)) = vocabulary().vague.at(&reading.text, at) {
        let times = match vague {
            Vague::Couple => 2.0,
            Vague::Few | Vague::Some => 3.0,
            Vague::Several => 5.0,
            Vague::Many => 10.0,
            Vague::Dozens => return Some((at..at + tokens, 48.0)),
            Vague::Hundreds => return Some((at..at + tokens, 300.0)),
        };
        let (more, power) = vocabulary().powers.at(&reading.text, at + tokens)?;
        return (*power >= 10.0).then(|| (at..at + tokens + more, times * power));
    }
    let single = matches!(reading.text.form(at), "a" | "an") && reading.is_free(at);
    single.then(|| (at..at + 1, 1.0))
}

/// The noun that a number before it counts: with words between them that are no things.
fn noun_behind(reading: &Reading<'_>, from: usize, wanted: Word) -> Option<Range<usize>> {
    let article = matches!(reading.text.form(from.wrapping_sub(1)), "a" | "an");
    let mut at = from;
    // `ten (10) images`.
    at += usize::from(reading.text.is_mark(at, ')'));
    // `60张`: of pictures, where nothing else is named.
    let sheet = matches!(reading.text.form(at), "张" | "幅") && wanted == Word::Images;
    if sheet && reading.text.tokens.get(at + 1).is_none_or(|next| !next.is_ideograph()) {
        return Some(at..at + 1);
    }
    // `50张轮胎图像`.
    if matches!(reading.text.form(at), "张" | "幅") && wanted == Word::Images {
        let behind = at + 1 + reading.thing_at(at + 1).unwrap_or(0);
        if behind > at + 1 && reading.word(behind, wanted).is_some() {
            return Some(at..at + 1);
        }
    }
    while at < (from + 4).min(reading.len()) && reading.is_free(at) {
        if let Some(tokens) = reading.word(at, wanted) {
            // `a frame dataset`, `an image set`, `images`: an article counts one image only.
            let behind = reading.text.form(at + tokens);
            let is_single = !reading.is_plural(at + tokens - 1)
                && !matches!(behind, "data" | "dataset" | "set" | "of" if behind != "of");
            return (!article || is_single).then_some(at..at + tokens);
        }
        let token = &reading.text.tokens[at];
        let is_measure = vocabulary().measure_words.at(&reading.text, at).is_some();
        let passes = token.kind == Kind::Word
            && !article
            && (is_measure
                || (!token.is_ideograph()
                    && !is_between(&token.form)
                    && (at == from || reading.thing_at(at).is_none())));
        if !passes {
            return None;
        }
        at += 1;
    }
    None
}

/// Words that end what a number counts.
fn is_between(form: &str) -> bool {
    const ENDS: [&str; 34] = [
        "of", "and", "with", "on", "in", "at", "to", "from", "by", "for", "or", "per", "each", "the", "und", "mit",
        "auf", "von", "y", "con", "de", "en", "et", "avec", "sur", "d", "m", "deg", "beam", "khz", "mhz", "scene",
        "over", "x",
    ];
    ENDS.contains(&form)
}

/// `images: 300`, `# of frames: 36`, `number of images = 300`.
fn noun_before(reading: &Reading<'_>, number: usize, wanted: Word) -> Option<Range<usize>> {
    let mut end = number;
    while end > 0 && reading.text.is_mark(end - 1, '"') {
        end -= 1;
    }
    let marked = end > 0 && (reading.text.is_mark(end - 1, ':') || reading.text.is_mark(end - 1, '='));
    if marked {
        end -= 1;
        end -= usize::from(end > 0 && reading.text.is_mark(end - 1, '"'));
    } else if end > 0 && matches!(reading.text.form(end - 1), "be" | "is") {
        end -= 1;
    } else if !(end >= 2 && reading.text.form(end - 1).is_empty()) {
        return None;
    }
    let (begin, word) = reading.ending_at(&vocabulary().words, end)?;
    // `200 frames: three bottles`: the noun has its number.
    let is_counted = begin > 0
        && ((begin.saturating_sub(2)..=begin).any(|end| reading.number_at_end(end))
            || reading.text.form(begin - 1) == "sonar");
    (*word == wanted && !is_counted).then_some(begin..number)
}

fn scene_just_before(reading: &Reading<'_>, number: usize) -> bool {
    number >= 2 && reading.word(number - 2, Word::Scenes).is_some()
}

/// A count that a recipe takes, or what is wrong with it.
fn whole(value: f64, what: &str) -> Result<u64, (String, String)> {
    let help = format!("ask for 1 to 100,000 {what}, such as \"200 {what}\"");
    if value == 0.0 {
        return Err((format!("zero {what}: a dataset has at least one"), help));
    }
    if value < 0.0 {
        return Err((format!("{value} {what}: a number of {what} is not negative, at least 1"), help));
    }
    if value.fract() != 0.0 {
        return Err((format!("{value} {what}: a number of {what} is a whole one"), help));
    }
    if value > MOST_IMAGES {
        let hours = value * 0.03 / 3600.0;
        let gigabytes = value * 0.4 / 1000.0;
        return Err((
            format!(
                "{} {what} are more than are drafted at once: at 0.03 s and 0.4 MB each they would take {hours:.1} hours on two \
                 cores and {gigabytes:.0} GB",
                grouped(value)
            ),
            format!(
                "ask for up to 100,000 {what} at a time; a recipe's `sweep` or another `seed` makes more of the same kind"
            ),
        ));
    }
    Ok(value as u64)
}

/// `1,000,000`.
fn grouped(value: f64) -> String {
    let digits = format!("{value:.0}");
    let mut out = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// `call it scrap-iron`.
fn name(reading: &mut Reading<'_>) {
    for tokens in reading.find_all(Word::CallIt) {
        let mut begin = tokens.end;
        while reading.text.is_mark(begin, '"') || reading.text.is_mark(begin, ':') || reading.text.is_mark(begin, '\'')
        {
            begin += 1;
        }
        if begin >= reading.len() {
            continue;
        }
        let from = reading.text.tokens[begin].bytes.start;
        let rest = &reading.text.source[from..];
        let stops = |c: char| !(c.is_alphanumeric() || c == '-' || c == '_');
        let name: String = rest.split(stops).next().unwrap_or_default().to_lowercase();
        let alone =
            matches!(reading.text.form(tokens.start), "called" | "named" | "nombre" | "nom" | "namens" | "name");
        // `an object called anchor` is no name of a dataset.
        let of_dataset = (tokens.start.saturating_sub(2)..tokens.start).any(|at| {
            matches!(
                reading.text.form(at),
                "dataset" | "it" | "set" | "datensatz" | "conjunto" | "jeu" | "data" | ";" | ","
            )
        });
        if name.is_empty() || (alone && !of_dataset) {
            continue;
        }
        let end = (begin..reading.len()).find(|&at| reading.text.tokens[at].bytes.start >= from + name.len());
        let end = end.unwrap_or(reading.len());
        reading.take(tokens.start..end);
        reading.wish.name = Some(reading.said(tokens.start..end, name));
        return;
    }
}
