//! Where everything is: things, vehicle, beam and ground, before a word of the recipe is written.

use super::asked::{Asked, Figure, assumed};
use super::depth::{Depth, UNDER_SURFACE_M, depth};
use super::placing::{Kind as Pose, Place, Placing, beside_heaps};
use super::structure::{Kind, Structure};
use super::view::{Terms, View};
use super::way::{Form, Going, Ground, Things, Way, altitude_of, exact_m, form};
use crate::draft::infer::budget::{Budget, budget};
use crate::draft::infer::device::{Device, Need, choose, device};
use crate::draft::infer::sight::{self, Sight};
use crate::draft::infer::{ground, room};
use crate::draft::wish::{Amount, Said, Side, Source};
use crate::draft::{Problem, Refusal};
use crate::math::real::{cos, radians, sin};
use crate::recipe::did_you_mean;

/// Distance where there is nothing to look at, metres.
const OF_THE_BOTTOM_M: f64 = 7.0;
/// Where things float that nobody gave a height, metres over the bottom, and the part of the depth they keep below.
const MID_WATER_M: [f64; 2] = [1.0, 3.0];
const MID_WATER: f64 = 0.6;
/// The same in a net pen, parts of the depth.
const IN_PEN: [f64; 2] = [0.5, 0.7];
/// Part of a device's range at which things are looked at, at most.
const USED: f64 = 0.6;
/// Over the farthest thing and its shadow.
const BEYOND: f64 = 1.08;
/// Highest middle that the beam is tilted for where things are passed on lines, metres.
const ON_LINES_M: f64 = 0.3;
/// Over the distance where things are passed on lines.
const BEYOND_ON_LINES: f64 = 1.9;
/// Where a range begins: near, of far ranges farther.
const NEAR_M: f64 = 0.5;
const NEAR: f64 = 0.04;
/// Part of the range that a side of the vehicle lies off its bow, of half the fan: it is still seen.
const ASIDE: f64 = 0.7;
/// A net pen's diameter and the distance of a vehicle from its net, metres.
const PEN_M: f64 = 14.0;
const FROM_NET_M: f64 = 5.0;

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

