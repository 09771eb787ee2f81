//! `ensonify draft --llm` against a server that fails in every way: a valid draft or one clear error with exit code 2, in
//! bounded time, and the key nowhere but in the request.

#[path = "support/fake_llm.rs"]
mod fake_llm;
mod support;

use std::process::Output;
use std::time::{Duration, Instant};

use ensonify::recipe::Outside;
use ensonify::run::{Given, Project};
use fake_llm::{FakeLlm, Play, nobody};
use serde_json::{Value, json};
use support::cli::{Desk, messages};

const SECRET: &str = "sk-very-secret-4711";
const PROMPT: &str = "50 images of two tires and an anchor on sand, 12 m deep";

/// The right answer to [`PROMPT`].
fn right() -> Value {
    json!({"images": 50, "objects": [{"name": "tire", "count": 2}, {"name": "anchor", "count": 1}], "bottom": "sand", "depth_m": 12})
}

/// Drafts into `a.yaml`. Whatever comes of it, it is a recipe that can be run or one clear error, comes in time and holds no key.
fn draft(desk: &Desk, url: &str, prompt: &str) -> Output {
    let starter = concat!(env!("CARGO_MANIFEST_DIR"), "/catalogs/starter");
    let begun = Instant::now();
    let output = desk
        .command(&[
            "draft",
            prompt,
            "-o",
            "a.yaml",
            "--quick",
            "--catalog",
            starter,
            "--llm",
            url,
            "--model",
            "small",
            "--timeout",
            "2",
        ])
        .env("ENSONIFY_LLM_KEY", SECRET)
        .env_remove("OPENAI_API_KEY")
        .output()
        .expect("the program starts");
    // Three rounds of two seconds, and the rest.
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    holds_no_key(desk, &output);
    match output.status.code() {
        Some(0) => can_be_run(desk),
        Some(2) => is_one_error(desk, &output),
        other => panic!("{other:?}: {}", messages(&output)),
    }
    output
}

fn holds_no_key(desk: &Desk, output: &Output) {
    let mut all = vec![output.stdout.clone(), output.stderr.clone()];
    all.extend(desk.names().iter().map(|name| std::fs::read(desk.path().join(name)).expect("readable")));
    for text in all {
        let text = String::from_utf8_lossy(&text).into_owned();
        assert!(!text.contains(SECRET) && !text.contains('\u{1b}'), "{text}");
    }
}

fn can_be_run(desk: &Desk) {
    let path = desk.path().join("a.yaml");
    let project = Project::load(&Given { path: &path, sets: &[], outside: Outside::Refused }).expect("a recipe");
    project.try_corners().expect("a recipe that can be run");
    assert_eq!(desk.names(), ["a.draft.jsonl", "a.yaml"]);
}

fn is_one_error(desk: &Desk, output: &Output) {
    let text = messages(output);
    assert!(text.starts_with("error: ") && text.contains("\nhelp: "), "{text}");
    assert_eq!(text.matches("error: ").count(), 1, "{text}");
    assert!(desk.names().is_empty(), "{:?}", desk.names());
}

fn code(play: Play) -> (Option<i32>, String) {
    let server = FakeLlm::always(play);
    let output = draft(&Desk::new(), &server.url(), PROMPT);
    (output.status.code(), messages(&output))
}

fn recipe(desk: &Desk) -> Value {
    let text = std::fs::read_to_string(desk.path().join("a.yaml")).expect("drafted");
    serde_yaml::from_str(&text).expect("YAML")
}

