//! The things of a prompt, how many and how they stand, from its first word to its last.

use std::ops::Range;

use super::measures::StandCue;
use super::noun::{Article, Noun, noun_at};
use super::reading::Reading;
use super::stand::{Relation, StandWord, add, stand_word};
use super::vocabulary::{Cue, Word};
use crate::catalog::concepts::concepts;
use crate::draft::Problem;
use crate::draft::wish::{Amount, Count, Stand, Thing, Unknown};

/// Finds the things.
pub(super) fn spot(reading: &mut Reading<'_>, stands: Vec<StandCue>) {
    let mut walk = Walk {
        stands,
        at: 0,
        group: Vec::new(),
        closed: false,
        negating: false,
        correcting: false,
        relation: None,
        lead: Vec::new(),
        halves: 0,
        headings: Vec::new(),
        reading,
    };
    while walk.at < walk.reading.len() {
        let before = walk.at;
        walk.step();
        if walk.at <= before {
            walk.at = before + 1;
        }
    }
    walk.mines();
    let headings = std::mem::take(&mut walk.headings);
    if walk.reading.wish.things.is_empty() && walk.reading.wish.unknown.is_empty() {
        for noun in headings {
            walk.thing(&noun);
        }
    }
}

/// Parts of structures that are no things by themselves.
pub(super) fn is_part(form: &str) -> bool {
    matches!(
        form,
        "wall"
            | "side"
            | "floor"
            | "face"
            | "edge"
            | "corner"
            | "wand"
            | "mauer"
            | "pared"
            | "muro"
            | "mur"
            | "pile"
            | "墙"
    )
}

pub(super) struct Walk<'r, 'a> {
    pub(super) reading: &'r mut Reading<'a>,
    pub(super) stands: Vec<StandCue>,
    pub(super) at: usize,
    /// Numbers of the things that the next words tell of.
    pub(super) group: Vec<usize>,
    /// Whether something was told of the group, so that another thing begins another group.
    pub(super) closed: bool,
    /// Whether things must not be there.
    pub(super) negating: bool,
    /// Whether the next thing is said instead of another: "No, two anchors".
    pub(super) correcting: bool,
    /// What the next thing is to the group, with the distance.
    pub(super) relation: Option<(Relation, Option<Amount>, Range<usize>)>,
    /// What is told of every thing that follows in the sentence: "scatter".
    pub(super) lead: Vec<(Range<usize>, StandWord)>,
    /// How many halves of a thing were told of.
    pub(super) halves: u32,
    /// Groups before a colon: "clutter: shells and bombs".
    pub(super) headings: Vec<Noun>,
}

impl Walk<'_, '_> {
    fn step(&mut self) {
        let at = self.at;
        if let Some(place) = self.stands.iter().position(|cue| cue.tokens.start == at && !self.is_size_before(cue)) {
            let cue = self.stands.remove(place);
            self.at = cue.tokens.end;
            return self.cue(&cue);
        }
        if self.mark() || self.place() || self.area() || self.half() || self.each() || self.more() || self.turn() {
            return;
        }
        if let Some((tokens, word)) = stand_word(self.reading, at)
            && self.stand(tokens, word)
        {
            return;
        }
        if let Some(noun) = noun_at(self.reading, &self.stands, at) {
            return self.noun(&noun);
        }
        self.preposition();
        self.at += 1;
    }

    /// A size before the thing that it is of: `a 2 m long cylinder`.
    fn is_size_before(&self, cue: &StandCue) -> bool {
        cue.cue == Cue::Size && (cue.tokens.end..cue.tokens.end + 3).any(|at| self.reading.thing_at(at).is_some()) && {
            let before = self.reading.text.form(cue.tokens.start.wrapping_sub(1));
            matches!(before, "a" | "an" | "the" | "ein" | "eine" | "un" | "une") || self.group.is_empty()
        }
    }

