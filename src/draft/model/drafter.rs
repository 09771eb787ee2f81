//! A prompt read by a language model, beside the built-in reader: asked, compared, asked again with what was wrong.

use std::fmt::Display;

use super::answer::Answer;
use super::ask;
use super::client::{Client, Settings};
use super::error::short;
use super::evidence::Evidence;
use super::format::{Message, Question};
use super::parse::parse;
use super::settle::{Reader, Settled, settle};
use super::to_wish::to_wish;
use super::translate::translated;
use super::{Fault, ModelError};
use crate::draft::sense::sense;
use crate::draft::transcript::{Round, Who};
use crate::draft::{Known, Problem, Prompt, Refusal, Wish};

/// Most answers that are asked for.
const MOST_ROUNDS: usize = 3;
/// Most images of a draft, as the built-in reader has it.
const MOST_IMAGES: u64 = 100_000;

/// What a model's reading is held against.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Held {
    /// The prompt's own words, as the built-in reader reads them.
    #[default]
    ToThePrompt,
    /// Nothing but the form and the catalogs: its first answer counts, for measuring models.
    ToTheFormAlone,
}

/// A drafter that asks a language model.
#[derive(Debug)]
pub struct ModelDrafter {
    client: Client,
    held: Held,
}

/// A prompt, what it may be about, and what the built-in reader makes of it.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The prompt.
    pub prompt: &'a Prompt,
    /// Catalogs.
    pub known: &'a Known,
    /// The built-in reader's reading.
    pub read: &'a Result<Wish, Refusal>,
}

/// What came of a prompt.
#[derive(Debug)]
pub struct Understood<T> {
    /// What was understood.
    pub wish: Wish,
    /// What was made of it.
    pub made: T,
}

/// Why nothing came of it.
#[derive(Debug)]
pub enum NotUnderstood<E> {
    /// The server, or the model's answers.
    Model(ModelError),
    /// The prompt asks for what cannot be, or for nothing.
    Refused(Refusal),
    /// What was understood makes no recipe.
    Unmade(E),
}

/// One answer: the form, or what is wrong with it, and its text.
struct Answered {
    answer: Result<Answer, Vec<String>>,
    text: String,
}

/// The best of the rounds so far.
struct Best<T, E> {
    settled: Settled,
    made: Result<T, E>,
}

impl ModelDrafter {
    /// A drafter for a server; nothing is sent yet.
    #[must_use]
    pub fn new(settings: Settings, held: Held) -> Self {
        Self { client: Client::new(settings), held }
    }

    /// Who it is, for headings and transcripts: never with a key.
    #[must_use]
    pub fn who(&self) -> Who {
        let settings = self.client.settings();
        Who::Model { model: settings.model.clone(), host: settings.server.host().to_owned() }
    }

    /// The client, for other questions.
    pub fn client(&mut self) -> &mut Client {
        &mut self.client
    }

    /// Reads a prompt and makes something of the wish, which may be refused. Every answer goes into `rounds`.
    ///
    /// # Errors
    /// A server that gives no answer, a prompt that is refused, a wish of which nothing can be made.
    pub fn read<T, E: Display>(
        &mut self,
        asked: Asked<'_>,
        rounds: &mut Vec<Round>,
        make: &mut dyn FnMut(&Wish) -> Result<T, E>,
    ) -> Result<Understood<T>, NotUnderstood<E>> {
        if self.held == Held::ToTheFormAlone {
            return self.read_alone(asked, rounds, make);
        }
        if let Some(refusal) = asked.read.as_ref().err().filter(|refusal| is_definite(refusal)) {
            return Err(NotUnderstood::Refused(refusal.clone()));
        }
        let read = asked.read.as_ref().ok();
        if let Some(wish) = read.filter(|wish| wish.unknown.is_empty()) {
            make(wish).map_err(NotUnderstood::Unmade)?;
        }
        let evidence = Evidence::of(asked.prompt, asked.known, read);
        let mut round = Rounds { drafter: self, asked, evidence, read: read.cloned().unwrap_or_default() };
        let best = round.all(rounds, make)?;
        self.conclude(asked, rounds, best, make)
    }

