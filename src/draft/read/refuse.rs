//! Requests that the reader can make no recipe of, and what to write instead.

use super::reading::Reading;
use super::vocabulary::{Word, vocabulary};
use crate::draft::Problem;

const EXAMPLE: &str =
    "say what is to be seen, such as \"300 images of two tires and a rusty anchor on a sandy bottom at 12 m depth\"";

/// A change of something that is there: it needs the recipe to change.
pub(super) fn edit(reading: &Reading<'_>) -> Option<Problem> {
    let text = &reading.text;
    let mut at = 0;
    while matches!(
        text.form(at),
        "please"
            | "now"
            | "then"
            | "can"
            | "could"
            | "you"
            | "would"
            | "ok"
            | "okay"
            | "and"
            | ","
            | "also"
            | "bitte"
            | "now,"
            | "hey"
            | "next"
            | "lets"
            | "jetzt"
            | "ahora"
            | "por"
            | "favor"
            | "maintenant"
            | "请"
            | "现"
            | "在"
            | "just"
            | "\""
    ) {
        at += 1;
    }
    // `Add a diver`, with nothing else said, is for a scene that is there.
    let wish = &reading.wish;
    let bare = reading.quantities.iter().all(|quantity| quantity.measure == super::quantity::Measure::Number)
        && (0..reading.len()).all(|at| vocabulary().sediments.at(text, at).is_none())
        && wish.sonar.devices.is_none();
    let add = matches!(text.form(at), "add" | "insert" | "hinzufugen" | "anade" | "agrega" | "ajoute" | "ajouter")
        .then_some((1, &()));
    let (tokens, ()) = vocabulary().edits.at(text, at).or(add.filter(|_| bare))?;
    // `Make the dataset …` begins a request.
    let behind = text.form(at + tokens);
    let is_request = reading.word(at + tokens, Word::Images).is_some()
        || matches!(
            behind,
            "dataset" | "data" | "set" | "training" | "recipe" | "collection" | "following" | "sonar dataset"
        );
    if is_request || reading.wish.images.is_some() {
        return None;
    }
    let what =
        format!("\"{}\" changes a recipe that is there, and a draft begins a new one", text.words(at..at + tokens));
    let help = format!("write `ensonify edit RECIPE \"{}\"` with the recipe that it is to change", text.source);
    Some(Problem::of(text.bytes(at..at + tokens), what, help))
}

/// All models at once.
pub(super) fn everything(reading: &Reading<'_>) -> Option<Problem> {
    let text = &reading.text;
    let at = (0..reading.len()).find(|&at| {
        let all = matches!(text.form(at), "every" | "all" | "each" | "alle" | "jede" | "todo" | "tou" | "tout");
        let noun = (at + 1..at + 4).any(|next| {
            matches!(
                text.form(next),
                "object"
                    | "model"
                    | "thing"
                    | "item"
                    | "asset"
                    | "objekt"
                    | "modell"
                    | "objeto"
                    | "modelo"
                    | "objet"
                    | "modele"
            )
        });
        let have = (at + 2..at + 9).any(|next| {
            matches!(
                text.form(next),
                "have"
                    | "know"
                    | "catalog"
                    | "catalogue"
                    | "available"
                    | "library"
                    | "exist"
                    | "hast"
                    | "katalog"
                    | "tiene"
                    | "avez"
            )
        });
        all && noun && have
    })?;
    let models: u64 = reading.known.catalogs.iter().map(|(_, catalog)| catalog.count()).sum();
    let what = format!(
        "every object there is: the catalogs have {models} models, and a million images take 8 hours on two cores and 400 GB \
         (0.03 s and 0.4 MB each)"
    );
    let help = "name the kinds that you need, such as \"2000 images of barrels, tires and anchors\"; `ensonify catalog list` shows them";
    Some(Problem::of(text.bytes(at..at + 2), what, help))
}

/// Negative counts of things: `-3 tires`.
pub(super) fn negative(reading: &Reading<'_>) -> Vec<Problem> {
    let mut found = Vec::new();
    for quantity in &reading.quantities {
        let [low, _] = quantity.amount.ends();
        let counts = quantity.measure == super::quantity::Measure::Number && reading.is_free(quantity.tokens.start);
        let noun = (quantity.tokens.end..quantity.tokens.end + 3).find(|&at| reading.thing_at(at).is_some());
        if let (true, Some(noun)) = (counts && (low < 0.0 || low.fract() != 0.0), noun) {
            let words = reading.text.words(quantity.tokens.start..noun + 1);
            let what = format!("{words}: a number of things is whole and at least 0, not {low}");
            let bytes = reading.text.bytes(quantity.tokens.start..noun + 1);
            found.push(Problem::of(bytes, what, "say how many, such as \"three tires\""));
        }
    }
    found
}

/// Only things that no catalog has.
pub(super) fn unknown_only(reading: &Reading<'_>) -> Option<Problem> {
    let unknown = &reading.wish.unknown;
    if unknown.is_empty() || !reading.wish.things.is_empty() {
        return None;
    }
    let names: Vec<&str> = unknown.iter().map(|thing| thing.called.as_str()).collect();
    let mut near: Vec<&str> = unknown.iter().flat_map(|thing| &thing.near).map(String::as_str).collect();
    near.dedup();
    let what = format!("no catalog has a model of {}", listed(&names));
    let instead = if near.is_empty() { String::new() } else { format!("there are {}; ", near.join(", ")) };
    let help = format!(
        "{instead}`ensonify catalog search \"{}\"` looks for more, and `ensonify catalog index FOLDER` adds models of your own",
        names[0]
    );
    let words = unknown[0].words.clone();
    Some(Problem { words, what, help })
}

/// Nothing that a dataset could be made of.
pub(super) fn nothing(reading: &Reading<'_>) -> Option<Problem> {
    let wish = &reading.wish;
    let said = !wish.things.is_empty()
        || !wish.without.is_empty()
        || wish.images.is_some()
        || wish.scenes.is_some()
        || wish.environment.is_some()
        || wish.seabed.shape.is_some()
        || wish.seabed.sediments.is_some()
        || wish.sonar.devices.is_some()
        || wish.water.depth_m.is_some()
        || wish.water.turbidity.is_some()
        || wish.path.route.is_some()
        || wish.path.points_m.is_some();
    let what = "no object, scene or image of a sonar dataset is spoken of";
    (!said).then(|| Problem::whole(what, EXAMPLE))
}

fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [only] => (*only).to_owned(),
        [all @ .., last] => format!("{} or {last}", all.join(", ")),
    }
}
