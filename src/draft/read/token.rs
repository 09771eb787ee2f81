//! A prompt cut into words, numbers and marks, each with its bytes.
//!
//! Knows how numbers are written in five languages; knows nothing of what words mean.

use std::ops::Range;

use crate::catalog::words::{is_ideograph, raw, stem};

/// Greatest number: more of anything is as many as this, and refused.
const MOST: f64 = 9e14;

/// A language that prompts are written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::draft) enum Language {
    /// English, and whatever else is not told to be another.
    #[default]
    English,
    /// German.
    German,
    /// Spanish.
    Spanish,
    /// French.
    French,
    /// Chinese.
    Chinese,
}

/// A word, a number or a mark.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::draft) struct Token {
    /// Bytes of the prompt.
    pub bytes: Range<usize>,
    /// Which it is.
    pub kind: Kind,
    /// In common form: a word in lower case, singular, without accents; a number as it is written; a mark as it is.
    pub form: String,
    /// Whether it stands directly behind the one before, or behind a hyphen: `m` of `12m`, `buried` of `half-buried`.
    pub glued: bool,
}

/// Kinds of tokens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::draft) enum Kind {
    /// A word, or a single letter of a script without spaces.
    Word,
    /// A number in digits, never negative.
    Number(f64),
    /// Anything else: dashes and minus signs are `-`, full-width marks as in English.
    Mark(char),
}

impl Token {
    /// The number that it is.
    pub(in crate::draft) fn number(&self) -> Option<f64> {
        match self.kind {
            Kind::Number(value) => Some(value),
            Kind::Word | Kind::Mark(_) => None,
        }
    }

    /// Whether it is this mark.
    pub(in crate::draft) fn is_mark(&self, mark: char) -> bool {
        self.kind == Kind::Mark(mark)
    }

    /// Whether it is a letter of a script without spaces.
    pub(in crate::draft) fn is_ideograph(&self) -> bool {
        self.kind == Kind::Word && self.form.chars().all(is_ideograph)
    }
}

/// The tokens of a text that is in this language.
pub(in crate::draft) fn tokens(text: &str, language: Language) -> Vec<Token> {
    let letters: Vec<(usize, char)> = text.char_indices().map(|(at, letter)| (at, plain(letter))).collect();
    let mut cut = Cut { text, letters, at: 0, language, tokens: Vec::new() };
    while cut.at < cut.letters.len() {
        cut.next();
    }
    cut.tokens
}

/// Marks that mean the same are the same.
fn plain(letter: char) -> char {
    match letter {
        '\u{FF01}'..='\u{FF5E}' => char::from_u32(letter as u32 - 0xFEE0).unwrap_or(letter),
        '\u{2010}'..='\u{2015}' | '−' | '﹣' => '-',
        '、' => ',',
        '。' => '.',
        '’' | '‘' | '′' | '`' | '´' => '\'',
        '“' | '”' | '″' | '„' | '«' | '»' | '「' | '」' => '"',
        '×' | '✕' => 'x',
        'º' => '°',
        '∼' | '≈' | '≃' => '~',
        other => other,
    }
}

struct Cut<'a> {
    text: &'a str,
    letters: Vec<(usize, char)>,
    at: usize,
    language: Language,
    tokens: Vec<Token>,
}

