//! What a chat server's body says: the model's text, or the server's reason for none.

use serde::Deserialize;

use super::error::short;
use super::exchange::Answered;
use super::{Fault, Key};

/// A model's text and how it ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reply {
    /// As it came, without what the model thought aloud before.
    pub text: String,
    /// Whether it was cut at the most tokens.
    pub is_cut: bool,
}

#[derive(Deserialize)]
struct Chat {
    #[serde(default)]
    choices: Vec<Choice>,
    error: Option<serde_json::Value>,
}

#[derive(Deserialize)]
struct Choice {
    message: Option<Said>,
    finish_reason: Option<String>,
}

#[derive(Deserialize)]
struct Said {
    content: Option<Content>,
    refusal: Option<String>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Content {
    Text(String),
    Parts(Vec<Part>),
}

#[derive(Deserialize)]
struct Part {
    #[serde(default)]
    text: String,
}

/// The model's text of a response with status 200.
///
/// # Errors
/// A body that no chat server sends, in words of ours; a model that declines, in its own.
pub(super) fn read(answered: &Answered, key: Option<&Key>) -> Result<Reply, Fault> {
    let text = text_of(answered, key).map_err(Fault::NotChat)?;
    let chat: Chat = serde_json::from_str(&text).map_err(|_| Fault::NotChat(foreign(answered, &text)))?;
    if let Some(error) = chat.error.filter(|error| !error.is_null()) {
        return Err(Fault::Status { status: answered.status, said: reason(&error) });
    }
    let choice = chat.choices.into_iter().next().ok_or_else(|| Fault::NotChat("there are no choices in it".into()))?;
    let said = choice.message.ok_or_else(|| Fault::NotChat("there is no message in it".into()))?;
    if let Some(refusal) = said.refusal.filter(|refusal| !refusal.trim().is_empty()) {
        return Err(Fault::Declined(short(&refusal)));
    }
    let content = match said.content {
        None => String::new(),
        Some(Content::Text(text)) => text,
        Some(Content::Parts(parts)) => parts.into_iter().map(|part| part.text).collect(),
    };
    let hidden = key.map_or(content.clone(), |key| key.hidden_in(&content));
    let is_cut = choice.finish_reason.as_deref() == Some("length");
    Ok(Reply { text: without_thoughts(&hidden).to_owned(), is_cut })
}

/// The reason that a server gives with another status: short, printable, without the key.
pub(super) fn reason_of(answered: &Answered, key: Option<&Key>) -> String {
    let Ok(text) = text_of(answered, key) else { return "(no text)".into() };
    let said = match serde_json::from_str::<serde_json::Value>(&text) {
        Ok(value) => reason(value.get("error").unwrap_or(&value)),
        Err(_) if answered.content_type == "text/html" => crate::catalog::text::without_html(&text),
        Err(_) => text,
    };
    match short(&said) {
        said if said.is_empty() => "(no reason given)".into(),
        said => said,
    }
}

fn reason(error: &serde_json::Value) -> String {
    let message = error.get("message").or_else(|| error.get("detail")).unwrap_or(error);
    short(&message.as_str().map_or_else(|| message.to_string(), str::to_owned))
}

fn text_of(answered: &Answered, key: Option<&Key>) -> Result<String, String> {
    if let Some(packed) = &answered.packed {
        return Err(format!("it is packed ({}), which nobody asked for", short(packed)));
    }
    let text = std::str::from_utf8(&answered.body).map_err(|_| "it is no UTF-8 text".to_owned())?;
    let text = text.trim_start_matches('\u{feff}').trim();
    Ok(key.map_or_else(|| text.to_owned(), |key| key.hidden_in(text)))
}

/// What a body is that is not of the protocol.
fn foreign(answered: &Answered, text: &str) -> String {
    if text.is_empty() {
        return "it is empty".into();
    }
    match answered.content_type.as_str() {
        "" | "application/json" => format!("it is no such JSON: {}", short(text)),
        "text/event-stream" => "it is a stream of events, though none was asked for".into(),
        other => format!("it is of the type {}", short(other)),
    }
}

/// Models that think aloud do so before they answer.
fn without_thoughts(text: &str) -> &str {
    let text = text.trim();
    match (text.starts_with("<think>"), text.find("</think>")) {
        (true, Some(end)) => text[end + "</think>".len()..].trim(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answered(content_type: &str, body: &str) -> Answered {
        let body = body.as_bytes().to_vec();
        let content_type = content_type.to_owned();
        Answered { status: 200, content_type, packed: None, retry_after: None, location: String::new(), body }
    }

    fn read_of(body: &str) -> Result<Reply, Fault> {
        read(&answered("application/json", body), None)
    }

    #[test]
    fn texts_of_models() {
        let whole = |text: &str| Ok(Reply { text: text.into(), is_cut: false });
        assert_eq!(read_of(r#"{"choices":[{"message":{"content":"{}"},"finish_reason":"stop"}]}"#), whole("{}"));
        assert_eq!(read_of("\u{feff}{\"choices\":[{\"message\":{\"content\":\" {} \"}}]}"), whole("{}"));
        assert_eq!(
            read_of(r#"{"choices":[{"message":{"content":[{"type":"text","text":"{"},{"text":"}"}]}}]}"#),
            whole("{}")
        );
        assert_eq!(read_of(r#"{"choices":[{"message":{"content":"<think>\nhm {</think>\n{}"}}]}"#), whole("{}"));
        let cut = read_of(r#"{"choices":[{"message":{"content":"{\"a\":"},"finish_reason":"length"}]}"#);
        assert_eq!(cut, Ok(Reply { text: "{\"a\":".into(), is_cut: true }));
    }

    #[test]
    fn bodies_that_are_none() {
        let fault = |content_type: &str, body: &str| match read(&answered(content_type, body), None) {
            Err(Fault::NotChat(why)) => why,
            other => panic!("{other:?}"),
        };
        assert_eq!(fault("application/json", ""), "it is empty");
        assert_eq!(fault("application/json", r#"{"choices":[]}"#), "there are no choices in it");
        assert_eq!(fault("application/json", r#"{"choices":[{}]}"#), "there is no message in it");
        assert_eq!(fault("text/html", "<html>hello</html>"), "it is of the type text/html");
        assert_eq!(fault("text/event-stream", "data: {}"), "it is a stream of events, though none was asked for");
        let latin = Answered { body: b"{\"choices\":\"\xe9\"}".to_vec(), ..answered("application/json", "") };
        assert_eq!(read(&latin, None), Err(Fault::NotChat("it is no UTF-8 text".into())));
        let packed = Answered { packed: Some("gzip".into()), ..answered("application/json", "") };
        assert!(matches!(read(&packed, None), Err(Fault::NotChat(why)) if why.contains("gzip")));
    }

    #[test]
    fn a_key_that_a_server_sends_back_is_not_shown() {
        let key = Key::new("sk-secret");
        let body = r#"{"error":{"message":"Incorrect API key provided: sk-secret"}}"#;
        assert_eq!(reason_of(&answered("application/json", body), key.as_ref()), "Incorrect API key provided: [key]");
        let body = "{\"choices\":[{\"message\":{\"content\":\"sk\\u002dsecret\"}}]}";
        let reply = read(&answered("application/json", body), key.as_ref()).expect("a reply");
        assert_eq!(reply.text, "[key]");
    }

    #[test]
    fn reasons_of_servers() {
        assert_eq!(reason_of(&answered("application/json", r#"{"detail":"no such model"}"#), None), "no such model");
        assert_eq!(reason_of(&answered("text/html", "<h1>502</h1> Bad\u{1b}[1m gateway"), None), "502 Bad [1m gateway");
        assert_eq!(reason_of(&answered("", ""), None), "(no reason given)");
    }
}
