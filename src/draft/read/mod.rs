//! The built-in drafter: reads requests in English, German, Spanish, French and Chinese with tables of words, offline.
//!
//! ```text
//! prompt ─ text (tokens, language, errors repaired) ─ numbers ─ spotters ─► Wish, or what cannot be
//! ```
//! Each spotter goes over the tokens that none before it has made something of, takes what it understands and gives it its
//! place in the wish; what is left over and names a thing is one to place. Words are in `catalogs/vocabulary.yaml`, names of
//! things in `catalogs/synonyms.yaml`. The same prompt always gives the same wish.

mod counts;
mod cue;
mod determiner;
mod device;
mod height;
mod looks;
pub(in crate::draft) mod meaning;
mod measures;
mod noun;
pub(in crate::draft) mod number;
mod output;
mod path;
pub(in crate::draft) mod phrases;
pub(in crate::draft) mod place;
pub(in crate::draft) mod quantity;
mod reading;
mod refuse;
mod settings;
mod splits;
mod stand;
#[cfg(test)]
pub(in crate::draft) mod summary;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_more;
pub(in crate::draft) mod text;
mod things;
mod things_many;
mod things_told;
pub(in crate::draft) mod token;
pub(in crate::draft) mod unit;
pub(in crate::draft) mod vocabulary;

use reading::Reading;
use vocabulary::Word;

use super::sense::sense;
use super::wish::{Said, Source, Wish};
use super::{Known, Options, Prompt, Refusal};

/// What a prompt asks for.
///
/// # Errors
/// If no recipe can be made of it: changes of another recipe, things that no catalog has, numbers that cannot be, and what
/// is no request for a dataset.
pub fn read(prompt: &Prompt, known: &Known) -> Result<Wish, Refusal> {
    let mut reading = Reading::of(prompt.text(), known);
    device::spot(&mut reading);
    splits::spot(&mut reading);
    reading.find_numbers();
    counts::spot(&mut reading);
    output::spot(&mut reading);
    if let Some(problem) = refuse::edit(&reading) {
        return Err(problem.into());
    }
    looks::noise(&mut reading);
    settings::environment(&mut reading);
    let mut stands = measures::spot(&mut reading);
    settings::environment_sizes(&mut reading, &mut stands);
    settings::sonar(&mut reading);
    path::spot(&mut reading);
    settings::water(&mut reading);
    settings::seabed(&mut reading);
    looks::of_one_scene(&mut reading);
    path::leftovers(&mut reading);
    reading.problems.extend(refuse::negative(&reading));
    reading.problems.extend(refuse::everything(&reading));
    things::spot(&mut reading, stands);
    anything(&mut reading);
    options(&mut reading.wish, &prompt.options);
    if reading.problems.is_empty() {
        reading.problems.extend(refuse::unknown_only(&reading).or_else(|| refuse::nothing(&reading)));
    }
    if reading.problems.is_empty() {
        sense(&reading.wish)?;
        return Ok(reading.wish);
    }
    let mut problems = std::mem::take(&mut reading.problems);
    problems.dedup();
    Err(Refusal { problems })
}

/// `some stuff`: things of any kind, where nothing else is named.
fn anything(reading: &mut Reading<'_>) {
    if !reading.wish.things.is_empty() || !reading.wish.unknown.is_empty() {
        return;
    }
    let empty = reading.find(Word::EmptyScene).is_some();
    let said = reading.find_all(Word::Anything).into_iter().find(|tokens| !reading.is_negated(tokens.start));
    let Some(tokens) = said.filter(|_| !empty) else { return };
    if let Ok(found) = reading.models("debris") {
        let called = reading.said(tokens.clone(), reading.text.words(tokens).to_owned());
        reading.wish.things.push(super::wish::Thing {
            called,
            label: found.label,
            models: found.models,
            count: None,
            size_m: None,
            stands: Vec::new(),
        });
    }
}

/// Options win over what the prompt says.
fn options(wish: &mut Wish, options: &Options) {
    fn put<T: Clone>(slot: &mut Option<Said<T>>, option: Option<&T>, name: &'static str) {
        if let Some(value) = option {
            *slot = Some(Said { value: value.clone(), source: Source::Option(name) });
        }
    }
    put(&mut wish.images, options.images.as_ref(), "--images");
    put(&mut wish.seed, options.seed.as_ref(), "--seed");
    put(&mut wish.name, options.name.as_ref(), "--name");
    put(&mut wish.sonar.devices, options.sonar.as_ref().map(|sonar| vec![sonar.clone()]).as_ref(), "--sonar");
}
