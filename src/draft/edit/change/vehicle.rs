//! Changes of how vehicle and sonar are held and move.

use super::pose::{amount, middle_of};
use super::values;
use super::{Acts, Held, Move, Param};
use crate::draft::Problem;
use crate::draft::edit::act::{Act, list, map, number};
use crate::draft::edit::numbers::{moved, rounded};
use crate::draft::edit::subject::Subject;
use crate::draft::wish::{Amount, Route};
use crate::recipe::Node;

/// Altitude where a recipe says none, metres.
const ALTITUDE_M: f64 = 2.0;
/// Radius of a circle where a recipe says no distance, metres.
const RADIUS_M: f64 = 5.0;
/// Sides of a survey and distance of its lines where nobody says them, metres.
const SURVEY_M: [f64; 2] = [12.0, 3.0];

/// Degrees to port.
pub(super) fn turn(subject: &Subject, degrees: f64, held: Held) -> Result<Acts, Problem> {
    let heading = |kind: &str, path: &str| match kind {
        "hover" => Some("yaw_deg"),
        "lawnmower" => Some("heading_deg"),
        "terrain" if subject.said(&format!("{path}.points_m")).is_none() => Some("heading_deg"),
        "approach" => Some("course_deg"),
        _ => None,
    };
    turned(subject, degrees, held, "sonar.mount.yaw_deg", &heading)
}

/// Degrees up.
pub(super) fn pitch(subject: &Subject, degrees: f64, held: Held) -> Result<Acts, Problem> {
    turned(subject, degrees, held, "sonar.mount.pitch_deg", &|kind, _| (kind == "hover").then_some("pitch_deg"))
}

/// The vehicle turned where its path lets it, else the sonar on it.
fn turned(
    subject: &Subject,
    degrees: f64,
    held: Held,
    mount: &str,
    key: &dyn Fn(&str, &str) -> Option<&'static str>,
) -> Result<Acts, Problem> {
    let kinds = if held == Held::Vehicle { subject.kinds("trajectory") } else { Vec::new() };
    let paths: Option<Vec<String>> =
        kinds.iter().map(|(path, kind)| key(kind, path).map(|key| format!("{path}.{key}"))).collect();
    match paths.filter(|paths| !paths.is_empty()) {
        Some(paths) => paths.iter().try_fold(Acts::default(), |acts, path| Ok(acts.with(by(subject, path, degrees)?))),
        None => {
            let acts = by(subject, mount, degrees)?;
            let names: Vec<&str> = kinds.iter().map(|(_, kind)| kind.as_str()).collect();
            if held == Held::Sonar || names.is_empty() {
                return Ok(acts);
            }
            Ok(acts.note(format!(
                "how the vehicle is turned follows from its path ({}): the sonar is turned on it",
                names.join(", ")
            )))
        }
    }
}

/// An angle changed, within half a turn where it is a mere number.
fn by(subject: &Subject, path: &str, degrees: f64) -> Result<Acts, Problem> {
    let Some((node, _)) = subject.value(path) else {
        return values::set(subject, path, number(rounded(degrees)));
    };
    if node.text().is_some_and(|text| text.starts_with('$')) {
        let what = format!("`{path}` is {}, which other values may share", node.describe());
        return Err(Problem::whole(what, format!("change it under `let`, or here with --set {path}=…")));
    }
    let value = moved(node, Move::By(degrees)).ok_or_else(|| {
        Problem::whole(format!("{} at `{path}` cannot be turned", node.describe()), format!("--set {path}=…"))
    })?;
    Ok(Acts::one(Act::set(path, value.number().map_or(value.clone(), |angle| number(rounded(half_turn(angle)))))))
}

fn half_turn(angle: f64) -> f64 {
    let rest = angle - 360.0 * (angle / 360.0).round();
    if rest <= -180.0 { rest + 360.0 } else { rest }
}

/// The vehicle's heading.
pub(super) fn heading(subject: &Subject, degrees: f64) -> Result<Acts, Problem> {
    let kinds = subject.kinds("trajectory");
    kinds.iter().try_fold(Acts::default(), |acts, (path, kind)| {
        let key = match kind.as_str() {
            "hover" => "yaw_deg",
            "lawnmower" | "terrain" => "heading_deg",
            "approach" => "course_deg",
            _ => {
                let what = format!("on its path ({kind}) the vehicle cannot be pointed somewhere");
                return Err(Problem::whole(what, "let it hover first: `hover at x=2, y=-1`"));
            }
        };
        Ok(acts.with(values::set(subject, &format!("{path}.{key}"), number(rounded(half_turn(degrees))))?))
    })
}