/// Sizes of what is to be seen.
#[derive(Clone, Copy)]
struct Sizes {
    longest_m: f64,
    smallest_m: f64,
    tallest_m: f64,
    heights_m: [f64; 2],
    /// Of scattered and placed things about their middle.
    field_m: f64,
    /// How far their middle is from the world's origin.
    off_m: f64,
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
        let solved = solve(asked, structure.as_ref(), &placings, &depth, sizes)?;
        let Solved { view, going, device, device_why, near_m, far_m, .. } = solved;
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
        let reach_m = solved.reach_m + sizes.off_m;
        let structure_m = structure.as_ref().map_or(0.0, |s| super::environment::half_m(s, &going.way, far_m));
        let extent_m = ground::extent_m(reach_m.max(structure_m));
        let cell_m = ground::cell_m(extent_m, smallest, super::seabed::wave_m(asked));
        let tilt_deg = solved.tilt_deg;
        if !view.holds && !going.way.aims() && !placings.is_empty() && asked.wish.path.route.is_none() {
            notes.push(
                "not all of the objects are in the beam at once: they are at too many heights or distances".to_owned(),
            );
        }
        let beyond = far_m > device.range_m[1];
        if beyond {
            let most = device.range_m[1];
            notes.push(format!(
                "{} is made for ranges to {most} m: beyond it, up to {far_m} m, images show little",
                device.name
            ));
        }
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
    pub fn from_vehicle(&self, placing: &Placing, side: Side, distance: Option<&Amount>) -> [f64; 2] {
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

/// Heights where things float that nobody gave one; in a net pen above its floor.
fn mid_water(depth: &Depth, structure: Option<&Structure>) -> [f64; 2] {
    if structure.is_some_and(|structure| structure.kind == Kind::NetPen) {
        return IN_PEN.map(|part| sight::round(part * depth.least_m));
    }
    let high = (MID_WATER * depth.least_m).min(MID_WATER_M[1]);
    [MID_WATER_M[0].min(0.5 * high), high].map(sight::round)
}

impl Sizes {
    fn of(placings: &[Placing], depth_m: f64, mid_water_m: [f64; 2]) -> Self {
        let each = |of: &dyn Fn(&Placing) -> f64| placings.iter().map(of).fold(0.0, f64::max);
        let heights: Vec<[f64; 2]> = placings.iter().map(|placing| placing.heights_m(depth_m, mid_water_m)).collect();
        let low = heights.iter().map(|height| height[0]).fold(f64::INFINITY, f64::min);
        let high = heights.iter().map(|height| height[1]).fold(0.0, f64::max);
        let smallest = placings.iter().map(|placing| placing.bulk.longest_m[0]).fold(f64::INFINITY, f64::min);
        let places: Vec<[f64; 2]> = placings.iter().flat_map(corners).collect();
        let middle = middle_of(&places);
        let spread = places.iter().map(|place| away(*place, middle)).fold(0.0, f64::max);
        let scattered = scattered_m(placings);
        let any = !placings.is_empty();
        let (field_m, off_m) = match places.is_empty() {
            true => (scattered, 0.0),
            // Scattered things lie about the origin, placed ones where they are.
            false if scattered > 0.0 => (scattered.max(spread + away(middle, [0.0; 2])), 0.0),
            false => (spread, away(middle, [0.0; 2])),
        };
        Self {
            longest_m: each(&|placing| placing.bulk.longest_m[1]),
            smallest_m: if any { smallest } else { 0.0 },
            tallest_m: each(&|placing| placing.height_m()),
            heights_m: if any { [low, high] } else { [0.0, 0.0] },
            field_m,
            off_m,
        }
    }
}

/// Places of the world that were given to a thing.
fn corners(placing: &Placing) -> Vec<[f64; 2]> {
    match placing.manner.place {
        Place::At(place, _) => vec![place],
        Place::Within(from, to) => vec![from, to],
        Place::Anywhere | Place::Around(_) | Place::FromVehicle(..) => Vec::new(),
    }
}

fn middle_of(places: &[[f64; 2]]) -> [f64; 2] {
    let count = places.len().max(1) as f64;
    [0, 1].map(|axis| places.iter().map(|place| place[axis]).sum::<f64>() / count)
}

fn away(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    (x * x + y * y).sqrt()
}

/// Radius of the disc of scattered things, metres.
fn scattered_m(placings: &[Placing]) -> f64 {
    let scattered = || placings.iter().filter(|placing| placing.is_scattered());
    // Those beside, on and against others need room with them.
    let followers =
        placings.iter().filter(|placing| matches!(placing.manner.kind, Pose::Near { .. } | Pose::Leaning(_)));
    let sizes = scattered().chain(followers).map(|placing| match placing.manner.kind {
        Pose::Heap => (2.0 * placing.reach_m(), 1),
        _ => (
            placing.bulk.longest_m[1].max(placing.manner.clear_m.map_or(0.0, |clear| clear.ends()[1])),
            placing.count.most(),
        ),
    });
    let said = scattered().filter_map(|placing| match placing.manner.place {
        Place::Around(radius) => Some(radius.ends()[1]),
        _ => None,
    });
    let single = placings.len() == 1 && placings[0].count.most() == 1;
    let rows = scattered().filter(|placing| matches!(placing.manner.kind, Pose::Row(_))).map(Placing::reach_m);
    match said.fold(0.0, f64::max) {
        around if around > 0.0 => around,
        _ if single => room::stray_m(sight::distance_m(placings[0].bulk.longest_m[1])),
        _ => rows.fold(room::disc_m(sizes), f64::max),
    }
}

/// Refuses what is larger than its tank.
fn fits(asked: &Asked, structure: Option<&Structure>, placings: &[Placing]) -> Result<(), Problem> {
    let Some(tank) = structure.filter(|structure| structure.kind == Kind::Tank) else { return Ok(()) };
    let [length, width, depth] = tank.tank_m();
    for placing in placings {
        let (size, label) = (placing.bulk.longest_m[0], &placing.thing.label);
        if size > 0.7 * length.max(width) || placing.height_m().min(size) > depth {
            let source = asked.wish.environment_m.as_ref().map_or(&placing.thing.called.source, |said| &said.source);
            let what = format!("{label}: {size:.1} m do not fit into a tank of {length} × {width} × {depth} m");
            return Err(asked.problem(source, what, "write a larger tank, or a smaller object"));
        }
    }
    Ok(())
}

struct Solved {
    view: View,
    going: Going,
    device: Device,
    device_why: String,
    near_m: f64,
    far_m: f64,
    tilt_deg: f64,
    reach_m: f64,
}

/// View, way and sonar suit each other: the sonar is chosen for the view, and the view is of that sonar's beam.
fn solve(
    asked: &Asked,
    structure: Option<&Structure>,
    placings: &[Placing],
    depth: &Depth,
    sizes: Sizes,
) -> Result<Solved, Refusal> {
    let scattered = placings.iter().map(|placing| placing.count.most()).sum::<u32>() > 1;
    let from_vehicle = placings.iter().find_map(|placing| match placing.manner.place {
        Place::FromVehicle(_, distance) => Some(distance),
        _ => None,
    });
    let of_structure =
        |placing: &Placing| structure.is_some_and(|structure| structure.is_meant_by(&placing.manner.kind));
    let at_structure = placings.iter().any(of_structure);
    let things = Things { scattered, from_vehicle: from_vehicle.is_some(), at_structure };
    let (form, why) = form(asked, structure, things);
    let mut chosen = said_device(asked)?.unwrap_or_else(|| choose(&Need::default()));
    let is_said = asked.wish.sonar.devices.is_some();
    // A sonar that is chosen for its beam may have another one: twice is enough.
    for round in 0..3 {
        let (device, device_why) = chosen.clone();
        let azimuth_deg = asked.wish.sonar.fov_deg.as_ref().map_or(device.azimuth_deg, |said| said.value.ends()[0]);
        let terms = terms(asked, structure, depth, sizes, &device, azimuth_deg, from_vehicle.flatten(), form);
        let view = terms.view().map_err(|what| too_steep(asked, what))?;
        let view = if structure.is_some_and(|s| s.kind == Kind::NetPen) { pen(structure, view, depth) } else { view };
        let far_m = far(asked, form, &view, sizes, depth);
        let ground = Ground {
            asked,
            structure,
            view: &view,
            azimuth_deg,
            far_m,
            depth_m: depth.least_m,
            field_m: sizes.field_m,
        };
        let going = ground.go(form, why.clone());
        let far_m = far_of_way(asked, &going.way, far_m, &view, sizes);
        let need = Need {
            smallest_m: sizes.smallest_m,
            distance_m: view.distance_m.ends()[0],
            far_m,
            frequency_khz: asked
                .wish
                .sonar
                .frequency_khz
                .as_ref()
                .map(|said| 0.5 * (said.value.ends()[0] + said.value.ends()[1])),
        };
        let better = if is_said { chosen.clone() } else { choose(&need) };
        if round == 2 || better.0 == device {
            let near_m = near(asked, far_m, &view, &device, sizes)?;
            let tilt_deg = tilt(&view, &going.way);
            let reach_m = Ground { far_m, ..ground }.reach_m(&going.way);
            let device_why = if is_said { device_why } else { better.1 };
            return Ok(Solved { tilt_deg, reach_m, view, going, device, device_why, near_m, far_m });
        }
        chosen = better;
    }
    unreachable!("the third round returns")
}

/// Whether a thing leans on the structure, or lies beside it.
pub(super) fn is_at(structure: Option<&Structure>, placing: &Placing) -> bool {
    structure.is_some_and(|structure| structure.is_meant_by(&placing.manner.kind))
}

/// The device that was named, the one with the thinnest beam of several.
fn said_device(asked: &Asked) -> Result<Option<(Device, String)>, Problem> {
    let Some(Said { value: names, source }) = &asked.wish.sonar.devices else { return Ok(None) };
    let mut found: Vec<Device> = Vec::new();
    for name in names {
        let Some(device) = device(name) else {
            let known: Vec<&str> = crate::catalog::sonars::DEVICES.iter().map(|(name, _)| *name).collect();
            let what = format!("there is no sonar `{name}`");
            return Err(asked.problem(source, what, did_you_mean(name, &known)));
        };
        found.push(device);
    }
    let least = found.into_iter().min_by(|a, b| {
        let order = a.azimuth_deg.total_cmp(&b.azimuth_deg);
        order.then(a.vertical_deg.total_cmp(&b.vertical_deg))
    });
    Ok(least.map(|device| (device, asked.why(source))))
}

#[expect(clippy::too_many_arguments, reason = "all of what a view depends on")]
fn terms<'a>(
    asked: &'a Asked,
    structure: Option<&Structure>,
    depth: &'a Depth,
    sizes: Sizes,
    device: &Device,
    azimuth_deg: f64,
    from_vehicle: Option<&'a Amount>,
    form: Form,
) -> Terms<'a> {
    let said = |said: &'a Option<Said<Amount>>| said.as_ref().map(|said| &said.value);
    let natural = if sizes.longest_m > 0.0 {
        sight::distance_of_all_m([sizes.smallest_m, sizes.longest_m])
    } else {
        OF_THE_BOTTOM_M
    };
    let most_seen = said(&asked.wish.sonar.most_range_m).map_or(f64::INFINITY, |far| 0.7 * far.ends()[0]);
    let steps = |amount: &&Amount| !matches!(amount, Amount::Steps(..));
    let range = said(&asked.wish.path.range_m).filter(steps).filter(|_| form != Form::Approach).or(from_vehicle);
    // On lines and along walls things come by at all distances.
    let passed = matches!(form, Form::Lawnmower | Form::Along | Form::Through);
    // One at a time is looked at.
    let single = form == Form::Views || passed;
    Terms {
        range: range.filter(|_| !passed),
        altitude: depth.altitude.as_ref(),
        tilt: said(&asked.wish.sonar.pitch_deg),
        natural_m: natural.min(most_seen).min(USED * device.range_m[1]),
        half_m: 0.5 * sizes.longest_m,
        field_m: if single { 0.0 } else { sizes.field_m },
        // Lines are flown for what lies on the bottom: what stands high is seen all the same.
        heights_m: if passed { sizes.heights_m.map(|height| height.min(ON_LINES_M)) } else { sizes.heights_m },
        vertical_deg: device.vertical_deg,
        azimuth_deg,
        most_m: most_seen
            .min(USED * device.range_m[1])
            .min(structure.map_or(f64::INFINITY, Structure::room_m))
            .max(0.5),
        ceiling_m: depth.least_m - UNDER_SURFACE_M.min(0.2 * depth.least_m),
    }
}