fn transcript(desk: &Desk) -> Vec<Value> {
    let text = std::fs::read_to_string(desk.path().join("a.draft.jsonl")).expect("a transcript");
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn a_right_answer_becomes_a_recipe_and_a_line_of_the_transcript() {
    let server = FakeLlm::says(&right().to_string());
    let desk = Desk::new();
    let output = draft(&desk, &server.url(), PROMPT);
    assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
    assert_eq!(server.asked().len(), 1);
    assert_eq!(server.asked()[0].header("authorization"), Some("Bearer sk-very-secret-4711"));
    let recipe = recipe(&desk);
    assert_eq!(recipe["scenes"].as_u64().unwrap_or(1) * recipe["frames"].as_u64().unwrap_or(1), 50);
    assert_eq!(recipe["water"]["depth_m"].as_f64(), Some(12.0));
    let line = &transcript(&desk)[0];
    assert_eq!((line["prompt"].as_str(), line["drafter"]["model"]["model"].as_str()), (Some(PROMPT), Some("small")));
    assert_eq!(format!("http://{}", line["drafter"]["model"]["host"].as_str().expect("a host")), server.url());
    assert_eq!(line["rounds"].as_array().map(Vec::len), Some(1));
}

#[test]
fn servers_that_give_no_answer_are_one_clear_error() {
    let to = |host: &str| vec![("Location", format!("{host}/v1/chat/completions"))];
    let trap = FakeLlm::says(&right().to_string());
    for (play, said) in [
        (Play::loading(), "Loading model"),
        (Play::refuses(401, &format!("Incorrect API key: {SECRET}")), "refuses the key"),
        (Play::refuses(404, "model `small` not found"), "not found"),
        (Play::Raw(307, to(&trap.url()), Vec::new()), "sends elsewhere"),
        (Play::Closes, "broke off"),
        (Play::ClosesInTheMiddle, "broke off"),
        (Play::Trickles, "within 2 s"),
        (Play::IsSilent, "within 2 s"),
        (Play::IsEndless, "longer than 4 MiB"),
        (Play::typed("text/html", "<html>It works</html>"), "text/html"),
        (Play::typed("application/json", ""), "empty"),
        (Play::typed("application/json", r#"{"choices": []}"#), "no choices"),
        (Play::typed("application/json", b"\xff\xfe{\0}\0".to_vec()), "UTF-8"),
    ] {
        let (code, text) = code(play.clone());
        assert!(code == Some(2) && text.contains(said), "{play:?}: {text}");
    }
    assert!(trap.asked().is_empty(), "nobody is followed");
    let output = draft(&Desk::new(), &nobody(), PROMPT);
    assert!(messages(&output).contains("nothing listens there"), "{}", messages(&output));
}

#[test]
fn servers_that_recover_or_understand_less_are_no_error() {
    let right = right().to_string();
    let fenced = format!("Sure! Here is the form:\n```json\n{right}\n```");
    for first in [
        Play::loading(),
        Play::refuses(500, "json_schema is not supported"),
        Play::refuses(400, "response_format"),
        Play::ClosesInTheMiddle,
    ] {
        for text in [&right, &fenced] {
            let (first, second) = (first.clone(), Play::Says(text.clone()));
            let server = FakeLlm::new(move |number, _| if number == 0 { first.clone() } else { second.clone() });
            let output = draft(&Desk::new(), &server.url(), PROMPT);
            assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
            assert_eq!(server.asked().len(), 2);
        }
    }
}

#[test]
fn an_answer_that_is_none_is_asked_for_again_and_then_done_without() {
    let many = json!({"images": 50, "objects": vec![json!({"name": "tire", "count": 1}); 500], "bottom": null, "depth_m": null});
    for (bad, problem) in [
        (Play::Says("I would rather not.".into()), "no JSON object"),
        (Play::Says(String::new()), "empty"),
        (Play::IsCut(r#"{"images": 50, "objects": [{"name": "ti"#.into()), "cut at the most tokens"),
        (
            Play::Says(json!({"images": 50, "objects": [], "bottom": "lava", "depth_m": 12}).to_string()),
            "`lava` is none of",
        ),
        (Play::Says(many.to_string()), "too many"),
        (Play::Says("[".repeat(100_000)), "no JSON object"),
    ] {
        let again = bad.clone();
        let server =
            FakeLlm::new(move |number, _| if number == 0 { again.clone() } else { Play::Says(right().to_string()) });
        let desk = Desk::new();
        let output = draft(&desk, &server.url(), PROMPT);
        assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
        assert!(server.asked()[1].last().contains(problem), "{}", server.asked()[1].last());
        assert!(transcript(&desk)[0]["rounds"][0]["problems"][0].as_str().is_some_and(|told| told.contains(problem)));
        // Three times nothing: the prompt's own words are enough, and a note says so.
        let server = FakeLlm::always(bad);
        let desk = Desk::new();
        let output = draft(&desk, &server.url(), PROMPT);
        assert_eq!((output.status.code(), server.asked().len()), (Some(0), 3), "{}", messages(&output));
        assert!(messages(&output).contains("gave no answer that can be used"), "{}", messages(&output));
    }
}

#[test]
fn numbers_of_the_prompt_count_where_the_model_will_not_take_them() {
    let wrong = json!({"images": 50, "objects": [{"name": "tire", "count": 3}, {"name": "anchor", "count": 1}], "bottom": "sand", "depth_m": 40, "fov_deg": 77});
    let server = FakeLlm::says(&wrong.to_string());
    let desk = Desk::new();
    let output = draft(&desk, &server.url(), "50 images of two tires and an anchor on sand at 40 feet");
    assert_eq!((output.status.code(), server.asked().len()), (Some(0), 3), "{}", messages(&output));
    let told = server.asked()[1].last().to_owned();
    assert!(told.contains("depth_m: 40 is wrong") && told.contains("2, not 3"), "{told}");
    assert!((recipe(&desk)["water"]["depth_m"].as_f64().expect("a depth") - 12.19).abs() < 0.01);
    let text = std::fs::read_to_string(desk.path().join("a.yaml")).expect("drafted");
    assert!(text.contains("the language model was not followed: depth_m: 40"), "{text}");
    assert!(text.contains("left out of what the language model said: fov_deg"), "{text}");
}

#[test]
fn what_cannot_be_is_refused_before_the_model_is_asked() {
    let server = FakeLlm::says(&right().to_string());
    for prompt in
        ["Zero images of an anchor", "Five to three barrels at 20 m", "Make the bottom muddier and the water darker"]
    {
        let output = draft(&Desk::new(), &server.url(), prompt);
        assert_eq!(output.status.code(), Some(2), "{prompt}: {}", messages(&output));
    }
    assert!(server.asked().is_empty());
}

#[test]
fn a_model_alone_is_bounded_too() {
    for (images, code) in [(0, 2), (1_000_000, 2), (50, 0)] {
        let server = FakeLlm::says(
            &json!({"images": images, "objects": [{"name": "tire", "count": 2}], "bottom": "mud", "depth_m": 9})
                .to_string(),
        );
        let starter = concat!(env!("CARGO_MANIFEST_DIR"), "/catalogs/starter");
        let desk = Desk::new();
        let url = server.url();
        let output = desk.run(&[
            "draft",
            "whatever",
            "--quick",
            "-c",
            starter,
            "--llm",
            &url,
            "--model",
            "small",
            "--model-alone",
        ]);
        assert_eq!(output.status.code(), Some(code), "{images}: {}", messages(&output));
        assert_eq!(messages(&output).contains("help: "), code == 2, "{}", messages(&output));
    }
}

/// All texts of a YAML value, keys included.
fn texts(value: &Value, out: &mut Vec<String>) {
    match value {
        Value::String(text) => out.push(text.clone()),
        Value::Array(items) => items.iter().for_each(|item| texts(item, out)),
        Value::Object(map) => map.iter().for_each(|(key, item)| {
            out.push(key.clone());
            texts(item, out);
        }),
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

#[test]
fn what_a_model_says_gets_nowhere_but_through_the_form() {
    let evil = [
        "../../../../etc/passwd",
        "http://evil.example/x.glb",
        "!include /etc/passwd",
        "$(touch pwned)",
        "a\nseed: 666\n",
        "\u{1b}[2J",
    ];
    for text in evil {
        let form = json!({"images": 50, "objects": [{"name": "tire", "count": 2}, {"name": text, "count": 1}], "bottom": "sand",
            "depth_m": 12, "without": [text], "sonar": text, "refusal": text});
        let more = json!({"images": 50, "objects": [{"name": "anchor", "count": 1, "path": text}], "bottom": "sand", "depth_m": 12,
            "output": text, "include": text});
        for answer in [form, more, json!({"tool_calls": [{"function": {"name": "read_file", "arguments": text}}]})] {
            let server = FakeLlm::says(&answer.to_string());
            let desk = Desk::new();
            let output = draft(&desk, &server.url(), PROMPT);
            assert_eq!(output.status.code(), Some(0), "{}", messages(&output));
            let recipe = recipe(&desk);
            let mut all = Vec::new();
            texts(&recipe, &mut all);
            assert!(all.iter().all(|value| !value.contains(text.trim())), "{all:?}");
            assert_ne!(recipe["seed"], 666);
            assert!(recipe.get("include").is_none() && recipe.get("output").is_none());
        }
    }
}

#[test]
fn addresses_and_options_that_cannot_be() {
    let desk = Desk::new();
    for arguments in [
        vec!["--llm", "ftp://127.0.0.1", "--model", "small"],
        vec!["--llm", "http://me:pass@127.0.0.1", "--model", "small"],
        vec!["--llm", "http://127.0.0.1:1"],
        vec!["--model", "small"],
        vec!["--llm", "http://127.0.0.1:1", "--model", "small", "--timeout", "0"],
    ] {
        let output = desk.run(&[&["draft", PROMPT][..], &arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", messages(&output));
        assert!(!messages(&output).contains("me:pass"), "{}", messages(&output));
    }
}
