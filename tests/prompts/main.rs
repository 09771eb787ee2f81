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

use drafted::Drafted;
use expected::{Case, Set, cases, vocabulary};
use score::{Outcome, score};
use table::{Result, faults, fields, misses, share, table};

/// Share of the fields that are right, at least.
const ENOUGH: f64 = 0.9;

/// The same of prompts that nobody looked at.
const ENOUGH_HELD_OUT: f64 = 0.0;

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
fn results(cases: &[Case], draft: &dyn Fn(&str) -> std::result::Result<String, String>) -> Vec<Result> {
    let words = vocabulary();
    let result = |case: &Case| {
        let outcome = match draft(&case.prompt) {
            Ok(recipe) => checked(&recipe),
            Err(message) => Outcome::Refused(message),
        };
        Result::of(case, &outcome, score(case, &outcome, &words))
    };
    cases.iter().map(result).collect()
}

/// The further prompts of one half.
fn half(set: Set) -> Vec<Case> {
    let mut cases = cases("prompts_more.yaml");
    cases.retain(|case| case.set == Some(set));
    cases
}
