//! The water's section.

use super::asked::Asked;
use super::layout::Layout;
use super::page::Page;
use super::yaml::Yaml;

pub(super) fn write(page: &mut Page, asked: &Asked, layout: &Layout) {
    let water = &asked.wish.water;
    let mut lines: Vec<(&'static str, Yaml, String)> = Vec::new();
    if let Some(depth) = &layout.depth.written {
        lines.push(("depth_m", Yaml::amount(&depth.amount), depth.why.clone()));
    }
    let others = [("temperature_c", &water.temperature_c), ("salinity_ppt", &water.salinity_ppt), ("ph", &water.ph)];
    for (key, said) in others {
        if let Some(said) = said {
            lines.push((key, Yaml::amount(&said.value), asked.why(&said.source)));
        }
    }
    if let Some(said) = water.turbidity.as_ref().filter(|said| !said.value.is_empty()) {
        let kinds = Yaml::choice(said.value.iter().map(|kind| Yaml::word(kind)));
        lines.push(("turbidity", kinds, asked.why(&said.source)));
    }
    if lines.is_empty() {
        return;
    }
    page.blank();
    page.open(0, "water", "");
    for (key, value, why) in lines {
        page.set(2, key, &value, &why);
    }
}
