//! The address of a server, and whether a key may go there.

use std::net::{IpAddr, Ipv6Addr};

use ureq::http::Uri;

use super::{Fault, ModelError};

/// A server that speaks the chat protocol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Server {
    /// Where questions go.
    pub(super) questions: String,
    host: String,
    way: Way,
}

/// What lies between this program and a server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// The same machine.
    Loopback,
    /// Encrypted.
    Encrypted,
    /// A network of one's own, readable to all in it.
    Private,
    /// Anything, readable to anyone.
    Open,
}

impl Server {
    /// A server by the address that a person gives: with or without `/v1`, or the whole address of its questions.
    ///
    /// # Errors
    /// Another scheme than http and https, no host, a name or password in it, a query.
    pub fn at(url: &str) -> Result<Self, ModelError> {
        let url = url.trim();
        let wrong = |why| ModelError { host: shown(url), fault: Fault::Address(why) };
        if url.contains('@') {
            return Err(wrong("names and passwords do not belong there; a key comes from ENSONIFY_LLM_KEY"));
        }
        if url.contains(['?', '#']) {
            return Err(wrong("it goes on with `?` or `#`"));
        }
        let uri: Uri = url.parse().map_err(|_| wrong("it cannot be read"))?;
        let scheme = uri.scheme_str().unwrap_or_default();
        if !matches!(scheme, "http" | "https") {
            return Err(wrong("it begins with neither http:// nor https://"));
        }
        let authority = uri.authority().filter(|authority| !authority.host().is_empty());
        let authority = authority.ok_or_else(|| wrong("it names no host"))?;
        let path = uri.path().trim_end_matches('/').trim_end_matches("/chat/completions");
        let path = if path.is_empty() { "/v1" } else { path };
        let way = if scheme == "https" { Way::Encrypted } else { way_to(authority.host()) };
        let host = authority.to_string();
        Ok(Self { questions: format!("{scheme}://{host}{path}/chat/completions"), host, way })
    }

    /// Host and port, as they were given.
    #[must_use]
    pub fn host(&self) -> &str {
        &self.host
    }

    /// Whether a key may be sent there: encrypted, or not beyond networks of one's own.
    #[must_use]
    pub fn may_have_key(&self) -> bool {
        self.way != Way::Open
    }

    /// Whether a proxy of the environment may stand between: only where it cannot read what passes.
    pub(super) fn may_use_proxy(&self) -> bool {
        self.way == Way::Encrypted
    }

    /// What a person should know of this way, before anything is sent.
    #[must_use]
    pub fn warning(&self, has_key: bool) -> Option<String> {
        let host = &self.host;
        match (self.way, has_key) {
            (Way::Loopback | Way::Encrypted, _) | (Way::Private, false) => None,
            (Way::Private, true) => Some(format!("the key goes to {host} unencrypted; https:// would hide it")),
            (Way::Open, true) => Some(format!(
                "the prompt goes to {host} unencrypted, and the key is not sent there at all; use https:// for a server that needs it"
            )),
            (Way::Open, false) => Some(format!("the prompt goes to {host} unencrypted; https:// would hide it")),
        }
    }
}

/// An address as an error may show it: nothing of what stands before an `@`.
fn shown(url: &str) -> String {
    super::error::short(url.rsplit('@').next().unwrap_or_default())
}

/// The way to a host over plain HTTP. Names are not resolved: who answers for a name may change.
fn way_to(host: &str) -> Way {
    let bare = host.trim_start_matches('[').trim_end_matches(']');
    match bare.parse::<IpAddr>() {
        Ok(IpAddr::V4(four)) if four.is_loopback() => Way::Loopback,
        Ok(IpAddr::V4(four)) if four.is_private() || four.is_link_local() => Way::Private,
        Ok(IpAddr::V6(six)) if six.is_loopback() => Way::Loopback,
        Ok(IpAddr::V6(six)) if is_private(six) => Way::Private,
        Ok(_) => Way::Open,
        Err(_) if bare.eq_ignore_ascii_case("localhost") => Way::Loopback,
        Err(_) => Way::Open,
    }
}

fn is_private(address: Ipv6Addr) -> bool {
    address.is_unique_local() || address.is_unicast_link_local()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn questions(url: &str) -> String {
        Server::at(url).expect("an address").questions
    }

    #[test]
    fn addresses_as_people_give_them() {
        assert_eq!(questions("http://127.0.0.1:18081"), "http://127.0.0.1:18081/v1/chat/completions");
        assert_eq!(questions(" http://127.0.0.1:18081/v1/ "), "http://127.0.0.1:18081/v1/chat/completions");
        assert_eq!(questions("https://a.example/v1/chat/completions"), "https://a.example/v1/chat/completions");
        assert_eq!(questions("https://a.example/v1beta/openai/"), "https://a.example/v1beta/openai/chat/completions");
        assert_eq!(Server::at("http://[::1]:80/v1").expect("an address").host(), "[::1]:80");
    }

    #[test]
    fn what_is_no_address_of_a_server() {
        for url in
            ["", "127.0.0.1:18081", "ftp://a", "http://", "file:///etc/passwd", "http://a/v1?key=1", "http://a b"]
        {
            assert!(matches!(Server::at(url), Err(ModelError { fault: Fault::Address(_), .. })), "{url}");
        }
        let error = Server::at("http://me:sk-secret@a.example/v1").expect_err("a password").to_string();
        assert!(!error.contains("sk-secret") && error.contains("ENSONIFY_LLM_KEY"), "{error}");
    }

    #[test]
    fn a_key_goes_over_open_ways_to_nobody() {
        let may = |url| Server::at(url).expect("an address").may_have_key();
        for url in [
            "https://api.example.com",
            "http://localhost:1",
            "http://127.8.8.8",
            "http://[::1]",
            "http://192.168.1.4",
            "http://10.0.0.1",
            "http://[fd00::1]",
        ] {
            assert!(may(url), "{url}");
        }
        for url in [
            "http://api.example.com",
            "http://8.8.8.8",
            "http://172.32.0.1",
            "http://localhost.example.com",
            "http://[2001:db8::1]",
            "http://127.0.0.1.nip.io",
        ] {
            assert!(!may(url), "{url}");
        }
        let warning = |url, has_key| Server::at(url).expect("an address").warning(has_key);
        assert_eq!(warning("http://127.0.0.1", true), None);
        assert!(warning("http://192.168.1.4", true).is_some_and(|text| text.contains("unencrypted")));
        assert!(warning("http://8.8.8.8", true).is_some_and(|text| text.contains("not sent")));
    }
}
