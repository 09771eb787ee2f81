//! Asks a language model: waits while it loads, learns how the server wants to be asked, and gives up in time.
//!
//! Knows nothing of sonar: a question is a conversation and the form of its answer.

use std::thread::sleep;
use std::time::{Duration, Instant};

use super::error::short;
use super::exchange::{Answered, Broken, LONGEST_BODY, Line};
use super::format::{Dialect, Form, Question};
use super::reply::{self, Reply};
use super::{Fault, Key, ModelError, Server};

/// Which model is asked, where, and how patiently.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The server.
    pub server: Server,
    /// Name of the model there.
    pub model: String,
    /// The key; not sent where others could read it.
    pub key: Option<Key>,
    /// Longest time for one question, waiting and repeating included.
    pub timeout: Duration,
    /// Most tokens of one answer.
    pub max_tokens: u32,
}

/// A conversation partner.
#[derive(Debug)]
pub struct Client {
    settings: Settings,
    line: Line,
    dialect: Dialect,
}

/// How often a server may fail in one way during one question.
const MOST_REFUSED: u32 = 4;
const MOST_BROKEN: u32 = 3;

/// Tries at one question.
struct Tries {
    begun: Instant,
    within: Duration,
    wait: Duration,
    refused: u32,
    broken: u32,
}

/// What one try came to.
enum Outcome {
    Reply(Reply),
    /// Ask otherwise, at once.
    Otherwise(Dialect),
    /// Ask again later: after so long, if the server says.
    Later(Option<Duration>, Fault),
    No(Fault),
}

impl Client {
    /// A client for these settings; nothing is sent yet.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        let line = Line::to(&settings.server, settings.key.as_ref());
        Self { settings, line, dialect: Dialect::default() }
    }

    /// What it was made with.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The strongest form that the server has not refused so far.
    #[must_use]
    pub fn form(&self) -> Form {
        self.dialect.form
    }

    /// Asks, and waits for the answer.
    ///
    /// # Errors
    /// No server, no time left, a server that refuses, or something that is no answer; see [`Fault`].
    pub fn ask(&mut self, question: &Question<'_>) -> Result<Reply, ModelError> {
        let mut tries = Tries::within(self.settings.timeout);
        loop {
            match self.try_once(question, &mut tries) {
                Outcome::Reply(reply) => {
                    self.dialect.is_proven = true;
                    return Ok(reply);
                }
                Outcome::Otherwise(dialect) => self.dialect = dialect,
                Outcome::Later(wait, fault) => {
                    if !tries.may_wait(wait) {
                        return Err(self.error(fault));
                    }
                }
                Outcome::No(fault) => return Err(self.error(fault)),
            }
        }
    }

    fn error(&self, fault: Fault) -> ModelError {
        ModelError { host: self.settings.server.host().to_owned(), fault }
    }

    fn try_once(&self, question: &Question<'_>, tries: &mut Tries) -> Outcome {
        let Some(left) = tries.left() else { return Outcome::No(self.too_slow()) };
        let body = self.dialect.body(&self.settings.model, self.settings.max_tokens, question);
        match self.line.exchange(&body, left) {
            Ok(answered) => self.judge(&answered, tries),
            Err(broken) => self.judge_broken(broken, tries),
        }
    }

    fn judge(&self, answered: &Answered, tries: &mut Tries) -> Outcome {
        let key = self.settings.key.as_ref();
        let status = answered.status;
        let said = || reply::reason_of(answered, key);
        match status {
            200..=299 => reply::read(answered, key).map_or_else(Outcome::No, Outcome::Reply),
            300..=399 => {
                let to = key.map_or(answered.location.clone(), |key| key.hidden_in(&answered.location));
                Outcome::No(Fault::Redirect { status, to: short(&to) })
            }
            401 | 403 => Outcome::No(Fault::NotAllowed { status, said: said() }),
            429 | 502..=504 => {
                let seconds = self.settings.timeout.as_secs();
                Outcome::Later(answered.retry_after, Fault::Busy { seconds, said: said() })
            }
            _ => match self.dialect.after(status, &said()) {
                Some(dialect) => Outcome::Otherwise(dialect),
                None if status == 500 && tries.broken + 1 < MOST_BROKEN => {
                    tries.broken += 1;
                    Outcome::Later(None, Fault::Status { status, said: said() })
                }
                None => Outcome::No(Fault::Status { status, said: said() }),
            },
        }
    }

    fn judge_broken(&self, broken: Broken, tries: &mut Tries) -> Outcome {
        match broken {
            Broken::Refused => {
                tries.refused += 1;
                let fault = Fault::Refused { tries: tries.refused };
                if tries.refused < MOST_REFUSED { Outcome::Later(None, fault) } else { Outcome::No(fault) }
            }
            Broken::Off => {
                tries.broken += 1;
                let fault = Fault::BrokenOff { tries: tries.broken };
                if tries.broken < MOST_BROKEN { Outcome::Later(None, fault) } else { Outcome::No(fault) }
            }
            Broken::Slow => Outcome::No(self.too_slow()),
            Broken::TooLong => Outcome::No(Fault::TooLong { mib: LONGEST_BODY >> 20 }),
            Broken::No(why) => Outcome::No(Fault::NoConnection(short(&why))),
            Broken::NotHttp(why) => Outcome::No(Fault::NotChat(short(&why))),
        }
    }

    fn too_slow(&self) -> Fault {
        Fault::TooSlow { seconds: self.settings.timeout.as_secs() }
    }
}

impl Tries {
    fn within(within: Duration) -> Self {
        Self { begun: Instant::now(), within, wait: Duration::from_millis(200), refused: 0, broken: 0 }
    }

    fn left(&self) -> Option<Duration> {
        self.within.checked_sub(self.begun.elapsed()).filter(|left| !left.is_zero())
    }

    /// Waits before the next try, as long as the server asks or twice as long as the last time; no where time would be out.
    fn may_wait(&mut self, asked: Option<Duration>) -> bool {
        let wait = asked.unwrap_or(self.wait).max(Duration::from_millis(50));
        if self.left().is_none_or(|left| left <= wait) {
            return false;
        }
        sleep(wait);
        self.wait = (self.wait * 2).min(Duration::from_secs(4));
        true
    }
}
