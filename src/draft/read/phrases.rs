//! Phrases of several words and what each means.

use std::collections::HashMap;

use serde::Deserialize;

use super::text::Text;
use super::token::{Language, tokens};

/// Words for one meaning, by language.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(in crate::draft) struct Words {
    /// What the words are for, where their key does not say it.
    pub(super) is: Vec<String>,
    en: Vec<String>,
    de: Vec<String>,
    es: Vec<String>,
    fr: Vec<String>,
    zh: Vec<String>,
}

impl Words {
    /// Each with its language.
    pub(super) fn all(&self) -> impl Iterator<Item = (Language, &str)> {
        let all = [
            (Language::English, &self.en),
            (Language::German, &self.de),
            (Language::Spanish, &self.es),
            (Language::French, &self.fr),
            (Language::Chinese, &self.zh),
        ];
        all.into_iter().flat_map(|(language, words)| words.iter().map(move |word| (language, word.as_str())))
    }
}

/// Phrases with what they mean.
#[derive(Clone, Debug)]
pub(in crate::draft) struct Phrases<T> {
    /// By first word; the longest first.
    starts: HashMap<String, Vec<Phrase<T>>>,
}

#[derive(Clone, Debug)]
struct Phrase<T> {
    forms: Vec<String>,
    language: Language,
    means: T,
}

impl<T: Clone> Phrases<T> {
    /// Phrases of a table.
    pub(in crate::draft) fn of<'a>(table: impl IntoIterator<Item = (T, &'a Words)>) -> Self {
        let mut starts: HashMap<String, Vec<Phrase<T>>> = HashMap::new();
        for (means, words) in table {
            for (language, word) in words.all() {
                // German umlauts are also typed as two letters.
                let printed = word.replace('ä', "ae").replace('ö', "oe").replace('ü', "ue");
                for spelling in [Some(word.to_owned()), (printed != word).then_some(printed)].into_iter().flatten() {
                    let forms: Vec<String> = tokens(&spelling, language).into_iter().map(|token| token.form).collect();
                    let Some(first) = forms.first().cloned() else { continue };
                    let phrase = Phrase { forms, language, means: means.clone() };
                    // Adjectives of other languages have many endings: found by their root, too.
                    if let Some(root) = root(&first, language) {
                        starts.entry(format!("{root}~")).or_default().push(phrase.clone());
                    }
                    starts.entry(first).or_default().push(phrase);
                }
            }
        }
        for phrases in starts.values_mut() {
            phrases.sort_by_key(|phrase| std::cmp::Reverse(phrase.forms.len()));
        }
        Self { starts }
    }

    /// The longest phrase that begins at a token: how many tokens, and what it means. Words of languages that the text is
    /// not in count only if they are English.
    pub(in crate::draft) fn at(&self, text: &Text<'_>, at: usize) -> Option<(usize, &T)> {
        self.all_at(text, at).next()
    }

    /// Every phrase that begins at a token, the longest first.
    pub(in crate::draft) fn all_at(&self, text: &Text<'_>, at: usize) -> impl Iterator<Item = (usize, &T)> {
        let rest = text.tokens.get(at..).unwrap_or_default();
        let language = text.language;
        let phrases = |form: &str| self.starts.get(form).map_or(&[][..], Vec::as_slice);
        let first = rest.first().map_or("", |first| first.form.as_str());
        let declined = root(first, language).map_or(&[][..], |root| phrases(&format!("{root}~")));
        let fits = move |phrase: &&Phrase<T>| {
            (phrase.language == language || matches!(phrase.language, Language::English | Language::Chinese))
                && phrase.forms.len() <= rest.len()
                && phrase.forms.iter().zip(rest).all(|(form, token)| is_same(form, &token.form, phrase.language))
        };
        let mut found: Vec<(usize, &T)> = phrases(first)
            .iter()
            .chain(declined)
            .filter(fits)
            .map(|phrase| (phrase.forms.len(), &phrase.means))
            .collect();
        found.sort_by_key(|(tokens, _)| std::cmp::Reverse(*tokens));
        found.into_iter()
    }

    /// Every word of the phrases with its language.
    pub(in crate::draft) fn words(&self) -> impl Iterator<Item = (Language, &str)> {
        self.starts
            .values()
            .flatten()
            .flat_map(|phrase| phrase.forms.iter().map(move |form| (phrase.language, form.as_str())))
    }
}

/// A word without the ending that its gender, case or number gives it; none in languages without such, and of short words.
fn root(form: &str, language: Language) -> Option<&str> {
    let endings: &[&str] = match language {
        Language::German => &["en", "em", "er", "es", "e", "n", "s"],
        Language::Spanish => &["os", "as", "o", "a", "s"],
        Language::French => &["es", "e", "s"],
        Language::English | Language::Chinese => return None,
    };
    let once = |root: &str| endings.iter().find_map(|ending| root.strip_suffix(ending)).map(str::len);
    let mut root = form;
    if language != Language::German {
        let length = once(root).unwrap_or(root.len());
        return (length >= 4).then(|| &root[..length]);
    }
    // `vergraben` and `vergrabenen` come to one root.
    while let Some(shorter) = endings.iter().find_map(|ending| root.strip_suffix(ending)).filter(|root| root.len() >= 4)
    {
        root = shorter;
    }
    (root.len() >= 4).then_some(root)
}

fn is_same(form: &str, written: &str, language: Language) -> bool {
    form == written || (form.len() >= 4 && root(form, language).is_some_and(|one| root(written, language) == Some(one)))
}
