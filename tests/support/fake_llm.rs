//! A chat server that plays a part: every way in which real ones were seen to fail, and some that were not.
#![allow(dead_code, reason = "each test binary uses its own part")]

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{JoinHandle, sleep, spawn};
use std::time::Duration;

use serde_json::{Value, json};

/// What somebody asked it.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The first line of the request.
    pub line: String,
    /// All headers, names in lower case.
    pub headers: Vec<(String, String)>,
    /// The body.
    pub body: Value,
}

impl Asked {
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(header, _)| header == name).map(|(_, value)| value.as_str())
    }

    /// `json_schema`, `json_object` or nothing: the form that was asked for.
    pub fn form(&self) -> Option<&str> {
        self.body["response_format"]["type"].as_str()
    }

    /// Text of the last message.
    pub fn last(&self) -> &str {
        let messages = self.body["messages"].as_array().map(Vec::as_slice).unwrap_or_default();
        messages.last().and_then(|message| message["content"].as_str()).unwrap_or_default()
    }
}

/// What it does with a question.
#[derive(Clone, Debug)]
pub enum Play {
    /// Answers with this text of the model.
    Says(String),
    /// The same, cut at the most tokens.
    IsCut(String),
    /// Any status with a JSON body.
    Status(u16, Value),
    /// Any status, further header lines, any body.
    Raw(u16, Vec<(&'static str, String)>, Vec<u8>),
    /// Closes without a word.
    Closes,
    /// Promises more than it sends, and closes.
    ClosesInTheMiddle,
    /// Sends headers and then a letter now and then, without end.
    Trickles,
    /// Says nothing at all for a long time.
    IsSilent,
    /// A body without end.
    IsEndless,
}

impl Play {
    /// What llama.cpp says while it loads.
    pub fn loading() -> Self {
        Self::Status(503, json!({"error": {"message": "Loading model", "type": "unavailable_error", "code": 503}}))
    }

    pub fn refuses(status: u16, message: &str) -> Self {
        Self::Status(status, json!({"error": {"message": message, "code": status}}))
    }

    pub fn typed(content_type: &str, body: impl Into<Vec<u8>>) -> Self {
        Self::Raw(200, vec![("Content-Type", content_type.to_owned())], body.into())
    }
}

/// A running server; it ends when dropped.
pub struct FakeLlm {
    port: u16,
    asked: Arc<Mutex<Vec<Asked>>>,
    is_over: Arc<AtomicBool>,
    listening: Option<JoinHandle<()>>,
}

type Part = Arc<dyn Fn(usize, &Asked) -> Play + Send + Sync>;

impl FakeLlm {
    /// Plays a part: what to do at the first question, the second …
    pub fn new(part: impl Fn(usize, &Asked) -> Play + Send + Sync + 'static) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let port = listener.local_addr().expect("bound").port();
        let asked = Arc::new(Mutex::new(Vec::new()));
        let is_over = Arc::new(AtomicBool::new(false));
        let part: Part = Arc::new(part);
        let (book, over) = (asked.clone(), is_over.clone());
        let listening = spawn(move || {
            for stream in listener.incoming().flatten() {
                if over.load(Ordering::SeqCst) {
                    break;
                }
                let (part, book, over) = (part.clone(), book.clone(), over.clone());
                spawn(move || serve(&stream, &part, &book, &over));
            }
        });
        Self { port, asked, is_over, listening: Some(listening) }
    }

    /// Always the same.
    pub fn always(play: Play) -> Self {
        Self::new(move |_, _| play.clone())
    }

    /// Always the same text of the model.
    pub fn says(text: &str) -> Self {
        Self::always(Play::Says(text.to_owned()))
    }

    pub fn url(&self) -> String {
        format!("http://127.0.0.1:{}", self.port)
    }

    /// What was asked so far.
    pub fn asked(&self) -> Vec<Asked> {
        self.asked.lock().expect("no panic").clone()
    }
}

impl Drop for FakeLlm {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::SeqCst);
        // Wakes the listener.
        let _ = TcpStream::connect(("127.0.0.1", self.port));
        if let Some(listening) = self.listening.take() {
            let _ = listening.join();
        }
    }
}

