//! Changes of numbers and words wherever they stand: in the recipe, in looks, in sweeps, in files below it.

use super::{Acts, Param};
use crate::draft::Problem;
use crate::draft::edit::act::{Act, list, map, number, word};
use crate::draft::edit::numbers::{self, Climb, Move, climbed, rounded};
use crate::draft::edit::subject::{Subject, Whose};
use crate::draft::wish::Amount;
use crate::recipe::Node;
use crate::recipe::path::{Step, item, steps, under};

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
/// Of a bottom that was flat, and shall be rougher: root mean square, metres.
const SLIGHTLY_ROUGH_M: f64 = 0.05;

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
fn override_list(subject: &Subject, path: &str, steps: &[Step]) -> Result<(), Problem> {
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
fn in_looks(subject: &Subject, path: &str, steps: &[Step]) -> (Vec<String>, usize) {
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
fn changed(subject: &Subject, path: &str, name: &str, change: Changing<'_>) -> Result<Acts, Problem> {
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
    bottom(subject)?;
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
            acts.notes.push(format!("`{word}` is the end of the {name}s that there are"));
        }
        Some(value)
    };
    everywhere(subject, path, name, &change)
}

fn bottom(subject: &Subject) -> Result<(), Problem> {
    match subject.said("seabed") {
        Some(_) => Ok(()),
        None => Err(Problem::whole("the recipe has no seabed", "say one: `a flat bottom of sand`")),
    }
}

/// Higher or lower shapes of the bottom.
pub(super) fn rougher(subject: &Subject, factor: f64) -> Result<Acts, Problem> {
    bottom(subject)?;
    let kinds = subject.kinds("seabed.shape");
    if kinds.is_empty() {
        let rough = map([("fractal", map([("rms_m", number(SLIGHTLY_ROUGH_M))]))]);
        return if factor > 1.0 { set(subject, "seabed.shape", rough) } else { Ok(Acts::default().note(FLAT_ALREADY)) };
    }
    kinds
        .iter()
        .try_fold(Acts::default(), |acts, (path, kind)| Ok(acts.with(one_rougher(subject, path, kind, factor)?)))
}

const FLAT_ALREADY: &str = "the bottom is flat already";

fn one_rougher(subject: &Subject, path: &str, kind: &str, factor: f64) -> Result<Acts, Problem> {
    let height = match kind {
        "ripples" | "sand-waves" => "height_m",
        "fractal" => "rms_m",
        "reef" => "relief_m",
        "trench" | "pipeline-trench" => "depth_m",
        "rock-field" => "per_100_m2",
        "rubble" => "cover",
        "slope" => "rms_m",
        "flat" if factor < 1.0 => return Ok(Acts::default().note(FLAT_ALREADY)),
        "flat" => {
            let around = path.strip_suffix(".flat").unwrap_or(path);
            let rough = map([("fractal", map([("rms_m", number(SLIGHTLY_ROUGH_M))]))]);
            return Ok(Acts::one(Act::set(around, rough)));
        }
        _ => {
            let what = format!("a `{kind}` has no height that could be changed");
            return Err(Problem::whole(what, "choose another shape, such as ripples"));
        }
    };
    let place = under(path, height);
    if subject.value(&place).is_some() {
        return changed(subject, &place, "height", &|node, _| numbers::moved(node, Move::Times(factor)));
    }
    let usual = crate::recipe::Recipe::parse("usual", &format!("seabed: {{shape: {kind}}}")).ok();
    let usual = usual.and_then(|recipe| recipe.completed().at(&format!("seabed.shape.{kind}.{height}")).cloned());
    let value = usual.and_then(|node| numbers::moved(&node, Move::Times(factor)));
    let value =
        value.ok_or_else(|| Problem::whole(format!("a `{kind}` says no height"), format!("--set {place}=…")))?;
    Ok(Acts::one(Act::set(place, value)))
}

/// A shape for the bottom.
pub(super) fn shape(subject: &Subject, kind: &str) -> Result<Acts, Problem> {
    if subject.kinds("seabed.shape").iter().all(|(_, there)| there == kind) && !subject.kinds("seabed.shape").is_empty()
    {
        return Ok(Acts::default().note(format!("the bottom is {kind} already")));
    }
    set(subject, "seabed.shape", word(kind))
}

/// A structure, or none.
pub(super) fn structure(subject: &Subject, kind: Option<&str>) -> Result<Acts, Problem> {
    match kind {
        Some(kind) if subject.kinds("environment.kind").iter().any(|(_, there)| there == kind) => {
            Ok(Acts::default().note(format!("there is a {kind} already")))
        }
        Some(kind) => set(subject, "environment.kind", word(kind)),
        None if subject.said("environment").is_some() => unset(subject, "environment"),
        None => Err(Problem::whole("there is no structure in the recipe", "nothing has to be removed")),
    }
}

/// So many frames in all: scenes as they are said, where that can be.
pub(super) fn images(subject: &Subject, images: u64) -> Result<Acts, Problem> {
    let variants = subject.variants() as u64;
    let each = images.div_ceil(variants).max(1);
    let frames = subject.value("frames").and_then(|(node, _)| node.number()).unwrap_or(10.0).max(1.0) as u64;
    // The number of frames nearest to what is said that divides them; a prime number of images has one scene more.
    let divides = (1..=each.min(10_000)).filter(|frames| each.is_multiple_of(*frames));
    let best = divides.min_by_key(|count| count.abs_diff(frames)).unwrap_or(1);
    let near = best * 2 >= frames && best <= frames * 2;
    let frames_now = if near { best } else { frames.min(each) };
    let scenes = each.div_ceil(frames_now);
    let made = scenes * frames_now * variants;
    let acts = set(subject, "scenes", number(scenes as f64))?;
    let acts = if frames_now == frames { acts } else { acts.with(set(subject, "frames", number(frames_now as f64))?) };
    Ok(match made == images {
        true => acts,
        false => {
            acts.note(format!("{made} images in all: {variants} variants of {scenes} scenes of {frames_now} frames"))
        }
    })
}

/// Shares of training, validation and test.
pub(super) fn splits(subject: &Subject, shares: [f64; 3]) -> Result<Acts, Problem> {
    let names = ["train", "val", "test"];
    if subject.said("splits").is_some() {
        let mut acts = Acts::default();
        for (name, share) in names.into_iter().zip(shares) {
            acts = acts.with(set(subject, &under("splits", name), number(rounded(share)))?);
        }
        return Ok(acts);
    }
    let entries = names.into_iter().zip(shares).map(|(name, share)| (name, number(rounded(share))));
    set(subject, "splits", map(entries))
}
