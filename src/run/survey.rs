//! What the frames of a plan can see, by geometry alone: some of its scenes are built, nothing is traced.
//!
//! A body counts as in view when half its bounding sphere reaches into the sonar's sector; what stands before it is not
//! looked at, so what is not in view here is in no image either.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};

use super::{Project, World, spread};
use crate::label::View;
use crate::math::Pose;
use crate::math::real::{asin, atan2, cos, radians, sin};
use crate::plan::{Header, Job};
use crate::scene::{Body, SceneError};
use crate::sonar::{Bearing, Sonar};
use crate::vehicle::Station;

/// Shortest way that a frame is said to be moved, metres.
const NOTICEABLE_M: f64 = 1e-3;
/// Scenes that are looked at, at most.
const MOST_SCENES: u64 = 12;
/// No scene is begun later than this.
const LONGEST: Duration = Duration::from_millis(900);

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// Frames that are moved to keep clear of bottom, objects and structures.
    pub moved: u64,
    /// The longest way of one of them, metres.
    pub farthest_moved_m: f64,
    /// Scenes that were looked at, spread over the plan.
    pub scenes: u64,
    /// Their frames.
    pub frames: u64,
    /// Time that a scene took to build, all together, seconds.
    pub building_s: f64,
    /// What became of each class.
    pub labels: BTreeMap<String, Sight>,
    /// Frames of scenes with bodies that have none of them in view.
    pub empty: u64,
    /// Frames whose lowest ray does not reach the ground within the range.
    pub groundless: u64,
    /// Of the first of them, height above the ground and slant range of the lowest ray there; metres, infinite where no ray
    /// goes down.
    pub first_groundless: Option<[f64; 2]>,
    /// Objects that found no place, and why.
    pub dropped: Vec<String>,
}

/// How often bodies of a class are in view: one for each body and frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sight {
    /// Bodies times frames.
    pub views: u64,
    /// In the sector.
    pub in_view: u64,
    /// Beyond the range.
    pub far: u64,
    /// Nearer than the range begins.
    pub near: u64,
    /// To the side of the sector.
    pub beside: u64,
    /// Above or below the sector.
    pub off_height: u64,
    /// In the sector, but smaller than a cell.
    pub small: u64,
    /// In the sector, but of fewer pixels than labels ask for.
    pub faint: u64,
}

/// Looks at scenes spread over the plan.
///
/// # Errors
/// A scene that cannot be built.
pub fn survey(project: &Project) -> Result<Survey, SceneError> {
    let begun = Instant::now();
    let scenes = spread(project.plan.scenes.len() as u64, MOST_SCENES);
    let first = scenes.first().copied();
    let looked: Vec<Result<Survey, SceneError>> = scenes
        .into_par_iter()
        .filter(|&scene| Some(scene) == first || begun.elapsed() < LONGEST)
        .map(|scene| of_scene(project, scene as usize))
        .collect();
    looked.into_iter().try_fold(Survey::default(), |whole, scene| Ok(whole.with(scene?)))
}

fn of_scene(project: &Project, number: usize) -> Result<Survey, SceneError> {
    let plan = &project.plan;
    let begun = Instant::now();
    let world = World::build(&plan.scenes[number], &project.assets)?;
    let building_s = begun.elapsed().as_secs_f64();
    let said =
        |dropped: &crate::scene::Dropped| format!("scene {number}: {} is left out: {}", dropped.asset, dropped.reason);
    let dropped = world.built().dropped.iter().map(said).collect();
    let mut found = Survey { scenes: 1, building_s, dropped, ..Survey::default() };
    let first = number * plan.header.frames as usize;
    for job in &plan.jobs[first..first + plan.header.frames as usize] {
        found.look(&plan.header, job, &world)?;
    }
    Ok(found)
}

impl Survey {
    fn look(&mut self, header: &Header, job: &Job, world: &World) -> Result<(), SceneError> {
        let Station { pose, moved_m, .. } = world.station(header, job)?;
        let pose = pose.then_inner(&job.sonar.mount.pose());
        self.frames += 1;
        if moved_m > NOTICEABLE_M {
            self.moved += 1;
            self.farthest_moved_m = self.farthest_moved_m.max(moved_m);
        }
        let bodies = &world.scene().bodies;
        let mut any = bodies.is_empty();
        for body in bodies {
            let place = Place::of(&job.sonar, &pose, body);
            any |= place.is_in_view();
            self.labels.entry(body.label.clone()).or_default().add(&place, &job.sonar, header);
        }
        self.empty += u64::from(!any);
        let ground = world.built().ground.height(pose.position.x, pose.position.y);
        let height = pose.position.z - ground;
        let slant = height / falls(&job.sonar, &pose);
        if slant > job.sonar.range_m[1] {
            self.groundless += 1;
            self.first_groundless.get_or_insert([height, slant]);
        }
        Ok(())
    }

    fn with(mut self, other: Self) -> Self {
        self.scenes += other.scenes;
        self.frames += other.frames;
        self.building_s += other.building_s;
        self.empty += other.empty;
        self.moved += other.moved;
        self.farthest_moved_m = self.farthest_moved_m.max(other.farthest_moved_m);
        self.groundless += other.groundless;
        self.first_groundless = self.first_groundless.or(other.first_groundless);
        self.dropped.extend(other.dropped);
        for (label, sight) in other.labels {
            self.labels.entry(label).or_default().join(&sight);
        }
        self
    }
}

/// How steeply the lowest ray ahead goes down: metres for each metre of slant range, 0 where none does.
fn falls(sonar: &Sonar, pose: &Pose) -> f64 {
    let down = radians(0.5 * sonar.elevation_deg);
    let ahead = pose.rotation.x_axis * cos(down) - pose.rotation.z_axis * sin(down);
    (-ahead.z).max(0.0)
}

