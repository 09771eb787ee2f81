//! How many of what was named before, and in which places: "10 each", "half of them", "between (0,0) and (10,10)".

use super::noun::noun_at;
use super::stand::{StandWord, stand_word};
use super::things::Walk;
use super::vocabulary::Word;
use crate::draft::wish::{Count, Stand};

impl Walk<'_, '_> {
    /// Places in numbers: `between (0,0) and (10,10)`, `at (3, 4)`.
    pub(super) fn place(&mut self) -> bool {
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

    /// `half of them moored, half lying`: two things of half each.
    pub(super) fn half(&mut self) -> bool {
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

    /// `and one standing upright`: more of the same.
    pub(super) fn more(&mut self) -> bool {
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
    pub(super) fn area(&mut self) -> bool {
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

    /// `10 each` behind a list.
    pub(super) fn each(&mut self) -> bool {
        let Some(number) = self.reading.number_at(self.at) else { return false };
        let (tokens, value) = (number.tokens.clone(), number.amount.ends()[1]);
        let bracket = self.reading.text.is_mark(self.at.wrapping_sub(1), '(');
        let first =
            self.at == 0 || self.reading.text.is_mark(self.at - 1, '.') || self.reading.text.is_mark(self.at - 1, ';');
        let of_them = matches!(self.reading.text.form(tokens.end), "of")
            && matches!(self.reading.text.form(tokens.end + 1), "them" | "these" | "each" | "it");
        let Some(words) = self.reading.word(tokens.end, Word::Each).or(of_them.then_some(2)) else { return false };
        // `Generate images of a mine. 150 of them.`
        if of_them && first && !bracket && self.reading.wish.images.is_none() && (1.0..=1e5).contains(&value) {
            self.reading.wish.images = Some(self.reading.said(tokens.clone(), value as u64));
            self.at = tokens.end + words;
            return true;
        }
        // `two tyres, one of them half buried`: a part of them.
        let last = self.group.last().copied().filter(|_| of_them && !bracket);
        let all = last.and_then(|last| self.reading.wish.things[last].count.as_ref()).map(|said| said.value);
        if let (Some(last), Some(Count::Exactly(all))) = (last, all)
            && f64::from(all) > value
            && value >= 1.0
        {
            let part = value as u32;
            let mut other = self.reading.wish.things[last].clone();
            other.count = Some(self.reading.said(tokens.clone(), Count::Exactly(part)));
            if let Some(said) = &mut self.reading.wish.things[last].count {
                said.value = Count::Exactly(all - part);
            }
            self.reading.wish.things.push(other);
            self.group = vec![self.reading.wish.things.len() - 1];
            self.at = tokens.end + words;
            self.closed = true;
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
}
