//! Objects against the ring around them, and their shadows against the bottom beside them.
//!
//! An object is every pixel of one number in the mask, if it has at least [`LEAST_PIXELS`].
//! - Ring: pixels of the fan within [`Settings::ring_px`] of the object that belong to no object.
//! - Shadow: at each bearing of the object but the outermost two, [`Settings::shadow_px`] pixels of range that begin
//!   [`GAP_PX`] beyond its farthest pixel at that bearing, less what belongs to an object.
//! - Beside: the same ranges, each as often as in the shadow, at bearings as wide as the object (8–60 pixels) on both sides
//!   of it, [`SIDE_GAP_PX`] away from it, less what belongs to an object.
//! - Control: the same shadow and its beside for the object mirrored about straight ahead, where no object is near.
//!
//! Where exactly the published shadows were measured is not known; the control tells what the measure gives without one.

use std::collections::BTreeMap;

use super::Settings;
use super::figures::{ClassContrast, Objects, ShadowControl};
use super::geometry::Direction;
use super::images::Frame;
use super::quantiles::{Histogram, Sorted};
use crate::math::real::degrees;

/// Smaller objects have no contrast to speak of.
const LEAST_PIXELS: usize = 20;
/// Range between an object and where its shadow is measured, pixels.
const GAP_PX: f64 = 2.0;
/// Distance between an object and where the bottom beside it is measured, pixels.
const SIDE_GAP_PX: f64 = 6.0;
/// Fewest pixels on each side of a ratio.
const LEAST_SAMPLES: f64 = 30.0;

/// One object in one image.
#[derive(Clone, Debug)]
pub(super) struct ObjectFigures {
    label: Option<String>,
    mean_over_ring: f64,
    p95_over_ring: f64,
    shadow: Option<f64>,
    control: Option<f64>,
    extent_deg: f64,
    extent_range_frac: f64,
    area_px: f64,
}

/// The objects of a frame, by number.
pub(super) fn objects(frame: &Frame<'_>, settings: &Settings) -> Vec<ObjectFigures> {
    let mut pixels: BTreeMap<u16, Vec<usize>> = BTreeMap::new();
    for (pixel, &object) in frame.mask.iter().flatten().enumerate() {
        if object != 0 && frame.inside[pixel] {
            pixels.entry(object).or_default().push(pixel);
        }
    }
    pixels.retain(|_, pixels| pixels.len() >= LEAST_PIXELS);
    pixels.iter().filter_map(|(number, pixels)| object(frame, *number, pixels, settings)).collect()
}

/// `None` if there is no ring or the ring is black.
fn object(frame: &Frame<'_>, number: u16, pixels: &[usize], settings: &Settings) -> Option<ObjectFigures> {
    let ring = ring(frame, number, pixels, settings.ring_px);
    let around = (ring.total() > 0).then(|| ring.mean()).filter(|&mean| mean > 0.0)?;
    let greys = Histogram::of(pixels.iter().map(|&pixel| frame.grey[pixel]));
    let outline = Outline::of(frame, pixels);
    let mirrored = outline.mirrored();
    let shadow = |outline: &Outline| outline.shadow(frame, settings.shadow_px);
    Some(ObjectFigures {
        label: frame.labels.get(&number).cloned(),
        mean_over_ring: greys.mean() / around,
        p95_over_ring: greys.quantile(0.95)? / around,
        shadow: shadow(&outline),
        control: if mirrored.is_clear(frame, settings.shadow_px) { shadow(&mirrored) } else { None },
        extent_deg: degrees(outline.step * outline.far.len() as f64),
        extent_range_frac: (outline.farthest() - outline.nearest + 1.0) / (frame.fan.rmax_px - frame.fan.rmin_px),
        area_px: pixels.len() as f64,
    })
}

