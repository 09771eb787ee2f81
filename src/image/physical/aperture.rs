//! The receiving line array: how many elements make the beam width stated, their weights and their errors.
//!
//! Elements stand so closely that their directions u = sin θ repeat only beyond the fan. Knows no beams and no ranges.

use serde::{Deserialize, Serialize};

use crate::math::real::{cos, ln, pow, radians, sin};
use crate::math::rng::Stream;
use crate::math::{Impossible, real};
use crate::physics::array::LineArray;
use crate::physics::shading::Shading;

/// A receiving array beside the beam width that the device states.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Array {
    /// Weights over the aperture. The aperture is as long as the stated beam width needs with them.
    pub shading: Shading,
    /// Standard deviation of the elements' gains, dB.
    pub gain_error_db: f64,
    /// Standard deviation of the elements' phases, degrees.
    pub phase_error_deg: f64,
    /// Standard deviation of the beams' gains behind the array, dB.
    pub ripple_db: f64,
    /// Where the array is focused.
    pub focus: Focus,
    /// One-way −3 dB width of the transmitter's pattern in bearing, degrees; none where it lights the fan evenly.
    pub transmit_width_deg: Option<f64>,
    /// Which specimen of the device this is: its errors and ripple are its own, and the same in every frame.
    pub unit: u64,
}

/// Where an array is focused.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Focus {
    /// At every range, as echoes come in.
    Dynamic,
    /// At one range.
    Fixed {
        /// That range, metres.
        range_m: f64,
    },
}

impl Array {
    /// Refuses arrays that form no beams.
    ///
    /// # Errors
    /// The first impossible figure, with its key.
    pub(super) fn validate(&self) -> Result<(), Impossible> {
        let weights = self.shading.weights(8).map(drop);
        weights.map_err(|fault| Impossible { key: "model.physical.array.shading", ..fault })?;
        Impossible::outside("model.physical.array.gain_error_db", self.gain_error_db, 0.0, 20.0)?;
        Impossible::outside("model.physical.array.phase_error_deg", self.phase_error_deg, 0.0, 180.0)?;
        Impossible::outside("model.physical.array.ripple_db", self.ripple_db, 0.0, 20.0)?;
        let width = self.transmit_width_deg.unwrap_or(90.0);
        Impossible::outside("model.physical.array.transmit_width_deg", width, 0.1, 180.0)?;
        match self.focus {
            Focus::Dynamic => Ok(()),
            Focus::Fixed { range_m } => {
                Impossible::outside("model.physical.array.focus.fixed.range_m", range_m, 1e-3, 1e5)
            }
        }
    }

    /// Amplitude gains of the beams behind the array, of this specimen.
    pub(super) fn ripple(&self, beams: usize) -> Vec<f64> {
        let mut stream = Stream::at(self.unit, "device", 0, "beam gains");
        (0..beams).map(|_| amplitude_from_db(self.ripple_db * stream.normal())).collect()
    }
}

/// The aperture as points a step apart, and the directions that a transform over them resolves.
#[derive(Clone, Debug)]
pub(super) struct Aperture {
    /// Shading of the elements, middle first: element ±k has `weights[k]`.
    pub half_weights: Vec<f64>,
    /// Distance of neighbouring elements, wavelengths.
    pub spacing: f64,
    /// Directions of the transform: a power of two.
    pub directions: usize,
}

/// What a device needs of its aperture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Needs {
    /// −3 dB width of a beam straight ahead, degrees.
    pub beam_width_deg: f64,
    /// Width of the fan, degrees.
    pub azimuth_deg: f64,
}

