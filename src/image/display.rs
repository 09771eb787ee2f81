//! Display: from powers to grey.

use serde::{Deserialize, Serialize};

use crate::math::Impossible;
use crate::math::fast::db;
use crate::math::real::{db_from_power, pow};
use crate::math::vectors::{Work, widest};

/// The levels that black and white stand for, as backscattering strength: after a 30 log R gain, a flat seabed shows its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Backscattering strength shown white (255), dB.
    pub white_db: f64,
    /// Decibels from white down to black (0).
    pub dynamic_range_db: f64,
    /// Exponent on the grey from 0 to 1: above 1 darkens what is between.
    pub gamma: f64,
}

/// What lies between a power and the backscattering strength that made it.
#[derive(Clone, Copy, Debug)]
pub struct Scale<'a> {
    /// Gain of each bin, dB.
    pub gain_db: &'a [f64],
    /// Area that each beam hears at 1 m, m².
    pub footprint_m2: &'a [f64],
}

impl Display {
    /// Refuses displays that show nothing.
    ///
    /// # Errors
    /// The first impossible figure, with its key.
    pub fn validate(&self) -> Result<(), Impossible> {
        Impossible::outside("display.white_db", self.white_db, -200.0, 200.0)?;
        Impossible::outside("display.dynamic_range_db", self.dynamic_range_db, 1.0, 200.0)?;
        Impossible::outside("display.gamma", self.gamma, 0.1, 10.0)
    }

    /// Power → decibels → gain, less the beam's footprint → grey, in cell order.
    #[must_use]
    pub fn grey(&self, powers: &[f32], scale: &Scale<'_>) -> Vec<u8> {
        let table = self.table();
        let steps_per_db = (table.len() - 1) as f32 / self.dynamic_range_db as f32;
        let black = self.white_db - self.dynamic_range_db;
        let bins = scale.gain_db.len();
        let gain: Vec<f32> = scale.gain_db.iter().map(|gain| (gain - black) as f32).collect();
        let mut grey = vec![0; powers.len()];
        let (mut offset_db, mut steps) = (vec![0.0; bins], vec![0; bins]);
        let beams = powers.chunks_exact(bins).zip(grey.chunks_exact_mut(bins));
        for ((powers, grey), footprint) in beams.zip(scale.footprint_m2) {
            let area = db_from_power(*footprint) as f32;
            offset_db.iter_mut().zip(&gain).for_each(|(offset, gain)| *offset = gain - area);
            widest(ToSteps { powers, offset_db: &offset_db, steps_per_db, last: table.len() - 1, steps: &mut steps });
            grey.iter_mut().zip(&steps).for_each(|(grey, &step)| *grey = table[step as usize]);
        }
        grey
    }

    /// Grey of levels from black to white in fine steps.
    fn table(&self) -> Vec<u8> {
        const STEPS: u32 = 4080;
        let grey = |step: u32| 255.0 * pow(f64::from(step) / f64::from(STEPS), self.gamma) + 0.5;
        (0..=STEPS).map(|step| grey(step) as u8).collect()
    }
}

/// Powers of a beam to steps of the table.
struct ToSteps<'a> {
    powers: &'a [f32],
    offset_db: &'a [f32],
    steps_per_db: f32,
    last: usize,
    steps: &'a mut [i32],
}

impl Work for ToSteps<'_> {
    #[inline(always)]
    fn run(self) {
        let last = self.last as f32;
        for ((power, offset), step) in self.powers.iter().zip(self.offset_db).zip(self.steps) {
            let above_black = db(power.max(f32::MIN_POSITIVE)) + offset;
            *step = (above_black * self.steps_per_db + 0.5).max(0.0).min(last) as i32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::real::power_from_db;

    #[test]
    fn white_black_and_between_are_where_the_display_says() {
        let display = Display { white_db: -5.0, dynamic_range_db: 60.0, gamma: 1.0 };
        let scale = Scale { gain_db: &[3.0, 20.0, 41.0, 10.0], footprint_m2: &[1e-3] };
        // A cell whose echo is that of backscattering strength `s` under its gain.
        let power = |s: f64, bin: usize| power_from_db(s - scale.gain_db[bin] - 30.0) as f32;
        let powers = [power(-5.0, 0), power(-35.0, 1), power(-65.0, 2), 0.0];
        assert_eq!(display.grey(&powers, &scale), [255, 128, 0, 0]);
        let dark = Display { gamma: 2.0, ..display };
        assert_eq!(dark.grey(&powers, &scale), [255, 64, 0, 0]);
    }
}
