//! Each form of way with its lengths.

use super::asked::Asked;
use super::structure::{Kind, Structure};
use super::view::{View, varied};
use super::way::{Form, Going, Way, exact_m};
use crate::draft::infer::budget::Frames;
use crate::draft::infer::sight::{reach_from_orbit_m, round};
use crate::draft::wish::{Amount, Route};
use crate::math::real::{atan2, cos, degrees, radians, sin};

/// Frames of a scene along a circle and of random views.
const FRAMES_ROUND: u64 = 10;
/// Frames of a scene along lines and walls.
const FRAMES_ALONG: u64 = 30;
/// Most frames of one scene: beyond that several scenes teach more.
const MOST_OF_ONE_SCENE: u64 = 100;
/// Distance in plan of a dive over its highest point.
const DIVE_OFF: f64 = 1.2;
/// Lines of a survey, and from line to line as part of the range.
const SPACING: f64 = 0.7;
/// Fewest and most lines where an area is not said.
const LINES: [f64; 2] = [3.0, 9.0];

/// What a way is chosen by.
pub(super) struct Ground<'a> {
    pub asked: &'a Asked<'a>,
    pub structure: Option<&'a Structure>,
    pub view: &'a View,
    pub azimuth_deg: f64,
    pub far_m: f64,
    pub depth_m: f64,
    /// Radius of the disc on which things are, metres; 0 without things.
    pub field_m: f64,
}

