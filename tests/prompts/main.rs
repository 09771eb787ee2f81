//! Prompts against what they must become, field by field.
//!
//! `prompts.yaml` has 39 that are to be right, `prompts_nonsense.yaml` what is to be refused, `prompts_more.yaml` many more, of
//! which one half is not looked at by who works on drafting. `cargo test --release --test prompts -- --nocapture` shows the
//! tables. With `ENSONIFY_LLM_URL` and `ENSONIFY_LLM_MODEL` set, `-- --ignored --nocapture` shows those of a language model.

mod drafted;
mod expected;
mod number;
mod score;
mod scorer;
mod table;
mod ways;

use std::path::Path;
use std::time::Duration;

use drafted::Drafted;
use ensonify::draft::model::{Asked, Held, Key, ModelDrafter, NotUnderstood, Server, Settings};
use ensonify::draft::read::read;
use ensonify::draft::{DraftError, Drafter, Known, Options, Prompt, composed};
use expected::{Case, Set, cases, vocabulary};
use score::{Outcome, score};
use table::{Result, faults, fields, misses, share, table};

/// Share of the fields that are right, at least.
const ENOUGH: f64 = 0.92;

/// The same of prompts that nobody looked at.
const ENOUGH_HELD_OUT: f64 = 0.9;

/// What a drafter makes of a prompt.
enum Drafting {
    Recipe(String),
    Refused(String),
    Failed(String),
}

/// What a recipe's text is worth: what `check` says of it.
fn checked(recipe: &str) -> Outcome {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("drafted.yaml");
    std::fs::write(&path, recipe).expect("written");
    match Drafted::load(&path) {
        Ok(drafted) => Outcome::Drafted(Box::new(drafted)),
        Err(fault) => Outcome::Invalid(fault),
    }
}

/// Drafts every prompt and scores it.
fn results(cases: &[Case], draft: &mut dyn FnMut(&str) -> Drafting) -> Vec<Result> {
    let words = vocabulary();
    let mut result = |case: &Case| {
        let outcome = match draft(&case.prompt) {
            Drafting::Recipe(recipe) => checked(&recipe),
            Drafting::Refused(message) => Outcome::Refused(message),
            Drafting::Failed(fault) => Outcome::Invalid(fault),
        };
        Result::of(case, &outcome, score(case, &outcome, &words))
    };
    cases.iter().map(&mut result).collect()
}

/// The further prompts of one half.
fn half(set: Set) -> Vec<Case> {
    let mut cases = cases("prompts_more.yaml");
    cases.retain(|case| case.set == Some(set));
    cases
}

/// The catalog that comes with the program, and no other that may lie here.
fn known() -> Known {
    Known::open(Path::new(env!("CARGO_MANIFEST_DIR")), &["starter".to_owned()]).expect("the starter catalog")
}

/// The built-in drafter.
fn built_in(known: &Known) -> impl FnMut(&str) -> Drafting + '_ {
    |typed| match Drafter::BuiltIn.draft(&Prompt::new(typed, Options::default()), known) {
        Ok(draft) => Drafting::Recipe(draft.recipe),
        Err(DraftError::Refused(refusal)) => Drafting::Refused(refusal.to_string()),
        Err(fault) => Drafting::Failed(fault.to_string()),
    }
}

/// Prints how prompts fared and asserts that it is well enough.
fn enough(title: &str, results: &[Result], least: f64) {
    println!("{}{}", table(title, results), misses(results));
    assert_eq!(faults(results), 0, "{title}: each is a valid recipe or a clear refusal");
    let share = share(fields(results));
    assert!(share >= least, "{title}: {:.1} % of the fields are right", 100.0 * share);
}

#[test]
fn the_39_prompts_become_what_they_say() {
    let known = known();
    enough("the 39", &results(&cases("prompts.yaml"), &mut built_in(&known)), ENOUGH);
}

#[test]
fn nonsense_is_refused_in_words_that_help() {
    let known = known();
    enough("nonsense", &results(&cases("prompts_nonsense.yaml"), &mut built_in(&known)), ENOUGH);
}

#[test]
fn further_prompts_become_what_they_say() {
    let known = known();
    enough("further prompts", &results(&half(Set::Dev), &mut built_in(&known)), ENOUGH);
}

#[test]
fn prompts_that_nobody_looked_at_become_what_they_say() {
    let known = known();
    let results = results(&half(Set::HeldOut), &mut built_in(&known));
    // No misses are shown: who reads them has looked.
    println!("{}", table("held out", &results));
    let share = share(fields(&results));
    assert!(share >= ENOUGH_HELD_OUT, "{:.1} % of the fields are right", 100.0 * share);
}

/// A language model at `ENSONIFY_LLM_URL`; none where that is not set.
fn model(held: Held) -> Option<ModelDrafter> {
    let variable = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    let (Some(url), Some(model)) = (variable("ENSONIFY_LLM_URL"), variable("ENSONIFY_LLM_MODEL")) else {
        println!("skipped: ENSONIFY_LLM_URL and ENSONIFY_LLM_MODEL name no language model");
        return None;
    };
    let server = Server::at(&url).expect("an address");
    let key = Key::of_environment().expect("a key, or none");
    let settings = Settings { server, model, key, timeout: Duration::from_secs(300), max_tokens: 600 };
    Some(ModelDrafter::new(settings, held))
}

/// What a language model makes of a prompt.
fn asked(drafter: &mut ModelDrafter, known: &Known, typed: &str) -> Drafting {
    let prompt = Prompt::new(typed, Options::default());
    let by_rules = read(&prompt, known);
    let question = Asked { prompt: &prompt, known, read: &by_rules };
    let understood =
        drafter.read(question, &mut Vec::new(), &mut |wish| composed(wish, &prompt, known, "a language model"));
    match understood {
        Ok(understood) => Drafting::Recipe(understood.made.recipe),
        Err(NotUnderstood::Refused(refusal) | NotUnderstood::Unmade(refusal)) => Drafting::Refused(refusal.to_string()),
        Err(NotUnderstood::Model(fault)) => Drafting::Failed(fault.to_string()),
    }
}

/// Shows how a language model fares with all prompts.
fn shown(held: Held, title: &str) {
    let known = known();
    let Some(mut drafter) = model(held) else { return };
    let mut draft = |typed: &str| asked(&mut drafter, &known, typed);
    let files = [cases("prompts.yaml"), cases("prompts_nonsense.yaml"), half(Set::Dev)];
    for (name, cases) in ["the 39", "nonsense", "further prompts"].into_iter().zip(files) {
        let results = results(&cases, &mut draft);
        println!("{}{}", table(&format!("{name}, {title}"), &results), misses(&results));
    }
    println!("{}", table(&format!("held out, {title}"), &results(&half(Set::HeldOut), &mut draft)));
}

#[test]
#[ignore = "asks a language model: minutes to hours"]
fn with_a_language_model_held_to_the_prompt() {
    shown(Held::ToThePrompt, "a language model held to the prompt");
}

#[test]
#[ignore = "asks a language model: minutes to hours"]
fn with_a_language_model_alone() {
    shown(Held::ToTheFormAlone, "a language model alone");
}
