//! What came out, for people: by kind of prompt, and what was missed.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::expected::{Case, Kind};
use crate::score::{Mark, Outcome};

/// How one prompt fared.
pub struct Result {
    pub prompt: String,
    pub kind: Kind,
    pub marks: Vec<Mark>,
    /// Why what came out is neither a valid recipe nor a clear refusal.
    pub fault: Option<String>,
}

impl Result {
    pub fn of(case: &Case, outcome: &Outcome, marks: Vec<Mark>) -> Self {
        let fault = match outcome {
            Outcome::Drafted(_) => None,
            Outcome::Refused(message) if message.contains("help: ") => None,
            Outcome::Refused(message) => Some(format!("a refusal without help: {message}")),
            Outcome::Invalid(fault) => Some(fault.clone()),
        };
        Self { prompt: case.prompt.clone(), kind: case.kind, marks, fault }
    }

    fn right(&self) -> usize {
        self.marks.iter().filter(|mark| mark.right).count()
    }
}

/// Fields that are right, and all.
pub fn fields(results: &[Result]) -> (usize, usize) {
    (results.iter().map(Result::right).sum(), results.iter().map(|result| result.marks.len()).sum())
}

/// Prompts that became neither a valid recipe nor a clear refusal.
pub fn faults(results: &[Result]) -> usize {
    results.iter().filter(|result| result.fault.is_some()).count()
}

pub fn share((right, of): (usize, usize)) -> f64 {
    right as f64 / of.max(1) as f64
}

/// A line for each kind of prompt, and one for all.
pub fn table(title: &str, results: &[Result]) -> String {
    let mut kinds: BTreeMap<Kind, Vec<&Result>> = BTreeMap::new();
    results.iter().for_each(|result| kinds.entry(result.kind).or_default().push(result));
    let mut out = format!(
        "{title}\n  {:10} {:>7} {:>10} {:>9} {:>6}  {:>5}\n",
        "kind", "prompts", "all right", "fields", "share", "valid"
    );
    let rows = kinds.into_iter().map(|(kind, results)| (format!("{kind:?}").to_lowercase(), results));
    for (name, results) in rows.chain([("together".to_owned(), results.iter().collect())]) {
        let whole = results.iter().filter(|result| result.right() == result.marks.len()).count();
        let valid = results.iter().filter(|result| result.fault.is_none()).count();
        let right: usize = results.iter().map(|result| result.right()).sum();
        let of: usize = results.iter().map(|result| result.marks.len()).sum();
        let share = 100.0 * share((right, of));
        let fields = format!("{right}/{of}");
        let _ = writeln!(out, "  {name:10} {:7} {whole:10} {fields:>9} {share:5.1}%  {valid:5}", results.len());
    }
    out
}

/// Everything that is not as expected.
pub fn misses(results: &[Result]) -> String {
    let mut out = String::new();
    for result in results {
        let missed: Vec<&Mark> = result.marks.iter().filter(|mark| !mark.right).collect();
        if missed.is_empty() && result.fault.is_none() {
            continue;
        }
        let _ = writeln!(out, "- {}", on_a_line(&result.prompt));
        if let Some(fault) = &result.fault {
            let _ = writeln!(out, "    neither valid nor clearly refused: {}", on_a_line(fault));
        }
        // A draft that is none misses every field for the same reason.
        let why = missed.first().map(|mark| &mark.found);
        if missed.len() > 1 && missed.iter().all(|mark| Some(&mark.found) == why) {
            let fields: Vec<&str> = missed.iter().map(|mark| mark.field.as_str()).collect();
            let why = why.filter(|why| result.fault.as_ref() != Some(*why)).map_or(String::new(), |why| on_a_line(why));
            let _ = writeln!(out, "    {} fields ({}): {why}", fields.len(), fields.join(", "));
            continue;
        }
        for Mark { field, expected, found, .. } in missed {
            let _ = writeln!(out, "    {field}: expected {expected}, found {}", on_a_line(found));
        }
    }
    out
}

fn on_a_line(text: &str) -> String {
    text.replace('\n', " ⏎ ")
}
