//! The trajectory's section.

use super::asked::{Asked, Figure, assumed, joined};
use super::layout::Layout;
use super::page::Page;
use super::way::{Way, distance_why};
use super::yaml::Yaml;
use crate::draft::wish::{Amount, Said};

/// Drift of a vehicle that holds its place through several frames: metres, degrees, seconds.
const DRIFT: [f64; 3] = [0.1, 3.0, 20.0];

pub(super) fn write(page: &mut Page, asked: &Asked, layout: &Layout, notes: &mut Vec<String>) {
    page.blank();
    page.open(0, "trajectory", &layout.going.why);
    let altitude = &layout.altitude;
    match &layout.going.way {
        Way::Orbit { radius_m, arc_deg, start_deg } => {
            page.open(2, "orbit", "");
            page.set(4, "radius_m", &Yaml::amount(radius_m), &distance_why(asked, &layout.view));
            high(page, altitude);
            if let Some(arc) = arc_deg {
                page.set(4, "arc_deg", &Yaml::number(*arc), "");
            }
            page.set(4, "start_deg", &Yaml::amount(start_deg), &assumed("each scene begins from another side"));
            centre(page, layout);
            speed(page, asked);
        }
        Way::Views { range_m } => {
            page.open(2, "views", "");
            page.set(4, "range_m", &Yaml::amount_per_frame(range_m), &distance_why(asked, &layout.view));
            page.set(4, "altitude_m", &Yaml::amount_per_frame(&altitude.amount), &altitude.why);
            let aside = (0.2 * layout.device.azimuth_deg).min(20.0).round();
            page.set(4, "off_axis_deg", &Yaml::number(aside), &assumed("not always in the middle of the picture"));
        }
        Way::Lawnmower { length_m, spacing_m, lines, heading_deg } => {
            page.open(2, "lawnmower", "");
            page.set(4, "length_m", &Yaml::number(*length_m), &layout.going.why);
            page.set(4, "spacing_m", &Yaml::number(*spacing_m), "");
            page.set(4, "lines", &Yaml::whole((*lines).into()), "");
            high(page, altitude);
            page.set(4, "heading_deg", &Yaml::amount(heading_deg), &heading_why(asked));
            speed(page, asked);
        }
        Way::Terrain { length_m, heading_deg, centre_m, .. } => {
            page.open(2, "terrain", "");
            page.set(4, "length_m", &Yaml::number(*length_m), "");
            page.set(4, "heading_deg", &Yaml::number(*heading_deg), &heading_why(asked));
            if *centre_m != [0.0, 0.0] {
                page.set(4, "centre_m", &Yaml::list(centre_m.map(Yaml::number)), &assumed("beside the wall"));
            }
            high(page, altitude);
            speed(page, asked);
        }
        Way::Approach { from_m, to_m, course_deg } => {
            page.open(2, "approach", "");
            if layout.structure.is_some() {
                page.set(4, "of", &Yaml::word("origin"), &assumed("the middle of the things, not of the walls"));
            }
            page.set(4, "from_m", &Yaml::number(*from_m), &format!("{}; in plan", layout.going.why));
            page.set(4, "to_m", &Yaml::number(*to_m), "");
            high(page, altitude);
            page.set(4, "course_deg", &Yaml::amount(course_deg), &heading_why(asked));
            speed(page, asked);
        }
        Way::Hover { place_m, yaw_deg } => hover(page, asked, layout, *place_m, *yaw_deg),
        Way::Through { points_m } => {
            let points = points_m.iter().map(|point| Yaml::list(point.map(Yaml::number)));
            page.open(2, "waypoints", "");
            page.set(4, "points_m", &Yaml::list(points), "z from the bottom up");
            speed(page, asked);
        }
        Way::Dive { away_m, heights_m } => {
            let points = heights_m.iter().map(|height| Yaml::list([-away_m, 0.0, *height].map(Yaml::number)));
            page.open(2, "waypoints", "");
            page.set(4, "points_m", &Yaml::list(points), "z from the bottom up");
            speed(page, asked);
        }
    }
    let is_slow = matches!(layout.going.way, Way::Views { .. } | Way::Hover { .. });
    if asked.wish.path.speed_m_s.is_some() && is_slow {
        notes.push("a speed is said, and frames that stand each for itself have none".to_owned());
    }
}

fn high(page: &mut Page, altitude: &Figure) {
    page.set(4, "altitude_m", &Yaml::amount(&altitude.amount), &altitude.why);
}

fn heading_why(asked: &Asked) -> String {
    asked.wish.path.heading_deg.as_ref().map_or_else(String::new, |said| asked.why(&said.source))
}

fn speed(page: &mut Page, asked: &Asked) {
    if let Some(Said { value, source }) = &asked.wish.path.speed_m_s {
        page.set(4, "speed_m_s", &Yaml::amount(value), &asked.why(source));
    }
}

/// Where parts of a structure are labelled too, the middle of all is not that of the things.
fn centre(page: &mut Page, layout: &Layout) {
    if layout.structure.is_none() {
        return;
    }
    page.set(4, "centre", &Yaml::word("origin"), &assumed("about the middle of the things, not of the walls"));
    page.set(4, "look_at", &Yaml::word("origin"), "");
}

fn hover(page: &mut Page, asked: &Asked, layout: &Layout, [x, y]: [f64; 2], yaw_deg: f64) {
    let path = &asked.wish.path;
    page.open(2, "hover", "");
    let z = match &layout.altitude.amount {
        Amount::Exactly(height) => Yaml::number(*height),
        other => Yaml::amount(other),
    };
    let value = Yaml::list([Yaml::number(x), Yaml::number(y), z]);
    let why = match &path.position_m {
        Some(said) => asked.why(&said.source),
        None => joined([distance_why(asked, &layout.view), layout.altitude.why.clone()]),
    };
    page.set(4, "position_m", &value, &why);
    let why = match &path.heading_deg {
        Some(said) => asked.why(&said.source),
        None => assumed("towards the objects"),
    };
    page.set(4, "yaw_deg", &Yaml::number(yaw_deg), &why);
    if layout.budget.frames > 1 {
        let [metres, degrees, seconds] = DRIFT.map(Yaml::number);
        let drift = Yaml::map([("horizontal_m", metres), ("yaw_deg", degrees), ("period_s", seconds)]);
        page.set(4, "drift", &drift, &assumed("as well as a pilot can; without it all frames of a scene are alike"));
    }
}
