//! Homogeneous patches: where only speckle changes the grey.
//!
//! Candidates are the squares of a fixed raster (side [`Settings::patch_px`]) that lie wholly in the fan and touch no mask.
//! One is homogeneous if it is not of a single grey and the mean of each of its quarters is within
//! [`Settings::homogeneity`] of its own mean. Of a frame's homogeneous patches at most [`Settings::patches_per_frame`]
//! are kept, evenly from top to bottom. The rule by which the published patches were chosen is not known.

use super::Settings;
use super::figures::{FitFigures, GammaShape, KAmplitude, Speckle, StdVsMean};
use super::fits::Law;
use super::images::Frame;
use super::quantiles::{Histogram, Sorted};
use crate::math::real::ln;

/// A homogeneous patch.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    /// Column and row of its top left pixel.
    pub corner: (usize, usize),
    /// Middle: range from the apex in pixels, bearing in radians.
    pub range_px: f64,
    pub bearing_rad: f64,
    pub greys: Histogram,
    pub mean: f64,
    pub std: f64,
}

/// What is kept of a patch when its frame is done.
#[derive(Clone, Debug)]
pub(super) struct PatchFigures {
    mean: f64,
    std: f64,
    skewness: f64,
    /// Whether E[x⁴] / E[x²]² > 2.
    heavier_than_rayleigh: bool,
    /// Range / rmax.
    range: f64,
    /// Distance and parameters for each law, of those that are fitted.
    fits: Option<Vec<(f64, Vec<f64>)>>,
}

/// The homogeneous patches of a frame.
pub(super) fn homogeneous(frame: &Frame<'_>, settings: &Settings) -> Vec<Patch> {
    let side = settings.patch_px as usize;
    let mut patches = Vec::new();
    for top in (0..(frame.height + 1).saturating_sub(side)).step_by(side) {
        for left in (0..(frame.width + 1).saturating_sub(side)).step_by(side) {
            patches.extend(patch(frame, (left, top), settings));
        }
    }
    let total = patches.len();
    let kept = total.min(settings.patches_per_frame);
    (0..kept).map(|i| patches[(2 * i + 1) * total / (2 * kept)].clone()).collect()
}

fn patch(frame: &Frame<'_>, corner: (usize, usize), settings: &Settings) -> Option<Patch> {
    let side = settings.patch_px as usize;
    let mut quarters = [0u32; 4];
    let mut greys = Histogram::new();
    let half = side / 2;
    for row in 0..side {
        let start = (corner.1 + row) * frame.width + corner.0;
        if frame.inside[start..start + side].contains(&false) || (start..start + side).any(|at| frame.object(at) != 0) {
            return None;
        }
        for (column, &grey) in frame.grey[start..start + side].iter().enumerate() {
            greys.add(grey);
            // The middle row and column of an odd side belong to no quarter.
            let outer = |i: usize| i < half || i >= side - half;
            if outer(row) && outer(column) {
                quarters[usize::from(row >= half) * 2 + usize::from(column >= half)] += u32::from(grey);
            }
        }
    }
    let mean = greys.mean();
    let std = greys.mean_of(|grey| (grey - mean) * (grey - mean)).sqrt();
    let quarter_pixels = (half * half) as f64;
    let even =
        quarters.iter().all(|&sum| (f64::from(sum) / quarter_pixels - mean).abs() <= settings.homogeneity * mean);
    let middle = 0.5 * (side - 1) as f64;
    let (range_px, bearing_rad) = frame.fan.polar(corner.0 as f64 + middle, corner.1 as f64 + middle);
    (even && std > 0.0).then_some(Patch { corner, range_px, bearing_rad, greys, mean, std })
}

impl Patch {
    /// Reduces a patch; fits laws to it if asked for.
    pub fn figures(&self, rmax_px: f64, laws: &[Law]) -> PatchFigures {
        let (mean, std) = (self.mean, self.std);
        let standard = |grey: f64| (grey - mean) / std;
        let power = self.greys.mean_of(|grey| grey * grey);
        let fits = laws.iter().map(|law| law.fit(&self.greys)).map(|fit| (fit.distance(&self.greys), fit.parameters()));
        PatchFigures {
            mean,
            std,
            skewness: self.greys.mean_of(|grey| standard(grey) * standard(grey) * standard(grey)),
            heavier_than_rayleigh: self.greys.mean_of(|grey| grey * grey * grey * grey) > 2.0 * power * power,
            range: self.range_px / rmax_px,
            fits: (!laws.is_empty()).then(|| fits.collect()),
        }
    }
}

