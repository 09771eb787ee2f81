//! Numbers and words moved wherever they stand: in the recipe, in looks, in sweeps, in files below it.

use super::values::{in_looks, override_list};
use super::{Acts, Param};
use crate::draft::Problem;
use crate::draft::edit::act::{Act, number};
use crate::draft::edit::numbers::{self, Climb, Move, climbed};
use crate::draft::edit::subject::{Subject, Whose};
use crate::recipe::Node;
use crate::recipe::path::{item, steps, under};

/// Kinds of suspended matter, ever murkier.
pub(in crate::draft::edit) const TURBIDITY: [&str; 4] = ["clear", "coastal", "turbid", "very-turbid"];
/// Sediments, ever finer.
pub(in crate::draft::edit) const SEDIMENTS: [&str; 10] = [
    "rough-rock",
    "rock",
    "cobbles",
    "gravel",
    "coarse-sand",
    "medium-sand",
    "fine-sand",
    "very-fine-sand",
    "silt",
    "mud",
];
/// What a step is where a recipe has grains of its own.
const GRAINS: f64 = 3.0;

/// Every number of a parameter moved, wherever it stands.
pub(super) fn moved(subject: &Subject, param: Param, how: Move) -> Result<Acts, Problem> {
    let paths = param.paths(subject)?;
    paths.iter().try_fold(Acts::default(), |acts, path| {
        let change = |node: &Node, _: &mut Acts| {
            let moved = numbers::moved(node, how)?;
            Some(if param.is_count() { whole(&moved) } else { moved })
        };
        Ok(acts.with(everywhere(subject, path, param.name(), &change)?))
    })
}

/// The value at a path, moved.
pub(in crate::draft::edit) fn moved_at(subject: &Subject, path: &str, how: Move) -> Result<Node, Problem> {
    let there = subject.value(path).map(|(node, _)| node);
    there.and_then(|node| numbers::moved(node, how)).ok_or_else(|| {
        Problem::whole(format!("there is no number at `{path}`"), format!("say the whole value: --set {path}=…"))
    })
}

fn whole(node: &Node) -> Node {
    node.number().map_or_else(|| node.clone(), |value| number(value.round().max(1.0)))
}

/// What makes another value of one.
type Changing<'a> = &'a dyn Fn(&Node, &mut Acts) -> Option<Node>;

/// A value changed in the recipe, in each look that has its own, and in what it is swept over.
fn everywhere(subject: &Subject, path: &str, name: &str, change: Changing<'_>) -> Result<Acts, Problem> {
    let mut acts = Acts::default();
    let (looks, all) = in_looks(subject, path, &steps(path).unwrap_or_default());
    for look in &looks {
        acts = acts.with(changed(subject, look, name, change)?);
    }
    if let Some(swept) = subject.swept(path) {
        let count = subject.said(&swept).map_or(0, |(node, _)| node.items().len());
        for index in 0..count {
            acts = acts.with(changed(subject, &item(&swept, index), name, change)?);
        }
        return Ok(acts);
    }
    if all > 0 && looks.len() == all {
        return Ok(acts);
    }
    Ok(acts.with(changed(subject, path, name, change)?))
}

/// A value at one place changed.
pub(super) fn changed(subject: &Subject, path: &str, name: &str, change: Changing<'_>) -> Result<Acts, Problem> {
    let Some((node, whose)) = subject.value(path) else {
        let help = format!("say how much: `{name} 5`, or --set {path}=…");
        return Err(Problem::whole(format!("the recipe says no {name}, so there is nothing to change"), help));
    };
    if let Some(shared) = node.text().and_then(|text| text.strip_prefix('$')) {
        return named(subject, path, shared, name, change);
    }
    let mut acts = Acts::default();
    let Some(value) = change(node, &mut acts) else {
        let what = format!("{} at `{path}` is neither a number nor a distribution of numbers", node.describe());
        return Err(Problem::whole(what, format!("say the whole value: --set {path}=…")));
    };
    if value.json() == node.json() {
        return Ok(acts);
    }
    if whose == Whose::Included {
        acts = acts.note(format!("an included file says `{path}`; what stands here wins"));
    }
    override_list(subject, path, &steps(path).unwrap_or_default())?;
    Ok(acts.with(Acts::one(Act::set(path, value))))
}

/// A shared value changed where it has its name; only if nothing else refers to it.
fn named(subject: &Subject, path: &str, shared: &str, name: &str, change: Changing<'_>) -> Result<Acts, Problem> {
    let uses = subject.uses_of(shared);
    if uses > 1 {
        let what = format!("the {name} is `${shared}`, which stands at {uses} places");
        let help = format!("change all of them with --set let.{shared}=…, or this one with --set {path}=…");
        return Err(Problem::whole(what, help));
    }
    changed(subject, &under("let", shared), name, change)
        .map(|acts| acts.note(format!("`${shared}` stands for the {name}")))
}

/// Steps along the kinds of suspended matter.
pub(super) fn murkier(subject: &Subject, steps: i32) -> Result<Acts, Problem> {
    let path = "water.turbidity";
    ladder(subject, path, "turbidity", &TURBIDITY, steps)
        .map_err(|problem| Problem { help: format!("say which: {}", TURBIDITY.join(", ")), ..problem })
}

/// Steps along the sediments.
pub(super) fn muddier(subject: &Subject, steps: i32) -> Result<Acts, Problem> {
    super::bottom::there(subject)?;
    ladder(subject, "seabed.sediment", "sediment", &SEDIMENTS, steps)
}

fn ladder(subject: &Subject, path: &str, name: &str, ladder: &[&str], steps: i32) -> Result<Acts, Problem> {
    let change = |node: &Node, acts: &mut Acts| {
        if let Some(grains) = node.get("sediment").and_then(|grains| grains.get("concentration_kg_m3")) {
            let more = numbers::moved(grains, Move::Times(if steps > 0 { GRAINS } else { 1.0 / GRAINS }))?;
            let mut node = node.clone();
            node.put("sediment.concentration_kg_m3", more, &node.span.clone()).ok()?;
            return Some(node);
        }
        let mut climb = Climb::default();
        let value = climbed(node, ladder, steps, &mut climb)?;
        for word in climb.at_end {
            acts.notes.push(format!("`{word}` stays: nothing is beyond it for the {name}"));
        }
        Some(value)
    };
    everywhere(subject, path, name, &change)
}