/// Greys of the ring around an object.
fn ring(frame: &Frame<'_>, number: u16, pixels: &[usize], ring_px: u32) -> Histogram {
    let (width, height, reach) = (frame.width as i64, frame.height as i64, i64::from(ring_px));
    let is_rim = |pixel: usize| {
        let (x, y) = (pixel as i64 % width, pixel as i64 / width);
        let same = |(x, y): (i64, i64)| {
            (0..width).contains(&x) && (0..height).contains(&y) && frame.object((y * width + x) as usize) == number
        };
        ![(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)].into_iter().all(same)
    };
    // The ring's box, so that a small object in a large picture costs little.
    let (columns, rows) = (pixels.iter().map(|p| *p as i64 % width), pixels.iter().map(|p| *p as i64 / width));
    let left = (columns.clone().min().unwrap_or(0) - reach).max(0);
    let right = (columns.max().unwrap_or(0) + reach).min(width - 1);
    let top = (rows.clone().min().unwrap_or(0) - reach).max(0);
    let bottom = (rows.max().unwrap_or(0) + reach).min(height - 1);
    let across = right - left + 1;
    let mut near = vec![false; (across * (bottom - top + 1)) as usize];
    for &pixel in pixels.iter().filter(|&&pixel| is_rim(pixel)) {
        let (x, y) = (pixel as i64 % width, pixel as i64 / width);
        for row in (y - reach).max(top)..=(y + reach).min(bottom) {
            let side = ((reach * reach - (row - y) * (row - y)) as f64).sqrt() as i64;
            let line = (row - top) * across - left;
            near[(line + (x - side).max(left)) as usize..=(line + (x + side).min(right)) as usize].fill(true);
        }
    }
    let in_ring = near.iter().zip(0i64..).filter(|(near, _)| **near).map(|(_, at)| {
        let (x, y) = (left + at % across, top + at / across);
        (y * width + x) as usize
    });
    Histogram::of(in_ring.filter(|&p| frame.inside[p] && frame.object(p) == 0).map(|p| frame.grey[p]))
}

/// An object seen from the apex: its farthest pixel in each of many thin bearings.
struct Outline {
    /// Bearing of the middle of the first, radians.
    first: f64,
    /// Width of each: a pixel at the object's middle range, radians.
    step: f64,
    /// Farthest range, pixels; `None` where the object has a gap.
    far: Vec<Option<f64>>,
    /// Range of its nearest pixel.
    nearest: f64,
}

impl Outline {
    fn of(frame: &Frame<'_>, pixels: &[usize]) -> Self {
        let polar = |pixel: &usize| {
            let (x, y) = frame.place(*pixel);
            frame.fan.polar(x, y)
        };
        let places: Vec<(f64, f64)> = pixels.iter().map(polar).collect();
        let extreme = |start: f64, pick: fn(f64, f64) -> f64, value: fn(&(f64, f64)) -> f64| {
            places.iter().map(value).fold(start, pick)
        };
        let (nearest, farthest) = (extreme(f64::MAX, f64::min, |p| p.0), extreme(0.0, f64::max, |p| p.0));
        let (first, last) = (extreme(f64::MAX, f64::min, |p| p.1), extreme(f64::MIN, f64::max, |p| p.1));
        let step = 1.0 / (0.5 * (nearest + farthest)).max(1.0);
        let mut far = vec![None; ((last - first) / step).round() as usize + 1];
        for (range, bearing) in places {
            let column: &mut Option<f64> = &mut far[((bearing - first) / step).round() as usize];
            *column = Some(column.map_or(range, |far| far.max(range)));
        }
        Self { first, step, far, nearest }
    }

    /// The same shape on the other side of straight ahead.
    fn mirrored(&self) -> Self {
        let last = self.first + self.step * (self.far.len() - 1) as f64;
        Self { first: -last, far: self.far.iter().rev().copied().collect(), ..*self }
    }

    fn farthest(&self) -> f64 {
        self.far.iter().flatten().fold(0.0, |most, &far| far.max(most))
    }

    /// Columns beside the outline, on both sides.
    fn beside(&self) -> Vec<i32> {
        let gap = SIDE_GAP_PX as i32;
        let (columns, width) = (self.far.len() as i32, (self.far.len() as i32).clamp(8, 60));
        (-gap - width..-gap).chain(columns + gap..columns + gap + width).collect()
    }

    fn direction(&self, column: i32) -> Direction {
        Direction::new(self.first + self.step * f64::from(column))
    }