/// From outside of a net pen, at the height of the net's middle.
fn pen(structure: Option<&Structure>, view: View, depth: &Depth) -> View {
    let half = 0.5 * structure.and_then(|pen| pen.said_m[0]).unwrap_or(PEN_M);
    let distance = half + FROM_NET_M;
    let altitude = match &depth.altitude {
        Some(said) => said.clone(),
        None => {
            Figure::assumed(Amount::Exactly(sight::round(0.45 * depth.least_m)), "the height of the net's lower half")
        }
    };
    let sight = Sight { near_m: FROM_NET_M, far_m: distance, low_m: 0.3 * depth.least_m, high_m: 0.5 * depth.least_m };
    let tilt_deg = sight.tilt_deg(altitude.middle());
    let field_m = (0.3 * half).min(view.field_m.max(0.5));
    View { distance_m: Amount::Exactly(distance), altitude, tilt_deg, field_m, sight, holds: true }
}

fn too_steep(asked: &Asked, what: String) -> Problem {
    let source = asked.wish.path.range_m.as_ref().map_or(&Source::Model, |said| &said.source);
    asked.problem(source, what, "write a greater range, or another altitude")
}

/// Farthest range that the things ask for, metres.
fn far(asked: &Asked, form: Form, view: &View, sizes: Sizes, depth: &Depth) -> f64 {
    if let Some(said) = &asked.wish.sonar.most_range_m {
        return said.value.ends()[1];
    }
    let [_, highest] = view.altitude.amount.ends();
    let sight = view.sight;
    let far = match form {
        Form::Lawnmower | Form::Along | Form::Through => BEYOND_ON_LINES * sight.slant_m(highest),
        Form::Dive => sight.slant_m(depth.least_m),
        Form::Orbit | Form::Views | Form::Approach | Form::Hover => {
            let shadow = sight.shadow_m(view.altitude.amount.ends()[0], sizes.tallest_m);
            sight.slant_m(highest) + 0.5 * sizes.longest_m + shadow
        }
    };
    up(BEYOND * far)
}

