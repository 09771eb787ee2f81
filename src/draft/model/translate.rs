//! Words that no table knows, in English: asked for by themselves, so that nothing suggests an answer.
//!
//! A thing that only the model sees counts where the model, asked for the plain meaning of a word of the prompt, says the same
//! thing again. So "pneumatici" can become tires, and a unicorn cannot become an anchor.

use std::ops::Range;

use serde::Deserialize;

use super::client::Client;
use super::format::{Message, Question, Role};
use super::parse::parse;
use super::shape::Shape;
use super::{ModelError, Reply};
use crate::draft::{Known, Prompt, find};

/// Most words that are asked for.
const MOST: usize = 8;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    words: Vec<Pair>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Pair {
    word: String,
    english: String,
}

/// Labels of catalogs that strange words mean, with the bytes of the words.
///
/// # Errors
/// The server's; an answer that is none gives no labels.
pub(super) fn translated(
    client: &mut Client,
    prompt: &Prompt,
    strange: &[Range<usize>],
    known: &Known,
) -> Result<Vec<(String, Range<usize>)>, ModelError> {
    let words: Vec<&str> = strange.iter().take(MOST).map(|range| prompt.words(range)).collect();
    let shape = shape();
    let messages = messages(&words);
    let reply = client.ask(&Question { messages: &messages, name: "words", shape: &shape })?;
    Ok(meanings(&reply, &shape, &words, strange, known))
}

fn meanings(
    reply: &Reply,
    shape: &Shape,
    words: &[&str],
    strange: &[Range<usize>],
    known: &Known,
) -> Vec<(String, Range<usize>)> {
    let Ok(answer) = parse::<Answer>(reply, shape) else { return Vec::new() };
    let mut out = Vec::new();
    for Pair { word, english } in answer.words {
        let place = words.iter().position(|asked| asked.to_lowercase() == word.to_lowercase());
        if let (Some(place), Ok(found)) = (place, find::models(&english, known)) {
            out.push((found.label, strange[place].clone()));
        }
    }
    out
}

fn shape() -> Shape {
    let pair = Shape::Record(vec![Shape::Text(40).always("word"), Shape::Text(40).always("english")]);
    Shape::Record(vec![pair.list(MOST as u32).always("words")])
}

fn messages(words: &[&str]) -> Vec<Message> {
    let list = serde_json::to_string(words).expect("a list of texts");
    let system = "You translate single words into English, whatever they are. A word that is English already stays as it is. Answer \
                  as JSON: {\"words\": [{\"word\": \"Reifen\", \"english\": \"tire\"}, …]}";
    [(Role::System, system.to_owned()), (Role::User, format!("Words: {list}"))]
        .map(|(role, content)| Message { role, content })
        .to_vec()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn a_translation_is_of_a_word_that_was_asked_for() {
        let starter = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs/starter");
        let known =
            Known::open(Path::new("."), &[starter.to_string_lossy().into_owned()]).expect("the starter catalog");
        let strange = [0..10, 20..27];
        let of = |text: &str| {
            let reply = Reply { text: text.into(), is_cut: false };
            meanings(&reply, &shape(), &["pneumatici", "unicorn"], &strange, &known)
        };
        assert_eq!(of(r#"{"words": [{"word": "Pneumatici", "english": "tires"}]}"#), [("tire".to_owned(), 0..10)]);
        assert_eq!(
            of(r#"{"words": [{"word": "unicorn", "english": "unicorn"}, {"word": "sub", "english": "anchor"}]}"#),
            []
        );
        assert_eq!(of("I do not know."), []);
    }
}