    /// The first answer as it is.
    fn read_alone<T, E: Display>(
        &mut self,
        asked: Asked<'_>,
        rounds: &mut Vec<Round>,
        make: &mut dyn FnMut(&Wish) -> Result<T, E>,
    ) -> Result<Understood<T>, NotUnderstood<E>> {
        let evidence = Evidence::of(asked.prompt, asked.known, None);
        let messages = self.first(asked, &evidence);
        let Answered { answer, text } = self.answer(&messages)?;
        rounds.push(Round::new(&text, answer.as_ref().err().cloned().unwrap_or_default()));
        let answer = answer.map_err(|problems| NotUnderstood::Model(self.useless(1, &problems)))?;
        refused_by(&answer, asked)?;
        let wish = to_wish(&answer, asked.known);
        sense(&wish).map_err(NotUnderstood::Refused)?;
        let made = make(&wish).map_err(NotUnderstood::Unmade)?;
        Ok(Understood { wish, made })
    }

    fn first(&self, asked: Asked<'_>, evidence: &Evidence) -> Vec<Message> {
        let candidates = ask::candidates(asked.prompt, asked.known, evidence);
        ask::messages(asked.prompt, &candidates, self.client.settings().max_tokens)
    }

    /// One answer and its text.
    fn answer<E>(&mut self, messages: &[Message]) -> Result<Answered, NotUnderstood<E>> {
        let question = Question { messages, name: "request", shape: ask::shape() };
        let reply = self.client.ask(&question).map_err(NotUnderstood::Model)?;
        Ok(Answered { answer: parse(&reply, ask::shape()), text: reply.text })
    }

    fn useless(&self, rounds: usize, problems: &[String]) -> ModelError {
        let why = short(&problems.join("; "));
        ModelError { host: self.client.settings().server.host().to_owned(), fault: Fault::Useless { rounds, why } }
    }

    /// What counts after the last round, and what a person is told of it.
    fn conclude<T, E: Display>(
        &self,
        asked: Asked<'_>,
        rounds: &[Round],
        best: Option<Best<T, E>>,
        make: &mut dyn FnMut(&Wish) -> Result<T, E>,
    ) -> Result<Understood<T>, NotUnderstood<E>> {
        let last = rounds.last().map(|round| round.problems.clone()).unwrap_or_default();
        match (best, asked.read) {
            (Some(Best { settled, made }), _) => {
                let mut wish = settled.wish;
                let made = made.map_err(NotUnderstood::Unmade)?;
                let notes = notes(&settled.wrong, &settled.left_out);
                if notes.is_empty() {
                    return Ok(Understood { wish, made });
                }
                wish.notes.extend(notes);
                let made = make(&wish).map_err(NotUnderstood::Unmade)?;
                Ok(Understood { wish, made })
            }
            (None, Ok(read)) => {
                let mut wish = read.clone();
                let why = short(&last.join("; "));
                wish.notes.push(format!(
                    "the language model gave no answer that can be used ({why}): the built-in reader's counts"
                ));
                let made = make(&wish).map_err(NotUnderstood::Unmade)?;
                Ok(Understood { wish, made })
            }
            (None, Err(_)) => Err(NotUnderstood::Model(self.useless(rounds.len(), &last))),
        }
    }
}

/// The rounds of one prompt.
struct Rounds<'a> {
    drafter: &'a mut ModelDrafter,
    asked: Asked<'a>,
    evidence: Evidence,
    read: Wish,
}

