//! The client of language models against a server that fails in every way: an answer or one clear error, in bounded time.

#[path = "support/fake_llm.rs"]
mod fake_llm;

use std::time::{Duration, Instant};

use ensonify::draft::model::{
    Client, Fault, Form, Key, Message, ModelError, Question, Reply, Role, Server, Settings, Shape,
};
use fake_llm::{FakeLlm, Play, nobody};

const SECRET: &str = "sk-very-secret-4711";

fn client(url: &str) -> Client {
    Client::new(Settings {
        server: Server::at(url).expect("an address"),
        model: "small".into(),
        key: Key::new(SECRET),
        timeout: Duration::from_secs(2),
        max_tokens: 100,
    })
}

/// Asks once; whatever comes, comes within the time that was given and a bit, and is without the key.
fn ask(client: &mut Client) -> Result<Reply, ModelError> {
    let messages = [Message { role: Role::User, content: "two tires".into() }];
    let shape = Shape::Record(vec![Shape::Whole(1, 9).always("count")]);
    let begun = Instant::now();
    let reply = client.ask(&Question { messages: &messages, name: "wish", shape: &shape });
    assert!(begun.elapsed() < Duration::from_secs(4), "{:?}", begun.elapsed());
    assert!(!format!("{reply:?} {client:?}").contains(SECRET));
    if let Err(error) = &reply {
        let text = error.to_string();
        assert_eq!(text.lines().count(), 2, "{text}");
        assert!(!text.contains(SECRET) && !text.contains('\u{1b}') && text.contains("help: "), "{text}");
    }
    reply
}

fn fault(play: Play) -> Fault {
    let server = FakeLlm::always(play);
    ask(&mut client(&server.url())).expect_err("a fault").fault
}

fn text(server: &FakeLlm) -> String {
    ask(&mut client(&server.url())).expect("a reply").text
}

#[test]
fn an_answer_comes_through() {
    let server = FakeLlm::says("{\"count\": 2}");
    assert_eq!(text(&server), "{\"count\": 2}");
    let asked = &server.asked()[0];
    assert_eq!(asked.line, "POST /v1/chat/completions HTTP/1.1");
    assert_eq!(asked.header("authorization"), Some("Bearer sk-very-secret-4711"));
    assert_eq!((asked.body["model"].as_str(), asked.body["max_tokens"].as_u64()), (Some("small"), Some(100)));
    assert_eq!(asked.form(), Some("json_schema"));
    assert!(asked.header("user-agent").is_some_and(|agent| agent.starts_with("ensonify/")));
}

#[test]
fn it_waits_while_the_model_loads() {
    let server = FakeLlm::new(|number, _| if number < 2 { Play::loading() } else { Play::Says("{}".into()) });
    assert_eq!(text(&server), "{}");
    assert_eq!(server.asked().len(), 3);
    assert!(matches!(fault(Play::loading()), Fault::Busy { said, .. } if said == "Loading model"));
}

#[test]
fn it_waits_as_long_as_it_is_asked_to() {
    let wait = |seconds: u32| Play::Raw(429, vec![("Retry-After", seconds.to_string())], b"slow down".to_vec());
    let server = FakeLlm::new(move |number, _| if number == 0 { wait(1) } else { Play::Says("{}".into()) });
    let begun = Instant::now();
    assert_eq!(text(&server), "{}");
    assert!(begun.elapsed() >= Duration::from_secs(1));
    // An hour is not waited for.
    assert!(matches!(fault(wait(3600)), Fault::Busy { said, .. } if said == "slow down"));
}

#[test]
fn forms_that_a_server_refuses_are_not_offered_again() {
    for status in [400, 404, 422, 500, 501] {
        for (most, form) in [(1, Form::ObjectWithSchema), (2, Form::Object), (3, Form::Free)] {
            let server = FakeLlm::new(move |number, _| {
                if number < most {
                    Play::refuses(status, "response_format is not supported")
                } else {
                    Play::Says("{}".into())
                }
            });
            let mut client = client(&server.url());
            assert_eq!(ask(&mut client).expect("a reply").text, "{}");
            assert_eq!(client.form(), form);
            ask(&mut client).expect("a reply");
            let forms: Vec<Option<String>> =
                server.asked().iter().map(|asked| asked.form().map(str::to_owned)).collect();
            assert_eq!(forms[most], forms[most + 1]);
            assert_eq!(forms.len(), most + 2);
        }
    }
    assert!(
        matches!(fault(Play::refuses(404, "no such model")), Fault::Status { status: 404, said } if said == "no such model")
    );
}

