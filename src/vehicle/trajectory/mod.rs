//! Trajectories: the vehicle's pose in the world and its time, frame by frame.
//!
//! World: x east, y north, z up; vehicle: x forward, y port, z up. A pose depends on its frame alone, so that frames
//! may be made in any order and their parameters drawn anew for each.

mod approach;
mod hover;
mod lawnmower;
mod orbit;
mod poses;
mod spline;
mod terrain;
mod views;
mod waypoints;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::clear;
use super::motion::Vehicle;
use super::track::Track;
use crate::math::real::{asin, atan2};
use crate::math::rng::Stream;
use crate::math::{Impossible, Pose};

pub use approach::Approach;
pub use hover::{Drift, Hover};
pub use lawnmower::Lawnmower;
pub use orbit::Orbit;
pub use poses::{Poses, Take};
pub use terrain::Terrain;
pub use views::Views;
pub use waypoints::Waypoints;

/// Farthest that anything may lie from the world's origin, metres.
const FARTHEST_M: f64 = 1e6;

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
    /// A path in plan that keeps its altitude over smoothed ground.
    Terrain(Terrain),
    /// Straight towards a place.
    Approach(Approach),
    /// Each frame from a new random side of a random target.
    Views(Views),
    /// At one place, drifting about it.
    Hover(Hover),
    /// Poses from a file.
    Poses(Poses),
}

/// One frame of a run along a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameOfRun {
    /// From 0.
    pub index: u64,
    /// How many frames the run has.
    pub count: u64,
}

/// A frame's question to its trajectory: which frame it is, of what vehicle, in what world.
#[derive(Clone, Copy)]
pub struct Voyage<'a> {
    /// Which frame.
    pub frame: FrameOfRun,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// vehicle_from_sonar.
    pub mount: &'a Pose,
    /// The world.
    pub around: &'a dyn Surroundings,
    /// The scene's random stream of a purpose, the same in all of its frames.
    pub scene_stream: &'a dyn Fn(&str) -> Stream,
    /// The poses of the file that [`Trajectory::file`] names.
    pub track: Option<&'a Track>,
}

/// What a trajectory may know of the world.
pub trait Surroundings {
    /// Height of the highest ground at (x, y), metres: what altitudes are measured from.
    fn ground(&self, x: f64, y: f64) -> f64;
    /// What there is to look at.
    fn targets(&self) -> &[Target];
    /// Whether nothing stands between two points.
    fn sees(&self, from: DVec3, to: DVec3) -> bool;
    /// Height of the bottom that a vehicle at a point must not be below, metres; there may be roofs above it.
    fn floor(&self, point: DVec3) -> f64;
    /// Distance from a point to the nearest object or structure, metres; 0 inside of one, and at most `within`.
    fn gap(&self, point: DVec3, within: f64) -> f64;
}

/// Where a vehicle is in a frame, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// world_from_vehicle.
    pub pose: Pose,
    /// Since the run began, or as the file of poses has it, seconds.
    pub time_s: f64,
    /// How far it was moved to keep clear of bottom, objects and structures, metres.
    pub moved_m: f64,
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

/// A path that is followed at a speed.
pub(super) struct Leg<'a> {
    /// Part of the time that has gone by, 0 to 1.
    pub share: f64,
    /// From its beginning to its end; 0 for a path without length.
    pub duration_s: f64,
    /// At most.
    pub speed_m_s: f64,
    /// world_from_vehicle at a part of the time.
    pub at: Box<dyn Fn(f64) -> Pose + 'a>,
}

impl Trajectory {
    /// Whether the parameters make sense.
    ///
    /// # Errors
    /// The first that does not.
    pub fn check(&self) -> Result<(), Impossible> {
        match self {
            Self::Orbit(orbit) => orbit.check(),
            Self::Lawnmower(lawnmower) => lawnmower.check(),
            Self::Waypoints(waypoints) => waypoints.check(),
            Self::Terrain(terrain) => terrain.check(),
            Self::Approach(approach) => approach.check(),
            Self::Views(views) => views.check(),
            Self::Hover(hover) => hover.check(),
            // What can be wrong with it stands in the file.
            Self::Poses(_) => Ok(()),
        }
    }

