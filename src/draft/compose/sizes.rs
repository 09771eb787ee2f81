//! Sizes of what is to be seen, and the room that it takes.

use super::asked::Asked;
use super::depth::Depth;
use super::placing::{Kind as Pose, Place, Placing};
use super::structure::{Kind, Structure};
use crate::draft::Problem;
use crate::draft::infer::{room, sight};

/// Where things float that nobody gave a height, metres over the bottom, and the part of the depth they keep below.
const MID_WATER_M: [f64; 2] = [1.0, 3.0];
const MID_WATER: f64 = 0.6;
/// The same in a net pen, parts of the depth.
const IN_PEN: [f64; 2] = [0.5, 0.7];
/// Part of a tank's longer side that a thing may have.
const IN_TANK: f64 = 0.7;

/// Sizes of what is to be seen.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    pub longest_m: f64,
    pub smallest_m: f64,
    pub tallest_m: f64,
    pub heights_m: [f64; 2],
    /// Of scattered and placed things about their middle.
    pub field_m: f64,
    /// How far their middle is from the world's origin.
    pub off_m: f64,
}

impl Sizes {
    pub fn of(placings: &[Placing], depth_m: f64, mid_water_m: [f64; 2]) -> Self {
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

/// Heights where things float that nobody gave one; in a net pen above its floor.
pub(super) fn mid_water(depth: &Depth, structure: Option<&Structure>) -> [f64; 2] {
    if structure.is_some_and(|structure| structure.kind == Kind::NetPen) {
        return IN_PEN.map(|part| sight::round(part * depth.least_m));
    }
    let high = (MID_WATER * depth.least_m).min(MID_WATER_M[1]);
    [MID_WATER_M[0].min(0.5 * high), high].map(sight::round)
}

/// Refuses what is larger than its tank.
pub(super) fn fits(asked: &Asked, structure: Option<&Structure>, placings: &[Placing]) -> Result<(), Problem> {
    let Some(tank) = structure.filter(|structure| structure.kind == Kind::Tank) else { return Ok(()) };
    let [length, width, depth] = tank.tank_m();
    for placing in placings {
        let (size, label) = (placing.bulk.longest_m[0], &placing.thing.label);
        if size > IN_TANK * length.max(width) || placing.height_m().min(size) > depth {
            let source = asked.wish.environment_m.as_ref().map_or(&placing.thing.called.source, |said| &said.source);
            let what = format!("{label}: {size:.1} m do not fit into a tank of {length} × {width} × {depth} m");
            return Err(asked.problem(source, what, "write a larger tank, or a smaller object"));
        }
    }
    Ok(())
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
    // One thing alone, or one heap, is in the middle or nearly so.
    let single = match placings {
        [only] if only.manner.kind == Pose::Heap => Some(only.reach_m()),
        [only] if only.count.most() == 1 => Some(0.0),
        _ => None,
    };
    let rows = scattered().filter(|placing| matches!(placing.manner.kind, Pose::Row(_))).map(Placing::reach_m);
    match said.fold(0.0, f64::max) {
        around if around > 0.0 => around,
        _ if let Some(reach) = single => reach + room::stray_m(sight::distance_m(placings[0].bulk.longest_m[1])),
        _ => rows.fold(room::disc_m(sizes), f64::max),
    }
}
