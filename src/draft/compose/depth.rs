//! Depth of the water, and where the vehicle is in it.

use super::asked::{Asked, Figure, assumed};
use super::placing::Placing;
use super::structure::{Kind, Structure};
use crate::draft::wish::{Amount, Route, Said};
use crate::draft::{Problem, infer::sight};

/// Depth where nobody says it and nothing asks for more, metres: the default of recipes.
pub(super) const USUAL_M: f64 = 10.0;
/// Shallowest place of a vehicle under the surface, metres.
pub(super) const UNDER_SURFACE_M: f64 = 0.5;
/// Lowest place over the bottom, metres.
pub(super) const LEAST_M: f64 = 0.4;

/// Depth of the water and what follows from it.
pub(super) struct Depth {
    /// What is written; nothing where the default does.
    pub written: Option<Figure>,
    /// The shallowest, metres.
    pub least_m: f64,
    /// Of the sonar over the bottom, as far as it was said.
    pub altitude: Option<Figure>,
}

/// Depth and altitude as they were said or follow.
pub(super) fn depth(asked: &Asked, structure: Option<&Structure>, placings: &[Placing]) -> Result<Depth, Problem> {
    let said = asked.wish.water.depth_m.as_ref();
    let (written, least_m) = match said {
        Some(depth) => {
            positive(asked, depth)?;
            (Some(asked.figure(depth)), depth.value.ends()[0])
        }
        None => unsaid(asked, structure, placings),
    };
    let altitude = altitude(asked, said, least_m)?;
    things_fit(asked, placings, said, least_m)?;
    Ok(Depth { written, least_m, altitude })
}

fn positive(asked: &Asked, depth: &Said<Amount>) -> Result<(), Problem> {
    let [low, high] = depth.value.ends();
    if low > 0.0 && high <= 12_000.0 {
        return Ok(());
    }
    let what = format!("water of {low} m depth");
    Err(asked.problem(&depth.source, what, "write a depth above 0 and up to 12000 m"))
}

/// The usual depth, more where something asks for more.
fn unsaid(asked: &Asked, structure: Option<&Structure>, placings: &[Placing]) -> (Option<Figure>, f64) {
    let path = &asked.wish.path;
    if let Some(tank) = structure.filter(|structure| structure.kind == Kind::Tank) {
        let depth = tank.tank_m()[2];
        return (Some(Figure::assumed(Amount::Exactly(depth), "the tank is full")), depth);
    }
    let most = |said: &Option<Said<Amount>>| said.as_ref().map_or(0.0, |said| said.value.ends()[1]);
    let places = path.position_m.iter().map(|said| said.value);
    let places = places.chain(path.points_m.iter().flat_map(|said| said.value.iter().copied()));
    let over = places.map(|place| place[2]).fold(most(&path.altitude_m), f64::max);
    let dive = match path.route.as_ref().map(|said| &said.value) {
        Some(Route::Dive { depth_m, .. }) => *depth_m,
        _ => 0.0,
    };
    let below = most(&path.vehicle_depth_m).max(dive);
    let natural = placings.iter().map(|placing| sight::distance_m(placing.bulk.longest_m[1])).fold(5.0, f64::max);
    let tallest = placings.iter().map(Placing::height_m).fold(0.0, f64::max);
    let sides = [
        (over + UNDER_SURFACE_M + 1.0, over > 0.0, "so that the vehicle is in the water"),
        (below + sight::altitude_m(natural), below > 0.0, "so deep that the bottom is in the beam from there"),
        (1.5 * tallest + 1.0, true, "so that the objects are in the water"),
        (sight::altitude_m(natural) + 2.0, true, "so that the sonar looks down at the objects"),
    ];
    let (depth, _, why) =
        sides.into_iter().filter(|side| side.1).fold((0.0, false, ""), |a, b| if b.0 > a.0 { b } else { a });
    let is_said = below > 0.0;
    if depth <= USUAL_M && !is_said {
        return (None, USUAL_M);
    }
    // What hangs below the surface is exactly there: the depth is one number.
    let depth = if is_said { sight::round(depth) } else { depth.ceil() };
    (Some(Figure { amount: Amount::Exactly(depth), why: assumed(why) }), depth)
}