/// The figures of all patches; `rmax_px` gives ranges in pixels. `None` without patches.
pub(super) fn speckle(patches: &[PatchFigures], patch_px: u32, rmax_px: f64) -> Option<Speckle> {
    let sorted = |value: &dyn Fn(&PatchFigures) -> f64| Sorted::new(patches.iter().map(value));
    let fitted: Vec<&Vec<(f64, Vec<f64>)>> = patches.iter().filter_map(|patch| patch.fits.as_ref()).collect();
    let shapes = {
        let gamma = Law::ALL.iter().position(|&law| law == Law::Gamma)?;
        Sorted::new(fitted.iter().map(|fits| fits[gamma].1[0]))?
    };
    let heavy = patches.iter().filter(|patch| patch.heavier_than_rayleigh).count();
    Some(Speckle {
        patches: patches.len() as u64,
        patch_px,
        mean_over_std: sorted(&|patch| patch.mean / patch.std)?.middle(),
        cv_std_over_mean: sorted(&|patch| patch.std / patch.mean)?.middle(),
        skewness: sorted(&|patch| patch.skewness)?.middle(),
        std_vs_mean: std_vs_mean(patches),
        cv_by_range: cv_by_range(patches, rmax_px),
        fits: Law::ALL
            .iter()
            .enumerate()
            .filter_map(|(i, law)| Some((law.name().to_owned(), fit(&fitted, i)?)))
            .collect(),
        k_amplitude: KAmplitude { patches_with_finite_nu: heavy as f64 / patches.len() as f64 },
        gamma_shape: GammaShape { median_shape: shapes.median(), p10: shapes.quantile(0.1), p90: shapes.quantile(0.9) },
    })
}

fn fit(fitted: &[&Vec<(f64, Vec<f64>)>], law: usize) -> Option<FitFigures> {
    let median_ks = Sorted::new(fitted.iter().map(|fits| fits[law].0))?.median();
    let parameters = fitted.first()?[law].1.len();
    let median = |i: usize| Some(Sorted::new(fitted.iter().map(|fits| fits[law].1[i]))?.median());
    Some(FitFigures { median_ks, median_params: (0..parameters).filter_map(median).collect() })
}

fn std_vs_mean(patches: &[PatchFigures]) -> StdVsMean {
    const SHARES: usize = 12;
    let mut by_mean: Vec<&PatchFigures> = patches.iter().collect();
    by_mean.sort_by(|a, b| a.mean.total_cmp(&b.mean));
    let row = |share: usize| {
        let patches = &by_mean[share * by_mean.len() / SHARES..(share + 1) * by_mean.len() / SHARES];
        let median = |value: &dyn Fn(&PatchFigures) -> f64| {
            Some(Sorted::new(patches.iter().map(|patch| value(patch)))?.median())
        };
        let cv = median(&|patch| patch.std / patch.mean)?;
        Some((median(&|patch| patch.mean)?, median(&|patch| patch.std)?, cv, patches.len() as u64))
    };
    let logs: Vec<(f64, f64)> = patches.iter().map(|patch| (ln(patch.mean), ln(patch.std))).collect();
    let (loglog_slope, r) = line(&logs);
    StdVsMean { table_mean_std_cv_n: (0..SHARES).filter_map(row).collect(), loglog_slope, r }
}

/// Slope of the least-squares line and correlation; zeros where all points have one x or one y.
fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len().max(1) as f64;
    let (mean_x, mean_y) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let sum = |term: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| term(p.0 - mean_x, p.1 - mean_y)).sum::<f64>();
    let (xx, yy, xy) = (sum(&|x, _| x * x), sum(&|_, y| y * y), sum(&|x, y| x * y));
    if xx * yy > 0.0 { (xy / xx, xy / (xx * yy).sqrt()) } else { (0.0, 0.0) }
}

/// The published shares of the far range, 80–180–260–340–420 pixels and beyond of 577, with their middles.
const RANGE_EDGES: [f64; 6] = [80.0 / 577.0, 180.0 / 577.0, 260.0 / 577.0, 340.0 / 577.0, 420.0 / 577.0, 500.0 / 577.0];