    /// Name of the kind in a recipe.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Orbit(_) => "orbit",
            Self::Lawnmower(_) => "lawnmower",
            Self::Waypoints(_) => "waypoints",
            Self::Terrain(_) => "terrain",
            Self::Approach(_) => "approach",
            Self::Views(_) => "views",
            Self::Hover(_) => "hover",
            Self::Poses(_) => "poses",
        }
    }

    /// File of its poses, from the recipe's folder.
    #[must_use]
    pub fn file(&self) -> Option<&str> {
        if let Self::Poses(poses) = self { Some(&poses.file) } else { None }
    }

    /// Where the vehicle is in a frame: on the trajectory, shaken by the water, clear of bottom and things. Only [`Views`]
    /// draws from the frame's stream.
    ///
    /// # Panics
    /// If the voyage has no track although [`Trajectory::file`] names one.
    #[must_use]
    pub fn station(&self, voyage: &Voyage, stream: &mut Stream) -> Station {
        let pinged = voyage.frame.index as f64 * voyage.vehicle.ping_s;
        let (pose, time_s, risen) = match self {
            Self::Orbit(orbit) => orbit.leg(voyage).follow(voyage),
            Self::Lawnmower(lawnmower) => lawnmower.leg(voyage).follow(voyage),
            Self::Waypoints(waypoints) => waypoints.leg(voyage).follow(voyage),
            Self::Terrain(terrain) => terrain.leg(voyage).follow(voyage),
            Self::Approach(approach) => approach.leg(voyage).follow(voyage),
            Self::Views(views) => (views.pose(voyage, stream), pinged, 0.0),
            Self::Hover(hover) => (hover.pose(pinged, voyage), pinged, 0.0),
            Self::Poses(poses) => {
                let track = voyage.track.expect("whoever asks for a frame has loaded the file of poses");
                let (pose, time_s) = poses.pose(track, voyage.frame);
                (pose, time_s, 0.0)
            }
        };
        let since_begin = time_s - voyage.track.map_or(0.0, Track::begin_s);
        let shaken = voyage.vehicle.shaken(pose, since_begin, voyage);
        let kept = clear::kept(shaken, voyage);
        Station { pose: kept, time_s, moved_m: risen + (kept.position - shaken.position).length() }
    }
}

impl Leg<'_> {
    /// Pose, time and how far the vehicle rises over what it passes. A path without length is stayed on from ping to ping.
    fn follow(&self, voyage: &Voyage) -> (Pose, f64, f64) {
        let mut pose = (self.at)(self.share);
        let risen = clear::rise_along(self, voyage);
        pose.position.z += risen;
        let stays = self.duration_s <= 0.0;
        let time_s =
            if stays { voyage.frame.index as f64 * voyage.vehicle.ping_s } else { self.share * self.duration_s };
        (pose, time_s, risen)
    }
}

impl FrameOfRun {
    /// Share of an open path: 0 in the first frame, 1 in the last.
    fn share(self) -> f64 {
        self.index as f64 / self.count.saturating_sub(1).max(1) as f64
    }

    /// Share of a closed path: the frame after the last would be the first again.
    fn share_of_round(self) -> f64 {
        self.index as f64 / self.count.max(1) as f64
    }
}

impl Voyage<'_> {
    fn place(&self, place: &Place) -> DVec3 {
        let targets = self.around.targets();
        match place {
            Place::Point(point) => DVec3::from_array(*point),
            Place::Named(NamedPlace::Origin) => DVec3::ZERO,
            Place::Named(NamedPlace::Objects) => {
                let sum: DVec3 = targets.iter().map(|target| target.centre).sum();
                sum / targets.len().max(1) as f64
            }
        }
    }

    /// Yaw of a level vehicle that turns the sonar's axis towards `direction` in plan.
    fn yaw_towards(&self, direction: DVec3) -> f64 {
        let axis = self.mount.rotation.x_axis;
        atan2(direction.y, direction.x) - atan2(axis.y, axis.x)
    }

    /// Pose of the vehicle with its sonar at a point, its axis at the elevation of `direction` and `off_axis` radians to
    /// port of its bearing.
    fn aimed(&self, sonar: DVec3, direction: DVec3, off_axis: f64) -> Pose {
        let axis = self.mount.rotation.x_axis;
        let rise = direction.z / direction.length();
        // Pitching turns the axis in the vehicle's x–z plane: sin(pitch + tilt) · upright = rise.
        let (upright, tilt) = ((axis.x * axis.x + axis.z * axis.z).sqrt(), atan2(axis.z, axis.x));
        let pitch = asin((rise / upright.max(1e-9)).clamp(-1.0, 1.0)) - tilt;
        let pitched = Pose::from_angles(DVec3::ZERO, 0.0, pitch, 0.0).rotation * axis;
        let yaw = atan2(direction.y, direction.x) + off_axis - atan2(pitched.y, pitched.x);
        let turned = Pose::from_angles(DVec3::ZERO, yaw, pitch, 0.0);
        Pose { position: sonar - turned.rotation * self.mount.position, ..turned }
    }
}

impl Place {
    fn check(&self, key: &'static str) -> Result<(), Impossible> {
        match self {
            Self::Point(point) => point.iter().try_for_each(|&value| metres(key, value)),
            Self::Named(_) => Ok(()),
        }
    }
}

fn refuse_unless(fine: bool, key: &'static str, value: f64, range: &str) -> Result<(), Impossible> {
    Impossible::unless(fine, key, format!("{value} is not {range}"), &format!("write a number that is {range}"))
}

fn finite(key: &'static str, value: f64) -> Result<(), Impossible> {
    refuse_unless(value.is_finite(), key, value, "finite")
}

fn positive(key: &'static str, value: f64) -> Result<(), Impossible> {
    refuse_unless(value.is_finite() && value > 0.0, key, value, "above 0")
}

fn not_negative(key: &'static str, value: f64) -> Result<(), Impossible> {
    refuse_unless(value.is_finite() && value >= 0.0, key, value, "0 or more")
}

/// A coordinate.
fn metres(key: &'static str, value: f64) -> Result<(), Impossible> {
    refuse_unless(value.abs() <= FARTHEST_M, key, value, "within 1000 km")
}

#[cfg(test)]
mod tests;