#[test]
fn names_of_limits_are_learnt() {
    let server = FakeLlm::new(|_, asked| match asked.body.get("max_tokens") {
        Some(_) => Play::refuses(400, "Unsupported parameter: 'max_tokens'. Use 'max_completion_tokens' instead."),
        None => Play::Says("{}".into()),
    });
    let mut client = client(&server.url());
    ask(&mut client).expect("a reply");
    assert_eq!(client.form(), Form::Schema);
    assert_eq!(server.asked()[1].body["max_completion_tokens"], 100);
}

#[test]
fn a_passing_fault_after_an_answer_is_no_matter_of_forms() {
    let server =
        FakeLlm::new(|number, _| if number == 1 { Play::refuses(500, "oops") } else { Play::Says("{}".into()) });
    let mut client = client(&server.url());
    ask(&mut client).expect("a reply");
    ask(&mut client).expect("a reply");
    assert_eq!((client.form(), server.asked().len()), (Form::Schema, 3));
}

#[test]
fn connections_that_are_none() {
    let refused = ask(&mut client(&nobody())).expect_err("nobody is there");
    assert!(matches!(refused.fault, Fault::Refused { tries: 4 }), "{refused}");
    assert_eq!(fault(Play::Closes), Fault::BrokenOff { tries: 3 });
    assert_eq!(fault(Play::ClosesInTheMiddle), Fault::BrokenOff { tries: 3 });
    let server = FakeLlm::new(|number, _| if number == 0 { Play::ClosesInTheMiddle } else { Play::Says("{}".into()) });
    assert_eq!(text(&server), "{}");
}

#[test]
fn time_is_bounded_whatever_comes() {
    assert_eq!(fault(Play::Trickles), Fault::TooSlow { seconds: 2 });
    assert_eq!(fault(Play::IsSilent), Fault::TooSlow { seconds: 2 });
    assert_eq!(fault(Play::IsEndless), Fault::TooLong { mib: 4 });
}

#[test]
fn nobody_is_followed_with_a_key() {
    let trap = FakeLlm::says("{}");
    for status in [301, 302, 307, 308] {
        let to = format!("{}/v1/chat/completions?key={SECRET}", trap.url());
        let fault = fault(Play::Raw(status, vec![("Location", to)], Vec::new()));
        assert!(matches!(fault, Fault::Redirect { to, .. } if to.contains("127.0.0.1")));
    }
    assert_eq!(trap.asked().len(), 0);
}

#[test]
fn a_refused_key_is_not_shown() {
    let echo = Play::refuses(401, &format!("Incorrect API key provided: {SECRET}\u{1b}[2J"));
    assert!(matches!(fault(echo), Fault::NotAllowed { status: 401, said } if said.contains("[key]")));
}

#[test]
fn bodies_that_are_no_answers() {
    let not_chat = |play| match fault(play) {
        Fault::NotChat(why) => why,
        other => panic!("{other:?}"),
    };
    assert!(not_chat(Play::typed("text/html", "<html><h1>It works</h1></html>")).contains("text/html"));
    assert_eq!(not_chat(Play::typed("application/json", "")), "it is empty");
    assert_eq!(not_chat(Play::typed("application/json", "{\"choices\": []}")), "there are no choices in it");
    assert!(not_chat(Play::typed("application/json", "[1, 2")).contains("no such JSON"));
    assert_eq!(
        not_chat(Play::typed("application/json", b"{\"choices\": \"\xff\xfe\"}".to_vec())),
        "it is no UTF-8 text"
    );
    assert!(not_chat(Play::typed("text/event-stream", "data: {}\n\n")).contains("stream of events"));
    let packed = Play::Raw(200, vec![("Content-Encoding", "gzip".into())], vec![0x1f, 0x8b, 8, 0]);
    assert!(not_chat(packed).contains("gzip"));
    // The type alone is no matter where the body is right.
    let server = FakeLlm::always(Play::typed("text/plain", r#"{"choices": [{"message": {"content": "{}"}}]}"#));
    assert_eq!(text(&server), "{}");
}

#[test]
fn an_answer_that_was_cut_says_so() {
    let server = FakeLlm::always(Play::IsCut("{\"count\": ".into()));
    assert!(ask(&mut client(&server.url())).expect("a reply").is_cut);
}