impl Cut<'_> {
    fn letter(&self, at: usize) -> Option<char> {
        self.letters.get(at).map(|(_, letter)| *letter)
    }

    fn byte(&self, at: usize) -> usize {
        self.letters.get(at).map_or(self.text.len(), |(byte, _)| *byte)
    }

    fn is(&self, at: usize, test: impl Fn(char) -> bool) -> bool {
        self.letter(at).is_some_and(test)
    }

    fn before(&self) -> Option<char> {
        self.at.checked_sub(1).and_then(|at| self.letter(at))
    }

    fn push(&mut self, from: usize, to: usize, kind: Kind, form: String) {
        let bytes = self.byte(from)..self.byte(to);
        let hyphen = |byte: usize| self.text[byte..bytes.start].chars().all(|c| plain(c) == '-');
        let glued = self.tokens.last().is_some_and(|last| last.bytes.end <= bytes.start && hyphen(last.bytes.end));
        self.tokens.push(Token { bytes, kind, form, glued });
    }

    fn next(&mut self) {
        let Some(letter) = self.letter(self.at) else { return };
        if letter.is_whitespace() {
            self.at += 1;
        } else if letter.is_ascii_digit() {
            self.digits();
        } else if let Some(value) = fraction(letter) {
            self.single(Kind::Number(value));
        } else if is_ideograph(letter) {
            self.single(Kind::Word);
        } else if is_letter(letter) {
            self.word();
        } else if matches!(letter, '-' | '\'') && self.joins_words() {
            self.at += 1;
        } else {
            self.single(Kind::Mark(letter));
        }
    }

    fn single(&mut self, kind: Kind) {
        let form = self.letter(self.at).map(String::from).unwrap_or_default();
        self.push(self.at, self.at + 1, kind, form);
        self.at += 1;
    }

    /// A hyphen or an apostrophe with a word behind it and no blank on either side.
    fn joins_words(&self) -> bool {
        self.before().is_some_and(char::is_alphanumeric) && self.is(self.at + 1, is_letter)
    }

    fn word(&mut self) {
        let begin = self.at;
        let x_of_a_size = |cut: &Self| {
            cut.letter(begin) == Some('x') && cut.is(begin + 1, |next| next.is_ascii_digit() || next == ' ')
        };
        if x_of_a_size(self) {
            self.at += 1;
        } else {
            self.while_letters(begin);
        }
        let written = &self.text[self.byte(begin)..self.byte(self.at)];
        // A multiplication sign is an `x`.
        let folded = if written == "×" || written == "✕" { "x".to_owned() } else { raw(written).concat() };
        self.push(begin, self.at, Kind::Word, stem(&folded));
    }

    fn while_letters(&mut self, begin: usize) {
        loop {
            if self.is(self.at, is_letter) {
                self.at += 1;
            } else if self.letter(self.at) == Some('\'') && self.is(self.at + 1, is_letter) {
                let before: String = (begin..self.at).filter_map(|at| self.letter(at)).collect();
                // `l'ancre` is two words, `ship's` one.
                if matches!(before.to_lowercase().as_str(), "l" | "d" | "s" | "n" | "c" | "j" | "m" | "t" | "qu") {
                    break;
                }
                self.at += 1;
            } else {
                break;
            }
        }
    }

    fn digits(&mut self) {
        let begin = self.at;
        while self.is(self.at, |c| c.is_ascii_digit())
            || (self.is(self.at, |c| matches!(c, '.' | ',' | '\''))
                && self.is(self.at + 1, |c| c.is_ascii_digit())
                && self.is(self.at - 1, |c| c.is_ascii_digit()))
        {
            self.at += 1;
        }
        let run: String = (begin..self.at).filter_map(|at| self.letter(at)).collect();
        // `1e3`.
        let exponent: String =
            (1..3).filter_map(|more| self.letter(self.at + more)).take_while(char::is_ascii_digit).collect();
        if self.is(self.at, |c| matches!(c, 'e' | 'E'))
            && !exponent.is_empty()
            && !self.is(self.at + 1 + exponent.len(), char::is_alphanumeric)
            && let Some(value) = format!("{run}e{exponent}").parse().ok().filter(|value: &f64| value.is_finite())
        {
            self.at += 1 + exponent.len();
            return self.push(begin, self.at, Kind::Number(value), run);
        }
        match self.value(&run, begin) {
            Some(value) => self.push_number(begin, value, run),
            None => self.separately(begin),
        }
    }

    /// The value of digits with their commas and points; none if these part numbers of a list.
    fn value(&self, run: &str, begin: usize) -> Option<f64> {
        let marks: Vec<char> = run.chars().filter(|c| !c.is_ascii_digit()).collect();
        let groups: Vec<&str> = run.split(['.', ',', '\'']).collect();
        let thousands = |groups: &[&str]| {
            groups[0].len() <= 3 && !groups[0].starts_with('0') && groups[1..].iter().all(|group| group.len() == 3)
        };
        let european = matches!(self.language, Language::German | Language::Spanish | Language::French);
        match marks.as_slice() {
            [] => run.parse().ok(),
            [','] if self.in_brackets(begin) => None,
            [mark] => {
                let grouped = thousands(&groups) && (*mark == '\'' || (*mark == '.') == european);
                let joined = if grouped { groups.concat() } else { groups.join(".") };
                joined.parse().ok()
            }
            [first, rest @ ..] => {
                let last = rest.last()?;
                if rest.iter().all(|mark| mark == first) {
                    return thousands(&groups).then(|| groups.concat().parse().ok()).flatten();
                }
                let (whole, part) = (&groups[..groups.len() - 1], groups[groups.len() - 1]);
                let sound = thousands(whole) && marks[..marks.len() - 1].iter().all(|mark| mark != last);
                sound.then(|| format!("{}.{part}", whole.concat()).parse().ok()).flatten()
            }
        }
    }

    /// Whether digits stand in brackets with nothing but numbers: `(3,4)` is a place.
    fn in_brackets(&self, begin: usize) -> bool {
        let inside = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | ';' | '-' | '+' | ' ');
        let back = (0..begin).rev().filter_map(|at| self.letter(at)).find(|c| !inside(*c));
        let ahead = (self.at..self.letters.len()).filter_map(|at| self.letter(at)).find(|c| !inside(*c));
        matches!((back, ahead), (Some('(' | '[' | '{'), Some(')' | ']' | '}')))
    }

    fn push_number(&mut self, begin: usize, value: f64, mut run: String) {
        let after_word = begin > 0 && self.is(begin - 1, is_letter);
        let mut value = value.min(MOST);
        // `10 000`.
        while !after_word && run.len() <= 12 && run.chars().all(|c| c.is_ascii_digit()) && value >= 1.0 {
            let group: String = (1..=3).filter_map(|more| self.letter(self.at + more)).collect();
            let is_group = self.letter(self.at) == Some(' ')
                && group.len() == 3
                && group.chars().all(|c| c.is_ascii_digit())
                && (group == "000" || self.language == Language::French)
                && (run.len() <= 3 || value >= 1000.0)
                && !self.is(self.at + 4, |c| c.is_ascii_digit());
            if !is_group {
                break;
            }
            run.push_str(&group);
            value = run.parse().unwrap_or(value);
            self.at += 4;
        }
        self.push(begin, self.at, Kind::Number(value), run);
    }

    /// Numbers of a list with nothing but marks between them.
    fn separately(&mut self, begin: usize) {
        let end = self.at;
        let mut from = begin;
        for at in begin..=end {
            if at < end && self.is(at, |c| c.is_ascii_digit()) {
                continue;
            }
            let run: String = (from..at).filter_map(|at| self.letter(at)).collect();
            let value = run.parse().unwrap_or(MOST).min(MOST);
            self.push(from, at, Kind::Number(value), run);
            if let Some(mark) = self.letter(at).filter(|_| at < end) {
                self.push(at, at + 1, Kind::Mark(mark), mark.into());
            }
            from = at + 1;
        }
    }
}

