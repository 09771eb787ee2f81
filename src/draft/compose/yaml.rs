//! Values of a recipe. Nothing becomes one but numbers, words of closed lists and quoted names.

use crate::draft::wish::Amount;

/// A value as it stands in a recipe, in flow style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::draft) struct Yaml(String);

/// Values that equal steps make where nobody says how many.
const STEPS: u32 = 5;

impl Yaml {
    pub fn text(&self) -> &str {
        &self.0
    }

    /// A number, to a millionth.
    pub fn number(value: f64) -> Self {
        let text = format!("{value:.6}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        Self(if text == "-0" { "0" } else { text }.to_owned())
    }

    pub fn whole(value: u64) -> Self {
        Self(value.to_string())
    }

    /// A name: plain where YAML reads it as the text that it is, else quoted.
    pub fn word(word: &str) -> Self {
        // Words that some YAML reads as something else.
        const TAKEN: [&str; 9] = ["on", "off", "yes", "no", "true", "false", "null", "y", "n"];
        let begins = word.starts_with(|c: char| c.is_ascii_lowercase());
        let plain = begins && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || "-_".contains(c));
        if plain && !TAKEN.contains(&word) {
            return Self(word.to_owned());
        }
        // JSON's strings are YAML's, and its escapes too. Letters that a terminal obeys are none of a name's.
        let seen: String = word.chars().filter(|c| !crate::catalog::text::is_unseen(*c)).collect();
        Self(serde_json::Value::from(seen).to_string())
    }

    pub fn list(items: impl IntoIterator<Item = Self>) -> Self {
        let items: Vec<String> = items.into_iter().map(|item| item.0).collect();
        Self(format!("[{}]", items.join(", ")))
    }

    pub fn map(entries: impl IntoIterator<Item = (&'static str, Self)>) -> Self {
        let entries: Vec<String> = entries.into_iter().map(|(key, value)| format!("{key}: {}", value.0)).collect();
        Self(format!("{{{}}}", entries.join(", ")))
    }

    /// A kind with its parameters, `{ripples: {height_m: 0.05}}`.
    pub fn kind(name: &str, entries: impl IntoIterator<Item = (&'static str, Self)>) -> Self {
        Self(format!("{{{}: {}}}", Self::word(name).0, Self::map(entries).0))
    }

    pub fn uniform(low: f64, high: f64) -> Self {
        if low == high {
            return Self::number(low);
        }
        Self::map([("uniform", Self::list([Self::number(low), Self::number(high)]))])
    }

    /// One of several, each as likely.
    pub fn choice(items: impl IntoIterator<Item = Self>) -> Self {
        let mut items: Vec<Self> = items.into_iter().collect();
        match (items.pop(), items.is_empty()) {
            (Some(only), true) => only,
            (last, _) => Self::map([("choice", Self::list(items.into_iter().chain(last)))]),
        }
    }

    /// An amount: exactly it, or drawn from what it may be.
    pub fn amount(amount: &Amount) -> Self {
        match amount {
            Amount::Exactly(value) => Self::number(*value),
            Amount::Between(low, high) => Self::uniform(*low, *high),
            Amount::OneOf(values) => Self::choice(values.iter().map(|value| Self::number(*value))),
            Amount::Steps(first, last, count) => Self::choice(steps(*first, *last, *count).map(Self::number)),
        }
    }

    /// The same, drawn anew for each frame.
    pub fn amount_per_frame(amount: &Amount) -> Self {
        let Self(once) = Self::amount(amount);
        match once.strip_suffix('}') {
            Some(open) => Self(format!("{open}, per: frame}}")),
            None => Self(once),
        }
    }
}

/// Values in equal steps.
fn steps(first: f64, last: f64, count: Option<u32>) -> impl Iterator<Item = f64> {
    let count = count.unwrap_or(STEPS).clamp(2, 1000);
    (0..count).map(move |k| first + (last - first) * f64::from(k) / f64::from(count - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values() {
        let texts = [
            Yaml::number(3.048),
            Yaml::number(-0.0),
            Yaml::number(12.0),
            Yaml::uniform(1.0, 2.5),
            Yaml::uniform(2.0, 2.0),
            Yaml::amount(&Amount::Steps(2.0, 8.0, Some(3))),
            Yaml::amount_per_frame(&Amount::Between(3.0, 5.0)),
            Yaml::amount_per_frame(&Amount::Exactly(3.0)),
            Yaml::choice([Yaml::word("mud")]),
        ];
        let expected = [
            "3.048",
            "0",
            "12",
            "{uniform: [1, 2.5]}",
            "2",
            "{choice: [2, 5, 8]}",
            "{uniform: [3, 5], per: frame}",
            "3",
            "mud",
        ];
        assert_eq!(texts.each_ref().map(Yaml::text), expected);
    }

    #[test]
    fn names_cannot_break_out() {
        for name in ["a: b", "x, y}", "\"", "*ref", "&a", "!tag", "- x", "no", "12", "", "a\nb", "~/x", "锚", "'"] {
            let text = format!("{{uid: {}, next: 1}}", Yaml::word(name).text());
            let back: serde_yaml::Value = serde_yaml::from_str(&text).expect(&text);
            let seen: String = name.chars().filter(|c| !crate::catalog::text::is_unseen(*c)).collect();
            assert_eq!((back["uid"].as_str(), back["next"].as_u64()), (Some(&*seen), Some(1)), "{text}");
            assert_eq!(text.lines().count(), 1);
        }
    }
}
