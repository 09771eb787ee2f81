//! Requests for changes and the difference that a careful person would make: `edits.yaml`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ensonify::draft::edit::{Act, Revision, Subject, revise, understand};
use ensonify::draft::{Known, Options, Prompt};
use ensonify::recipe::Outside;
use ensonify::run::{Given, Project};
use serde::Deserialize;
use similar::{ChangeTag, TextDiff};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cases {
    /// Recipes besides those in `recipes`, by name.
    recipes: BTreeMap<String, String>,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    on: String,
    say: String,
    /// Lines that go and come, as in a unified difference.
    diff: Option<Vec<String>>,
    /// What the answer begins with where nothing is changed.
    refused: Option<String>,
}

fn cases() -> Cases {
    serde_yaml::from_str(include_str!("edits.yaml")).expect("edits.yaml")
}

fn recipes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes")
}

/// Where a case's recipe stands, and its text. Recipes of the cases lie in a folder of their own, so that they can include.
fn recipe(cases: &Cases, name: &str, folder: &Path) -> (PathBuf, String) {
    let Some(text) = cases.recipes.get(name) else {
        let path = recipes().join(format!("{name}.yaml"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        return (path, text);
    };
    (folder.join(format!("{name}.yaml")), text.clone())
}

/// What a request makes of a recipe: the new text, or why nothing.
fn edited(path: &Path, text: &str, say: &str, known: &Known) -> Result<String, String> {
    let subject = Subject::new(path, text, Outside::Refused).map_err(|error| error.to_string())?;
    let prompt = Prompt::new(say, Options::default());
    let understood = understand(&prompt, &subject, known).map_err(|refusal| refusal.to_string())?;
    let revision: Revision = revise(&subject, known, &understood.changes).map_err(|problem| problem.what)?;
    assert!(revision.done.iter().all(|done| done.value.iter().all(|act| !Act::path(act).is_empty())));
    Ok(revision.subject.text().to_owned())
}

fn difference(before: &str, after: &str) -> Vec<String> {
    let diff = TextDiff::from_lines(before, after);
    let sign = |tag| match tag {
        ChangeTag::Equal => None,
        ChangeTag::Delete => Some('-'),
        ChangeTag::Insert => Some('+'),
    };
    let lines = diff.iter_all_changes();
    lines
        .filter_map(|line| Some(format!("{}{}", sign(line.tag())?, line.value().trim_end_matches(['\n', '\r']))))
        .collect()
}

fn with_folder(test: impl Fn(&Cases, &Path, &Known)) {
    let cases = cases();
    let folder = tempfile::tempdir().unwrap();
    let starter = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs");
    let catalogs = folder.path().join("catalogs");
    std::fs::create_dir(&catalogs).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(starter.join("starter"), catalogs.join("starter")).unwrap();
    for (name, text) in &cases.recipes {
        std::fs::write(folder.path().join(format!("{name}.yaml")), text).unwrap();
    }
    let known = Known::open(&recipes(), &["starter".to_owned()]).expect("the starter catalog");
    test(&cases, folder.path(), &known);
}

#[test]
fn requests_make_the_difference_that_a_careful_person_would() {
    with_folder(|cases, folder, known| {
        let mut wrong = Vec::new();
        for case in &cases.cases {
            let (path, text) = recipe(cases, &case.on, folder);
            let found = edited(&path, &text, &case.say, known);
            let is_right = match (&found, &case.diff, &case.refused) {
                (Ok(after), Some(diff), None) => difference(&text, after) == *diff,
                (Err(why), None, Some(refused)) => why.starts_with(refused),
                _ => false,
            };
            if !is_right {
                let found = found.map(|after| difference(&text, &after).join("\n    "));
                wrong.push(format!(
                    "{} | {}\n    {}",
                    case.on,
                    case.say,
                    found.unwrap_or_else(|why| format!("refused: {why}"))
                ));
            }
        }
        assert!(cases.cases.len() >= 40, "{}", cases.cases.len());
        assert!(wrong.is_empty(), "{} of {} are otherwise:\n{}", wrong.len(), cases.cases.len(), wrong.join("\n"));
    });
}

#[cfg(unix)]
#[test]
fn changed_recipes_compile() {
    with_folder(|cases, folder, known| {
        for case in cases.cases.iter().filter(|case| case.diff.is_some() && case.refused.is_none()) {
            let (path, text) = recipe(cases, &case.on, folder);
            let after = edited(&path, &text, &case.say, known).unwrap_or_else(|why| panic!("{}: {why}", case.say));
            let given = Given { path: &path, sets: &[], outside: Outside::Refused };
            if let Err(error) = Project::load_text(&given, &after) {
                panic!("{} | {}: {error}", case.on, case.say);
            }
        }
    });
}

#[test]
fn other_line_ends_and_a_byte_order_mark_stay() {
    with_folder(|cases, folder, known| {
        for case in cases.cases.iter().filter(|case| case.on == "hover" && case.diff.is_some()) {
            let (path, text) = recipe(cases, &case.on, folder);
            let windows = format!("\u{feff}{}", text.replace('\n', "\r\n"));
            let plain = edited(&path, &text, &case.say, known).unwrap();
            let after = edited(&path, &windows, &case.say, known).unwrap();
            assert_eq!(after, format!("\u{feff}{}", plain.replace('\n', "\r\n")), "{}", case.say);
        }
    });
}
