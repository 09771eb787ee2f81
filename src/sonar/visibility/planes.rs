//! The beam planes of a ping: half-planes through the sonar's vertical axis, each sampled in elevation.
//!
//! In a plane a point is (ρ, z): distance ahead and height. Its elevation is sampled in `t = z / ρ = tan(elevation)`,
//! in which straight lines stay straight and `1 / ρ` is linear, as on a picture's screen.

use crate::math::real::{cos, degrees, radians, sin, tan};
use crate::sonar::{Bearing, Sonar};

/// Geometry of all beam planes of a sonar.
#[derive(Clone, Debug)]
pub struct Planes {
    /// Cosine of each plane's azimuth.
    pub cos: Vec<f32>,
    /// Sine of each plane's azimuth.
    pub sin: Vec<f32>,
    /// Azimuth of plane 0, radians (the most starboard one).
    pub first_rad: f64,
    /// Azimuth between neighbouring planes, radians.
    pub step_rad: f64,
    /// Tangent of each elevation sample, ascending.
    pub t: Vec<f32>,
    /// Lower edge of the first elevation cell (tangent).
    pub t_low: f32,
    /// Upper edge of the last elevation cell (tangent).
    pub t_high: f32,
    /// Height of an elevation cell (tangent).
    pub t_step: f32,
    /// Sine and cosine of the outermost azimuth, half a step beyond the last plane.
    pub edge: (f32, f32),
    /// Farthest slant range of interest, metres.
    pub far_m: f32,
}

impl Planes {
    /// One plane a beam. Where bearing is a cone angle, planes beyond the aperture are added: an echo off the
    /// horizontal plane is heard at a smaller bearing than its azimuth.
    #[must_use]
    pub fn new(sonar: &Sonar) -> Self {
        let step_rad = sonar.grid().beam_rad();
        let half = 0.5 * radians(sonar.azimuth_deg);
        let half_elevation = 0.5 * radians(sonar.elevation_deg);
        let extra = match sonar.bearing {
            Bearing::Azimuth => 0,
            Bearing::Cone => extra_planes(half, half_elevation, step_rad),
        };
        let first_rad = 0.5 * step_rad - half - f64::from(extra) * step_rad;
        let azimuths = (0..sonar.beams + 2 * extra).map(|plane| first_rad + f64::from(plane) * step_rad);
        let (sines, cosines) = azimuths.map(|a| (sin(a) as f32, cos(a) as f32)).unzip();
        let t_high = tan(half_elevation);
        let t_step = 2.0 * t_high / f64::from(sonar.elevations);
        let edge_rad = half + f64::from(extra) * step_rad;
        Self {
            cos: cosines,
            sin: sines,
            first_rad,
            step_rad,
            t: (0..sonar.elevations).map(|j| ((f64::from(j) + 0.5) * t_step - t_high) as f32).collect(),
            t_low: -t_high as f32,
            t_high: t_high as f32,
            t_step: t_step as f32,
            edge: (sin(edge_rad) as f32, cos(edge_rad) as f32),
            far_m: sonar.range_m[1] as f32,
        }
    }

    /// Number of planes.
    #[must_use]
    pub fn count(&self) -> usize {
        self.cos.len()
    }

    /// Elevation samples of a plane.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.t.len()
    }

    /// Azimuth of a plane, radians, port positive.
    #[must_use]
    pub fn azimuth_rad(&self, plane: usize) -> f64 {
        self.first_rad + plane as f64 * self.step_rad
    }

    /// Direction of the sample (plane, t) in the sonar's frame, scaled so that its horizontal part has length 1.
    #[must_use]
    pub fn direction(&self, plane: usize, sample: usize) -> [f32; 3] {
        [self.cos[plane], self.sin[plane], self.t[sample]]
    }
}

/// Planes needed beyond the aperture on each side: an echo at bearing `half` and elevation ε has azimuth
/// asin(sin half / cos ε). Capped short of abeam, where no plane ahead can see.
fn extra_planes(half: f64, half_elevation: f64, step: f64) -> u32 {
    let sine = (sin(half) / cos(half_elevation)).min(1.0);
    let widest = crate::math::real::asin(sine).min(radians(0.5 * Sonar::MAX_AZIMUTH_DEG + 2.0));
    debug_assert!(degrees(widest) < 90.0);
    (((widest - half) / step).ceil().max(0.0)) as u32
}
