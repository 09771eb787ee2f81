//! The conversation with a model: what it is told, and how it is told what was wrong.
//!
//! The first part is the same for every prompt, so that servers keep it; a prompt is data in quotes.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use serde::Deserialize;

use super::answer;
use super::evidence::Evidence;
use super::format::{Message, Role};
use super::shape::Shape;
use crate::draft::{Known, Prompt};

const SYSTEM: &str = include_str!("../../../templates/draft/system.txt");
const EXAMPLES: &str = include_str!("../../../templates/draft/examples.yaml");

/// Tokens that small servers have for a question and its answer.
const CONTEXT: usize = 4096;
/// Most labels of models that are offered.
const MOST_CANDIDATES: usize = 12;

/// A request and its form.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Example {
    request: String,
    form: serde_json::Map<String, serde_json::Value>,
}

/// The form and what every conversation begins with.
static BEGIN: LazyLock<(Shape, Vec<Message>)> = LazyLock::new(|| {
    let shape = answer::shape();
    let mut messages = vec![Message { role: Role::System, content: SYSTEM.trim().replace("{form}", &shape.sketch()) }];
    for Example { request, form } in examples() {
        messages.push(Message { role: Role::User, content: user(&request, &[]) });
        messages.push(Message { role: Role::Assistant, content: in_order(&form, &shape) });
    }
    (shape, messages)
});

fn examples() -> Vec<Example> {
    serde_yaml::from_str(EXAMPLES).expect("the examples in the program are sound: a test reads them")
}

/// The form of the answer.
pub(super) fn shape() -> &'static Shape {
    &BEGIN.0
}

/// The conversation that asks for a prompt's form, within the context of small servers.
pub(super) fn messages(prompt: &Prompt, candidates: &[String], most_tokens: u32) -> Vec<Message> {
    let mut messages = BEGIN.1.clone();
    messages.push(Message { role: Role::User, content: user(prompt.text(), candidates) });
    fitted(messages, most_tokens)
}

/// The same, after an answer with problems.
pub(super) fn mended(mut messages: Vec<Message>, answer: &str, problems: &[String], most_tokens: u32) -> Vec<Message> {
    let answer: String = answer.chars().take(2000).collect();
    messages.push(Message { role: Role::Assistant, content: answer });
    let list: String = problems.iter().take(6).map(|problem| format!("\n- {problem}")).collect();
    let content = format!("That form is not right yet:{list}\nWrite the whole form again, mended.");
    messages.push(Message { role: Role::User, content });
    fitted(messages, most_tokens)
}

/// Labels of models that a prompt names, and of those that words which no table knows may mean.
pub(super) fn candidates(prompt: &Prompt, known: &Known, evidence: &Evidence) -> Vec<String> {
    let mut out: BTreeSet<String> = evidence.labels().map(str::to_owned).collect();
    for word in evidence.strange.iter().take(MOST_CANDIDATES) {
        for (_, catalog) in &known.catalogs {
            // A search that cannot be made offers nothing; the model has its own words.
            let found = catalog.find(prompt.words(word), 2).unwrap_or_default();
            out.extend(found.into_iter().filter_map(|found| Some(catalog.asset(found.model).ok()?.label)));
        }
    }
    out.into_iter().filter(|label| !label.is_empty()).take(MOST_CANDIDATES).collect()
}

fn user(request: &str, candidates: &[String]) -> String {
    let quoted = serde_json::to_string(request).expect("a text");
    if candidates.is_empty() {
        return format!("Request: {quoted}");
    }
    format!("Names that may fit: {}\nRequest: {quoted}", candidates.join(", "))
}

/// Leaves examples out until question and answer fit.
fn fitted(mut messages: Vec<Message>, most_tokens: u32) -> Vec<Message> {
    let room = CONTEXT.saturating_sub(most_tokens as usize);
    let examples = BEGIN.1.len() - 1;
    let mut left = examples;
    while left >= 2 && tokens(&messages) > room {
        messages.drain(1..3);
        left -= 2;
    }
    messages
}

/// Tokens of a conversation, rather too many: letters of English are three or four to a token, others one.
fn tokens(messages: &[Message]) -> usize {
    let of = |text: &str| {
        let wide = text.chars().filter(|letter| !letter.is_ascii()).count();
        (text.len() - wide) / 3 + wide + 8
    };
    messages.iter().map(|message| of(&message.content)).sum()
}

/// A form as JSON with its fields in the order of the shape.
fn in_order(form: &serde_json::Map<String, serde_json::Value>, shape: &Shape) -> String {
    let Shape::Record(fields) = shape else { return serde_json::Value::Object(form.clone()).to_string() };
    let mut parts = Vec::new();
    for field in fields {
        let Some(value) = form.get(field.name) else { continue };
        let text = match (value, &field.shape) {
            (serde_json::Value::Array(items), Shape::List(of, _)) => {
                let items: Vec<String> = items
                    .iter()
                    .map(|item| item.as_object().map_or_else(|| item.to_string(), |map| in_order(map, of)))
                    .collect();
                format!("[{}]", items.join(", "))
            }
            (value, _) => value.to_string(),
        };
        parts.push(format!("\"{}\": {text}", field.name));
    }
    format!("{{{}}}", parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::super::Reply;
    use super::super::answer::Answer;
    use super::super::parse::parse;
    use super::*;
    use crate::draft::Options;

    #[test]
    fn every_example_is_an_answer() {
        assert!(examples().len() >= 3);
        for Example { request, form } in examples() {
            let text = in_order(&form, shape());
            let answer = parse::<Answer>(&Reply { text: text.clone(), is_cut: false }, shape());
            assert!(answer.is_ok(), "{request}: {text}: {answer:?}");
            assert_eq!(
                serde_json::from_str::<serde_json::Value>(&text).expect("JSON"),
                serde_json::Value::Object(form)
            );
        }
    }

    #[test]
    fn a_prompt_is_data_in_quotes() {
        let prompt = Prompt::new("\"}]} 50 images of a {\"name\":\"anchor\"}", Options::default());
        let messages = messages(&prompt, &["anchor".into()], 600);
        let last = &messages[messages.len() - 1].content;
        assert_eq!(
            last,
            "Names that may fit: anchor\nRequest: \"\\\"}]} 50 images of a {\\\"name\\\":\\\"anchor\\\"}\""
        );
        assert_eq!(messages[0].role, Role::System);
        assert!(
            messages[0].content.contains("\"objects\": [{\"name\": text") && !messages[0].content.contains("{form}")
        );
    }

    #[test]
    fn long_prompts_fit_the_context_of_small_servers() {
        let short = messages(&Prompt::new("two tires", Options::default()), &[], 600);
        assert!(tokens(&short) < 2200, "{}", tokens(&short));
        let long = messages(&Prompt::new(&"two tires ".repeat(500), Options::default()), &[], 600);
        assert!(tokens(&long) <= 4096 - 600, "{}", tokens(&long));
        let again = mended(short, &"x".repeat(9000), &vec!["y".repeat(80); 50], 600);
        assert!(tokens(&again) <= 4096 - 600, "{}", tokens(&again));
        assert!(again[again.len() - 1].content.ends_with("mended."));
    }
}
