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

/// Runs the program in a folder: exit code, standard output, standard error.
fn program(folder: &Path, arguments: &[&str], input: &str) -> (i32, String, String) {
    use std::io::Write as _;
    use std::process::{Command, Stdio};
    let mut child = Command::new(env!("CARGO_BIN_EXE_ensonify"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    child.stdin.take().expect("piped").write_all(input.as_bytes()).expect("it reads");
    let out = child.wait_with_output().expect("it ends");
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    (out.status.code().unwrap_or(-1), text(out.stdout), text(out.stderr))
}

#[cfg(unix)]
#[test]
fn nothing_is_written_without_a_yes_and_undo_gives_the_same_bytes() {
    with_folder(|cases, folder, _| {
        let path = folder.join("hover.yaml");
        let before = format!("\u{feff}{}", cases.recipes["hover"].replace('\n', "\r\n"));
        std::fs::write(&path, &before).unwrap();
        let read = || std::fs::read_to_string(&path).unwrap();
        let (code, out, err) = program(folder, &["edit", "hover.yaml", "range 15 m"], "");
        assert_eq!((code, read() == before), (0, true), "{err}");
        assert!(out.contains("+  range_m: [0.5, 15]") && err.contains("--yes"), "{out}{err}");
        assert_eq!(program(folder, &["edit", "hover.yaml", "range 15 m", "--yes"], "").0, 0);
        let after = read();
        assert_eq!(after, before.replace("[0.5, 10]", "[0.5, 15]"));
        assert_eq!(program(folder, &["edit", "hover.yaml", "--set", "frames=5", "-y"], "").0, 0);
        assert_eq!(program(folder, &["edit", "hover.yaml", "--undo"], "").0, 0);
        assert_eq!(read(), after);
        assert_eq!(program(folder, &["edit", "hover.yaml", "--undo"], "").0, 0);
        assert_eq!(read(), before);
        assert_eq!(program(folder, &["edit", "hover.yaml", "--redo"], "").0, 0);
        assert_eq!(read(), after);
    });
}

#[cfg(unix)]
#[test]
fn what_would_not_run_is_not_written() {
    with_folder(|_, folder, _| {
        let path = folder.join("hover.yaml");
        let before = std::fs::read(&path).unwrap();
        for arguments in [
            &["edit", "hover.yaml", "--set", "water.salinity_ppt=-5", "--yes"][..],
            &["edit", "hover.yaml", "--set", "water.wetness=5", "--yes"],
            &["edit", "hover.yaml", "add a unicorn", "--yes"],
            &["edit", "hover.yaml", "tell me a joke", "--yes"],
            &["edit", "nothing.yaml", "range 15 m", "--yes"],
        ] {
            let (code, _, err) = program(folder, arguments, "");
            assert_eq!((code, std::fs::read(&path).unwrap() == before), (2, true), "{arguments:?}: {err}");
            assert!(err.contains("help:") || err.contains("no such file"), "{arguments:?}: {err}");
        }
    });
}

#[cfg(unix)]
#[test]
fn a_conversation_through_a_pipe() {
    with_folder(|cases, folder, _| {
        let path = folder.join("hover.yaml");
        let lines = "make the water murkier\nundo\nredo\nrange 15 m\nshow\n";
        let (code, out, err) = program(folder, &["chat", "hover.yaml", "--no-preview"], lines);
        assert_eq!(code, 0, "{err}");
        let expected = cases.recipes["hover"]
            .replace("[0.5, 10]", "[0.5, 15]")
            .replace("  depth_m: 12\n", "  depth_m: 12\n  turbidity: coastal\n");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), expected);
        assert!(out.ends_with(&expected), "{out}");
        let (code, _, err) = program(folder, &["chat", "hover.yaml", "--no-preview"], "range 12 m\nadd a unicorn\n");
        assert_eq!(code, 2, "{err}");
        assert!(std::fs::read_to_string(&path).unwrap().contains("[0.5, 12]"));
        let first = "two tires on mud at 10 m depth\nmake the water murkier\n";
        let (code, _, err) = program(folder, &["chat", "new.yaml", "--no-preview"], first);
        assert_eq!(code, 0, "{err}");
        assert!(std::fs::read_to_string(folder.join("new.yaml")).unwrap().contains("tire"));
    });
}
