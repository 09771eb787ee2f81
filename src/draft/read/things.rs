//! The things of a prompt, how many and how they stand, from its first word to its last.

use std::ops::Range;

use super::cue::floats;
use super::measures::StandCue;
use super::noun::{Article, Noun, noun_at};
use super::reading::Reading;
use super::stand::{Relation, StandWord, add, stand_word};
use super::vocabulary::{Cue, Word, vocabulary};
use crate::catalog::concepts::concepts;
use crate::draft::Problem;
use crate::draft::wish::{Amount, Count, Side, Stand, Thing, Unknown};

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
fn is_part(form: &str) -> bool {
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

struct Walk<'r, 'a> {
    reading: &'r mut Reading<'a>,
    stands: Vec<StandCue>,
    at: usize,
    /// Numbers of the things that the next words tell of.
    group: Vec<usize>,
    /// Whether something was told of the group, so that another thing begins another group.
    closed: bool,
    /// Whether things must not be there.
    negating: bool,
    /// Whether the next thing is said instead of another: "No, two anchors".
    correcting: bool,
    /// What the next thing is to the group, with the distance.
    relation: Option<(Relation, Option<Amount>, Range<usize>)>,
    /// What is told of every thing that follows in the sentence: "scatter".
    lead: Vec<(Range<usize>, StandWord)>,
    /// How many halves of a thing were told of.
    halves: u32,
    /// Groups before a colon: "clutter: shells and bombs".
    headings: Vec<Noun>,
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

    /// Places in numbers: `between (0,0) and (10,10)`, `at (3, 4)`.
    fn place(&mut self) -> bool {
        let Some(found) = self.reading.places.iter().position(|place| place.tokens.start == self.at) else {
            return false;
        };
        let place = self.reading.places.remove(found);
        let mut tokens = place.tokens.clone();
        self.at = tokens.end;
        let Some(corner) = place.flat() else { return true };
        let between = (place.tokens.start.saturating_sub(2)..place.tokens.start).any(|at| {
            matches!(
                self.reading.text.form(at),
                "between" | "from" | "zwischen" | "von" | "entre" | "de" | "within" | "over" | "area"
            )
        });
        let other = self.reading.places.iter().position(|other| {
            other.tokens.start <= tokens.end + 2 && other.tokens.start >= tokens.end && other.flat().is_some()
        });
        let stand = match other.filter(|_| between) {
            Some(other) => {
                let other = self.reading.places.remove(other);
                tokens.end = other.tokens.end;
                self.at = tokens.end;
                Stand::Within(corner, other.flat().unwrap_or(corner))
            }
            None => Stand::At(corner, place.at[2]),
        };
        self.attach(tokens, stand);
        true
    }

    /// `and one standing upright`: more of the same.
    fn more(&mut self) -> bool {
        let Some(number) = self.reading.number_at(self.at) else { return false };
        let (tokens, value) = (number.tokens.clone(), number.amount.ends()[1]);
        let Some(&last) = self.group.last().filter(|_| (1.0..1e5).contains(&value)) else { return false };
        let told = stand_word(self.reading, tokens.end)
            .is_some_and(|(_, word)| !matches!(word, StandWord::Heap | StandWord::Row));
        let known = noun_at(self.reading, &self.stands, self.at).is_some();
        if !told || known || value.fract() != 0.0 || !self.closed {
            return false;
        }
        let mut other = self.reading.wish.things[last].clone();
        other.stands.clear();
        other.count = Some(self.reading.said(tokens.clone(), Count::Exactly(value as u32)));
        self.reading.wish.things.push(other);
        self.group = vec![self.reading.wish.things.len() - 1];
        self.closed = false;
        self.at = tokens.end;
        true
    }

    /// `over a 10 by 10 m area`: about the middle.
    fn area(&mut self) -> bool {
        let Some(found) = self.reading.sides.iter().position(|(_, tokens)| tokens.start == self.at) else {
            return false;
        };
        let (sides, tokens) = self.reading.sides.remove(found);
        self.at = tokens.end;
        if let [x, y, ..] = sides.as_slice()
            && !self.group.is_empty()
            && tokens.clone().all(|at| self.reading.is_free(at))
        {
            self.attach(tokens, Stand::Within([-x / 2.0, -y / 2.0], [x / 2.0, y / 2.0]));
        }
        true
    }

    /// `half of them moored, half lying`: two things of half each.
    fn half(&mut self) -> bool {
        let Some(tokens) = self.reading.word(self.at, Word::HalfOf).filter(|_| self.reading.is_free(self.at)) else {
            return false;
        };
        let bare = tokens == 1 && self.halves == 0;
        let Some(&last) = self.group.last().filter(|_| !bare && stand_word(self.reading, self.at).is_none()) else {
            return false;
        };
        if self.reading.thing_at(self.at + tokens).is_some() && tokens == 1 {
            return false;
        }
        let words = self.at..self.at + tokens;
        self.halves += 1;
        let share = |count: Count| match count {
            Count::Exactly(count) => Count::Exactly((count / 2).max(1)),
            Count::Between(low, high) => Count::Between((low / 2).max(1), (high / 2).max(1)),
        };
        if self.halves == 1 {
            if let Some(said) = &mut self.reading.wish.things[last].count {
                said.value = share(said.value);
            }
            self.group = vec![last];
        } else {
            let mut other = self.reading.wish.things[last].clone();
            other.stands.clear();
            self.reading.wish.things.push(other);
            self.group = vec![self.reading.wish.things.len() - 1];
        }
        self.reading.take(words.clone());
        self.at = words.end;
        self.closed = true;
        true
    }

    /// `10 each` behind a list.
    fn each(&mut self) -> bool {
        let Some(number) = self.reading.number_at(self.at) else { return false };
        let (tokens, value) = (number.tokens.clone(), number.amount.ends()[1]);
        let bracket = self.reading.text.is_mark(self.at.wrapping_sub(1), '(');
        let first =
            self.at == 0 || self.reading.text.is_mark(self.at - 1, '.') || self.reading.text.is_mark(self.at - 1, ';');
        let of_them = matches!(self.reading.text.form(tokens.end), "of")
            && matches!(self.reading.text.form(tokens.end + 1), "them" | "these" | "each" | "it");
        let Some(words) = self.reading.word(tokens.end, Word::Each).or(of_them.then_some(2)) else { return false };
        // `Generate images of a mine. 150 of them.`
        if of_them && first && !bracket && self.reading.wish.images.is_none() && value >= 1.0 && value <= 1e5 {
            self.reading.wish.images = Some(self.reading.said(tokens.clone(), value as u64));
            self.at = tokens.end + words;
            return true;
        }
        if self.group.is_empty() || value.fract() != 0.0 || !(1.0..1e5).contains(&value) {
            return false;
        }
        let group = if of_them { vec![self.group[self.group.len() - 1]] } else { self.group.clone() };
        for place in group {
            let said = self.reading.said(tokens.clone(), Count::Exactly(value as u32));
            self.reading.wish.things[place].count = Some(said);
        }
        self.at = tokens.end + words;
        true
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

    /// A word for how things are; false if it is something else here.
    fn stand(&mut self, tokens: usize, word: StandWord) -> bool {
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
    fn relate(&mut self, relation: Relation, distance: Option<Amount>, words: Range<usize>) {
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
    fn cue(&mut self, cue: &StandCue) {
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
    fn attach(&mut self, words: Range<usize>, stand: Stand) {
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
    fn preposition(&mut self) {
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
        if self.reading.environment_at.is_some() && is_part(&noun.name) {
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
