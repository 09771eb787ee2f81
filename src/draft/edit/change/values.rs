//! Values put at their places, and swept: in the recipe, over included files and defaults.

use super::{Acts, Param};
use crate::draft::Problem;
use crate::draft::edit::act::{Act, list, map, number, word};
use crate::draft::edit::numbers::rounded;
use crate::draft::edit::subject::{Subject, Whose};
use crate::draft::wish::Amount;
use crate::recipe::Node;
use crate::recipe::path::{Step, item, steps, under};

/// A value at a path: swept and shared values of it end.
pub(super) fn set(subject: &Subject, path: &str, value: Node) -> Result<Acts, Problem> {
    let steps = steps(path).map_err(|why| Problem::whole(format!("`{path}` is no path: {why}"), EXAMPLE))?;
    let mut acts = Acts::default();
    if let Some(swept) = subject.swept(path) {
        acts = acts.with(unswept(subject, &swept)).note(format!("`{path}` is swept no longer"));
    }
    let (looks, all) = in_looks(subject, path, &steps);
    if !looks.is_empty() {
        if looks.len() == all {
            let help = format!("say which look, with --set {}=…", looks[0]);
            return Err(Problem::whole(format!("every look has a `{path}` of its own"), help));
        }
        acts = acts.note(format!("looks that say `{path}` themselves keep theirs"));
    }
    if let Some(path) = inside_name(subject, &steps) {
        let help = format!("write it out at `{path}`, or change the name's value under `let`");
        return Err(Problem::whole(format!("`{path}` is a name of `let`"), help));
    }
    if let Some((node, _)) = subject.said(path)
        && let Some(name) = node.text().and_then(|text| text.strip_prefix('$'))
        && subject.uses_of(name) == 1
    {
        acts = acts.note(format!("`{name}` of `let` stands nowhere any more"));
    }
    override_list(subject, path, &steps)?;
    if let Some((_, Whose::Included)) = subject.said(path) {
        acts = acts.note(format!("an included file says `{path}`, too; what stands here wins"));
    }
    Ok(acts.with(Acts::one(Act::set(path, value))))
}

/// A value goes.
pub(super) fn unset(subject: &Subject, path: &str) -> Result<Acts, Problem> {
    match subject.said(path) {
        Some((_, Whose::Own)) => Ok(Acts::one(Act::Remove { path: path.to_owned() })),
        Some(_) => {
            Err(Problem::whole(format!("`{path}` stands in an included file"), "remove it there, or override it"))
        }
        None => Err(Problem::whole(format!("there is no `{path}`"), "name a path that is there")),
    }
}

const EXAMPLE: &str = "write a path such as sonar.range_m or objects[0].count";

/// An item of a list that an included file says cannot be overridden alone.
pub(super) fn override_list(subject: &Subject, path: &str, steps: &[Step]) -> Result<(), Problem> {
    let mut walked = String::new();
    for step in steps {
        if matches!(step, Step::Index(_)) && subject.own().at(&walked).is_none() {
            return match subject.value(&walked) {
                Some((_, Whose::Included)) => Err(Problem::whole(
                    format!("`{walked}` stands in an included file, and a list is taken whole"),
                    "change that file",
                )),
                _ => Err(Problem::whole(format!("there is no `{path}`"), format!("say the whole `{walked}`"))),
            };
        }
        walked = match step {
            Step::Key(key) => under(&walked, key),
            Step::Index(index) => item(&walked, *index),
        };
    }
    Ok(())
}

/// The value on the way to a path that is a name of `let`, if one is.
fn inside_name(subject: &Subject, steps: &[Step]) -> Option<String> {
    let mut walked = String::new();
    for step in &steps[..steps.len().saturating_sub(1)] {
        walked = match step {
            Step::Key(key) => under(&walked, key),
            Step::Index(index) => item(&walked, *index),
        };
        if subject.said(&walked).is_some_and(|(node, _)| node.text().is_some_and(|text| text.starts_with('$'))) {
            return Some(walked);
        }
    }
    None
}

/// Looks that say a path, and how many looks there are.
pub(super) fn in_looks(subject: &Subject, path: &str, steps: &[Step]) -> (Vec<String>, usize) {
    match steps.first() {
        Some(Step::Key(section)) if matches!(section.as_str(), "water" | "image") => subject.in_looks(path),
        _ => (Vec::new(), 0),
    }
}

/// A list of swept values goes, and the sweep with its last.
fn unswept(subject: &Subject, swept: &str) -> Acts {
    let mut path = swept.to_owned();
    for around in [swept.split_once('.').map_or("", |_| parent_of(swept)), "sweep"] {
        if subject.own().at(around).is_some_and(|node| node.entries().len() == 1) {
            path = around.to_owned();
        } else {
            break;
        }
    }
    Acts::one(Act::Remove { path })
}

