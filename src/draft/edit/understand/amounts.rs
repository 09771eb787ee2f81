//! Numbers: "range 15 m", "15 m range", "warmer by 5 degrees", "one metre lower", "sweep temperature from 5 to 25".

use super::words::{Degree, Topic, Verb, lexicon};
use super::{Reader, Step};
use crate::draft::edit::change::{Change, Param};
use crate::draft::edit::numbers::Move;
use crate::draft::read::quantity::{Measure, Quantity, quantity_at};
use crate::draft::wish::Amount;

/// Factor where nobody says how much: "deeper", "closer", "faster".
const SOME: f64 = 1.5;
/// Degrees and parts per thousand where nobody says how many.
const SOME_DEGREES: f64 = 5.0;

/// What a number may be of.
fn fits(param: Param, measure: Measure) -> bool {
    use Measure::{Angle, Length, Number, Salinity, Share, Speed, Temperature};
    match param {
        Param::Temperature => matches!(measure, Temperature | Angle | Number),
        Param::Salinity => matches!(measure, Salinity | Number),
        Param::Pitch | Param::Yaw => matches!(measure, Angle | Number),
        Param::Speed => matches!(measure, Speed | Number),
        Param::Ph | Param::Frames | Param::Scenes | Param::Seed | Param::Lines | Param::White | Param::Noise => {
            matches!(measure, Number)
        }
        _ => matches!(measure, Length | Number | Share),
    }
}