fn cv_by_range(patches: &[PatchFigures], rmax_px: f64) -> Vec<(f64, f64, u64)> {
    let last = RANGE_EDGES.len() - 2;
    let row = |i: usize| {
        let (near, far) = (RANGE_EDGES[i], RANGE_EDGES[i + 1]);
        let here = patches.iter().filter(|p| p.range >= near && (p.range < far || i == last));
        let cv = Sorted::new(here.map(|patch| patch.std / patch.mean))?;
        Some((0.5 * (near + far) * rmax_px, cv.median(), cv.len()))
    };
    (0..=last).filter_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sample::{blank, noise};
    use super::*;

    fn all(frame: &Frame<'_>, settings: &Settings) -> Vec<PatchFigures> {
        homogeneous(frame, settings).iter().map(|patch| patch.figures(frame.fan.rmax_px, &Law::ALL)).collect()
    }

    #[test]
    fn white_rayleigh_noise_measures_as_rayleigh() {
        let frame = noise(1, |s| 50.0 * (-2.0 * ln(1.0 - s.unit())).sqrt());
        let settings = Settings { homogeneity: 0.3, patches_per_frame: 1000, ..Settings::default() };
        let speckle = speckle(&all(&frame, &settings), 20, 400.0).unwrap();
        assert!(speckle.patches > 150, "{}", speckle.patches);
        // 1 / 0.5227, and less a little for the whitest, which 255 cuts.
        assert!((speckle.mean_over_std.median - 1.913).abs() < 0.04, "{:?}", speckle.mean_over_std);
        assert!((speckle.skewness.median - 0.6).abs() < 0.1, "{:?}", speckle.skewness);
        assert!((speckle.fits["rayleigh"].median_params[0] - 50.0).abs() < 1.0);
        assert!((speckle.fits["nakagami"].median_params[0] - 1.0).abs() < 0.05);
        assert!((speckle.fits["weibull"].median_params[0] - 2.0).abs() < 0.06);
        let far = |law: &str| speckle.fits[law].median_ks;
        assert!(far("rayleigh") < 0.045 && far("nakagami") < 0.04 && far("normal") > 0.05, "{:?}", speckle.fits);
    }

    #[test]
    fn the_deviation_against_the_mean_is_found() {
        // Constant deviation: slope 0. Proportional deviation: slope 1.
        for (slope, deviation) in [(0.0, [12.0; 3]), (1.0, [8.0, 12.0, 18.0])] {
            let mut patches = Vec::new();
            for (seed, (mean, deviation)) in [60.0, 90.0, 135.0].into_iter().zip(deviation).enumerate() {
                let frame = noise(seed as u64, move |s| mean + deviation * s.normal());
                patches.extend(all(&frame, &Settings::default()));
            }
            let speckle = speckle(&patches, 20, 400.0).unwrap();
            assert_eq!(speckle.patches, 3 * Settings::default().patches_per_frame as u64);
            let found = speckle.std_vs_mean;
            assert!((found.loglog_slope - slope).abs() < 0.03, "{slope}: {found:?}");
            assert_eq!(found.table_mean_std_cv_n.len(), 12);
            let (mean, std, cv, _) = found.table_mean_std_cv_n[1];
            assert!(
                (mean - 60.0).abs() < 1.0
                    && (std / deviation[0] - 1.0).abs() < 0.04
                    && (cv * mean / std - 1.0).abs() < 0.02
            );
        }
    }

    #[test]
    fn steps_edges_and_objects_are_left_out() {
        let mut frame = noise(4, |s| 80.0 + 5.0 * s.normal());
        let settings = Settings { patches_per_frame: 10_000, ..Settings::default() };
        let before = homogeneous(&frame, &settings).len();
        // A step of grey through the middle of a patch, and a mask of one pixel in another.
        let width = frame.width;
        let (left, top) = homogeneous(&frame, &settings)[before / 2].corner;
        (0..20).for_each(|row| frame.grey[(top + row) * width + left..][..10].fill(140));
        let (left, top) = homogeneous(&frame, &settings)[before / 3].corner;
        let mut mask = vec![0; frame.grey.len()];
        mask[(top + 19) * width + left + 19] = 3;
        frame.mask = Some(mask);
        assert_eq!(homogeneous(&frame, &settings).len(), before - 2);
        assert!(homogeneous(&blank(77), &settings).is_empty(), "one grey has no speckle");
    }
}
