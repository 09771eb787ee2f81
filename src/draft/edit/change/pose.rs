//! Poses of objects, as somebody says how and where they stand.

use super::item::Item;
use super::{Acts, Named};
use crate::draft::Problem;
use crate::draft::edit::act::{Act, list, map, number, word};
use crate::draft::edit::numbers::rounded;
use crate::draft::edit::subject::Subject;
use crate::draft::wish::{Amount, Side, Stand};
use crate::math::real::{cos, radians, sin};
use crate::recipe::Node;

/// Free water between things that are near each other, metres, where nobody says how much.
const NEAR_M: [f64; 2] = [0.2, 1.0];

/// The pose of an item that is made.
#[derive(Default)]
pub(super) struct Posed {
    /// None where the usual one will do.
    pub value: Option<Node>,
    /// Free water to others, metres, where it is not the usual.
    pub clear_m: Option<f64>,
    /// What a person should know.
    pub notes: Vec<String>,
}

/// What poses are made from.
pub(super) struct Posing<'a> {
    pub subject: &'a Subject,
    pub items: &'a [Item<'a>],
}

/// Path and label of what an item stands by, if its pose says one.
pub(super) fn refers_to(item: &Node) -> Option<(String, &str)> {
    let (kind, pose) = item.get("pose")?.entries().first()?;
    let key = ["of", "against", "to"].into_iter().find(|key| pose.get(key).is_some())?;
    let label = pose.get(key)?.text()?;
    Some((format!("pose.{}.{key}", kind.text), label))
}

/// The kind of a pose and its parameters, as they are said.
#[derive(Default)]
struct Parts {
    kind: Option<&'static str>,
    entries: Vec<(&'static str, Node)>,
}

impl Parts {
    fn kind(&mut self, kind: &'static str) {
        self.kind = Some(kind);
    }

    fn put(&mut self, key: &'static str, value: Node) {
        self.entries.retain(|(known, _)| *known != key);
        self.entries.push((key, value));
    }
}

impl Posing<'_> {
    /// The pose of new objects.
    pub fn pose(&self, thing: &Named, stands: &[Stand]) -> Result<Posed, Problem> {
        let mut posed = Posed::default();
        let parts = self.parts(stands, &mut posed)?;
        let kind = parts.kind.unwrap_or("rest");
        let mut entries = parts.entries;
        let is_placed = entries.iter().any(|(key, _)| matches!(*key, "within_m" | "of" | "against" | "centre_m"));
        if !is_placed && let Some(within) = self.usual_within() {
            entries.insert(0, ("within_m", within));
        }
        let _ = thing;
        posed.value = (kind != "rest" || !entries.is_empty()).then(|| map([(kind, map(entries))]));
        Ok(posed)
    }

