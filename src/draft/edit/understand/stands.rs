//! How and where objects stand: "3 m in front of the robot", "half buried", "between (0,0) and (10,10)".

use super::Reader;
use super::words::{Manner, Relation, Topic, lexicon};
use crate::draft::Problem;
use crate::draft::read::place::place_at;
use crate::draft::read::quantity::{Measure, Quantity};
use crate::draft::wish::{Amount, Side, Stand};

/// Share of the height that is sunk where nobody says how much.
const SOME_BURIAL: f64 = 0.3;

impl Reader<'_> {
    /// What is said of a thing behind it, and the token behind that.
    pub(super) fn stands(&self, from: usize) -> Result<(Vec<Stand>, usize), Problem> {
        let mut stands: Vec<Stand> = Vec::new();
        let mut end = from;
        loop {
            let Some((stand, next)) = self.stand_at(end)? else { return Ok((stands, end)) };
            // `swimming 3 m above the bottom` is one thing said twice.
            if matches!(stand, Stand::Floating(Some(_))) {
                let moored = stands.iter().any(|known| matches!(known, Stand::Moored(_)));
                stands.retain(|known| !matches!(known, Stand::Floating(_) | Stand::Moored(_)));
                match stand {
                    Stand::Floating(height) if moored => stands.push(Stand::Moored(height)),
                    stand => stands.push(stand),
                }
            } else {
                stands.push(stand);
            }
            end = next;
        }
    }

    /// One thing that is said at a token, behind words that say nothing.
    fn stand_at(&self, from: usize) -> Result<Option<(Stand, usize)>, Problem> {
        let mut at = from;
        for _ in 0..6 {
            if let Some(found) = self.stand_here(at)? {
                return Ok(Some(found));
            }
            let is_and = matches!(self.text.form(at), "and" | "und" | "y" | "et" | "和");
            let comma = self.text.is_mark(at, ',');
            let filler = self.phrase(&lexicon().fillers, at);
            let number = self.quantity(at).is_some();
            match filler {
                // What comes next may be another thing.
                Some(_) if (is_and || number) && self.stand_here(at + 1)?.is_none() => return Ok(None),
                Some((tokens, ())) => at += tokens,
                None if comma => at += 1,
                None => return Ok(None),
            }
        }
        Ok(None)
    }

    fn stand_here(&self, at: usize) -> Result<Option<(Stand, usize)>, Problem> {
        if let Some(found) = self.quantity(at)
            && let Some(stand) = self.at_distance(&found)?
        {
            return Ok(Some(stand));
        }
        if let Some(found) = self.rectangle(at) {
            return Ok(Some(found));
        }
        if let Some(place) = place_at(&self.text, at)
            && let Some(flat) = place.flat()
        {
            return Ok(Some((Stand::At(flat, place.at[2]), place.tokens.end)));
        }
        if let Some((tokens, manner)) = self.phrase(&lexicon().stands, at) {
            return Ok(Some(self.manner(manner, at + tokens)));
        }
        match self.relation_at(at) {
            Some((tokens, relation)) => self.related(relation, None, at + tokens),
            None => Ok(None),
        }
    }

    /// `between (0,0) and (10,10)`, `from (0,0) to (10,10)`.
    fn rectangle(&self, at: usize) -> Option<(Stand, usize)> {
        let is_between =
            |at: usize| matches!(self.text.form(at), "between" | "zwischen" | "entre" | "from" | "von" | "in" | "在");
        let begin = if is_between(at) { at + 1 } else { at };
        let first = place_at(&self.text, begin)?;
        let link = first.tokens.end;
        let linked =
            matches!(self.text.form(link), "and" | "to" | "und" | "bis" | "y" | "et" | "a" | "-" | "和" | "到" | "x");
        let second = place_at(&self.text, link + usize::from(linked)).filter(|_| linked && begin > at)?;
        Some((Stand::Within(first.flat()?, second.flat()?), second.tokens.end))
    }

    /// An amount and what it is the amount of: `3 m in front of`, `30 % buried`, `2 m apart`.
    fn at_distance(&self, found: &Quantity) -> Result<Option<(Stand, usize)>, Problem> {
        let end = found.tokens.end;
        let amount = || found.amount.clone();
        if found.measure == Measure::Share {
            let buried = self.phrase(&lexicon().stands, end).filter(|(_, manner)| *manner == Manner::Buried);
            return Ok(buried.map(|(tokens, _)| (Stand::Buried(amount()), end + tokens)));
        }
        if found.measure != Measure::Length {
            return Ok(None);
        }
        // `2 m to the left of`: the relation may begin behind `away`.
        for at in [end, end + 1] {
            match self.relation_at(at) {
                Some((tokens, Relation::AboveBottom)) => {
                    return Ok(Some((Stand::Floating(Some(amount())), at + tokens)));
                }
                Some((tokens, Relation::BelowSurface)) => {
                    return Ok(Some((Stand::BelowSurface(amount()), at + tokens)));
                }
                Some((tokens, Relation::Apart)) => return Ok(Some((Stand::Apart(amount()), at + tokens))),
                Some((tokens, relation)) if at == end || relation != Relation::On => {
                    if let Some(found) = self.related(relation, Some(amount()), at + tokens)? {
                        return Ok(Some(found));
                    }
                }
                _ => {}
            }
        }
        Ok(None)
    }

    fn manner(&self, manner: Manner, end: usize) -> (Stand, usize) {
        let half = |at: usize| {
            self.phrase(&lexicon().stands, at).filter(|(_, manner)| matches!(manner, Manner::Half | Manner::Buried))
        };
        match manner {
            Manner::Floating => (Stand::Floating(None), end),
            Manner::Moored => (Stand::Moored(None), end),
            Manner::Buried => {
                let behind = self.skip(end);
                match (half(behind), self.quantity(behind).filter(|found| found.measure == Measure::Share)) {
                    (_, Some(found)) => (Stand::Buried(found.amount), found.tokens.end),
                    (Some((tokens, Manner::Half)), None) => (Stand::Buried(Amount::Exactly(0.5)), behind + tokens),
                    _ => (Stand::Buried(Amount::Exactly(SOME_BURIAL)), end),
                }
            }
            Manner::Half => (Stand::Buried(Amount::Exactly(0.5)), half(end).map_or(end, |(tokens, _)| end + tokens)),
            Manner::Side => (Stand::OnSide, end),
            Manner::Upright => (Stand::Upright, end),
            Manner::Heap => (Stand::Heap, end),
            Manner::Row => (Stand::Row(None), end),
            Manner::Settled => (Stand::Settled, end),
            Manner::School => (Stand::School, end),
            Manner::Scattered => (Stand::Resting, end),
        }
    }

    /// A relation to what stands behind it.
    fn related(
        &self,
        relation: Relation,
        distance_m: Option<Amount>,
        at: usize,
    ) -> Result<Option<(Stand, usize)>, Problem> {
        let at = self.skip_articles(at);
        let side = match relation {
            Relation::Left => Some(Side::Left),
            Relation::Right => Some(Side::Right),
            Relation::Front => Some(Side::Front),
            Relation::Behind => Some(Side::Behind),
            _ => None,
        };
        if let (Some(side), Some((tokens, Topic::Vehicle | Topic::Sonar))) = (side, self.phrase(&lexicon().topics, at))
        {
            return Ok(Some((Stand::FromVehicle { side, distance_m }, at + tokens)));
        }
        if relation == Relation::Within {
            let found = self.quantity(at).filter(|found| found.measure == Measure::Length);
            return Ok(found.map(|found| (Stand::Around(found.amount.clone()), found.tokens.end)));
        }
        if matches!(relation, Relation::AboveBottom | Relation::BelowSurface | Relation::Apart) {
            return Ok(None);
        }
        let Some((label, end)) = self.label_at(at) else { return Ok(None) };
        Ok(match relation {
            Relation::On => Some((Stand::On(label), end)),
            Relation::Against => Some((Stand::Leaning(Some(label)), end)),
            Relation::Off if distance_m.is_none() => None,
            _ => Some((Stand::Near { of: label, side, distance_m }, end)),
        })
    }

    fn skip_articles(&self, mut at: usize) -> usize {
        let is_article = |form: &str| {
            matches!(
                form,
                "the"
                    | "a"
                    | "an"
                    | "of"
                    | "der"
                    | "die"
                    | "das"
                    | "dem"
                    | "den"
                    | "einem"
                    | "einer"
                    | "el"
                    | "la"
                    | "los"
                    | "las"
                    | "le"
                    | "les"
                    | "l"
                    | "un"
                    | "une"
                    | "una"
                    | "du"
                    | "its"
            )
        };
        while is_article(self.text.form(at)) {
            at += 1;
        }
        at
    }

    /// The label that poses may refer to of what is named at a token: an object's, or that of a part of a structure.
    fn label_at(&self, at: usize) -> Option<(String, usize)> {
        if let Some(thing) = self.thing_at(at) {
            let there = crate::draft::edit::change::label_of(self.subject, self.known, &thing.which);
            let label = there.or_else(|| thing.named.as_ref().ok().map(|named| named.label.clone()));
            return Some((label.unwrap_or(thing.which.called), thing.end));
        }
        let (tokens, kind) = self.phrase(&lexicon().structures, at)?;
        self.subject.said("environment").map(|_| (kind, at + tokens))
    }
}
