//! Vehicle and sonar: "pitch the sonar down 20°", "turn it 45 degrees to the right", "move the AUV to x=2, y=-1", "lawnmower".

use super::words::{Topic, Turning, Verb, Way, lexicon};
use super::{Reader, Step};
use crate::draft::edit::change::{Change, Held, Param};
use crate::draft::edit::numbers::Move;
use crate::draft::read::place::place_at;
use crate::draft::read::quantity::{Measure, Quantity};
use crate::draft::wish::{Amount, Route};

/// Degrees by which something is tilted where nobody says how many.
const TILT_DEG: f64 = 10.0;

/// What a turn is said with: up to the end of its clause.
#[derive(Default)]
struct Turn {
    end: usize,
    held: Option<Held>,
    turning: Option<Turning>,
    number: Option<Quantity>,
    heading: Option<f64>,
    is_new: bool,
}

impl Reader<'_> {
    /// Turns and tilts.
    pub(super) fn held_turns(&mut self) -> Step {
        let verbs: Vec<(usize, Verb)> =
            lexicon().verbs.all_at(&self.text, self.at).map(|(tokens, verb)| (tokens, *verb)).collect();
        let wanted = |verb: &Verb| matches!(verb, Verb::Turn | Verb::Pitch | Verb::Point);
        let said = verbs.into_iter().find(|(_, verb)| wanted(verb));
        let topic =
            self.phrase(&lexicon().topics, self.at).filter(|(_, topic)| matches!(topic, Topic::Sonar | Topic::Vehicle));
        let (tokens, verb) = match (said, topic) {
            (Some((tokens, verb)), _) => (tokens, Some(verb)),
            // `the sonar 20° down`
            (None, Some((tokens, _))) => (tokens, None),
            _ => return Ok(None),
        };
        let turn = self.turn(self.at + tokens);
        let held = turn.held.or(topic.map(|(_, topic)| held_of(topic))).or(self.held);
        let change = match (verb, &turn) {
            (_, Turn { heading: Some(heading), .. }) if verb != Some(Verb::Pitch) => Some(Change::Heading(*heading)),
            (None, Turn { number: None, .. }) => None,
            (_, Turn { turning: Some(Turning::Up | Turning::Down), .. }) | (Some(Verb::Pitch), _) => {
                self.pitched(held, &turn)?
            }
            (_, Turn { turning: Some(side), number, .. }) => {
                let degrees = angle(number.as_ref()).or_else(|| number.is_none().then_some(90.0));
                let sign = if *side == Turning::Left { 1.0 } else { -1.0 };
                degrees.map(|degrees| Change::Turn(sign * degrees, held.unwrap_or(Held::Vehicle)))
            }
            _ => None,
        };
        let Some(change) = change else { return Ok(None) };
        self.held = held.or(self.held);
        self.change(self.at..turn.end, change);
        Ok(Some(turn.end))
    }

    fn pitched(&self, held: Option<Held>, turn: &Turn) -> Result<Option<Change>, crate::draft::Problem> {
        let sign = if turn.turning == Some(Turning::Down) { -1.0 } else { 1.0 };
        let degrees = match (&turn.number, turn.turning) {
            (Some(number), _) => angle(Some(number)),
            (None, Some(_)) => Some(TILT_DEG),
            (None, None) => None,
        };
        let Some(degrees) = degrees else { return Ok(None) };
        // `the pitch to -30`, `pitch -30`: without a direction it is the new value.
        if turn.is_new || turn.turning.is_none() {
            return Ok(Some(Change::To(Param::Pitch, Amount::Exactly(sign * degrees))));
        }
        Ok(Some(Change::Pitch(sign * degrees, held.unwrap_or(Held::Sonar))))
    }

    /// What stands in the clause of a turn.
    fn turn(&self, from: usize) -> Turn {
        let mut turn = Turn { end: from, ..Turn::default() };
        let mut at = from;
        while at < self.text.tokens.len() && !self.text.is_mark(at, ',') && !self.text.is_mark(at, ';') {
            if let Some((tokens, topic)) = self.phrase(&lexicon().topics, at) {
                if !matches!(topic, Topic::Sonar | Topic::Vehicle) {
                    break;
                }
                turn.held = turn.held.or(Some(held_of(topic)));
                at += tokens;
            } else if let Some(number) = self.quantity(at).filter(|found| turn.number.is_none() && is_angle(found)) {
                let before = at.checked_sub(1).map_or("", |before| self.text.form(before));
                turn.is_new |= matches!(before, "to" | "auf" | "a" | "=" | ":" | "为" | "到");
                at = number.tokens.end;
                turn.number = Some(number);
            } else if let Some((tokens, turning)) = self.phrase(&lexicon().turns, at).filter(|_| turn.turning.is_none())
            {
                turn.turning = Some(turning);
                at += tokens;
            } else if let Some((tokens, heading)) =
                self.phrase(&lexicon().headings, at).filter(|_| turn.heading.is_none())
            {
                turn.heading = Some(heading);
                at += tokens;
            } else {
                let is_and = matches!(self.text.form(at), "and" | "und" | "y" | "et" | "并" | "then");
                let next = self.skip_one(at);
                let begins = self.phrase(&lexicon().verbs, next).is_some() || is_and;
                if next == at || begins {
                    break;
                }
                at = next;
                continue;
            }
            turn.end = at;
        }
        turn
    }

    /// Behind one word that says nothing.
    fn skip_one(&self, at: usize) -> usize {
        let table = lexicon();
        let to = self.phrase(&table.to, at).or(self.phrase(&table.difference, at)).or(self.phrase(&table.fillers, at));
        to.map_or(at, |(tokens, ())| at + tokens)
    }

    /// `move the AUV to x=2, y=-1`, `raise the vehicle by 2 m`, `hover at (2, 3, 1)`.
    pub(super) fn goes(&mut self) -> Step {
        let verb = self.phrase(&lexicon().verbs, self.at);
        let hovers = self.phrase(&lexicon().routes, self.at).filter(|(_, way)| *way == Way::Hover);
        let (tokens, verb) = match (verb, hovers) {
            (Some((tokens, verb @ (Verb::Move | Verb::Put | Verb::More | Verb::Fewer))), _) => (tokens, verb),
            (None, Some((tokens, _))) => (tokens, Verb::Move),
            _ => return Ok(None),
        };
        let (behind, topic) = self.skip_topic(self.at + tokens);
        let is_vehicle = matches!(topic, Some(Topic::Sonar | Topic::Vehicle)) || hovers.is_some();
        let is_it = topic.is_none() && verb == Verb::Move && self.held.is_some();
        if !is_vehicle && !is_it {
            return Ok(None);
        }
        self.held = topic.map(held_of).or(self.held);
        if matches!(verb, Verb::More | Verb::Fewer) {
            let sign = if verb == Verb::More { 1.0 } else { -1.0 };
            let number = self.quantity(self.skip_one(behind)).or_else(|| self.quantity(behind));
            let metres = match number.as_ref().map(|found| (&found.amount, found.measure)) {
                Some((Amount::Exactly(metres), Measure::Length)) => *metres,
                _ => return Ok(None),
            };
            let end = number.map_or(behind, |found| found.tokens.end);
            self.change(self.at..end, Change::Move(Param::Altitude, Move::By(sign * metres)));
            return Ok(Some(end));
        }
        let place = place_at(&self.text, behind).or_else(|| place_at(&self.text, self.skip_one(behind)));
        let Some(place) = place else { return Ok(None) };
        self.change(self.at..place.tokens.end, Change::Place(place.at));
        Ok(Some(place.tokens.end))
    }

    /// `a lawnmower`, `orbit`, `hover`.
    pub(super) fn routes(&mut self) -> Step {
        let Some((tokens, way)) = self.phrase(&lexicon().routes, self.at) else { return Ok(None) };
        let nothing = (None, None);
        let route = match way {
            Way::Orbit => Route::Orbit { arc_deg: None, sides: None },
            Way::Lawnmower => Route::Lawnmower { length_m: None, width_m: None, spacing_m: None, lines: self.lines() },
            Way::Follow => Route::Follow { what: None, length_m: None },
            Way::Approach => Route::Approach { from_m: nothing.0, to_m: nothing.1 },
            Way::Views => Route::Views,
            Way::Hover => Route::Hover,
        };
        self.change(self.at..self.at + tokens, Change::Route(route));
        Ok(Some(self.at + tokens))
    }

    /// How many lines, where the number stands before them: `five survey lines`.
    fn lines(&self) -> Option<u32> {
        let before = self.at.checked_sub(1)?;
        let number = crate::draft::read::number::number_at(&self.text, before)?;
        (number.tokens == 1 && number.value >= 1.0 && number.value <= 1000.0).then_some(number.value as u32)
    }
}

fn held_of(topic: Topic) -> Held {
    if topic == Topic::Vehicle { Held::Vehicle } else { Held::Sonar }
}

fn is_angle(found: &Quantity) -> bool {
    matches!(found.measure, Measure::Angle | Measure::Number)
}

fn angle(found: Option<&Quantity>) -> Option<f64> {
    match found.map(|found| (&found.amount, found.measure)) {
        Some((Amount::Exactly(degrees), Measure::Angle | Measure::Number)) => Some(*degrees),
        _ => None,
    }
}
