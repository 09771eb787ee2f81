//! The section of the structure.

use super::asked::assumed;
use super::layout::Layout;
use super::page::Page;
use super::structure::{Kind, Structure};
use super::way::Way;
use super::yaml::Yaml;

/// Width of a pier's deck, of a harbour from quay to quay, and from the origin to a dam, metres, where nothing is said.
pub(super) const PIER_WIDTH_M: f64 = 6.0;
pub(super) const HARBOUR_WIDTH_M: f64 = 24.0;
pub(super) const DAM_DISTANCE_M: f64 = 8.0;
/// Length of a pier, a dam and a harbour, metres.
const LENGTHS_M: [f64; 3] = [24.0, 40.0, 44.0];
/// Of decks and walls over the water, metres.
const FREEBOARD_M: f64 = 1.0;
/// Diameter of a net pen, metres.
const PEN_M: f64 = 14.0;
/// Diameters of pipes, metres, where none is said.
const PIPES_M: [f64; 2] = [0.4, 0.8];

pub(super) fn write(page: &mut Page, layout: &Layout) {
    let Some(structure) = &layout.structure else { return };
    page.blank();
    page.open(0, "environment", &structure.why);
    let parts = structure.kind.parts().join(", ");
    match layout.labelled {
        true => page.set(2, "labels", &Yaml::word("by-part"), &format!("{parts}; `none` makes them background")),
        false => page.set(2, "labels", &Yaml::word("none"), &format!("background; `by-part` labels {parts}")),
    }
    let (entries, why) = entries(structure, layout);
    page.open(2, "kind", "");
    page.set(4, structure.kind.name(), &Yaml::map(entries), &why);
}

/// Half the width of a pier or a harbour, metres.
pub(super) fn half_width_m(structure: Option<&Structure>) -> f64 {
    let Some(structure) = structure else { return 0.0 };
    let usual = if structure.kind == Kind::Pier { PIER_WIDTH_M } else { HARBOUR_WIDTH_M };
    0.5 * structure.said_m[1].unwrap_or(usual)
}

/// Half of the longest side that stands on the seabed, metres.
pub(super) fn half_m(structure: &Structure, way: &Way, far_m: f64) -> f64 {
    let [length, width, _] = structure.said_m;
    match structure.kind {
        Kind::Pier => 0.5 * length.unwrap_or(LENGTHS_M[0]).max(40.0),
        Kind::Dam => 0.5 * length.unwrap_or(LENGTHS_M[1]) + DAM_DISTANCE_M,
        Kind::Harbour => 0.5 * length.unwrap_or(LENGTHS_M[2]).max(width.unwrap_or(HARBOUR_WIDTH_M)) + 2.0,
        Kind::Tank => 0.5 * structure.tank_m()[0],
        Kind::Pipeline => 0.5 * pipe_m(structure, way, far_m),
        Kind::NetPen => 3.0 * length.unwrap_or(PEN_M),
    }
}

/// Length of a pipe: it goes on beyond what is seen of it.
fn pipe_m(structure: &Structure, way: &Way, far_m: f64) -> f64 {
    let followed = match way {
        Way::Terrain { length_m, .. } => *length_m,
        _ => 0.0,
    };
    structure.said_m[0].unwrap_or((followed + 2.0 * far_m + 2.0).ceil())
}

fn entries(structure: &Structure, layout: &Layout) -> (Vec<(&'static str, Yaml)>, String) {
    let [length, width, height] = structure.said_m;
    let number = |key: &'static str, said: Option<f64>, usual: f64| (key, Yaml::number(said.unwrap_or(usual)));
    let top = (layout.depth.least_m + FREEBOARD_M).clamp(2.0, 50.0);
    let said = |why: &str| match structure.sides_why.as_str() {
        "" => assumed(why),
        sides => format!("{sides}; {}", assumed(why)),
    };
    match structure.kind {
        Kind::Pier => {
            let entries = vec![
                number("length_m", length, LENGTHS_M[0]),
                number("width_m", width, PIER_WIDTH_M),
                number("height_m", height, top),
                ("broken", Yaml::uniform(0.0, 0.15)),
            ];
            (entries, said("its deck is above the water"))
        }
        Kind::Dam => {
            let distance = DAM_DISTANCE_M.max((layout.field_m + 2.0).ceil());
            let entries = vec![
                ("distance_m", Yaml::number(if layout.placings.is_empty() { DAM_DISTANCE_M } else { distance })),
                number("length_m", length, LENGTHS_M[1]),
                number("height_m", height, top.max(6.0)),
            ];
            (entries, said("behind the objects, its top above the water"))
        }
        Kind::Harbour => {
            let orbit = match &layout.going.way {
                Way::Orbit { radius_m, .. } => radius_m.ends()[1],
                _ => 0.0,
            };
            let entries = vec![
                number("length_m", length, LENGTHS_M[2]),
                number("width_m", width, HARBOUR_WIDTH_M.max((2.0 * orbit + 5.0).ceil())),
                number("height_m", height, top),
                ("dolphins", Yaml::whole(0)),
            ];
            (entries, said("the vehicle has room between the quays"))
        }
        Kind::Tank => {
            let [length, width, depth] = structure.tank_m();
            let deep = layout.depth.least_m.max(depth);
            let sides = [("length_m", length), ("width_m", width), ("depth_m", deep)];
            let why = if structure.said_m.iter().all(Option::is_some) {
                structure.sides_why.clone()
            } else {
                said("a test basin")
            };
            (sides.map(|(key, side)| (key, Yaml::number(side))).into(), why)
        }
        Kind::Pipeline => {
            let diameter = width.map_or(Yaml::uniform(PIPES_M[0], PIPES_M[1]), Yaml::number);
            let entries = vec![
                ("length_m", Yaml::number(pipe_m(structure, &layout.going.way, layout.far_m))),
                ("diameter_m", diameter),
                ("direction_deg", Yaml::number(heading(&layout.going.way))),
                ("wander_m", Yaml::uniform(0.0, 0.5)),
                ("burial", Yaml::uniform(0.0, 0.35)),
            ];
            (entries, said("it lies under the vehicle and goes on beyond what is seen"))
        }
        Kind::NetPen => {
            let surface = layout.depth.least_m.max(2.0);
            let deep = height.or(width).unwrap_or((0.6 * surface * 10.0).round() / 10.0).min(surface);
            let entries = vec![
                number("diameter_m", length, PEN_M),
                ("surface_m", Yaml::number(surface)),
                ("depth_m", Yaml::number(deep)),
                ("sway_m", Yaml::uniform(0.0, 0.8)),
            ];
            (entries, said("it hangs from the surface"))
        }
    }
}

fn heading(way: &Way) -> f64 {
    match way {
        Way::Terrain { heading_deg, .. } => *heading_deg,
        _ => 0.0,
    }
}