impl Aperture {
    /// The aperture whose beam straight ahead has its −3 dB width where the device states it.
    ///
    /// In u the pattern of elements `d` wavelengths apart repeats with period 1/d: the fan and a guard of six beam widths, or
    /// a tenth of the fan, must fit in (never more than the period 2 of half a wavelength). The number of elements is odd, so
    /// that one is in the middle; their spacing then follows exactly from the width.
    pub fn new(shading: &Shading, needs: Needs) -> Self {
        let half_width = sin(0.5 * radians(needs.beam_width_deg));
        let fan = 2.0 * sin(0.5 * radians(needs.azimuth_deg));
        let period = (fan + (12.0 * half_width).max(0.1 * fan)).min(2.0);
        // −3 dB point in u at spacing ½; it scales with 1/d.
        let half_power = |elements: u32| LineArray::new(elements, 0.5, shading).ok().and_then(|a| a.half_power_u());
        let spacing = |elements: u32| half_power(elements).map(|u| 0.5 * u / half_width);
        let long = half_power(65).unwrap_or(0.886 / 65.0) * 65.0;
        let mut elements = ((0.5 * period * long / half_width) as u32).max(3) | 1;
        let spacing = loop {
            match spacing(elements) {
                Some(spacing) if spacing * period <= 1.0 || elements >= 65_000 => break spacing,
                _ => elements += 2,
            }
        };
        let weights = shading.weights(elements).unwrap_or_else(|_| vec![1.0; elements as usize]);
        let directions = (1.0 / (spacing * half_width)).max(f64::from(elements + 1));
        Self {
            half_weights: weights[elements as usize / 2..].to_vec(),
            spacing,
            directions: (directions.ceil() as usize).next_power_of_two(),
        }
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        2 * self.half_weights.len() - 1
    }

    /// Step of the transform's directions, in u.
    pub fn u_step(&self) -> f64 {
        1.0 / (self.spacing * self.directions as f64)
    }

    /// Place of a direction among the transform's: number `directions / 2` looks straight ahead.
    pub fn place(&self, u: f64) -> f64 {
        u / self.u_step() + 0.5 * self.directions as f64
    }

    /// Distance of element `k` (0 first) from the middle, wavelengths.
    pub fn position(&self, element: usize) -> f64 {
        (element as f64 - (self.half_weights.len() - 1) as f64) * self.spacing
    }

    /// Row of the transform that is element `k`'s signal: e^(−2πi·ki/n) counts from the middle, round the end.
    pub fn row(&self, element: usize) -> usize {
        (element + self.directions - (self.half_weights.len() - 1)) % self.directions
    }

    /// Element `k`'s weight.
    pub fn weight(&self, element: usize) -> f64 {
        self.half_weights[element.abs_diff(self.half_weights.len() - 1)]
    }

    /// Complex weights with the errors of this specimen, for a transform there and back (which multiplies by its length)
    /// whose response to a point has energy 1.
    pub fn weights_with_errors(&self, array: &Array) -> Vec<(f32, f32)> {
        let mut stream = Stream::at(array.unit, "device", 0, "element errors");
        let scale = 1.0 / (self.directions as f64 * self.power_at(0.0)).sqrt();
        (0..self.elements())
            .map(|element| {
                let size = scale * self.weight(element) * amplitude_from_db(array.gain_error_db * stream.normal());
                let phase = radians(array.phase_error_deg) * stream.normal();
                ((size * cos(phase)) as f32, (size * sin(phase)) as f32)
            })
            .collect()
    }

    /// Correlation of an even field's echoes between directions `offset` steps apart, times the weights' energy:
    /// `Σ wₖ²·cos(2πk·offset/n)`.
    pub fn power_at(&self, offset: f64) -> f64 {
        self.cosine_sum(offset, |w| w * w)
    }

    /// Amplitude of the response `offset` steps from its middle, times a constant: `Σ wₖ·cos(2πk·offset/n)`.
    pub fn response_at(&self, offset: f64) -> f64 {
        self.cosine_sum(offset, |w| w)
    }

    /// Width in u of the rectangle with the pattern's peak and energy: `∫|B|² du = Σw²/(d·(Σw)²)`.
    ///
    /// Source: Van Trees (2002), Optimum Array Processing, ch. 2 (directivity of a line array); Harris (1978).
    pub fn equivalent_u(&self) -> f64 {
        let peak = self.response_at(0.0);
        self.power_at(0.0) / (self.spacing * peak * peak)
    }

    /// Sum over both halves, cosines by recurrence.
    fn cosine_sum(&self, offset: f64, of: impl Fn(f64) -> f64) -> f64 {
        let step = cos(std::f64::consts::TAU * offset / self.directions as f64);
        let (mut before, mut here, mut sum) = (1.0, step, of(self.half_weights[0]));
        for &weight in &self.half_weights[1..] {
            sum += 2.0 * of(weight) * here;
            (before, here) = (here, 2.0 * step * here - before);
        }
        sum
    }
}

