//! What is told of the things that were named before: "half buried", "2 m apart", "leaning against a rock".

use std::ops::Range;

use super::cue::floats;
use super::measures::StandCue;
use super::noun::{Article, noun_at};
use super::stand::{Relation, StandWord, add};
use super::things::{Walk, is_part};
use super::vocabulary::{Cue, Word, vocabulary};
use crate::draft::wish::{Amount, Side, Stand};

impl Walk<'_, '_> {
    /// A word for how things are; false if it is something else here.
    pub(super) fn stand(&mut self, tokens: usize, word: StandWord) -> bool {
        let words = self.at..self.at + tokens;
        let longer_thing = self.reading.thing_at(self.at).is_some_and(|count| count > tokens);
        let single_thing = self.reading.thing_at(self.at) == Some(tokens)
            && matches!(word, StandWord::Heap | StandWord::Row | StandWord::Relation(_) | StandWord::Floating);
        if longer_thing || (single_thing && self.group.is_empty()) {
            return false;
        }
        // An adjective of the thing that follows: `dumped bicycles`, `a heap of tires`.
        let before_noun = !matches!(word, StandWord::Relation(_) | StandWord::Resting | StandWord::Middle)
            && noun_at(self.reading, &self.stands, self.at).is_some_and(|noun| !noun.stands.is_empty());
        if before_noun {
            return false;
        }
        self.at = words.end;
        if let StandWord::Relation(relation) = word {
            if !self.group.is_empty() {
                self.relate(relation, None, words);
            }
            return true;
        }
        let Some(mut stand) = word.stand() else { return true };
        // `halb im Schlamm vergraben`: the share stands apart from the word.
        if let Stand::Buried(amount) = &mut stand {
            let share = self.reading.quantities.iter().find(|quantity| {
                quantity.measure == super::quantity::Measure::Share
                    && quantity.tokens.end <= words.start
                    && quantity.tokens.end + 5 > words.start
                    // `half of the tires`: of them, not of each.
                    && !matches!(self.reading.text.form(quantity.tokens.end), "of" | "the" | "der" | "de" | "des")
                    && quantity.tokens.clone().all(|at| self.reading.is_free(at))
            });
            if let Some(share) = share.cloned() {
                *amount = share.amount;
                self.reading.take(share.tokens);
            }
        }
        if self.group.is_empty() || self.is_order(words.start) {
            self.group.clear();
            self.lead.push((words, word));
        } else {
            self.attach(words, stand);
        }
        true
    }

    /// `Scatter twenty rocks`, `then throw a tire`: an order, of what follows.
    fn is_order(&self, at: usize) -> bool {
        let before = self.reading.text.form(at.wrapping_sub(1));
        let first = at == 0 || matches!(before, "then" | "and" | "." | ";" | "please" | ",");
        first
            && matches!(
                self.reading.text.form(at),
                "scatter" | "throw" | "drop" | "spread" | "sprinkle" | "verteile" | "streue" | "distribute"
            )
    }

    /// Says what the group is to what follows.
    pub(super) fn relate(&mut self, relation: Relation, distance: Option<Amount>, words: Range<usize>) {
        let text = &self.reading.text;
        let mut next = self.at;
        while next < self.at + 3
            && (matches!(
                text.form(next),
                "the"
                    | "a"
                    | "an"
                    | "its"
                    | "of"
                    | "dem"
                    | "der"
                    | "den"
                    | "einem"
                    | "einer"
                    | "del"
                    | "la"
                    | "el"
                    | "le"
                    | "du"
                    | "l"
                    | "un"
                    | "une"
                    | "de"
                    | "einen"
            ))
        {
            next += 1;
        }
        let vehicle =
            self.reading.word(next, Word::Vehicle).filter(|_| !matches!(text.form(next.wrapping_sub(1)), "a" | "an"));
        let structure = self.reading.environment_at.as_ref().is_some_and(|place| {
            (next..next + 5).contains(&place.start) && (place.start <= next + 1 || is_part(text.form(next)))
        }) || vocabulary().environments.at(text, next).is_some();
        let side = match relation {
            Relation::Near(side) => side,
            Relation::Leaning | Relation::On => None,
        };
        if let (Some(tokens), Some(side)) = (vehicle, side) {
            let whole = words.start..next + tokens;
            self.at = whole.end;
            return self.attach(whole, Stand::FromVehicle { side, distance_m: distance });
        }
        if structure {
            if relation == Relation::Leaning {
                self.attach(words, Stand::Leaning(None));
            }
            return;
        }
        let follows =
            noun_at(self.reading, &self.stands, self.at).or_else(|| noun_at(self.reading, &self.stands, next));
        if self.group.is_empty() {
            // `3 m in front of an anchor`: of who looks.
            if let Some(distance) = distance {
                let said = self.reading.said(words, distance);
                self.reading.wish.path.range_m.get_or_insert(said);
            }
            return;
        }
        match (follows, side) {
            (Some(_), _) => self.relation = Some((relation, distance, words)),
            (None, Some(side)) => self.attach(words, Stand::FromVehicle { side, distance_m: distance }),
            (None, None) if relation == Relation::Leaning => self.attach(words, Stand::Leaning(None)),
            (None, None) => {}
        }
    }