/// The same, where the way goes farther off.
fn far_of_way(asked: &Asked, way: &Way, far_m: f64, view: &View, sizes: Sizes) -> f64 {
    if asked.wish.sonar.most_range_m.is_some() {
        return far_m;
    }
    let height = view.altitude.amount.ends()[1];
    let slant = match way {
        Way::Approach { from_m, to_m, .. } => sight::slant_m(from_m.max(*to_m) + view.field_m, height),
        Way::Views { range_m } => range_m.ends()[1],
        Way::Dive { away_m, heights_m } => {
            sight::slant_m(away_m + view.field_m, heights_m.iter().copied().fold(0.0, f64::max))
        }
        Way::Orbit { radius_m, .. } => sight::slant_m(radius_m.ends()[1] + view.field_m, height),
        _ => return far_m,
    };
    let shadow = view.sight.shadow_m(height, sizes.tallest_m);
    let least = BEYOND * (slant + 0.5 * sizes.longest_m + shadow);
    match way {
        Way::Views { .. } => up(least),
        _ => far_m.max(up(least)),
    }
}

/// Rounded up for people.
fn up(value: f64) -> f64 {
    let step = match value {
        ..10.0 => 0.5,
        10.0..30.0 => 1.0,
        _ => 5.0,
    };
    (value / step).ceil() * step
}

