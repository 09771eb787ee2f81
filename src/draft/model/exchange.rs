//! One question over HTTP: bounded in time and size, followed nowhere else.
//!
//! Knows nothing of what is asked or answered.

use std::io::ErrorKind;
use std::time::Duration;

use ureq::{Agent, Timeout};

use super::{Key, Server};

/// Longest body that is read: an answer of any model is a few thousand letters.
pub(super) const LONGEST_BODY: u64 = 4 << 20;

/// What came back.
#[derive(Debug)]
pub(super) struct Answered {
    /// The status of the response.
    pub status: u16,
    /// Without parameters; empty where there is none.
    pub content_type: String,
    /// How the body is packed, where it is: nothing was asked to be.
    pub packed: Option<String>,
    /// Seconds that the server asks to be left alone.
    pub retry_after: Option<Duration>,
    /// Where a redirect points.
    pub location: String,
    /// As it came.
    pub body: Vec<u8>,
}

/// Why nothing, or not all, came back.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Broken {
    /// Nobody listens.
    Refused,
    /// The connection ended early.
    Off,
    /// Out of time.
    Slow,
    /// A body beyond [`LONGEST_BODY`].
    TooLong,
    /// No connection at all, and none to be expected soon.
    No(String),
    /// No HTTP.
    NotHttp(String),
}

/// Connections to one server.
#[derive(Debug)]
pub(super) struct Line {
    agent: Agent,
    url: String,
    key: Option<Key>,
}

impl Line {
    /// A line to a server, with its key where that may be sent.
    pub fn to(server: &Server, key: Option<&Key>) -> Self {
        let config = Agent::config_builder()
            .http_status_as_error(false)
            .max_redirects(0)
            .max_redirects_will_error(false)
            .user_agent(concat!("ensonify/", env!("CARGO_PKG_VERSION")))
            .accept("application/json")
            // Each question is alone: a connection that a server has closed meanwhile would be an error of its own.
            .max_idle_connections(0);
        let config = if server.may_use_proxy() { config } else { config.proxy(None) };
        let key = key.filter(|_| server.may_have_key()).cloned();
        Self { agent: config.build().new_agent(), url: server.questions.clone(), key }
    }

    /// Sends a question, in JSON, and reads what comes back, all within a time.
    pub fn exchange(&self, question: &[u8], within: Duration) -> Result<Answered, Broken> {
        let mut request = self.agent.post(&self.url).content_type("application/json");
        if let Some(key) = &self.key {
            request = request.header("authorization", key.header());
        }
        let request = request
            .config()
            .timeout_global(Some(within))
            .timeout_connect(Some(within.min(Duration::from_secs(10))))
            .build();
        let mut response = request.send(question).map_err(|error| broken(&error))?;
        let header = |name: &str| {
            let value = response.headers().get(name).and_then(|value| value.to_str().ok());
            value.unwrap_or_default().trim().to_owned()
        };
        let retry_after = header("retry-after").parse().ok().map(Duration::from_secs);
        let packed = Some(header("content-encoding")).filter(|name| !name.is_empty() && name != "identity");
        let content_type = header("content-type").split(';').next().unwrap_or_default().trim().to_lowercase();
        let location = header("location");
        let status = response.status().as_u16();
        let body = response.body_mut().with_config().limit(LONGEST_BODY).read_to_vec();
        let body = body.map_err(|error| broken(&error))?;
        Ok(Answered { status, content_type, packed, retry_after, location, body })
    }
}

fn broken(error: &ureq::Error) -> Broken {
    match error {
        ureq::Error::Timeout(Timeout::Resolve | Timeout::Connect) => Broken::No("it does not answer".into()),
        ureq::Error::Timeout(_) => Broken::Slow,
        ureq::Error::BodyExceedsLimit(_) => Broken::TooLong,
        ureq::Error::BodyStalled => Broken::Off,
        ureq::Error::HostNotFound => Broken::No("no host of this name is known".into()),
        ureq::Error::ConnectionFailed => Broken::Refused,
        ureq::Error::Io(error) => broken_io(error),
        ureq::Error::Tls(_) | ureq::Error::Rustls(_) | ureq::Error::ConnectProxyFailed(_) => {
            Broken::No(error.to_string())
        }
        other => Broken::NotHttp(other.to_string()),
    }
}

fn broken_io(error: &std::io::Error) -> Broken {
    // An error of HTTP can come in the clothes of one of reading.
    if let Some(inner) = error.get_ref().and_then(|inner| inner.downcast_ref::<ureq::Error>()) {
        return broken(inner);
    }
    match error.kind() {
        ErrorKind::ConnectionRefused => Broken::Refused,
        ErrorKind::TimedOut | ErrorKind::WouldBlock => Broken::Slow,
        ErrorKind::ConnectionReset
        | ErrorKind::ConnectionAborted
        | ErrorKind::BrokenPipe
        | ErrorKind::NotConnected
        | ErrorKind::UnexpectedEof => Broken::Off,
        _ => Broken::No(error.to_string()),
    }
}
