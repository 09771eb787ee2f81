//! Where everything is: things, vehicle, beam and ground, before a word of the recipe is written.

use super::asked::{Asked, Figure, assumed};
use super::depth::{Depth, depth};
use super::placing::{Placing, beside_heaps};
use super::sizes::{Sizes, fits, mid_water};
use super::solve::{Case, Solved, is_at};
use super::structure::{Kind, Structure};
use super::view::View;
use super::way::{Going, Way, altitude_of, exact_m};
use crate::draft::infer::budget::{Budget, Frames, budget};
use crate::draft::infer::device::Device;
use crate::draft::infer::{ground, sight};
use crate::draft::wish::{Amount, Side, Source};
use crate::draft::{Problem, Refusal};
use crate::math::real::{cos, radians, sin};

/// Part of half of the fan by which a side of the vehicle lies off its bow: it is still seen.
const ASIDE: f64 = 0.7;

/// A scene, laid out.
pub(super) struct Layout<'a> {
    pub placings: Vec<Placing<'a>>,
    pub structure: Option<Structure>,
    pub depth: Depth,
    pub budget: Budget,
    pub device: Device,
    pub device_why: String,
    pub near_m: f64,
    pub far_m: f64,
    pub view: View,
    pub altitude: Figure,
    pub tilt_deg: f64,
    pub going: Going,
    /// Middle of the disc on which things are scattered, and its radius, metres.
    pub centre_m: [f64; 2],
    pub field_m: f64,
    /// The rectangle of scattered things, where they are passed on lines: its lowest and its highest corner, metres.
    pub area_m: Option<[[f64; 2]; 2]>,
    /// Whether the things have less room than they need, because no more is in view.
    pub crowded: bool,
    /// Whether parts of the structure are labelled, and so looked at as objects are.
    pub labelled: bool,
    /// Where things float that nobody gave a height.
    pub mid_water_m: [f64; 2],
    pub extent_m: f64,
    pub cell_m: f64,
}

impl<'a> Layout<'a> {
    pub fn of(asked: &'a Asked<'a>, notes: &mut Vec<String>) -> Result<Self, Refusal> {
        let structure = Structure::of(asked)?;
        let mut placings: Vec<Placing> =
            asked.wish.things.iter().map(|thing| Placing::of(thing, asked, notes)).collect();
        beside_heaps(&mut placings);
        let depth = depth(asked, structure.as_ref(), &placings)?;
        fits(asked, structure.as_ref(), &placings)?;
        let mid_water_m = mid_water(&depth, structure.as_ref());
        let sizes = Sizes::of(&placings, depth.least_m, mid_water_m);
        let case = Case { asked, structure: structure.as_ref(), placings: &placings, depth: &depth, sizes };
        let Solved { view, going, device, device_why, near_m, far_m, tilt_deg, reach_m } = case.solve()?;
        let budget = budget_of(asked, &going)?;
        let altitude = match &going.way {
            Way::Hover { .. } => view.altitude.clone(),
            Way::Orbit { .. } if structure.as_ref().is_some_and(|s| s.kind == Kind::NetPen) => view.altitude.clone(),
            _ => altitude_of(asked, &view),
        };
        let centre_m = centre(&going.way, &view, asked);
        let (field_m, area_m) = scattering(&going.way, &view, sizes, structure.as_ref());
        let crowded = area_m.is_none() && field_m < sight::round(sizes.field_m);
        let at_structure = placings.iter().any(|placing| is_at(structure.as_ref(), placing));
        let background = structure.as_ref().is_some_and(|structure| structure.kind == Kind::Tank);
        let labelled = at_structure || !(background || matches!(going.way, Way::Views { .. }));
        let smallest = (sizes.smallest_m > 0.0).then_some(sizes.smallest_m);
        let reach_m = reach_m + sizes.off_m;
        let structure_m = structure.as_ref().map_or(0.0, |s| super::environment::half_m(s, &going.way, far_m));
        let extent_m = ground::extent_m(reach_m.max(structure_m));
        let cell_m = ground::cell_m(extent_m, smallest, super::seabed::wave_m(asked));
        let is_free = !going.way.aims() && asked.wish.path.route.is_none();
        warn(&view, is_free && !placings.is_empty(), (&device, far_m), notes);
        Ok(Self {
            placings,
            structure,
            depth,
            budget,
            device,
            device_why,
            near_m,
            far_m,
            view,
            altitude,
            tilt_deg,
            going,
            centre_m,
            field_m,
            area_m,
            crowded,
            labelled,
            mid_water_m,
            extent_m,
            cell_m,
        })
    }

    /// Where a thing is that is told from the vehicle, in plan, metres.
    pub fn told_from_vehicle(&self, placing: &Placing, side: Side, distance: Option<&Amount>) -> [f64; 2] {
        let (place, yaw_deg) = match self.going.way {
            Way::Hover { place_m, yaw_deg } => (place_m, yaw_deg),
            _ => ([0.0, 0.0], 0.0),
        };
        let slant = distance.map_or(self.view.distance_m.ends()[0], |said| said.ends()[0]);
        let [low, high] = placing.heights_m(self.depth.least_m, self.mid_water_m);
        let below = self.altitude.middle() - 0.5 * (low + high);
        let plan = sight::plan_m(slant, below).unwrap_or(slant);
        let bearing = radians(yaw_deg + self.bearing_deg(side));
        [exact_m(place[0] + plan * cos(bearing)), exact_m(place[1] + plan * sin(bearing))]
    }