/// `sweep.grid` of `sweep.grid["water.ph"]`.
fn parent_of(swept: &str) -> &'static str {
    if swept.starts_with("sweep.zip") { "sweep.zip" } else { "sweep.grid" }
}

/// An amount for a parameter.
pub(super) fn to(subject: &Subject, param: Param, amount: &Amount) -> Result<Acts, Problem> {
    if let Amount::Steps(first, last, count) = amount {
        return sweep(subject, param, &in_steps(*first, *last, *count));
    }
    let value = valued(param, amount);
    let paths = param.paths(subject)?;
    let only = paths.len() == 1;
    paths.iter().try_fold(Acts::default(), |acts, path| {
        let kept = subject.said(path).and_then(|(node, _)| node.get("per")).filter(|_| value.is_distribution());
        let value = match kept {
            Some(per) => with_per(&value, per),
            None => value.clone(),
        };
        let acts = acts.with(range(subject, path, &value).unwrap_or_else(|| set(subject, path, value))?);
        Ok(if only { acts } else { acts.note(format!("changed in each kind that may be drawn: `{path}`")) })
    })
}

/// A whole `range_m`, where the recipe says none.
fn range(subject: &Subject, path: &str, value: &Node) -> Option<Result<Acts, Problem>> {
    let list_path =
        path.strip_suffix("[1]").or_else(|| path.strip_suffix("[0]")).filter(|list| *list == "sonar.range_m")?;
    if subject.own().at(list_path).is_some() {
        return None;
    }
    let (there, _) = subject.value(list_path)?;
    let mut ends = there.items().to_vec();
    *ends.get_mut(usize::from(path.ends_with("[1]")))? = value.clone();
    Some(set(subject, list_path, list(ends)))
}

fn with_per(value: &Node, per: &Node) -> Node {
    let mut value = value.clone();
    if let crate::recipe::Kind::Map(entries) = &mut value.kind {
        let extra = map([("per", per.clone())]);
        entries.extend(extra.entries().iter().cloned());
    }
    value
}

fn valued(param: Param, amount: &Amount) -> Node {
    let one = |value: f64| number(if param.is_count() { value.round() } else { rounded(value) });
    match amount {
        Amount::Exactly(value) => one(*value),
        Amount::Between(low, high) => {
            let law = if param.is_count() { "int" } else { "uniform" };
            map([(law, list(vec![one(*low), one(*high)]))])
        }
        Amount::OneOf(values) => map([("choice", list(values.iter().map(|value| one(*value)).collect()))]),
        Amount::Steps(first, last, count) => {
            map([("choice", list(in_steps(*first, *last, *count).into_iter().map(one).collect()))])
        }
    }
}

/// Values in equal steps; five where nobody says how many.
pub(in crate::draft::edit) fn in_steps(first: f64, last: f64, count: Option<u32>) -> Vec<f64> {
    let count = count.unwrap_or(5).clamp(2, 100);
    (0..count).map(|step| rounded(first + (last - first) * f64::from(step) / f64::from(count - 1))).collect()
}

/// Words of which one is drawn.
pub(super) fn one_of(words: &[String]) -> Node {
    match words {
        [one] => word(one),
        several => map([("choice", list(several.iter().map(|text| word(text)).collect()))]),
    }
}

/// A parameter in steps, every one a variant.
pub(super) fn sweep(subject: &Subject, param: Param, values: &[f64]) -> Result<Acts, Problem> {
    let values = list(values.iter().map(|value| number(rounded(*value))).collect());
    let paths = param.paths(subject)?;
    let [path] = &paths[..] else {
        let what = format!("the {} stands at several places: {}", param.name(), paths.join(", "));
        return Err(Problem::whole(what, "sweep one of them with --set sweep={grid: {PATH: [VALUE, VALUE]}}"));
    };
    swept(subject, path, values)
}

/// A word in steps.
pub(super) fn sweep_words(subject: &Subject, path: &str, words: &[String]) -> Result<Acts, Problem> {
    swept(subject, path, list(words.iter().map(|text| word(text)).collect()))
}

fn swept(subject: &Subject, path: &str, values: Node) -> Result<Acts, Problem> {
    let section = path.split(['.', '[']).next().unwrap_or_default();
    if !crate::plan::is_swept(section) {
        let what = format!("`{section}` cannot be swept");
        return Err(Problem::whole(what, "sweep what differs from frame to frame, such as water.temperature_c"));
    }
    let (looks, _) = in_looks(subject, path, &steps(path).unwrap_or_default());
    if let Some(look) = looks.first() {
        return Err(Problem::whole(format!("looks say `{path}`, too"), format!("remove `{look}` first")));
    }
    // A place that is swept must be there: items of lists are.
    override_list(subject, path, &steps(path).unwrap_or_default())?;
    let place = subject.swept(path).unwrap_or_else(|| under("sweep.grid", path));
    Ok(Acts::one(Act::set(place, values)))
}