fn is_letter(letter: char) -> bool {
    (letter.is_alphabetic() || ('\u{300}'..'\u{370}').contains(&letter)) && !is_ideograph(letter)
}

fn fraction(letter: char) -> Option<f64> {
    Some(match letter {
        '½' => 0.5,
        '¼' => 0.25,
        '¾' => 0.75,
        '⅓' => 1.0 / 3.0,
        '⅔' => 2.0 / 3.0,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_numbers_and_marks_are_parted() {
        let forms = |text: &str| -> String {
            tokens(text, Language::English).into_iter().map(|token| token.form).collect::<Vec<_>>().join(" ")
        };
        for (text, expected) in [
            ("Two half-buried tyres.", "two half buried tire ."),
            ("12m, 1.2MHz", "12 m , 1.2 mhz"),
            ("20x20 m", "20 x 20 m"),
            ("10-25 m", "10 - 25 m"),
            ("−12 m", "- 12 m"),
            ("70/20/10", "70 / 20 / 10"),
            ("(0,0)", "( 0 , 0 )"),
            ("1,000 and 2,5", "1,000 and 2,5"),
            ("d'une ancre, ship's", "d une ancre , ship"),
            ("M1200d-hf", "m 1200 d hf"),
            ("沙底12米", "沙 底 12 米"),
            ("2.5.1", "2 . 5 . 1"),
            ("xray x3", "xray x 3"),
        ] {
            assert_eq!(forms(text), expected, "{text}");
        }
        let numbers =
            |text: &str, language| -> Vec<f64> { tokens(text, language).iter().filter_map(Token::number).collect() };
        assert_eq!(numbers("1,000 1.000 12,5 10 000 0.125", Language::English), [1000.0, 1.0, 12.5, 10000.0, 0.125]);
        assert_eq!(numbers("1.000 12,5 1,500 1.234,5", Language::German), [1000.0, 12.5, 1.5, 1234.5]);
    }

    #[test]
    fn every_token_has_its_bytes() {
        for text in ["锚 ü-Boot, 12½ m ×3 “a” d'ancre x", "-", "1.", "١٢", "a\u{301}b", "'", "9999999999999999999999.5"]
        {
            for token in tokens(text, Language::French) {
                assert!(text.get(token.bytes.clone()).is_some_and(|words| !words.is_empty()), "{text}: {token:?}");
            }
        }
    }
}
