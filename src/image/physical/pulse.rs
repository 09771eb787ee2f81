//! The pulse: what the receiver makes of a point in range, and what compressing a long pulse gains.
//!
//! `physics::response` has the widths; this has the shapes, sampled on range bins.

use serde::{Deserialize, Serialize};

use crate::math::Impossible;
use crate::math::real::sin;
use crate::physics::response::PulseWindow;

/// What is sent, and how the receiver filters it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Pulse {
    /// A tone as long as the bandwidth allows, 1/B, through its matched filter: a triangle, no side lobes.
    Tone,
    /// A chirp over the bandwidth, compressed by its matched filter.
    Chirp {
        /// Length of what is sent, ms; the gain over noise is bandwidth × length.
        duration_ms: f64,
        /// Weighting of the spectrum, against side lobes in range.
        window: PulseWindow,
    },
}

/// A pulse on the bins of a grid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sampled {
    /// Half of the symmetric response, middle first; the energy of the whole is 1.
    pub taps: Vec<f32>,
    /// Echo power of an even field at an instant, over its energy in a bin: equivalent length of the pulse over a bin's.
    pub echo_gain: f64,
    /// Looks at independent scatterers averaged in a bin.
    pub looks: u32,
}

impl Pulse {
    /// Refuses pulses that cannot be sent.
    ///
    /// # Errors
    /// A duration out of range.
    pub(super) fn validate(&self) -> Result<(), Impossible> {
        match *self {
            Self::Tone => Ok(()),
            Self::Chirp { duration_ms, .. } => {
                Impossible::outside("model.physical.pulse.chirp.duration_ms", duration_ms, 1e-4, 1000.0)
            }
        }
    }

    /// Response in amplitude after the receiver to a point `x` away, in units of c/2B; 1 at its middle.
    ///
    /// A tone's matched filter gives a triangle; a chirp's gives the transform of its weighted spectrum, `sinc(x)` or, for
    /// Hamming's weights, `sinc(x) + (0.23/0.54)·(sinc(x − 1) + sinc(x + 1))`.
    /// Source: Lurton (2002), An Introduction to Underwater Acoustics, ch. 5; Harris (1978), Proc. IEEE 66:51–83.
    #[must_use]
    pub fn response(&self, x: f64) -> f64 {
        match *self {
            Self::Tone => (1.0 - x.abs()).max(0.0),
            Self::Chirp { window: PulseWindow::Uniform, .. } => sinc(x),
            Self::Chirp { window: PulseWindow::Hamming, .. } => sinc(x) + 0.23 / 0.54 * (sinc(x - 1.0) + sinc(x + 1.0)),
        }
    }

    /// Length, in units of c/2B, of the rectangle with the response's peak and energy: `∫response² dx`, by Parseval's theorem.
    #[must_use]
    pub fn equivalent_length(&self) -> f64 {
        match *self {
            Self::Tone => 2.0 / 3.0,
            Self::Chirp { window: PulseWindow::Uniform, .. } => 1.0,
            Self::Chirp { window: PulseWindow::Hamming, .. } => (0.54 * 0.54 + 2.0 * 0.23 * 0.23) / (0.54 * 0.54),
        }
    }

    /// Power of white noise behind the receiver, over its power in the bandwidth, where an echo keeps its peak: for a chirp
    /// 1/(B·T), times the equivalent noise bandwidth of the window.
    ///
    /// Source: Urick (1983), ch. 2, processing gain; Harris (1978), table 1: 1.36 bins for Hamming.
    #[must_use]
    pub fn noise_gain(&self, bandwidth_hz: f64) -> f64 {
        match *self {
            Self::Tone => 1.0,
            // No pulse of this bandwidth is shorter than 1/B.
            Self::Chirp { duration_ms, .. } => self.equivalent_length() / (bandwidth_hz * duration_ms * 1e-3).max(1.0),
        }
    }

    /// The pulse of resolution `c/2B` on bins. Where a bin holds several pulses' lengths, the receiver detects in each of them
    /// and averages the powers, up to `most_looks`.
    pub(super) fn sampled(&self, resolution_m: f64, bin_m: f64, most_looks: u32) -> Sampled {
        let step = bin_m / resolution_m;
        let reach = match *self {
            Self::Tone => 1.0,
            // Beyond, side lobes are below −34 dB (uniform) and −60 dB (Hamming).
            Self::Chirp { window: PulseWindow::Uniform, .. } => 16.0,
            Self::Chirp { window: PulseWindow::Hamming, .. } => 8.0,
        };
        let last = (reach / step).floor().min(512.0) as u32;
        let taps: Vec<f64> = (0..=last).map(|k| self.response(f64::from(k) * step)).collect();
        let energy = taps[0] * taps[0] + 2.0 * taps[1..].iter().map(|tap| tap * tap).sum::<f64>();
        let lengths_in_bin = step / self.equivalent_length();
        Sampled {
            taps: taps.iter().map(|tap| (tap / energy.sqrt()) as f32).collect(),
            echo_gain: 1.0 / lengths_in_bin,
            looks: (lengths_in_bin.floor() as u32).clamp(1, most_looks.max(1)),
        }
    }
}

