//! From samples of a ping to cells: which beams hear a sample, and how much of its energy counts.

use super::visibility::Planes;
use super::{Bearing, Sonar};
use crate::math::real::{asin, cos, radians, sin};

/// The two neighbouring beams that share one sample's energy. Beam −1 and beam `beams` lie outside the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// The more starboard of the two.
    pub first: i32,
    /// Share of `first`; the rest goes to `first + 1`.
    pub share: f32,
}

impl Split {
    /// The split of the same patch seen `beams` more to port.
    #[inline]
    #[must_use]
    pub fn moved(self, beams: f32) -> Self {
        if beams == 0.0 {
            return self;
        }
        let place = self.first as f32 + (1.0 - self.share) + beams;
        let first = place.floor();
        Self { first: first as i32, share: 1.0 - (place - first) }
    }
}

/// Tables over the samples of a sonar's ping.
#[derive(Clone, Debug)]
pub struct Beams {
    /// For each (plane, sample), plane by plane, who hears it. A single entry a plane where bearing is azimuth.
    splits: Vec<Split>,
    /// Entries of `splits` a plane.
    stride: usize,
    /// Half the horizontal aperture, radians.
    half: f64,
    /// Angle between beams, radians.
    beam_rad: f64,
    /// For each sample: two-way vertical pattern × azimuth step × cos⁵ε, so that `E = weight · f(cos θ) · w² · Δt` is the
    /// energy of a patch at 1/ρ = w that spans Δt.
    pub weight: Vec<f32>,
    /// For each sample: two-way vertical pattern × its solid angle, sr.
    pub solid_angle: Vec<f32>,
    /// For each sample: cosine of its elevation.
    pub cosine: Vec<f32>,
    /// For each sample: secant of its elevation, and how it changes with the tangent. Pieces of a sample reach half a
    /// sample from it: there the two give √(1 + t²) to 1e-7.
    pub secant: Vec<[f32; 2]>,
}

impl Beams {
    /// The tables of `sonar` over `planes`.
    #[must_use]
    pub fn new(sonar: &Sonar, planes: &Planes) -> Self {
        let beam_rad = sonar.grid().beam_rad();
        let half = 0.5 * radians(sonar.azimuth_deg);
        let samples: &[f32] = match sonar.bearing {
            Bearing::Azimuth => &[0.0],
            Bearing::Cone => &planes.t,
        };
        let mut splits = Vec::with_capacity(planes.count() * samples.len());
        for plane in 0..planes.count() {
            let azimuth = planes.azimuth_rad(plane);
            for &t in samples {
                let cos_elevation = 1.0 / (1.0 + f64::from(t) * f64::from(t)).sqrt();
                splits.push(split(azimuth, cos_elevation, planes.step_rad, half, beam_rad));
            }
        }
        let cosine: Vec<f64> = planes.t.iter().map(|&t| 1.0 / (1.0 + f64::from(t) * f64::from(t)).sqrt()).collect();
        let heard: Vec<f64> = planes
            .t
            .iter()
            .zip(&cosine)
            .map(|(&t, cosine)| {
                let sin_elevation = f64::from(t) * cosine;
                let pattern =
                    sonar.vertical_beam_deg.map_or(1.0, |width| vertical_pattern(sin_elevation, radians(width)));
                pattern * planes.step_rad
            })
            .collect();
        let times_cosine = |power: i32, step: f64| -> Vec<f32> {
            heard
                .iter()
                .zip(&cosine)
                .map(|(heard, c)| (heard * step * (0..power).fold(1.0, |p, _| p * c)) as f32)
                .collect()
        };
        Self {
            splits,
            stride: samples.len(),
            half,
            beam_rad,
            weight: times_cosine(5, 1.0),
            solid_angle: times_cosine(3, f64::from(planes.t_step)),
            secant: planes.t.iter().zip(&cosine).map(|(&t, c)| [(1.0 / c) as f32, (f64::from(t) * c) as f32]).collect(),
            cosine: cosine.iter().map(|&c| c as f32).collect(),
        }
    }

    /// Who hears sample (plane, sample).
    #[inline]
    #[must_use]
    pub fn split(&self, plane: usize, sample: usize) -> Split {
        self.splits[plane * self.stride + sample.min(self.stride - 1)]
    }
}

impl Beams {
    /// Who hears what comes from a bearing, radians: the two beams on either side of it.
    #[must_use]
    pub fn split_at(&self, bearing: f64) -> Split {
        let place = (bearing + self.half) / self.beam_rad - 0.5;
        let first = place.floor();
        Split { first: first as i32, share: (1.0 - (place - first)) as f32 }
    }
}

/// Spreads a patch one azimuth step wide over the beams that it overlaps. In bearing it is never wider than in azimuth,
/// hence never more than two beams.
fn split(azimuth: f64, cos_elevation: f64, step: f64, half: f64, beam_rad: f64) -> Split {
    let bearing = asin(sin(azimuth) * cos_elevation);
    let width = step * cos_elevation * cos(azimuth) / cos(bearing);
    let low = (bearing - 0.5 * width + half) / beam_rad;
    let high = (bearing + 0.5 * width + half) / beam_rad;
    // A patch that ends a rounding error beyond a beam's edge belongs to that beam.
    let first = (low + 1e-6).floor();
    let share = ((first + 1.0 - low) / (high - low)).clamp(0.0, 1.0);
    Split { first: first as i32, share: if share > 1.0 - 1e-5 { 1.0 } else { share as f32 } }
}

/// Two-way vertical power pattern of a uniform line aperture whose one-way −3 dB width is `width_rad`.
///
/// b(ε) = sinc⁴(0.442946·sin ε / sin(width/2)), with sinc(x) = sin(πx)/(πx): one factor sinc² for transmission, one for reception.
/// Source: Urick (1983), ch. 3, uniform line array; −3 dB of sinc² at x = 0.442946.
#[must_use]
pub fn vertical_pattern(sin_elevation: f64, width_rad: f64) -> f64 {
    let x = std::f64::consts::PI * 0.442_946_470_689_452_3 * sin_elevation / sin(0.5 * width_rad);
    let one_way = if x.abs() < 1e-6 { 1.0 } else { (sin(x) / x) * (sin(x) / x) };
    one_way * one_way
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vertical_pattern_is_3_db_down_each_way_at_its_edge() {
        let width = radians(20.0);
        assert!((vertical_pattern(0.0, width) - 1.0).abs() < 1e-12);
        assert!((vertical_pattern(sin(0.5 * width), width) - 0.25).abs() < 1e-9);
    }

    #[test]
    fn a_patch_on_the_horizontal_plane_belongs_to_its_own_beam() {
        let step = radians(130.0) / 512.0;
        for beam in [0, 100, 511] {
            let azimuth = (f64::from(beam) + 0.5) * step - radians(65.0);
            assert_eq!(split(azimuth, 1.0, step, radians(65.0), step), Split { first: beam, share: 1.0 });
        }
    }

    #[test]
    fn off_the_horizontal_plane_bearing_shrinks_towards_ahead() {
        let step = radians(130.0) / 512.0;
        let shifted = split(radians(60.0), cos(radians(10.0)), step, radians(65.0), step);
        let bearing = asin(sin(radians(60.0)) * cos(radians(10.0)));
        let middle = f64::from(shifted.first) + 1.0 - f64::from(shifted.share);
        let expected = (bearing + radians(65.0)) / step - 0.5;
        assert!((middle - expected).abs() < 0.5, "{middle} {expected}");
    }
}
