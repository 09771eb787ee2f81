//! How a server wants to be asked: what it understands of forms, and of the names of limits.
//!
//! Servers differ and do not say so: one refuses a form with 400, another with 500. What a server has refused once it is not
//! offered again.

use serde::Serialize;
use serde_json::value::RawValue;

use super::Shape;

/// What a server is told of the form of an answer; each next one asks less of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Form {
    /// `{"type": "json_schema", "json_schema": {…}}`: OpenAI, llama.cpp, Ollama, vLLM.
    Schema,
    /// `{"type": "json_object", "schema": {…}}`: llama.cpp before that, and others after it.
    ObjectWithSchema,
    /// `{"type": "json_object"}`: any JSON.
    Object,
    /// Nothing: the prompt alone asks for JSON.
    Free,
}

impl Form {
    /// The next weaker one.
    #[must_use]
    pub fn weaker(self) -> Option<Self> {
        match self {
            Self::Schema => Some(Self::ObjectWithSchema),
            Self::ObjectWithSchema => Some(Self::Object),
            Self::Object => Some(Self::Free),
            Self::Free => None,
        }
    }
}

/// How a server wants to be asked, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dialect {
    /// Strongest form that was not refused.
    pub form: Form,
    /// Whether an answer came in this form: what goes wrong then has another reason.
    pub is_proven: bool,
    limit: Limit,
    temperature: Temperature,
}

/// What a server calls the most tokens of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Limit {
    MaxTokens,
    MaxCompletionTokens,
}

/// Whether a server takes a temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Temperature {
    Zero,
    ItsOwn,
}

impl Default for Dialect {
    fn default() -> Self {
        Self { form: Form::Schema, is_proven: false, limit: Limit::MaxTokens, temperature: Temperature::Zero }
    }
}

/// One message of a conversation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Message {
    /// `system`, `user` or `assistant`.
    pub role: Role,
    /// Its text.
    pub content: String,
}

/// Who says a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// This program, to begin with.
    System,
    /// This program, for a person.
    User,
    /// The model.
    Assistant,
}

/// What a model is asked.
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// The conversation so far.
    pub messages: &'a [Message],
    /// What the form is called: letters and `_`.
    pub name: &'static str,
    /// The form of the answer.
    pub shape: &'a Shape,
}

#[derive(Serialize)]
struct Body<'a> {
    model: &'a str,
    messages: &'a [Message],
    stream: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    temperature: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_tokens: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_completion_tokens: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    response_format: Option<ResponseFormat<'a>>,
}

#[derive(Serialize)]
struct ResponseFormat<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    json_schema: Option<NamedSchema<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    schema: Option<&'a RawValue>,
}

#[derive(Serialize)]
struct NamedSchema<'a> {
    name: &'static str,
    strict: bool,
    schema: &'a RawValue,
}

impl Dialect {
    /// The question as JSON.
    pub fn body(&self, model: &str, most_tokens: u32, question: &Question<'_>) -> Vec<u8> {
        let schema = serde_json::value::to_raw_value(question.shape).expect("a shape has string keys only");
        let format = |kind| ResponseFormat { kind, json_schema: None, schema: None };
        let named = NamedSchema { name: question.name, strict: false, schema: &schema };
        let response_format = match self.form {
            Form::Schema => Some(ResponseFormat { json_schema: Some(named), ..format("json_schema") }),
            Form::ObjectWithSchema => Some(ResponseFormat { schema: Some(&schema), ..format("json_object") }),
            Form::Object => Some(format("json_object")),
            Form::Free => None,
        };
        let body = Body {
            model,
            messages: question.messages,
            stream: false,
            temperature: (self.temperature == Temperature::Zero).then_some(0),
            max_tokens: (self.limit == Limit::MaxTokens).then_some(most_tokens),
            max_completion_tokens: (self.limit == Limit::MaxCompletionTokens).then_some(most_tokens),
            response_format,
        };
        serde_json::to_vec(&body).expect("the body has string keys only")
    }

    /// The dialect to try next after a refusal, or none where nothing is left that could be its reason.
    pub fn after(self, status: u16, said: &str) -> Option<Self> {
        let may_be_of_form = matches!(status, 400 | 404 | 415 | 422 | 500 | 501);
        if !may_be_of_form {
            return None;
        }
        if self.limit == Limit::MaxTokens && said.contains("max_completion_tokens") {
            return Some(Self { limit: Limit::MaxCompletionTokens, ..self });
        }
        if self.temperature == Temperature::Zero && said.contains("temperature") {
            return Some(Self { temperature: Temperature::ItsOwn, ..self });
        }
        if self.is_proven {
            return None;
        }
        self.form.weaker().map(|form| Self { form, ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(dialect: Dialect) -> String {
        let messages = [Message { role: Role::User, content: "two \"tires\"".into() }];
        let shape = Shape::Text(9);
        let question = Question { messages: &messages, name: "wish", shape: &shape };
        String::from_utf8(dialect.body("m", 50, &question)).expect("UTF-8")
    }

    #[test]
    fn each_form_asks_less_of_a_server() {
        let mut dialect = Dialect::default();
        let begin = r#"{"model":"m","messages":[{"role":"user","content":"two \"tires\""}],"stream":false,"temperature":0,"max_tokens":50"#;
        let schema = r#"{"type":"string","maxLength":9}"#;
        for format in [
            format!(
                r#","response_format":{{"type":"json_schema","json_schema":{{"name":"wish","strict":false,"schema":{schema}}}}}}}"#
            ),
            format!(r#","response_format":{{"type":"json_object","schema":{schema}}}}}"#),
            r#","response_format":{"type":"json_object"}}"#.into(),
            "}".into(),
        ] {
            assert_eq!(body(dialect), format!("{begin}{format}"));
            dialect = dialect.after(500, "cannot").unwrap_or(dialect);
        }
        assert_eq!(dialect.after(400, "cannot"), None);
    }

    #[test]
    fn names_of_limits_follow_what_a_server_says() {
        let first = Dialect::default();
        let second = first.after(400, "Unsupported parameter: use 'max_completion_tokens' instead").expect("another");
        assert!(second.form == Form::Schema && body(second).contains(r#""temperature":0,"max_completion_tokens":50"#));
        let third = second.after(400, "Unsupported value: 'temperature' does not support 0").expect("another");
        assert!(!body(third).contains("temperature"));
        assert_eq!(first.after(401, "no"), None);
        assert_eq!(Dialect { is_proven: true, ..first }.after(500, "out of memory"), None);
    }
}
