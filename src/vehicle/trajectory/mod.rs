//! Trajectories: the vehicle's pose in the world, frame by frame.
//!
//! World: x east, y north, z up; vehicle: x forward, y port, z up. A pose depends on its frame alone, so that frames
//! may be made in any order and their parameters drawn anew for each.

mod hover;
mod lawnmower;
mod orbit;
mod views;
mod waypoints;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::math::Pose;
use crate::math::real::atan2;
use crate::math::rng::Stream;

pub use hover::Hover;
pub use lawnmower::Lawnmower;
pub use orbit::Orbit;
pub use views::Views;
pub use waypoints::Waypoints;

/// Least height of the vehicle above the ground, metres.
pub const LEAST_ALTITUDE_M: f64 = 0.3;

/// Kinds of trajectory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trajectory {
    /// A circle about a place, looking inwards.
    Orbit(Orbit),
    /// Parallel lines over an area.
    Lawnmower(Lawnmower),
    /// A smooth path through given points.
    Waypoints(Waypoints),
    /// Each frame from a new random side of a random target.
    Views(Views),
    /// The same pose in all frames.
    Hover(Hover),
}

/// One frame of a run along a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameOfRun {
    /// From 0.
    pub index: u64,
    /// How many frames the run has.
    pub count: u64,
}

/// What a trajectory may know of the world.
pub struct Surroundings<'a> {
    /// Height of the ground at (x, y), metres.
    pub ground: &'a dyn Fn(f64, f64) -> f64,
    /// What there is to look at.
    pub targets: &'a [Target],
    /// Whether nothing stands between two points of the world.
    pub clear: &'a dyn Fn(DVec3, DVec3) -> bool,
    /// vehicle_from_sonar.
    pub mount: &'a Pose,
}

/// Something to look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// In the world, metres.
    pub centre: DVec3,
    /// Of a sphere about it, metres.
    pub radius_m: f64,
}

/// A place in the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Place {
    /// A place with a name.
    Named(NamedPlace),
    /// World coordinates, metres.
    Point([f64; 3]),
}

/// Places with names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NamedPlace {
    /// Middle of all targets; the origin without targets.
    Objects,
    /// The world's origin.
    Origin,
}

/// A trajectory that cannot be followed.
#[derive(Debug, Error, PartialEq)]
#[error("trajectory: {name} is {value}, which is not {range}")]
pub struct TrajectoryError {
    /// The parameter.
    pub name: &'static str,
    /// What it is.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl Trajectory {
    /// Whether the parameters make sense.
    ///
    /// # Errors
    /// The first that does not.
    pub fn check(&self) -> Result<(), TrajectoryError> {
        match self {
            Self::Orbit(orbit) => orbit.check(),
            Self::Lawnmower(lawnmower) => lawnmower.check(),
            Self::Waypoints(waypoints) => waypoints.check(),
            Self::Views(views) => views.check(),
            Self::Hover(hover) => hover.check(),
        }
    }

    /// world_from_vehicle of a frame, never lower than [`LEAST_ALTITUDE_M`] above the ground. Only [`Views`] draws
    /// from the stream.
    #[must_use]
    pub fn pose(&self, frame: FrameOfRun, around: &Surroundings, stream: &mut Stream) -> Pose {
        let mut pose = match self {
            Self::Orbit(orbit) => orbit.pose(frame, around),
            Self::Lawnmower(lawnmower) => lawnmower.pose(frame, around),
            Self::Waypoints(waypoints) => waypoints.pose(frame),
            Self::Views(views) => views.pose(around, stream),
            Self::Hover(hover) => hover.pose(),
        };
        let ground = (around.ground)(pose.position.x, pose.position.y);
        pose.position.z = pose.position.z.max(ground + LEAST_ALTITUDE_M);
        pose
    }
}

impl FrameOfRun {
    /// Share of an open path: 0 in the first frame, 1 in the last.
    fn share(&self) -> f64 {
        self.index as f64 / self.count.saturating_sub(1).max(1) as f64
    }

    /// Share of a closed path: the frame after the last would be the first again.
    fn share_of_round(&self) -> f64 {
        self.index as f64 / self.count.max(1) as f64
    }
}

impl Surroundings<'_> {
    fn place(&self, place: &Place) -> DVec3 {
        match place {
            Place::Point(point) => DVec3::from_array(*point),
            Place::Named(NamedPlace::Origin) => DVec3::ZERO,
            Place::Named(NamedPlace::Objects) => {
                let sum: DVec3 = self.targets.iter().map(|target| target.centre).sum();
                sum / self.targets.len().max(1) as f64
            }
        }
    }

    /// Yaw of a level vehicle that turns the sonar's axis towards `direction` in plan.
    fn yaw_towards(&self, direction: DVec3) -> f64 {
        let axis = self.mount.rotation.x_axis;
        atan2(direction.y, direction.x) - atan2(axis.y, axis.x)
    }
}

fn finite(name: &'static str, value: f64) -> Result<(), TrajectoryError> {
    if value.is_finite() { Ok(()) } else { Err(TrajectoryError { name, value, range: "a number" }) }
}

fn positive(name: &'static str, value: f64) -> Result<(), TrajectoryError> {
    let fine = value.is_finite() && value > 0.0;
    if fine { Ok(()) } else { Err(TrajectoryError { name, value, range: "above 0" }) }
}

fn not_negative(name: &'static str, value: f64) -> Result<(), TrajectoryError> {
    let fine = value.is_finite() && value >= 0.0;
    if fine { Ok(()) } else { Err(TrajectoryError { name, value, range: "0 or more" }) }
}

#[cfg(test)]
mod tests;
