//! Where bodies stand: at a given pose, or at rest on the ground without touching each other.
//!
//! Knows nothing of catalogs or labels: it places meshes.

use glam::{DAffine3, DMat3, DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::ground::Ground;
use super::mesh::Mesh;
use crate::math::Pose;
use crate::math::real::radians;
use crate::math::rng::Stream;

/// Free water between two bodies at rest, in plan, metres.
const CLEARANCE_M: f64 = 0.05;
/// Random places tried before a body is dropped.
pub(super) const TRIES: u32 = 200;
/// Steepest ground that a body rests on: its normal's z, here 45°.
const LEAST_UPRIGHT: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Samples along each side of a footprint for the plane under it.
const PLANE_SAMPLES: i32 = 7;

/// How a body is placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PoseSpec {
    /// On the ground, at a random free place.
    Rest(Rest),
    /// Exactly there.
    At(At),
}

/// At rest on the ground about the world's origin, turned with the slope under it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rest {
    /// Counter-clockwise from x, degrees.
    pub yaw_deg: f64,
    /// About the model's own x axis, before the yaw: 90 lays a standing barrel down, degrees.
    pub tip_deg: f64,
    /// Share of the body's height that is sunk into the ground, 0 to 1.
    pub burial: f64,
    /// Radius of the disc about the world's origin in which it lies, metres.
    pub within_m: f64,
}

/// At a pose of the model's base centre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct At {
    /// Of the middle of the model's base, world, metres.
    pub position_m: [f64; 3],
    /// Counter-clockwise from x, degrees.
    pub yaw_deg: f64,
    /// Nose (the model's x) up, degrees.
    pub pitch_deg: f64,
    /// Port side (the model's y) up, degrees.
    pub roll_deg: f64,
}

impl PoseSpec {
    /// What is wrong with the numbers, if anything.
    pub(super) fn fault(&self) -> Option<String> {
        let numbers: &[f64] = match self {
            Self::Rest(rest) => &[rest.yaw_deg, rest.tip_deg, rest.burial, rest.within_m],
            Self::At(at) => {
                &[at.yaw_deg, at.pitch_deg, at.roll_deg, at.position_m[0], at.position_m[1], at.position_m[2]]
            }
        };
        match self {
            _ if numbers.iter().any(|number| !number.is_finite()) => Some("a number of its pose is not finite".into()),
            Self::Rest(rest) if !(0.0..=1.0).contains(&rest.burial) => {
                Some(format!("burial is {}, which is not between 0 and 1", rest.burial))
            }
            Self::Rest(rest) if rest.within_m < 0.0 => Some(format!("within_m is {}, below 0", rest.within_m)),
            Self::Rest(_) | Self::At(_) => None,
        }
    }
}

/// A placed body: its transform, and its outline in plan.
#[derive(Clone, Debug)]
pub(super) struct Standing {
    pub world_from_mesh: DAffine3,
    pub footprint: Footprint,
}

/// A rectangle in plan.
#[derive(Clone, Debug)]
pub(super) struct Footprint {
    centre: DVec2,
    /// Direction of the first side.
    axis: DVec2,
    /// Half of each side, metres.
    half: DVec2,
}

impl At {
    /// Where the mesh stands then.
    pub(super) fn stand(&self, mesh: &Mesh) -> Standing {
        let position = DVec3::from_array(self.position_m);
        let pose = Pose::from_angles(position, radians(self.yaw_deg), radians(self.pitch_deg), radians(self.roll_deg));
        let world_from_mesh = DAffine3 { matrix3: pose.rotation, translation: position };
        let corners = corners(mesh.low.as_dvec3(), mesh.high.as_dvec3()).map(|c| world_from_mesh.transform_point3(c));
        Standing { world_from_mesh, footprint: Footprint::of(&corners, heading(radians(self.yaw_deg))) }
    }
}