    /// Marks that end a sentence or a list.
    fn mark(&mut self) -> bool {
        let text = &self.reading.text;
        if text.is_mark(self.at, '.')
            || text.is_mark(self.at, ';')
            || text.is_mark(self.at, '!')
            || text.is_mark(self.at, '?')
        {
            self.closed = true;
            self.negating = false;
            self.relation = None;
            self.lead.clear();
            self.at += 1;
            return true;
        }
        if text.is_mark(self.at, ',') {
            let next = self.at + 1;
            let or = matches!(text.form(next), "or" | "nor" | "oder" | "ni" | "o" | "ou");
            if self.negating && !or && (self.reading.thing_at(next).is_none() || self.has_article(next)) {
                self.negating = false;
            }
            self.relation = None;
            self.at += 1;
            return true;
        }
        false
    }

    fn has_article(&self, at: usize) -> bool {
        matches!(self.reading.text.form(at), "a" | "an" | "the") || self.reading.number_at(at).is_some()
    }

    /// Words that turn things off, or on again.
    fn turn(&mut self) -> bool {
        let free = self.reading.is_free(self.at);
        // `no more than three cans`.
        if self.reading.number_at(self.at).is_some_and(|number| number.bound.is_some()) {
            return false;
        }
        let off = self.reading.word(self.at, Word::Without).filter(|_| free);
        let on = self.reading.word(self.at, Word::Include).filter(|_| free);
        match (off, on) {
            (Some(tokens), on) if on.is_none_or(|on| on <= tokens) => {
                let next = self.at + tokens;
                // `No, two anchors.`
                self.correcting = self.reading.text.is_mark(next, ',') && self.reading.text.form(self.at) == "no";
                self.negating = !self.correcting;
                self.at = next;
                true
            }
            (_, Some(tokens)) => {
                let was = self.negating;
                self.negating = false;
                self.at += tokens;
                if was || self.reading.text.form(self.at - tokens) == "with" {
                    self.closed = true;
                }
                self.relation = None;
                true
            }
            _ => false,
        }
    }

    fn noun(&mut self, noun: &Noun) {
        self.at = noun.tokens.end;
        let text = &self.reading.text;
        // `rocks that look like mines`, `mine-like`.
        let alike = matches!(text.form(noun.tokens.start.wrapping_sub(1)), "like" | "resembling" | "than")
            || (text.form(noun.tokens.end) == "like"
                && text.tokens.get(noun.tokens.end).is_some_and(|token| token.glued));
        if alike {
            return;
        }
        // `the wall of the tank`: part of the structure.
        let place = self.reading.environment_at.is_some() || self.reading.wish.path.route.is_some();
        if place && is_part(&noun.name) {
            return;
        }
        if self.negating {
            let label = crate::draft::find::name_of(&noun.name)
                .or_else(|| self.reading.models(&noun.name).map(|found| found.label).ok())
                .unwrap_or_else(|| noun.name.to_lowercase());
            let said = self.reading.said(noun.tokens.clone(), label);
            self.reading.wish.without.push(said);
            self.reading.take(noun.tokens.clone());
            return;
        }
        if noun.falls {
            return self.backwards(noun);
        }
        let is_group = || {
            let label = self.reading.models(&noun.name).map(|found| found.label).unwrap_or_default();
            label == "uxo" || concepts().number(&label).is_some_and(|number| concepts().is_group(number))
        };
        if text.is_mark(noun.tokens.end, ':') && noun.count.is_none() && noun.article == Article::None && is_group() {
            self.headings.push(noun.clone());
            return;
        }
        self.thing(noun);
    }

    fn backwards(&mut self, noun: &Noun) {
        let Some(count) = &noun.count else { return };
        let words = self.reading.text.words(noun.tokens.clone());
        let (low, high) = match count.value {
            Count::Exactly(count) => (count, count),
            Count::Between(low, high) => (low, high),
        };
        let what = format!("{words}: the range runs backwards, from {high} to {low}");
        let help = format!("did you mean {low} to {high} {}?", noun.name);
        self.reading.problems.push(Problem::of(self.reading.text.bytes(noun.tokens.clone()), what, help));
    }

