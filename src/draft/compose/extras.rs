//! What a recipe has only where somebody asks for it: a vehicle that sways, mirrors for sound, other files.

use super::asked::{Asked, assumed};
use super::layout::Layout;
use super::page::Page;
use super::yaml::Yaml;

/// How waves and current move the vehicle.
pub(super) fn vehicle(page: &mut Page, asked: &Asked) {
    let Some(said) = &asked.wish.path.sway else { return };
    let sway = said.value;
    // Drift to the sides is the path's, which `hover` alone has.
    let all = [
        ("roll_deg", sway.roll_deg),
        ("pitch_deg", sway.pitch_deg),
        ("yaw_deg", sway.yaw_deg),
        ("heave_m", sway.heave_m),
    ];
    let told: Vec<(&'static str, Yaml)> =
        all.into_iter().filter_map(|(key, value)| Some((key, Yaml::number(value?)))).collect();
    if !told.is_empty() {
        let value = Yaml::map([("attitude_noise", Yaml::map(told))]);
        page.set(0, "vehicle", &value, &asked.why(&said.source));
    }
}

/// The sea surface and a smooth floor.
pub(super) fn multipath(page: &mut Page, asked: &Asked, layout: &Layout) {
    let Some(said) = &asked.wish.multipath else { return };
    page.blank();
    page.open(0, "multipath", &asked.why(&said.source));
    for mirror in &said.value {
        match mirror.as_str() {
            "surface" => {
                let height = Yaml::map([("height_m", Yaml::number(layout.depth.least_m))]);
                page.set(2, "surface", &height, &assumed("over the bottom, as deep as the water is"));
            }
            "bottom" => page.set(2, "bottom", &Yaml::map([("height_m", Yaml::number(0.0))]), ""),
            _ => {}
        }
    }
}

/// Files besides what is always written.
pub(super) fn output(page: &mut Page, asked: &Asked) {
    let output = &asked.wish.output;
    let sources = [
        output.raw.as_ref().map(|said| &said.source),
        output.views.as_ref().map(|said| &said.source),
        output.pack.as_ref().map(|said| &said.source),
    ];
    let mut told: Vec<(&'static str, Yaml)> = Vec::new();
    if let Some(views) = &output.views {
        told.push(("views", Yaml::list(views.value.iter().map(|view| Yaml::word(view)))));
    }
    told.extend(output.raw.as_ref().map(|raw| ("raw", Yaml::word(&raw.value))));
    told.extend(output.pack.as_ref().map(|pack| ("pack", Yaml::word(&pack.value))));
    if !told.is_empty() {
        let why: Vec<String> = sources.into_iter().flatten().map(|source| asked.why(source)).collect();
        page.set(0, "output", &Yaml::map(told), &why.join(", "));
    }
}