/// The vehicle at a place: it hovers there.
pub(super) fn place(subject: &Subject, place: [Option<f64>; 3]) -> Result<Acts, Problem> {
    let kinds = subject.kinds("trajectory");
    let height = place[2].map(|z| above_bottom(subject, z)).transpose()?;
    let place = [place[0], place[1], height];
    if let [(path, kind)] = &kinds[..]
        && kind == "hover"
    {
        let axes = place.into_iter().enumerate().filter_map(|(axis, value)| Some((axis, value?)));
        return axes.into_iter().try_fold(Acts::default(), |acts, (axis, value)| {
            let path = format!("{path}.position_m[{axis}]");
            Ok(acts.with(values::set(subject, &path, number(rounded(value)))?))
        });
    }
    let [Some(x), Some(y), z] = place else {
        return Err(Problem::whole(
            "the vehicle moves, so one number is no place",
            "say x and y: `move it to x=2, y=-1`",
        ));
    };
    let z = z.map_or_else(|| altitude(subject), |z| number(rounded(z)));
    let there = map([("position_m", list(vec![number(rounded(x)), number(rounded(y)), z]))]);
    let names: Vec<&str> = kinds.iter().map(|(_, kind)| kind.as_str()).collect();
    let was = if names.is_empty() { String::new() } else { format!(" instead of its path ({})", names.join(", ")) };
    let acts = values::set(subject, "trajectory", map([("hover", there)]))?;
    Ok(acts.note(format!("the vehicle stays at this place{was}: `hover`")))
}

/// A height in the world; what lies below the surface is told as a depth.
fn above_bottom(subject: &Subject, z: f64) -> Result<f64, Problem> {
    if z >= 0.0 {
        return Ok(z);
    }
    match subject.value("water.depth_m").and_then(|(node, _)| node.number()) {
        Some(depth) if depth + z >= 0.0 => Ok(depth + z),
        Some(depth) => Err(Problem::whole(
            format!("{} m under the surface is below the bottom, at {depth} m", -z),
            "say a lesser depth",
        )),
        None => Err(Problem::whole("the depth is drawn anew in each scene", "say the height over the bottom: `z=3`")),
    }
}

/// Another way, at the altitude and distance of the one before.
pub(super) fn route(subject: &Subject, route: &Route) -> Result<Acts, Problem> {
    let high = ("altitude_m", altitude(subject));
    let metres = |value: Option<f64>, usual: f64| number(rounded(value.unwrap_or(usual)));
    let (kind, parameters) = match route {
        Route::Orbit { arc_deg, .. } => {
            let mut parameters = vec![("radius_m", distance(subject)), high];
            parameters.extend(arc_deg.map(|arc| ("arc_deg", number(rounded(arc)))));
            ("orbit", parameters)
        }
        Route::Lawnmower { length_m, width_m, spacing_m, lines } => {
            let spacing = spacing_m.unwrap_or(SURVEY_M[1]);
            let lines = lines.or_else(|| width_m.map(|width| (width / spacing).round() as u32 + 1));
            let mut parameters =
                vec![("length_m", metres(*length_m, SURVEY_M[0])), ("spacing_m", metres(Some(spacing), 0.0))];
            parameters.extend(lines.map(|lines| ("lines", number(f64::from(lines)))));
            parameters.push(high);
            ("lawnmower", parameters)
        }
        Route::Follow { length_m, .. } => {
            let mut parameters = vec![high];
            parameters.extend(length_m.map(|length| ("length_m", number(rounded(length)))));
            ("terrain", parameters)
        }
        Route::Approach { from_m, to_m } => {
            let mut parameters = vec![high];
            parameters.extend(from_m.map(|from| ("from_m", number(rounded(from)))));
            parameters.extend(to_m.map(|to| ("to_m", number(rounded(to)))));
            ("approach", parameters)
        }
        Route::Views => ("views", Vec::new()),
        Route::Hover => {
            let back = middle_of(&distance(subject)).unwrap_or(RADIUS_M);
            ("hover", vec![("position_m", list(vec![number(-rounded(back)), number(0.0), high.1]))])
        }
        Route::Dive { .. } => {
            let help = "draft a recipe with it: `ensonify draft`, or write a `waypoints` trajectory";
            return Err(Problem::whole("a dive cannot be made of another path", help));
        }
    };
    let there = subject.kinds("trajectory");
    if let [(_, own)] = &there[..]
        && own == kind
        && parameters.iter().all(|(key, _)| matches!(*key, "altitude_m" | "radius_m" | "position_m"))
    {
        return Ok(Acts::default().note(format!("the trajectory is {kind} already")));
    }
    values::set(subject, "trajectory", map([(kind, map(parameters))]))
}

/// The altitude that the recipe says, as it says it.
fn altitude(subject: &Subject) -> Node {
    said(subject, Param::Altitude).unwrap_or_else(|| number(ALTITUDE_M))
}

fn distance(subject: &Subject) -> Node {
    said(subject, Param::Distance).unwrap_or_else(|| amount(&Amount::Exactly(RADIUS_M)))
}

fn said(subject: &Subject, param: Param) -> Option<Node> {
    let paths = param.paths(subject).ok()?;
    let value = paths.iter().find_map(|path| subject.said(path))?.0;
    (value.get("per").is_none() && (value.number().is_some() || value.is_distribution())).then(|| value.clone())
}