impl Rest {
    /// Finds a free place; `None` after [`TRIES`] tries.
    pub(super) fn stand(&self, mesh: &Mesh, around: &Around, stream: &mut Stream) -> Option<Standing> {
        let body = Tipped::new(self, mesh);
        (0..TRIES).find_map(|_| {
            let place = disc(self.within_m, stream);
            if !around.ground.is_there(place.x, place.y) {
                return None;
            }
            let rotation = body.aligned(place, around.ground)?;
            let footprint = body.footprint(place, rotation);
            if around.taken.iter().any(|other| footprint.is_near(other)) {
                return None;
            }
            let translation = place.extend(body.touching(place, rotation, around.ground));
            let from_tipped = DAffine3 { matrix3: rotation, translation };
            Some(Standing { world_from_mesh: from_tipped * body.tipped_from_mesh, footprint })
        })
    }
}

/// What a body must get along with.
pub(super) struct Around<'a> {
    pub ground: &'a Ground,
    pub taken: &'a [Footprint],
}

/// A body tipped over, before yaw and slope: the middle of its base at the origin.
struct Tipped {
    tipped_from_mesh: DAffine3,
    vertices: Vec<DVec3>,
    half: DVec2,
    height: f64,
    yaw: f64,
    burial: f64,
}

impl Tipped {
    fn new(rest: &Rest, mesh: &Mesh) -> Self {
        let tip = Pose::from_angles(DVec3::ZERO, 0.0, 0.0, radians(rest.tip_deg)).rotation;
        let mut vertices: Vec<DVec3> = mesh.vertices().map(|v| tip * v.as_dvec3()).collect();
        let (low, high) = bounds(&vertices);
        let base = DVec3::new(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z);
        vertices.iter_mut().for_each(|v| *v -= base);
        Self {
            tipped_from_mesh: DAffine3 { matrix3: tip, translation: -base },
            vertices,
            half: 0.5 * (high - low).truncate(),
            height: high.z - low.z,
            yaw: radians(rest.yaw_deg),
            burial: rest.burial,
        }
    }

    /// Yaw, then the slope of the plane that fits the ground under the footprint best; `None` where that is too steep.
    fn aligned(&self, place: DVec2, ground: &Ground) -> Option<DMat3> {
        let yaw = Pose::from_angles(DVec3::ZERO, self.yaw, 0.0, 0.0).rotation;
        let share = |k: i32| f64::from(2 * k) / f64::from(PLANE_SAMPLES - 1) - 1.0;
        let (mut slope, mut squares) = (DVec2::ZERO, 0.0);
        // On a grid symmetric about the middle, the fit is one sum an axis.
        for (i, j) in (0..PLANE_SAMPLES).flat_map(|i| (0..PLANE_SAMPLES).map(move |j| (i, j))) {
            let across = DVec2::new(share(i), share(j));
            let there = place + (yaw * (across * self.half).extend(0.0)).truncate();
            slope += across * ground.height(there.x, there.y);
            squares += across.x * across.x;
        }
        // A body thinner than a millimetre has no slope across it.
        let slope = slope / (squares * self.half.max(DVec2::splat(1e-3)));
        let gradient = yaw * slope.extend(0.0);
        let normal = DVec3::new(-gradient.x, -gradient.y, 1.0).normalize();
        (normal.z >= LEAST_UPRIGHT).then(|| from_up_to(normal) * yaw)
    }

    fn footprint(&self, place: DVec2, rotation: DMat3) -> Footprint {
        let (low, high) = ((-self.half).extend(0.0), self.half.extend(self.height));
        let corners = corners(low, high).map(|c| rotation * c + place.extend(0.0));
        Footprint::of(&corners, heading(self.yaw))
    }

    /// Height of the base's middle at which the lowest vertex touches the ground, then sunk by the burial.
    fn touching(&self, place: DVec2, rotation: DMat3, ground: &Ground) -> f64 {
        let mut clearance = f64::INFINITY;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for vertex in &self.vertices {
            let v = rotation * *vertex;
            clearance = clearance.min(v.z - ground.height(place.x + v.x, place.y + v.y));
            (low, high) = (low.min(v.z), high.max(v.z));
        }
        -clearance - self.burial * (high - low)
    }
}

