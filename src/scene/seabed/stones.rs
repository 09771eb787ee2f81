//! Stones strewn over a bottom: boulders with flat faces, cobbles without, mounds of coral.
//!
//! A stone is a bump: it has no underside. Where bumps overlap the higher one is seen.

use glam::DVec2;

use super::HeightGrid;
use super::noise::Noise;
use crate::math::real::{cos, pow, radians, sin, tan};
use crate::math::rng::Stream;

/// How many stones there may be, for messages.
pub(super) const MANY: &str = "0 to as many as cover the ground twice";

/// What a stone is shaped like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Flat faces, a tilted top.
    Boulder,
    /// Half an ellipsoid.
    Cobble,
    /// A knobbly dome with steep sides.
    CoralHead,
}

/// Stones of one form.
#[derive(Clone, Debug)]
pub(super) struct Stones<'a> {
    pub form: Form,
    /// Smallest and largest diameter, metres; small ones are more.
    pub size_m: [f64; 2],
    /// Share of its height by which a stone is sunk, 0 to under 1.
    pub burial: f64,
    /// Of the stones.
    pub sediment: &'a str,
}

impl Stones<'_> {
    /// Lays `count` stones at random places.
    pub fn strew(&self, count: u64, grid: &mut HeightGrid, stream: &mut Stream) {
        let half = 0.5 * grid.extent();
        for _ in 0..count {
            let middle = DVec2::new(stream.uniform(-half, half), stream.uniform(-half, half));
            self.lay(middle, grid, stream);
        }
    }

    /// Lays a stone of random size there.
    pub fn lay(&self, middle: DVec2, grid: &mut HeightGrid, stream: &mut Stream) {
        let [small, large] = self.size_m;
        let radius = 0.5 * small * pow(large / small, pow(stream.unit(), 2.0));
        let stone = Stone::new(self.form, radius, stream);
        let ground = grid.height(middle.x, middle.y) - self.burial * stone.height;
        let top = |x: f64, y: f64| ground + stone.top(DVec2::new(x, y) - middle);
        grid.raise_to(middle, radius, top, self.sediment);
    }

    /// Mean area in plan of a stone, square metres.
    pub fn mean_area(&self) -> f64 {
        let [small, large] = self.size_m;
        let steps = (0..64).map(|k| pow(large / small, pow((f64::from(k) + 0.5) / 64.0, 2.0)));
        let squares: f64 = steps.map(|ratio| small * small * ratio * ratio).sum();
        // Stones are longer than wide: an ellipse of the mean aspect.
        0.8 * std::f64::consts::FRAC_PI_4 * squares / 64.0
    }
}

/// One stone about the origin of its own plan.
struct Stone {
    form: Form,
    /// Half its length and half its width, metres.
    half: DVec2,
    axis: DVec2,
    height: f64,
    faces: Vec<Face>,
    knobs: Option<Noise>,
}

/// A plane over the plan: height at the origin and its fall along x and y.
struct Face {
    height: f64,
    fall: DVec2,
}

impl Stone {
    fn new(form: Form, radius: f64, stream: &mut Stream) -> Self {
        let turn = std::f64::consts::TAU * stream.unit();
        let width = radius * stream.uniform(0.6, 1.0);
        let flat = match form {
            Form::Boulder => stream.uniform(0.6, 1.2),
            Form::Cobble => stream.uniform(0.5, 0.9),
            Form::CoralHead => stream.uniform(0.7, 1.3),
        };
        let height = radius * flat;
        let faces = if form == Form::Boulder { faces(radius, width, height, stream) } else { Vec::new() };
        let knobs = (form == Form::CoralHead).then(|| Noise::new(0.45 * radius, radius, stream));
        Self { form, half: DVec2::new(radius, width), axis: DVec2::new(cos(turn), sin(turn)), height, faces, knobs }
    }

    /// Height above its base at a point of its plan; negative outside.
    fn top(&self, from_middle: DVec2) -> f64 {
        let place = DVec2::new(from_middle.dot(self.axis), from_middle.dot(self.axis.perp()));
        let r2 = (place / self.half).length_squared();
        match self.form {
            Form::Boulder => self.faces.iter().map(|face| face.height - face.fall.dot(place)).fold(f64::MAX, f64::min),
            Form::Cobble if r2 < 1.0 => self.height * (1.0 - r2).sqrt(),
            Form::CoralHead if r2 < 1.0 => {
                let knob = self.knobs.as_ref().map_or(0.0, |knobs| knobs.at(place.x, place.y));
                self.height * (1.0 - r2 * r2).sqrt() * (1.0 + 0.12 * knob)
            }
            Form::Cobble | Form::CoralHead => -1.0,
        }
    }
}

/// A top that leans a little and five to eight sides.
fn faces(radius: f64, width: f64, height: f64, stream: &mut Stream) -> Vec<Face> {
    let lean = |stream: &mut Stream| stream.uniform(-0.35, 0.35);
    let mut faces = vec![Face { height, fall: DVec2::new(lean(stream), lean(stream)) }];
    let sides = 5 + stream.below(4);
    for side in 0..sides {
        let bearing = std::f64::consts::TAU * (side as f64 + stream.uniform(-0.35, 0.35)) / sides as f64;
        let outwards = DVec2::new(cos(bearing), sin(bearing));
        let steepness = tan(radians(stream.uniform(40.0, 75.0)));
        let reach = stream.uniform(0.6, 0.95) * (outwards * DVec2::new(radius, width)).length();
        faces.push(Face { height: reach * steepness, fall: outwards * steepness });
    }
    faces
}
