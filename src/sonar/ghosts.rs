//! Ghosts: echoes that came by one bounce off the sea surface or a smooth bottom.
//!
//! What stands behind a mirror at range r1 (its real thing at r0) is heard twice: at r1, sound having bounced on both ways,
//! and at (r0 + r1) / 2, having bounced on one of them. Whether a real thing hides the bounce is not asked.
//! Source: image sources, Urick (1983), ch. 6; coherent reflection after Eckart (1953).

use glam::{DAffine3, DVec3};

use super::Sonar;
use super::beams::{Beams, vertical_pattern};
use super::cells::Cells;
use super::surface::Surfaces;
use super::visibility::{Segment, Visibility};
use crate::math::Pose;
use crate::math::real::{asin, radians, sin};
use crate::physics::reflection::sea_surface;
use crate::scene::multipath::Mirror;
use crate::scene::{Instance, Scene};

/// Speed of sound that turns a frequency into a wavelength here, m/s.
const SOUND_SPEED_M_S: f64 = 1500.0;

/// One mirror of one ping.
pub(super) struct Reflection<'a> {
    pub sonar: &'a Sonar,
    pub beams: &'a Beams,
    pub scene: &'a Scene,
    pub surfaces: &'a Surfaces,
    pub world_from_sonar: &'a Pose,
    pub mirror: Mirror,
}

impl Reflection<'_> {
    /// Adds the ghosts that this mirror makes. Uses the scan converter's buffers.
    pub fn deposit(&self, visibility: &mut Visibility, cells: &mut Cells) {
        let image = self.mirror.image();
        // Behind a bottom the bottom itself would stand in its own way.
        let below = self.mirror.height_m < self.world_from_sonar.position.z;
        let seen = |instance: &Instance| !below || instance.body != 0;
        visibility.scan_instances(self.scene, self.world_from_sonar, &image, seen);
        let planes = &visibility.planes;
        for plane in 0..planes.count() {
            for sample in 0..planes.samples() {
                let at = plane * planes.samples() + sample;
                let w = visibility.depth.nearest[at];
                if w > 0.0 {
                    let segment = &visibility.depth.segments[visibility.depth.segment[at] as usize];
                    let direction = planes.direction(plane, sample);
                    // What the sample stands for along the ray.
                    let span = segment.slope.abs() / (w * w) * planes.t_step / self.beams.cosine[sample];
                    self.deposit_sample(cells, &image, segment, Seen { plane, sample, w, span, direction });
                }
            }
        }
    }

    fn deposit_sample(&self, cells: &mut Cells, image: &DAffine3, segment: &Segment, seen: Seen) {
        let Seen { plane, sample, w, span, direction } = seen;
        let towards = DVec3::new(direction[0].into(), direction[1].into(), direction[2].into());
        let slant = towards.length();
        let far = slant / f64::from(w);
        let world = self.world_from_sonar.rotation * (towards / slant);
        let amplitude = self.reflection(world.z.abs());
        if amplitude < 1e-4 {
            return;
        }
        // A mirror turns itself back: the image of the image is the thing.
        let real = image.transform_point3(self.world_from_sonar.position + world * far);
        let direct = self.world_from_sonar.inverse().apply(real);
        let near = direct.length();
        let power = amplitude * amplitude;
        let instance = &self.scene.instances[usize::from(segment.instance)];
        let material = instance.materials[usize::from(segment.material)];
        let cosine = segment.facing(direction[2]) * self.beams.cosine[sample];
        let scattered = f64::from(self.surfaces.response(material, cosine) * self.beams.solid_angle[sample]);
        let split = self.beams.split(plane, sample);

        let twice = scattered * power * power / (far * far);
        cells.add_ghost(split, twice as f32, extent(far, span));

        // One way by the mirror, the other straight, and the same way round: two paths of equal length.
        let pattern = |elevation_sine: f64| {
            let width = self.sonar.vertical_beam_deg;
            width.map_or(1.0, |width| vertical_pattern(elevation_sine, radians(width)).sqrt())
        };
        let within = |elevation_sine: f64| elevation_sine.abs() <= sin(radians(0.5 * self.sonar.elevation_deg));
        let (by_mirror, straight) = (f64::from(direction[2]) / slant, direct.z / near);
        if direct.x > 0.0 && within(straight) {
            let heard = pattern(straight) / pattern(by_mirror).max(1e-9);
            let once = scattered * heard * power / (near * near);
            let ranges = extent(0.5 * (near + far), span);
            // Heard from the mirror's side on one path, from the thing's on the other.
            cells.add_ghost(split, once as f32, ranges);
            cells.add_ghost(self.beams.split_at(asin((direct.y / near).clamp(-1.0, 1.0))), once as f32, ranges);
        }
    }

    /// Amplitude that the mirror reflects at a grazing angle, given by its sine.
    fn reflection(&self, grazing_sine: f64) -> f64 {
        let wavenumber = std::f64::consts::TAU * 1000.0 * self.sonar.frequency_khz / SOUND_SPEED_M_S;
        self.mirror.reflection * sea_surface(wavenumber, self.mirror.rough_m, asin(grazing_sine.min(1.0))).abs()
    }
}

/// A sample of a ping that met something behind the mirror.
struct Seen {
    plane: usize,
    sample: usize,
    /// 1/ρ, 1/m.
    w: f32,
    /// Slant range that its surface spans, metres.
    span: f32,
    direction: [f32; 3],
}

/// Ranges between which a sample's surface lies.
fn extent(middle: f64, span: f32) -> [f32; 2] {
    [middle as f32 - 0.5 * span, middle as f32 + 0.5 * span]
}
