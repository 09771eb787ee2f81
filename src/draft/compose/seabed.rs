//! The seabed's section.

use super::asked::{Asked, assumed};
use super::layout::Layout;
use super::page::Page;
use super::structure::Kind;
use super::yaml::Yaml;
use crate::draft::wish::{Amount, Said};

/// Sediments where nobody says one, each as likely.
const SEDIMENTS: [&str; 3] = ["silt", "fine-sand", "medium-sand"];
/// What is drawn anew for each scene where it is not said: a shape's parameter, least and most.
const DRAWN: [(&str, &str, [f64; 2]); 8] = [
    ("fractal", "rms_m", [0.02, 0.08]),
    ("ripples", "wavelength_m", [0.4, 0.9]),
    ("ripples", "height_m", [0.02, 0.06]),
    ("sand-waves", "wavelength_m", [5.0, 9.0]),
    ("sand-waves", "height_m", [0.2, 0.5]),
    ("rock-field", "per_100_m2", [6.0, 16.0]),
    ("reef", "relief_m", [0.5, 1.2]),
    ("reef", "share", [0.15, 0.35]),
];
/// Wave that cells of an eighth of a metre show: the least bumps of uneven ground need such cells.
const BUMP_M: f64 = 0.75;
/// Widest cell that shows those bumps, metres, and bumps over it where cells have to be wider.
const BUMP_CELL_M: f64 = 0.125;
const BUMP_CELLS: f64 = 2.5;
/// Shapes with a direction.
const DIRECTED: [&str; 4] = ["ripples", "sand-waves", "slope", "trench"];
/// Keys of the height and of the distance from crest to crest of each shape.
const HEIGHTS: [(&str, &str); 8] = [
    ("fractal", "rms_m"),
    ("ripples", "height_m"),
    ("sand-waves", "height_m"),
    ("reef", "relief_m"),
    ("trench", "depth_m"),
    ("pipeline-trench", "depth_m"),
    ("slope", "rms_m"),
    ("rock-field", "rms_m"),
];
const LENGTHS: [(&str, &str); 4] =
    [("fractal", "longest_m"), ("ripples", "wavelength_m"), ("sand-waves", "wavelength_m"), ("trench", "spacing_m")];
/// A height from trough to crest over its root mean square, of random ground about 4, of waves less.
const CREST_OVER_RMS: f64 = 4.0;

/// The shape that was said, or suits.
pub(super) fn shape<'a>(asked: &'a Asked) -> &'a str {
    let seabed = &asked.wish.seabed;
    match &seabed.shape {
        Some(said) => &said.value,
        None if seabed.slope_deg.is_some() => "slope",
        None if seabed.wavelength_m.is_some() => "ripples",
        None => "fractal",
    }
}

/// Shortest wave that cells must show, metres.
pub(super) fn wave_m(asked: &Asked) -> Option<f64> {
    let said = asked.wish.seabed.wavelength_m.as_ref().map(|said| said.value.ends()[0]);
    match shape(asked) {
        "ripples" => Some(said.unwrap_or(0.4)),
        "sand-waves" => Some(0.5),
        "flat" | "height-map" => said,
        // Ground has bumps down to 0.25 m, three cells of an eighth.
        _ => Some(said.map_or(BUMP_M, |wave| wave.min(BUMP_M))),
    }
}

/// Whether there is a bottom to write: a tank has its own.
pub(super) fn is_there(asked: &Asked, layout: &Layout) -> bool {
    let seabed = &asked.wish.seabed;
    let tank = layout.structure.as_ref().is_some_and(|structure| structure.kind == Kind::Tank);
    !tank || seabed.shape.is_some() || seabed.sediments.is_some() || seabed.slope_deg.is_some()
}

pub(super) fn write(page: &mut Page, asked: &Asked, layout: &Layout) {
    if !is_there(asked, layout) {
        return;
    }
    let seabed = &asked.wish.seabed;
    page.blank();
    page.open(0, "seabed", "");
    page.set(2, "extent_m", &Yaml::number(layout.extent_m), &assumed("wider than the sonar sees"));
    page.set(2, "cell_m", &Yaml::number(layout.cell_m), &assumed("finer than the smallest object and wave"));
    if let Some(fine) = crate::draft::infer::ground::fine_m(layout.extent_m) {
        page.set(2, "fine_m", &Yaml::number(fine), &assumed("cells grow outside of the middle"));
    }
    let (value, why) = shape_of(asked, layout.cell_m);
    page.set(2, "shape", &value, &why);
    let (sediments, why) = match &seabed.sediments {
        Some(said) if !said.value.is_empty() => {
            (Yaml::choice(said.value.iter().map(|name| Yaml::word(name))), asked.why(&said.source))
        }
        _ => (Yaml::choice(SEDIMENTS.map(Yaml::word)), assumed("soft ground of several kinds")),
    };
    page.set(2, "sediment", &sediments, &why);
}

/// The shape with its parameters, as `{ripples: {…}}`.
fn shape_of(asked: &Asked, cell_m: f64) -> (Yaml, String) {
    let seabed = &asked.wish.seabed;
    let name = shape(asked);
    let mut reasons = Vec::new();
    match &seabed.shape {
        Some(said) => reasons.push(asked.why(&said.source)),
        None if seabed.slope_deg.is_none() && seabed.wavelength_m.is_none() => reasons.push(assumed("gently uneven")),
        None => {}
    }
    let mut entries: Vec<(&'static str, Yaml)> = Vec::new();
    let mut say = |key: &'static str, said: &Said<Amount>, value: Yaml| {
        reasons.push(asked.why(&said.source));
        entries.push((key, value));
    };
    if let Some(said) = seabed.slope_deg.as_ref().filter(|_| name == "slope") {
        say("angle_deg", said, Yaml::amount(&said.value));
    }
    if let (Some(said), Some(key)) = (&seabed.wavelength_m, key_of(&LENGTHS, name)) {
        say(key, said, Yaml::amount(&said.value));
    }
    if let (Some(said), Some(key)) = (&seabed.height_m, key_of(&HEIGHTS, name)) {
        let factor = if key == "rms_m" { 1.0 / CREST_OVER_RMS } else { 1.0 };
        say(key, said, Yaml::amount(&said.value.scaled(factor)));
    }
    for (_, key, [low, high]) in DRAWN.iter().filter(|(shape, ..)| *shape == name) {
        if !entries.iter().any(|(said, _)| said == key) {
            entries.push((key, Yaml::uniform(*low, *high)));
        }
    }
    if name == "fractal" && cell_m > BUMP_CELL_M {
        entries.push(("shortest_m", Yaml::number((BUMP_CELLS * cell_m * 100.0).ceil() / 100.0)));
    }
    if DIRECTED.contains(&name) {
        entries.push(("direction_deg", Yaml::uniform(0.0, 360.0)));
    }
    let reason = reasons.join(", ");
    (if entries.is_empty() { Yaml::word(name) } else { Yaml::kind(name, entries) }, reason)
}

fn key_of(keys: &[(&str, &'static str)], shape: &str) -> Option<&'static str> {
    keys.iter().find(|(name, _)| *name == shape).map(|(_, key)| *key)
}
