//! View, way and sonar that suit each other.

use super::asked::{Asked, Figure};
use super::depth::{Depth, UNDER_SURFACE_M};
use super::placing::{Place, Placing};
use super::routes::Ground;
use super::sizes::Sizes;
use super::structure::{Kind, Structure};
use super::view::{Terms, View};
use super::way::{Form, Going, Things, Way, form};
use crate::draft::infer::device::{Device, Need, choose, device};
use crate::draft::infer::sight::{self, Sight};
use crate::draft::wish::{Amount, Said, Source};
use crate::draft::{Problem, Refusal};
use crate::recipe::did_you_mean;

/// Distance where there is nothing to look at, metres.
const OF_THE_BOTTOM_M: f64 = 7.0;
/// Part of a device's range, and of a range that was said, at which things are looked at, at most.
const USED: f64 = 0.6;
const USED_OF_SAID: f64 = 0.7;
/// Over the farthest thing and its shadow.
const BEYOND: f64 = 1.08;
/// Highest middle that the beam is tilted for where things are passed on lines, metres.
const ON_LINES_M: f64 = 0.3;
/// Over the distance where things are passed on lines.
const BEYOND_ON_LINES: f64 = 1.9;
/// Where a range begins: near, of far ranges farther.
const NEAR_M: f64 = 0.5;
const NEAR: f64 = 0.04;
/// A net pen's diameter and the distance of a vehicle from its net, metres.
const PEN_M: f64 = 14.0;
const FROM_NET_M: f64 = 5.0;
/// Rounds in which sonar and view are made to suit each other.
const ROUNDS: u32 = 3;

/// What is to be seen, and in what.
pub(super) struct Case<'a> {
    pub asked: &'a Asked<'a>,
    pub structure: Option<&'a Structure>,
    pub placings: &'a [Placing<'a>],
    pub depth: &'a Depth,
    pub sizes: Sizes,
}

/// View, way and sonar.
pub(super) struct Solved {
    pub view: View,
    pub going: Going,
    pub device: Device,
    pub device_why: String,
    pub near_m: f64,
    pub far_m: f64,
    pub tilt_deg: f64,
    /// How far from the world's origin anything is seen, metres.
    pub reach_m: f64,
}

/// One try of a sonar.
struct Try {
    view: View,
    going: Going,
    far_m: f64,
    azimuth_deg: f64,
}

