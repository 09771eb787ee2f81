//! Looks: pictures of the same echoes under other water, other noise, or by another model.

use super::asked::Asked;
use super::page::Page;
use super::yaml::Yaml;
use crate::draft::wish::LookChange;

/// Noise of the `deepsonar` chain as usual, in intensity at the farthest range.
const NOISE_SIGMA: f64 = 0.005;
/// Noise of the electronics as usual, dB, and how much a tenfold noise lifts it: below that images at short range show none.
const NOISE_FIGURE_DB: [f64; 2] = [5.0, 40.0];
/// Intensity that the chain shows white: of its default of 0.1 the bottom of most scenes has but a tenth.
const WHITE: f64 = 0.03;
/// Speckle that looks the same as the usual noise among looks of other speckle.
const NOISE_AS_SPECKLE: f64 = 0.5;
/// Most that a receiver may have, dB.
const MOST_FIGURE_DB: f64 = 60.0;

pub(super) fn write(page: &mut Page, asked: &Asked, notes: &mut Vec<String>) {
    let looks = &asked.wish.looks;
    if looks.is_empty() {
        return;
    }
    let speckled = looks
        .iter()
        .flat_map(|said| &said.value.changes)
        .any(|change| matches!(change, LookChange::Speckle(strength) if *strength != 1.0));
    page.blank();
    if speckled {
        notes.push(
            "speckle of another strength is what the `deepsonar` model makes: these looks are by it, linear and without the \
             physical model's beams; `physical` has full speckle"
                .to_owned(),
        );
    }
    page.open(0, "looks", "several pictures of the same echoes: labels are shared");
    for said in looks {
        let changes = &said.value.changes;
        let mut entries = vec![("name", Yaml::word(&said.value.name))];
        let water = water(changes);
        if !water.is_empty() {
            entries.push(("water", Yaml::map(water)));
        }
        if let Some(model) = model(changes, speckled) {
            entries.push(("image", Yaml::map([("model", model)])));
        }
        page.flow_item(2, &Yaml::map(entries), &asked.why(&said.source));
    }
}

fn water(changes: &[LookChange]) -> Vec<(&'static str, Yaml)> {
    let entry = |change: &LookChange| match change {
        LookChange::Turbidity(kind) => Some(("turbidity", Yaml::word(kind))),
        LookChange::Temperature(degrees) => Some(("temperature_c", Yaml::number(*degrees))),
        LookChange::Speckle(_) | LookChange::Noise(_) | LookChange::Model(_) => None,
    };
    changes.iter().filter_map(entry).collect()
}

/// The image model of a look; none where it is as usual.
fn model(changes: &[LookChange], speckled: bool) -> Option<Yaml> {
    let named = changes.iter().find_map(|change| match change {
        LookChange::Model(name) => Some(name.as_str()),
        _ => None,
    });
    let number = |of: fn(&LookChange) -> Option<f64>| changes.iter().rev().find_map(of);
    let speckle = number(|change| if let LookChange::Speckle(strength) = change { Some(*strength) } else { None });
    let noise = number(|change| if let LookChange::Noise(strength) = change { Some(*strength) } else { None });
    match named {
        Some("holoocean") => {
            let mut entries = Vec::new();
            entries.extend(speckle.map(|strength| ("mult_sigma", Yaml::number(0.2 * strength.max(0.0)))));
            entries.extend(noise.map(|strength| ("add_sigma", Yaml::number(0.15 * strength.max(0.0)))));
            Some(Yaml::kind("holoocean", entries))
        }
        Some("physical") => Some(physical(noise)).flatten().or_else(|| Some(Yaml::word("physical"))),
        Some(_) => Some(deepsonar(speckle, noise)),
        // Beside looks of other speckle, noise is meant to be seen as they are.
        None if speckled => {
            let as_speckle = noise.map(|noise| (NOISE_AS_SPECKLE * noise).min(1.0));
            Some(deepsonar(speckle.or(as_speckle), noise))
        }
        None => physical(noise),
    }
}

fn deepsonar(speckle: Option<f64>, noise: Option<f64>) -> Yaml {
    let sigma = speckle.unwrap_or(1.0).clamp(0.0, 1.0);
    // Without speckle nobody means noise.
    let noise = noise.unwrap_or(if sigma == 0.0 { 0.0 } else { 1.0 }).clamp(0.0, 200.0);
    let entries = [("speckle_sigma", sigma), ("noise_sigma", NOISE_SIGMA * noise), ("white", WHITE)];
    Yaml::kind("deepsonar", entries.map(|(key, value)| (key, Yaml::number(value))))
}

fn physical(noise: Option<f64>) -> Option<Yaml> {
    let noise = noise.filter(|noise| *noise != 1.0)?;
    let [usual, decade] = NOISE_FIGURE_DB;
    let lifted = usual + decade * crate::math::real::log10(noise.max(1e-9));
    let figure = if noise <= 0.0 { 0.0 } else { lifted.round().clamp(0.0, MOST_FIGURE_DB) };
    let receiver = Yaml::map([("noise_figure_db", Yaml::number(figure))]);
    Some(Yaml::kind("physical", [("receiver", receiver)]))
}
