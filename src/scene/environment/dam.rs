//! The upstream face of a dam: monoliths of concrete, intakes behind trash racks, outlet pipes.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::EnvironmentError;
use super::kinds::within;
use super::solid::Solid;
use super::structure::Structure;
use crate::math::rng::Stream;

/// How deep an intake reaches into the wall, metres.
const INTAKE_M: f64 = 2.5;
/// Thickness of the wall, metres.
const WALL_M: f64 = 4.0;

/// A wall along y that looks towards negative x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dam {
    /// From the world's origin to the face, along x, metres.
    pub distance_m: f64,
    /// Along y, metres.
    pub length_m: f64,
    /// Top above z = 0, metres.
    pub height_m: f64,
    /// Width of the monoliths that it is cast in, metres.
    pub monolith_m: f64,
    /// How far monoliths stand out from each other, at most, metres.
    pub offset_m: f64,
    /// Intakes, each in a monolith of its own.
    pub intakes: u32,
    /// Width and height of an intake, metres.
    pub intake_m: [f64; 2],
    /// From bar to bar of the racks, metres.
    pub bar_spacing_m: f64,
    /// Outlet pipes, each in a monolith without intake.
    pub pipes: u32,
    /// Outer diameter of a pipe, metres.
    pub pipe_m: f64,
}

impl Dam {
    pub(super) const PARTS: &'static [&'static str] = &["dam", "pipe", "trash-rack"];

    pub(super) fn check(&self) -> Result<(), EnvironmentError> {
        within("distance_m", self.distance_m, [0.0, 500.0])?;
        within("length_m", self.length_m, [2.0, 500.0])?;
        within("height_m", self.height_m, [2.0, 200.0])?;
        within("monolith_m", self.monolith_m, [1.0, 50.0])?;
        within("offset_m", self.offset_m, [0.0, 1.0])?;
        within("intakes + pipes", self.intakes.saturating_add(self.pipes).into(), [0.0, f64::from(self.monoliths())])?;
        within("intake_m: width", self.intake_m[0], [0.2, 0.9 * self.monolith_m])?;
        within("intake_m: height", self.intake_m[1], [0.2, 0.8 * self.height_m])?;
        within("bar_spacing_m", self.bar_spacing_m, [0.05, 2.0])?;
        within("pipe_m", self.pipe_m, [0.1, 0.8 * self.monolith_m])
    }

    pub(super) fn raise(&self, structure: &mut Structure, stream: &mut Stream) {
        let count = self.monoliths();
        let width = self.length_m / f64::from(count);
        let taken = self.intakes + self.pipes;
        for k in 0..count {
            let x = self.distance_m + self.offset_m * stream.unit();
            let y = (f64::from(k) - 0.5 * f64::from(count - 1)) * width;
            let bay = Bay { x, y, width: width - 0.04 };
            // Openings lie evenly along the wall, pipes between intakes.
            let opening = if taken == 0 { None } else { opening_of(k, count, taken) };
            match opening {
                Some(number) if number % taken.div_ceil(self.intakes.max(1)) == 0 && self.intakes > 0 => {
                    self.intake(&bay, structure);
                }
                Some(_) => self.outlet(&bay, structure),
                None => structure.part(
                    "dam",
                    "concrete",
                    &[bay.block([-0.5, 0.5], [structure.site.foot, self.height_m], 0.0)],
                ),
            }
        }
    }

    fn monoliths(&self) -> u32 {
        (self.length_m / self.monolith_m).round().max(1.0) as u32
    }

    /// A monolith with a niche, a rack of bars before it.
    fn intake(&self, bay: &Bay, structure: &mut Structure) {
        let [wide, high] = self.intake_m;
        let side = 0.5 * wide / bay.width;
        let sill = 0.12 * self.height_m;
        let blocks = [
            bay.block([-0.5, -side], [structure.site.foot, self.height_m], 0.0),
            bay.block([side, 0.5], [structure.site.foot, self.height_m], 0.0),
            bay.block([-side, side], [structure.site.foot, sill], 0.0),
            bay.block([-side, side], [sill + high, self.height_m], 0.0),
            bay.block([-side, side], [sill, sill + high], INTAKE_M),
        ];
        structure.part("dam", "concrete", &blocks);
        let at = |y: f64, z: f64| DVec3::new(bay.x - 0.15, bay.y + y, z);
        let bars = (wide / self.bar_spacing_m).floor() as u32;
        let step = wide / f64::from(bars.max(1));
        let (low, top) = (sill - 0.2, sill + high + 0.2);
        let mut rack: Vec<Solid> = (0..=bars)
            .map(|k| f64::from(k) * step - 0.5 * wide)
            .map(|y| Solid::block(at(y - 0.01, low) - DVec3::X * 0.06, at(y + 0.01, top)))
            .collect();
        let beams = (high / 1.2).floor() as u32 + 1;
        rack.extend((0..=beams).map(|k| low + (top - low) * f64::from(k) / f64::from(beams)).map(|z| {
            let (from, to) = (at(-0.5 * wide - 0.1, z), at(0.5 * wide + 0.1, z));
            Solid::bar(from + DVec3::X * 0.04, to + DVec3::X * 0.04, [0.08, 0.12])
        }));
        structure.part("trash-rack", "steel", &rack);
    }

    /// A monolith with a pipe that stands out of it.
    fn outlet(&self, bay: &Bay, structure: &mut Structure) {
        structure.part("dam", "concrete", &[bay.block([-0.5, 0.5], [structure.site.foot, self.height_m], 0.0)]);
        let z = 0.25 * self.height_m + 0.5 * self.pipe_m;
        let (from, to) = (DVec3::new(bay.x + 0.3, bay.y, z), DVec3::new(bay.x - 1.2, bay.y, z));
        let outer = 0.5 * self.pipe_m;
        let pipe = Solid::tube(from, to, [0.88 * outer, outer], 32);
        let flange = Solid::tube(to + DVec3::X * 0.12, to, [0.9 * outer, 1.2 * outer], 32);
        structure.part("pipe", "iron", &[pipe, flange]);
    }
}

/// Number of the opening in a monolith, if it has one.
fn opening_of(monolith: u32, monoliths: u32, openings: u32) -> Option<u32> {
    (0..openings).find(|&k| (2 * k + 1) * monoliths / (2 * openings) == monolith)
}

/// The place of a monolith.
struct Bay {
    x: f64,
    y: f64,
    width: f64,
}

impl Bay {
    /// A block over part of the bay's width (−0.5 to 0.5) and between two heights, `back` metres behind the face.
    fn block(&self, [left, right]: [f64; 2], [low, high]: [f64; 2], back: f64) -> Solid {
        let low = DVec3::new(self.x + back, self.y + left * self.width, low);
        Solid::block(low, DVec3::new(self.x + WALL_M, self.y + right * self.width, high))
    }
}
