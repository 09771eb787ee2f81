//! Requests and what they ask for.

use super::things::starter;
use super::*;
use crate::draft::Options;
use crate::draft::edit::revise;
use crate::recipe::Outside;

const RECIPE: &str = "\
ensonify: 1
seed: 7
scenes: 20
frames: 10

sonar:
  device: oculus-m1200d-lf
  range_m: [0.5, 10]
  mount: {pitch_deg: -20}

water:
  temperature_c: {uniform: [4, 22]}
  depth_m: 12

seabed:
  shape: ripples
  sediment: {choice: {silt: 1, gravel: 2}}

objects:
  - pick: {catalog: starter, uid: shipwreck}
  - pick: {catalog: starter, label: rock}
    count: {int: [1, 3]}
    pose: {rest: {within_m: 4}}
  - pick: {catalog: starter, uid: [oil-drum, oil-drum-open]}
    count: 2

trajectory:
  hover: {position_m: [-4, 0, 2]}
";

/// The lines that a request takes out and puts in.
fn edited(request: &str) -> String {
    let known = starter();
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes/test.yaml");
    let subject = Subject::new(&path, RECIPE, Outside::Refused).unwrap();
    let understood = match understand(&Prompt::new(request, Options::default()), &subject, &known) {
        Ok(understood) => understood,
        Err(refusal) => return format!("refused: {refusal}"),
    };
    let revision = match revise(&subject, &known, &understood.changes) {
        Ok(revision) => revision,
        Err(problem) => return format!("impossible: {}", problem.what),
    };
    let (old, new): (Vec<&str>, Vec<&str>) = (RECIPE.lines().collect(), revision.subject.text().lines().collect());
    let gone = old.iter().filter(|line| !new.contains(line)).map(|line| format!("-{line}"));
    let come = new.iter().filter(|line| !old.contains(line)).map(|line| format!("+{line}"));
    let unread = understood.unread.iter().map(|words| format!("?{}", &request[words.clone()]));
    gone.chain(come).chain(unread).collect::<Vec<_>>().join("|")
}

#[test]
fn requests_become_the_lines_that_a_careful_person_would_change() {
    let mut wrong = Vec::new();
    for case in include_str!("cases.txt").lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let (request, expected) = case.split_once(" => ").unwrap();
        let found = edited(request);
        if found != expected {
            wrong.push(format!("{request}\n   found {found}\n  wanted {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