impl Footprint {
    /// The rectangle along `axis` about points of the world.
    pub(super) fn of(points: &[DVec3], axis: DVec2) -> Self {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in points {
            let along = DVec2::new(point.truncate().dot(axis), point.truncate().dot(axis.perp()));
            (low, high) = (low.min(along), high.max(along));
        }
        let middle = 0.5 * (low + high);
        Self { centre: axis * middle.x + axis.perp() * middle.y, axis, half: 0.5 * (high - low) }
    }

    /// Whether less than the clearance lies between two rectangles along every side's direction.
    ///
    /// Source: separating axis theorem, Gottschalk et al. (1996), OBBTree, SIGGRAPH.
    fn is_near(&self, other: &Self) -> bool {
        let between = other.centre - self.centre;
        [self.axis, self.axis.perp(), other.axis, other.axis.perp()].iter().all(|&direction| {
            between.dot(direction).abs() < self.reach(direction) + other.reach(direction) + CLEARANCE_M
        })
    }

    fn reach(&self, direction: DVec2) -> f64 {
        self.half.x * self.axis.dot(direction).abs() + self.half.y * self.axis.perp().dot(direction).abs()
    }
}

/// Lowest and highest corner of points.
pub(super) fn bounds<'a>(points: impl IntoIterator<Item = &'a DVec3>) -> (DVec3, DVec3) {
    points.into_iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)))
}

fn corners(low: DVec3, high: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|k| {
        let pick = |bit: usize, axis: usize| if k >> bit & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(0, 0), pick(1, 1), pick(2, 2))
    })
}

fn heading(yaw: f64) -> DVec2 {
    DVec2::new(crate::math::real::cos(yaw), crate::math::real::sin(yaw))
}

/// Uniform in the disc about the origin.
fn disc(radius: f64, stream: &mut Stream) -> DVec2 {
    let from_middle = radius * stream.unit().sqrt();
    from_middle * heading(std::f64::consts::TAU * stream.unit())
}

/// The shortest turn from straight up to a direction that points up.
fn from_up_to(normal: DVec3) -> DMat3 {
    let v = DVec3::Z.cross(normal);
    let cross = DMat3::from_cols(DVec3::new(0.0, v.z, -v.y), DVec3::new(-v.z, 0.0, v.x), DVec3::new(v.y, -v.x, 0.0));
    DMat3::IDENTITY + cross + cross * cross * (1.0 / (1.0 + normal.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_turn_takes_up_to_the_normal() {
        let normal = DVec3::new(0.3, -0.2, 0.9).normalize();
        let turn = from_up_to(normal);
        assert!((turn * DVec3::Z - normal).length() < 1e-14);
        assert!((turn.determinant() - 1.0).abs() < 1e-14);
        assert!((turn * DVec3::Z.cross(normal) - DVec3::Z.cross(normal)).length() < 1e-14);
    }

    #[test]
    fn turned_rectangles_keep_their_distance() {
        let at = |x: f64, y: f64, yaw: f64| Footprint {
            centre: DVec2::new(x, y),
            axis: heading(yaw),
            half: DVec2::new(1.0, 0.1),
        };
        assert!(at(0.0, 0.0, 0.0).is_near(&at(0.0, 0.24, 0.0)));
        assert!(!at(0.0, 0.0, 0.0).is_near(&at(0.0, 0.26, 0.0)));
        // Two crossed sticks touch, two in an L whose bounding circles overlap do not.
        assert!(at(0.0, 0.0, 0.5).is_near(&at(0.0, 0.0, 2.0)));
        assert!(!at(0.0, 0.0, 0.0).is_near(&at(1.2, 0.5, std::f64::consts::FRAC_PI_2)));
    }

    #[test]
    fn places_fill_the_disc_evenly() {
        let mut stream = Stream::at(1, "test", 0, "disc");
        let inner = (0..4000).filter(|_| disc(2.0, &mut stream).length() < 1.0).count();
        assert!((900..1100).contains(&inner), "{inner}");
    }
}
