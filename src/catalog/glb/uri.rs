//! URIs as glTF uses them: relative references and `data:`.
//!
//! Source: RFC 3986 (2005), sections 2.1 and 3.1; RFC 2397 (1998).

/// The scheme in front of the first colon, if there is one.
pub(super) fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.');
    (scheme.starts_with(|c: char| c.is_ascii_alphabetic()) && scheme.chars().all(plain)).then_some(scheme)
}

/// The bytes in a `data:` URI, with or without media type and base64; `None` for other URIs.
pub(super) fn data(uri: &str) -> Option<Result<Vec<u8>, &'static str>> {
    if !scheme(uri)?.eq_ignore_ascii_case("data") {
        return None;
    }
    let Some((about, text)) = uri["data:".len()..].split_once(',') else {
        return Some(Err("its data: URI has no comma"));
    };
    if !about.to_ascii_lowercase().trim_end().ends_with(";base64") {
        return Some(Ok(percent_bytes(text)));
    }
    let unescaped = text.contains('%').then(|| percent_bytes(text));
    Some(base64(unescaped.as_deref().unwrap_or(text.as_bytes())).ok_or("its data: URI is not base64"))
}

/// The text with `%xx` as bytes.
pub(super) fn percent_decoded(uri: &str) -> String {
    String::from_utf8_lossy(&percent_bytes(uri)).into_owned()
}

fn percent_bytes(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let escaped = (bytes[at] == b'%').then(|| text.get(at + 1..at + 3)).flatten();
        match escaped.and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(byte) => {
                out.push(byte);
                at += 3;
            }
            None => {
                out.push(bytes[at]);
                at += 1;
            }
        }
    }
    out
}

fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let end = text.iter().rposition(|&symbol| symbol != b'=').map_or(0, |last| last + 1);
    let mut out = Vec::with_capacity(end / 4 * 3 + 2);
    let (mut bits, mut held) = (0u32, 0u32);
    for &symbol in &text[..end] {
        let value = match symbol {
            b'A'..=b'Z' => symbol - b'A',
            b'a'..=b'z' => symbol - b'a' + 26,
            b'0'..=b'9' => symbol - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            b' ' | b'\t' | b'\r' | b'\n' => continue,
            _ => return None,
        };
        bits = (bits << 6) | u32::from(value);
        held += 6;
        if held >= 8 {
            held -= 8;
            out.push((bits >> held) as u8);
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_and_percent_signs_are_decoded() {
        assert_eq!(base64(b"c29uYXI=").as_deref(), Some(&b"sonar"[..]));
        assert_eq!(base64(b"+/8=").as_deref(), Some(&[0xFB, 0xFF][..]));
        assert_eq!(base64(b"a*"), None);
        assert_eq!(percent_decoded("a%20b%E2%9A%93%z%"), "a b⚓%z%");
    }

    #[test]
    fn data_uris_come_in_several_spellings() {
        for uri in [
            "data:application/octet-stream;base64,c29uYXI=",
            "data:;base64,c29uYXI",
            "DATA:application/gltf-buffer;BASE64,c29u%59XI%3D",
            "data:text/plain,son%61r",
            "data:,sonar",
        ] {
            assert_eq!(data(uri).expect("data").as_deref(), Ok(&b"sonar"[..]), "{uri}");
        }
        assert!(data("data:application/octet-stream;base64").expect("data").is_err());
        assert!(data("data:;base64,*").expect("data").is_err());
        assert_eq!(data("sonar.bin"), None);
        assert_eq!((scheme("a/b:c"), scheme("1:2"), scheme("a+b:c")), (None, None, Some("a+b")));
    }
}
