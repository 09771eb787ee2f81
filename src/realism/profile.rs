//! Grey over range, and ripple from beam to beam.

use super::figures::RangeProfile;
use super::geometry::Direction;
use super::images::Frame;
use super::quantiles::{Histogram, Sorted, mean_and_sd};
use crate::math::real::radians;

/// Range bins of a profile, from rmin to rmax.
const BINS: usize = 20;
/// Beams on each side of one over which its neighbourhood's gain is averaged.
const NEIGHBOURS: usize = 8;

/// Median grey of each range bin of a frame, and of the frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FrameProfile {
    bins: [Option<f64>; BINS],
    median: f64,
}

impl FrameProfile {
    /// `None` if no pixel is in the fan.
    pub fn of(frame: &Frame<'_>, all: &Histogram) -> Option<Self> {
        let mut bins = vec![Histogram::new(); BINS];
        let per_pixel = BINS as f64 / (frame.fan.rmax_px - frame.fan.rmin_px);
        for (pixel, &grey) in frame.grey.iter().enumerate().filter(|(pixel, _)| frame.inside[*pixel]) {
            let (x, y) = frame.place(pixel);
            let bin = ((frame.fan.range(x, y) - frame.fan.rmin_px) * per_pixel) as usize;
            bins[bin.min(BINS - 1)].add(grey);
        }
        let median = all.quantile(0.5)?;
        let mut profile = Self { bins: [None; BINS], median };
        profile.bins.iter_mut().zip(&bins).for_each(|(median, greys)| *median = greys.quantile(0.5));
        Some(profile)
    }
}

/// The profile of several frames. A black frame has no normalised profile.
pub(super) fn range_profile(frames: &[&FrameProfile]) -> RangeProfile {
    let grey = |bin: usize| Sorted::new(frames.iter().filter_map(|frame| frame.bins[bin]));
    let normalised = |bin: usize| {
        let lit = frames.iter().filter(|frame| frame.median > 0.0);
        Sorted::new(lit.filter_map(|frame| Some(frame.bins[bin]? / frame.median)))
    };
    let row = |value: &dyn Fn(usize) -> Option<f64>| (0..BINS).map(|bin| value(bin).unwrap_or(0.0)).collect();
    let at = |probability: f64| row(&|bin| Some(normalised(bin)?.quantile(probability)));
    RangeProfile {
        bin_centres_fraction_of_rmin_to_rmax: row(&|bin| Some((bin as f64 + 0.5) / BINS as f64)),
        median_grey: row(&|bin| Some(grey(bin)?.median())),
        normalised_median: at(0.5),
        normalised_p10: at(0.1),
        normalised_p90: at(0.9),
    }
}

/// Ripple of the gain from beam to beam in one frame: a standard deviation relative to 1.
///
/// Each beam is read off the picture at its own bearing, pixel by pixel along range, from where beams are a pixel apart;
/// objects are left out. Greys are divided by the mean of all beams at the same range, averaged along the beam, and divided
/// by the mean over the beam and [`NEIGHBOURS`] on each side; so trends over range and over many beams do not count, but
/// what speckle leaves in the average of a beam does. `None` where beams are not known or all finer than pixels.
pub(super) fn beam_ripple(frame: &Frame<'_>) -> Option<f64> {
    let beams = frame.fan.beams?;
    let step = radians(frame.fan.fov_deg) / f64::from(beams);
    let first = (1.0 / step).max(frame.fan.rmin_px + 1.0);
    let ranges = (frame.fan.rmax_px - 1.0 - first).floor();
    if ranges < 1.0 {
        return None;
    }
    let read = |beam: u32| {
        let direction = Direction::new((f64::from(beam) + 0.5) * step - 0.5 * radians(frame.fan.fov_deg));
        (0..ranges as u32).map(move |i| {
            let pixel = frame.pixel(frame.fan.place(first + f64::from(i), direction))?;
            (frame.object(pixel) == 0).then(|| f64::from(frame.grey[pixel]))
        })
    };
    let mut rows = vec![(0.0, 0u32); ranges as usize];
    for beam in 0..beams {
        for (grey, row) in read(beam).zip(&mut rows).filter_map(|(grey, row)| Some((grey?, row))) {
            *row = (row.0 + grey, row.1 + 1);
        }
    }
    let means: Vec<f64> = rows.iter().map(|&(sum, count)| sum / f64::from(count.max(1))).collect();
    let gain = |beam: u32| {
        let lit = read(beam).zip(&means).filter(|(_, mean)| **mean > 0.0);
        let (sum, count) = lit.fold((0.0, 0u32), |(sum, count), (grey, mean)| match grey {
            Some(grey) => (sum + grey / mean, count + 1),
            None => (sum, count),
        });
        // A beam that is mostly hidden by objects or by the edge says little of its gain.
        (f64::from(count) >= 0.25 * ranges).then(|| sum / f64::from(count))
    };
    let gains: Vec<f64> = (0..beams).filter_map(gain).collect();
    ripple(&gains)
}

