//! What a plain scalar is: the core schema of YAML 1.2.
//!
//! Source: YAML 1.2.2, section 10.3.2. So `yes` is a text and `010` is ten; infinity and not-a-number are refused.

use super::node::Kind;

/// The value of a scalar without quotes; what is wrong with it otherwise.
pub(crate) fn resolve(text: &str) -> Result<Kind, &'static str> {
    Ok(match text {
        "" | "~" | "null" | "Null" | "NULL" => Kind::Null,
        "true" | "True" | "TRUE" => Kind::Bool(true),
        "false" | "False" | "FALSE" => Kind::Bool(false),
        _ => return number(text),
    })
}

fn number(text: &str) -> Result<Kind, &'static str> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let word = Ok(Kind::Text(text.to_owned()));
    if matches!(unsigned, ".inf" | ".Inf" | ".INF") || matches!(text, ".nan" | ".NaN" | ".NAN") {
        return Err("infinity and not-a-number are no values of a recipe");
    }
    let radix = match text.get(..2) {
        Some("0x") => Some(16),
        Some("0o") => Some(8),
        _ => None,
    };
    if let Some(radix) = radix {
        let digits = &text[2..];
        return if !digits.is_empty() && digits.chars().all(|c| c.is_digit(radix)) {
            whole(i128::from_str_radix(digits, radix).ok())
        } else {
            word
        };
    }
    if !unsigned.is_empty() && unsigned.bytes().all(|b| b.is_ascii_digit()) {
        return whole(text.parse().ok());
    }
    if !is_decimal(unsigned) {
        return word;
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(Kind::Float(value)),
        Ok(_) => Err("the number is too large"),
        Err(_) => word,
    }
}

fn whole(value: Option<i128>) -> Result<Kind, &'static str> {
    let range = i128::from(i64::MIN)..=i128::from(u64::MAX);
    value.filter(|value| range.contains(value)).map(Kind::Int).ok_or("the whole number is too large")
}

/// `( \. [0-9]+ | [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?`
fn is_decimal(text: &str) -> bool {
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent.strip_prefix(['+', '-']).unwrap_or(exponent))),
        None => (text, None),
    };
    let (before, after) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let some_digits = !(before.is_empty() && after.is_empty());
    some_digits && digits(before) && digits(after) && exponent.is_none_or(|e| !e.is_empty() && digits(e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_core_schema() {
        for text in ["", "~", "null", "Null", "NULL"] {
            assert_eq!(resolve(text), Ok(Kind::Null), "{text}");
        }
        for (text, value) in [("true", true), ("True", true), ("FALSE", false)] {
            assert_eq!(resolve(text), Ok(Kind::Bool(value)), "{text}");
        }
        for (text, value) in [
            ("0", 0),
            ("-12", -12),
            ("+7", 7),
            ("010", 10),
            ("0x1F", 31),
            ("0o17", 15),
            ("18446744073709551615", u64::MAX.into()),
        ] {
            assert_eq!(resolve(text), Ok(Kind::Int(value)), "{text}");
        }
        for (text, value) in [("1.5", 1.5), (".5", 0.5), ("5.", 5.0), ("1e3", 1000.0), ("-2.5E-1", -0.25)] {
            assert_eq!(resolve(text), Ok(Kind::Float(value)), "{text}");
        }
        for text in [
            "yes", "no", "on", "-", "+", ".", "1_000", "0x", "0xg", "1e", "e5", ".e5", "1.2.3", "--1", "nan", "inf",
            "é0", "+0x1",
        ] {
            assert_eq!(resolve(text), Ok(Kind::Text(text.to_owned())), "{text}");
        }
        for text in [".inf", "-.INF", ".nan", "1e999", "18446744073709551616", &"9".repeat(99)] {
            assert!(resolve(text).is_err(), "{text}");
        }
    }
}