/// An address where nobody listens: a port that was free a moment ago.
pub fn nobody() -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    format!("http://127.0.0.1:{}", listener.local_addr().expect("bound").port())
}

fn serve(stream: &TcpStream, part: &Part, book: &Mutex<Vec<Asked>>, over: &AtomicBool) {
    let Some(asked) = read(stream) else { return };
    let number = {
        let mut book = book.lock().expect("no panic");
        book.push(asked.clone());
        book.len() - 1
    };
    let play = part(number, &asked);
    // Who asked may be gone meanwhile: that is a part of the play.
    let _ = answer(stream, play, over);
    let _ = stream.shutdown(Shutdown::Both);
}

fn read(stream: &TcpStream) -> Option<Asked> {
    let mut reader = BufReader::new(stream);
    let mut line = String::new();
    reader.read_line(&mut line).ok()?;
    let mut headers = Vec::new();
    loop {
        let mut header = String::new();
        reader.read_line(&mut header).ok()?;
        let Some((name, value)) = header.trim().split_once(':') else { break };
        headers.push((name.to_lowercase(), value.trim().to_owned()));
    }
    let length = headers.iter().find(|(name, _)| name == "content-length")?.1.parse().ok()?;
    let mut body = vec![0; length];
    reader.read_exact(&mut body).ok()?;
    Some(Asked { line: line.trim().to_owned(), headers, body: serde_json::from_slice(&body).ok()? })
}

fn answer(stream: &TcpStream, play: Play, over: &AtomicBool) -> std::io::Result<()> {
    match play {
        Play::Says(text) => send(stream, 200, &json_type(), chat(&text, "stop").as_bytes()),
        Play::IsCut(text) => send(stream, 200, &json_type(), chat(&text, "length").as_bytes()),
        Play::Status(status, body) => send(stream, status, &json_type(), body.to_string().as_bytes()),
        Play::Raw(status, headers, body) => send(stream, status, &headers, &body),
        Play::Closes => Ok(()),
        Play::ClosesInTheMiddle => {
            let mut out = stream;
            out.write_all(
                b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: 500\r\n\r\n{\"choices\": [",
            )
        }
        Play::Trickles => {
            let mut out = stream;
            out.write_all(b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: 100000\r\n\r\n{")?;
            while !over.load(Ordering::SeqCst) {
                out.write_all(b" ")?;
                sleep(Duration::from_millis(50));
            }
            Ok(())
        }
        Play::IsSilent => {
            while !over.load(Ordering::SeqCst) {
                sleep(Duration::from_millis(50));
            }
            Ok(())
        }
        Play::IsEndless => {
            let mut out = stream;
            out.write_all(b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nConnection: close\r\n\r\n")?;
            let spaces = [b' '; 1 << 16];
            while !over.load(Ordering::SeqCst) {
                out.write_all(&spaces)?;
            }
            Ok(())
        }
    }
}

fn json_type() -> Vec<(&'static str, String)> {
    vec![("Content-Type", "application/json; charset=utf-8".into())]
}

fn chat(text: &str, finish: &str) -> String {
    let message = json!({"role": "assistant", "content": text});
    json!({"object": "chat.completion", "choices": [{"index": 0, "finish_reason": finish, "message": message}], "usage": {"total_tokens": 9}})
        .to_string()
}

fn send(mut stream: &TcpStream, status: u16, headers: &[(&str, String)], body: &[u8]) -> std::io::Result<()> {
    let mut head = format!("HTTP/1.1 {status} Status\r\nContent-Length: {}\r\nConnection: close\r\n", body.len());
    for (name, value) in headers {
        head.push_str(&format!("{name}: {value}\r\n"));
    }
    stream.write_all(head.as_bytes())?;
    stream.write_all(b"\r\n")?;
    stream.write_all(body)
}
