//! The list of objects: what is picked, how many, and its pose.

use super::asked::{Asked, assumed};
use super::layout::Layout;
use super::page::Page;
use super::placing::{Kind, Placing};
use super::pose::Posing;
use super::solve::is_at;
use super::structure::Structure;
use super::yaml::Yaml;
use crate::draft::Problem;
use crate::draft::wish::Count;

/// Refuses poses beside, on and against what is not in the scene.
pub(super) fn check(asked: &Asked, structure: Option<&Structure>, placings: &[Placing]) -> Result<(), Problem> {
    for placing in placings {
        let others = || placings.iter().map(|other| &*other.thing.label).filter(|label| *label != placing.thing.label);
        let Some(of) = refers_to(placing) else { continue };
        if others().any(|label| label == of)
            || structure.is_some_and(|s| s.kind.name() == of || s.kind.parts().contains(&of))
        {
            continue;
        }
        let source = placing.manner.words.last().copied().unwrap_or(&placing.thing.called.source);
        let what = format!("{}: there is no other {of} in the scene", placing.thing.label);
        return Err(asked.problem(source, what, format!("ask for a {of} too, or for another place")));
    }
    Ok(())
}

fn refers_to<'a>(placing: &'a Placing) -> Option<&'a str> {
    match placing.manner.kind {
        Kind::On(of) | Kind::Near { of, .. } => Some(of),
        Kind::Leaning(against) => against,
        Kind::Rest | Kind::Settle | Kind::Float { .. } | Kind::Heap | Kind::Row(_) => None,
    }
}

pub(super) fn write(page: &mut Page, asked: &Asked, layout: &Layout, notes: &mut Vec<String>) {
    if layout.placings.is_empty() {
        return;
    }
    page.blank();
    page.open(0, "objects", "");
    for placing in &layout.placings {
        let thing = placing.thing;
        page.item(2, "label", &Yaml::word(&thing.label), &asked.why(&thing.called.source));
        page.set(4, "pick", &pick(placing), &picked(placing));
        match placing.count {
            Count::Exactly(count) => page.set(4, "count", &Yaml::whole(count.into()), &placing.count_why),
            Count::Between(few, many) => {
                let ends = [few, many].map(|count| Yaml::whole(count.into()));
                page.set(4, "count", &Yaml::map([("int", Yaml::list(ends))]), &placing.count_why);
            }
        }
        if let Some(apart) = placing.manner.clear_m {
            page.set(4, "clear_m", &Yaml::amount(apart), "free water to any other object");
        } else if placing.manner.kind == Kind::Heap {
            page.set(4, "clear_m", &Yaml::number(0.0), &assumed("in a heap things touch"));
        }
        if layout
            .structure
            .as_ref()
            .is_some_and(|structure| structure.kind.is_long() && is_at(Some(structure), placing))
        {
            let frames = Yaml::list([Yaml::whole(layout.budget.frames / 2)]);
            let why = assumed("at a place of the wall that the frame in the middle sees");
            page.set(4, "in_view", &Yaml::map([("frames", frames)]), &why);
        }
        let pose = Posing { asked, layout, placing };
        let (value, why) = pose.pose(notes);
        page.set(4, "pose", &value, &why);
    }
}

/// The models.
fn pick(placing: &Placing) -> Yaml {
    let models = &placing.thing.models;
    let catalog = ("catalog", Yaml::word(&models.catalog));
    match &models.label {
        Some(label) if models.is_whole_label && placing.uids.len() == models.uids.len() => {
            Yaml::map([catalog, ("label", Yaml::word(label))])
        }
        _ => {
            let mut uids: Vec<Yaml> = placing.uids.iter().map(|uid| Yaml::word(uid)).collect();
            let value = if uids.len() == 1 { uids.remove(0) } else { Yaml::list(uids) };
            Yaml::map([catalog, ("uid", value)])
        }
    }
}

/// What is picked among, with sizes.
fn picked(placing: &Placing) -> String {
    let [least, most] = placing.bulk.longest_m.map(|size| (size * 100.0).round() / 100.0);
    let size = if least == most { format!("{most} m") } else { format!("{least} to {most} m") };
    let names: Vec<&str> = placing.uids.iter().take(4).map(String::as_str).collect();
    let more = if placing.uids.len() > names.len() { ", …" } else { "" };
    format!("{}{more}; {size}", names.join(", "))
}
