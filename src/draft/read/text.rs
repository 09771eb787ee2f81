//! A prompt as tokens, in a language, with its typing errors repaired.

use std::ops::Range;

use super::token::{Kind, Language, Token, tokens};
use super::vocabulary::vocabulary;
use crate::catalog::concepts::concepts;
use crate::catalog::search::query::{half_errors, nearest};

/// A prompt in pieces.
#[derive(Clone, Debug)]
pub(in crate::draft) struct Text<'a> {
    /// As it was written.
    pub source: &'a str,
    /// The language it is in.
    pub language: Language,
    /// Its tokens.
    pub tokens: Vec<Token>,
}

impl<'a> Text<'a> {
    /// Cuts a prompt.
    pub(in crate::draft) fn of(source: &'a str) -> Self {
        let language = language_of(&tokens(source, Language::English));
        let mut tokens = tokens(source, language);
        for token in tokens.iter_mut().filter(|token| token.kind == Kind::Word) {
            let misspelt = vocabulary().misspelt(&token.form).filter(|_| language == Language::English);
            if let Some(meant) = misspelt.or_else(|| repaired(&token.form, language)) {
                token.form = meant;
            }
        }
        Self { source, language, tokens }
    }

    /// Bytes of some tokens.
    pub(in crate::draft) fn bytes(&self, tokens: Range<usize>) -> Range<usize> {
        match self.tokens.get(tokens.clone()) {
            Some([first, .., last]) => first.bytes.start..last.bytes.end,
            Some([only]) => only.bytes.clone(),
            _ => 0..0,
        }
    }

    /// Some tokens as they were written.
    pub(in crate::draft) fn words(&self, tokens: Range<usize>) -> &'a str {
        self.source.get(self.bytes(tokens)).unwrap_or_default()
    }

    /// The form of a token; empty behind the last.
    pub(in crate::draft) fn form(&self, at: usize) -> &str {
        self.tokens.get(at).map_or("", |token| token.form.as_str())
    }

    /// Whether a token is this mark.
    pub(in crate::draft) fn is_mark(&self, at: usize, mark: char) -> bool {
        self.tokens.get(at).is_some_and(|token| token.is_mark(mark))
    }
}

/// The language that most words are of, English among equals.
fn language_of(tokens: &[Token]) -> Language {
    if tokens.iter().filter(|token| token.is_ideograph()).count() >= 2 {
        return Language::Chinese;
    }
    const ALL: [Language; 4] = [Language::English, Language::German, Language::Spanish, Language::French];
    let mut score = [0_u32; 4];
    for token in tokens.iter().filter(|token| token.kind == Kind::Word) {
        let of = vocabulary().languages_of(&token.form);
        // What is said in one language only tells most.
        let weight = if of.len() == 1 { 2 } else { 1 };
        for (language, score) in ALL.iter().zip(&mut score) {
            *score += if of.contains(language) { weight } else { 0 };
        }
    }
    let mut best = 0;
    for place in 1..ALL.len() {
        if score[place] > score[best] {
            best = place;
        }
    }
    ALL[best]
}

/// The known word that was meant by one that is not.
fn repaired(form: &str, language: Language) -> Option<String> {
    let letters = form.chars().count();
    let known = |word: &str| !vocabulary().languages_of(word).is_empty() || concepts().vocabulary().contains(word);
    let is_thing = || concepts().units(&[form.to_owned()]).iter().any(|unit| !unit.concepts.is_empty());
    if letters < 4 || is_thing() || !form.chars().all(|c| c.is_ascii_alphabetic()) || known(form) {
        return None;
    }
    let phonetic = form.replace('f', "ph");
    if phonetic != form && known(&phonetic) {
        return Some(phonetic);
    }
    // In halves: see the search.
    let errors = match letters {
        4 | 5 => 2,
        6 => 3,
        _ => 4,
    };
    let spoken = |word: &&str| {
        let of = vocabulary().languages_of(word);
        word.len() >= 4 && (of.contains(&Language::English) || of.contains(&language))
    };
    let said = nearest(form, vocabulary().words().filter(spoken), errors);
    let named = nearest(form, concepts().vocabulary().iter().map(String::as_str), errors);
    // Of words equally near, that of the request before that of a thing.
    let off = |word: &&str| half_errors(form, word);
    said.into_iter().chain(named).min_by_key(off).map(str::to_owned)
}
