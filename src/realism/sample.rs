//! Frames with known answers, for tests.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::geometry::FanGeometry;
use super::images::Frame;
use crate::math::real::radians;
use crate::math::rng::Stream;

/// A 60° fan of 128 beams in 410 × 360 pixels, ranges 60–400 pixels.
static FAN: LazyLock<FanGeometry> = LazyLock::new(|| FanGeometry {
    apex_px: [204.5, 399.5],
    vertical_stretch: 1.0,
    rmax_px: 400.0,
    rmin_px: 60.0,
    fov_deg: 60.0,
    beams: Some(128),
});

static NO_LABELS: BTreeMap<u16, String> = BTreeMap::new();

/// The frame that is one grey.
pub(super) fn blank(grey: u8) -> Frame<'static> {
    painted(|_, _| grey)
}

/// Pixels by range (pixels) and bearing (degrees, positive to the left).
pub(super) fn painted(paint: impl Fn(f64, f64) -> u8) -> Frame<'static> {
    let (width, height) = (410, 360);
    let pixels = (0..width * height).map(|pixel| {
        let (range, bearing) = FAN.polar((pixel % width) as f64, (pixel / width) as f64);
        paint(range, bearing / radians(1.0))
    });
    let grey = pixels.collect();
    let inside = FAN.inside(width as u32, height as u32);
    Frame { fan: &FAN, width, height, grey, inside, mask: None, labels: &NO_LABELS }
}

/// Independent pixels.
pub(super) fn noise(seed: u64, draw: impl Fn(&mut Stream) -> f64) -> Frame<'static> {
    let mut frame = blank(0);
    let mut stream = Stream::at(seed, "test", 0, "noise");
    frame.grey.iter_mut().for_each(|grey| *grey = (draw(&mut stream) + 0.5).clamp(0.0, 255.0) as u8);
    frame
}
