//! The sonar's section.

use super::asked::{Asked, assumed, joined};
use super::layout::Layout;
use super::page::Page;
use super::yaml::Yaml;
use crate::draft::wish::{Amount, Said};

/// A frequency this far from a device's own changes the width of its beams, a ratio.
const OTHER_FREQUENCY: f64 = 1.02;

pub(super) fn write(page: &mut Page, asked: &Asked, layout: &Layout) {
    let sonar = &asked.wish.sonar;
    page.blank();
    page.open(0, "sonar", "");
    let names = match &sonar.devices {
        Some(said) => Yaml::choice(said.value.iter().map(|name| Yaml::word(name))),
        None => Yaml::word(&layout.device.name),
    };
    let why = if sonar.devices.is_some() { layout.device_why.clone() } else { assumed(&layout.device_why) };
    page.set(2, "device", &names, &why);
    if let Some(said) = &sonar.frequency_khz {
        frequency(page, asked, layout, said);
    }
    if let Some(said) = &sonar.beams {
        page.set(2, "beams", &Yaml::whole(said.value.into()), &asked.why(&said.source));
    }
    if let Some(said) = &sonar.fov_deg {
        page.set(2, "azimuth_deg", &Yaml::amount(&said.value), &asked.why(&said.source));
    }
    range(page, asked, layout);
    mount(page, asked, layout);
}

/// The frequency, and the beam width that the same aperture has there.
fn frequency(page: &mut Page, asked: &Asked, layout: &Layout, said: &Said<Amount>) {
    let device = &layout.device;
    let is_its_own = said.value == Amount::Exactly(device.frequency_khz);
    let why = asked.why(&said.source);
    if is_its_own {
        page.note(2, &format!("{why}: the device's own"));
        return;
    }
    page.set(2, "frequency_khz", &Yaml::amount(&said.value), &why);
    let [low, high] = said.value.ends();
    let ratio = device.frequency_khz / (0.5 * (low + high));
    if ratio.max(1.0 / ratio) > OTHER_FREQUENCY {
        let width = (device.beam_width_deg * ratio * 100.0).round() / 100.0;
        let comment =
            assumed(&format!("the same aperture; {} degrees at {} kHz", device.beam_width_deg, device.frequency_khz));
        page.set(2, "beam_width_deg", &Yaml::number(width.clamp(0.05, 40.0)), &comment);
    }
}

fn range(page: &mut Page, asked: &Asked, layout: &Layout) {
    let sonar = &asked.wish.sonar;
    let end = |said: &Option<Said<Amount>>, own: f64| {
        said.as_ref().map_or(Yaml::number(own), |said| Yaml::amount(&said.value))
    };
    let value = Yaml::list([end(&sonar.least_range_m, layout.near_m), end(&sonar.most_range_m, layout.far_m)]);
    let said: Vec<String> =
        [&sonar.least_range_m, &sonar.most_range_m].into_iter().flatten().map(|said| asked.why(&said.source)).collect();
    let why = if said.is_empty() { assumed("to the farthest object and its shadow") } else { said.join(", ") };
    let why = if layout.placings.is_empty() && said.is_empty() { assumed("what lies in the beam") } else { why };
    page.set(2, "range_m", &value, &why);
}

fn mount(page: &mut Page, asked: &Asked, layout: &Layout) {
    let sonar = &asked.wish.sonar;
    let (pitch, pitch_why) = match &sonar.pitch_deg {
        Some(said) => (Yaml::amount(&said.value), asked.why(&said.source)),
        None => {
            let why = match layout.placings.is_empty() {
                true => "the beam meets the bottom in the middle of the range",
                false => "the objects lie in the middle of the beam",
            };
            (Yaml::number(layout.tilt_deg), assumed(why))
        }
    };
    let aside = layout.going.way.yaw_deg();
    let yaw = match &sonar.yaw_deg {
        Some(said) => Some((Yaml::amount(&said.value), asked.why(&said.source))),
        None if aside != 0.0 => Some((Yaml::number(aside), assumed("turned to the wall"))),
        None => None,
    };
    match yaw {
        None => page.set(2, "mount", &Yaml::map([("pitch_deg", pitch)]), &pitch_why),
        Some((yaw, why)) => {
            let value = Yaml::map([("pitch_deg", pitch), ("yaw_deg", yaw)]);
            page.set(2, "mount", &value, &joined([pitch_why, why]));
        }
    }
}