impl Rounds<'_> {
    fn reader(&self) -> Reader {
        if self.asked.read.is_ok() { Reader::Understood } else { Reader::Lost }
    }

    /// Asks until an answer has nothing wrong, or often enough; the last answer of the right form is the best.
    fn all<T, E: Display>(
        &mut self,
        rounds: &mut Vec<Round>,
        make: &mut dyn FnMut(&Wish) -> Result<T, E>,
    ) -> Result<Option<Best<T, E>>, NotUnderstood<E>> {
        let most_tokens = self.drafter.client.settings().max_tokens;
        let first = self.drafter.first(self.asked, &self.evidence);
        let mut messages = first.clone();
        let mut best = None;
        for _ in 0..MOST_ROUNDS {
            let Answered { answer, text } = self.drafter.answer(&messages)?;
            let problems = match answer {
                Err(problems) => problems,
                Ok(answer) => {
                    if self.reader() == Reader::Lost {
                        refused_by(&answer, self.asked)?;
                    }
                    let settled = self.settled(&answer)?;
                    let made = make(&settled.wish);
                    let mut problems = settled.wrong.clone();
                    // Of what the prompt's own words ask for, a model can change nothing.
                    problems.extend(
                        made.as_ref()
                            .err()
                            .filter(|_| self.reader() == Reader::Lost)
                            .map(|error| short(&error.to_string())),
                    );
                    best = Some(Best { settled, made });
                    problems
                }
            };
            rounds.push(Round::new(&text, problems.clone()));
            if problems.is_empty() {
                break;
            }
            messages = ask::mended(first.clone(), &text, &problems, most_tokens);
        }
        Ok(best)
    }

    fn settled<E>(&mut self, answer: &Answer) -> Result<Settled, NotUnderstood<E>> {
        let Asked { prompt, known, .. } = self.asked;
        let said = to_wish(answer, known);
        let strange: Vec<_> = match self.reader() {
            Reader::Understood => self.read.unknown.iter().filter_map(|unknown| unknown.words.clone()).collect(),
            Reader::Lost => self.evidence.strange.clone(),
        };
        let is_new = |label: &str| self.evidence.label(label).is_none();
        if !strange.is_empty() && said.things.iter().any(|thing| is_new(&thing.label)) {
            let found = translated(&mut self.drafter.client, prompt, &strange, known).map_err(NotUnderstood::Model)?;
            found.into_iter().for_each(|(label, words)| self.evidence.learn(label, words));
        }
        let settled = settle(prompt, &self.read, said, &self.evidence, self.reader());
        if self.reader() == Reader::Lost {
            if says_nothing(&settled.wish) {
                return Err(NotUnderstood::Refused(lost(self.asked, None)));
            }
            sense(&settled.wish).map_err(NotUnderstood::Refused)?;
        }
        Ok(settled)
    }
}

/// The built-in reader's refusal, with what the model says.
fn lost(asked: Asked<'_>, said: Option<&str>) -> Refusal {
    let mut refusal = asked.read.as_ref().err().cloned().unwrap_or_else(|| Refusal { problems: Vec::new() });
    if let Some(said) = said.map(short).filter(|said| !said.is_empty()) {
        let help = "write what should be in the images: `20 images of two tires on sand`";
        refusal.problems.push(Problem::whole(format!("the language model finds no scene in it, either: {said}"), help));
    }
    refusal
}

/// A model that says that there is nothing to draft, no images at all or too many: a plan of a thousand million frames fills any
/// memory.
fn refused_by<E>(answer: &Answer, asked: Asked<'_>) -> Result<(), NotUnderstood<E>> {
    let what = match answer.images {
        Some(0) => Some("zero images: a dataset has at least one".to_owned()),
        Some(images) if images > MOST_IMAGES => Some(format!("{images} images are more than are drafted at once")),
        _ => None,
    };
    if let Some(what) = what {
        let help = format!(
            "ask for 1 to {MOST_IMAGES} images; a recipe's `sweep` or another `seed` makes more of the same kind"
        );
        return Err(NotUnderstood::Refused(Problem::whole(what, help).into()));
    }
    match answer.refusal.as_deref().map(str::trim) {
        Some(said) if !said.is_empty() && answer.objects.is_empty() => {
            let refusal = lost(asked, Some(said));
            Err(NotUnderstood::Refused(refusal))
        }
        _ => Ok(()),
    }
}

/// Whether a refusal is of what the prompt says, and not for want of words in it that the reader knows: those that it does not
/// know may be of another language.
fn is_definite(refusal: &Refusal) -> bool {
    let is_strange = |problem: &Problem| problem.help.contains("`ensonify catalog index");
    refusal.problems.iter().any(|problem| problem.words.is_some() && !is_strange(problem))
}

/// Whether a wish is for nothing that could be seen.
fn says_nothing(wish: &Wish) -> bool {
    let is_place = wish.unknown.is_empty() && (wish.environment.is_some() || wish.path.route.is_some());
    wish.things.is_empty() && !is_place
}

/// What a person is told of what a model said otherwise.
fn notes(wrong: &[String], left_out: &[String]) -> Vec<String> {
    let wrong = wrong.iter().map(|text| format!("the language model was not followed: {text}"));
    wrong.chain(left_out.iter().map(|text| format!("left out of what the language model said: {text}"))).collect()
}
