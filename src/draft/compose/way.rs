//! The way of the vehicle: which kind of trajectory, with which lengths.

use super::asked::{Asked, Figure, assumed};
use super::structure::{Kind, Structure};
use super::view::{View, varied};
use crate::draft::infer::budget::Frames;
use crate::draft::wish::{Amount, Route, Said};

/// Highest slope on which a level vehicle has things in its beam all round, degrees.
const GENTLE_DEG: f64 = 10.0;
/// Fan below which a circle about several things sees but one of them, degrees.
const NARROW_DEG: f64 = 45.0;
/// Highest over lowest altitude that one tilt serves.
const WIDE: f64 = 1.6;

/// What a vehicle does.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Way {
    /// About the things.
    Orbit {
        radius_m: Amount,
        arc_deg: Option<f64>,
        start_deg: Amount,
    },
    /// At a distance by sound from one of them at a time.
    Views {
        range_m: Amount,
    },
    Lawnmower {
        length_m: f64,
        spacing_m: f64,
        lines: u32,
        heading_deg: Amount,
    },
    /// Along the x axis, or a heading.
    Terrain {
        length_m: f64,
        heading_deg: f64,
        centre_m: [f64; 2],
        yaw_deg: f64,
    },
    /// Distances in plan.
    Approach {
        from_m: f64,
        to_m: f64,
        course_deg: Amount,
    },
    Hover {
        place_m: [f64; 2],
        yaw_deg: f64,
    },
    /// Through places, z over the bottom.
    Through {
        points_m: Vec<[f64; 3]>,
    },
    /// Heights over the bottom, one after the other.
    Dive {
        away_m: f64,
        heights_m: Vec<f64>,
    },
}

/// A way, and who says it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Going {
    pub way: Way,
    pub why: String,
    pub frames: Frames,
}

/// Which kind of way, before any length is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Orbit,
    Views,
    Lawnmower,
    Along,
    Approach,
    Hover,
    Through,
    Dive,
}

/// What a form is chosen by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Things {
    /// Whether there are several.
    pub scattered: bool,
    /// Whether one of them is told from the vehicle.
    pub from_vehicle: bool,
    /// Whether one of them leans on the structure, or lies beside it.
    pub at_structure: bool,
}

/// The form of way that was asked for, or that suits, with the reason.
pub(super) fn form(asked: &Asked, structure: Option<&Structure>, of: Things) -> (Form, String) {
    let Things { scattered, from_vehicle, at_structure } = of;
    let path = &asked.wish.path;
    if let Some(Said { value, source }) = &path.route {
        let form = match value {
            Route::Orbit { .. } => Form::Orbit,
            Route::Lawnmower { .. } => Form::Lawnmower,
            Route::Follow { .. } => Form::Along,
            Route::Approach { .. } => Form::Approach,
            Route::Views => Form::Views,
            Route::Hover => Form::Hover,
            Route::Dive { .. } => Form::Dive,
        };
        return (form, asked.why(source));
    }
    if let Some(said) = path.range_m.as_ref().filter(|said| matches!(said.value, Amount::Steps(..))) {
        return (Form::Approach, asked.why(&said.source));
    }
    if let Some(said) = path.points_m.as_ref().filter(|said| said.value.len() > 1) {
        return (Form::Through, asked.why(&said.source));
    }
    if let Some(said) = &path.position_m {
        return (Form::Hover, asked.why(&said.source));
    }
    let suits = |form: Form, why: &str| (form, assumed(why));
    if at_structure && structure.is_some_and(|structure| structure.kind.is_long()) {
        return suits(Form::Along, "along the wall, turned to what stands at it");
    }
    let kind = structure.map(|structure| structure.kind);
    if from_vehicle {
        return suits(Form::Hover, "things are told from the vehicle, which keeps its place");
    }
    match kind {
        Some(Kind::Pipeline) => return suits(Form::Along, "along the pipe"),
        Some(Kind::Pier) if asked.wish.things.is_empty() => return suits(Form::Along, "along the pier"),
        Some(Kind::Harbour) if asked.wish.things.is_empty() => return suits(Form::Along, "along the quay"),
        Some(Kind::Dam) if asked.wish.things.is_empty() => return suits(Form::Along, "along the wall"),
        Some(Kind::Pier) => return suits(Form::Views, "between piles a view must be free, which views look for"),
        Some(Kind::Dam | Kind::Harbour | Kind::Tank | Kind::NetPen) => {}
        None if asked.wish.things.is_empty() => {
            return suits(Form::Along, "there is nothing to look at but the bottom");
        }
        None => {}
    }
    let azimuth = asked.wish.sonar.fov_deg.as_ref().map(|said| said.value.ends()[0]);
    if scattered && azimuth.is_some_and(|azimuth| azimuth < NARROW_DEG) {
        return suits(Form::Views, "a narrow fan is turned to one object at a time");
    }
    if asked.wish.seabed.slope_deg.as_ref().is_some_and(|slope| slope.value.ends()[1].abs() > GENTLE_DEG) {
        return suits(Form::Views, "on a slope the sonar is pitched towards the objects");
    }
    let wide = |said: &Said<Amount>| said.value.ends()[1] > WIDE * said.value.ends()[0];
    if path.altitude_m.as_ref().is_some_and(wide) || path.vehicle_depth_m.as_ref().is_some_and(wide) {
        return suits(Form::Views, "from each altitude the sonar is pitched towards the objects");
    }
    if path.range_m.is_some() && scattered {
        return suits(Form::Views, "each frame is at that distance from one of the objects");
    }
    suits(Form::Orbit, "round the objects")
}

/// A length to the millimetre.
pub(super) fn exact_m(value: f64) -> f64 {
    let rounded = (value * 1000.0).round() / 1000.0;
    if rounded == 0.0 { 0.0 } else { rounded }
}

impl Way {
    /// Whether each frame is pitched towards its object, whatever the mount's tilt.
    pub fn aims(&self) -> bool {
        matches!(self, Self::Views { .. } | Self::Approach { .. })
    }

    /// How far the sonar is turned to port, degrees.
    pub fn yaw_deg(&self) -> f64 {
        if let Self::Terrain { yaw_deg, .. } = self { *yaw_deg } else { 0.0 }
    }
}

/// The comment of a radius or a range.
pub(super) fn distance_why(asked: &Asked, view: &View) -> String {
    match &asked.wish.path.range_m {
        Some(said) => asked.why(&said.source),
        None if view.holds => assumed("the objects fill the picture and are in the beam together"),
        None => assumed("as near as the objects are in the beam"),
    }
}

/// An altitude, varied where nobody said it.
pub(super) fn altitude_of(asked: &Asked, view: &View) -> Figure {
    let path = &asked.wish.path;
    let said = path.altitude_m.is_some() || path.vehicle_depth_m.is_some() || path.position_m.is_some();
    if said || asked.wish.sonar.pitch_deg.is_some() || path.range_m.is_some() {
        return view.altitude.clone();
    }
    Figure { amount: varied(&view.altitude.amount), why: view.altitude.why.clone() }
}
