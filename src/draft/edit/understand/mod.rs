//! The built-in reading of a request to change a recipe: tables of words, offline.
//!
//! Rules are tried at each token in turn; what one reads is a change, what none reads is told. A thing that no catalog has and
//! a place that cannot be found are asked back.

mod amounts;
mod counts;
mod settings;
mod stands;
mod things;
mod vehicle;
mod words;

use std::ops::Range;

use super::change::{Change, Held, Param};
use super::subject::Subject;
use crate::draft::read::phrases::Phrases;
use crate::draft::read::text::Text;
use crate::draft::read::token::{Kind, tokens};
use crate::draft::wish::Said;
use crate::draft::{Known, Problem, Prompt, Refusal};
use words::{Topic, Verb, lexicon};

/// What a request asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Understood {
    /// In the order of the request.
    pub changes: Vec<Said<Change>>,
    /// Words of the request that say nothing that is known.
    pub unread: Vec<Range<usize>>,
}

/// Reads a request.
///
/// # Errors
/// What was not understood, does not exist or cannot be, and what to write instead.
pub fn understand(prompt: &Prompt, subject: &Subject, known: &Known) -> Result<Understood, Refusal> {
    let mut reader = Reader::of(prompt.text(), subject, known);
    while reader.at < reader.text.tokens.len() {
        reader.next()?;
    }
    let unread = reader.unread();
    if reader.changes.is_empty() {
        let what = match unread.first() {
            Some(words) => format!("“{}” was not understood as a change", prompt.words(words)),
            None => "nothing that would change was understood".to_owned(),
        };
        return Err(Problem { words: unread.first().cloned(), what, help: EXAMPLES.to_owned() }.into());
    }
    Ok(Understood { changes: reader.changes, unread })
}

/// What is told where nothing was understood.
pub(in crate::draft::edit) const EXAMPLES: &str = "say for example “make the water murkier”, “add two barrels to the left of the wreck”, “pitch the sonar \
                        down 20°”, “range 15 m”; any value can be set with --set path=value";

/// A request on its way to changes.
struct Reader<'a> {
    text: Text<'a>,
    subject: &'a Subject,
    known: &'a Known,
    /// The next token.
    at: usize,
    /// What is to be done with what comes.
    verb: Option<Verb>,
    /// Where that is said, until something is done.
    verb_at: Option<usize>,
    /// What `it` is.
    held: Option<Held>,
    topic: Option<Topic>,
    /// What a number without a name is of.
    param: Option<Param>,
    changes: Vec<Said<Change>>,
    /// Tokens that no rule takes.
    unread: Vec<usize>,
}

/// What a rule made of some tokens: the next token, or why not.
type Step = Result<Option<usize>, Problem>;

impl<'a> Reader<'a> {
    fn of(source: &'a str, subject: &'a Subject, known: &'a Known) -> Self {
        let mut text = Text::of(source);
        // Typing errors are repaired only where this table does not know the word.
        for (token, raw) in text.tokens.iter_mut().zip(tokens(source, text.language)) {
            if lexicon().known.contains(&raw.form) || settings::is_of_device(&raw.form) {
                token.form = raw.form;
            }
        }
        Self {
            text,
            subject,
            known,
            at: 0,
            verb: None,
            verb_at: None,
            held: None,
            topic: None,
            param: None,
            changes: Vec::new(),
            unread: Vec::new(),
        }
    }

    /// Reads what stands at the next token.
    fn next(&mut self) -> Result<(), Problem> {
        let rules: [fn(&mut Self) -> Step; 14] = [
            Self::clears,
            Self::names,
            Self::splits,
            Self::devices,
            Self::held_turns,
            Self::goes,
            Self::routes,
            Self::degrees,
            Self::amounts,
            Self::values,
            Self::objects,
            Self::verbs,
            Self::topics,
            Self::nothing,
        ];
        for rule in rules {
            if let Some(next) = rule(self)? {
                self.at = next.max(self.at + 1);
                return Ok(());
            }
        }
        self.unread.push(self.at);
        self.at += 1;
        Ok(())
    }

    /// Notes a change that some tokens ask for.
    fn change(&mut self, tokens: Range<usize>, change: Change) {
        // Only little words stand between the verb and what it is about.
        let begin = self.verb_at.take().filter(|verb| *verb < tokens.start).unwrap_or(tokens.start);
        self.changes.push(Said::by(self.text.bytes(begin..tokens.end), change));
    }

    /// A fault of some tokens.
    fn problem(&self, tokens: Range<usize>, what: impl Into<String>, help: impl Into<String>) -> Problem {
        Problem::of(self.text.bytes(tokens), what, help)
    }

    fn phrase<T: Clone>(&self, phrases: &Phrases<T>, at: usize) -> Option<(usize, T)> {
        phrases.at(&self.text, at).map(|(tokens, means)| (tokens, means.clone()))
    }

    /// Behind words that say nothing, such as articles.
    fn skip(&self, mut at: usize) -> usize {
        while let Some((tokens, ())) = self.phrase(&lexicon().fillers, at) {
            at += tokens;
        }
        at
    }

    /// Behind words that say nothing and what is spoken of: `the sonar`.
    fn skip_topic(&self, mut at: usize) -> (usize, Option<Topic>) {
        let mut topic = None;
        loop {
            let next = self.skip(at);
            match self.phrase(&lexicon().topics, next) {
                Some((tokens, found)) => {
                    topic = Some(found);
                    at = next + tokens;
                }
                None => return (next, topic),
            }
        }
    }

    fn topics(&mut self) -> Step {
        let Some((tokens, topic)) = self.phrase(&lexicon().topics, self.at) else { return Ok(None) };
        self.topic = Some(topic);
        match topic {
            Topic::Sonar => self.held = Some(Held::Sonar),
            Topic::Vehicle => self.held = Some(Held::Vehicle),
            _ => {}
        }
        Ok(Some(self.at + tokens))
    }

    fn verbs(&mut self) -> Step {
        let Some((tokens, verb)) = self.phrase(&lexicon().verbs, self.at) else { return Ok(None) };
        self.verb = Some(verb);
        self.verb_at = Some(self.at);
        Ok(Some(self.at + tokens))
    }

    /// `clear the scene`.
    fn clears(&mut self) -> Step {
        let Some((tokens, Verb::Clear)) = self.phrase(&lexicon().verbs, self.at) else { return Ok(None) };
        self.change(self.at..self.at + tokens, Change::Clear);
        self.verb = Some(Verb::Add);
        Ok(Some(self.at + tokens))
    }

    /// Words that say nothing, and marks.
    fn nothing(&mut self) -> Step {
        if self.text.tokens.get(self.at).is_some_and(|token| matches!(token.kind, Kind::Mark(_))) {
            return Ok(Some(self.at + 1));
        }
        let table = lexicon();
        let alone = [&table.fillers, &table.images].into_iter().find_map(|words| self.phrase(words, self.at));
        let tokens = alone.map(|(tokens, ())| tokens).or(self.phrase(&table.params, self.at).map(|(tokens, _)| tokens));
        Ok(tokens.map(|tokens| self.at + tokens))
    }

    /// Runs of words that no rule takes.
    fn unread(&self) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for &token in &self.unread {
            match runs.last_mut() {
                Some(run) if run.end == token => run.end += 1,
                _ => runs.push(token..token + 1),
            }
        }
        runs.into_iter().map(|run| self.text.bytes(run)).collect()
    }
}