    /// How the other objects are spread.
    fn usual_within(&self) -> Option<Node> {
        let of_kind = |item: &Item<'_>| {
            let (_, pose) = item.node.get("pose")?.entries().first()?;
            pose.get("within_m").filter(|within| within.number().is_some()).cloned()
        };
        self.items.iter().find_map(of_kind)
    }

    /// The acts that make an item stand so.
    pub fn changed(&self, item: &Item<'_>, stands: &[Stand]) -> Result<Acts, Problem> {
        let mut posed = Posed::default();
        let parts = self.parts(stands, &mut posed)?;
        let there = item.node.get("pose").and_then(|pose| pose.entries().first());
        let own = there.map_or("rest", |(key, _)| key.text.as_str());
        let mut acts = Acts { notes: posed.notes, ..Acts::default() };
        let is_placed = parts.entries.iter().any(|(key, _)| matches!(*key, "centre_m" | "within_m"));
        let own_has_place = matches!(own, "rest" | "settle" | "float" | "cluster" | "line");
        let usual = if is_placed && !own_has_place { "rest" } else { own_kind(own) };
        let kind = parts.kind.unwrap_or(usual);
        if kind == own {
            let path = |key: &str| format!("{}.pose.{}", item.path, crate::recipe::path::under(kind, key));
            acts.acts.extend(parts.entries.into_iter().map(|(key, value)| Act::set(path(key), value)));
            return Ok(acts);
        }
        let mut entries = parts.entries;
        // What both kinds have stays as it was.
        let shared = ["burial", "yaw_deg"]
            .into_iter()
            .filter(|_| matches!(kind, "rest" | "near" | "settle" | "line" | "cluster"));
        for key in shared {
            let kept =
                there.and_then(|(_, pose)| pose.get(key)).filter(|_| !entries.iter().any(|(known, _)| *known == key));
            entries.extend(kept.map(|value| (key, value.clone())));
        }
        acts.acts.push(Act::set(format!("{}.pose", item.path), map([(kind, map(entries))])));
        Ok(acts)
    }

    fn parts(&self, stands: &[Stand], posed: &mut Posed) -> Result<Parts, Problem> {
        let mut parts = Parts::default();
        for stand in stands {
            self.add(stand, &mut parts, posed)?;
        }
        Ok(parts)
    }

    fn add(&self, stand: &Stand, parts: &mut Parts, posed: &mut Posed) -> Result<(), Problem> {
        match stand {
            Stand::Resting => {}
            Stand::Upright => parts.put("tip_deg", number(0.0)),
            Stand::OnSide => parts.put("tip_deg", number(90.0)),
            Stand::Settled => parts.kind("settle"),
            Stand::Buried(share) => parts.put("burial", amount(share)),
            Stand::Floating(height) => {
                parts.kind("float");
                parts.put("altitude_m", amount(height.as_ref().unwrap_or(&Amount::Exactly(2.0))));
                parts.put("mooring_m", number(0.0));
            }
            Stand::Moored(height) => {
                parts.kind("float");
                parts.put("altitude_m", amount(height.as_ref().unwrap_or(&Amount::Exactly(2.0))));
            }
            Stand::BelowSurface(depth) => {
                parts.kind("float");
                parts.put("altitude_m", number(self.above_bottom(depth)?));
            }
            Stand::School => {
                parts.kind("float");
                parts.put("school", map([]));
            }
            Stand::Heap => {
                parts.kind("cluster");
                posed.clear_m = Some(0.0);
            }
            Stand::Row(spacing) => {
                parts.kind("line");
                parts.entries.extend(spacing.as_ref().map(|spacing| ("spacing_m", amount(spacing))));
            }
            Stand::Apart(distance) => posed.clear_m = Some(distance.ends()[0]),
            Stand::Around(radius) => parts.put("within_m", number(rounded(radius.ends()[1]))),
            _ => self.place(stand, parts, posed)?,
        }
        Ok(())
    }

    fn place(&self, stand: &Stand, parts: &mut Parts, posed: &mut Posed) -> Result<(), Problem> {
        match stand {
            Stand::Leaning(against) => {
                parts.kind("leaning");
                let against = against.as_deref().unwrap_or("environment");
                self.is_there(against)?;
                parts.put("against", word(against));
            }
            Stand::On(of) => {
                self.is_there(of)?;
                parts.kind("on");
                parts.put("of", word(of));
            }
            Stand::Near { of, side, distance_m } => {
                self.is_there(of)?;
                parts.kind("near");
                parts.put("of", word(of));
                let usual = Amount::Between(NEAR_M[0], NEAR_M[1]);
                parts.put("distance_m", amount(distance_m.as_ref().unwrap_or(&usual)));
                if let Some(side) = side {
                    parts.put("direction_deg", number(compass(*side)));
                    posed.notes.push(format!("sides are told looking north: {}", side_words(*side)));
                }
            }
            Stand::FromVehicle { side, distance_m } => {
                let [x, y] = self.seen_from_vehicle(*side, distance_m.as_ref().map_or(3.0, middle))?;
                self.at(parts, [number(x), number(y)]);
            }
            Stand::At([x, y], None) => self.at(parts, [number(rounded(*x)), number(rounded(*y))]),
            Stand::At([x, y], Some(z)) => {
                parts.kind("at");
                parts.put("position_m", list([*x, *y, *z].map(|value| number(rounded(value))).to_vec()));
            }
            Stand::Within(a, b) => {
                let span = |axis: usize| [a[axis].min(b[axis]), a[axis].max(b[axis])];
                let uniform = |[low, high]: [f64; 2]| map([("uniform", list(vec![number(low), number(high)]))]);
                self.at(parts, [uniform(span(0)), uniform(span(1))]);
            }
            _ => {}
        }
        Ok(())
    }

    fn at(&self, parts: &mut Parts, place: [Node; 2]) {
        parts.put("within_m", number(0.0));
        parts.put("centre_m", list(place.to_vec()));
    }

    /// Refuses what no object of the recipe is called, and no part of its structure may be.
    fn is_there(&self, label: &str) -> Result<(), Problem> {
        if self.subject.said("environment").is_some() || self.items.iter().any(|item| item.is_called(label)) {
            return Ok(());
        }
        let names: Vec<String> = self.items.iter().map(Item::names).collect();
        let help = format!("name one of these: {}", names.join("; "));
        Err(Problem::whole(format!("there is no {label} in the recipe"), help))
    }

    /// Metres under the surface as an altitude.
    fn above_bottom(&self, depth: &Amount) -> Result<f64, Problem> {
        let bottom = self.subject.value("water.depth_m").and_then(|(node, _)| node.number());
        let bottom = bottom.ok_or_else(|| {
            Problem::whole(
                "the depth of the bottom is drawn anew in each scene",
                "say the height over the bottom instead",
            )
        })?;
        let height = bottom - middle(depth);
        if height < 0.0 {
            return Err(Problem::whole(format!("the bottom is at {bottom} m"), "say a place above it"));
        }
        Ok(rounded(height))
    }

    /// A place seen from a vehicle that stays where it is.
    fn seen_from_vehicle(&self, side: Side, distance: f64) -> Result<[f64; 2], Problem> {
        let help = "place it near another object or at a place: `at x=3, y=-1`";
        let kinds = self.subject.kinds("trajectory");
        let [(path, kind)] = &kinds[..] else {
            return Err(Problem::whole("the vehicle moves on several paths", help));
        };
        if kind != "hover" {
            return Err(Problem::whole(format!("the vehicle does not stay at one place: its path is {kind}"), help));
        }
        let figure = |key: &str| {
            let value = self.subject.value(&format!("{path}.{key}")).and_then(|(node, _)| middle_of(node));
            value.ok_or_else(|| Problem::whole(format!("`{path}.{key}` is no number"), help))
        };
        let mount = self.subject.value("sonar.mount.yaw_deg").and_then(|(node, _)| middle_of(node)).unwrap_or(0.0);
        let turned = match side {
            Side::Front => 0.0,
            Side::Left => 90.0,
            Side::Behind => 180.0,
            Side::Right => -90.0,
        };
        let heading = radians(figure("yaw_deg")? + turned + if side == Side::Front { mount } else { 0.0 });
        let [x, y] = [figure("position_m[0]")?, figure("position_m[1]")?];
        let cm = |value: f64| (value * 100.0).round() / 100.0 + 0.0;
        Ok([cm(x + distance * cos(heading)), cm(y + distance * sin(heading))])
    }
}