/// Height of the sonar over the bottom, as it was said.
fn altitude(asked: &Asked, depth: Option<&Said<Amount>>, least_m: f64) -> Result<Option<Figure>, Problem> {
    let path = &asked.wish.path;
    if let Some(said) = &path.altitude_m {
        let [low, high] = said.value.ends();
        if low < 0.0 {
            return Err(asked.problem(
                &said.source,
                format!("an altitude of {low} m is below the bottom"),
                "write a height above 0",
            ));
        }
        if depth.is_some() && high >= least_m {
            let what = format!("{high} m above the bottom is out of the water, which is {least_m} m deep");
            return Err(asked.problem(
                &said.source,
                what,
                format!("write an altitude below {least_m} m, or deeper water"),
            ));
        }
        return Ok(Some(asked.figure(said)));
    }
    if let Some(said) = &path.vehicle_depth_m {
        let [low, high] = said.value.ends();
        if low < 0.0 {
            return Err(asked.problem(
                &said.source,
                "the vehicle is above the surface",
                "write a depth of 0 m or more",
            ));
        }
        if high > least_m - 0.3 {
            let what =
                format!("a vehicle {high} m under the surface is in the bottom of water that is {least_m} m deep");
            return Err(asked.problem(&said.source, what, "write a smaller depth of the vehicle, or deeper water"));
        }
        let over = |under: f64| super::way::exact_m(least_m - under);
        let amount = match &said.value {
            Amount::Exactly(under) => Amount::Exactly(over(*under)),
            Amount::Between(less, more) => Amount::Between(over(*more), over(*less)),
            Amount::OneOf(values) => Amount::OneOf(values.iter().map(|under| over(*under)).collect()),
            Amount::Steps(first, last, count) => Amount::Steps(over(*first), over(*last), *count),
        };
        let why = format!("{} of {least_m} m of water", asked.why(&said.source));
        return Ok(Some(Figure { amount, why }));
    }
    if let Some(said) = &path.position_m {
        let height = super::placing::at_height(said.value[2], least_m);
        if said.value[2] > 0.0 && depth.is_some() && height >= least_m {
            let what = format!("{height} m above the bottom is out of the water, which is {least_m} m deep");
            return Err(asked.problem(&said.source, what, "write a lower place, or deeper water"));
        }
        return Ok(Some(Figure { amount: Amount::Exactly(height), why: asked.why(&said.source) }));
    }
    if let Some(said) = &path.points_m {
        let heights = said.value.iter().map(|point| super::placing::at_height(point[2], least_m));
        let count = said.value.len().max(1) as f64;
        let mean = super::way::exact_m(heights.clone().sum::<f64>() / count);
        let highest = heights.fold(0.0, f64::max);
        if depth.is_some() && highest >= least_m {
            let what = format!("{highest} m above the bottom is out of the water, which is {least_m} m deep");
            return Err(asked.problem(&said.source, what, "write lower places, or deeper water"));
        }
        return Ok(Some(Figure { amount: Amount::Exactly(mean), why: asked.why(&said.source) }));
    }
    Ok(None)
}

/// Refuses what does not fit between bottom and surface, where the depth is said.
fn things_fit(asked: &Asked, placings: &[Placing], depth: Option<&Said<Amount>>, least_m: f64) -> Result<(), Problem> {
    let Some(depth) = depth else { return Ok(()) };
    for placing in placings {
        let height = placing.height_m();
        let [_, middle] = placing.heights_m(least_m, [0.0, 0.0]);
        if height > least_m || middle > least_m {
            let top = height.max(middle + 0.5 * height);
            let what = format!(
                "{}: it reaches {top:.1} m over the bottom of water that is {least_m} m deep",
                placing.thing.label
            );
            return Err(asked.problem(
                &depth.source,
                what,
                format!("write a depth above {top:.0} m, or another object"),
            ));
        }
    }
    Ok(())
}