/// Where a body is as the sonar has it.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// From the sonar to the body's middle, metres.
    pub range_m: f64,
    /// To port positive, radians.
    pub bearing_rad: f64,
    /// Largest extent, metres.
    pub size_m: f64,
    /// Whether it is in the sector.
    pub view: InView,
}

/// Whether a body is in a sonar's sector, or where it is instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InView {
    /// In the sector.
    Yes,
    /// Beyond the range.
    Far,
    /// Nearer than the range begins.
    Near,
    /// To the side of the sector.
    Beside,
    /// Above or below the sector.
    OffHeight,
}

impl InView {
    /// In words that go on after "is".
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Yes => "in view",
            Self::Far => "beyond range_m",
            Self::Near => "nearer than range_m begins",
            Self::Beside => "outside azimuth_deg",
            Self::OffHeight => "above or below elevation_deg",
        }
    }
}

impl Place {
    /// The place of a body; `pose` is world_from_sonar.
    #[must_use]
    pub fn of(sonar: &Sonar, pose: &Pose, body: &Body) -> Self {
        let there = pose.rotation.transpose() * (body.centre - pose.position);
        let (range_m, half) = (there.length(), 0.5 * body.radius);
        let [near, far] = sonar.range_m;
        let angle = |sine: f64| asin(sine.clamp(-1.0, 1.0));
        let margin = angle(half / range_m.max(half).max(1e-9));
        let across = match sonar.bearing {
            Bearing::Cone => angle(there.y / range_m.max(1e-9)),
            Bearing::Azimuth => atan2(there.y, there.x),
        };
        let up = angle(there.z / range_m.max(1e-9));
        let behind = there.x < -half;
        let view = if range_m - half > far {
            InView::Far
        } else if range_m + half < near {
            InView::Near
        } else if behind || across.abs() - margin > radians(0.5 * sonar.azimuth_deg) {
            InView::Beside
        } else if up.abs() - margin > radians(0.5 * sonar.elevation_deg) {
            InView::OffHeight
        } else {
            InView::Yes
        };
        Self { range_m, bearing_rad: across, size_m: 2.0 * body.radius, view }
    }

    fn is_in_view(&self) -> bool {
        self.view == InView::Yes
    }
}

impl Sight {
    fn add(&mut self, place: &Place, sonar: &Sonar, header: &Header) {
        self.views += 1;
        match place.view {
            InView::Yes => self.in_view += 1,
            InView::Far => self.far += 1,
            InView::Near => self.near += 1,
            InView::Beside => self.beside += 1,
            InView::OffHeight => self.off_height += 1,
        }
        if !place.is_in_view() {
            return;
        }
        let [near, far] = sonar.range_m;
        let bin = (far - near) / f64::from(sonar.range_bins);
        let beam = radians(sonar.azimuth_deg / f64::from(sonar.beams)) * place.range_m;
        self.small += u64::from(place.size_m < bin.max(beam));
        let pixel = far / f64::from(header.output.fan_height_px);
        let cells = |across: f64, along: f64| (place.size_m / across + 1.0) * (place.size_m / along + 1.0);
        let pixels = header.output.views.iter().map(|view| match view {
            View::Polar => cells(bin, beam),
            View::Fan => cells(pixel, pixel),
        });
        let most = pixels.fold(0.0, f64::max);
        self.faint += u64::from(most < f64::from(header.labels.min_pixels));
    }

    fn join(&mut self, other: &Self) {
        let Self { views, in_view, far, near, beside, off_height, small, faint } = other;
        self.views += views;
        self.in_view += in_view;
        self.far += far;
        self.near += near;
        self.beside += beside;
        self.off_height += off_height;
        self.small += small;
        self.faint += faint;
    }
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3};

    use super::*;
    use crate::recipe::{Origin, parse};

    fn sonar() -> Sonar {
        let text = "{beams: 90, azimuth_deg: 90, elevation_deg: 20, vertical_beam_deg: 20, elevations: 200, range_m: [1, 10],
          range_bins: 450, bearing: cone, beam_width_deg: 1, frequency_khz: 900, bandwidth_khz: 100, source_level_db: 210,
          directivity_db: 30, yaw_rate_deg_s: 0, mount: {position_m: [0, 0, 0], yaw_deg: 0, pitch_deg: 0, roll_deg: 0}}";
        parse("sonar", text, Origin::Given).unwrap().to("sonar").unwrap()
    }

    #[test]
    fn bodies_are_told_apart_by_where_they_are() {
        let why = |x: f64, y: f64, z: f64| {
            let body = Body { label: String::new(), asset: String::new(), centre: DVec3::new(x, y, z), radius: 0.2 };
            Place::of(&sonar(), &Pose::IDENTITY, &body).view
        };
        assert!(why(5.0, 0.0, 0.0) == InView::Yes && why(4.0, 3.9, 0.0) == InView::Yes);
        assert!(why(10.05, 0.0, 0.0) == InView::Yes && why(10.2, 0.0, 0.0) == InView::Far);
        assert!(why(0.5, 0.0, 0.0) == InView::Near);
        assert!(why(3.0, 4.0, 0.0) == InView::Beside && why(-5.0, 0.0, 0.0) == InView::Beside);
        assert!(why(5.0, 0.0, -2.0) == InView::OffHeight);
    }

    #[test]
    fn the_lowest_ray_falls_by_half_the_sector() {
        let level = falls(&sonar(), &Pose::IDENTITY);
        assert!((level - sin(radians(10.0))).abs() < 1e-12);
        let up = Pose { rotation: DMat3::from_cols(DVec3::Z, DVec3::Y, -DVec3::X), ..Pose::IDENTITY };
        assert_eq!(falls(&sonar(), &up), 0.0);
    }
}