impl Ground<'_> {
    /// The way of a form.
    pub fn go(&self, form: Form, why: String) -> Going {
        let route = self.asked.wish.path.route.as_ref().map(|said| &said.value);
        let (way, frames) = match form {
            Form::Orbit => self.orbit(route),
            Form::Views => self.views(),
            Form::Lawnmower => self.lawnmower(route),
            Form::Along => self.along(route),
            Form::Approach => self.approach(route),
            Form::Hover => (self.hover(), Frames::About(1)),
            Form::Through => self.through(),
            Form::Dive => self.dive(route),
        };
        Going { way, why, frames }
    }

    fn orbit(&self, route: Option<&Route>) -> (Way, Frames) {
        let (arc_deg, sides) = match route {
            Some(Route::Orbit { arc_deg, sides }) => (*arc_deg, *sides),
            _ => (None, None),
        };
        let anywhere = Amount::Between(0.0, 360.0);
        let (arc_deg, start_deg) = match self.structure.map(|structure| structure.kind) {
            // From where there is no wall, looking at it.
            Some(Kind::Dam) if arc_deg.is_none() => (Some(120.0), Amount::Between(110.0, 130.0)),
            Some(Kind::NetPen) if arc_deg.is_none() => (Some(150.0), anywhere),
            _ => (arc_deg, anywhere),
        };
        let said = self.asked.wish.path.range_m.is_some();
        let free = self.structure.is_none_or(|structure| structure.room_m().is_infinite());
        let radius_m = match &self.view.distance_m {
            exactly if said || !free => exactly.clone(),
            other => varied(other),
        };
        let frames = sides.map_or(Frames::About(FRAMES_ROUND), |sides| Frames::Exactly(u64::from(sides.max(1))));
        (Way::Orbit { radius_m, arc_deg, start_deg }, frames)
    }

    fn views(&self) -> (Way, Frames) {
        let range_m = match &self.asked.wish.path.range_m {
            Some(said) => said.value.clone(),
            None => {
                let distance = self.view.distance_m.ends()[0];
                Amount::Between(round(0.7 * distance), round(1.2 * distance))
            }
        };
        (Way::Views { range_m }, Frames::About(FRAMES_ROUND))
    }

    fn lawnmower(&self, route: Option<&Route>) -> (Way, Frames) {
        let Some(Route::Lawnmower { length_m, width_m, spacing_m, lines }) = route else {
            return self.lawnmower(Some(&Route::Lawnmower {
                length_m: None,
                width_m: None,
                spacing_m: None,
                lines: None,
            }));
        };
        let side = round(2.0 * self.field_m + self.view.distance_m.ends()[0]);
        let length_m = length_m.or(*width_m).unwrap_or(side);
        let spacing_m = match (*spacing_m, *width_m, *lines) {
            (Some(spacing), ..) => spacing,
            (None, Some(width), Some(lines)) if lines > 1 => width / f64::from(lines - 1),
            (None, Some(width), _) => {
                let gaps = (width / (SPACING * self.far_m)).ceil().max(2.0);
                width / gaps
            }
            (None, None, _) => round(SPACING * self.far_m),
        };
        let across = width_m.unwrap_or(length_m);
        let lines = lines.unwrap_or_else(|| lines_of(across, spacing_m, width_m.is_some()));
        let heading_deg = match &self.asked.wish.path.heading_deg {
            Some(said) => Amount::Exactly(said.value),
            None if width_m.is_some() => Amount::Exactly(0.0),
            None => Amount::Between(0.0, 360.0),
        };
        (Way::Lawnmower { length_m, spacing_m, lines, heading_deg }, Frames::Along(FRAMES_ALONG))
    }

    fn along(&self, route: Option<&Route>) -> (Way, Frames) {
        let said = match route {
            Some(Route::Follow { length_m, .. }) => *length_m,
            _ => None,
        };
        let length_m = said.unwrap_or(if self.structure.is_some() { 20.0 } else { 15.0 });
        let distance = self.view.distance_m.ends()[0];
        let (heading_deg, centre_m, yaw_deg) = match self.structure.map(|s| (s.kind, s)) {
            // To port of a vehicle that runs along x lies what has greater y.
            Some((Kind::Pier, pier)) => {
                let half = super::environment::half_width_m(Some(pier));
                (0.0, [0.0, exact_m(-(half + distance))], 60.0)
            }
            Some((Kind::Harbour, basin)) => {
                let half = super::environment::half_width_m(Some(basin));
                (0.0, [0.0, exact_m((half - distance).max(1.0 - half))], 60.0)
            }
            Some((Kind::Dam, _)) => (90.0, [exact_m(super::environment::DAM_DISTANCE_M - distance), 0.0], -60.0),
            _ => (self.asked.wish.path.heading_deg.as_ref().map_or(0.0, |said| said.value), [0.0, 0.0], 0.0),
        };
        (Way::Terrain { length_m, heading_deg, centre_m, yaw_deg }, Frames::Along(FRAMES_ALONG))
    }

    fn approach(&self, route: Option<&Route>) -> (Way, Frames) {
        let (from, to) = match route {
            Some(Route::Approach { from_m, to_m }) => (*from_m, *to_m),
            _ => (None, None),
        };
        let steps = match self.asked.wish.path.range_m.as_ref().map(|said| &said.value) {
            Some(Amount::Steps(first, last, count)) => Some((*first, *last, *count)),
            Some(Amount::Between(near, far)) => Some((*far, *near, None)),
            _ => None,
        };
        let distance = self.view.distance_m.ends()[0];
        let from_m = from.or(steps.map(|(first, ..)| first)).unwrap_or_else(|| round(1.6 * distance));
        let to_m =
            to.or(steps.map(|(_, last, _)| last)).unwrap_or_else(|| round((0.4 * from_m).max(self.field_m + 1.0)));
        let course_deg = match &self.asked.wish.path.heading_deg {
            Some(said) => Amount::Exactly(said.value),
            None if self.structure.is_some_and(|structure| structure.kind == Kind::Dam) => Amount::Between(-20.0, 20.0),
            None if self.structure.is_some() => Amount::Exactly(0.0),
            None => Amount::Between(0.0, 360.0),
        };
        let few = self.asked.wish.images.as_ref().is_none_or(|said| said.value <= MOST_OF_ONE_SCENE);
        let frames = match steps.and_then(|(.., count)| count) {
            Some(count) => Frames::Exactly(u64::from(count.max(1))),
            None if few && steps.is_some() => Frames::OneScene,
            None => Frames::Along(FRAMES_ALONG),
        };
        (Way::Approach { from_m, to_m, course_deg }, frames)
    }

    fn hover(&self) -> Way {
        let path = &self.asked.wish.path;
        let distance = self.view.distance_m.ends()[0];
        let heading = path.heading_deg.as_ref().map(|said| said.value);
        if let Some(said) = &path.position_m {
            let [x, y, _] = said.value;
            let to_middle = if x == 0.0 && y == 0.0 { 0.0 } else { exact_deg(degrees(atan2(-y, -x))) };
            return Way::Hover { place_m: [x, y], yaw_deg: heading.unwrap_or(to_middle) };
        }
        let yaw_deg = heading.unwrap_or(0.0);
        let away = |part: f64| exact_m(-distance * part);
        Way::Hover { place_m: [away(cos(radians(yaw_deg))), away(sin(radians(yaw_deg)))], yaw_deg }
    }

    /// Through the places that were said; below 0 they are told from the surface.
    fn through(&self) -> (Way, Frames) {
        let said = self.asked.wish.path.points_m.as_ref().map_or(&[][..], |said| &said.value);
        let over = |&[x, y, z]: &[f64; 3]| [x, y, exact_m(super::placing::at_height(z, self.depth_m))];
        let few = self.asked.wish.images.as_ref().is_none_or(|said| said.value <= MOST_OF_ONE_SCENE);
        let frames = if few { Frames::OneScene } else { Frames::Along(FRAMES_ALONG) };
        (Way::Through { points_m: said.iter().map(over).collect() }, frames)
    }

    fn dive(&self, route: Option<&Route>) -> (Way, Frames) {
        let (depth_m, back) = match route {
            Some(Route::Dive { depth_m, back }) => (*depth_m, *back),
            _ => (0.5 * self.depth_m, None),
        };
        let top = (self.depth_m - super::depth::UNDER_SURFACE_M).max(0.5);
        let below = (self.depth_m - depth_m).max(super::depth::LEAST_M);
        let mut heights_m = vec![exact_m(top), exact_m(below)];
        if back.is_some() {
            heights_m.push(exact_m(top));
        }
        let few = self.asked.wish.images.as_ref().is_none_or(|said| said.value <= MOST_OF_ONE_SCENE);
        let frames = match back.flatten() {
            // Down in so many frames, up again in as many, the turn counted once.
            Some(count) => Frames::Exactly(count.max(2)),
            None if few => Frames::OneScene,
            None => Frames::Along(FRAMES_ALONG),
        };
        // So far off that one tilt serves from above and from below.
        let away_m = self.view.distance_m.ends()[0].max(round(DIVE_OFF * top));
        (Way::Dive { away_m, heights_m }, frames)
    }

    /// How far from the world's origin anything is seen from the way, metres.
    pub fn reach_m(&self, way: &Way) -> f64 {
        let inwards = |distance: f64| reach_from_orbit_m(distance, self.far_m, self.azimuth_deg);
        match way {
            Way::Orbit { radius_m, .. } => {
                let [near, far] = radius_m.ends();
                self.field_m + inwards(near).max(inwards(far))
            }
            Way::Views { range_m } => self.field_m + inwards(range_m.ends()[0]).max(inwards(range_m.ends()[1])),
            Way::Lawnmower { length_m, spacing_m, lines, .. } => {
                let (x, y) = (0.5 * (length_m + spacing_m), 0.5 * spacing_m * f64::from(lines.saturating_sub(1)));
                (x * x + y * y).sqrt() + self.far_m
            }
            Way::Terrain { length_m, centre_m: [x, y], .. } => 0.5 * length_m + (x * x + y * y).sqrt() + self.far_m,
            Way::Approach { from_m, to_m, .. } => self.field_m + inwards(*from_m).max(inwards(*to_m)),
            Way::Hover { place_m: [x, y], yaw_deg } => {
                let away = (x * x + y * y).sqrt();
                let looks_in =
                    (x + cos(radians(*yaw_deg)) * away).abs() + (y + sin(radians(*yaw_deg)) * away).abs() < 0.01;
                if looks_in { inwards(away) } else { away + self.far_m }
            }
            Way::Through { points_m } => {
                points_m.iter().map(|[x, y, _]| (x * x + y * y).sqrt()).fold(0.0, f64::max) + self.far_m
            }
            Way::Dive { away_m, .. } => inwards(*away_m),
        }
    }
}

/// Lines over a width: 20 m in steps of 2 m take 11.
fn lines_of(across_m: f64, spacing_m: f64, said: bool) -> u32 {
    let lines = (across_m / spacing_m.max(1e-3) + 1e-6).floor() + 1.0;
    (if said { lines } else { lines.clamp(LINES[0], LINES[1]) }).clamp(1.0, 10_000.0) as u32
}

fn exact_deg(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twenty_metres_in_steps_of_two_are_eleven_lines() {
        assert_eq!(lines_of(20.0, 2.0, true), 11);
        assert_eq!(lines_of(20.0, 0.1, true), 201);
        assert_eq!((lines_of(5.0, 10.0, false), lines_of(500.0, 10.0, false)), (3, 9));
    }
}
