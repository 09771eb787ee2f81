//! Grey levels: histograms, their quantiles, and quantiles of measured values.

use std::collections::BTreeMap;

use super::figures::{Intensity, Middle, Spread};

/// Probabilities of the published quantiles, by the name under which they stand.
pub(super) const PROBABILITIES: [(&str, f64); 10] = [
    ("0.01", 0.01),
    ("0.05", 0.05),
    ("0.1", 0.1),
    ("0.25", 0.25),
    ("0.5", 0.5),
    ("0.75", 0.75),
    ("0.9", 0.9),
    ("0.95", 0.95),
    ("0.99", 0.99),
    ("0.999", 0.999),
];

/// How often each grey occurs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Histogram {
    pub counts: [u64; 256],
}

impl Histogram {
    pub fn new() -> Self {
        Self { counts: [0; 256] }
    }

    pub fn of(greys: impl Iterator<Item = u8>) -> Self {
        let mut histogram = Self::new();
        greys.for_each(|grey| histogram.add(grey));
        histogram
    }

    pub fn add(&mut self, grey: u8) {
        self.counts[usize::from(grey)] += 1;
    }

    pub fn merge(&mut self, other: &Self) {
        self.counts.iter_mut().zip(&other.counts).for_each(|(mine, theirs)| *mine += theirs);
    }

    pub fn total(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// The least grey with at least a share `probability` of all pixels at or below it; `None` without pixels.
    pub fn quantile(&self, probability: f64) -> Option<f64> {
        // A rounding error of the product must not ask for one pixel more.
        let wanted = (probability * self.total() as f64 - 1e-6).max(0.0);
        let mut below = 0;
        self.counts.iter().zip(0u32..).find_map(|(&count, grey)| {
            below += count;
            (count > 0 && below as f64 >= wanted).then_some(f64::from(grey))
        })
    }

    /// Mean of `value(grey)` over the pixels; 0 without pixels.
    pub fn mean_of(&self, value: impl Fn(f64) -> f64) -> f64 {
        let used = self.counts.iter().zip(0u32..).filter(|(count, _)| **count > 0);
        let sum: f64 = used.map(|(&count, grey)| count as f64 * value(f64::from(grey))).sum();
        sum / self.total().max(1) as f64
    }

    pub fn mean(&self) -> f64 {
        self.mean_of(|grey| grey)
    }
}

/// The figures of several frames' histograms; frames without pixels count for nothing.
pub(super) fn intensity(frames: &[&Histogram]) -> Intensity {
    let mut pooled = Histogram::new();
    frames.iter().for_each(|frame| pooled.merge(frame));
    let share = |grey: usize| pooled.counts[grey] as f64 / pooled.total().max(1) as f64;
    let table = |value: &dyn Fn(f64) -> f64| -> BTreeMap<String, f64> {
        PROBABILITIES.iter().map(|&(name, probability)| (name.to_owned(), value(probability))).collect()
    };
    let of_frames =
        |probability: f64| -> Vec<f64> { frames.iter().filter_map(|frame| frame.quantile(probability)).collect() };
    Intensity {
        frames: frames.len() as u64,
        pooled_quantiles: table(&|probability| pooled.quantile(probability).unwrap_or(0.0)),
        pooled_mean: pooled.mean(),
        zero_fraction: share(0),
        saturated_255_fraction: share(255),
        per_frame_quantile_mean: table(&|probability| mean_and_sd(&of_frames(probability)).0),
        per_frame_quantile_sd: table(&|probability| mean_and_sd(&of_frames(probability)).1),
    }
}

/// Mean and standard deviation (of the values, not of a population behind them); zeros without values.
pub(super) fn mean_and_sd(values: &[f64]) -> (f64, f64) {
    let n = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / n;
    (mean, variance.sqrt())
}

/// Measured values in ascending order, to ask quantiles of.
pub(super) struct Sorted(Vec<f64>);

impl Sorted {
    /// `None` without values.
    pub fn new(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_by(f64::total_cmp);
        (!values.is_empty()).then_some(Self(values))
    }

    pub fn len(&self) -> u64 {
        self.0.len() as u64
    }

    /// Quantile with linear interpolation between neighbours.
    pub fn quantile(&self, probability: f64) -> f64 {
        let place = probability * (self.0.len() - 1) as f64;
        let low = place.floor();
        let (first, second) = (self.0[low as usize], self.0[(low as usize + 1).min(self.0.len() - 1)]);
        first + (second - first) * (place - low)
    }

    pub fn median(&self) -> f64 {
        self.quantile(0.5)
    }

    /// Share of values below a limit.
    pub fn share_below(&self, limit: f64) -> f64 {
        self.0.partition_point(|&value| value < limit) as f64 / self.0.len() as f64
    }

    pub fn middle(&self) -> Middle {
        Middle { median: self.median(), p10: self.quantile(0.1), p90: self.quantile(0.9) }
    }

    pub fn spread(&self) -> Spread {
        let at = |probability| self.quantile(probability);
        Spread { n: self.len(), p05: at(0.05), p25: at(0.25), median: at(0.5), p75: at(0.75), p95: at(0.95) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_greys_are_exact() {
        // 1000 pixels, ten of each grey 0..100.
        let even = Histogram::of((0..1000).map(|i| (i % 100) as u8));
        for (probability, grey) in [(0.01, 0.0), (0.05, 4.0), (0.5, 49.0), (0.99, 98.0), (0.999, 99.0)] {
            assert_eq!(even.quantile(probability), Some(grey), "{probability}");
        }
        assert_eq!(even.mean(), 49.5);
        assert_eq!(Histogram::new().quantile(0.5), None);
    }

    #[test]
    fn frames_are_pooled_by_pixels_and_averaged_by_frames() {
        let dark = Histogram::of([0, 10, 10, 10].into_iter());
        let bright = Histogram::of([255; 12].into_iter());
        let all = intensity(&[&dark, &bright]);
        assert_eq!((all.frames, all.pooled_quantiles["0.5"], all.per_frame_quantile_mean["0.5"]), (2, 255.0, 132.5));
        assert_eq!(all.per_frame_quantile_sd["0.5"], 122.5);
        assert_eq!((all.zero_fraction, all.saturated_255_fraction), (1.0 / 16.0, 0.75));
        assert_eq!(all.pooled_mean, (30.0 + 12.0 * 255.0) / 16.0);
    }

    #[test]
    fn quantiles_of_values_interpolate() {
        let values = Sorted::new([4.0, 1.0, 2.0, 3.0, 5.0]).unwrap();
        assert_eq!((values.median(), values.quantile(0.1), values.quantile(1.0)), (3.0, 1.4, 5.0));
        assert_eq!(values.share_below(3.0), 0.4);
        assert!(Sorted::new([]).is_none());
    }
}