fn near(asked: &Asked, far_m: f64, view: &View, device: &Device, sizes: Sizes) -> Result<f64, Problem> {
    if let Some(said) = &asked.wish.sonar.least_range_m {
        let near = said.value.ends()[0];
        if near >= far_m {
            let what = format!("a range from {near} m to {far_m} m runs backwards");
            return Err(asked.problem(&said.source, what, "write a farther end of the range"));
        }
        return Ok(near);
    }
    let nearest = (view.sight.near_m - 0.5 * sizes.longest_m).max(0.2);
    let near = (NEAR * far_m).max(NEAR_M).min(0.6 * nearest).max(device.range_m[0].min(0.5 * far_m));
    let step = if near < 1.0 { 0.1 } else { 0.5 };
    Ok(((near / step).floor() * step * 10.0).round() / 10.0).map(|near: f64| near.max(0.1).min(0.5 * far_m))
}

/// The mount's tilt.
fn tilt(view: &View, way: &Way) -> f64 {
    match way {
        Way::Dive { away_m, heights_m } => {
            let sight = Sight { near_m: *away_m, far_m: *away_m, ..view.sight };
            let ends = heights_m.iter().map(|height| sight.elevations_deg(*height));
            let (low, high) = ends.fold((0.0_f64, -90.0_f64), |(low, high), [a, b]| (low.min(a), high.max(b)));
            (0.5 * (low + high)).round()
        }
        _ => view.tilt_deg,
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
    let alone = matches!(going.frames, crate::draft::infer::budget::Frames::Exactly(_)) && images.is_none();
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
        false => assumed("room for all of them beside each other"),
    }
}
