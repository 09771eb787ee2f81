//! Keeping clear: a pose that is too near the bottom, an object or a structure is moved to where there is room.
//!
//! Along a path it rises over things, and begins to climb ahead of them, so that the path stays smooth. A pose without a
//! path, and what stands higher than [`MOST_RISE_M`] over one, such as a quay or a pile, is left the shortest way, up or
//! aside.

use std::f64::consts::TAU;

use glam::DVec3;

use super::trajectory::{Leg, Voyage};
use crate::math::Pose;
use crate::math::real::{cos, sin};

/// Highest thing that a path rises over, metres.
const MOST_RISE_M: f64 = 4.0;
/// Climb of a vehicle that rises over something ahead, metres up for each metre of way at its speed: 30°.
const CLIMB: f64 = 0.577;
/// Way between the places ahead and behind that are looked at, metres.
const AHEAD_STEP_M: f64 = 0.5;
/// Shortest step up that is tried, metres; steps are at least as long as what is missing.
const LEAST_STEP_M: f64 = 0.05;
/// Growth from step to step: walls are high.
const GROWTH: f64 = 1.5;
/// Halvings of the last step.
const HALVINGS: u32 = 9;
/// Steps up, enough for any height.
const MOST_STEPS: u32 = 40;
/// Way to the side that is tried at most, and its steps, metres.
const ASIDE_M: [f64; 2] = [10.0, 0.25];
/// Directions to the side.
const DIRECTIONS: u32 = 16;
/// Missing room that is none, metres.
const NOTHING_M: f64 = 1e-9;

/// How far a pose must rise before there is room, metres; `None` where `most` over the bottom do not suffice.
fn rise(pose: &Pose, voyage: &Voyage, most: f64) -> Option<f64> {
    let lifted = |up: f64| Pose { position: pose.position + DVec3::Z * up, ..*pose };
    let from_bottom = over_bottom(pose, voyage);
    let mut up = from_bottom;
    let mut missing = shortage(&lifted(up), voyage);
    if missing <= NOTHING_M {
        return Some(up);
    }
    let (mut below, mut step) = (up, LEAST_STEP_M);
    for _ in 0..MOST_STEPS {
        below = up;
        step = missing.max(GROWTH * step);
        up += step;
        if below >= from_bottom + most {
            return None;
        }
        missing = shortage(&lifted(up), voyage);
        if missing <= NOTHING_M {
            break;
        }
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (below + up);
        if shortage(&lifted(middle), voyage) <= NOTHING_M { up = middle } else { below = middle }
    }
    (up <= from_bottom + most).then_some(up)
}

/// The origins of the vehicle and of its sonar, which may be one.
fn origins(pose: &Pose, voyage: &Voyage) -> [DVec3; 2] {
    [pose.position, pose.apply(voyage.mount.position)]
}

/// How far both origins must rise to have their room over the bottom, metres.
fn over_bottom(pose: &Pose, voyage: &Voyage) -> f64 {
    let missing = |point: DVec3| voyage.around.floor(point) + voyage.vehicle.clear_m - point.z;
    origins(pose, voyage).map(missing).into_iter().fold(0.0, f64::max)
}

/// Room that the vehicle or its sonar lacks all round, metres.
fn shortage(pose: &Pose, voyage: &Voyage) -> f64 {
    // Not even without any room may it be in something, or touch it.
    let room = voyage.vehicle.clear_m.max(1e-3);
    let [vehicle, sonar] = origins(pose, voyage);
    let missing = room - voyage.around.gap(vehicle, room);
    if sonar == vehicle { missing } else { missing.max(room - voyage.around.gap(sonar, room)) }
}

/// How far a vehicle on a path rises over what it passes, metres: where it stands as far as it must, before and after
/// that no steeper than [`CLIMB`]. The places that are looked at are fixed on the path, so that neighbouring frames agree.
pub(super) fn rise_along(leg: &Leg, voyage: &Voyage) -> f64 {
    let mut risen = rise(&(leg.at)(leg.share), voyage, MOST_RISE_M).unwrap_or(0.0);
    let way = leg.speed_m_s * leg.duration_s;
    // Also refuses what is no number.
    if !(way > 0.0 && way.is_finite()) {
        return risen;
    }
    let here = leg.share * way / AHEAD_STEP_M;
    let reach = MOST_RISE_M / CLIMB / AHEAD_STEP_M + 1.0;
    let (first, last) = ((here - reach).max(0.0).ceil() as u64, (here + reach).min(way / AHEAD_STEP_M).floor() as u64);
    for place in first..=last {
        // A place speaks for the way to its neighbours.
        let between = ((place as f64 - here).abs() - 1.0).max(0.0) * AHEAD_STEP_M;
        if MOST_RISE_M - CLIMB * between <= risen {
            continue;
        }
        let there = (leg.at)(place as f64 * AHEAD_STEP_M / way);
        if let Some(needed) = rise(&there, voyage, MOST_RISE_M) {
            risen = risen.max(needed - CLIMB * between);
        }
    }
    risen
}

/// The pose where there is room about it: itself, or moved up or aside, whichever is the shorter way.
pub(super) fn kept(pose: Pose, voyage: &Voyage) -> Pose {
    let moved = |by: DVec3| Pose { position: pose.position + by, ..pose };
    // The steps of a rise have no limit but their number.
    let up = rise(&pose, voyage, f64::INFINITY).unwrap_or(0.0);
    let from_bottom = over_bottom(&pose, voyage);
    let rings = (1..).map(|ring| f64::from(ring) * ASIDE_M[1]);
    let aside = rings.take_while(|&radius| radius <= ASIDE_M[0].min(up - from_bottom)).flat_map(|radius| {
        (0..DIRECTIONS).map(move |k| {
            let angle = TAU * f64::from(k) / f64::from(DIRECTIONS);
            DVec3::new(cos(angle) * radius, sin(angle) * radius, from_bottom)
        })
    });
    let has_room = |pose: &Pose| over_bottom(pose, voyage).max(shortage(pose, voyage)) <= NOTHING_M;
    aside.map(moved).find(has_room).unwrap_or_else(|| moved(DVec3::Z * up))
}