    /// Mean grey behind / mean grey of the same ranges beside; `None` where there are too few pixels or all are black.
    fn shadow(&self, frame: &Frame<'_>, shadow_px: u32) -> Option<f64> {
        let free = |range: f64, direction: Direction| {
            let pixel = frame.pixel(frame.fan.place(range, direction))?;
            (frame.object(pixel) == 0).then(|| f64::from(frame.grey[pixel]))
        };
        // Sum and number of pixels behind the object, by range.
        let mut behind: BTreeMap<i64, (f64, f64)> = BTreeMap::new();
        // The outermost bearings are half in the shadow and half beside it.
        let rim = usize::from(self.far.len() >= 5);
        let bearings = (0..).zip(&self.far).skip(rim).take(self.far.len() - 2 * rim);
        for (column, far) in bearings.filter_map(|(column, far)| Some((column, (*far)?))) {
            let direction = self.direction(column);
            let start = (far + GAP_PX).ceil() as i64;
            for range in start..start + i64::from(shadow_px) {
                if let Some(grey) = free(range as f64, direction) {
                    let (sum, count) = behind.entry(range).or_default();
                    (*sum, *count) = (*sum + grey, *count + 1.0);
                }
            }
        }
        let directions: Vec<Direction> = self.beside().into_iter().map(|column| self.direction(column)).collect();
        let (mut shadow, mut beside, mut samples) = (0.0, 0.0, 0.0);
        for (range, (sum, count)) in behind {
            let greys = directions.iter().filter_map(|&direction| free(range as f64, direction));
            let (total, pixels) = greys.fold((0.0, 0.0), |(total, pixels), grey| (total + grey, pixels + 1.0));
            if pixels > 0.0 {
                (shadow, beside, samples) = (shadow + sum, beside + count * total / pixels, samples + count);
            }
        }
        (samples >= LEAST_SAMPLES && beside > 0.0).then(|| shadow / beside)
    }

    /// Whether no object is where the outline, its shadow and what is beside them lie.
    fn is_clear(&self, frame: &Frame<'_>, shadow_px: u32) -> bool {
        let (near, far) = (self.nearest as i64, self.farthest() as i64 + i64::from(shadow_px));
        let beside = self.beside();
        let (first, last) = (beside.first().copied().unwrap_or(0), beside.last().copied().unwrap_or(0));
        (first..=last).all(|column| {
            let direction = self.direction(column);
            let mut pixels = (near..=far).filter_map(|range| frame.pixel(frame.fan.place(range as f64, direction)));
            pixels.all(|pixel| frame.object(pixel) == 0)
        })
    }
}

/// The figures of all objects; `None` without any.
pub(super) fn contrasts(all: &[ObjectFigures]) -> Option<Objects> {
    let sorted = |value: &dyn Fn(&ObjectFigures) -> Option<f64>| Sorted::new(all.iter().filter_map(value));
    let shadows = sorted(&|object| object.shadow);
    let control = sorted(&|object| object.control);
    let below = |limit: f64| shadows.as_ref().map_or(0.0, |shadows| shadows.share_below(limit));
    let mut classes: BTreeMap<&str, Vec<&ObjectFigures>> = BTreeMap::new();
    for object in all {
        if let Some(label) = &object.label {
            classes.entry(label).or_default().push(object);
        }
    }
    Some(Objects {
        contrast_mean_object_over_ring: sorted(&|object| Some(object.mean_over_ring))?.spread(),
        contrast_p95_object_over_ring: sorted(&|object| Some(object.p95_over_ring))?.spread(),
        shadow_over_background: shadows.as_ref().map(Sorted::spread),
        shadow_below_08: below(0.8),
        shadow_below_06: below(0.6),
        per_class: classes.into_iter().filter_map(|(label, of)| Some((label.to_owned(), class(&of)?))).collect(),
        shadow_control_without_object: control.as_ref().map(Sorted::spread).map(|control| ShadowControl {
            n: control.n,
            p05: control.p05,
            p25: control.p25,
            median: control.median,
            p75: control.p75,
        }),
    })
}

fn class(objects: &[&ObjectFigures]) -> Option<ClassContrast> {
    let median = |value: &dyn Fn(&ObjectFigures) -> Option<f64>| {
        Some(Sorted::new(objects.iter().filter_map(|object| value(object)))?.median())
    };
    Some(ClassContrast {
        n: objects.len() as u64,
        contrast_mean: median(&|object| Some(object.mean_over_ring))?,
        contrast_p95: median(&|object| Some(object.p95_over_ring))?,
        shadow_ratio: median(&|object| object.shadow),
        extent_deg: median(&|object| Some(object.extent_deg))?,
        extent_range_frac: median(&|object| Some(object.extent_range_frac))?,
        area_px: median(&|object| Some(object.area_px))?,
    })
}

