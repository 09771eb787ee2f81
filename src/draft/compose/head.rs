//! The heading of a recipe: the prompt, what was made of it, and what to do next.

use super::asked::{Asked, assumed};
use super::page::{Page, printable};
use crate::draft::wish::Thing;

/// Most letters of the prompt in the heading.
const LONGEST: usize = 600;
/// Most letters of a name, and most things in it.
const LONGEST_NAME: usize = 48;
const MOST_IN_NAME: usize = 3;

pub(super) fn head(asked: &Asked, by: &str, notes: &[String]) -> Page {
    let wish = asked.wish;
    let mut page = Page::default();
    page.note(0, &format!("Drafted by ensonify {} ({}) from:", env!("CARGO_PKG_VERSION"), cut(by, 60)));
    page.quote(&cut(asked.prompt.text(), LONGEST));
    page.note(0, "In quotes: your words. Assumed: what nobody said.");
    for said in &wish.ignored {
        page.note(0, &format!("Ignored: {} - {}", asked.why(&said.source), said.value));
    }
    for unknown in &wish.unknown {
        let near = match unknown.near.is_empty() {
            true => String::new(),
            false => format!("; there are {}", unknown.near.join(", ")),
        };
        page.note(0, &format!("Unknown: \"{}\" - no catalog has it{near}", unknown.called));
    }
    for said in &wish.without {
        page.note(0, &format!("Left out: {} ({})", said.value, asked.why(&said.source)));
    }
    for note in wish.notes.iter().chain(notes) {
        page.note(0, &format!("Note: {note}"));
    }
    page.note(0, "Try it: ensonify preview THIS_FILE");
    page.note(0, "Make it: ensonify run THIS_FILE");
    page
}

/// The dataset's name: the option's, else the things, else the place; letters, digits and `-` alone.
pub(super) fn name(asked: &Asked) -> (String, String) {
    let wish = asked.wish;
    if let Some(said) = &wish.name {
        let name = plain(&said.value);
        if !name.is_empty() {
            return (name, asked.why(&said.source));
        }
    }
    let things: Vec<String> = wish.things.iter().take(MOST_IN_NAME).map(in_name).collect();
    let name = match &wish.environment {
        _ if !things.is_empty() => things.join("-and-"),
        Some(said) => said.value.clone(),
        None => "seabed".to_owned(),
    };
    (plain(&name), assumed("after what is in it"))
}

fn in_name(thing: &Thing) -> String {
    let one = thing.count.as_ref().is_some_and(|said| said.value.most() == 1);
    let ends = |end: &str| thing.label.ends_with(end);
    match thing.label.as_str() {
        label if one || ends("fish") => label.to_owned(),
        label if ends("s") || ends("x") || ends("ch") || ends("sh") => format!("{label}es"),
        label if ends("y") && !ends("ey") && !ends("oy") && !ends("ay") => format!("{}ies", &label[..label.len() - 1]),
        label => format!("{label}s"),
    }
}

fn plain(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let text: String = name.chars().take(LONGEST_NAME).map(letter).collect();
    let words: Vec<&str> = text.split('-').filter(|word| !word.is_empty()).collect();
    words.join("-")
}

fn cut(text: &str, most: usize) -> String {
    let text = printable(text);
    match text.chars().count() > most {
        true => text.chars().take(most).collect::<String>() + " …",
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain() {
        assert_eq!(plain("../Étc/passwd: x"), "tc-passwd-x");
        assert_eq!(plain("Two Tires!"), "two-tires");
        assert_eq!(cut(&"x".repeat(700), LONGEST).chars().count(), LONGEST + 2);
    }
}
