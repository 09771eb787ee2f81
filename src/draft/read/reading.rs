//! A prompt that is being read: which words have told what, and what was learnt so far.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;

use super::measures::StandCue;
use super::path::Parts;
use super::phrases::Phrases;
use super::place::{Place, place_at};
use super::quantity::{Measure, Quantity, quantity_at, sides_at};
use super::text::Text;
use super::token::{Kind, Language};
use super::vocabulary::{Word, vocabulary};
use crate::catalog::concepts::concepts;
use crate::draft::find::{Found, is_known_thing, models};
use crate::draft::wish::{Said, Source, Wish};
use crate::draft::{Known, Problem};

/// A prompt that is being read.
pub(super) struct Reading<'a> {
    /// Its tokens.
    pub text: Text<'a>,
    /// What there is to choose from.
    pub known: &'a Known,
    /// What was learnt.
    pub wish: Wish,
    /// What cannot be.
    pub problems: Vec<Problem>,
    /// Which tokens have told something.
    taken: Vec<bool>,
    /// Places in numbers.
    pub places: Vec<Place>,
    /// Sides of areas, metres.
    pub sides: Vec<(Vec<f64>, Range<usize>)>,
    /// Amounts that nothing has been made of.
    pub quantities: Vec<Quantity>,
    /// What is said of things that are not read yet.
    pub pending: Vec<StandCue>,
    /// Amounts of the route.
    pub route: Parts,
    /// Tokens of the structure.
    pub environment_at: Option<Range<usize>>,
    /// Models that were looked for, by name.
    found: RefCell<BTreeMap<String, Result<Found, Vec<String>>>>,
}

impl<'a> Reading<'a> {
    /// Nothing is read yet.
    pub fn of(source: &'a str, known: &'a Known) -> Self {
        let text = Text::of(source);
        let taken = vec![false; text.tokens.len()];
        Self {
            text,
            known,
            wish: Wish::default(),
            problems: Vec::new(),
            taken,
            places: Vec::new(),
            sides: Vec::new(),
            quantities: Vec::new(),
            pending: Vec::new(),
            route: Parts::default(),
            environment_at: None,
            found: RefCell::default(),
        }
    }

    /// The models that a name means: see [`models`].
    pub fn models(&self, name: &str) -> Result<Found, Vec<String>> {
        self.found.borrow_mut().entry(name.to_owned()).or_insert_with(|| models(name, self.known)).clone()
    }

    /// Finds the numbers that are left.
    pub fn find_numbers(&mut self) {
        let mut at = 0;
        while at < self.len() {
            let free = |reading: &Self, tokens: &Range<usize>| tokens.clone().all(|at| reading.is_free(at));
            if let Some(place) = place_at(&self.text, at).filter(|place| free(self, &place.tokens)) {
                at = place.tokens.end;
                self.take(place.tokens.clone());
                self.places.push(place);
            } else if let Some((sides, tokens)) = sides_at(&self.text, at).filter(|(_, tokens)| free(self, tokens)) {
                at = tokens.end;
                self.sides.push((sides, tokens));
            } else if let Some(quantity) = quantity_at(&self.text, at).filter(|found| free(self, &found.tokens)) {
                at = quantity.tokens.end;
                self.quantities.push(quantity);
            } else {
                at += 1;
            }
        }
    }

    /// How many tokens.
    pub fn len(&self) -> usize {
        self.text.tokens.len()
    }

    /// Whether a token has told nothing yet.
    pub fn is_free(&self, at: usize) -> bool {
        self.taken.get(at) == Some(&false)
    }

    /// Marks tokens as those that have told something.
    pub fn take(&mut self, tokens: Range<usize>) {
        for at in tokens {
            if let Some(taken) = self.taken.get_mut(at) {
                *taken = true;
            }
        }
    }

    /// A value that some tokens say.
    pub fn said<T>(&self, tokens: Range<usize>, value: T) -> Said<T> {
        Said::by(self.text.bytes(tokens), value)
    }

    /// A value that tokens of several places say.
    pub fn said_by<T>(&self, tokens: &[Range<usize>], value: T) -> Said<T> {
        let mut words: Vec<Range<usize>> =
            tokens.iter().filter(|tokens| !tokens.is_empty()).map(|tokens| self.text.bytes(tokens.clone())).collect();
        words.sort_by_key(|range| range.start);
        Said { value, source: Source::Words(words) }
    }

    /// How many tokens at a place say a word.
    pub fn word(&self, at: usize, wanted: Word) -> Option<usize> {
        vocabulary().words.all_at(&self.text, at).find(|(_, word)| **word == wanted).map(|(tokens, _)| tokens)
    }

    /// Free tokens that say a word, the first such place.
    pub fn find(&self, wanted: Word) -> Option<Range<usize>> {
        self.find_all(wanted).into_iter().next()
    }

    /// Every place whose free tokens say a word.
    pub fn find_all(&self, wanted: Word) -> Vec<Range<usize>> {
        let mut found = Vec::new();
        let mut at = 0;
        while at < self.len() {
            let tokens = self.word(at, wanted).filter(|tokens| (at..at + tokens).all(|at| self.is_free(at)));
            if let Some(tokens) = tokens {
                found.push(at..at + tokens);
            }
            at += tokens.unwrap_or(1);
        }
        found
    }

