//! A model's text as a typed answer, and what is wrong with it where it is none.

use serde::Deserialize as _;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::error::short;
use super::reply::Reply;
use super::shape::{Needed, Shape};

/// Most problems of one answer that are told: a model that is told more mends less.
const MOST_PROBLEMS: usize = 6;

/// Reads the JSON object in a model's text: fences and talk round it are no matter; unknown fields, other kinds, and values
/// beyond the form's bounds are, whether or not the server held the model to it.
///
/// # Errors
/// What is wrong and where, for the model to mend it: short, each on one line.
pub fn parse<T: DeserializeOwned>(reply: &Reply, shape: &Shape) -> Result<T, Vec<String>> {
    let text = reply.text.as_str();
    if text.is_empty() {
        return Err(vec!["the answer is empty".into()]);
    }
    let Some(start) = text.find('{') else { return Err(vec!["there is no JSON object in the answer".into()]) };
    let mut values = serde_json::Deserializer::from_str(&text[start..]);
    let value = Value::deserialize(&mut values).map_err(|error| vec![explained(&error, reply)])?;
    let mut problems = Vec::new();
    faults(shape, &value, "", &mut problems);
    if !problems.is_empty() {
        problems.truncate(MOST_PROBLEMS);
        return Err(problems);
    }
    T::deserialize(value).map_err(|error| vec![short(&error.to_string())])
}

fn explained(error: &serde_json::Error, reply: &Reply) -> String {
    if !error.is_eof() {
        return format!("it is no JSON: {}", short(&error.to_string()));
    }
    let end: Vec<char> = reply.text.chars().rev().take(30).collect();
    let end: String = end.into_iter().rev().collect();
    let why = if reply.is_cut { "it was cut at the most tokens" } else { "it stops too early" };
    format!("the JSON is not whole, {why}: it ends in `{}`", short(&end))
}

/// Everything of a value that is not of the form.
fn faults(shape: &Shape, value: &Value, path: &str, out: &mut Vec<String>) {
    let place = if path.is_empty() { String::new() } else { format!("{path}: ") };
    match (shape, value) {
        (Shape::OrNull(_), Value::Null) => {}
        (Shape::OrNull(shape), value) => faults(shape, value, path, out),
        (Shape::Record(fields), Value::Object(map)) => {
            for key in map.keys().filter(|key| fields.iter().all(|field| field.name != *key)) {
                out.push(format!("{place}`{}` is no field of the form", short(key)));
            }
            for field in fields {
                let below = if path.is_empty() { field.name.to_owned() } else { format!("{path}.{}", field.name) };
                match (map.get(field.name), field.needed) {
                    (None, Needed::Always) => out.push(format!("{place}`{}` is missing", field.name)),
                    // Models write null for what they leave out.
                    (None | Some(Value::Null), Needed::WhereSaid) => {}
                    (Some(value), _) => faults(&field.shape, value, &below, out),
                }
            }
        }
        (Shape::List(of, most), Value::Array(items)) => {
            if items.len() > *most as usize {
                out.push(format!("{place}{} are too many, at most {most}", items.len()));
            }
            for (number, item) in items.iter().take(*most as usize).enumerate() {
                faults(of, item, &format!("{path}[{number}]"), out);
            }
        }
        (Shape::Text(most), Value::String(text)) => {
            if text.chars().count() > *most as usize {
                out.push(format!("{place}more than {most} letters"));
            }
        }
        (Shape::Word(words), Value::String(text)) => {
            if !words.contains(text) {
                out.push(format!("{place}`{}` is none of {}", short(text), words.join(", ")));
            }
        }
        (Shape::Whole(least, most), Value::Number(number)) => match number.as_i64() {
            None => out.push(format!("{place}a whole number is wanted, not {number}")),
            Some(whole) if !(*least..=*most).contains(&whole) => {
                out.push(format!("{place}{whole} is not between {least} and {most}"));
            }
            Some(_) => {}
        },
        (Shape::Number(least, most), Value::Number(number)) => {
            if !number.as_f64().is_some_and(|number| (*least..=*most).contains(&number)) {
                out.push(format!("{place}{number} is not between {least} and {most}"));
            }
        }
        (shape, other) => out.push(format!("{place}{} is wanted, not {}", wanted(shape), short(&other.to_string()))),
    }
}

fn wanted(shape: &Shape) -> &'static str {
    match shape {
        Shape::Record(_) => "an object",
        Shape::List(..) => "a list",
        Shape::Text(_) | Shape::Word(_) => "a text",
        Shape::Whole(..) => "a whole number",
        Shape::Number(..) => "a number",
        Shape::OrNull(shape) => wanted(shape),
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Answer {
        objects: Vec<Item>,
    }

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Item {
        name: String,
        count: Option<u32>,
    }

    fn parse_of(text: &str, is_cut: bool) -> Result<Answer, Vec<String>> {
        let item = Shape::Record(vec![Shape::Text(9).always("name"), Shape::Whole(1, 9).where_said("count")]);
        parse(&Reply { text: text.into(), is_cut }, &Shape::Record(vec![item.list(2).always("objects")]))
    }

    #[test]
    fn fences_and_talk_are_no_matter() {
        let one = Answer { objects: vec![Item { name: "tire".into(), count: Some(2) }] };
        let json = r#"{"objects": [{"name": "tire", "count": 2}]}"#;
        for text in
            [json.to_owned(), format!("```json\n{json}\n```"), format!("Sure! Here it is:\n{json}\nAnything else?")]
        {
            assert_eq!(parse_of(&text, false).as_ref(), Ok(&one), "{text}");
        }
    }

    #[test]
    fn faults_say_where() {
        let fault = |text| parse_of(text, false).expect_err(text).join("; ");
        assert_eq!(fault(""), "the answer is empty");
        assert_eq!(fault("I cannot do that."), "there is no JSON object in the answer");
        assert_eq!(
            fault(r#"{"objects": [{"name": "tire", "count": "two"}]}"#),
            "objects[0].count: a whole number is wanted, not \"two\""
        );
        assert_eq!(
            fault(r#"{"objects": [{"name": "tire", "file": "/etc/passwd"}]}"#),
            "objects[0]: `file` is no field of the form"
        );
        assert_eq!(
            fault(r#"{"objects": [{"name": "a long name", "count": -2}]}"#),
            "objects[0].name: more than 9 letters; objects[0].count: -2 is not between 1 and 9"
        );
        assert!(
            fault(r#"{"objects": [{"name": "ti"#)
                .contains("it stops too early: it ends in `{\"objects\": [{\"name\": \"ti`")
        );
        assert!(fault("{objects: []}").starts_with("it is no JSON"));
        assert!(parse_of("{\"objects\": [", true).expect_err("cut")[0].contains("cut at the most tokens"));
        let nested = format!("{{\"objects\": {}", "[".repeat(100_000));
        assert!(parse_of(&nested, false).is_err(), "depth is bounded");
    }
}