    fn thing(&mut self, noun: &Noun) {
        self.reading.take(noun.tokens.clone());
        let said = self.reading.said(noun.named.clone(), self.reading.text.words(noun.named.clone()).to_owned());
        let found = match self.reading.models(&noun.name) {
            Ok(found) => found,
            Err(near) => {
                let unknown =
                    Unknown { called: said.value, words: Some(self.reading.text.bytes(noun.named.clone())), near };
                if !self.reading.wish.unknown.iter().any(|known| known.called == unknown.called) {
                    self.reading.wish.unknown.push(unknown);
                }
                self.relation = None;
                return;
            }
        };
        let narrowed: Vec<String> = found.narrowed_by.clone();
        let ignored = noun.ignored.iter().filter(|said| {
            let crate::draft::wish::Source::Words(words) = &said.source else { return true };
            let written =
                words.first().map(|range| self.reading.text.source[range.clone()].to_owned()).unwrap_or_default();
            !crate::catalog::words::words(&written).iter().any(|word| narrowed.contains(word))
        });
        let ignored: Vec<_> = ignored.cloned().collect();
        self.reading.wish.ignored.extend(ignored);
        let known = self
            .reading
            .wish
            .things
            .iter()
            .position(|thing| thing.label == found.label && thing.models == found.models);
        let place = match known {
            // The same again: `the anchor`, `anchor anchor`, `No, two anchors`.
            Some(known) if self.correcting || noun.count.is_none() => {
                if noun.count.is_some() {
                    self.reading.wish.things[known].count.clone_from(&noun.count);
                }
                known
            }
            _ => {
                let count = noun.count.clone().or_else(|| self.single(noun));
                self.reading.wish.things.push(Thing {
                    called: said,
                    label: found.label,
                    models: found.models,
                    count,
                    size_m: noun.size_m.clone(),
                    stands: Vec::new(),
                });
                self.reading.wish.things.len() - 1
            }
        };
        self.correcting = false;
        let own: Vec<(Range<usize>, StandWord)> = self.lead.iter().chain(&noun.stands).cloned().collect();
        for (tokens, word) in own {
            if let Some(stand) = word.stand() {
                let said = self.reading.said(tokens, stand);
                add(&mut self.reading.wish.things[place].stands, said);
            }
        }
        if let Some((relation, distance_m, words)) = self.relation.take() {
            let of = self.reading.wish.things[place].label.clone();
            let stand = match relation {
                Relation::Leaning => Stand::Leaning(Some(of)),
                Relation::On => Stand::On(of),
                Relation::Near(side) => Stand::Near { of, side, distance_m },
            };
            self.attach(words, stand);
            return;
        }
        if self.closed {
            self.group.clear();
            self.closed = false;
        }
        if !self.group.contains(&place) {
            self.group.push(place);
        }
        self.halves = 0;
    }

    /// Of mines, those on a line are moored mines, and of two halves those on the ground are bottom mines.
    fn mines(&mut self) {
        let on_line = |thing: &Thing| {
            thing.label == "mine"
                && thing.stands.iter().any(|said| matches!(said.value, Stand::Moored(_) | Stand::Floating(_)))
        };
        let both = self.reading.wish.things.iter().any(on_line);
        for place in 0..self.reading.wish.things.len() {
            let thing = &self.reading.wish.things[place];
            let name = match (thing.label.as_str(), on_line(thing)) {
                ("mine", true) => "moored mine",
                ("mine", false) if both => "bottom mine",
                _ => continue,
            };
            if let Ok(found) = self.reading.models(name) {
                self.reading.wish.things[place].models = found.models;
            }
        }
    }

    /// `the anchor` is one.
    fn single(&self, noun: &Noun) -> Option<crate::draft::wish::Said<Count>> {
        let last = noun.named.end.checked_sub(1)?;
        let is_one = noun.article == Article::Definite && !self.reading.is_plural(last);
        is_one.then(|| self.reading.said(noun.tokens.clone(), Count::Exactly(1)))
    }
}
