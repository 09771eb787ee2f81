//! What can go wrong between this program and a language model.

use std::fmt;

use crate::recipe::printable;

/// A question to a language model that has no answer.
#[derive(Debug, PartialEq, Eq)]
pub struct ModelError {
    /// Who was asked: host and port, never a key.
    pub host: String,
    /// What went wrong.
    pub fault: Fault,
}

/// What went wrong. Texts of servers in here are short and without the key.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// An address that is none.
    #[error("no address of a server: {0}\nhelp: write --llm http://127.0.0.1:8080 or --llm https://api.example.com/v1")]
    Address(&'static str),
    /// A key that no header can carry.
    #[error(
        "the key in this variable has letters that no key has\nhelp: set it to the key alone, without quotes or line ends"
    )]
    Key,
    /// Nobody listens.
    #[error(
        "nothing listens there ({tries} tries)\nhelp: start the server, or leave out --llm: the built-in drafter needs none"
    )]
    Refused {
        /// How often it was tried.
        tries: u32,
    },
    /// The name is not known, the certificate is not valid, the proxy says no …
    #[error("no connection: {0}\nhelp: see whether the address is right and the network is up")]
    NoConnection(String),
    /// The connection ended before the answer did.
    #[error(
        "the connection broke off before the answer was whole ({tries} tries)\nhelp: see what the server's own messages say"
    )]
    BrokenOff {
        /// How often it was tried.
        tries: u32,
    },
    /// Out of time.
    #[error("no whole answer within {seconds} s\nhelp: give it more time with --timeout, or take a smaller model")]
    TooSlow {
        /// Seconds that were given.
        seconds: u64,
    },
    /// Busy until the time was out.
    #[error(
        "still not ready after {seconds} s: {said}\nhelp: wait until it has loaded its model, or give it more time with --timeout"
    )]
    Busy {
        /// Seconds that were given.
        seconds: u64,
        /// In the server's words.
        said: String,
    },
    /// It wants nothing of this client.
    #[error(
        "it refuses the key (status {status}): {said}\nhelp: set ENSONIFY_LLM_KEY or OPENAI_API_KEY to a key of this server"
    )]
    NotAllowed {
        /// 401 or 403.
        status: u16,
        /// In the server's words.
        said: String,
    },
    /// It points elsewhere; nobody is followed with a key.
    #[error("it sends elsewhere (status {status}), to {to}\nhelp: if that is right, give that address with --llm")]
    Redirect {
        /// 301, 302, 307 …
        status: u16,
        /// The address that it names.
        to: String,
    },
    /// Any other status.
    #[error("it answers with status {status}: {said}\nhelp: see whether --llm and --model are what the server has")]
    Status {
        /// The status.
        status: u16,
        /// In the server's words.
        said: String,
    },
    /// No body that such a server would send.
    #[error(
        "its answer is not that of a chat server: {0}\nhelp: --llm takes the address of an OpenAI-compatible server, such as http://127.0.0.1:8080/v1"
    )]
    NotChat(String),
    /// More than any answer needs.
    #[error(
        "its answer is longer than {mib} MiB\nhelp: --llm takes the address of an OpenAI-compatible server, such as http://127.0.0.1:8080/v1"
    )]
    TooLong {
        /// Mebibytes that are read at most.
        mib: u64,
    },
    /// The model would not say.
    #[error(
        "the model declines: {0}\nhelp: say it in other words, or leave out --llm: the built-in drafter needs no model"
    )]
    Declined(String),
    /// Rounds are used up.
    #[error(
        "after {rounds} rounds its answer is still none that can be used: {why}\nhelp: take a larger model, or leave out --llm: the built-in drafter needs none"
    )]
    Useless {
        /// How many answers there were.
        rounds: usize,
        /// What was wrong with the last.
        why: String,
    },
}

impl std::error::Error for ModelError {}

impl fmt::Display for ModelError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let who = if self.fault == Fault::Key { "" } else { "language model at " };
        let fault = self.fault.to_string();
        let (what, help) = fault.split_once('\n').unwrap_or((&fault, ""));
        write!(out, "{who}{}: {}\n{help}", printable(&self.host), printable(what))
    }
}

/// A text of a server as a message may show it: one line, at most 200 letters.
pub(super) fn short(text: &str) -> String {
    let text = crate::catalog::text::clean(text);
    match text.char_indices().nth(200) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_servers_are_short_and_printable() {
        assert_eq!(short(&"long ".repeat(100)).chars().count(), 201);
        let fault = Fault::Status { status: 500, said: short("bad\u{1b}[2J\nnews") };
        let text = ModelError { host: "127.0.0.1:1".into(), fault }.to_string();
        assert_eq!(text.lines().count(), 2, "{text}");
        assert!(text.starts_with("language model at 127.0.0.1:1: it answers with status 500: bad"), "{text}");
        assert!(!text.contains('\u{1b}'));
    }
}