impl Reader<'_> {
    /// A number with its name behind or before it.
    pub(super) fn amounts(&mut self) -> Step {
        if let Some(next) = self.named_first()? {
            return Ok(Some(next));
        }
        self.number_first()
    }

    /// `range 15 m`, `temperature from 5 to 25 in five steps`, `images: 500`.
    fn named_first(&mut self) -> Step {
        let at = self.at;
        if let Some((tokens, ())) = self.phrase(&lexicon().images, at) {
            let next = self.skip(self.behind_to(at + tokens));
            return Ok(self.quantity(next).and_then(|found| self.images(at..found.tokens.end, &found)));
        }
        let Some((tokens, param)) = self.phrase(&lexicon().params, at) else { return Ok(None) };
        let next = at + tokens;
        let (is_difference, is_new) = (self.is_difference(next), self.behind_to(next) > next);
        let mut number = next;
        let mut found = None;
        for _ in 0..4 {
            found = self.quantity(number).filter(|found| fits(param, found.measure));
            if found.is_some() {
                break;
            }
            number = self.behind_difference(self.behind_to(number)).max(number + usize::from(self.is_filler(number)));
        }
        let Some(found) = found else { return Ok(self.by_verb(param, at..next)) };
        let change = self.of_number(param, &found, is_difference && !is_new);
        self.param = Some(param);
        self.change(at..found.tokens.end, change);
        self.verb = self.verb.filter(|verb| !matches!(verb, Verb::More | Verb::Fewer | Verb::Sweep));
        Ok(Some(found.tokens.end))
    }

    /// `15 m range`, `500 images`, `30 m deep`, `one metre lower`, `5 degrees warmer`.
    fn number_first(&mut self) -> Step {
        let Some(found) = self.quantity(self.at) else { return Ok(None) };
        let behind = self.skip(found.tokens.end);
        if let Some((tokens, degree)) = self.phrase(&lexicon().degrees, behind)
            && let Some(change) = self.of_degree(degree, Some(&found))
        {
            self.change(self.at..behind + tokens, change);
            return Ok(Some(behind + tokens));
        }
        if let Some((tokens, param)) =
            self.phrase(&lexicon().params, behind).filter(|(_, param)| fits(*param, found.measure))
        {
            let change = self.of_number(param, &found, false);
            self.change(self.at..behind + tokens, change);
            return Ok(Some(behind + tokens));
        }
        if let Some((tokens, ())) = self.phrase(&lexicon().images, behind) {
            return Ok(self.images(self.at..behind + tokens, &found));
        }
        // `increase the depth by 5 m and the range` has its number behind; a number alone belongs to what was spoken of.
        match self.param.filter(|param| fits(*param, found.measure) && found.measure != Measure::Number) {
            Some(param) if self.verb.is_none() => {
                let change = self.of_number(param, &found, false);
                self.change(found.tokens.clone(), change);
                Ok(Some(found.tokens.end))
            }
            _ => Ok(None),
        }
    }

    fn images(&mut self, tokens: std::ops::Range<usize>, found: &Quantity) -> Option<usize> {
        let Amount::Exactly(count) = found.amount else { return None };
        if found.measure != Measure::Number || !(1.0..=1e9).contains(&count) {
            return None;
        }
        let end = tokens.end;
        self.change(tokens, Change::Images(count as u64));
        Some(end)
    }

    pub(super) fn quantity(&self, at: usize) -> Option<Quantity> {
        quantity_at(&self.text, at)
    }

    fn is_filler(&self, at: usize) -> bool {
        self.phrase(&lexicon().fillers, at).is_some() || self.phrase(&lexicon().verbs, at).is_some()
    }

    pub(super) fn behind_to(&self, at: usize) -> usize {
        self.phrase(&lexicon().to, at).map_or(at, |(tokens, ())| at + tokens)
    }

    pub(super) fn is_difference(&self, at: usize) -> bool {
        self.phrase(&lexicon().difference, at).is_some()
    }

    fn behind_difference(&self, at: usize) -> usize {
        self.phrase(&lexicon().difference, at).map_or(at, |(tokens, ())| at + tokens)
    }

    /// What a number for a parameter means: a value, more, less, or values of a sweep.
    fn of_number(&self, param: Param, found: &Quantity, is_difference: bool) -> Change {
        let amount = found.amount.clone();
        if self.verb == Some(Verb::Sweep) {
            let values = match &amount {
                Amount::Steps(first, last, count) => steps(*first, *last, *count),
                Amount::Between(low, high) if found.falls => steps(*high, *low, None),
                Amount::Between(low, high) => steps(*low, *high, None),
                Amount::OneOf(values) => values.clone(),
                Amount::Exactly(value) => vec![*value],
            };
            return Change::Sweep(param, values);
        }
        let sign = if self.verb == Some(Verb::Fewer) { -1.0 } else { 1.0 };
        match (self.verb, amount) {
            (Some(Verb::More | Verb::Fewer), Amount::Exactly(share))
                if is_difference && found.measure == Measure::Share =>
            {
                Change::Move(param, Move::Times(1.0 + sign * share))
            }
            (Some(Verb::More | Verb::Fewer), Amount::Exactly(value)) if is_difference => {
                Change::Move(param, Move::By(sign * value))
            }
            (_, amount) => Change::To(param, amount),
        }
    }

    /// `double the range`, `increase the temperature`.
    fn by_verb(&mut self, param: Param, tokens: std::ops::Range<usize>) -> Option<usize> {
        let how = match (self.verb?, param) {
            (Verb::Double, _) => Move::Times(2.0),
            (Verb::Halve, _) => Move::Times(0.5),
            (Verb::More, Param::Temperature | Param::Salinity) => Move::By(SOME_DEGREES),
            (Verb::Fewer, Param::Temperature | Param::Salinity) => Move::By(-SOME_DEGREES),
            (Verb::More, _) => Move::Times(SOME),
            (Verb::Fewer, _) => Move::Times(1.0 / SOME),
            _ => {
                self.param = Some(param);
                return None;
            }
        };
        let end = tokens.end;
        self.change(tokens, Change::Move(param, how));
        self.verb = None;
        Some(end)
    }

    /// `warmer`, `murkier by two steps`, `lower by one metre`, `closer`.
    pub(super) fn degrees(&mut self) -> Step {
        let Some((tokens, degree)) = self.phrase(&lexicon().degrees, self.at) else { return Ok(None) };
        let mut next = self.at + tokens;
        // `lower the vehicle by 1 m`.
        let (behind, topic) = self.skip_topic(next);
        let before = self.behind_difference(behind);
        let number = [next, before, self.behind_difference(next)].into_iter().find_map(|at| self.quantity(at));
        if let Some(topic) = topic {
            self.topic = Some(topic);
        }
        let change = match &number {
            Some(found) => self.of_degree(degree, Some(found)).or_else(|| self.of_degree(degree, None)),
            None => self.of_degree(degree, None),
        };
        let Some(change) = change else { return Ok(None) };
        if let Some(found) = number.filter(|found| self.of_degree(degree, Some(found)).is_some()) {
            next = found.tokens.end;
        }
        self.change(self.at..next, change);
        Ok(Some(next))
    }

    /// A change by a word of more or less.
    fn of_degree(&self, degree: Degree, found: Option<&Quantity>) -> Option<Change> {
        let by = |param: Param, sign: f64, usual: Move| {
            let Some(found) = found else { return Some(Change::Move(param, usual)) };
            let Amount::Exactly(value) = found.amount else { return None };
            match found.measure {
                Measure::Share => Some(Change::Move(param, Move::Times(1.0 + sign * value))),
                measure if fits(param, measure) => Some(Change::Move(param, Move::By(sign * value))),
                _ => None,
            }
        };
        let times = |param, sign: f64| by(param, sign, Move::Times(if sign > 0.0 { SOME } else { 1.0 / SOME }));
        let plus = |param, sign: f64, usual: f64| by(param, sign, Move::By(sign * usual));
        let steps = |sign: i32| match found.map(|found| (&found.amount, found.measure)) {
            None => Some(sign),
            Some((Amount::Exactly(value), Measure::Number)) if *value >= 1.0 && *value <= 9.0 => {
                Some(sign * *value as i32)
            }
            Some(_) => None,
        };
        match degree {
            Degree::Warmer => plus(Param::Temperature, 1.0, SOME_DEGREES),
            Degree::Colder => plus(Param::Temperature, -1.0, SOME_DEGREES),
            Degree::Saltier => plus(Param::Salinity, 1.0, SOME_DEGREES),
            Degree::Fresher => plus(Param::Salinity, -1.0, SOME_DEGREES),
            Degree::Deeper => times(Param::Depth, 1.0),
            Degree::Shallower => times(Param::Depth, -1.0),
            Degree::Murkier | Degree::Clearer if self.topic == Some(Topic::Picture) => {
                plus(Param::White, if degree == Degree::Murkier { 1.0 } else { -1.0 }, 3.0)
            }
            Degree::Murkier => steps(1).map(Change::Murkier),
            Degree::Clearer => steps(-1).map(Change::Murkier),
            Degree::Muddier => steps(1).map(Change::Muddier),
            Degree::Coarser => steps(-1).map(Change::Muddier),
            Degree::Rougher => found.is_none().then_some(Change::Rougher(SOME)),
            Degree::Flatter => found.is_none().then_some(Change::Rougher(1.0 / SOME)),
            Degree::Higher => plus(Param::Altitude, 1.0, 1.0),
            Degree::Lower => plus(Param::Altitude, -1.0, 1.0),
            Degree::Closer => times(Param::Distance, -1.0),
            Degree::Farther => times(Param::Distance, 1.0),
            Degree::Faster => times(Param::Speed, 1.0),
            Degree::Slower => times(Param::Speed, -1.0),
            Degree::Brighter => plus(Param::White, -1.0, 3.0),
            Degree::Dimmer => plus(Param::White, 1.0, 3.0),
            Degree::Noisier => plus(Param::Noise, 1.0, 6.0),
            Degree::Quieter => plus(Param::Noise, -1.0, 6.0),
        }
    }
}

fn steps(first: f64, last: f64, count: Option<u32>) -> Vec<f64> {
    crate::draft::edit::change::in_steps(first, last, count)
}
