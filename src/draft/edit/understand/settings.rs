//! Names, splits, sonars, and words that are values: "rename it to harbour2", "split 70/20/10", "use a Gemini 720", "freshwater".

use super::words::{Topic, Verb, lexicon};
use super::{Reader, Step};
use crate::catalog::sonars;
use crate::draft::edit::act::word;
use crate::draft::edit::change::{Change, Param};
use crate::draft::read::number::number_at;
use crate::draft::wish::Amount;

/// Longest name of a dataset.
const LONGEST_NAME: usize = 64;

/// Whether a word is part of a sonar's name.
pub(super) fn is_of_device(form: &str) -> bool {
    form.len() > 3 && sonars::names().any(|name| name.split('-').any(|part| part == form))
}

impl Reader<'_> {
    /// `rename it to harbour2`.
    pub(super) fn names(&mut self) -> Step {
        let Some((tokens, Verb::Rename)) = self.phrase(&lexicon().verbs, self.at) else { return Ok(None) };
        let behind = self.skip(self.at + tokens);
        let from = self.text.bytes(behind..behind + 1).start;
        let said = self.text.source.get(from..).unwrap_or_default();
        let name =
            said.split([' ', ',', ';']).next().unwrap_or_default().trim_matches(['"', '\'', '“', '”', '.', '!', '?']);
        let is_name = !name.is_empty()
            && name.len() <= LONGEST_NAME
            && name.starts_with(|c: char| c.is_alphanumeric())
            && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '-' | '_'));
        if !is_name {
            let what = "a dataset's name has letters, digits, `-` and `_` only";
            return Err(self.problem(self.at..behind + 1, what, "say for example “rename it to harbour2”"));
        }
        let end = from + name.len();
        let mut next = behind;
        while self.text.tokens.get(next).is_some_and(|token| token.bytes.start < end) {
            next += 1;
        }
        self.change(self.at..next, Change::Set("name".to_owned(), word(name)));
        Ok(Some(next))
    }

    /// `split 70/20/10`, `70-20-10 split`, `70/20/10`.
    pub(super) fn splits(&mut self) -> Step {
        let said = self.phrase(&lexicon().topics, self.at).filter(|(_, topic)| *topic == Topic::Split);
        let mut next = self.skip(self.at + said.map_or(0, |(tokens, _)| tokens));
        let begin = next;
        let mut shares = Vec::new();
        while let Some(number) = number_at(&self.text, next).filter(|number| number.value >= 0.0) {
            shares.push(number.value);
            next += number.tokens;
            next += usize::from(self.text.is_mark(next, '%'));
            if shares.len() == 3 {
                break;
            }
            let parted = ['/', '-', ':', ','].into_iter().any(|mark| self.text.is_mark(next, mark));
            if !parted {
                break;
            }
            next += 1;
        }
        let sum: f64 = shares.iter().sum();
        let whole = [1.0, 100.0].into_iter().find(|whole| (sum - whole).abs() < 0.02 * whole);
        let slashes = self.text.is_mark(begin + 1, '/');
        match (&shares[..], whole) {
            ([train, rest @ ..], Some(whole)) if !rest.is_empty() && (said.is_some() || slashes) => {
                let (val, test) = if let [val, test] = rest { (*val, *test) } else { (0.0, rest[0]) };
                let change = Change::Splits([train / whole, val / whole, test / whole]);
                self.change(self.at..next, change);
                Ok(Some(next))
            }
            (_, None) if said.is_some() && shares.len() > 1 => {
                let what = format!("these shares add up to {sum}, not to 100");
                Err(self.problem(self.at..next, what, "say for example “split 70/20/10”"))
            }
            _ => Ok(None),
        }
    }

    /// `a Gemini 720`, `Oculus M750d`.
    pub(super) fn devices(&mut self) -> Step {
        let mut chosen: Vec<String> = Vec::new();
        let mut next = self.at;
        while let Some((end, device)) = self.device_at(next)? {
            chosen.push(device);
            next = self.skip(end);
            while self.text.is_mark(next, ',')
                || matches!(self.text.form(next), "and" | "or" | "und" | "oder" | "y" | "et")
            {
                next = self.skip(next + 1);
            }
        }
        if chosen.is_empty() {
            return Ok(None);
        }
        let change = match (self.verb, &chosen[..]) {
            (Some(Verb::Sweep), _) => Change::SweepWords("sonar.device", chosen),
            _ => Change::Words("sonar.device", chosen),
        };
        self.change(self.at..next, change);
        Ok(Some(next))
    }

    /// A sonar that is named at a token: its brand and as much of its type as was said.
    fn device_at(&self, at: usize) -> Result<Option<(usize, String)>, crate::draft::Problem> {
        let form = self.text.form(at);
        let is_brand = |name: &&str| name.split('-').next() == Some(form);
        let branded: Vec<&str> = sonars::names().filter(is_brand).collect();
        if branded.is_empty() {
            return Ok(None);
        }
        let kind = |name: &str| name.split_once('-').map_or(String::new(), |(_, kind)| kind.replace('-', ""));
        let (mut said, mut next) = (String::new(), at + 1);
        let mut left = branded.clone();
        while next < self.text.tokens.len() {
            let longer = format!("{said}{}", self.text.words(next..next + 1).to_lowercase());
            let fitting: Vec<&str> = branded.iter().copied().filter(|name| kind(name).contains(&longer)).collect();
            if fitting.is_empty() {
                break;
            }
            (said, left) = (longer, fitting);
            next += 1;
        }
        let is_number = |at: usize| self.text.tokens.get(at).is_some_and(|token| token.number().is_some());
        if said.is_empty() && is_number(next) {
            let what = format!("no sonar is called “{}”", self.text.words(at..next + 1));
            return Err(self.problem(at..next + 1, what, format!("there are {}", branded.join(", "))));
        }
        // Of two frequencies the lower one, which is the usual one.
        let low = left.iter().find(|name| name.ends_with("-lf")).or(left.first());
        let types: std::collections::BTreeSet<&str> =
            left.iter().map(|name| name.trim_end_matches("-lf").trim_end_matches("-hf")).collect();
        if types.len() > 1 {
            let what = format!("“{}” may be {}", self.text.words(at..next), left.join(", "));
            return Err(self.problem(at..next, what, "name one of these"));
        }
        Ok(low.map(|name| (next, (*name).to_owned())))
    }

    /// `freshwater`, `clear`, `sand`, `flat`, `ripples`, `a pier`.
    pub(super) fn values(&mut self) -> Step {
        let table = lexicon();
        if let Some((tokens, salt)) = self.phrase(&table.salt, self.at) {
            self.change(self.at..self.at + tokens, Change::To(Param::Salinity, Amount::Exactly(salt)));
            return Ok(Some(self.at + tokens));
        }
        for (path, phrases, ladder) in [
            ("water.turbidity", &table.turbidity, &crate::draft::edit::change::TURBIDITY[..]),
            ("seabed.sediment", &table.sediments, &[]),
        ] {
            if let Some((next, words)) = self.listed(phrases, ladder) {
                let change = match self.verb {
                    Some(Verb::Sweep) => Change::SweepWords(path, words),
                    Some(Verb::Remove) => return Ok(None),
                    _ => Change::Words(path, words),
                };
                self.change(self.at..next, change);
                return Ok(Some(next));
            }
        }
        if let Some((tokens, shape)) = self.phrase(&table.shapes, self.at).filter(|_| self.verb != Some(Verb::Remove)) {
            self.change(self.at..self.at + tokens, Change::Shape(shape));
            return Ok(Some(self.at + tokens));
        }
        let Some((tokens, kind)) = self.phrase(&table.structures, self.at) else { return Ok(None) };
        let removed = self.verb == Some(Verb::Remove);
        self.change(self.at..self.at + tokens, Change::Structure((!removed).then_some(kind)));
        Ok(Some(self.at + tokens))
    }

    /// Words of one table one after the other; from one to another of a ladder, all between.
    fn listed(
        &self,
        phrases: &crate::draft::read::phrases::Phrases<String>,
        ladder: &[&str],
    ) -> Option<(usize, Vec<String>)> {
        let (tokens, first) = self.phrase(phrases, self.at)?;
        let mut words = vec![first];
        let mut next = self.at + tokens;
        loop {
            let to = matches!(self.text.form(next), "to" | "bis" | "a" | "hasta" | "jusqu" | "到");
            let link = self.skip(next + usize::from(self.text.is_mark(next, ',')));
            let link = link + usize::from(matches!(self.text.form(link), "or" | "oder" | "o" | "ou" | "或"));
            let Some((tokens, word)) = self.phrase(phrases, self.skip(link)).filter(|_| link > next) else { break };
            next = self.skip(link) + tokens;
            let place = |word: &str| ladder.iter().position(|rung| *rung == word);
            match (to, place(&words[words.len() - 1]), place(&word)) {
                (true, Some(from), Some(until)) if from < until => {
                    words.extend(ladder[from + 1..=until].iter().map(|rung| (*rung).to_owned()));
                }
                (true, Some(from), Some(until)) => {
                    words.extend(ladder[until..from].iter().rev().map(|rung| (*rung).to_owned()));
                }
                _ => words.push(word),
            }
        }
        Some((next, words))
    }
}
