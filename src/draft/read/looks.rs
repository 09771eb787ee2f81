//! Several pictures of the same echoes: "with no noise, medium speckle and strong speckle".

use std::ops::Range;

use super::reading::Reading;
use super::vocabulary::Word;
use crate::draft::wish::{Amount, Look, LookChange};

/// How strong noise is said to be: its name, and of speckle and of noise how much.
const STRENGTHS: [(Word, &str, f64, f64); 4] = [
    (Word::Without, "no", 0.0, 0.0),
    (Word::Weak, "weak", 0.25, 0.5),
    (Word::Medium, "medium", 0.5, 1.0),
    (Word::Strong, "strong", 1.0, 3.0),
];

/// Finds looks that differ in noise.
pub(super) fn noise(reading: &mut Reading<'_>) {
    let mut found: Vec<(Range<usize>, Look)> = Vec::new();
    for tokens in reading.find_all(Word::NoiseFree) {
        let is_noise = (tokens.start..tokens.end)
            .any(|at| reading.word(at, Word::Noise).is_some() || reading.word(at, Word::Speckle).is_some())
            || tokens.len() > 1
            || matches!(reading.text.form(tokens.start), "noiseless" | "rauschfrei");
        if is_noise {
            reading.take(tokens.clone());
            found.push((tokens, look("no-noise", vec![LookChange::Speckle(0.0), LookChange::Noise(0.0)])));
        }
    }
    for noun in [Word::Speckle, Word::Noise] {
        for tokens in reading.find_all(noun) {
            for (words, name, speckle, noise) in strengths_before(reading, tokens.start) {
                let what = if noun == Word::Speckle { "speckle" } else { "noise" };
                let change =
                    if noun == Word::Speckle { LookChange::Speckle(speckle) } else { LookChange::Noise(noise) };
                let both = vec![LookChange::Speckle(0.0), LookChange::Noise(0.0)];
                let changes = if name == "no" && noun == Word::Noise { both } else { vec![change] };
                reading.take(words.clone());
                found.push((words.start..tokens.end, look(&format!("{name}-{what}"), changes)));
            }
            reading.take(tokens);
        }
    }
    // `with and without noise`.
    let both = (0..reading.len()).any(|at| {
        matches!(reading.text.form(at), "with" | "mit" | "avec" | "con")
            && matches!(reading.text.form(at + 2), "without" | "ohne" | "san" | "sin" | "sans")
    });
    if let ([(tokens, _)], true) = (found.as_slice(), both) {
        found.push((tokens.clone(), look("noise", vec![LookChange::Speckle(1.0), LookChange::Noise(1.0)])));
    }
    found.sort_by_key(|(tokens, _)| tokens.start);
    found.dedup_by(|(_, one), (_, other)| one.name == other.name);
    reading.wish.looks = found.into_iter().map(|(tokens, look)| reading.said(tokens, look)).collect();
}

fn look(name: &str, changes: Vec<LookChange>) -> Look {
    Look { name: name.to_owned(), changes }
}

type Strength = (Range<usize>, &'static str, f64, f64);

/// The strengths before a noun: `no, medium and strong`, the first first.
fn strengths_before(reading: &Reading<'_>, end: usize) -> Vec<Strength> {
    let mut all = Vec::new();
    let mut at = end;
    while at > 0 {
        let found = STRENGTHS.iter().find_map(|(word, name, speckle, noise)| {
            (1..=2.min(at))
                .find(|count| reading.is_free(at - count) && reading.word(at - count, *word) == Some(*count))
                .map(|count| (at - count..at, *name, *speckle, *noise))
        });
        let Some(found) = found else { break };
        at = found.0.start;
        all.push(found);
        // `no, medium and strong`: marks between them.
        let before = at;
        while at > 0
            && (reading.text.is_mark(at - 1, ',')
                || matches!(reading.text.form(at - 1), "and" | "und" | "y" | "et" | "和"))
        {
            at -= 1;
        }
        if at == before {
            break;
        }
    }
    all.reverse();
    all
}

/// Makes looks of waters of one scene: "the same scene in clear and in turbid water".
pub(super) fn of_one_scene(reading: &mut Reading<'_>) {
    let one_scene = reading.wish.scenes.as_ref().is_some_and(|scenes| scenes.value == 1);
    let again = reading.find(Word::SameScene).is_some();
    if !(one_scene || again) || !reading.wish.looks.is_empty() {
        return;
    }
    let turbidity = reading.wish.water.turbidity.clone().filter(|said| said.value.len() > 1);
    if let Some(said) = turbidity {
        let looks = said.value.iter().map(|kind| {
            let look = Look { name: kind.clone(), changes: vec![LookChange::Turbidity(kind.clone())] };
            crate::draft::wish::Said { value: look, source: said.source.clone() }
        });
        reading.wish.looks = looks.collect();
        reading.wish.water.turbidity = None;
        return;
    }
    let temperature = reading.wish.water.temperature_c.clone();
    if let Some(said) = temperature
        && let Amount::OneOf(values) = &said.value
    {
        let looks = values.iter().map(|value| {
            let look = Look { name: format!("{value}-c"), changes: vec![LookChange::Temperature(*value)] };
            crate::draft::wish::Said { value: look, source: said.source.clone() }
        });
        reading.wish.looks = looks.collect();
        reading.wish.water.temperature_c = None;
    }
}