fn ripple(gains: &[f64]) -> Option<f64> {
    if gains.len() <= 2 * NEIGHBOURS {
        return None;
    }
    let deviations: Vec<f64> = (NEIGHBOURS..gains.len() - NEIGHBOURS)
        .map(|beam| {
            let around = &gains[beam - NEIGHBOURS..=beam + NEIGHBOURS];
            let mean = around.iter().sum::<f64>() / around.len() as f64;
            if mean > 0.0 { gains[beam] / mean - 1.0 } else { 0.0 }
        })
        .collect();
    Some(mean_and_sd(&deviations).1)
}

#[cfg(test)]
mod tests {
    use super::super::sample::{blank, painted};
    use super::*;

    fn profile(frame: &Frame<'_>) -> FrameProfile {
        let inside = frame.grey.iter().zip(&frame.inside).filter(|(_, inside)| **inside);
        FrameProfile::of(frame, &Histogram::of(inside.map(|(&grey, _)| grey))).unwrap()
    }

    #[test]
    fn a_ramp_over_range_is_its_own_profile() {
        // 200 at the near edge down to 100 at the far edge, in 20 steps of 5.
        let frame = painted(|range, _| 200 - 5 * ((range - 60.0) / 17.0).clamp(0.0, 19.0) as u8);
        let profile = profile(&frame);
        let dark = FrameProfile { bins: profile.bins.map(|grey| grey.map(|grey| grey - 20.0)), median: 100.0 };
        let found = range_profile(&[&profile, &profile, &dark]);
        for bin in 0..BINS {
            assert_eq!(found.median_grey[bin], 200.0 - 5.0 * bin as f64);
            assert!((found.normalised_median[bin] - found.median_grey[bin] / profile.median).abs() < 1e-12);
            assert!((found.bin_centres_fraction_of_rmin_to_rmax[bin] - 0.025 - 0.05 * bin as f64).abs() < 1e-12);
        }
    }

    #[test]
    fn ripple_is_the_deviation_of_the_beams_gains() {
        // Every second of 128 beams 5 % up, the others 5 % down: 17 neighbours take 1/17 of it away.
        let beam = |bearing: f64| ((bearing + 30.0) / 60.0 * 128.0).floor() as i32;
        let frame = painted(|_, bearing| if beam(bearing) % 2 == 0 { 105 } else { 95 });
        let found = beam_ripple(&frame).unwrap();
        assert!((found - 0.05 * 16.0 / 17.0).abs() < 0.004, "{found}");
        assert_eq!(beam_ripple(&blank(50)), Some(0.0));
    }

    #[test]
    fn trends_are_no_ripple() {
        let frame = painted(|range, bearing| (200.0 - 0.3 * range + 0.5 * bearing) as u8);
        assert!(beam_ripple(&frame).unwrap() < 0.004);
    }
}
