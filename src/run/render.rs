//! One job, from pose to pictures and labels: one frame is one thread's work.

use crate::image::{self, Channel};
use crate::label::{View, ViewLabels, label_fan, label_polar};
use crate::math::Pose;
use crate::math::real::{asin, atan2, degrees};
use crate::math::rng::Stream;
use crate::plan::{Header, Job, Look, Raw};
use crate::sonar::{Echoes, FanMap, Grid, Keep, Tracer};
use crate::store::exr::RawImage;
use crate::vehicle::{Station, TrackError};

use super::world::World;

/// A rendered frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Where the sonar was.
    pub world_from_sonar: Pose,
    /// When, seconds.
    pub time_s: f64,
    /// How far the vehicle was moved to keep clear, metres.
    pub moved_m: f64,
    /// The views asked for, in their order.
    pub pictures: Vec<Picture>,
    /// Linear values, where asked for.
    pub raw: Option<RawImage>,
}

/// A view of a frame: grey pixels from the noisy images, labels from the noise-free echoes.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Which view.
    pub view: View,
    /// Grey pixels of each look, row by row; as large as the labels' mask.
    pub looks: Vec<Vec<u8>>,
    /// Masks and boxes.
    pub labels: ViewLabels,
}

/// A thread's tools: tables and buffers that serve frame after frame, made anew only when the sonar changes.
#[derive(Debug, Default)]
pub struct Renderer {
    tracer: Option<Tracer>,
    fan: Option<(Grid, FanMap)>,
}

impl Renderer {
    /// Renders a job in its world.
    ///
    /// # Errors
    /// If the job's poses are in a file that cannot be read any more.
    pub fn render(&mut self, header: &Header, job: &Job, world: &World) -> Result<Frame, TrackError> {
        let Station { pose, time_s, moved_m } = world.station(header, job)?;
        let world_from_sonar = pose.then_inner(&job.sonar.mount.pose());
        // Looks that average over rays may sort them by one range or the other: a second trace serves the second kind.
        let first = job.looks.iter().find_map(|look| look.image.rays());
        let second = job.looks.iter().filter_map(|look| look.image.rays()).find(|range| Some(*range) != first);
        let tracer = self.tracer(job);
        let keep = Keep { detail: header.output.raw == Raw::Exr, rays: first };
        let echoes = tracer.trace(world.scene(), &world_from_sonar, keep);
        let others = second
            .map(|range| tracer.trace(world.scene(), &world_from_sonar, Keep { rays: Some(range), ..Keep::ENERGY }));
        // All looks of a frame share their random draws: the same scatterers under other conditions.
        let number = header.number_in_variant(job.scene, job.frame);
        let stream = || Stream::at(world.seed(), "frame", number, "image");
        let greys: Vec<Vec<u8>> = job
            .looks
            .iter()
            .map(|look| match &others {
                Some(others) if look.image.rays() == second => grey(job, look, others, stream()),
                _ => grey(job, look, &echoes, stream()),
            })
            .collect();
        let view = |&view: &View| match view {
            View::Polar => Picture {
                view,
                looks: greys.iter().map(|grey| echoes.grid.to_polar_image(grey)).collect(),
                labels: label_polar(&echoes, &header.labels),
            },
            View::Fan => {
                let fan = self.fan.get_or_insert_with(|| fan(&echoes.grid, header));
                if fan.0 != echoes.grid {
                    *fan = self::fan(&echoes.grid, header);
                }
                let looks = greys.iter().map(|grey| fan.1.picture(grey)).collect();
                Picture { view, looks, labels: label_fan(&echoes, &fan.1, &header.labels) }
            }
        };
        let pictures: Vec<Picture> = header.output.views.iter().map(view).collect();
        let raw = echoes.detail.is_some().then(|| raw(&echoes, header, job, &stream()));
        Ok(Frame { world_from_sonar, time_s, moved_m, pictures, raw })
    }

    fn tracer(&mut self, job: &Job) -> &mut Tracer {
        if self.tracer.as_ref().is_none_or(|tracer| *tracer.sonar() != job.sonar) {
            self.tracer = None;
        }
        self.tracer.get_or_insert_with(|| Tracer::new(&job.sonar))
    }
}

/// The grey cells of one look.
fn grey(job: &Job, look: &Look, echoes: &Echoes, mut stream: Stream) -> Vec<u8> {
    let channel = Channel::new(&job.sonar, &look.water);
    image::form(echoes, &look.image, &channel, &mut stream)
}

fn fan(grid: &Grid, header: &Header) -> (Grid, FanMap) {
    (*grid, FanMap::new(grid, header.output.fan_height_px))
}

/// The linear image, in the orientation of the polar view; received levels are those of the first look.
fn raw(echoes: &Echoes, header: &Header, job: &Job, stream: &Stream) -> RawImage {
    let grid = &echoes.grid;
    let detail = echoes.detail.as_ref();
    let plane = |values: Option<&Vec<f32>>| values.map_or_else(Vec::new, |values| grid.to_polar_image(values));
    let wide = |values: &[u16]| values.iter().map(|&value| u32::from(value)).collect();
    let levels = job.looks.first().and_then(|look| {
        let channel = Channel::new(&job.sonar, &look.water);
        image::linear(echoes, &look.image, &channel, stream)
    });
    let (echo, received) = levels.map(|levels| (levels.noise_free, levels.noisy)).unzip();
    RawImage {
        width: grid.beams,
        height: grid.bins,
        intensity: grid.to_polar_image(&echoes.energy),
        echo: echo.map(|cells| grid.to_polar_image(&cells)),
        received: received.map(|cells| grid.to_polar_image(&cells)),
        elevation: plane(detail.map(|detail| &detail.elevation_rad)),
        incidence: plane(detail.map(|detail| &detail.incidence_rad)),
        instance: wide(&label_polar(echoes, &header.labels).mask),
        material: detail.map_or_else(Vec::new, |detail| wide(&grid.to_polar_image(&detail.material))),
    }
}

/// A pose as the record has it: x, y, z in metres, then yaw, pitch, roll in degrees (see [`Pose::from_angles`]).
#[must_use]
pub fn pose_numbers(pose: &Pose) -> [f64; 6] {
    let (ahead, port, up) = (pose.rotation.x_axis, pose.rotation.y_axis, pose.rotation.z_axis);
    let yaw = atan2(ahead.y, ahead.x);
    let pitch = asin(ahead.z.clamp(-1.0, 1.0));
    let roll = atan2(port.z, up.z);
    let [x, y, z] = pose.position.to_array();
    [x, y, z, degrees(yaw), degrees(pitch), degrees(roll)]
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::math::real::radians;

    #[test]
    fn a_pose_comes_back_from_its_numbers() {
        let given = [1.0, -2.0, 3.0, 140.0, -15.0, 4.0];
        let position = DVec3::new(given[0], given[1], given[2]);
        let pose = Pose::from_angles(position, radians(given[3]), radians(given[4]), radians(given[5]));
        for (a, b) in pose_numbers(&pose).into_iter().zip(given) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }
}