/// A name of a kind that is in the program.
fn own_kind(kind: &str) -> &'static str {
    ["rest", "settle", "float", "attach", "at", "near", "on", "leaning", "cluster", "line"]
        .into_iter()
        .find(|known| *known == kind)
        .unwrap_or("rest")
}

/// Degrees counter-clockwise from east, looking north.
fn compass(side: Side) -> f64 {
    match side {
        Side::Front => 90.0,
        Side::Behind => 270.0,
        Side::Left => 180.0,
        Side::Right => 0.0,
    }
}

fn side_words(side: Side) -> &'static str {
    match side {
        Side::Front => "in front is north",
        Side::Behind => "behind is south",
        Side::Left => "left is west",
        Side::Right => "right is east",
    }
}

fn middle(amount: &Amount) -> f64 {
    let [low, high] = amount.ends();
    f64::midpoint(low, high)
}

/// The number, or the middle of a uniform distribution.
pub(super) fn middle_of(node: &Node) -> Option<f64> {
    let ends = node.get("uniform").map(Node::items);
    match ends {
        Some([low, high]) => Some(f64::midpoint(low.number()?, high.number()?)),
        _ => node.number(),
    }
}

/// An amount as a value of a recipe.
pub(super) fn amount(amount: &Amount) -> Node {
    let one = |value: f64| number(rounded(value));
    match amount {
        Amount::Exactly(value) => one(*value),
        Amount::Between(low, high) => map([("uniform", list(vec![one(*low), one(*high)]))]),
        Amount::OneOf(values) => map([("choice", list(values.iter().map(|value| one(*value)).collect()))]),
        Amount::Steps(first, last, count) => {
            let values = super::values::in_steps(*first, *last, *count);
            map([("choice", list(values.into_iter().map(number).collect()))])
        }
    }
}