impl Case<'_> {
    /// View, way and sonar suit each other: the sonar is chosen for the view, and the view is of that sonar's beam.
    pub fn solve(&self) -> Result<Solved, Refusal> {
        let (form, why) = form(self.asked, self.structure, self.things());
        let said = self.said_device()?;
        let (mut device, mut device_why) = said.clone().unwrap_or_else(|| choose(&Need::default()));
        let mut tried = self.with(&device, form, &why)?;
        if said.is_none() {
            for _ in 1..ROUNDS {
                let better = choose(&self.need(&tried));
                let is_the_same = better.0 == device;
                (device, device_why) = better;
                if is_the_same {
                    break;
                }
                tried = self.with(&device, form, &why)?;
            }
        }
        let Try { view, going, far_m, azimuth_deg } = tried;
        let far_m = self.heard(far_m, &view, &device);
        let near_m = self.near(far_m, &view, &device)?;
        let tilt_deg = tilt(&view, &going.way);
        let reach_m = self.ground(&view, azimuth_deg, far_m).reach_m(&going.way);
        Ok(Solved { tilt_deg, reach_m, view, going, device, device_why, near_m, far_m })
    }

    fn things(&self) -> Things {
        Things {
            scattered: self.placings.iter().map(|placing| placing.count.most()).sum::<u32>() > 1,
            from_vehicle: self.told_from_vehicle().is_some(),
            at_structure: self.placings.iter().any(|placing| is_at(self.structure, placing)),
        }
    }

    /// The first distance from the vehicle that was said, if anything is told from it.
    fn told_from_vehicle(&self) -> Option<Option<&Amount>> {
        self.placings.iter().find_map(|placing| match placing.manner.place {
            Place::FromVehicle(_, distance) => Some(distance),
            _ => None,
        })
    }

    fn with(&self, device: &Device, form: Form, why: &str) -> Result<Try, Problem> {
        let fov = self.asked.wish.sonar.fov_deg.as_ref();
        let azimuth_deg = fov.map_or(device.azimuth_deg, |said| said.value.ends()[0]);
        let view = self.terms(device, azimuth_deg, form).view().map_err(|what| self.too_steep(what))?;
        let is_pen = self.structure.is_some_and(|structure| structure.kind == Kind::NetPen);
        let view = if is_pen { self.of_pen(view) } else { view };
        let far_m = self.far(form, &view);
        let going = self.ground(&view, azimuth_deg, far_m).go(form, why.to_owned());
        let far_m = self.far_of_way(&going.way, far_m, &view);
        Ok(Try { view, going, far_m, azimuth_deg })
    }

    fn ground<'b>(&'b self, view: &'b View, azimuth_deg: f64, far_m: f64) -> Ground<'b> {
        let Case { asked, structure, depth, sizes, .. } = *self;
        Ground { asked, structure, view, azimuth_deg, far_m, depth_m: depth.least_m, field_m: sizes.field_m }
    }

    /// No farther than the device is made for, where the things are nearer.
    fn heard(&self, far_m: f64, view: &View, device: &Device) -> f64 {
        let [_, height] = view.altitude.amount.ends();
        let things = view.sight.slant_m(height) + 0.5 * self.sizes.longest_m;
        let most = device.range_m[1];
        let is_said = self.asked.wish.sonar.most_range_m.is_some();
        if !is_said && far_m > most && things < most { most } else { far_m }
    }

    fn need(&self, tried: &Try) -> Need {
        let frequency = self.asked.wish.sonar.frequency_khz.as_ref().map(|said| said.value.ends());
        Need {
            smallest_m: self.sizes.smallest_m,
            distance_m: tried.view.distance_m.ends()[0],
            far_m: tried.far_m,
            frequency_khz: frequency.map(|[low, high]| 0.5 * (low + high)),
        }
    }

    fn terms<'b>(&'b self, device: &Device, azimuth_deg: f64, form: Form) -> Terms<'b> {
        let Case { asked, sizes, depth, .. } = *self;
        fn said(said: &Option<Said<Amount>>) -> Option<&Amount> {
            said.as_ref().map(|said| &said.value)
        }
        let natural = match sizes.longest_m {
            0.0 => OF_THE_BOTTOM_M,
            longest => sight::distance_of_all_m([sizes.smallest_m, longest]),
        };
        let most_said = said(&asked.wish.sonar.most_range_m).map(|far| USED_OF_SAID * far.ends()[0]);
        let most = most_said.unwrap_or(f64::INFINITY).min(USED * device.range_m[1]);
        let steps = |amount: &&Amount| !matches!(amount, Amount::Steps(..));
        let range = said(&asked.wish.path.range_m).filter(steps).filter(|_| form != Form::Approach);
        // On lines and along walls things come by at all distances.
        let passed = matches!(form, Form::Lawnmower | Form::Along | Form::Through);
        // One at a time is looked at.
        let single = form == Form::Views || passed;
        Terms {
            range: range.or(self.told_from_vehicle().flatten()).filter(|_| !passed),
            altitude: depth.altitude.as_ref(),
            tilt: said(&asked.wish.sonar.pitch_deg),
            natural_m: natural.min(most),
            half_m: 0.5 * sizes.longest_m,
            field_m: if single { 0.0 } else { sizes.field_m },
            // Lines are flown for what lies on the bottom: what stands high is seen all the same.
            heights_m: if passed { sizes.heights_m.map(|height| height.min(ON_LINES_M)) } else { sizes.heights_m },
            vertical_deg: device.vertical_deg,
            azimuth_deg,
            most_m: most.min(self.structure.map_or(f64::INFINITY, Structure::room_m)).max(0.5),
            ceiling_m: depth.least_m - UNDER_SURFACE_M.min(0.2 * depth.least_m),
        }
    }

    /// The device that was named, the one with the thinnest beam of several.
    fn said_device(&self) -> Result<Option<(Device, String)>, Problem> {
        let Some(Said { value: names, source }) = &self.asked.wish.sonar.devices else { return Ok(None) };
        let mut found: Vec<Device> = Vec::new();
        for name in names {
            let Some(device) = device(name) else {
                let known: Vec<&str> = crate::catalog::sonars::DEVICES.iter().map(|(name, _)| *name).collect();
                let what = format!("there is no sonar `{name}`");
                return Err(self.asked.problem(source, what, did_you_mean(name, &known)));
            };
            found.push(device);
        }
        let least = found.into_iter().min_by(|a, b| {
            let order = a.azimuth_deg.total_cmp(&b.azimuth_deg);
            order.then(a.vertical_deg.total_cmp(&b.vertical_deg))
        });
        Ok(least.map(|device| (device, self.asked.why(source))))
    }

    /// From outside of a net pen, at the height of the net's middle.
    fn of_pen(&self, view: View) -> View {
        let half = 0.5 * self.structure.and_then(|pen| pen.said_m[0]).unwrap_or(PEN_M);
        let distance = half + FROM_NET_M;
        let altitude = match &self.depth.altitude {
            Some(said) => said.clone(),
            None => Figure::assumed(
                Amount::Exactly(sight::round(0.45 * self.depth.least_m)),
                "the height of the net's lower half",
            ),
        };
        let sight = Sight {
            near_m: FROM_NET_M,
            far_m: distance,
            low_m: 0.3 * self.depth.least_m,
            high_m: 0.5 * self.depth.least_m,
        };
        let tilt_deg = sight.tilt_deg(altitude.middle());
        let field_m = (0.3 * half).min(view.field_m.max(0.5));
        View { distance_m: Amount::Exactly(distance), altitude, tilt_deg, field_m, sight, holds: true }
    }

    fn too_steep(&self, what: String) -> Problem {
        let source = self.asked.wish.path.range_m.as_ref().map_or(&Source::Model, |said| &said.source);
        self.asked.problem(source, what, "write a greater range, or another altitude")
    }

    /// Farthest range that the things ask for, metres.
    fn far(&self, form: Form, view: &View) -> f64 {
        if let Some(said) = &self.asked.wish.sonar.most_range_m {
            return said.value.ends()[1];
        }
        let [_, highest] = view.altitude.amount.ends();
        let sight = view.sight;
        let far = match form {
            Form::Lawnmower | Form::Along | Form::Through => BEYOND_ON_LINES * sight.slant_m(highest),
            Form::Dive => sight.slant_m(self.depth.least_m),
            Form::Orbit | Form::Views | Form::Approach | Form::Hover => {
                let shadow = sight.shadow_m(view.altitude.amount.ends()[0], self.sizes.tallest_m);
                sight.slant_m(highest) + 0.5 * self.sizes.longest_m + shadow
            }
        };
        up(BEYOND * far)
    }

    /// The same, where the way goes farther off.
    fn far_of_way(&self, way: &Way, far_m: f64, view: &View) -> f64 {
        if self.asked.wish.sonar.most_range_m.is_some() {
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
        let shadow = view.sight.shadow_m(height, self.sizes.tallest_m);
        let least = BEYOND * (slant + 0.5 * self.sizes.longest_m + shadow);
        match way {
            Way::Views { .. } => up(least),
            _ => far_m.max(up(least)),
        }
    }

    fn near(&self, far_m: f64, view: &View, device: &Device) -> Result<f64, Problem> {
        if let Some(said) = &self.asked.wish.sonar.least_range_m {
            let near = said.value.ends()[0];
            if near >= far_m {
                let what = format!("a range from {near} m to {far_m} m runs backwards");
                return Err(self.asked.problem(&said.source, what, "write a farther end of the range"));
            }
            return Ok(near);
        }
        let nearest = (view.sight.near_m - 0.5 * self.sizes.longest_m).max(0.2);
        let near = (NEAR * far_m).max(NEAR_M).min(0.6 * nearest).max(device.range_m[0].min(0.5 * far_m));
        let step = if near < 1.0 { 0.1 } else { 0.5 };
        Ok(((near / step).floor() * step * 10.0).round() / 10.0).map(|near: f64| near.max(0.1).min(0.5 * far_m))
    }
}

/// Whether a thing leans on the structure, or lies beside it.
pub(super) fn is_at(structure: Option<&Structure>, placing: &Placing) -> bool {
    structure.is_some_and(|structure| structure.is_meant_by(&placing.manner.kind))
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
