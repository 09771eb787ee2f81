//! The pose of each thing, as the recipe has it.

use super::asked::{Asked, assumed, joined};
use super::layout::{Layout, field_why};
use super::placing::{Kind, Place, Placing, at_height};
use super::way::exact_m;
use super::yaml::Yaml;
use crate::draft::infer::room::{BURIAL, heap_m};
use crate::draft::infer::sight::round;
use crate::draft::wish::{Amount, Side};

/// Distance between what lies beside each other, metres, where it is not said.
const BESIDE_M: [f64; 2] = [0.1, 0.8];
/// Thickness of mooring lines, metres.
const LINE_M: f64 = 0.02;
/// Lean from the vertical, degrees, where things lean.
const LEAN_DEG: [f64; 2] = [12.0, 30.0];
/// Part of a rectangle's shorter side over which a place that is taken may be moved.
const PLAY: f64 = 0.08;
/// Names of the pose `on`, which YAML may read as `true`.
const ON: &str = "\"on\"";

type Entries = Vec<(&'static str, Yaml)>;

/// One thing's pose.
pub(super) struct Posing<'a> {
    pub asked: &'a Asked<'a>,
    pub layout: &'a Layout<'a>,
    pub placing: &'a Placing<'a>,
}

impl Posing<'_> {
    pub fn pose(&self, notes: &mut Vec<String>) -> (Yaml, String) {
        let manner = &self.placing.manner;
        let mut why: Vec<String> = manner.words.iter().map(|source| self.asked.why(source)).collect();
        why.dedup();
        let mut entries: Entries = Vec::new();
        let mut reason = String::new();
        let kind = match &manner.kind {
            Kind::Rest => {
                if let Place::At(place, Some(z)) = manner.place {
                    return (self.at(place, z), why.join(", "));
                }
                self.tip(&mut entries);
                self.burial(&mut entries);
                reason = self.place(&mut entries, 0.0, notes);
                "rest"
            }
            Kind::Settle => {
                self.burial(&mut entries);
                reason = self.place(&mut entries, 0.0, notes);
                "settle"
            }
            Kind::Float { over_m, under_m, moored, school } => {
                reason = self.float(&mut entries, [*over_m, *under_m], [*moored, *school], notes);
                "float"
            }
            Kind::Heap => {
                let radius = round(heap_m(self.placing.bulk.longest_m[1], self.placing.count.most()));
                entries.push(("radius_m", Yaml::number(radius)));
                self.burial(&mut entries);
                reason = self.place(&mut entries, radius, notes);
                "cluster"
            }
            Kind::Row(spacing) => {
                let gap = spacing.map_or_else(|| Yaml::number(self.placing.spacing_m(None)), Yaml::amount);
                entries.push(("spacing_m", gap));
                let rope = ("rope_m", Yaml::number(0.0));
                let stray = ("stray_m", Yaml::number(if spacing.is_some() { 0.0 } else { 0.2 }));
                entries.extend([rope, stray]);
                self.tip(&mut entries);
                self.burial(&mut entries);
                reason = self.place(&mut entries, 0.7 * self.layout.field_m, notes);
                "line"
            }
            Kind::Leaning(against) => {
                entries.push(("against", Yaml::word(self.other(*against))));
                entries.push(("lean_deg", Yaml::uniform(LEAN_DEG[0], LEAN_DEG[1])));
                "leaning"
            }
            Kind::On(of) => {
                entries.push(("of", Yaml::word(self.other(Some(of)))));
                ON
            }
            Kind::Near { of, side, distance_m } => {
                entries.push(("of", Yaml::word(self.other(Some(of)))));
                let beside = distance_m.map_or_else(|| Yaml::uniform(BESIDE_M[0], BESIDE_M[1]), Yaml::amount);
                entries.push(("distance_m", beside));
                if let Some(side) = side {
                    entries.push(("direction_deg", Yaml::number(direction_deg(*side))));
                }
                self.tip(&mut entries);
                self.burial(&mut entries);
                "near"
            }
        };
        if !reason.is_empty() {
            why.push(reason);
        }
        let value = Yaml::map([(kind, Yaml::map(entries))]);
        (value, joined(why))
    }

    fn tip(&self, entries: &mut Entries) {
        if let Some(tip) = self.placing.manner.tip_deg {
            entries.push(("tip_deg", Yaml::number(tip)));
        }
    }

    /// How far it is sunk in: as said, else a little, but where there is nothing to sink into.
    fn burial(&self, entries: &mut Entries) {
        let soft = super::seabed::is_there(self.asked, self.layout);
        match self.placing.manner.burial {
            Some(said) => entries.push(("burial", Yaml::amount(said))),
            None if soft => entries.push(("burial", Yaml::uniform(BURIAL[0], BURIAL[1]))),
            None => {}
        }
    }

    /// Where it is, with the reason for what nobody said; `less` is taken from the disc of scattered things.
    fn place(&self, entries: &mut Entries, less: f64, notes: &mut Vec<String>) -> String {
        let layout = self.layout;
        let small = if self.placing.count.most() > 1 { round(self.placing.bulk.longest_m[1]) } else { 0.0 };
        let at = |entries: &mut Entries, place: [f64; 2], within: f64| {
            if place != [0.0, 0.0] {
                entries.push(("centre_m", Yaml::list(place.map(Yaml::number))));
            }
            entries.push(("within_m", Yaml::number(within)));
        };
        match &self.placing.manner.place {
            Place::Anywhere => {
                if let Some([low, high]) = layout.area_m {
                    rectangle(entries, low, high);
                    return assumed("over the whole area");
                }
                at(entries, layout.centre_m, round((layout.field_m - less).max(0.2)));
                field_why(layout)
            }
            Place::Around(radius) => {
                let centre = layout.centre_m;
                if centre != [0.0, 0.0] {
                    entries.push(("centre_m", Yaml::list(centre.map(Yaml::number))));
                }
                entries.push(("within_m", Yaml::amount(radius)));
                String::new()
            }
            Place::FromVehicle(side, distance) => {
                let place = layout.told_from_vehicle(self.placing, *side, *distance);
                at(entries, place, small);
                self.aside(*side, notes)
            }
            Place::At(place, _) => {
                at(entries, *place, small);
                String::new()
            }
            Place::Within(from, to) => {
                let low = [0, 1].map(|axis| from[axis].min(to[axis]));
                let high = [0, 1].map(|axis| from[axis].max(to[axis]));
                rectangle(entries, low, high);
                String::new()
            }
        }
    }

    /// What is abeam lies forward of the beam, where the fan holds it.
    fn aside(&self, side: Side, notes: &mut Vec<String>) -> String {
        let bearing = self.layout.bearing_deg(side);
        match side {
            Side::Front => assumed("on the vehicle's axis, so far off by sound"),
            Side::Left | Side::Right if bearing.abs() < 90.0 => {
                assumed(&format!("{} degrees off the bow, where the fan still holds it", bearing.abs()))
            }
            Side::Left | Side::Right => String::new(),
            Side::Behind => {
                notes.push(format!("{}: what is behind the vehicle is in no image", self.placing.thing.label));
                String::new()
            }
        }
    }

    fn float(
        &self,
        entries: &mut Entries,
        [over, under]: [Option<&Amount>; 2],
        [moored, school]: [bool; 2],
        notes: &mut Vec<String>,
    ) -> String {
        let depth = self.layout.depth.least_m;
        let [low, high] = self.layout.mid_water_m;
        let mut reason = Vec::new();
        let altitude = match (over, under, self.placing.manner.place.clone()) {
            (Some(over), ..) => Yaml::amount(over),
            (None, Some(under), _) => {
                let height = self.placing.bulk.height_m;
                let [less, more] = under.ends();
                let over = |under: f64| exact_m((depth - under - height).max(0.0));
                reason.push(format!("its top so deep under the surface of {depth} m of water"));
                Yaml::uniform(over(more), over(less))
            }
            (None, None, Place::At(_, Some(z))) => Yaml::number(exact_m(at_height(z, depth))),
            (None, None, _) => {
                reason.push(assumed("at these heights the sonar has it in its beam"));
                if school { per_scene(low, high) } else { Yaml::uniform(low, high) }
            }
        };
        entries.push(("altitude_m", altitude));
        entries.push(("mooring_m", Yaml::number(if moored { LINE_M } else { 0.0 })));
        let radius =
            round((f64::from(self.placing.count.most()).sqrt() * 0.5 * self.placing.bulk.longest_m[1]).max(0.5));
        let placed = self.place(entries, if school { radius } else { 0.0 }, notes);
        if school {
            entries.push(("school", Yaml::map([("radius_m", Yaml::number(radius))])));
        }
        reason.push(placed);
        joined(reason)
    }

    /// At a place with a height.
    fn at(&self, [x, y]: [f64; 2], z: f64) -> Yaml {
        let z = exact_m(at_height(z, self.layout.depth.least_m));
        let mut entries: Entries = vec![("position_m", Yaml::list([x, y, z].map(Yaml::number)))];
        entries.push(("yaw_deg", Yaml::uniform(0.0, 360.0)));
        if let Some(tip) = self.placing.manner.tip_deg.filter(|tip| *tip != 0.0) {
            entries.push(("roll_deg", Yaml::number(tip)));
        }
        Yaml::map([("at", Yaml::map(entries))])
    }

    /// The label of another: of a structure the part that things lie beside.
    fn other<'b>(&'b self, said: Option<&'b str>) -> &'b str {
        let structure = self.layout.structure.as_ref();
        match (said, structure) {
            (Some(name), Some(structure)) if structure.kind.name() == name => structure.kind.part(),
            (Some(name), _) => name,
            (None, Some(structure)) => structure.kind.part(),
            (None, None) => {
                // Against the largest of the others.
                let others = self.layout.placings.iter().filter(|other| other.thing.label != self.placing.thing.label);
                let largest = others.max_by(|a, b| a.bulk.longest_m[1].total_cmp(&b.bulk.longest_m[1]));
                largest.map_or("rock", |other| &other.thing.label)
            }
        }
    }
}

/// Somewhere in a rectangle: its middle is drawn, and moved a little where that place is taken.
fn rectangle(entries: &mut Entries, low: [f64; 2], high: [f64; 2]) {
    let play = round((PLAY * (high[0] - low[0]).min(high[1] - low[1])).min(1.0));
    let drawn = [0, 1].map(|axis| {
        let middle = 0.5 * (low[axis] + high[axis]);
        Yaml::uniform(exact_m((low[axis] + play).min(middle)), exact_m((high[axis] - play).max(middle)))
    });
    entries.push(("centre_m", Yaml::list(drawn)));
    entries.push(("within_m", Yaml::number(play)));
}

/// Drawn once a scene, the same for all.
fn per_scene(low: f64, high: f64) -> Yaml {
    let ends = Yaml::list([low, high].map(Yaml::number));
    Yaml::map([("uniform", ends), ("per", Yaml::word("scene"))])
}

/// Direction of a side of something, degrees counter-clockwise from east: in front of it is north.
fn direction_deg(side: Side) -> f64 {
    match side {
        Side::Right => 0.0,
        Side::Front => 90.0,
        Side::Left => 180.0,
        Side::Behind => 270.0,
    }
}