    /// An amount that tells where or how large things are.
    pub(super) fn cue(&mut self, cue: &StandCue) {
        let (tokens, amount) = (cue.tokens.clone(), cue.amount.clone());
        let side = match cue.cue {
            Cue::Front => Some(Side::Front),
            Cue::Behind => Some(Side::Behind),
            Cue::Left => Some(Side::Left),
            Cue::Right => Some(Side::Right),
            _ => None,
        };
        if let Some(side) = side {
            return self.relate(Relation::Near(Some(side)), Some(amount), tokens);
        }
        match cue.cue {
            Cue::Altitude => self.attach(tokens, Stand::Floating(Some(amount))),
            Cue::BelowSurface => self.attach(tokens, Stand::BelowSurface(amount)),
            Cue::Apart => self.attach(tokens, Stand::Apart(amount)),
            Cue::Radius => self.attach(tokens, Stand::Around(amount)),
            Cue::Burial if self.group.is_empty() => {
                let [low, high] = amount.ends();
                self.lead.push((tokens, StandWord::Buried(low, high)));
            }
            Cue::Burial => self.attach(tokens, Stand::Buried(amount)),
            Cue::Size => {
                if let Some(&last) = self.group.last() {
                    let said = self.reading.said(tokens, amount);
                    self.reading.wish.things[last].size_m.get_or_insert(said);
                }
            }
            // `5 m from a gate valve`: of the vehicle, unless a thing stands before it.
            _ if self.group.is_empty() || self.closed => {
                let said = self.reading.said(tokens, amount);
                self.reading.wish.path.range_m.get_or_insert(said);
            }
            _ => self.relate(Relation::Near(None), Some(amount), tokens),
        }
    }

    /// Tells something of the group.
    pub(super) fn attach(&mut self, words: Range<usize>, stand: Stand) {
        let afloat = matches!(stand, Stand::Floating(_) | Stand::Moored(_) | Stand::School | Stand::BelowSurface(_));
        let mut told = self.group.clone();
        if afloat && told.len() > 1 {
            let swims = |place: &usize| self.swims(*place);
            let swimming: Vec<usize> = told.iter().copied().filter(swims).collect();
            told = if swimming.is_empty() { told[told.len() - 1..].to_vec() } else { swimming };
        }
        let said = self.reading.said(words.clone(), stand);
        for place in told {
            add(&mut self.reading.wish.things[place].stands, said.clone());
        }
        self.closed = true;
        self.reading.take(words);
    }

    fn swims(&self, place: usize) -> bool {
        let called = self.reading.wish.things[place].called.clone();
        let crate::draft::wish::Source::Words(words) = called.source else { return false };
        let tokens = (0..self.reading.len())
            .filter(|&at| words.iter().any(|range| range.contains(&self.reading.text.tokens[at].bytes.start)));
        let (first, last) = tokens.fold((usize::MAX, 0), |(first, last), at| (at.min(first), at.max(last)));
        first <= last && floats(self.reading, first..last + 1)
    }

    /// `an anchor on a crate`: a thing on a thing.
    pub(super) fn preposition(&mut self) {
        let form = self.reading.text.form(self.at);
        if matches!(form, "on" | "onto" | "atop" | "upon" | "sobre" | "sur" | "auf")
            && !self.group.is_empty()
            && self.reading.is_free(self.at)
        {
            let follows = noun_at(self.reading, &self.stands, self.at + 1)
                .filter(|noun| noun.is_known && noun.article != Article::None);
            let bottom = matches!(follows.as_ref().map(|noun| noun.name.as_str()), Some("rock" | "stone"));
            if follows.is_some() && !bottom {
                self.relation = Some((Relation::On, None, self.at..self.at + 1));
            }
        }
        if matches!(form, "then" | "also" | "dann" | "luego" | "puis" | "put" | "place" | "set" | "lay") {
            self.closed = true;
            self.lead.clear();
        }
    }
}
