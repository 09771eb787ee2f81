//! The bottom's shape, and structures on it.

use super::Acts;
use super::shift::changed;
use super::values::{set, unset};
use crate::draft::Problem;
use crate::draft::edit::act::{Act, map, number, word};
use crate::draft::edit::numbers::{self, Move};
use crate::draft::edit::subject::Subject;
use crate::recipe::path::under;

/// Of a bottom that was flat, and shall be rougher: root mean square, metres.
const SLIGHTLY_ROUGH_M: f64 = 0.05;

/// Refuses where there is no bottom.
pub(super) fn there(subject: &Subject) -> Result<(), Problem> {
    match subject.said("seabed") {
        Some(_) => Ok(()),
        None => Err(Problem::whole("the recipe has no seabed", "say one: `a flat bottom of sand`")),
    }
}

/// Higher or lower shapes of the bottom.
pub(super) fn rougher(subject: &Subject, factor: f64) -> Result<Acts, Problem> {
    there(subject)?;
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
