//! A quantity that wanders about zero, in closed form: any time can be asked for, in any order.
//!
//! Knows nothing of what it moves.

use std::f64::consts::TAU;

use crate::math::real::{cos, pow};
use crate::math::rng::Stream;

/// Waves that are summed: enough for a sum that is nearly normal and does not repeat within a scene.
const WAVES: u32 = 16;

/// How much and how slowly something wanders.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wander {
    /// Root mean square over a long time, in the unit of the quantity.
    pub rms: f64,
    /// Mean period; the waves' periods spread evenly in octaves from half to twice that, seconds.
    pub period_s: f64,
}

impl Wander {
    /// Its value at a time, at most 5.7 times its root mean square; `stream` draws periods and phases and is to be the same
    /// for all times of a scene.
    ///
    /// A sum of waves of equal amplitude whose phases are drawn is a stationary random process with that spectrum.
    /// Source: Shinozuka & Deodatis (1991), Simulation of stochastic processes by spectral representation, eq. 41.
    pub fn at(self, time_s: f64, mut stream: Stream) -> f64 {
        if self.rms == 0.0 {
            return 0.0;
        }
        let wave = |number: u32| {
            let octave = 2.0 * (f64::from(number) + stream.unit()) / f64::from(WAVES) - 1.0;
            let turns = pow(2.0, octave) * time_s / self.period_s + stream.unit();
            cos(TAU * turns)
        };
        self.rms * (2.0 / f64::from(WAVES)).sqrt() * (0..WAVES).map(wave).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_its_strength_and_its_pace() {
        let wander = Wander { rms: 2.0, period_s: 5.0 };
        for index in 0..5 {
            let values: Vec<f64> =
                (0..40_000).map(|k| wander.at(f64::from(k) * 0.1, Stream::at(1, "scene", index, "roll"))).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let square = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
            assert!(mean.abs() < 0.02 && (square.sqrt() - 2.0).abs() < 0.03, "{mean} {square}");
            // A wave of a period crosses zero upwards once in it.
            let up = values.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count() as f64;
            let period = 4000.0 / up;
            assert!((3.0..7.0).contains(&period), "{period}");
        }
        let still = Wander { rms: 0.0, period_s: 5.0 };
        assert_eq!(still.at(3.0, Stream::at(1, "scene", 0, "roll")), 0.0);
    }
}