impl Sampled {
    /// The part of an even field's power that a bin receives where the grid ends: 1 but for the first and last bins.
    pub(super) fn coverage(&self, bins: usize) -> Vec<f64> {
        let squares: Vec<f64> = self.taps.iter().map(|&tap| f64::from(tap) * f64::from(tap)).collect();
        // Energy of the taps up to a distance, on one side.
        let within = |reach: usize| squares.iter().skip(1).take(reach).sum::<f64>();
        (0..bins).map(|bin| squares[0] + within(bin) + within(bins - 1 - bin)).collect()
    }

    /// Convolves a row with the response into `out`; beyond the row's ends there is nothing.
    #[inline(always)]
    pub(super) fn convolve(&self, row: &[f32], out: &mut [f32]) {
        let middle = self.taps[0];
        out.iter_mut().zip(row).for_each(|(out, value)| *out = middle * value);
        for (offset, &tap) in self.taps.iter().enumerate().skip(1).filter(|&(offset, _)| offset < row.len()) {
            out[offset..].iter_mut().zip(row).for_each(|(out, value)| *out += tap * value);
            out.iter_mut().zip(&row[offset..]).for_each(|(out, value)| *out += tap * value);
        }
    }
}

/// `sin(πx)/(πx)`.
fn sinc(x: f64) -> f64 {
    let angle = std::f64::consts::PI * x;
    if angle.abs() < 1e-6 { 1.0 } else { sin(angle) / angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::response::half_power_resolution_m;

    const PULSES: [Pulse; 3] = [
        Pulse::Tone,
        Pulse::Chirp { duration_ms: 0.1, window: PulseWindow::Uniform },
        Pulse::Chirp { duration_ms: 0.1, window: PulseWindow::Hamming },
    ];

    #[test]
    fn chirps_have_the_widths_that_theory_gives() {
        for window in [PulseWindow::Uniform, PulseWindow::Hamming] {
            // c/2B = 1 for c = 2 m/s and B = 1 Hz.
            let half = 0.5 * half_power_resolution_m(2.0, 1.0, window);
            let power = Pulse::Chirp { duration_ms: 1.0, window }.response(half).powi(2);
            assert!((power - 0.5).abs() < 1e-6, "{power}");
        }
    }

    #[test]
    fn lengths_are_the_integrals_of_the_responses() {
        for pulse in PULSES {
            let integral: f64 = (-60_000..60_000).map(|i| pulse.response(f64::from(i) * 0.005).powi(2) * 0.005).sum();
            assert!((integral / pulse.equivalent_length() - 1.0).abs() < 1e-3, "{pulse:?} {integral}");
        }
    }

    #[test]
    fn fine_bins_share_a_pulse_and_coarse_bins_hold_several() {
        for pulse in PULSES {
            let fine = pulse.sampled(0.01, 0.00125, 4);
            let energy: f32 = fine.taps.iter().skip(1).map(|tap| 2.0 * tap * tap).sum::<f32>() + fine.taps[0].powi(2);
            assert!((energy - 1.0).abs() < 1e-5 && fine.looks == 1);
            // The response and its equivalent length agree: peak power over energy is one over the length.
            let peak = f64::from(fine.taps[0]).powi(2) * fine.echo_gain;
            assert!((peak - 1.0).abs() < 0.03, "{pulse:?} {peak}");
            let coarse = pulse.sampled(0.01, 0.05, 3);
            assert!(coarse.taps[0] > 0.99 && coarse.looks == 3 && coarse.echo_gain < 0.3);
        }
    }

    #[test]
    fn a_chirp_gains_its_bandwidth_times_its_length_less_the_window() {
        let gain = PULSES[2].noise_gain(100e3);
        assert!((10.0 * gain.log10() + 10.0 - 1.344).abs() < 1e-3, "{gain}");
        assert_eq!(PULSES[0].noise_gain(100e3), 1.0);
    }

    #[test]
    fn the_ends_of_the_grid_receive_less() {
        let pulse = Pulse::Tone.sampled(0.01, 0.004, 1);
        let coverage = pulse.coverage(9);
        assert!((coverage[4] - 1.0).abs() < 1e-6 && coverage[0] < 0.9);
        let mut out = [0.0; 9];
        let mut row = [0.0; 9];
        row[0] = 1.0;
        pulse.convolve(&row, &mut out);
        assert_eq!(&out[..4], &[pulse.taps[0], pulse.taps[1], pulse.taps[2], 0.0]);
        assert!((f64::from(out.iter().map(|v| v * v).sum::<f32>()) - coverage[0]).abs() < 1e-6);
    }
}
