//! From a wish to the text of a recipe, each line with the words that led to it or the reason why it was chosen.
//!
//! Writes closed words, numbers and names of catalogs; what somebody typed stands in comments alone. Knows nothing of how
//! prompts are read.

mod asked;
mod depth;
mod environment;
mod head;
mod layout;
mod looks;
mod objects;
pub(in crate::draft) mod page;
mod path;
mod placing;
mod pose;
mod routes;
mod seabed;
mod sizes;
mod solve;
mod sonar;
mod structure;
mod view;
mod water;
mod way;
pub(in crate::draft) mod yaml;

#[cfg(test)]
mod tests;

use super::infer::budget::{LEAST_SCENES_TO_SPLIT, SHARES};
use super::{Known, Problem, Prompt, Refusal, Wish};
use crate::scene::AssetCache;
use asked::{Asked, assumed};
use layout::Layout;
use page::Page;
use yaml::Yaml;

/// A recipe, and what a person should know of it besides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Composed {
    /// Its text.
    pub recipe: String,
    /// What could not be as it was asked for, and what to expect: these stand in the recipe's heading too.
    pub notes: Vec<String>,
}

/// The text of a recipe that fulfils a wish. `by` is who read the prompt: the built-in drafter, or a model's name.
///
/// # Errors
/// What of the wish cannot be, with the words that ask for it and the remedy.
pub fn compose(wish: &Wish, prompt: &Prompt, known: &Known, by: &str) -> Result<String, Refusal> {
    composed(wish, prompt, known, by).map(|composed| composed.recipe)
}

/// The same, with its notes.
///
/// # Errors
/// As [`compose`].
pub fn composed(wish: &Wish, prompt: &Prompt, known: &Known, by: &str) -> Result<Composed, Refusal> {
    let asked = Asked { wish, prompt, assets: AssetCache::new(&known.folder) };
    something(&asked)?;
    let mut notes = Vec::new();
    let layout = Layout::of(&asked, &mut notes)?;
    objects::check(&asked, layout.structure.as_ref(), &layout.placings)?;

    let mut page = Page::default();
    counts(&mut page, &asked, &layout);
    sonar::write(&mut page, &asked, &layout);
    water::write(&mut page, &asked, &layout);
    seabed::write(&mut page, &asked, &layout);
    environment::write(&mut page, &layout);
    objects::write(&mut page, &asked, &layout, &mut notes);
    path::write(&mut page, &asked, &layout, &mut notes);
    looks::write(&mut page, &asked, &mut notes);
    splits(&mut page, &asked, &layout);
    if !wish.looks.is_empty() {
        notes.push(format!("{} looks of each frame: as many pictures for each", wish.looks.len()));
    }
    let head = head::head(&asked, by, &notes);
    let notes = wish.notes.iter().chain(&notes).map(|note| page::printable(note)).collect();
    Ok(Composed { recipe: head.text() + &page.text(), notes })
}

/// Refuses a wish for nothing but what no catalog has.
fn something(asked: &Asked) -> Result<(), Problem> {
    let Some(unknown) = asked.wish.unknown.first().filter(|_| asked.wish.things.is_empty()) else { return Ok(()) };
    let what = format!("no catalog has a model of \"{}\"", unknown.called);
    let near = unknown.near.iter().take(5).map(String::as_str).collect::<Vec<_>>().join(", ");
    let help = match near.is_empty() {
        true => "index models of it with `ensonify catalog index`, or ask for something else".to_owned(),
        false => format!("there are {near}; or index models of it with `ensonify catalog index`"),
    };
    Err(match &unknown.words {
        Some(words) => Problem::of(words.clone(), what, help),
        None => Problem::whole(what, help),
    })
}

/// Name, seed, scenes and frames.
fn counts(page: &mut Page, asked: &Asked, layout: &Layout) {
    let (wish, budget) = (asked.wish, layout.budget);
    page.set(0, "ensonify", &Yaml::whole(crate::recipe::VERSION.into()), "");
    let (name, why) = head::name(asked);
    page.set(0, "name", &Yaml::word(&name), &why);
    match &wish.seed {
        Some(said) => page.set(0, "seed", &Yaml::whole(said.value), &asked.why(&said.source)),
        None => page.set(0, "seed", &Yaml::whole(0), &assumed("another seed, another dataset")),
    }
    let plural = |count: u64, name: &str| if count == 1 { format!("1 {name}") } else { format!("{count} {name}s") };
    let product = format!("{} of {}", plural(budget.scenes, "scene"), plural(budget.frames, "frame"));
    let scenes_why = match (&wish.images, &wish.scenes) {
        (Some(images), Some(scenes)) => {
            format!("{}, {}: {product}", asked.why(&images.source), asked.why(&scenes.source))
        }
        (Some(images), None) => format!("{}: {product}", asked.why(&images.source)),
        (None, Some(scenes)) => asked.why(&scenes.source),
        (None, None) => assumed("enough to look at"),
    };
    page.set(0, "scenes", &Yaml::whole(budget.scenes), &scenes_why);
    page.set(0, "frames", &Yaml::whole(budget.frames), "");
}

fn splits(page: &mut Page, asked: &Asked, layout: &Layout) {
    let (shares, by, why) = match &asked.wish.splits {
        Some(said) => (said.value.shares, said.value.by.clone(), asked.why(&said.source)),
        None if layout.budget.scenes >= LEAST_SCENES_TO_SPLIT => (SHARES, None, assumed("the usual shares")),
        None => ([1.0, 0.0, 0.0], None, assumed("too few scenes to deal out")),
    };
    page.blank();
    let [train, val, test] = shares.map(Yaml::number);
    let by = Yaml::word(by.as_deref().unwrap_or("scene"));
    page.set(0, "splits", &Yaml::map([("train", train), ("val", val), ("test", test), ("by", by)]), &why);
}