    /// Bearing of a side of the vehicle, degrees to port: of what is abeam, so far forward that the fan holds it.
    pub fn bearing_deg(&self, side: Side) -> f64 {
        let aside = (ASIDE * 0.5 * self.device.azimuth_deg).min(90.0).round();
        match side {
            Side::Front => 0.0,
            Side::Behind => 180.0,
            Side::Left => aside,
            Side::Right => -aside,
        }
    }
}

/// Tells of what cannot be helped: things out of the beam, ranges beyond a device's.
fn warn(view: &View, all_at_once: bool, (device, far_m): (&Device, f64), notes: &mut Vec<String>) {
    if !view.holds && all_at_once {
        notes.push("not all objects are in the beam at once: they are at too many heights or distances".to_owned());
    }
    let (name, most) = (&device.name, device.range_m[1]);
    if far_m > most {
        notes.push(format!("{name} is made for ranges to {most} m: beyond it, up to {far_m} m, images show little"));
    }
}

/// Scenes and frames, or what numbers of images there could be.
fn budget_of(asked: &Asked, going: &Going) -> Result<Budget, Problem> {
    let (images, scenes) = (asked.wish.images.as_ref(), asked.wish.scenes.as_ref());
    for (said, name) in [(images, "images"), (scenes, "scenes")] {
        if let Some(zero) = said.filter(|said| said.value == 0) {
            return Err(asked.problem(&zero.source, format!("0 {name} are no dataset"), "write a number above 0"));
        }
    }
    let alone = matches!(going.frames, Frames::Exactly(_)) && images.is_none();
    let one = matches!(going.way, Way::Approach { .. } | Way::Dive { .. }) && alone && scenes.is_none();
    let scenes_of = if one { Some(1) } else { scenes.map(|said| said.value) };
    budget(images.map(|said| said.value), scenes_of, going.frames).map_err(|[less, more]| {
        let source = images.or(scenes).map_or(&Source::Model, |said| &said.source);
        let asked_for = images.map_or(0, |said| said.value);
        let what = format!("{asked_for} images are no whole number of scenes with as many frames as are asked for");
        let help = if less == more { format!("write {less} images") } else { format!("write {less} or {more} images") };
        asked.problem(source, what, help)
    })
}

/// Middle of the disc of scattered things: before a vehicle that holds its place.
fn centre(way: &Way, view: &View, asked: &Asked) -> [f64; 2] {
    match way {
        Way::Hover { place_m, yaw_deg } if asked.wish.path.position_m.is_some() => {
            let distance = view.distance_m.ends()[0];
            [place_m[0] + distance * cos(radians(*yaw_deg)), place_m[1] + distance * sin(radians(*yaw_deg))]
                .map(sight::round)
        }
        _ => [0.0, 0.0],
    }
}

/// Radius of the disc on which things are scattered; on lines a rectangle too.
fn scattering(way: &Way, view: &View, sizes: Sizes, structure: Option<&Structure>) -> (f64, Option<[[f64; 2]; 2]>) {
    let about = |x: f64, y: f64| [[-x, -y], [x, y]];
    let beside = view.distance_m.ends()[0];
    match way {
        Way::Views { .. } => (sight::round(sizes.field_m), None),
        Way::Lawnmower { length_m, spacing_m, lines, heading_deg } => {
            let across = spacing_m * f64::from(lines - 1);
            let disc = sizes.field_m.max(0.45 * length_m.min(across.max(beside)));
            let area = (*heading_deg == Amount::Exactly(0.0)).then(|| about(0.5 * length_m, 0.5 * across.max(2.0)));
            (sight::round(disc), area)
        }
        Way::Terrain { length_m, heading_deg, .. } => {
            let (along, across) = (0.5 * length_m, 0.6 * beside);
            // Between the vehicle and the wall, else to both sides of its way.
            let before = |wall: f64| [wall - 0.7 * beside, wall - 0.8];
            let area = match (structure.map(|structure| structure.kind), *heading_deg) {
                (Some(Kind::Dam), _) => {
                    let [low, high] = before(super::environment::DAM_DISTANCE_M);
                    Some([[low, -along], [high, along]])
                }
                (Some(Kind::Harbour), _) => {
                    let [low, high] = before(super::environment::half_width_m(structure));
                    Some([[-along, low], [along, high]])
                }
                // Under the pier too.
                (Some(Kind::Pier), _) => {
                    let half = super::environment::half_width_m(structure);
                    Some([[-along, -half - 0.5 * beside], [along, 0.5 * half]])
                }
                (_, 0.0) => Some(about(along, across)),
                (_, 90.0) => Some(about(across, along)),
                _ => None,
            };
            (sight::round(sizes.field_m.max(across)), area.filter(|_| sizes.field_m > 0.0))
        }
        Way::Through { .. } => (sight::round(sizes.field_m), None),
        Way::Orbit { .. } | Way::Approach { .. } | Way::Hover { .. } | Way::Dive { .. } => {
            (sight::round(view.field_m.min(sizes.field_m)), None)
        }
    }
}

/// The comment of a field's radius.
pub(super) fn field_why(layout: &Layout) -> String {
    match layout.crowded {
        true => assumed("no more fits into view"),
        false if layout.placings.iter().map(|placing| placing.count.most()).sum::<u32>() <= 1 => {
            assumed("not always in the middle")
        }
        false => assumed("room for all of them beside each other"),
    }
}