#[cfg(test)]
mod tests {
    use super::super::sample::painted;
    use super::*;

    /// Object at ranges 180–220 and ±4° about 10°, shadow 222–290 behind it, on a bottom of 100 that falls with range.
    fn frame(bottom: fn(f64) -> u8) -> Frame<'static> {
        let inside = |range: f64, bearing: f64, near: f64, far: f64| {
            range >= near && range <= far && (bearing - 10.0).abs() <= 4.0
        };
        let mut frame = painted(|range, bearing| {
            if inside(range, bearing, 180.0, 220.0) {
                // A tenth of the object is very bright.
                if range >= 216.0 { 240 } else { 150 }
            } else if inside(range, bearing, 220.0, 290.0) {
                bottom(range) / 2
            } else {
                bottom(range)
            }
        });
        let mask = painted(|range, bearing| u8::from(inside(range, bearing, 180.0, 220.0)));
        frame.mask = Some(mask.grey.into_iter().map(u16::from).collect());
        frame
    }

    #[test]
    fn a_painted_shadow_is_found_exactly_whatever_the_range_trend() {
        let bottoms: [fn(f64) -> u8; 2] = [|_| 100, |range| (400.0 - range).max(0.0) as u8 / 2 * 2];
        for bottom in bottoms {
            let all = objects(&frame(bottom), &Settings::default());
            let [object] = &all[..] else { panic!("one object, not {}", all.len()) };
            assert!((object.shadow.unwrap() - 0.5).abs() < 0.01, "{object:?}");
            assert!((object.control.unwrap() - 1.0).abs() < 0.01, "{object:?}");
            assert!((object.extent_deg - 8.0).abs() < 0.5, "{object:?}");
            assert!((object.extent_range_frac - 41.0 / 340.0).abs() < 0.005, "{object:?}");
        }
    }

    #[test]
    fn a_painted_object_has_its_contrast() {
        let mut frame = frame(|_| 100);
        // Without the shadow the ring is 100 all around.
        for pixel in 0..frame.grey.len() {
            if frame.object(pixel) == 0 {
                frame.grey[pixel] = 100;
            }
        }
        let all = objects(&frame, &Settings::default());
        let contrasts = contrasts(&all).unwrap();
        let bright = frame.grey.iter().filter(|grey| **grey == 240).count() as f64 / all[0].area_px;
        let expected = 1.5 * (1.0 - bright) + 2.4 * bright;
        assert!((contrasts.contrast_mean_object_over_ring.median - expected).abs() < 1e-9);
        assert_eq!(contrasts.contrast_p95_object_over_ring.median, 2.4);
        assert_eq!((contrasts.shadow_below_08, contrasts.shadow_over_background.unwrap().median), (0.0, 1.0));
        assert!(contrasts.per_class.is_empty());
    }

    #[test]
    fn the_ring_has_its_width_and_leaves_other_objects_out() {
        let mut frame = painted(|_, _| 100);
        let (x, y) = (204, 180);
        let mut mask = vec![0; frame.grey.len()];
        (0..9).for_each(|row| mask[(y + row) * frame.width + x..][..9].fill(1));
        let pixels: Vec<usize> = (0..mask.len()).filter(|&pixel| mask[pixel] == 1).collect();
        frame.mask = Some(mask);
        // 9 × 14 on four sides, and the lattice points of the four quarters of a disc of 14: 613 in all, 57 on the axes.
        assert_eq!(ring(&frame, 1, &pixels, 14).total(), 4 * 9 * 14 + 613 - 57);
        let neighbour = y * frame.width + x + 12;
        frame.mask.as_mut().unwrap()[neighbour] = 2;
        assert_eq!(ring(&frame, 1, &pixels, 14).total(), 4 * 9 * 14 + 613 - 57 - 1);
    }

    #[test]
    fn classes_have_their_own_medians() {
        let labels = BTreeMap::from([(1, "tire".to_owned())]);
        let frame = Frame { labels: &labels, ..frame(|_| 100) };
        let all = objects(&frame, &Settings::default());
        let contrasts = contrasts(&[all.clone(), all].concat()).unwrap();
        assert_eq!(contrasts.per_class["tire"].n, 2);
        assert!((contrasts.per_class["tire"].shadow_ratio.unwrap() - 0.5).abs() < 0.01);
        assert_eq!(contrasts.shadow_below_06, 1.0);
    }
}
