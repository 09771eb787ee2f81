//! A pipeline: joints of pipe laid over the seabed, sunk here and spanning there, under mattresses in places.

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::EnvironmentError;
use super::kinds::{material, within};
use super::solid::Solid;
use super::structure::Structure;
use crate::math::real::{cos, radians, sin};
use crate::math::rng::Stream;

/// Length of a joint of pipe, metres.
const JOINT_M: f64 = 12.0;
/// Straight pieces of a joint.
const PIECES: u32 = 8;

/// A pipe through the world's origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pipeline {
    /// Of the route, metres.
    pub length_m: f64,
    /// Outer diameter, metres.
    pub diameter_m: f64,
    /// Along the route, degrees counter-clockwise from x.
    pub direction_deg: f64,
    /// How far the route strays from the straight line, metres.
    pub wander_m: f64,
    /// Mean part of the diameter that is sunk into the ground, 0 to 1.
    pub burial: f64,
    /// Concrete mattresses over the pipe.
    pub mattresses: u32,
    /// What the pipe is coated with.
    pub material: String,
}

impl Pipeline {
    pub(super) const PARTS: &'static [&'static str] = &["field-joint", "mattress", "pipeline"];

    pub(super) fn check(&self) -> Result<(), EnvironmentError> {
        within("length_m", self.length_m, [1.0, 1000.0])?;
        within("diameter_m", self.diameter_m, [0.02, 5.0])?;
        within("direction_deg", self.direction_deg, [f64::MIN, f64::MAX])?;
        within("wander_m", self.wander_m, [0.0, 50.0])?;
        within("burial", self.burial, [0.0, 1.0])?;
        within("mattresses", self.mattresses.into(), [0.0, 100.0])?;
        material(&self.material)
    }

    pub(super) fn raise(&self, structure: &mut Structure, stream: &mut Stream) {
        let route = Route::new(self, structure, stream);
        let joints = (self.length_m / JOINT_M).ceil().max(1.0) as u32;
        let radius = 0.5 * self.diameter_m;
        for joint in 0..joints {
            let way = |piece: u32| {
                (self.length_m * (f64::from(joint) + f64::from(piece) / f64::from(PIECES)) / f64::from(joints))
                    .min(self.length_m)
            };
            let pieces: Vec<Solid> = (0..PIECES)
                .map(|piece| {
                    let (from, to) = (route.at(way(piece)), route.at(way(piece + 1)));
                    // Pieces reach a little into each other, so that bends show no gaps.
                    let lap = (to - from).normalize() * (0.05 * radius);
                    Solid::rod(from - lap, to + lap, radius, 24)
                })
                .collect();
            structure.part("pipeline", &self.material, &pieces);
            let (middle, next) = (route.at(way(0)), route.at(way(1)));
            let along = (next - middle).normalize() * 0.25;
            structure.part("field-joint", "steel", &[Solid::rod(middle - along, middle + along, 1.12 * radius, 24)]);
        }
        for mattress in 0..self.mattresses {
            let share = (f64::from(mattress) + stream.uniform(0.3, 0.7)) / f64::from(self.mattresses);
            self.mattress(share * self.length_m, &route, structure);
        }
    }

    /// Six by three metres of concrete blocks on ropes, draped over the pipe.
    fn mattress(&self, way: f64, route: &Route, structure: &mut Structure) {
        const BLOCK_M: f64 = 0.5;
        let middle = route.at(way);
        let along = (route.at(way + 0.5) - route.at(way - 0.5)).truncate().normalize();
        let blocks = (0..12).flat_map(|i| (0..6).map(move |j| (f64::from(i) - 5.5, f64::from(j) - 2.5)));
        let radius = 0.5 * self.diameter_m;
        let top = |across: f64, place: DVec2| {
            let ground = (structure.site.ground)(place.x, place.y);
            let over = (across.abs() - radius).max(0.0);
            ground.max(middle.z + radius - 1.2 * over)
        };
        let solids: Vec<Solid> = blocks
            .map(|(i, j)| {
                let across = i * BLOCK_M;
                let place = middle.truncate() + along * (j * BLOCK_M) + along.perp() * across;
                let reach = along.perp() * (0.43 * BLOCK_M);
                let end = |side: f64| {
                    let place = place + reach * side;
                    place.extend(top(across + side * 0.43 * BLOCK_M, place) + 0.1)
                };
                Solid::bar(end(-1.0), end(1.0), [0.86 * BLOCK_M, 0.25])
            })
            .collect();
        structure.part("mattress", "concrete", &solids);
    }
}

/// Middle line of the pipe: a point every metre.
struct Route(Vec<DVec3>);

impl Route {
    fn new(pipeline: &Pipeline, structure: &Structure, stream: &mut Stream) -> Self {
        let heading = radians(pipeline.direction_deg);
        let along = DVec2::new(cos(heading), sin(heading));
        let (phase, other) = (stream.uniform(0.0, 6.2), stream.uniform(0.0, 6.2));
        let count = pipeline.length_m.ceil() as usize + 1;
        let plan: Vec<DVec2> = (0..count)
            .map(|k| {
                let way = k as f64 - 0.5 * pipeline.length_m;
                let stray = 0.7 * sin(way / 9.0 + phase) + 0.3 * sin(way / 3.7 + other);
                along * way + along.perp() * (pipeline.wander_m * stray)
            })
            .collect();
        let lift = (0.5 - pipeline.burial) * pipeline.diameter_m;
        let ground: Vec<f64> = plan.iter().map(|p| (structure.site.ground)(p.x, p.y) + lift).collect();
        // A pipe is stiff: it lies on the mean of the ground over some ten metres.
        let middle = |k: usize| {
            let near = &ground[k.saturating_sub(5)..(k + 6).min(count)];
            near.iter().sum::<f64>() / near.len() as f64
        };
        Self(plan.iter().enumerate().map(|(k, p)| p.extend(middle(k))).collect())
    }

    /// The point that many metres along the route.
    fn at(&self, way: f64) -> DVec3 {
        let last = (self.0.len() - 1) as f64;
        let way = way.clamp(0.0, last);
        let before = (way as usize).min(self.0.len().saturating_sub(2));
        let after = (before + 1).min(self.0.len() - 1);
        self.0[before] + (self.0[after] - self.0[before]) * (way - before as f64)
    }
}
