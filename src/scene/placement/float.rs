//! In mid-water: a mine on its line, a buoy, a lone fish or a school.

use glam::{DAffine3, DVec3};
use serde::{Deserialize, Serialize};

use super::rope::Rope;
use super::tree::Box3;
use super::{ANY_DEG, Asking, Candidate, FAR_M, Miss, disc_about, disc_fault, is_origin, outside};
use crate::math::Pose;
use crate::math::real::radians;
use crate::math::rng::Stream;

/// Above the ground, over a disc about the world's origin or another place. Where the sea surface is, a scene does not know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Float {
    /// Of its lowest point above the ground, metres; of a school, of its middle.
    pub altitude_m: f64,
    /// Counter-clockwise from x, degrees; in a school, from the school's heading.
    pub yaw_deg: f64,
    /// Nose (the model's x) up, degrees.
    pub pitch_deg: f64,
    /// Port side (the model's y) up, degrees.
    pub roll_deg: f64,
    /// Thickness of the line that moors it to the ground below, metres; 0 for none. The line is background.
    pub mooring_m: f64,
    /// Radius of the disc over which it floats, metres; of a school, its middle.
    pub within_m: f64,
    /// Middle of that disc: x east, y north, metres.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub centre_m: [f64; 2],
    /// All instances swim together; without a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub school: Option<School>,
}

/// A school: a ball of fish that head the same way, nearly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct School {
    /// Of the ball, metres.
    pub radius_m: f64,
    /// Where the school heads, counter-clockwise from x, degrees: drawn `per: scene`, it is the same for all.
    pub heading_deg: f64,
    /// Standard deviation of each one's yaw and pitch about it, degrees.
    pub stray_deg: f64,
}

impl Float {
    pub(super) fn fault(&self) -> Option<String> {
        let angles = [("yaw_deg", self.yaw_deg), ("pitch_deg", self.pitch_deg), ("roll_deg", self.roll_deg)];
        let lengths = [("altitude_m", self.altitude_m, 0.0, FAR_M), ("mooring_m", self.mooring_m, 0.0, 1.0)];
        let school = self.school.iter().find_map(|school| {
            outside(&[
                ("school.radius_m", school.radius_m, 0.0, FAR_M),
                ("school.heading_deg", school.heading_deg, ANY_DEG.0, ANY_DEG.1),
                ("school.stray_deg", school.stray_deg, 0.0, 180.0),
            ])
        });
        outside(&lengths)
            .or_else(|| outside(&angles.map(|(name, value)| (name, value, ANY_DEG.0, ANY_DEG.1))))
            .or(school)
            .or_else(|| disc_fault(self.centre_m, self.within_m))
    }

    pub(super) fn propose(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        match &self.school {
            Some(school) => self.in_school(school, asking, stream),
            None => self.alone(asking, stream),
        }
    }

    fn alone(&self, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let Asking { shape, around, .. } = *asking;
        let place = disc_about(self.centre_m, self.within_m, stream);
        if !around.ground.is_there(place.x, place.y) {
            return Err(Miss::NoGround);
        }
        let turn = self.turn([self.yaw_deg, self.pitch_deg]);
        let bounds = Box3::about(shape.hull.iter().map(|p| turn * *p));
        let bottom = bounds.middle().with_z(bounds.low.z);
        let ground = around.ground.height(place.x, place.y);
        let foot = place.extend(ground + self.altitude_m);
        let world_from_mesh = DAffine3 { matrix3: turn, translation: foot - bottom };
        let rope = (self.mooring_m > 0.0 && self.altitude_m > 0.0).then(|| {
            // Up to the lowest of what is near its axis, so that the line ends at the body and not in it.
            let above = |p: &DVec3| world_from_mesh.transform_point3(*p);
            let near = 0.1 * shape.size();
            let points = shape.samples.iter().map(above).filter(|p| (p.truncate() - place).length() < near);
            let top = points.map(|p| p.z).fold(f64::MAX, f64::min);
            let top = if top < f64::MAX { top } else { foot.z };
            Rope::through(&[place.extend(ground - 0.2), place.extend(top)], self.mooring_m, Vec::new())
        });
        Ok(Candidate { rope, ..world_from_mesh.into() })
    }

    fn in_school(&self, school: &School, asking: &Asking, stream: &mut Stream) -> Result<Candidate, Miss> {
        let Asking { shape, around, .. } = *asking;
        let middle = disc_about(self.centre_m, self.within_m, &mut (asking.shared)());
        let altitude = around.ground.height(middle.x, middle.y) + self.altitude_m;
        let mut side = || stream.uniform(-1.0, 1.0);
        let in_ball = loop {
            let point = DVec3::new(side(), side(), side());
            if point.length_squared() <= 1.0 {
                break point;
            }
        };
        let stray = [stream.normal(), stream.normal()].map(|normal| school.stray_deg * normal.clamp(-3.0, 3.0));
        let turn = self.turn([school.heading_deg + self.yaw_deg + stray[0], self.pitch_deg + stray[1]]);
        let centre = Box3::about(shape.hull.iter().map(|p| turn * *p)).middle();
        let place = middle.extend(altitude) + in_ball * school.radius_m;
        let world_from_mesh = DAffine3 { matrix3: turn, translation: place - centre };
        let low = super::footing::clearance(around.ground, shape, &world_from_mesh);
        if low > asking.clear_m { Ok(world_from_mesh.into()) } else { Err(Miss::Taken) }
    }

    fn turn(&self, [yaw_deg, pitch_deg]: [f64; 2]) -> glam::DMat3 {
        Pose::from_angles(DVec3::ZERO, radians(yaw_deg), radians(pitch_deg), radians(self.roll_deg)).rotation
    }
}
