//! Where vehicle and objects are: altitudes, ranges, lengths of paths.

use serde_json::Value;

use crate::drafted::{Drafted, View, items, kind};
use crate::expected::Vocabulary;
use crate::number::{Grain, Number};

/// How far from a place that was said an object may lie, metres.
const NEAR_M: f64 = 0.75;

/// Tilt of the sonar: that of its mount, and of the vehicle where it hovers.
pub fn pitches(drafted: &Drafted) -> Vec<f64> {
    let mounts = drafted.of_jobs("/sonar/mount/pitch_deg");
    let hovers = drafted.of_jobs("/trajectory/hover/pitch_deg");
    let of = |value: Option<&&Value>| value.and_then(|value| value.as_f64()).unwrap_or_default();
    (0..mounts.len()).map(|at| of(mounts.get(at)) + of(hovers.get(at))).collect()
}

/// Altitudes as the trajectories have them; those of the frames where they have none.
pub fn altitudes(drafted: &Drafted) -> Vec<f64> {
    let ways = drafted.of_jobs("/trajectory");
    let stated: Vec<f64> = ways.iter().filter_map(|way| kind(way).1["altitude_m"].as_f64()).collect();
    if stated.len() == ways.len() {
        return stated;
    }
    drafted.views().iter().map(|view| view.vehicle[2] - view.ground_m).collect()
}

/// The greatest depth of the vehicle below the surface.
pub fn deepest(drafted: &Drafted) -> Vec<f64> {
    drafted.views().iter().map(|view| view.depth_m - view.vehicle[2]).reduce(f64::max).into_iter().collect()
}

/// Lengths of paths, metres.
pub fn lengths(drafted: &Drafted) -> Vec<f64> {
    drafted.of_jobs("/trajectory").into_iter().filter_map(|way| length(kind(way))).collect()
}

fn length((name, of): (&str, &Value)) -> Option<f64> {
    let along = || {
        let points: Vec<Vec<f64>> = items(&of["points_m"])
            .iter()
            .map(|point| items(point).iter().filter_map(Value::as_f64).collect())
            .collect();
        let step = |ends: &[Vec<f64>]| {
            ends[0].iter().zip(&ends[1]).map(|(from, to)| (to - from) * (to - from)).sum::<f64>().sqrt()
        };
        (points.len() > 1).then(|| points.windows(2).map(step).sum())
    };
    match name {
        "terrain" => along().or_else(|| of["length_m"].as_f64()),
        "waypoints" => along(),
        "lawnmower" => Some(of["length_m"].as_f64()? * of["lines"].as_f64()?),
        _ => None,
    }
}

/// Distances of the nearest object in each frame: in plan, and along the slant.
pub fn ranges(drafted: &Drafted, things: &[&str], words: &Vocabulary) -> Vec<[f64; 2]> {
    let range = |view: &View| {
        let wanted = view.bodies.iter().filter(|(label, asset, _)| {
            things.is_empty() || things.iter().any(|word| drafted.is_built(label, asset, word, words))
        });
        let distances = wanted.map(|(_, _, place)| {
            let [x, y, z] = [0, 1, 2].map(|axis| place[axis] - view.vehicle[axis]);
            [(x * x + y * y).sqrt(), (x * x + y * y + z * z).sqrt()]
        });
        distances.min_by(|one, other| one[1].total_cmp(&other[1]))
    };
    drafted.views().iter().filter_map(range).collect()
}

/// Whether objects are as far away as is expected, in plan or along the slant.
pub fn is_at_range(expected: &Number, ranges: &[[f64; 2]]) -> bool {
    let reaches =
        |[low, high]: [f64; 2]| !ranges.is_empty() && ranges.iter().all(|[plan, slant]| *slant >= low && *plan <= high);
    match expected {
        Number::Range { from, to } => {
            let slants = ranges.iter().map(|[_, slant]| *slant);
            let spanned = slants.clone().fold(0.0, f64::max) - slants.fold(f64::INFINITY, f64::min);
            reaches([0.9 * from - 0.5, 1.1 * to + 0.5]) && spanned >= 0.6 * (to - from)
        }
        Number::Between(ends) => reaches(*ends),
        other => other.takes(&ranges.iter().map(|[_, slant]| *slant).collect::<Vec<_>>(), Grain::Measured),
    }
}

/// Ranges for people.
pub fn told(ranges: &[[f64; 2]]) -> String {
    let slants = ranges.iter().map(|[_, slant]| *slant);
    let (least, most) = (slants.clone().fold(f64::INFINITY, f64::min), slants.fold(0.0, f64::max));
    if ranges.is_empty() { "no object".into() } else { format!("{least:.1} to {most:.1} m along the slant") }
}

/// Places of all that a word stands for, x and y.
pub fn places(drafted: &Drafted, word: &str, words: &Vocabulary) -> Vec<[f64; 2]> {
    let bodies = drafted.views().iter().flat_map(|view| &view.bodies);
    let wanted = bodies.filter(|(label, asset, _)| drafted.is_built(label, asset, word, words));
    wanted.map(|(_, _, place)| [place[0], place[1]]).collect()
}

pub fn is_inside(place: [f64; 2], corners: [[f64; 2]; 2]) -> bool {
    (0..2).all(|axis| {
        let [low, high] = [corners[0][axis].min(corners[1][axis]), corners[0][axis].max(corners[1][axis])];
        (low - NEAR_M..=high + NEAR_M).contains(&place[axis])
    })
}

/// Places for people.
pub fn spanned(places: &[[f64; 2]]) -> String {
    let ends = |axis: usize| {
        let along = places.iter().map(|place| place[axis]);
        (along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max))
    };
    let ((west, east), (south, north)) = (ends(0), ends(1));
    if places.is_empty() { "none".into() } else { format!("x {west:.1} to {east:.1}, y {south:.1} to {north:.1}") }
}
