//! Objects: "add two barrels to the left of the wreck", "remove the anchors", "three tires instead of two", "twice as many rocks".

use std::collections::BTreeSet;

use super::counts::{Counted, count_is_said};
use super::words::{Relation, Verb, lexicon};
use super::{Reader, Step};
use crate::catalog::words::words;
use crate::draft::Problem;
use crate::draft::edit::change::{Addition, Change, Named, NumberOf, Which};
use crate::draft::edit::numbers::Move;
use crate::draft::find;
use crate::draft::read::number::number_at;
use crate::draft::read::token::Kind;
use crate::draft::wish::{Amount, Count, Stand};

/// Longest name of a thing, tokens.
const LONGEST: usize = 5;
/// Factor of "more" and "fewer".
const SOME: f64 = 1.5;

/// A thing that is named at a token.
pub(super) struct Thing {
    /// Behind its last token.
    pub end: usize,
    pub named: Result<Named, Vec<String>>,
    pub which: Which,
}

impl Reader<'_> {
    /// A thing with what is to be done with it.
    pub(super) fn objects(&mut self) -> Step {
        let begin = self.at;
        let counted = self.counted();
        let Some(thing) = self.thing_at(counted.end) else { return self.unknown(&counted) };
        let instead = self.phrase(&lexicon().instead, thing.end).map(|(tokens, ())| thing.end + tokens);
        if let Some(behind) = instead {
            return self.instead(begin, &counted, &thing, behind);
        }
        match (self.verb, counted.count) {
            (Some(Verb::Remove), _) => {
                self.change(begin..thing.end, Change::Remove(thing.which));
                Ok(Some(thing.end))
            }
            (Some(Verb::Replace), _) => self.replaced(begin, thing),
            (Some(Verb::Double), None) => Ok(Some(self.number(begin, thing, NumberOf::Moved(Move::Times(2.0))))),
            (Some(Verb::Halve), None) => Ok(Some(self.number(begin, thing, NumberOf::Moved(Move::Times(0.5))))),
            (Some(Verb::More), None) => Ok(Some(self.number(begin, thing, NumberOf::Moved(Move::Times(SOME))))),
            (Some(Verb::Fewer), None) => Ok(Some(self.number(begin, thing, NumberOf::Moved(Move::Times(1.0 / SOME))))),
            (Some(Verb::Fewer), Some(Count::Exactly(fewer))) => {
                Ok(Some(self.number(begin, thing, NumberOf::Moved(Move::By(-f64::from(fewer))))))
            }
            (Some(Verb::Add), _) => self.added(begin, &counted, thing),
            (None | Some(Verb::More), Some(count)) if self.is_there(&thing.which) && !counted.is_more => {
                Ok(Some(self.number(begin, thing, NumberOf::Count(count))))
            }
            (Some(Verb::Put | Verb::Move | Verb::Bury) | None, _)
                if self.is_there(&thing.which) && !counted.is_more =>
            {
                self.stood(begin, &counted, thing)
            }
            (Some(Verb::Bury | Verb::Move), _) => {
                // What is not there is asked back by the change itself.
                self.stood(begin, &counted, thing)
            }
            (Some(Verb::Put), _) if counted.is_definite => self.stood(begin, &counted, thing),
            _ if counted.count.is_some() || counted.is_more || self.verb == Some(Verb::Put) => {
                self.added(begin, &counted, thing)
            }
            _ => Ok(None),
        }
    }

    fn number(&mut self, begin: usize, thing: Thing, number: NumberOf) -> usize {
        self.change(begin..thing.end, Change::Number(thing.which, number));
        thing.end
    }

    /// Objects that come.
    fn added(&mut self, begin: usize, counted: &Counted, thing: Thing) -> Step {
        let named = thing.named.map_err(|near| self.no_such(counted.end..thing.end, &near))?;
        let (mut stands, end) = self.stands(thing.end)?;
        stands.extend(counted.manner.clone());
        let count = counted.count.unwrap_or(Count::Exactly(1));
        let addition = Addition { thing: named, count, stands, is_more: counted.is_more };
        self.change(begin..end, Change::Add(addition));
        self.verb = Some(Verb::Add);
        Ok(Some(end))
    }

    /// `replace the barrels by two crates`.
    fn replaced(&mut self, begin: usize, thing: Thing) -> Step {
        let Some((tokens, ())) = self.phrase(&lexicon().by, thing.end) else {
            let help = "say what comes: “replace the barrels by crates”";
            return Err(self.problem(
                begin..thing.end,
                format!("nothing comes in the stead of {}", thing.which.called),
                help,
            ));
        };
        let counted = self.counted_from(thing.end + tokens);
        let Some(new) = self.thing_at(counted.end) else {
            let end = (counted.end + 1).min(self.text.tokens.len());
            return Err(self.no_such(counted.end..end, &[]));
        };
        let end = new.end;
        let named = new.named.map_err(|near| self.no_such(counted.end..end, &near))?;
        self.change(begin..end, Change::Swap(thing.which, named));
        if let Some(count) =
            counted.count.filter(|_| !counted.is_definite && count_is_said(&self.text, thing.end + tokens))
        {
            self.change(begin..end, Change::Number(new.which, NumberOf::Count(count)));
        }
        self.verb = None;
        Ok(Some(end))
    }

    /// `three tires instead of two`, `crates instead of barrels`.
    fn instead(&mut self, begin: usize, counted: &Counted, thing: &Thing, behind: usize) -> Step {
        let old = self.counted_from(behind);
        if let Some(old_thing) = self.thing_at(old.end) {
            let named = thing.named.clone().map_err(|near| self.no_such(counted.end..thing.end, &near))?;
            self.change(begin..old_thing.end, Change::Swap(old_thing.which, named));
            if let Some(count) = counted.count {
                self.change(begin..old_thing.end, Change::Number(thing.which.clone(), NumberOf::Count(count)));
            }
            return Ok(Some(old_thing.end));
        }
        let end = number_at(&self.text, behind).map_or(behind, |number| behind + number.tokens);
        let Some(count) = counted.count else { return Ok(None) };
        self.change(begin..end, Change::Number(thing.which.clone(), NumberOf::Count(count)));
        Ok(Some(end))
    }

    /// Objects that are there stand otherwise.
    fn stood(&mut self, begin: usize, counted: &Counted, thing: Thing) -> Step {
        let (mut stands, end) = self.stands(thing.end)?;
        if self.verb == Some(Verb::Bury) && !stands.iter().any(|stand| matches!(stand, Stand::Buried(_))) {
            stands.push(Stand::Buried(Amount::Exactly(0.5)));
        }
        if stands.is_empty() {
            return if self.verb == Some(Verb::Put) && !counted.is_definite {
                self.added(begin, counted, thing)
            } else {
                Ok(None)
            };
        }
        if self.verb == Some(Verb::Put) && !counted.is_definite {
            return self.added(begin, counted, thing);
        }
        self.change(begin..end, Change::Stand(thing.which, stands));
        Ok(Some(end))
    }

    /// What is to come or go and is no thing that is known.
    fn unknown(&self, counted: &Counted) -> Step {
        let wanted = matches!(self.verb, Some(Verb::Add | Verb::Remove | Verb::Replace | Verb::Put | Verb::Bury));
        let counts = counted.count.is_some() || counted.is_definite;
        let is_word = self.text.tokens.get(counted.end).is_some_and(|token| token.kind == Kind::Word);
        let free = self.is_free(counted.end);
        if !(wanted && is_word && free && (counts || counted.end == self.at)) {
            return Ok(None);
        }
        let end = self.end_of_noun(counted.end);
        let near = find::models(self.text.words(counted.end..end), self.known).err().unwrap_or_default();
        Err(self.no_such(counted.end..end, &near))
    }

    fn end_of_noun(&self, from: usize) -> usize {
        let mut end = from + 1;
        while end < from + 3
            && self.text.tokens.get(end).is_some_and(|token| token.kind == Kind::Word)
            && self.is_free(end)
        {
            end += 1;
        }
        end
    }

    /// Whether no phrase of this reader begins at a token.
    fn is_free(&self, at: usize) -> bool {
        let table = lexicon();
        let any = self.phrase(&table.verbs, at).is_some()
            || self.phrase(&table.params, at).is_some()
            || self.phrase(&table.degrees, at).is_some()
            || self.phrase(&table.topics, at).is_some()
            || self.phrase(&table.routes, at).is_some()
            || self.phrase(&table.turns, at).is_some();
        let words = [&table.turbidity, &table.sediments, &table.shapes, &table.structures];
        let little = [&table.fillers, &table.by, &table.instead, &table.images, &table.to, &table.difference];
        !(any
            || words.into_iter().any(|words| self.phrase(words, at).is_some())
            || little.into_iter().any(|words| self.phrase(words, at).is_some())
            || self.phrase(&table.relations, at).is_some()
            || self.phrase(&table.stands, at).is_some())
    }

    fn no_such(&self, tokens: std::ops::Range<usize>, near: &[String]) -> Problem {
        let called = self.text.words(tokens.clone());
        let help = if near.is_empty() {
            "name a thing that a catalog has; `ensonify catalog search WORDS` tells".to_owned()
        } else {
            format!("catalogs have {}", near.join(", "))
        };
        self.problem(tokens, format!("no catalog has “{called}”"), help)
    }

    fn is_there(&self, which: &Which) -> bool {
        crate::draft::edit::change::has(self.subject, self.known, which)
    }

    /// The thing that is named at a token, with its adjectives.
    pub(super) fn thing_at(&self, at: usize) -> Option<Thing> {
        let is_word = |at: usize| self.text.tokens.get(at).is_some_and(|token| token.kind == Kind::Word);
        let mut best: Option<Thing> = None;
        // What this table has is no name of a thing, nor its first word: `put a rock`.
        if !self.is_free(at) && !self.is_label(self.text.form(at)) {
            return None;
        }
        for end in at + 1..=at + LONGEST {
            if !is_word(end - 1) || (end - at > 1 && best.is_some() && !self.is_free(end - 1)) {
                break;
            }
            let thing = self.named(at, end);
            let better = match (&best, &thing) {
                (_, None) => false,
                (None, Some(_)) => true,
                (Some(old), Some(new)) => {
                    new.which.uids != old.which.uids || new.which.labels.is_disjoint(&old.which.labels)
                }
            };
            if better {
                best = thing;
            }
        }
        best
    }

    /// Whether an item of the recipe is labelled so.
    fn is_label(&self, form: &str) -> bool {
        let items = self.subject.said("objects").map_or(&[][..], |(node, _)| node.items());
        let labels = items.iter().filter_map(|item| item.get("label")?.text());
        labels.into_iter().any(|label| words(label).join(" ") == form)
    }

    fn named(&self, at: usize, end: usize) -> Option<Thing> {
        let called = self.text.words(at..end);
        let forms: Vec<String> = (at..end).map(|at| self.text.form(at).to_owned()).collect();
        let said = forms.join(" ");
        let found = find::models(&forms.join(" "), self.known);
        let (mut labels, mut uids) = (BTreeSet::from([said.clone()]), BTreeSet::new());
        let labelled = self.is_label(&said);
        match &found {
            Ok(found) => {
                uids.extend(found.models.uids.iter().cloned());
                // With adjectives only these models are meant.
                if found.narrowed_by.is_empty() {
                    labels.insert(found.label.clone());
                    labels.extend(found.models.label.clone());
                }
            }
            Err(_) if labelled || (find::is_known_thing(&said) && self.known_head(at, end)) => {}
            Err(_) => return None,
        }
        let named = found.map(|found| Named { called: called.to_owned(), label: found.label, models: found.models });
        Some(Thing { end, named, which: Which { called: called.to_owned(), labels, uids } })
    }

    /// Whether the last word of a name is the thing: not `diver swimming`.
    fn known_head(&self, at: usize, end: usize) -> bool {
        end == at + 1 || !find::is_known_thing(self.text.words(at..end - 1))
    }

    /// A side's word and what it is of.
    pub(super) fn relation_at(&self, at: usize) -> Option<(usize, Relation)> {
        self.phrase(&lexicon().relations, at)
    }
}
