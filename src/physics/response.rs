//! What a pulse resolves in range, and how often it may be sent.

use serde::{Deserialize, Serialize};

use super::numeric::crossing;
use super::target::sinc;

/// Weighting of a chirp's spectrum in the matched filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PulseWindow {
    /// None: −13.26 dB side lobes in range.
    Uniform,
    /// Hamming: −42.7 dB, half as wide again.
    Hamming,
}

/// Slant range that a tone of a duration (s) fills, m: `c·τ/2`. Source: Urick (1983), ch. 8.
#[must_use]
pub fn tone_resolution_m(sound_speed_m_s: f64, duration_s: f64) -> f64 {
    0.5 * sound_speed_m_s * duration_s
}

/// Rayleigh resolution in slant range of a pulse of a bandwidth (Hz), m: `c/2B`, from the peak to the first null.
///
/// Source: Lurton (2002), An Introduction to Underwater Acoustics, ch. 5.
#[must_use]
pub fn pulse_resolution_m(sound_speed_m_s: f64, bandwidth_hz: f64) -> f64 {
    0.5 * sound_speed_m_s / bandwidth_hz
}

/// −3 dB width in slant range of a compressed chirp, m: a factor of the window times `c/2B` (0.886 or 1.303).
///
/// The response of a flat spectrum is sinc(x), x = B·t; Hamming's is `0.54·sinc(x) + 0.23·(sinc(x − 1) + sinc(x + 1))`.
/// Source: Harris (1978), Proc. IEEE 66:51–83; Lurton (2002), ch. 5.
#[must_use]
pub fn half_power_resolution_m(sound_speed_m_s: f64, bandwidth_hz: f64, window: PulseWindow) -> f64 {
    2.0 * half_power_x(window) * pulse_resolution_m(sound_speed_m_s, bandwidth_hz)
}

/// Greatest ping rate for a range, Hz: one ping in the water, `c/(2R)`. Source: definition; Urick (1983), ch. 2.
#[must_use]
pub fn ping_rate_hz(sound_speed_m_s: f64, range_m: f64) -> f64 {
    0.5 * sound_speed_m_s / range_m
}

/// Where a window's response falls to half its power, in units of 1/B.
fn half_power_x(window: PulseWindow) -> f64 {
    let normal = |x: f64| sinc(std::f64::consts::PI * x);
    let response = |x: f64| match window {
        PulseWindow::Uniform => normal(x),
        PulseWindow::Hamming => normal(x) + 0.23 / 0.54 * (normal(x - 1.0) + normal(x + 1.0)),
    };
    // Both fall from 1 to less than half within the first null, which lies at 1 and 2.
    crossing(0.0, 1.0, |x| response(x) * response(x) > 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_of_a_100_khz_pulse() {
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
        close(tone_resolution_m(1500.0, 1e-5), 0.0075);
        close(pulse_resolution_m(1500.0, 1e5), 0.0075);
        close(half_power_resolution_m(1500.0, 1e5, PulseWindow::Uniform), 0.006_644_25);
        // Harris' table 1: 1.30 bins.
        close(half_power_resolution_m(1500.0, 1e5, PulseWindow::Hamming), 1.302_98 * 0.0075);
        close(ping_rate_hz(1500.0, 120.0), 6.25);
    }
}
