//! How far grey is correlated across and along range, in homogeneous patches.
//!
//! Patches within [`AHEAD_DEG`] of straight ahead are used, where columns of the picture run along range and rows across.
//! The correlation at a lag is the mean product of pixels that far apart, less the patch's mean, over its variance; it is
//! averaged over the patches of a tenth of the far range, and crossings of 1/2 and 1/e are found between whole pixels by
//! linear interpolation. These reproduce the relations between the published columns.

use super::figures::CorrelationRow;
use super::geometry::FanGeometry;
use super::images::Frame;
use super::patches::Patch;
use crate::math::real::{atan2, degrees, exp, radians};

/// Half the aperture of the published fans, degrees.
const AHEAD_DEG: f64 = 15.0;
/// Longest lag, pixels.
const LAGS: usize = 10;
/// Shares of the far range that are averaged apart.
const CLASSES: usize = 10;

/// Sums over patches, by share of the far range.
#[derive(Clone, Debug, Default)]
pub(super) struct Correlation {
    classes: [Class; CLASSES],
}

#[derive(Clone, Debug, Default)]
struct Class {
    patches: u64,
    range_px: f64,
    /// Across and along range, lags 0 to [`LAGS`].
    sums: [[f64; LAGS + 1]; 2],
}

impl Correlation {
    /// The correlation of a frame's patches.
    pub fn of(frame: &Frame<'_>, patches: &[Patch], side: usize) -> Self {
        let mut all = Self::default();
        let ahead = patches.iter().filter(|patch| patch.bearing_rad.abs() <= radians(AHEAD_DEG));
        for patch in ahead.filter(|_| side > LAGS) {
            let class = (patch.range_px / frame.fan.rmax_px * CLASSES as f64) as usize;
            let class = &mut all.classes[class.min(CLASSES - 1)];
            class.patches += 1;
            class.range_px += patch.range_px;
            let first = patch.corner.1 * frame.width + patch.corner.0;
            for (sums, (along, across)) in class.sums.iter_mut().zip([(1, frame.width), (frame.width, 1)]) {
                let at = |line: usize, i: usize| f64::from(frame.grey[first + line * across + i * along]) - patch.mean;
                for (lag, sum) in sums.iter_mut().enumerate() {
                    let pairs = (0..side).flat_map(|line| (0..side - lag).map(move |i| (line, i)));
                    let product: f64 = pairs.map(|(line, i)| at(line, i) * at(line, i + lag)).sum();
                    *sum += product / ((side * (side - lag)) as f64 * patch.std * patch.std);
                }
            }
        }
        all
    }

    /// Adds another frame's sums.
    pub fn merge(&mut self, other: &Self) {
        for (mine, theirs) in self.classes.iter_mut().zip(&other.classes) {
            mine.patches += theirs.patches;
            mine.range_px += theirs.range_px;
            for (mine, theirs) in mine.sums.iter_mut().flatten().zip(theirs.sums.iter().flatten()) {
                *mine += theirs;
            }
        }
    }

    /// A row for each share of the far range that has patches, near to far.
    pub fn rows(&self, fan: &FanGeometry) -> Vec<CorrelationRow> {
        self.classes.iter().filter(|class| class.patches > 0).filter_map(|class| class.row(fan)).collect()
    }
}

impl Class {
    /// `None` if the correlation stays high over all lags.
    fn row(&self, fan: &FanGeometry) -> Option<CorrelationRow> {
        let n = self.patches as f64;
        let [across, along] = self.sums.map(|sums| sums.map(|sum| sum / n));
        let range_px = self.range_px / n;
        let bearing_deg = |lag_px: f64| degrees(atan2(lag_px, range_px));
        let (half, e) = (0.5, exp(-1.0));
        let lateral_half_px = crossing(&across, half)?;
        let lateral_1e_deg = bearing_deg(crossing(&across, e)?);
        Some(CorrelationRow {
            range_px,
            n: self.patches,
            lateral_half_px,
            lateral_half_deg: bearing_deg(lateral_half_px),
            lateral_1e_deg,
            lateral_1e_beams: fan.beams.map(|beams| lateral_1e_deg * f64::from(beams) / fan.fov_deg),
            range_half_px: crossing(&along, half)?,
            range_1e_px: crossing(&along, e)?,
            lag1_lateral: across[1],
            lag1_range: along[1],
        })
    }
}

/// The lag at which a correlation first falls to a level.
fn crossing(correlation: &[f64], level: f64) -> Option<f64> {
    let lag = correlation.windows(2).position(|pair| pair[1] <= level)?;
    let (before, after) = (correlation[lag], correlation[lag + 1]);
    Some(lag as f64 + (before - level) / (before - after))
}

#[cfg(test)]
mod tests {
    use super::super::Settings;
    use super::super::patches::homogeneous;
    use super::super::sample::{blank, noise};
    use super::*;
    use crate::math::rng::Stream;

    fn rows(frame: &Frame<'_>) -> Vec<CorrelationRow> {
        let settings = Settings { patches_per_frame: 1000, homogeneity: 0.3, ..Settings::default() };
        Correlation::of(frame, &homogeneous(frame, &settings), 20).rows(frame.fan)
    }

    #[test]
    fn white_noise_is_correlated_with_itself_only() {
        let rows = rows(&noise(2, |s| 100.0 + 20.0 * s.normal()));
        assert!(rows.len() >= 5);
        for row in rows {
            // From 1 to −1/400 within a pixel: 1/e at 0.63.
            assert!((row.range_1e_px - 0.63).abs() < 0.03 && (row.lateral_half_px - 0.5).abs() < 0.03, "{row:?}");
            assert!((row.lateral_1e_deg / (degrees(1.0) * 0.63 / row.range_px) - 1.0).abs() < 0.05, "{row:?}");
            assert!((row.lateral_1e_beams.unwrap() / row.lateral_1e_deg - 128.0 / 60.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_known_blur_gives_its_own_lengths() {
        // Means of 4 pixels across and 2 along: triangles that reach 0 at lags 4 and 2.
        let mut frame = blank(0);
        let (width, height) = (frame.width, frame.height);
        let mut stream = Stream::at(3, "test", 0, "blur");
        let white: Vec<f64> = (0..width * height).map(|_| stream.normal()).collect();
        for y in 0..height - 1 {
            for x in 0..width - 3 {
                let sum: f64 = (0..8).map(|k| white[(y + k / 4) * width + x + k % 4]).sum();
                frame.grey[y * width + x] = (120.0 + 8.0 * sum).clamp(0.0, 255.0) as u8;
            }
        }
        for row in rows(&frame) {
            assert!((row.lag1_lateral - 0.75).abs() < 0.04 && (row.lag1_range - 0.5).abs() < 0.05, "{row:?}");
            assert!((row.lateral_half_px - 2.0).abs() < 0.15, "{row:?}");
            assert!((row.range_1e_px - 2.0 * (1.0 - exp(-1.0))).abs() < 0.12, "{row:?}");
        }
    }

    #[test]
    fn crossings_reproduce_the_published_relations() {
        // Row A/258: correlation 0.37 at one pixel is 1/2 at 0.79 pixels; row B/173: 0.353 is 1/e at 0.98 pixels.
        assert!((crossing(&[1.0, 0.37, 0.1], 0.5).unwrap() - 0.79).abs() < 0.005);
        assert!((crossing(&[1.0, 0.353, 0.1], exp(-1.0)).unwrap() - 0.98).abs() < 0.005);
        assert_eq!(crossing(&[1.0, 0.9, 0.8], 0.5), None);
    }
}