/// One-way power pattern of a transmitter as a uniform line whose −3 dB width is `width_rad`, towards u.
///
/// `sinc²(0.442946·u / sin(width/2))`. Source: Urick (1983), ch. 3.
pub(super) fn transmit_power(u: f64, width_rad: f64) -> f64 {
    let x = std::f64::consts::PI * 0.442_946_470_689_452_3 * u / real::sin(0.5 * width_rad);
    if x.abs() < 1e-6 { 1.0 } else { (sin(x) / x) * (sin(x) / x) }
}

fn amplitude_from_db(db: f64) -> f64 {
    pow(10.0, db / 20.0)
}

/// Root of the mean square of amplitude errors of `db` and `deg`: the side-lobe floor over the main lobe is this squared over
/// the number of elements.
///
/// Source: Van Trees (2002), ch. 2.6.3, array perturbations; first order in both.
#[must_use]
pub fn error_rms(gain_error_db: f64, phase_error_deg: f64) -> f64 {
    let gain = gain_error_db * ln(10.0) / 20.0;
    let phase = radians(phase_error_deg);
    (gain * gain + phase * phase).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHADINGS: [Shading; 5] = [
        Shading::Uniform,
        Shading::Hann,
        Shading::Hamming,
        Shading::Taylor { side_lobe_db: 25.0, near: 4 },
        Shading::Chebyshev { side_lobe_db: 40.0 },
    ];

    #[test]
    fn every_shading_gets_the_width_and_the_room_that_it_needs() {
        for shading in SHADINGS {
            for (beam_width_deg, azimuth_deg) in
                [(0.6, 130.0), (0.25, 29.66), (1.0, 120.0), (10.0, 60.0), (45.0, 170.0)]
            {
                let aperture = Aperture::new(&shading, Needs { beam_width_deg, azimuth_deg });
                let array = LineArray::new(aperture.elements() as u32, aperture.spacing, &shading).unwrap();
                let width = real::degrees(array.beam_width_rad(0.0).unwrap());
                assert!((width / beam_width_deg - 1.0).abs() < 1e-9, "{shading:?} {width}");
                let fan = 2.0 * sin(0.5 * radians(azimuth_deg));
                assert!(1.0 / aperture.spacing >= fan.min(1.999), "{shading:?} {}", aperture.spacing);
                assert!(
                    aperture.u_step() <= sin(0.5 * radians(beam_width_deg))
                        && aperture.directions > aperture.elements()
                );
            }
        }
    }

    #[test]
    fn a_uniform_aperture_has_the_published_length() {
        let aperture = Aperture::new(&Shading::Uniform, Needs { beam_width_deg: 0.6, azimuth_deg: 130.0 });
        let length = aperture.elements() as f64 * aperture.spacing;
        assert!((length * radians(0.6) / 0.886 - 1.0).abs() < 1e-3, "{length}");
        assert!((aperture.equivalent_u() * length - 1.0).abs() < 1e-9);
        assert_eq!(aperture.row(aperture.elements() / 2), 0);
        assert_eq!(aperture.position(aperture.elements() / 2), 0.0);
    }

    #[test]
    fn weights_have_unit_energy_and_a_specimen_its_own_errors() {
        let array = Array {
            shading: Shading::Hamming,
            gain_error_db: 0.5,
            phase_error_deg: 3.0,
            ripple_db: 0.75,
            focus: Focus::Dynamic,
            transmit_width_deg: None,
            unit: 1,
        };
        let aperture = Aperture::new(&array.shading, Needs { beam_width_deg: 0.6, azimuth_deg: 130.0 });
        let weights = aperture.weights_with_errors(&array);
        let energy: f64 = weights.iter().map(|&(re, im)| f64::from(re * re + im * im)).sum();
        assert!((energy * aperture.directions as f64 - 1.0).abs() < 0.02, "{energy}");
        assert_eq!(weights, aperture.weights_with_errors(&array));
        let other = Array { unit: 2, ..array };
        assert_ne!(weights, aperture.weights_with_errors(&other));
        assert_ne!(array.ripple(4), other.ripple(4));
        assert!((error_rms(0.5, 3.0) - 0.0779).abs() < 1e-4);
    }
}