    /// The phrase that ends right before a token.
    pub fn ending_at<'p, T: Clone>(&self, phrases: &'p Phrases<T>, end: usize) -> Option<(usize, &'p T)> {
        (1..=7.min(end)).rev().find_map(|count| {
            let begin = end - count;
            let mut all = phrases.all_at(&self.text, begin);
            all.find(|(tokens, _)| *tokens == count).map(|(_, means)| (begin, means))
        })
    }

    /// The quantity whose first token this is, if nothing has been made of it.
    pub fn quantity_at(&self, at: usize) -> Option<&Quantity> {
        self.quantities.iter().find(|quantity| quantity.tokens.start == at && self.is_free(at))
    }

    /// A mere number, or a choice or range of such.
    pub fn number_at(&self, at: usize) -> Option<&Quantity> {
        self.quantity_at(at).filter(|quantity| quantity.measure == Measure::Number)
    }

    /// Whether a mere number ends right before a token.
    pub fn number_at_end(&self, at: usize) -> bool {
        self.quantities.iter().any(|quantity| quantity.tokens.end == at && quantity.measure == Measure::Number)
    }

    /// Whether a token is one that people say something between two others with.
    pub fn is_link(&self, at: usize) -> bool {
        const LINKS: [&str; 19] = [
            "of", "is", "be", "a", "an", "the", "=", ":", "von", "de", "d", "es", "est", "ist", "是", "为", "的", "\"",
            "to",
        ];
        let form = self.text.form(at);
        LINKS.contains(&form) || form == "i" && self.text.words(at..at + 1) == "is"
    }

    /// How many tokens at a place name a thing that the table of things knows: of free words only.
    pub fn thing_at(&self, at: usize) -> Option<usize> {
        self.named_at(at, |at| self.is_free(at))
    }

    /// As [`Self::thing_at`], of words that were read, too.
    pub fn any_thing_at(&self, at: usize) -> Option<usize> {
        self.named_at(at, |_| true)
    }

    fn named_at(&self, at: usize, may: impl Fn(usize) -> bool) -> Option<usize> {
        let first = self.text.tokens.get(at).filter(|token| token.kind == Kind::Word && may(at))?;
        let run = |most: usize| (at..self.len().min(at + most)).take_while(|&next| may(next));
        if first.is_ideograph() {
            let letters: Vec<&str> = run(6)
                .take_while(|&next| self.text.tokens[next].is_ideograph())
                .map(|next| self.text.form(next))
                .collect();
            return (1..=letters.len()).rev().find(|&count| {
                let units = concepts().units(&[letters[..count].concat()]);
                matches!(units.as_slice(), [unit] if !unit.concepts.is_empty())
            });
        }
        let is_word = |next: &usize| {
            let token = &self.text.tokens[*next];
            let ends = matches!(
                token.form.as_str(),
                "on" | "in" | "at" | "and" | "or" | "with" | "to" | "by" | "for" | "from" | "und" | "y" | "et"
            );
            (token.kind == Kind::Word && !token.is_ideograph() && !ends) || (token.number().is_some() && token.glued)
        };
        // The table of things leaves out words such as `de`: `carrito de compras`.
        let silent =
            |form: &str| matches!(form, "of" | "de" | "d" | "du" | "des" | "del" | "a" | "la" | "l" | "en" | "the");
        let places: Vec<usize> =
            run(6).take_while(is_word).filter(|&next| next == at || !silent(self.text.form(next))).collect();
        let forms: Vec<String> = places.iter().map(|&next| self.text.form(next).to_owned()).collect();
        if forms.is_empty() || silent(&forms[0]) {
            return None;
        }
        let units = concepts().units(&forms);
        let unit = units.first()?;
        if !unit.concepts.is_empty() {
            return Some(places[unit.words.len() - 1] + 1 - at);
        }
        let long = if self.text.language == Language::English { 7 } else { 5 };
        let is_compound = forms[0].len() >= long
            && vocabulary().words.at(&self.text, at).is_none()
            && !vocabulary().plain.contains(&forms[0])
            && is_known_thing(&forms[0]);
        is_compound.then_some(1)
    }

    /// Whether a word was written in the plural, as far as that can be seen.
    pub fn is_plural(&self, at: usize) -> bool {
        let written = self.text.words(at..at + 1).to_lowercase();
        self.text.tokens.get(at).is_some_and(|token| token.form != written && written.ends_with(['s', 'e', 'n', 'x']))
    }

    /// Whether a word is turned off by one shortly before it: "no noise", "without any tires".
    pub fn is_negated(&self, at: usize) -> bool {
        let begin = at.saturating_sub(3);
        (begin..at).any(|before| {
            self.word(before, Word::Without).is_some_and(|tokens| {
                let between = before + tokens..at;
                before + tokens <= at
                    && between.clone().count() <= 2
                    && between
                        .into_iter()
                        .all(|at| self.text.tokens[at].kind == Kind::Word && self.thing_at(at).is_none())
            })
        })
    }
}
