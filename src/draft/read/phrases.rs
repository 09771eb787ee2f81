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
                    if let Some(first) = forms.first().cloned() {
                        starts.entry(first).or_default().push(Phrase { forms, language, means: means.clone() });
                    }
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
        let phrases = rest.first().and_then(|first| self.starts.get(&first.form)).map_or(&[][..], Vec::as_slice);
        let fits = move |phrase: &&Phrase<T>| {
            (phrase.language == language || matches!(phrase.language, Language::English | Language::Chinese))
                && phrase.forms.len() <= rest.len()
                && phrase.forms.iter().zip(rest).all(|(form, token)| *form == token.form)
        };
        phrases.iter().filter(fits).map(|phrase| (phrase.forms.len(), &phrase.means))
    }

    /// Every word of the phrases with its language.
    pub(in crate::draft) fn words(&self) -> impl Iterator<Item = (Language, &str)> {
        self.starts
            .values()
            .flatten()
            .flat_map(|phrase| phrase.forms.iter().map(move |form| (phrase.language, form.as_str())))
    }
}
